using System;

namespace Guidewire.Core
{
    /// <summary>The pieces of a tube that are deepest along a segment, in order, and where one hands over to the next:
    /// the points where both hold it equally deep. No point of the segment is less deep than the least of them and the
    /// ends.</summary>
    internal sealed class TubeHandovers
    {
        private const int MostCuts = 24;
        private readonly TubeTree _tree;
        private readonly StructList<TubePoint> _places = new StructList<TubePoint>(16);

        /// <summary>For the tree of a tube's pieces.</summary>
        public TubeHandovers(TubeTree tree)
        {
            _tree = tree;
        }

        /// <summary>First end of the segment, units.</summary>
        public Vector3d A { get; private set; }

        /// <summary>Second end of the segment, units.</summary>
        public Vector3d B { get; private set; }

        /// <summary>Least distance of the ends and of all handovers, units.</summary>
        public double Least { get; private set; }

        /// <summary>Takes the pieces of segment a b; where an end is nearer than <paramref name="enough"/>, only
        /// <see cref="Least"/>.</summary>
        public void Find(in Vector3d a, in Vector3d b, double enough)
        {
            A = a;
            B = b;
            int first = _tree.Deepest(a, _places.Count > 0 ? _places[0].Piece : 0, out double da);
            int last = _tree.Deepest(b, first, out double db);
            Least = Math.Min(da, db);
            var start = new TubePoint(0.0, da, first);
            _places.Clear();
            _places.Add(start);
            if (Least < enough)
            {
                return;
            }
            Cut(start, new TubePoint(1.0, db, last), 0);
            _places.Add(new TubePoint(1.0, db, last));
        }

        /// <summary>True where a linear motion of the segment to where <paramref name="after"/> has it is proven to
        /// have a clearance, units.</summary>
        /// <remarks>A handover's position on the segment changes linearly with time, and so does the segment: their
        /// product bends the handover's path by up to a quarter of both changes.</remarks>
        public bool LeadTo(TubeHandovers after, double clearance)
        {
            if (_places.Count != after._places.Count)
            {
                return false;
            }
            double turn = ((after.B - after.A) - (B - A)).Length;
            for (int k = 0; k + 1 < _places.Count; k++)
            {
                TubePoint left = _places[k];
                TubePoint right = _places[k + 1];
                TubePoint leftAfter = after._places[k];
                TubePoint rightAfter = after._places[k + 1];
                double slide = Math.Max(Math.Abs(leftAfter.S - left.S), Math.Abs(rightAfter.S - right.S));
                double least = Math.Min(
                    Math.Min(left.Distance, right.Distance), Math.Min(leftAfter.Distance, rightAfter.Distance));
                if (left.Piece != leftAfter.Piece || least < clearance + 0.25 * slide * turn)
                {
                    return false;
                }
            }
            return true;
        }

        private void Cut(in TubePoint from, in TubePoint to, int cuts)
        {
            if (from.Piece == to.Piece)
            {
                return;
            }
            if (cuts == MostCuts)
            {
                Least = double.NegativeInfinity;    // not known
                return;
            }
            double s = _tree.Crossing(A, B, from, to);
            Vector3d x = Vector3d.Lerp(A, B, s);
            double equal = Math.Min(_tree.Pieces[from.Piece].Distance(x), _tree.Pieces[to.Piece].Distance(x));
            int deepest = _tree.Deepest(x, from.Piece, out double d);
            if (d <= equal + _tree.Resolution)
            {
                Least = Math.Min(Least, equal);
                _places.Add(new TubePoint(s, equal, to.Piece));
                return;
            }
            var cut = new TubePoint(s, d, deepest);
            Cut(from, cut, cuts + 1);
            Cut(cut, to, cuts + 1);
        }
    }
}
