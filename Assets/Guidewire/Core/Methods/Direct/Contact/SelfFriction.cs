using System;

namespace Guidewire.Core
{
    /// <summary>Coulomb friction where a wire touches itself, elastic before it slips, with the law of
    /// <see cref="FrictionEnergy"/>: between two elements, and lagged in the same way.</summary>
    /// <remarks>The surfaces slip by u = P (sum of w_i (x_i - x_i0) + r n x R_0 phi + r' n x R_0' phi'), P = 1 - n n^T,
    /// w and n those of the pair's distance, phi the turn of an element since the step's start. Displacements are kept
    /// by pair: a contact that slides on to another element begins anew, which loses at most the elastic slip, a
    /// hundredth of the radius.</remarks>
    internal sealed class SelfFriction : EnergyTerm
    {
        private readonly SelfContact _self;
        private readonly MaterialRod _rod;
        private readonly double _coefficient;
        private readonly double _elasticSlip;     // m
        private readonly StructList<Contact> _contacts = new StructList<Contact>(32);
        private StructList<Spring> _anchors = new StructList<Spring>(32);
        private StructList<Spring> _spare = new StructList<Spring>(32);
        private readonly Vector3d[] _start;       // x_0, m
        private readonly Quaterniond[] _frames;   // q_0

        /// <summary>Friction at the contacts of a wire with itself.</summary>
        /// <param name="elasticSlip">m.</param>
        public SelfFriction(SelfContact self, MaterialRod rod, double coefficient, double elasticSlip)
        {
            _self = self;
            _rod = rod;
            _coefficient = coefficient;
            _elasticSlip = elasticSlip;
            _start = new Vector3d[rod.Capacity + 1];
            _frames = new Quaterniond[rod.Capacity];
            Remesh();
        }

        /// <summary>What friction has turned into heat so far, J.</summary>
        public double Dissipated { get; private set; }

        /// <summary>Energy of all elastic displacements, J.</summary>
        public double StoredEnergy
        {
            get
            {
                double sum = 0.0;
                for (int k = 0; k < _anchors.Count; k++)
                {
                    sum += _anchors[k].StoredEnergy;
                }
                return sum;
            }
        }

        /// <summary>Its slope is a force; its value over a step holds the heat too.</summary>
        public override bool StoresEnergy => false;

        /// <inheritdoc/>
        public override void Remesh()
        {
            _contacts.Clear();
            Array.Fill(_frames, Quaterniond.Identity);
            Array.Clear(_start, 0, _start.Length);
        }

        /// <summary>Takes over what contacts keep, of a wire where nodes have come in or gone.</summary>
        /// <param name="node">What each node was there, -1 where it comes in; an element was that which ended at the
        /// same node.</param>
        public void CarryOver(SelfFriction former, int[] node, int elementCount)
        {
            Dissipated = former.Dissipated;
            StructList<Spring> was = former._anchors;
            (_anchors, _spare) = (_spare, _anchors);
            _anchors.Clear();
            for (int k = 0; k < was.Count; k++)
            {
                int first = Array.IndexOf(node, was[k].First + 1, 1, elementCount);
                int second = Array.IndexOf(node, was[k].Second + 1, 1, elementCount);
                if (first > 0 && second > 0)
                {
                    _anchors.Add(new Spring(first - 1, second - 1, was[k].Force, was[k].Stiffness));
                }
            }
        }

        /// <inheritdoc/>
        public override void BeginStep(RodShape shape, double dt)
        {
            Array.Copy(shape.X, _start, _rod.ElementCount + 1);
            Array.Copy(shape.Q, _frames, _rod.ElementCount);
        }

        /// <summary>Takes over normal forces and normals from a shape.</summary>
        public void Lag(RodShape shape)
        {
            _contacts.Clear();
            StructList<StrandContact> contacts = _self.ContactsOf(shape);
            int at = 0;
            for (int k = 0; k < contacts.Count; k++)
            {
                ref StrandContact of = ref contacts[k];
                double limit = _coefficient * of.Force;
                if (!(limit > 0.0))
                {
                    continue;
                }
                Spring anchor = AnchorOf(of, ref at);
                double stiffness = Math.Max(anchor.Stiffness, limit / _elasticSlip);
                Vector3d force = anchor.Force - Vector3d.Dot(anchor.Force, of.Pair.Normal) * of.Pair.Normal;
                double size = force.Length;
                _contacts.Add(new Contact
                {
                    Of = of,
                    Limit = limit,
                    Stiffness = stiffness,
                    Start = size > 0.0 ? (anchor.Force.Length / (size * stiffness)) * force : Vector3d.Zero,
                });
            }
        }

        /// <summary>Moves the anchors to where the step has left them: the next begins in this shape.</summary>
        public override void EndStep(RodShape shape)
        {
            double stored = StoredEnergy;
            double work = Value(shape);
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref Contact contact = ref _contacts[k];
                work -= 0.5 * contact.Stiffness * contact.Start.LengthSquared;
            }
            _anchors.Clear();
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref Contact contact = ref _contacts[k];
                Vector3d z = Displacement(shape, contact, out _, out _);
                double scale = StiffnessAt(contact, z);
                _anchors.Add(new Spring(contact.Of.First, contact.Of.Second, scale * z, contact.Stiffness));
            }
            Dissipated += stored + work - StoredEnergy;
            BeginStep(shape, 0.0);
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref Contact contact = ref _contacts[k];
                sum += FrictionEnergy.EnergyOf(Displacement(shape, contact, out _, out _).Length, contact.Limit,
                    contact.Stiffness);
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref Contact contact = ref _contacts[k];
                Vector3d z = Displacement(shape, contact, out Vector3d turn, out Vector3d otherTurn);
                Vector3d force = StiffnessAt(contact, z) * z;
                for (int end = 0; end < 4; end++)
                {
                    int i = contact.Of.NodeOf(end);
                    if (i >= from && i < to)
                    {
                        RodVector v = Along(contact, force, end, end < 2 ? turn : otherTurn);
                        gradient[i].AddX(v.X);
                        gradient[i].AddT(v.T);
                    }
                }
            }
        }

        /// <inheritdoc/>
        public override void AddColumns(RodShape shape, LowRank columns)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref Contact contact = ref _contacts[k];
                Vector3d z = Displacement(shape, contact, out Vector3d turn, out Vector3d otherTurn);
                double across = StiffnessAt(contact, z);
                Vector3d normal = contact.Of.Pair.Normal;
                Vector3d one = z.Length > 0.0 ? Vector3d.Normalize(z) : Vector3d.Perpendicular(normal);
                if (across == contact.Stiffness)
                {
                    AddColumn(columns, contact, one, turn, otherTurn, across);
                }
                AddColumn(columns, contact, Vector3d.Cross(normal, one), turn, otherTurn, across);
            }
        }

        /// <summary>Writes or restores what contacts keep from step to step.</summary>
        public void SerializeHistory(Snapshot snapshot)
        {
            Dissipated = snapshot.Serialize(Dissipated);
            long count = snapshot.Serialize(_anchors.Count);
            if (!snapshot.IsWritten)
            {
                _anchors.Clear();
            }
            for (int k = 0; k < count; k++)
            {
                Spring anchor = k < _anchors.Count ? _anchors[k] : default;
                anchor = new Spring((int)snapshot.Serialize(anchor.First), (int)snapshot.Serialize(anchor.Second),
                    snapshot.Serialize(anchor.Force), snapshot.Serialize(anchor.Stiffness));
                if (!snapshot.IsWritten)
                {
                    _anchors.Add(anchor);
                }
            }
        }

        private Spring AnchorOf(in StrandContact contact, ref int at)
        {
            while (at < _anchors.Count && (_anchors[at].First < contact.First
                || (_anchors[at].First == contact.First && _anchors[at].Second < contact.Second)))
            {
                at++;
            }
            return at < _anchors.Count && _anchors[at].First == contact.First && _anchors[at].Second == contact.Second
                ? _anchors[at] : default;
        }

        // Force over displacement, N/m.
        private static double StiffnessAt(in Contact contact, in Vector3d z)
        {
            double size = z.Length;
            return contact.Stiffness * size <= contact.Limit ? contact.Stiffness : contact.Limit / size;
        }

        // The elastic displacement at the step's start and the slip since, and the turns of both elements.
        private Vector3d Displacement(RodShape shape, in Contact contact, out Vector3d turn, out Vector3d otherTurn)
        {
            (int j, int k) = (contact.Of.First, contact.Of.Second);
            Vector3d n = contact.Of.Pair.Normal;
            turn = RotationVector.Log(_frames[j].Conjugate * shape.Q[j]);
            otherTurn = RotationVector.Log(_frames[k].Conjugate * shape.Q[k]);
            Vector3d move = Vector3d.Cross(n, _rod.Radius[j] * Quaterniond.Rotate(_frames[j], turn)
                + _rod.Radius[k] * Quaterniond.Rotate(_frames[k], otherTurn));
            for (int end = 0; end < 4; end++)
            {
                int i = contact.Of.NodeOf(end);
                move += contact.Of.Pair.Weight(end) * (shape.X[i] - _start[i]);
            }
            return contact.Start + move - Vector3d.Dot(move, n) * n;
        }

        // How a slip along a direction changes with one of the four ends, and the turn of its element where it is the
        // first of that.
        private RodVector Along(in Contact contact, in Vector3d direction, int end, in Vector3d turn)
        {
            Vector3d couple = Vector3d.Zero;
            if ((end & 1) == 0)
            {
                int j = contact.Of.NodeOf(end);
                Vector3d arm = _rod.Radius[j] * Vector3d.Cross(direction, contact.Of.Pair.Normal);
                couple = FrictionEnergy.InverseTangent(-turn, Quaterniond.Rotate(_frames[j].Conjugate, arm));
            }
            return new RodVector(contact.Of.Pair.Weight(end) * direction, couple);
        }

        private void AddColumn(LowRank columns, in Contact contact, in Vector3d direction, in Vector3d turn,
            in Vector3d otherTurn, double stiffness)
        {
            columns.Add(contact.Of.First, contact.Of.Second, Along(contact, direction, 0, turn),
                Along(contact, direction, 1, turn), Along(contact, direction, 2, otherTurn),
                Along(contact, direction, 3, otherTurn), stiffness);
        }

        // In the current step.
        private struct Contact
        {
            public StrandContact Of;
            public double Limit;        // mu N, N
            public double Stiffness;    // N/m
            public Vector3d Start;      // the elastic displacement at the step's start, m
        }

        private readonly struct Spring
        {
            public readonly int First;
            public readonly int Second;
            public readonly Vector3d Force;      // N
            public readonly double Stiffness;    // N/m

            public Spring(int first, int second, in Vector3d force, double stiffness)
            {
                First = first;
                Second = second;
                Force = force;
                Stiffness = stiffness;
            }

            public double StoredEnergy => Stiffness > 0.0 ? 0.5 * Force.LengthSquared / Stiffness : 0.0;
        }
    }
}
