using System;

namespace Guidewire.Core
{
    /// <summary>How far a wire between walls may move along a straight path of its nodes: continuous collision
    /// detection, wall by wall, of nodes and of elements.</summary>
    internal sealed class GapMotion
    {
        private const double QuickFraction = 0.9;    // of a gap known only approximately

        private readonly WallLaw[] _laws;         // by wall
        private readonly NeighbourList _near;
        private readonly Vector3d[][] _x;         // where the nodes are, by wall, units
        private readonly Vector3d[][] _to;        // where they move to, by wall, units
        private readonly double[] _nodeGap;       // by wall and node, m
        private readonly double[] _edgeGap;       // by wall and element, m
        private readonly double _units;           // per metre
        private readonly MaterialRod _rod;

        /// <summary>Of a wire whose places and gaps are kept elsewhere.</summary>
        public GapMotion(MaterialRod rod, WallLaw[] laws, NeighbourList near,
            (Vector3d[][] Now, Vector3d[][] Next) nodes, (double[] OfNodes, double[] OfElements) gaps, double units)
        {
            _laws = laws;
            _near = near;
            (_x, _to) = nodes;
            (_nodeGap, _edgeGap) = gaps;
            _units = units;
            _rod = rod;
        }

        /// <summary>Gives the fraction of the motion, 1 or less, on which gaps stay open.</summary>
        /// <param name="longestSquared">Of the nodes' displacements, units^2.</param>
        /// <param name="minGap">Of all gaps, m.</param>
        public double MaxStep(double longestSquared, double minGap)
        {
            double sure = QuickFraction * _units * minGap;
            double fraction = 1.0;
            for (int w = 0; w < _laws.Length && !(sure > 0.0 && longestSquared < sure * sure); w++)
            {
                fraction = MaxStepAt(w, fraction);
            }
            return fraction;
        }

        // Along the wire: the given fraction or a lower one. A node has the larger clearance that its two elements
        // need, and is tested once.
        private double MaxStepAt(int w, double fraction)
        {
            WallLaw law = _laws[w];
            int n = _rod.ElementCount;
            double gapBefore = 0.0;       // of the element before, 0 where it is not tested
            double radiusBefore = 0.0;
            double leftBefore = 0.0;
            for (int j = 0; j <= n; j++)
            {
                double gap = 0.0;
                double radius = 0.0;
                double left = 0.0;
                if (j < n && IsTested(w, j, fraction, out gap))
                {
                    radius = _units * law.RadiusOf(j);
                    fraction = MaxStepOf(w, j, fraction, radius, ref gap);
                    left = law.LeftOf(j, gap);
                }
                if (_laws[w].Wall.IsSurface && (gap != 0.0 || gapBefore != 0.0))
                {
                    bool isBefore = radiusBefore + leftBefore > radius + left;
                    fraction = isBefore ? MaxStepOfNode(w, j, fraction, radiusBefore, gapBefore, leftBefore)
                        : MaxStepOfNode(w, j, fraction, radius, gap, left);
                }
                gapBefore = gap;
                radiusBefore = radius;
                leftBefore = left;
            }
            return fraction;
        }

        // Whether the wall may limit this fraction of the motion of element j, and the least gap between them that is
        // known, units.
        private bool IsTested(int w, int j, double fraction, out double gap)
        {
            int n = _rod.ElementCount;
            double motion = fraction * Math.Sqrt(
                Math.Max((_to[w][j] - _x[w][j]).LengthSquared, (_to[w][j + 1] - _x[w][j + 1]).LengthSquared));
            gap = Math.Min(Math.Min(_nodeGap[w * (n + 1) + j], _nodeGap[w * (n + 1) + j + 1]),
                _edgeGap[w * n + j]) * _units;
            double most = motion + _laws[w].MaxClearance(j);
            bool isFar = motion < QuickFraction * gap || !_near.MayBeInRange(w, j, _x[w], most);
            gap = isFar ? 0.0 : gap;
            return !isFar;
        }

        private double MaxStepOf(int w, int j, double fraction, double radius, ref double gap)
        {
            ref int hint = ref _near.HintOf(w, j);
            double free = MaxStepOf(w, j, fraction, radius, gap, hint);
            if (free == 0.0)
            {
                _laws[w].Wall.Nearest(_x[w][j], _x[w][j + 1], double.PositiveInfinity, ref hint,
                    out SurfaceContact contact);
                gap = _laws[w].Wall.UnsignedDistance(contact.Distance) - radius;
                free = MaxStepOf(w, j, fraction, radius, gap, hint);
            }
            return free;
        }

        private double MaxStepOf(int w, int j, double fraction, double radius, double gap, int hint)
        {
            double left = _laws[w].LeftOf(j, gap);
            double resolution = WallLaw.Resolution(radius, gap, left);
            return gap > 0.0 ? _laws[w].Wall.ConservativeTimeOfImpact(_x[w][j], _x[w][j + 1], _to[w][j], _to[w][j + 1],
                radius + left, resolution, hint, _near.FeaturesAlong(w, j, _x[w], _to[w], fraction), fraction) : 0.0;
        }

        private double MaxStepOfNode(int w, int i, double fraction, double radius, double gap, double left)
        {
            double distance = _units * (_laws[w].RadiusOfNode(i) + _nodeGap[w * (_rod.ElementCount + 1) + i]);
            double clearance = radius + left;
            if (fraction * Vector3d.Distance(_x[w][i], _to[w][i]) <= QuickFraction * (distance - clearance))
            {
                return fraction;
            }
            (Vector3d x, Vector3d to) = (_x[w][i], _to[w][i]);
            return gap > 0.0 ? _laws[w].Wall.ConservativeTimeOfImpact(x, x, to, to, clearance,
                WallLaw.Resolution(radius, gap, left), -1, _near.FeaturesAlongNode(w, i, _x[w], _to[w], fraction),
                fraction) : 0.0;
        }
    }
}
