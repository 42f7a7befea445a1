using System;

namespace Guidewire.Core
{
    /// <summary>Finds the piece of a tube in which a point lies deepest: a binary tree over the pieces in the order of
    /// the centreline, each node with the box around its knots and its largest radius.</summary>
    /// <remarks>A piece gives a point no more than its largest radius less the point's distance from the box, so most
    /// of a long tube is skipped by one test. Nothing is allocated in a search.</remarks>
    internal sealed class TubeTree
    {
        private const int MaxSecants = 60;
        private readonly TubePiece[] _pieces;
        private readonly Vector3d[] _low;      // per node; the children of node i are 2 i + 1 and 2 i + 2
        private readonly Vector3d[] _high;
        private readonly double[] _widest;     // largest radius, units

        /// <summary>The tree over the pieces between successive knots.</summary>
        /// <param name="knots">At least 2, units.</param>
        /// <param name="radii">One for each, units.</param>
        /// <param name="resolution">Distances that differ by no more count as equal, units.</param>
        public TubeTree(Vector3d[] knots, double[] radii, double resolution)
        {
            Resolution = resolution;
            _pieces = new TubePiece[knots.Length - 1];
            for (int i = 0; i < _pieces.Length; i++)
            {
                _pieces[i] = new TubePiece(knots[i], knots[i + 1], radii[i], radii[i + 1]);
            }
            int nodes = 1;
            while (nodes < _pieces.Length)
            {
                nodes *= 2;
            }
            _low = new Vector3d[2 * nodes];
            _high = new Vector3d[2 * nodes];
            _widest = new double[2 * nodes];
            Enclose(0, 0, _pieces.Length, knots, radii);
        }

        /// <summary>The pieces, along the centreline.</summary>
        public TubePiece[] Pieces => _pieces;

        /// <summary>Distances that differ by no more count as equal, units.</summary>
        public double Resolution { get; }

        /// <summary>The piece in which x lies deepest, and its term there.</summary>
        /// <param name="x">Units.</param>
        /// <param name="guess">A piece that is tried first, such as that of a point nearby; it wins ties.</param>
        /// <param name="distance">The piece's term at x, units.</param>
        public int Deepest(in Vector3d x, int guess, out double distance)
        {
            int piece = guess;
            distance = _pieces[guess].Distance(x);
            Descend(0, 0, _pieces.Length, x, ref piece, ref distance);
            return piece;
        }

        /// <summary>Where on segment a b, between two points, the terms of their pieces are equal; false position with
        /// the weight of an end that stays halved (Illinois).</summary>
        public double Crossing(in Vector3d a, in Vector3d b, in TubePoint from, in TubePoint to)
        {
            ref readonly TubePiece first = ref _pieces[from.Piece];
            ref readonly TubePiece last = ref _pieces[to.Piece];
            double s0 = from.S;
            double s1 = to.S;
            double over0 = from.Distance - last.Distance(Vector3d.Lerp(a, b, s0));
            double over1 = first.Distance(Vector3d.Lerp(a, b, s1)) - to.Distance;
            if (!(over0 > 0.0) || !(over1 < 0.0))
            {
                // Equal at an end: two pieces have the same term about their common knot.
                return over0 > 0.0 ? s1 : s0;
            }
            double s = s0;
            for (int k = 0; k < MaxSecants; k++)
            {
                s = s0 + (s1 - s0) * (over0 / (over0 - over1));
                Vector3d x = Vector3d.Lerp(a, b, s);
                double over = first.Distance(x) - last.Distance(x);
                if (Math.Abs(over) <= 0.1 * Resolution || !(s > s0 && s < s1))
                {
                    break;
                }
                if (over > 0.0)
                {
                    s0 = s;
                    over0 = over;
                    over1 *= 0.5;
                }
                else
                {
                    s1 = s;
                    over1 = over;
                    over0 *= 0.5;
                }
            }
            return s;
        }

        /// <summary>Adds the pieces that hold something within a range of segment a b, in their order.</summary>
        public void Collect(in Vector3d a, in Vector3d b, double limit, StructList<WallFeature> pieces)
        {
            Vector3d middle = 0.5 * (a + b);
            Collect(0, 0, _pieces.Length, a, b, limit, middle, -limit - 0.5 * Vector3d.Distance(a, b), pieces);
        }

        private void Collect(int node, int first, int end, in Vector3d a, in Vector3d b, double limit,
            in Vector3d middle, double least, StructList<WallFeature> pieces)
        {
            if (Bound(node, middle) < least)
            {
                return;
            }
            if (end - first == 1)
            {
                if (_pieces[first].MayHold(a, b, limit))
                {
                    pieces.Add(new WallFeature(first, 0.0));
                }
                return;
            }
            int half = (first + end) / 2;
            Collect(2 * node + 1, first, half, a, b, limit, middle, least, pieces);
            Collect(2 * node + 2, half, end, a, b, limit, middle, least, pieces);
        }

        private void Descend(int node, int first, int end, in Vector3d x, ref int piece, ref double distance)
        {
            if (end - first == 1)
            {
                double own = _pieces[first].Distance(x);
                if (own > distance)
                {
                    distance = own;
                    piece = first;
                }
                return;
            }
            int middle = (first + end) / 2;
            double left = Bound(2 * node + 1, x);
            double right = Bound(2 * node + 2, x);
            bool leftFirst = left >= right;
            if (leftFirst && left > distance)
            {
                Descend(2 * node + 1, first, middle, x, ref piece, ref distance);
            }
            if (right > distance)
            {
                Descend(2 * node + 2, middle, end, x, ref piece, ref distance);
            }
            if (!leftFirst && left > distance)
            {
                Descend(2 * node + 1, first, middle, x, ref piece, ref distance);
            }
        }

        private double Bound(int node, in Vector3d x)
        {
            Vector3d low = _low[node] - x;
            Vector3d high = x - _high[node];
            double dx = Math.Max(0.0, Math.Max(low.X, high.X));
            double dy = Math.Max(0.0, Math.Max(low.Y, high.Y));
            double dz = Math.Max(0.0, Math.Max(low.Z, high.Z));
            return _widest[node] - Math.Sqrt(dx * dx + dy * dy + dz * dz);
        }

        private void Enclose(int node, int first, int end, Vector3d[] knots, double[] radii)
        {
            Vector3d low = knots[first];
            Vector3d high = low;
            for (int i = first; i <= end; i++)
            {
                low = BvhNode.Min(low, knots[i]);
                high = BvhNode.Max(high, knots[i]);
                _widest[node] = Math.Max(_widest[node], radii[i]);
            }
            _low[node] = low;
            _high[node] = high;
            if (end - first > 1)
            {
                int middle = (first + end) / 2;
                Enclose(2 * node + 1, first, middle, knots, radii);
                Enclose(2 * node + 2, middle, end, knots, radii);
            }
        }
    }

    /// <summary>A point of a segment in a tube.</summary>
    internal readonly struct TubePoint
    {
        /// <summary>Where along the segment, 0 at its first end and 1 at its second.</summary>
        public readonly double S;

        /// <summary>The signed distance d there, units.</summary>
        public readonly double Distance;

        /// <summary>The piece that gives it; at a handover, the one that follows.</summary>
        public readonly int Piece;

        /// <summary>Makes a point with these values.</summary>
        public TubePoint(double s, double distance, int piece)
        {
            S = s;
            Distance = distance;
            Piece = piece;
        }
    }

    /// <summary>Pieces of a tube that overlap pieces which are not next to them: legs of a hairpin, where the tube
    /// comes back to itself, and where it widens so much in short pieces that one holds the crease of others. A segment
    /// may cross from one to the other at no knot.</summary>
    internal sealed class TubeOverlaps
    {
        private const double LargestTurn = 1.0;    // radians between axes of pieces that pieces between them separate
        private const int Directions = 6;          // around a knot, in which its crease is looked at
        private const int Iterations = 10;
        private const double Near = 1e-9;          // of the radius: a crease that is found
        private const double Hidden = 1e-4;        // of the radius, by which another piece is deeper there
        private const double LeastSine = 1e-6;     // of the angle of a crease
        private static readonly double[] Depths = { 0.0, 0.25 };    // of the radius, at which it is looked at
        private readonly bool[] _isIn;             // by piece
        private readonly bool[] _hides;            // by piece
        private bool _hasAny;
        private bool _hidesAny;

        /// <summary>Finds the overlaps of the tube through these knots with these radii, units.</summary>
        /// <param name="tree">Of its pieces.</param>
        public TubeOverlaps(Vector3d[] knots, double[] radii, TubeTree tree)
        {
            int count = knots.Length - 1;
            _isIn = new bool[count];
            _hides = new bool[count];
            var lengths = new double[count];
            for (int i = 0; i < count; i++)
            {
                lengths[i] = Vector3d.Distance(knots[i], knots[i + 1]);
            }
            for (int i = 0; i < count; i++)
            {
                double between = 0.0;    // length of the pieces between i and j
                Vector3d axis = (knots[i + 1] - knots[i]) / lengths[i];
                for (int j = i + 2; j < count; j++)
                {
                    between += lengths[j - 1];
                    double range = Math.Max(radii[i], radii[i + 1]) + Math.Max(radii[j], radii[j + 1]);
                    double far = range + lengths[i] + lengths[j];
                    if ((knots[i] - knots[j]).LengthSquared > far * far)
                    {
                        continue;
                    }
                    double squared = ClosestPoints.SegmentSegment(
                        knots[i], knots[i + 1], knots[j], knots[j + 1], out double s, out double t);
                    double along = between + (1.0 - s) * lengths[i] + t * lengths[j];
                    double cosine = Vector3d.Dot(axis, knots[j + 1] - knots[j]) / lengths[j];
                    // Around a circle of at least the tube's radius it takes more than half a circle to come so near.
                    if (squared < range * range && (cosine < Math.Cos(LargestTurn) || along > 0.5 * Math.PI * range))
                    {
                        _isIn[i] = true;
                        _isIn[j] = true;
                        _hasAny = true;
                    }
                }
            }
            for (int k = 1; k < count; k++)
            {
                Vector3d along = Vector3d.Normalize((1.0 / lengths[k - 1]) * (knots[k] - knots[k - 1])
                    + (1.0 / lengths[k]) * (knots[k + 1] - knots[k]));
                FindHidden(tree, k, knots[k], radii[k], along);
            }
        }

        // Whether another piece is deeper where the two at a knot meet, by Newton's method in planes along the tube.
        private void FindHidden(TubeTree tree, int k, in Vector3d knot, double radius, in Vector3d along)
        {
            Vector3d side = Vector3d.Normalize(Vector3d.Perpendicular(along));
            Vector3d other = Vector3d.Cross(along, side);
            for (int i = 0; i < Directions * Depths.Length; i++)
            {
                double angle = 2.0 * Math.PI * i / Directions;
                Vector3d across = Math.Cos(angle) * side + Math.Sin(angle) * other;
                double depth = Depths[i / Directions] * radius;
                Vector3d x = knot + (radius - depth) * across;
                for (int iteration = 0; iteration < Iterations; iteration++)
                {
                    double first = depth - tree.Pieces[k - 1].Distance(x, out Vector3d centre, out _);
                    Vector3d one = Vector3d.Normalize(centre - x);
                    double second = depth - tree.Pieces[k].Distance(x, out centre, out _);
                    Vector3d two = Vector3d.Normalize(centre - x);
                    double determinant = Vector3d.Dot(one, across) * Vector3d.Dot(two, along)
                        - Vector3d.Dot(one, along) * Vector3d.Dot(two, across);
                    if (!(Math.Abs(determinant) > LeastSine))
                    {
                        break;
                    }
                    if (Math.Abs(first) + Math.Abs(second) < Near * radius)
                    {
                        int deepest = tree.Deepest(x, k, out double there);
                        if (there > depth + Hidden * radius)
                        {
                            _hides[k - 1] = true;
                            _hides[k] = true;
                            _hides[deepest] = true;
                            _hidesAny = true;
                        }
                        break;
                    }
                    double outwards = first * Vector3d.Dot(two, along) - second * Vector3d.Dot(one, along);
                    double forwards = second * Vector3d.Dot(one, across) - first * Vector3d.Dot(two, across);
                    x += (outwards / determinant) * across + (forwards / determinant) * along;
                }
            }
        }

        /// <summary>Whether one of these pieces is that of a leg; of all pieces, where they are not known.</summary>
        public bool Has(FeatureRange pieces) => _hasAny && IsAny(_isIn, pieces);

        /// <summary>Whether one of them holds a crease of others, or has one that another piece holds.</summary>
        public bool Hide(FeatureRange pieces) => _hidesAny && IsAny(_hides, pieces);

        private static bool IsAny(bool[] flags, FeatureRange pieces)
        {
            for (int i = pieces.From; i < pieces.To; i++)
            {
                if (flags[pieces[i]])
                {
                    return true;
                }
            }
            return !pieces.IsKnown;
        }
    }
}
