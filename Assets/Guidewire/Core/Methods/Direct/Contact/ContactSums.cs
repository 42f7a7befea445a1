using System;

namespace Guidewire.Core
{
    /// <summary>The contacts of a wire with walls in one shape: their positions, and the first and second derivatives
    /// of their energy by the nodes' positions.</summary>
    /// <remarks>An element's contact at s acts on its two nodes with weights 1 - s and s. The part of its second
    /// derivative that is proportional to its force is stored apart. Most of a long wire touches nothing and is
    /// skipped.</remarks>
    internal sealed class ContactSums
    {
        private readonly Vector3d[] _gradient;    // by node, N
        private readonly Symmetric3[] _own;       // (x_i, x_i), N/m
        private readonly Symmetric3[] _coupling;  // (x_i+1, x_i)
        private readonly Symmetric3[] _ownBending;      // what elements' contacts add by their second derivatives
        private readonly Symmetric3[] _couplingBending;
        private readonly Vector3d[] _couplingTurn;      // the same, t of the part v -> t x v
        private readonly bool[] _isTouched;       // by node: whether these are not 0
        private int _elements;
        private int _held = -1;                   // node that does not move
        private Vector3d _heldGradient;           // of it, which a vessel that gives way feels all the same
        private Symmetric3 _heldOwn;
        private Symmetric3 _heldCoupling;

        /// <summary>Of a wire of this many elements that touches none of so many walls.</summary>
        public ContactSums(int elementCount, int wallCount)
        {
            Multipliers = new ContactMultipliers(elementCount, wallCount);
            int nodes = elementCount + 1;
            _elements = elementCount;
            _gradient = new Vector3d[nodes];
            _own = new Symmetric3[nodes];
            _coupling = new Symmetric3[elementCount];
            _ownBending = new Symmetric3[nodes];
            _couplingBending = new Symmetric3[elementCount];
            _couplingTurn = new Vector3d[elementCount];
            _isTouched = new bool[nodes];
        }

        /// <summary>Wall by wall and along the wire.</summary>
        public StructList<WallContact> Contacts { get; } = new StructList<WallContact>(64);

        /// <summary>Estimates of their forces.</summary>
        public ContactMultipliers Multipliers { get; }

        /// <summary>The wire has so many elements, at most those it was made for, and touches nothing.</summary>
        public void Remesh(int elementCount)
        {
            Clear();
            Multipliers.Remesh(elementCount);
            _elements = elementCount;
        }

        /// <summary>Removes all contacts.</summary>
        public void Clear()
        {
            Multipliers.Clear();
            for (int k = 0; k < Contacts.Count; k++)
            {
                int j = Contacts[k].Element;
                for (int i = j; i <= j + 1; i++)
                {
                    _isTouched[i] = false;
                    _gradient[i] = Vector3d.Zero;
                    _own[i] = default;
                    _ownBending[i] = default;
                }
                _coupling[j] = default;
                _couplingBending[j] = default;
                _couplingTurn[j] = Vector3d.Zero;
            }
            Contacts.Clear();
            (_held, _heldGradient, _heldOwn, _heldCoupling) = (-1, Vector3d.Zero, default, default);
        }

        /// <summary>Adds a contact of node i with wall w.</summary>
        /// <param name="w">Which wall.</param>
        /// <param name="i">Which node.</param>
        /// <param name="gradient">N.</param>
        /// <param name="second">N/m.</param>
        /// <param name="bending">What the second derivative has besides, N/m.</param>
        /// <param name="gap">m.</param>
        /// <param name="barrier">Of the gap.</param>
        /// <param name="displacement">Of the wall, m.</param>
        public void AddNode(int w, int i, in Vector3d gradient, in Symmetric3 second, in Symmetric3 bending, double gap,
            in Barrier barrier, double displacement)
        {
            bool isLast = i == _elements;
            Touch(w, isLast ? i - 1 : i, isLast ? 1.0 : 0.0, -gradient, true, displacement);
            Multipliers.AddNode(w, i, -gradient, second, gap, barrier);
            _gradient[i] += gradient;
            _own[i] += second;
            _ownBending[i] += bending;
        }

        /// <summary>Gives a contact of the interior of element j with a convex edge.</summary>
        /// <param name="w">Which wall.</param>
        /// <param name="j">Which element.</param>
        /// <param name="edge">In units.</param>
        /// <param name="chord">x_j+1 - x_j, units.</param>
        /// <param name="units">Per metre.</param>
        /// <param name="value">b of the gap, J.</param>
        /// <param name="slope">b', N.</param>
        /// <param name="curvature">b'', N/m.</param>
        /// <param name="displacement">Of the wall, m.</param>
        /// <param name="map">G by node, where a wall moves; null where it stands still.</param>
        /// <returns>The sum of the gradients, N.</returns>
        public Vector3d AddEdgeContact(int w, int j, in EdgeContact edge, in Vector3d chord, double units, double value,
            double slope, double curvature, double displacement, Matrix3[]? map = null)
        {
            double s = edge.Position;
            if (map != null)
            {
                var others = new PairSums(this, j);
                PairSums.Clear(this, j);
                AddEdgeContact(w, j, edge, chord, units, value, slope, curvature, displacement);
                new PairSums(this, j).AddMapped(this, j, map[j], map[j + 1], others);
                Vector3d one = edge.Weight * slope * edge.Normal;
                Contacts[Contacts.Count - 1] = new WallContact(w, j, s, -(1.0 - s) * map[j].TransposeTimes(one)
                    - s * map[j + 1].TransposeTimes(one), false, displacement);
                return _gradient[j] - others.First + (_gradient[j + 1] - others.Second);
            }
            double r = 1.0 - s;
            Vector3d force = (edge.Weight * slope) * edge.Normal;
            Vector3d first = r * force + (value * units) * edge.WeightAlongA;
            Vector3d second = s * force + (value * units) * edge.WeightAlongB;
            Touch(w, j, s, -force, false, displacement);
            _gradient[j] += first;
            _gradient[j + 1] += second;
            double stiffness = edge.Weight * curvature;
            _own[j] += Symmetric3.Outer(stiffness * r * r, edge.Normal);
            _own[j + 1] += Symmetric3.Outer(stiffness * s * s, edge.Normal);
            _coupling[j] += Symmetric3.Outer(stiffness * r * s, edge.Normal);
            AddBending(j, edge, chord, units * edge.Weight * slope);
            AddPairs(j, units * slope, r * edge.Normal, s * edge.Normal, edge.WeightAlongA, edge.WeightAlongB);
            return first + second;
        }

        /// <summary>All edge contacts of element j with wall w have been added.</summary>
        /// <param name="w">Which wall.</param>
        /// <param name="j">Which element.</param>
        /// <param name="first">Index of the first of them.</param>
        /// <param name="stiffness">The sum of their b'', N/m.</param>
        /// <param name="gap">The least of their gaps, m.</param>
        /// <param name="barrier">Of the gaps, but for how stiff it is.</param>
        public void EndElement(int w, int j, int first, double stiffness, double gap, in Barrier barrier)
        {
            Vector3d force = Vector3d.Zero;
            double moment = 0.0;
            double sum = 0.0;
            for (int k = first; k < Contacts.Count; k++)
            {
                ref WallContact contact = ref Contacts[k];
                force += contact.Force * contact.Normal;
                moment += contact.Force * contact.Position;
                sum += contact.Force;
            }
            if (force != Vector3d.Zero)
            {
                Multipliers.AddElement(w, j, moment / sum, force, stiffness, gap, barrier);
            }
        }

        /// <summary>Node i, which begins the first element that touches anything, does not move as walls see it.
        /// </summary>
        public void Hold(int i)
        {
            _held = i;
            _heldGradient += _gradient[i];
            _heldOwn += _own[i];
            _heldCoupling += _coupling[i];
            _gradient[i] = Vector3d.Zero;
            _own[i] = default;
            _ownBending[i] = default;
            _coupling[i] = default;
            _couplingBending[i] = default;
            _couplingTurn[i] = Vector3d.Zero;
            Multipliers.Hold(i);
        }

        /// <summary>Adds the first derivatives of nodes from one (inclusive) to another (exclusive).</summary>
        public void AddGradient(RodVector[] gradient, int from, int to, ref GradientMeasures measured)
        {
            int end = Math.Min(to, _elements + 1);
            double largest = 0.0;
            for (int i = from; i < end; i++)
            {
                if (!_isTouched[i])
                {
                    continue;
                }
                largest = Math.Max(largest, _gradient[i].LengthSquared);
                gradient[i].AddX(_gradient[i]);
            }
            measured.IncludeForce(Math.Sqrt(largest));
        }

        /// <summary>Adds the second derivatives of nodes from one (inclusive) to another (exclusive), with or without
        /// the part proportional to the forces of elements' contacts.</summary>
        public void AddBlocks(RodBlock[] blocks, int from, int to, bool hasBending)
        {
            int end = Math.Min(to, _elements + 1);
            bool hasEstimates = Multipliers.HasEstimates;
            for (int i = from; i < end; i++)
            {
                if (!_isTouched[i])
                {
                    continue;
                }
                ref RodBlock b = ref blocks[i];
                Symmetric3 a = hasBending ? _own[i] + _ownBending[i] : _own[i];
                a = hasEstimates ? a + Multipliers.OwnOf(i) : a;
                b.A11 += a.A11; b.A21 += a.A21; b.A22 += a.A22;
                b.A31 += a.A31; b.A32 += a.A32; b.A33 += a.A33;
                if (i < _elements)
                {
                    Symmetric3 d = hasBending ? _coupling[i] + _couplingBending[i] : _coupling[i];
                    d = hasEstimates ? d + Multipliers.CouplingOf(i) : d;
                    Vector3d t = hasBending ? _couplingTurn[i] : Vector3d.Zero;
                    b.D11 += d.A11; b.D12 += d.A21 - t.Z; b.D13 += d.A31 + t.Y;
                    b.D21 += d.A21 + t.Z; b.D22 += d.A22; b.D23 += d.A32 - t.X;
                    b.D31 += d.A31 - t.Y; b.D32 += d.A32 + t.X; b.D33 += d.A33;
                }
            }
        }

        /// <summary>Adds the derivatives by the splines of a vessel that gives way: each touched node is displaced
        /// against it by dx - W dq.</summary>
        /// <param name="weights">W by touched node.</param>
        public void AddVesselGradient(RodVector[] gradient, int start, BeamWeight[] weights)
        {
            for (int i = 0; i <= _elements; i++)
            {
                if (_isTouched[i])
                {
                    weights[i].AddTo(gradient, start, -(i == _held ? _heldGradient : _gradient[i]));
                }
            }
        }

        /// <summary>Adds the second derivatives by these splines.</summary>
        /// <param name="weights">W by touched node.</param>
        /// <param name="units">Per metre; 0: without what turning sections add.</param>
        public void AddBorder(LowRank columns, BeamWeight[] weights, bool hasBending, double units)
        {
            bool hasEstimates = Multipliers.HasEstimates;
            for (int i = 0; i <= _elements; i++)
            {
                if (!_isTouched[i])
                {
                    continue;
                }
                bool isHeld = i == _held;
                Symmetric3 own = isHeld ? _heldOwn : hasBending ? _own[i] + _ownBending[i] : _own[i];
                own = hasEstimates ? own + Multipliers.OwnOf(i) : own;
                weights[i].AddBorder(columns, isHeld ? -1 : i, weights[i], isHeld ? -1 : i, Matrix3.Of(own), false);
                if (hasBending && units > 0.0)
                {
                    weights[i].AddTurning(columns, isHeld ? -1 : i, isHeld ? _heldGradient : _gradient[i], units);
                }
                if (i == _elements || !_isTouched[i + 1])
                {
                    continue;
                }
                Symmetric3 next = isHeld ? _heldCoupling : hasBending ? _coupling[i] + _couplingBending[i]
                    : _coupling[i];
                next = hasEstimates ? next + Multipliers.CouplingOf(i) : next;
                weights[i + 1].AddBorder(columns, i + 1, weights[i], isHeld ? -1 : i,
                    Matrix3.Of(next, isHeld || !hasBending ? Vector3d.Zero : _couplingTurn[i]), true);
            }
        }

        /// <summary>Whether a contact acts on node i.</summary>
        public bool IsTouched(int i) => _isTouched[i];

        private void Touch(int w, int j, double position, in Vector3d force, bool isNode, double displacement)
        {
            Contacts.Add(new WallContact(w, j, position, force, isNode, displacement));
            _isTouched[j] = true;
            _isTouched[j + 1] = true;
        }

        // The force of an edge contact times the second derivative of its distance.
        private void AddBending(int j, in EdgeContact edge, in Vector3d chord, double force)
        {
            double s = edge.Position;
            double r = 1.0 - s;
            Symmetric3 h = edge.Curvature;
            _ownBending[j] += (force * r * r) * h;
            _ownBending[j + 1] += (force * s * s) * h;
            _couplingBending[j] += (force * r * s) * h;
            Vector3d hu = h.Times(chord);
            double half = 0.5 * Vector3d.Dot(chord, hu);
            AddPairs(j, force, r * hu - edge.Normal + half * edge.SlideAlongA,
                s * hu + edge.Normal + half * edge.SlideAlongB, edge.SlideAlongA, edge.SlideAlongB);
        }

        // weight (c d^T + d c^T) of vectors over both nodes of an element.
        private void AddPairs(int j, double weight, in Vector3d c, in Vector3d cNext, in Vector3d d, in Vector3d dNext)
        {
            _ownBending[j] += Symmetric3.Pair(weight, c, d);
            _ownBending[j + 1] += Symmetric3.Pair(weight, cNext, dNext);
            _couplingBending[j] += Symmetric3.Pair(0.5 * weight, cNext, d) + Symmetric3.Pair(0.5 * weight, dNext, c);
            _couplingTurn[j] -= (0.5 * weight) * (Vector3d.Cross(cNext, d) + Vector3d.Cross(dNext, c));
        }

        /// <summary>The sums of the two nodes of an element and between them.</summary>
        private readonly struct PairSums
        {
            public readonly Vector3d First;     // gradients
            public readonly Vector3d Second;
            private readonly Symmetric3 _ownFirst;
            private readonly Symmetric3 _ownSecond;
            private readonly Symmetric3 _bendingFirst;
            private readonly Symmetric3 _bendingSecond;
            private readonly Symmetric3 _coupling;
            private readonly Symmetric3 _couplingBending;
            private readonly Vector3d _turn;

            public PairSums(ContactSums of, int j)
            {
                (First, Second) = (of._gradient[j], of._gradient[j + 1]);
                (_ownFirst, _ownSecond) = (of._own[j], of._own[j + 1]);
                (_bendingFirst, _bendingSecond) = (of._ownBending[j], of._ownBending[j + 1]);
                (_coupling, _couplingBending, _turn) = (of._coupling[j], of._couplingBending[j], of._couplingTurn[j]);
            }

            public static void Clear(ContactSums of, int j) => default(PairSums).Set(of, j);

            /// <summary>Adds others to these as they are in space: G^T g, G^T H G.</summary>
            public void AddMapped(ContactSums of, int j, in Matrix3 first, in Matrix3 second, in PairSums others)
            {
                Vector3d turn = Vector3d.Zero;
                Symmetric3 coupling = second.Congruent(_coupling, first, ref turn);
                Vector3d bending = _turn;
                Symmetric3 couplingBending = second.Congruent(_couplingBending, first, ref bending);
                of._gradient[j] = others.First + first.TransposeTimes(First);
                of._gradient[j + 1] = others.Second + second.TransposeTimes(Second);
                of._own[j] = others._ownFirst + first.Congruent(_ownFirst);
                of._own[j + 1] = others._ownSecond + second.Congruent(_ownSecond);
                of._ownBending[j] = others._bendingFirst + first.Congruent(_bendingFirst);
                of._ownBending[j + 1] = others._bendingSecond + second.Congruent(_bendingSecond);
                of._coupling[j] = others._coupling + coupling;
                of._couplingBending[j] = others._couplingBending + couplingBending;
                of._couplingTurn[j] = others._turn + turn + bending;
            }

            private void Set(ContactSums of, int j)
            {
                (of._gradient[j], of._gradient[j + 1]) = (First, Second);
                (of._own[j], of._own[j + 1]) = (_ownFirst, _ownSecond);
                (of._ownBending[j], of._ownBending[j + 1]) = (_bendingFirst, _bendingSecond);
                (of._coupling[j], of._couplingBending[j], of._couplingTurn[j]) = (_coupling, _couplingBending, _turn);
            }
        }
    }
}
