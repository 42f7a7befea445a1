using System;

namespace Guidewire.Core
{
    /// <summary>The stiffness of contacts in Newton's method from estimates of their forces, the multipliers of
    /// primal-dual interior point methods (S. Wright 1997, Primal-Dual Interior-Point Methods): that of the chord from
    /// the gap as it is to the gap at which the barrier's force is the estimate.</summary>
    /// <remarks>The second derivative of a barrier is true at one gap only. Where a gap came out too small, its force
    /// is too large and so is its stiffness, and a Newton step no more than doubles the gap; where it came out too
    /// large, a step would close it altogether. The force with which the linear model of the last step ended is much
    /// nearer to that of the solution than the force at the new gap is. Gradients are not changed, so neither is the
    /// solution.
    ///
    /// All contacts of a node with a wall count as one, and so do those of an element: with the sum of their forces,
    /// at the least of their gaps.</remarks>
    internal sealed class ContactMultipliers
    {
        private int _nodes;
        private readonly StructList<Contact> _contacts = new StructList<Contact>(64);    // of the current shape
        private readonly double[] _estimate;      // N, by wall and node, then element; NaN where there is none
        private readonly StructList<int> _estimated = new StructList<int>(64);    // where there is one
        private readonly Symmetric3[] _own;       // what (x_i, x_i) has besides the second derivative, N/m
        private readonly Symmetric3[] _coupling;  // (x_i+1, x_i)
        private int _held = -1;                   // the node that does not move as walls see it

        /// <summary>Of a wire of this many elements between this many walls.</summary>
        public ContactMultipliers(int elementCount, int wallCount)
        {
            _nodes = elementCount + 1;
            _estimate = new double[wallCount * (_nodes + elementCount)];
            _own = new Symmetric3[_nodes];
            _coupling = new Symmetric3[elementCount];
            Array.Fill(_estimate, double.NaN);
        }

        /// <summary>The wire has so many elements, at most those it was made for, and touches nothing.</summary>
        public void Remesh(int elementCount)
        {
            Forget();
            Clear();
            _nodes = elementCount + 1;
        }

        /// <summary>Whether second derivatives are changed: not where nothing is estimated.</summary>
        public bool HasEstimates => _estimated.Count > 0;

        /// <summary>What the second derivative by node i changes by, N/m.</summary>
        public ref readonly Symmetric3 OwnOf(int i) => ref _own[i];

        /// <summary>Gives that by nodes j + 1 and j, N/m.</summary>
        public ref readonly Symmetric3 CouplingOf(int j) => ref _coupling[j];

        /// <summary>Removes all contacts, but not the estimates.</summary>
        public void Clear()
        {
            if (HasEstimates)
            {
                Restore();
            }
            _contacts.Clear();
            _held = -1;
        }

        /// <summary>Removes the estimates: contacts have their second derivatives.</summary>
        public void Forget()
        {
            if (HasEstimates)
            {
                Restore();
                ForgetEstimates();
            }
        }

        /// <summary>Adds the contact of node i with a wall.</summary>
        /// <param name="w">Which wall.</param>
        /// <param name="i">Which node.</param>
        /// <param name="force">On the wire, N.</param>
        /// <param name="stiffness">By its second derivative, N/m.</param>
        /// <param name="gap">m.</param>
        /// <param name="barrier">Of the gap, but for how stiff it is.</param>
        public void AddNode(int w, int i, in Vector3d force, in Symmetric3 stiffness, double gap, in Barrier barrier)
        {
            bool isLast = i == _nodes - 1;
            double size = force.Length;
            if (size > 0.0)    // not too small for its square
            {
                Vector3d normal = (1.0 / size) * force;
                Add(w * (2 * _nodes - 1) + i, isLast ? i - 1 : i, isLast ? 1.0 : 0.0, size, normal,
                    Vector3d.Dot(normal, stiffness.Times(normal)), gap, barrier);
            }
        }

        /// <summary>Adds the contact of the interior of element j, at s, with a wall.</summary>
        public void AddElement(int w, int j, double s, in Vector3d force, double stiffness, double gap,
            in Barrier barrier)
        {
            double size = force.Length;
            if (size > 0.0)
            {
                Add(w * (2 * _nodes - 1) + _nodes + j, j, s, size, (1.0 / size) * force, stiffness, gap,
                    barrier);
            }
        }

        /// <summary>Node i does not move as walls see it.</summary>
        public void Hold(int i)
        {
            _held = i;
            _own[i] = default;
            _coupling[i] = default;
        }

        /// <summary>Estimates the forces after a step from the current shape, in which nodes move so far, m.</summary>
        public void Estimate(RodVector[] direction)
        {
            ForgetEstimates();
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref Contact contact = ref _contacts[k];
                _estimated.Add(contact.Key);
                _estimate[contact.Key] = contact.Force
                    - contact.Stiffness * Vector3d.Dot(contact.Normal, MoveOf(direction, contact));
            }
        }

        private void Add(int key, int j, double s, double force, in Vector3d normal, double tangent, double gap,
            in Barrier barrier)
        {
            double stiffness = tangent;
            double estimate = _estimate[key];
            if (!double.IsNaN(estimate))
            {
                stiffness *= barrier.ChordStiffness(gap, estimate / force);
                double added = stiffness - tangent;
                double r = 1.0 - s;
                _own[j] += Symmetric3.Outer(added * r * r, normal);
                _own[j + 1] += Symmetric3.Outer(added * s * s, normal);
                _coupling[j] += Symmetric3.Outer(added * r * s, normal);
            }
            _contacts.Add(new Contact
            {
                Key = key,
                Element = j,
                Position = s,
                Normal = normal,
                Force = force,
                Tangent = tangent,
                Stiffness = stiffness,
            });
        }

        // Every contact has its second derivative.
        private void Restore()
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref Contact contact = ref _contacts[k];
                int j = contact.Element;
                contact.Stiffness = contact.Tangent;
                _own[j] = default;
                _own[j + 1] = default;
                _coupling[j] = default;
            }
        }

        private void ForgetEstimates()
        {
            for (int k = 0; k < _estimated.Count; k++)
            {
                _estimate[_estimated[k]] = double.NaN;
            }
            _estimated.Clear();
        }

        private Vector3d MoveOf(RodVector[] direction, in Contact contact)
        {
            int j = contact.Element;
            return (1.0 - contact.Position) * MoveOf(direction, j) + contact.Position * MoveOf(direction, j + 1);
        }

        private Vector3d MoveOf(RodVector[] direction, int i) => i == _held ? Vector3d.Zero : direction[i].X;

        private struct Contact
        {
            public int Key;
            public int Element;
            public double Position;
            public Vector3d Normal;      // of the force
            public double Force;         // N
            public double Tangent;       // by its second derivative, N/m
            public double Stiffness;     // by the estimate
        }
    }

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

        /// <summary>Makes the motion of a wire whose places and gaps are kept elsewhere.</summary>
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
