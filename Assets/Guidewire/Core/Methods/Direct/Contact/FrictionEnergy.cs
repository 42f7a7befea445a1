using System;

namespace Guidewire.Core
{
    /// <summary>Friction at one contact point in the current step: on element j at s; its normal force, and its elastic
    /// displacement at the start of the step.</summary>
    internal struct FrictionContact
    {
        /// <summary>The index of the anchor.</summary>
        public int Index;

        /// <summary>The element j.</summary>
        public int Element;

        /// <summary>The position s along it.</summary>
        public double Position;

        /// <summary>The wall's normal n.</summary>
        public Vector3d Normal;

        /// <summary>The limit mu N of the friction force.</summary>
        public double Limit;

        /// <summary>The tangential stiffness k, N/m.</summary>
        public double Stiffness;

        /// <summary>d at the step's start, m, along the wall.</summary>
        public Vector3d Start;

        /// <summary>Where the element's nodes were at the step's start, carried with the wall since, m.</summary>
        public (Vector3d First, Vector3d Second) From;

        /// <summary>The element's frame at the step's start, turned with the wall since.</summary>
        public Quaterniond Frame;

        /// <summary>How a vessel that gives way moves these nodes' places on it, by the index of the contact.</summary>
        public int Order;
    }

    /// <summary>Coulomb friction on walls, elastic before it slips, as an energy over one step: at each contact the
    /// wire's surface is displaced from its anchor on the wall by z = d + u, d the elastic displacement kept from the
    /// steps before, u the slip along the wall since the step's start. The energy is k z^2/2 up to the limit
    /// k |z| = mu N, and beyond it mu N |z| - (mu N)^2/(2 k): its slope is the force, k z and then mu N against the
    /// displacement.</summary>
    /// <remarks>At the end of an accepted step the anchor follows what is beyond the limit (return mapping; Simo and
    /// Hughes, Computational Inelasticity, 1998; in contact Wriggers, Computational Contact Mechanics, 2006): d is
    /// force/k, no longer than mu N/k. What sticks is held by its force without slipping, and does not creep. The heat
    /// of the step is mu N (|z| - mu N/k). k = mu N/s with s the elastic slip that is allowed, N the largest normal
    /// force since the contact began: a normal force that rises or falls leaves the force of a sticking contact
    /// unchanged, and energy is only lost.
    ///
    /// Normal forces N and normals n are lagged: those of the shape last given to <see cref="Lag"/>. Contacts of one
    /// element with several edges of a wall share one anchor in proportion to their normal forces. The surface of
    /// element j at s slips by u = P ((1 - s) (x_j - x_j0) + s (x_j+1 - x_j+1,0) + r n x R_0 phi), P = 1 - n n^T, phi
    /// the turn of the element since the step's start along its axes there: an element that turns about its own axis
    /// has friction too, and takes a couple. Where a vessel gives way the places on it go along: x_j0 moves by
    /// V (q - q_0), with V and q_0 of the shape last given to <see cref="Lag"/>. With u' = W theta,
    /// W = r [n] R_0 J^-1(phi), the second derivative leaves out that of phi, of order |phi|.</remarks>
    internal sealed class FrictionEnergy : EnergyTerm
    {
        private const double OfRadius = 1e-2;

        private readonly BarrierEnergy _barrier;
        private readonly StructList<FrictionContact> _contacts = new StructList<FrictionContact>(64);
        private readonly double[] _limitSum;          // sum of the limits by anchor, N
        private readonly Vector3d[] _start;       // x_0, m
        private readonly Quaterniond[] _frames;   // q_0
        private readonly Vector3d[]?[] _onWall;   // of moving walls: where they saw the nodes at the start, units
        private readonly Quaterniond[]?[] _wallTurn;   // turn of these walls at the elements at the start
        private readonly double[] _coefficient;   // of elements with one of their own on all walls; else NaN
        private readonly StructList<(BeamWeight First, BeamWeight Second)> _ofVessel =
            new StructList<(BeamWeight, BeamWeight)>(1);
        private readonly Vector3d[] _vessel;      // q_0, m
        private int _elements;

        /// <summary>Friction at the contacts of a barrier.</summary>
        /// <param name="elasticSlip">s, m.</param>
        /// <param name="capacity">The most elements that there will be.</param>
        public FrictionEnergy(BarrierEnergy barrier, int elementCount, double elasticSlip, int capacity = 0)
        {
            capacity = Math.Max(elementCount, capacity);
            _elements = elementCount;
            _barrier = barrier;
            ElasticSlip = elasticSlip;
            _start = new Vector3d[capacity + 1];
            _frames = new Quaterniond[capacity];
            Array.Fill(_frames, Quaterniond.Identity);
            _onWall = Array.ConvertAll(barrier.Fields.Of, field => field == null ? null : new Vector3d[capacity + 1]);
            _wallTurn = Array.ConvertAll(barrier.Fields.Of, field => field == null ? null : new Quaterniond[capacity]);
            _coefficient = new double[capacity];
            Array.Fill(_coefficient, double.NaN);
            Anchors = new FrictionAnchors(barrier.Walls.Length, elementCount, capacity);
            _limitSum = new double[barrier.Walls.Length * (2 * capacity + 1)];
            _vessel = new Vector3d[barrier.Fields.Beam?.Count ?? 0];
        }

        /// <summary>The wire has so many elements, at most those it was made for, and touches nothing.</summary>
        public void Remesh(int elementCount)
        {
            _elements = elementCount;
            Array.Fill(_frames, Quaterniond.Identity);
            Array.Clear(_start, 0, _start.Length);
            _contacts.Clear();
            _ofVessel.Clear();
            Array.Clear(_limitSum, 0, _limitSum.Length);
            Array.Fill(_coefficient, double.NaN);
        }

        /// <summary>s, m.</summary>
        public double ElasticSlip { get; set; }

        /// <summary>Elements from one up to another are an instrument's with a coefficient of its own on all
        /// walls.</summary>
        /// <param name="coefficient">NaN: those of the walls.</param>
        public void SetCoefficient(int from, int to, double coefficient) =>
            Array.Fill(_coefficient, coefficient, from, to - from);

        /// <summary>s by rule, m: a hundredth of the thinnest element's radius, by which a surface turns about the
        /// wire's axis by 0.01 rad.</summary>
        public static double ElasticSlipOf(MaterialRod rod)
        {
            double thinnest = double.PositiveInfinity;
            for (int j = 0; j < rod.ElementCount; j++)
            {
                thinnest = Math.Min(thinnest, rod.Radius[j]);
            }
            return OfRadius * thinnest;
        }

        /// <summary>The state between steps.</summary>
        public FrictionAnchors Anchors { get; }

        /// <summary>Its slope is a force; its value over a step holds the heat too. What contacts store is
        /// <see cref="FrictionAnchors.StoredEnergy"/>.</summary>
        public override bool StoresEnergy => false;

        /// <inheritdoc/>
        public override void BeginStep(RodShape shape, double dt)
        {
            Array.Copy(shape.X, _start, _elements + 1);
            Array.Copy(shape.Q, _frames, _elements);
            Array.Copy(shape.Vessel, _vessel, _vessel.Length);
            for (int w = 0; w < _onWall.Length; w++)
            {
                if (_onWall[w] is Vector3d[] nodes)
                {
                    Array.Copy(_barrier.ImagesOf(shape, w), nodes, _elements + 1);
                    for (int j = 0; j < _elements; j++)
                    {
                        _wallTurn[w]![j] = TurnOfWall(w, 0.5 * (shape.X[j] + shape.X[j + 1]));
                    }
                }
            }
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref FrictionContact contact = ref _contacts[k];
                contact.From = (_start[contact.Element], _start[contact.Element + 1]);
                contact.Frame = _frames[contact.Element];
            }
        }

        private Quaterniond TurnOfWall(int w, in Vector3d x) =>
            _barrier.Fields.Of[w]!.TurnAt(_barrier.UnitsPerMetre * x);

        // Since the step's start, at element j; where its nodes were is carried along.
        private Quaterniond Carry(int w, int j, ref FrictionContact contact)
        {
            contact.From = (_start[j], _start[j + 1]);
            contact.Frame = _frames[j];
            if (!(_barrier.Fields.Of[w] is WallField field))
            {
                return Quaterniond.Identity;
            }
            double metres = 1.0 / _barrier.UnitsPerMetre;
            contact.From = (metres * field.Moved(_onWall[w]![j]), metres * field.Moved(_onWall[w]![j + 1]));
            Quaterniond turn = TurnOfWall(w, 0.5 * (contact.From.First + contact.From.Second))
                * _wallTurn[w]![j].Conjugate;
            contact.Frame = turn * contact.Frame;
            return turn;
        }

        /// <summary>Takes over normal forces and normals from a shape.</summary>
        public void Lag(RodShape shape)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                _limitSum[_contacts[k].Index] = 0.0;
            }
            _contacts.Clear();
            _ofVessel.Clear();
            Array.Copy(shape.Vessel, _vessel, _vessel.Length);
            StructList<WallContact> contacts = _barrier.ContactsOf(shape);
            for (int k = 0; k < contacts.Count; k++)
            {
                ref WallContact contact = ref contacts[k];
                double limit = CoefficientOf(contact) * contact.Force;
                if (limit > 0.0)
                {
                    int index = Anchors.IndexOf(contact);
                    _limitSum[index] += limit;
                    var sliding = new FrictionContact
                    {
                        Index = index, Element = contact.Element, Position = contact.Position,
                        Normal = contact.Normal, Limit = limit, Order = _ofVessel.Count,
                    };
                    if (_vessel.Length > 0)
                    {
                        Vector3d[] onWall = _onWall[contact.Wall]!;
                        WallField field = _barrier.Fields.Of[contact.Wall]!;
                        _ofVessel.Add((field.WeightAt(onWall[contact.Element]),
                            field.WeightAt(onWall[contact.Element + 1])));
                    }
                    Quaterniond turn = Carry(contact.Wall, contact.Element, ref sliding);
                    sliding.Start = turn == Quaterniond.Identity ? Anchors[index].Force
                        : Quaterniond.Rotate(turn, Anchors[index].Force);
                    _contacts.Add(sliding);
                }
            }
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref FrictionContact contact = ref _contacts[k];
                ref FrictionAnchors.Anchor anchor = ref Anchors[contact.Index];
                double limitSum = _limitSum[contact.Index];
                double stiffness = Math.Max(anchor.Stiffness, limitSum / ElasticSlip);
                contact.Stiffness = contact.Limit / limitSum * stiffness;
                contact.Start = Turned((1.0 / stiffness) * contact.Start, contact.Normal);
            }
        }

        /// <summary>Moves the anchors to where the step has left them: the next begins in this shape.</summary>
        public override void EndStep(RodShape shape)
        {
            double lost = 0.0;
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref FrictionContact contact = ref _contacts[k];
                Vector3d z = Displacement(shape, contact, out _);
                contact.Start = Math.Min(1.0, contact.Limit / (contact.Stiffness * z.Length)) * z;
                lost += contact.Limit * Math.Max(0.0, z.Length - contact.Start.Length);
            }
            for (int index = 0; index < Anchors.Count; index++)
            {
                ref FrictionAnchors.Anchor anchor = ref Anchors[index];
                double limitSum = _limitSum[index];
                double stiffness = limitSum > 0.0 ? Math.Max(anchor.Stiffness, limitSum / ElasticSlip) : 0.0;
                // The energy that a stiffer contact does not store, or one that has ended.
                lost += stiffness == anchor.Stiffness || anchor.Stiffness == 0.0 ? 0.0
                    : anchor.StoredEnergy * (1.0 - (stiffness > 0.0 ? anchor.Stiffness / stiffness : 0.0));
                anchor = new FrictionAnchors.Anchor { Stiffness = stiffness };
            }
            for (int k = 0; k < _contacts.Count; k++)
            {
                Anchors[_contacts[k].Index].Force += _contacts[k].Stiffness * _contacts[k].Start;
            }
            Anchors.Dissipated += lost;
            BeginStep(shape, 0.0);
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref FrictionContact contact = ref _contacts[k];
                sum += EnergyOf(Displacement(shape, contact, out _).Length, contact.Limit, contact.Stiffness);
            }
            return sum;
        }

        /// <summary>Energy of a spring that slides at a force, J: its derivative is the smaller of k z and that
        /// force.</summary>
        /// <param name="z">Its displacement, m.</param>
        /// <param name="limit">The force at which it slides, N.</param>
        /// <param name="stiffness">k, N/m.</param>
        internal static double EnergyOf(double z, double limit, double stiffness)
        {
            double most = limit / stiffness;
            return z <= most ? 0.5 * stiffness * z * z : limit * (z - 0.5 * most);
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref FrictionContact contact = ref _contacts[k];
                if (contact.Element >= from && contact.Element < to)
                {
                    AddForce(contact, Displacement(shape, contact, out Vector3d turn), turn, gradient);
                }
            }
            AddVesselGradient(shape, gradient, to);
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref FrictionContact contact = ref _contacts[k];
                int j = contact.Element;
                if (j < from || j >= to)
                {
                    continue;
                }
                Vector3d z = Displacement(shape, contact, out Vector3d turn);
                AddForce(contact, z, turn, gradient);
                AddBlocks(contact, turn, SecondDerivative(contact, z), ref blocks[j], ref blocks[j + 1]);
            }
            AddVesselGradient(shape, gradient, to);
        }

        /// <inheritdoc/>
        public override void AddColumns(RodShape shape, LowRank columns)
        {
            for (int k = 0; k < _contacts.Count && shape.Vessel.Length > 0; k++)
            {
                ref FrictionContact contact = ref _contacts[k];
                int j = contact.Element;
                double s = contact.Position;
                double r = 1.0 - s;
                Matrix3 h = Matrix3.Of(SecondDerivative(contact, Displacement(shape, contact, out Vector3d turn)));
                BeamWeight first = _ofVessel[contact.Order].First;
                BeamWeight second = _ofVessel[contact.Order].Second;
                first.AddBorder(columns, j, first, j, (r * r) * h, false);
                second.AddBorder(columns, j + 1, second, j + 1, (s * s) * h, false);
                second.AddBorder(columns, j + 1, first, j, (r * s) * h, true);
                var turned = new Matrix3(Column(contact, turn, Vector3d.UnitX), Column(contact, turn, Vector3d.UnitY),
                    Column(contact, turn, Vector3d.UnitZ));
                Matrix3 couple = -1.0 * turned.TransposeTimes(h);
                first.AddTurn(columns, j, r * couple);
                second.AddTurn(columns, j, s * couple);
            }
        }

        private void AddVesselGradient(RodShape shape, RodVector[] gradient, int to)
        {
            for (int k = 0; k < _contacts.Count && to > _elements && shape.Vessel.Length > 0; k++)
            {
                ref FrictionContact contact = ref _contacts[k];
                Vector3d z = Displacement(shape, contact, out _);
                Vector3d force = -StiffnessAt(contact, z) * z;
                _ofVessel[contact.Order].First.AddTo(gradient, shape.VesselStart, (1.0 - contact.Position) * force);
                _ofVessel[contact.Order].Second.AddTo(gradient, shape.VesselStart, contact.Position * force);
            }
        }

        private static Symmetric3 SecondDerivative(in FrictionContact contact, in Vector3d z)
        {
            double across = StiffnessAt(contact, z);
            double along = across < contact.Stiffness ? 0.0 : across;
            Symmetric3 h = new Symmetric3(across, 0.0, across, 0.0, 0.0, across)
                + Symmetric3.Outer(-across, contact.Normal);
            return along == across ? h : h + Symmetric3.Outer(along - across, Vector3d.Normalize(z));
        }

        private double CoefficientOf(in WallContact contact)
        {
            double own = _coefficient[contact.Element];
            return double.IsNaN(own) ? _barrier.Walls[contact.Wall].FrictionCoefficient : own;
        }

        // Force over displacement, N/m.
        private static double StiffnessAt(in FrictionContact contact, in Vector3d z)
        {
            double size = z.Length;
            return contact.Stiffness * size <= contact.Limit ? contact.Stiffness : contact.Limit / size;
        }

        // A vector in the plane across a normal, of unchanged length.
        private static Vector3d Turned(in Vector3d v, in Vector3d normal)
        {
            Vector3d flat = v - Vector3d.Dot(v, normal) * normal;
            double size = flat.Length;
            return size > 0.0 ? (v.Length / size) * flat : Vector3d.Zero;
        }

        // z, and phi.
        private Vector3d Displacement(RodShape shape, in FrictionContact contact, out Vector3d turn) =>
            contact.Start + Slip(shape, contact, out turn);

        // u, and phi.
        private Vector3d Slip(RodShape shape, in FrictionContact contact, out Vector3d turn)
        {
            int j = contact.Element;
            double s = contact.Position;
            Vector3d n = contact.Normal;
            turn = RotationVector.Log(contact.Frame.Conjugate * shape.Q[j]);
            Vector3d move = (1.0 - s) * (shape.X[j] - contact.From.First) + s * (shape.X[j + 1] - contact.From.Second)
                + _barrier.RadiusOf(j) * Vector3d.Cross(n, Quaterniond.Rotate(contact.Frame, turn));
            if (_vessel.Length > 0)
            {
                move -= (1.0 - s) * _ofVessel[contact.Order].First.Move(shape.Vessel, _vessel)
                    + s * _ofVessel[contact.Order].Second.Move(shape.Vessel, _vessel);
            }
            return move - Vector3d.Dot(move, n) * n;
        }

        private void AddForce(in FrictionContact contact, in Vector3d z, in Vector3d turn, RodVector[] gradient)
        {
            int j = contact.Element;
            Vector3d force = StiffnessAt(contact, z) * z;
            gradient[j].AddX((1.0 - contact.Position) * force);
            gradient[j + 1].AddX(contact.Position * force);
            Vector3d couple = Quaterniond.Rotate(contact.Frame.Conjugate,
                _barrier.RadiusOf(j) * Vector3d.Cross(force, contact.Normal));
            couple = InverseTangent(-turn, couple);
            gradient[j].AddT(couple);
        }

        private void AddBlocks(in FrictionContact contact, in Vector3d turn, in Symmetric3 h, ref RodBlock b,
            ref RodBlock next)
        {
            double s = contact.Position;
            double r = 1.0 - s;
            RodBlock.AddAt(ref b, ref next, s, h);
            Vector3d w1 = Column(contact, turn, Vector3d.UnitX);
            Vector3d w2 = Column(contact, turn, Vector3d.UnitY);
            Vector3d w3 = Column(contact, turn, Vector3d.UnitZ);
            Vector3d h1 = h.Times(w1);
            Vector3d h2 = h.Times(w2);
            Vector3d h3 = h.Times(w3);
            b.B11 += r * h1.X; b.B12 += r * h1.Y; b.B13 += r * h1.Z;
            b.B21 += r * h2.X; b.B22 += r * h2.Y; b.B23 += r * h2.Z;
            b.B31 += r * h3.X; b.B32 += r * h3.Y; b.B33 += r * h3.Z;
            b.E11 += s * h1.X; b.E21 += s * h1.Y; b.E31 += s * h1.Z;
            b.E12 += s * h2.X; b.E22 += s * h2.Y; b.E32 += s * h2.Z;
            b.E13 += s * h3.X; b.E23 += s * h3.Y; b.E33 += s * h3.Z;
            b.C11 += Vector3d.Dot(w1, h1);
            b.C21 += Vector3d.Dot(w2, h1);
            b.C22 += Vector3d.Dot(w2, h2);
            b.C31 += Vector3d.Dot(w3, h1);
            b.C32 += Vector3d.Dot(w3, h2);
            b.C33 += Vector3d.Dot(w3, h3);
        }

        // W e.
        private Vector3d Column(in FrictionContact contact, in Vector3d turn, in Vector3d e)
        {
            int j = contact.Element;
            return _barrier.RadiusOf(j)
                * Vector3d.Cross(contact.Normal, Quaterniond.Rotate(contact.Frame, InverseTangent(turn, e)));
        }

        // J^-1(phi) v: how phi changes with a turn v along the element's own axes; the transpose with -phi.
        internal static Vector3d InverseTangent(in Vector3d turn, in Vector3d v)
        {
            Vector3d across = Vector3d.Cross(turn, v);
            return v + 0.5 * across
                + RotationVector.CotangentFactor(turn.LengthSquared) * Vector3d.Cross(turn, across);
        }
    }

    /// <summary>The state of friction between steps: by wall and node, and by wall and element that edges of the wall
    /// meet, the elastic force F along the wall, the stiffness k with which it has grown, and so the elastic
    /// displacement F/k between the wire's surface and its anchor on the wall.</summary>
    /// <remarks>Kept by what the wire consists of, not by features of a wall: these come and go as a wire moves over a
    /// mesh. A contact that has ended has k = 0.</remarks>
    internal sealed class FrictionAnchors
    {
        private readonly int _walls;
        private int _nodes;
        private Anchor[] _anchors;                // of each wall the nodes', then the elements'
        private Anchor[] _spare;                  // for those of a wire whose elements change

        /// <summary>Makes the anchors of a wire that touches nothing.</summary>
        /// <param name="capacity">The most elements that it will have.</param>
        public FrictionAnchors(int wallCount, int elementCount, int capacity = 0)
        {
            _walls = wallCount;
            _nodes = elementCount + 1;
            _anchors = new Anchor[wallCount * (2 * Math.Max(elementCount, capacity) + 1)];
            _spare = new Anchor[_anchors.Length];
        }

        /// <summary>Where anchors are kept.</summary>
        public int Count => _walls * (2 * _nodes - 1);

        /// <summary>What friction has turned into heat so far, J.</summary>
        public double Dissipated { get; set; }

        /// <summary>The anchor at an index.</summary>
        public ref Anchor this[int index] => ref _anchors[index];

        /// <summary>Energy of all elastic displacements, sum of F^2/(2 k), J.</summary>
        public double StoredEnergy
        {
            get
            {
                double sum = 0.0;
                for (int k = 0; k < Count; k++)
                {
                    sum += _anchors[k].StoredEnergy;
                }
                return sum;
            }
        }

        /// <summary>Where the anchor of a contact is kept.</summary>
        public int IndexOf(in WallContact contact)
        {
            int of = contact.IsNode ? contact.Element + (contact.Position == 1.0 ? 1 : 0) : _nodes + contact.Element;
            return contact.Wall * (2 * _nodes - 1) + of;
        }

        /// <summary>Takes over the anchors of another wire between the same walls or of this one, where nodes have
        /// come in or gone.</summary>
        /// <param name="node">What each node was in the other one, -1 where it comes in; an element was that which
        /// ended at the same node.</param>
        /// <param name="elementCount">At most those that this is made for.</param>
        public void CarryOver(FrictionAnchors other, int[] node, int elementCount)
        {
            Dissipated = other.Dissipated;
            Anchor[] was = other._anchors;
            int nodes = other._nodes;
            if (other == this)
            {
                (_anchors, _spare) = (_spare, _anchors);
            }
            _nodes = elementCount + 1;
            for (int w = 0; w < _walls; w++)
            {
                int own = w * (2 * _nodes - 1);
                int others = w * (2 * nodes - 1);
                for (int i = 0; i < _nodes; i++)
                {
                    _anchors[own + i] = node[i] >= 0 ? was[others + node[i]] : default;
                    if (i > 0)
                    {
                        _anchors[own + _nodes + i - 1] = node[i] > 0 ? was[others + nodes + node[i] - 1] : default;
                    }
                }
            }
        }

        /// <summary>Writes or restores all of it.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Dissipated = snapshot.Serialize(Dissipated);
            for (int k = 0; k < Count; k++)
            {
                snapshot.Serialize(ref _anchors[k].Force);
                snapshot.Serialize(ref _anchors[k].Stiffness);
            }
        }

        /// <summary>An elastic force along a wall.</summary>
        internal struct Anchor
        {
            /// <summary>F, of the wire on the wall, N.</summary>
            public Vector3d Force;

            /// <summary>k, N/m; 0 without contact.</summary>
            public double Stiffness;

            /// <summary>F^2/(2 k), J.</summary>
            public readonly double StoredEnergy => Stiffness > 0.0 ? 0.5 * Force.LengthSquared / Stiffness : 0.0;
        }
    }
}
