using System;

namespace Guidewire.Core
{
    /// <summary>All places of a tube within a range of a segment: where its distance d(s) along the segment is locally
    /// least, with weight 1, and between each two of them where it is largest, with weight -1.</summary>
    /// <remarks>d is the largest of the pieces' terms, each concave in s. On a stretch where one piece's term is the
    /// largest d can have one maximum and no minimum but at its ends. So the stretches are found first: a part of the
    /// segment is halved until one piece is proven to be the largest on it. A neighbour whose centre stays at the knot
    /// that both share has that knot's term, which is no larger than the piece's own; every other piece is bounded by
    /// the tangents at both ends, the piece itself by its chord. Without the maxima a minimum at an end that turns away
    /// from the wall would vanish at a finite distance; with them it meets its maximum and both go.</remarks>
    internal sealed class TubePlaces
    {
        private const int MaxHalvings = 44;
        private const double Level = 1e-12;    // slope per length below which d neither rises nor falls
        private readonly TubeShape _tube;
        private readonly int _pieceCount;
        private readonly StructList<Stretch> _stretches = new StructList<Stretch>(8);
        private readonly double _resolution;
        private Vector3d _a;
        private Vector3d _b;
        private double _length;

        /// <summary>For queries of one thread.</summary>
        public TubePlaces(TubeShape tube)
        {
            _tube = tube;
            _pieceCount = tube.Knots.Length - 1;
            double widest = 0.0;
            foreach (double radius in tube.Radii)
            {
                widest = Math.Max(widest, radius);
            }
            _resolution = 1e-13 * widest;
        }

        /// <summary>Adds the places within <paramref name="range"/> of segment a b, from a to b.</summary>
        public void Find(in Vector3d a, in Vector3d b, double range, StructList<WallPlace> places)
        {
            _a = a;
            _b = b;
            _length = Vector3d.Distance(a, b);
            if (_length == 0.0)
            {
                Add(0.0, 1, range, places);
                return;
            }
            double da = _tube.Distance(a, out _);
            double db = _tube.Distance(b, out _);
            if (0.5 * (da + db - _length) > range)
            {
                return;
            }
            _stretches.Clear();
            if (_length > 0.0)
            {
                Split(0.0, 1.0, 0);
            }
            bool falls = true;
            double low = 0.0;    // from where on d falls no more
            for (int k = 0; k < _stretches.Count; k++)
            {
                Stretch stretch = _stretches[k];
                double first = Slope(stretch.Piece, stretch.From);
                double last = Slope(stretch.Piece, stretch.To);
                if (falls && first > Level * _length)
                {
                    Add(0.5 * (low + stretch.From), 1, range, places);
                    falls = false;
                }
                if (!falls && last < -Level * _length)
                {
                    Add(first > 0.0 ? Top(stretch) : stretch.From, -1, range, places);
                    falls = true;
                }
                low = last < -Level * _length ? stretch.To : low;
            }
            if (falls)
            {
                Add(_length > 0.0 ? 0.5 * (low + 1.0) : 0.0, 1, range, places);
            }
        }

        // Adds the stretches of one piece each that make up the part from s0 to s1; at the last halving that part is
        // a handover of no length, and whichever pieces serve its ends have their stretches up to it.
        private void Split(double s0, double s1, int depth)
        {
            int piece = Largest(0.5 * (s0 + s1));
            if (depth == MaxHalvings || IsLargest(piece, s0, s1))
            {
                if (_stretches.Count > 0 && _stretches[_stretches.Count - 1].Piece == piece)
                {
                    s0 = _stretches[_stretches.Count - 1].From;
                    _stretches[_stretches.Count - 1] = new Stretch(piece, s0, s1);
                }
                else if (depth < MaxHalvings)
                {
                    _stretches.Add(new Stretch(piece, s0, s1));
                }
                return;
            }
            double middle = 0.5 * (s0 + s1);
            Split(s0, middle, depth + 1);
            Split(middle, s1, depth + 1);
        }

        private int Largest(double s)
        {
            _tube.Largest(Vector3d.Lerp(_a, _b, s), 0, out int largest);
            return largest;
        }

        private bool IsLargest(int piece, double s0, double s1)
        {
            double own0 = _tube.PieceDistance(piece, Vector3d.Lerp(_a, _b, s0), out _, out _);
            double own1 = _tube.PieceDistance(piece, Vector3d.Lerp(_a, _b, s1), out _, out _);
            for (int i = 0; i < _pieceCount; i++)
            {
                bool isNeighbour = i == piece - 1 || i == piece + 1;
                if (i == piece || (isNeighbour && StaysAtKnot(i, i < piece, s0, s1)))
                {
                    continue;
                }
                double slope0 = Slope(i, s0, out double value0);
                double slope1 = Slope(i, s1, out double value1);
                double h = s1 - s0;
                double over0 = value0 - own0;
                double over1 = value1 - own1;
                double steepness = (own1 - own0) / h;
                if (Math.Max(over0, over1) > _resolution
                    || TopOfTangents(over0, slope0 - steepness, over1, slope1 - steepness, h) > _resolution)
                {
                    return false;
                }
            }
            return true;
        }

        // Largest value on 0..h below both tangents y0 + m0 s and y1 + m1 (s - h).
        private static double TopOfTangents(double y0, double m0, double y1, double m1, double h)
        {
            if (m0 <= 0.0 || m1 >= 0.0)
            {
                return Math.Max(Math.Min(y0, y1 - m1 * h), Math.Min(y1, y0 + m0 * h));
            }
            double meet = Math.Min(Math.Max((y1 - m1 * h - y0) / (m0 - m1), 0.0), h);
            return Math.Min(y0 + m0 * meet, y1 + m1 * (meet - h));
        }

        // True where piece i's centre is proven to stay at its last (or first) knot. Where along the endless piece it
        // would lie is the sum of a linear function of s and a convex one times the slope of the radius.
        private bool StaysAtKnot(int i, bool last, double s0, double s1)
        {
            _tube.PieceDistance(i, Vector3d.Lerp(_a, _b, s0), out _, out double along0);
            _tube.PieceDistance(i, Vector3d.Lerp(_a, _b, s1), out _, out double along1);
            double beyond0 = last ? along0 - 1.0 : -along0;
            double beyond1 = last ? along1 - 1.0 : -along1;
            double size = Vector3d.Distance(_tube.Knots[i], _tube.Knots[i + 1]);
            double k = (_tube.Radii[i + 1] - _tube.Radii[i]) / size;
            bool endsSuffice = last ? k <= 0.0 : k >= 0.0;
            double fastest = (1.0 + Math.Abs(k) / Math.Sqrt(1.0 - k * k)) * _length * (s1 - s0) / size;
            return beyond0 >= 0.0 && beyond1 >= 0.0 && (endsSuffice || beyond0 + beyond1 >= fastest);
        }

        // Where the piece's term is largest within the stretch, its slope going from positive to negative.
        private double Top(in Stretch stretch)
        {
            double rising = stretch.From;
            double falling = stretch.To;
            for (int k = 0; k < MaxHalvings; k++)
            {
                double middle = 0.5 * (rising + falling);
                if (Slope(stretch.Piece, middle) > 0.0)
                {
                    rising = middle;
                }
                else
                {
                    falling = middle;
                }
            }
            return 0.5 * (rising + falling);
        }

        private double Slope(int piece, double s)
        {
            return Slope(piece, s, out _);
        }

        private double Slope(int piece, double s, out double value)
        {
            Vector3d x = Vector3d.Lerp(_a, _b, s);
            value = _tube.PieceDistance(piece, x, out Vector3d centre, out _);
            return Vector3d.Dot(Vector3d.Normalize(centre - x), _b - _a);
        }

        private void Add(double s, int weight, double range, StructList<WallPlace> places)
        {
            Vector3d x = Vector3d.Lerp(_a, _b, s);
            double distance = _tube.Largest(x, 0, out int piece);
            if (distance <= range)
            {
                Add(x, s, weight, piece, distance, places);
            }
        }

        /// <summary>Adds the place of a point whose piece and distance are known.</summary>
        public void Add(in Vector3d x, int piece, double distance, StructList<WallPlace> places)
        {
            Add(x, 0.0, 1, piece, distance, places);
        }

        private void Add(in Vector3d x, double s, int weight, int piece, double distance,
            StructList<WallPlace> places)
        {
            _tube.PieceDistance(piece, x, out Vector3d centre, out double along);
            double radius = Vector3d.Distance(centre, x);
            Vector3d normal = Vector3d.Normalize(centre - x);
            var contact = new SurfaceContact(s, x - distance * normal, normal, distance);
            Vector3d axis = _tube.Knots[piece + 1] - _tube.Knots[piece];
            Vector3d around = Vector3d.Normalize(Vector3d.Cross(axis, normal));
            bool isRound = along <= 0.0 || along >= 1.0;
            places.Add(isRound ? WallPlace.Corner(contact, weight, -radius)
                : WallPlace.Edge(contact, weight, Vector3d.Cross(around, normal), -radius));
        }

        // A part of the segment on which one piece's term is the largest.
        private readonly struct Stretch
        {
            public readonly int Piece;
            public readonly double From;
            public readonly double To;

            public Stretch(int piece, double from, double to)
            {
                Piece = piece;
                From = from;
                To = to;
            }
        }
    }
}
