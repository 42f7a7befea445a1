using System;

namespace Guidewire.Core
{
    /// <summary>Contact with walls as constraints with multipliers. Of the point of element j at s, with weights
    /// a_j = 1 - s and a_{j+1} = s, wall point c and normal n: C = (a_j x_j + a_{j+1} x_{j+1} - c).n - r, lambda at
    /// least 0, with compliance 1/k where a contact has a stiffness k and none where it is rigid (Macklin 2016).
    /// Coulomb friction as a second multiplier f along the wall, |f| at most mu lambda, against the slip of the wire's
    /// surface since the substep began (Macklin 2020).</summary>
    /// <remarks>Per iteration and contact, with W = a_j^2 w_j + a_{j+1}^2 w_{j+1}: dlambda = -(C + lambda/(k h^2))/(W +
    /// 1/(k h^2)), the sum held at 0 or more; then f - u/V, shortened to mu lambda, with the slip u = P (a_j (x_j -
    /// x_j0) + a_{j+1} (x_{j+1} - x_{j+1,0}) + r n x R_0 phi), P = 1 - n n^T, phi the element's turn since the substep
    /// began along its axes there. What a force f does to the surface includes the couple r f x n on the element. V = W
    /// + r^2 max(1/I) is at least as much as f moves the surface in any direction, and the same in all of them: so
    /// where the iterations have converged f is against u, which it would not be with the motion by f in its own
    /// direction alone. A slip of 0 is held by any f within the limit. The slip of a contact that the iterations leave
    /// is stored with f and added to that of the next substep, so that a sticking contact returns to where it was: no
    /// more than V mu lambda, by which a force at the limit moves it in a substep, because a contact beyond its limit
    /// slips.
    ///
    /// A rigid contact that is inside the wall, because its plane approximates the wall only near the point where it
    /// was found, is moved out by no more than its own displacement in the substep, or a fraction of the depth: all at
    /// once would be a speed of depth over h, and what moves over an edge of the wall comes out of it as fast as it
    /// moves.</remarks>
    internal sealed class CompliantContacts
    {
        private const double Recovered = 0.02;    // of a depth in a substep

        private readonly Contact[] _contacts;
        private readonly Contact[] _held;         // of held nodes
        private readonly Vector3d[] _storedImpulse;        // lambda n + f of each slot, while contacts are found anew
        private readonly Vector3d[] _storedSlip;    // the same of slips that are left, m
        private readonly double[] _friction;      // mu, by wall
        private readonly double[] _radius;        // of elements, m
        private readonly double[] _nodeRadius;
        private readonly double[] _inverseMass;
        private readonly Vector3d[] _inverseInertia;
        private readonly double _metres;          // per unit
        private readonly double _compliance;      // 1/k, m/N
        private RodShape _old;
        private double _perSquare;                // compliance/h^2
        private int _count;
        private int _heldCount;

        /// <summary>No contacts yet of a scene's wire with its walls.</summary>
        /// <param name="stiffness">k, N/m; 0 for rigid contacts.</param>
        public CompliantContacts(MaterialScene scene, NodalInertia inertia, double stiffness)
        {
            int n = scene.Rod.ElementCount;
            _friction = Array.ConvertAll(scene.Walls, wall => wall.FrictionCoefficient);
            _radius = scene.Rod.Radius;
            _nodeRadius = new double[n + 1];
            for (int j = 0; j < n; j++)
            {
                _nodeRadius[j] = Math.Max(_nodeRadius[j], _radius[j]);
                _nodeRadius[j + 1] = _radius[j];
            }
            _inverseMass = inertia.InverseMass;
            _inverseInertia = inertia.InverseInertia;
            _metres = scene.Metres;
            _compliance = stiffness > 0.0 ? 1.0 / stiffness : 0.0;
            // A search finds each node and each element at most once a wall.
            _storedImpulse = new Vector3d[scene.Walls.Length * (2 * n + 1)];
            _storedSlip = new Vector3d[_storedImpulse.Length];
            _contacts = new Contact[_storedImpulse.Length];
            _held = new Contact[2 * scene.Walls.Length];
            _old = scene.Shape;
        }

        /// <summary>Contacts at present, without those of held nodes.</summary>
        public int Count => _count;

        /// <summary>Gives contact k.</summary>
        public ref readonly Contact this[int k] => ref _contacts[k];

        /// <summary>Takes over the contacts that a search has found; multipliers stay with their node or element and
        /// wall, turned into the new normal's direction.</summary>
        public void Renew(StructList<WireContact> found)
        {
            StoreImpulses();
            _count = 0;
            _heldCount = 0;
            int n = _radius.Length;
            for (int k = 0; k < found.Count; k++)
            {
                ref readonly WireContact contact = ref found[k];
                SurfaceContact nearest = contact.Nearest;
                bool isTip = !contact.IsElement && contact.Index == n;
                int j = isTip ? n - 1 : contact.Index;
                double s = contact.IsElement ? nearest.Position : isTip ? 1.0 : 0.0;
                double inverse = (1.0 - s) * (1.0 - s) * _inverseMass[j] + s * s * _inverseMass[j + 1];
                bool isHeld = !(inverse > 0.0);
                if (isHeld && _heldCount == _held.Length)
                {
                    continue;
                }
                ref Contact to = ref (isHeld ? ref _held[_heldCount++] : ref _contacts[_count++]);
                to.Slot = contact.Wall * (2 * n + 1) + contact.Index + (contact.IsElement ? n + 1 : 0);
                to.Wall = contact.Wall;
                to.Element = j;
                to.Position = s;
                to.Node = s == 1.0 ? j + 1 : j;
                to.Normal = nearest.Normal;
                to.Offset = _metres * Vector3d.Dot(nearest.Point, nearest.Normal);
                to.Radius = contact.IsElement ? _radius[j] : _nodeRadius[contact.Index];
                to.Inverse = inverse;
                Vector3d turning = _inverseInertia[j];
                to.InverseOfSlip = inverse
                    + to.Radius * to.Radius * Math.Max(turning.X, Math.Max(turning.Y, turning.Z));
                Vector3d kept = _storedImpulse[to.Slot];
                to.NormalImpulse = Math.Max(0.0, Vector3d.Dot(kept, to.Normal));
                to.FrictionImpulse = Shortened(kept - Vector3d.Dot(kept, to.Normal) * to.Normal,
                    _friction[to.Wall] * to.NormalImpulse);
                Vector3d slip = _storedSlip[to.Slot];
                to.Slip = slip - Vector3d.Dot(slip, to.Normal) * to.Normal;
            }
            ClearStoredImpulses();
        }

        /// <summary>A substep begins; a held node that would come nearer than its radius is kept off.</summary>
        /// <param name="old">The wire where it begins; it stays so until the next.</param>
        /// <param name="shape">The wire, before the iterations, with its held nodes placed.</param>
        /// <param name="substep">h, s.</param>
        public void Begin(RodShape old, RodShape shape, double substep)
        {
            _old = old;
            for (int k = 0; k < _heldCount; k++)
            {
                ref readonly Contact contact = ref _held[k];
                double missing = contact.Radius - Distance(contact, shape);
                if (missing > 0.0)
                {
                    shape.X[contact.Node] += missing * contact.Normal;
                }
            }
            _perSquare = _compliance / (substep * substep);
            for (int k = 0; k < _count; k++)
            {
                ref Contact contact = ref _contacts[k];
                double distance = Distance(contact, old);
                contact.Clearance = contact.Radius;
                if (_compliance == 0.0 && distance < contact.Radius)
                {
                    double depth = contact.Radius - distance;
                    contact.Clearance = distance
                        + Math.Min(depth, Math.Max(Recovered * depth, DisplacementOf(contact, shape)));
                }
            }
        }

        /// <summary>Sets the multipliers to 0.</summary>
        public void Reset()
        {
            for (int k = 0; k < _count; k++)
            {
                _contacts[k].NormalImpulse = 0.0;
                _contacts[k].FrictionImpulse = Vector3d.Zero;
                _contacts[k].Slip = Vector3d.Zero;
            }
        }

        /// <summary>Writes or restores the multipliers; where they act is found again.</summary>
        public void Serialize(Snapshot snapshot)
        {
            StoreImpulses();
            snapshot.Serialize(_storedImpulse);
            snapshot.Serialize(_storedSlip);
            if (snapshot.IsWritten)
            {
                ClearStoredImpulses();
            }
            else
            {
                _count = 0;
            }
        }

        /// <summary>Adds the motion that the multipliers make in this shape.</summary>
        /// <param name="shape">The wire, not moved.</param>
        /// <param name="shift">Shift of each node, m.</param>
        /// <param name="turn">Turn of each element along its own axes.</param>
        public void AddMotion(RodShape shape, Vector3d[] shift, Vector3d[] turn)
        {
            for (int k = 0; k < _count; k++)
            {
                ref readonly Contact contact = ref _contacts[k];
                if (contact.NormalImpulse == 0.0)
                {
                    continue;
                }
                int j = contact.Element;
                Vector3d impulse = contact.NormalImpulse * contact.Normal + contact.FrictionImpulse;
                shift[j] += ((1.0 - contact.Position) * _inverseMass[j]) * impulse;
                shift[j + 1] += (contact.Position * _inverseMass[j + 1]) * impulse;
                turn[j] += Turn(contact, shape.Q[j], contact.FrictionImpulse);
            }
        }

        /// <summary>One Gauss-Seidel iteration over all contacts.</summary>
        /// <param name="shape">The wire, moved and turned in place.</param>
        public void Iterate(RodShape shape)
        {
            for (int k = 0; k < _count; k++)
            {
                ref Contact contact = ref _contacts[k];
                double impulse = NormalImpulseIn(contact, shape);
                double change = impulse - contact.NormalImpulse;
                if (impulse == 0.0 && contact.NormalImpulse == 0.0)
                {
                    continue;
                }
                int j = contact.Element;
                contact.NormalImpulse = impulse;
                shape.X[j] += ((1.0 - contact.Position) * _inverseMass[j] * change) * contact.Normal;
                shape.X[j + 1] += (contact.Position * _inverseMass[j + 1] * change) * contact.Normal;
                if (_friction[contact.Wall] > 0.0)
                {
                    Vector3d friction = FrictionImpulseIn(contact, shape);
                    Vector3d more = friction - contact.FrictionImpulse;
                    contact.FrictionImpulse = friction;
                    shape.X[j] += ((1.0 - contact.Position) * _inverseMass[j]) * more;
                    shape.X[j + 1] += (contact.Position * _inverseMass[j + 1]) * more;
                    shape.Q[j] = Quaterniond.Normalize(
                        shape.Q[j] * RotationVector.Exp(Turn(contact, shape.Q[j], more)));
                }
            }
        }

        /// <summary>A substep has come to this shape: stores the remaining slips.</summary>
        public void End(RodShape shape)
        {
            for (int k = 0; k < _count; k++)
            {
                ref Contact contact = ref _contacts[k];
                double limit = _friction[contact.Wall] * contact.NormalImpulse;
                contact.Slip = limit > 0.0 ? Shortened(SlipIn(contact, shape), contact.InverseOfSlip * limit)
                    : Vector3d.Zero;
            }
        }

        /// <summary>Takes the largest displacement, in radii, by which one more iteration would move a contact's
        /// point.</summary>
        public void AddResidual(RodShape shape, ref IterationResidual sum)
        {
            for (int k = 0; k < _count; k++)
            {
                ref readonly Contact contact = ref _contacts[k];
                double impulse = NormalImpulseIn(contact, shape);
                double displacement = contact.Inverse * Math.Abs(impulse - contact.NormalImpulse);
                if (_friction[contact.Wall] > 0.0)
                {
                    displacement = Math.Max(displacement,
                        contact.InverseOfSlip * Vector3d.Distance(FrictionImpulseIn(contact, shape),
                        contact.FrictionImpulse));
                }
                sum.Contact = Math.Max(sum.Contact, displacement / contact.Radius);
            }
        }

        /// <summary>Adds the multipliers to the nodes on which they act, lambda n + f, and along the normals to their
        /// walls, kg m.</summary>
        public void AddMultipliers(Vector3d[] nodes, Vector3d[] walls)
        {
            for (int k = 0; k < _count; k++)
            {
                ref readonly Contact contact = ref _contacts[k];
                if (contact.NormalImpulse > 0.0)
                {
                    Vector3d impulse = contact.NormalImpulse * contact.Normal;
                    walls[contact.Wall] += impulse;
                    impulse += contact.FrictionImpulse;
                    nodes[contact.Element] += (1.0 - contact.Position) * impulse;
                    nodes[contact.Element + 1] += contact.Position * impulse;
                }
            }
        }

        private void ClearStoredImpulses()
        {
            Array.Clear(_storedImpulse, 0, _storedImpulse.Length);
            Array.Clear(_storedSlip, 0, _storedSlip.Length);
        }

        private void StoreImpulses()
        {
            for (int k = 0; k < _count; k++)
            {
                _storedSlip[_contacts[k].Slot] = _contacts[k].Slip;
                _storedImpulse[_contacts[k].Slot] = _contacts[k].NormalImpulse * _contacts[k].Normal
                    + _contacts[k].FrictionImpulse;
            }
        }

        // Of the point on the axis, m.
        private static double Distance(in Contact contact, RodShape shape)
        {
            int j = contact.Element;
            return (1.0 - contact.Position) * Vector3d.Dot(shape.X[j], contact.Normal)
                + contact.Position * Vector3d.Dot(shape.X[j + 1], contact.Normal) - contact.Offset;
        }

        // Displacement of the point since the substep began, m.
        private double DisplacementOf(in Contact contact, RodShape shape)
        {
            int j = contact.Element;
            return ((1.0 - contact.Position) * (shape.X[j] - _old.X[j])
                + contact.Position * (shape.X[j + 1] - _old.X[j + 1])).Length;
        }

        // The value of lambda for this shape.
        private double NormalImpulseIn(in Contact contact, RodShape shape)
        {
            double error = Distance(contact, shape) - contact.Clearance + _perSquare * contact.NormalImpulse;
            return Math.Max(0.0, contact.NormalImpulse - error / (contact.Inverse + _perSquare));
        }

        // The value of f for this shape.
        private Vector3d FrictionImpulseIn(in Contact contact, RodShape shape)
        {
            return Shortened(contact.FrictionImpulse - (1.0 / contact.InverseOfSlip) * SlipIn(contact, shape),
                _friction[contact.Wall] * contact.NormalImpulse);
        }

        // u.
        private Vector3d SlipIn(in Contact contact, RodShape shape)
        {
            int j = contact.Element;
            double s = contact.Position;
            Vector3d n = contact.Normal;
            Vector3d turn = RotationVector.Log(_old.Q[j].Conjugate * shape.Q[j]);
            Vector3d move = (1.0 - s) * (shape.X[j] - _old.X[j]) + s * (shape.X[j + 1] - _old.X[j + 1])
                + contact.Radius * Vector3d.Cross(n, Quaterniond.Rotate(_old.Q[j], turn));
            return contact.Slip + move - Vector3d.Dot(move, n) * n;
        }

        // Turn of the element by a force along the wall, along the element's axes.
        private Vector3d Turn(in Contact contact, in Quaterniond q, in Vector3d friction)
        {
            Vector3d couple = contact.Couple(q, friction);
            Vector3d inverse = _inverseInertia[contact.Element];
            return new Vector3d(inverse.X * couple.X, inverse.Y * couple.Y, inverse.Z * couple.Z);
        }

        private static Vector3d Shortened(in Vector3d friction, double most)
        {
            double size = friction.Length;
            return size > most ? (most / size) * friction : friction;
        }

        /// <summary>A contact and its multipliers.</summary>
        internal struct Contact
        {
            /// <summary>Where its multipliers are stored while contacts are searched again.</summary>
            public int Slot;

            /// <summary>Index in the scene's list.</summary>
            public int Wall;

            /// <summary>The element j in contact.</summary>
            public int Element;

            /// <summary>The place s along the element, 0 to 1.</summary>
            public double Position;

            /// <summary>The node at s = 0 or 1.</summary>
            public int Node;

            /// <summary>The wall's normal n, towards the wire.</summary>
            public Vector3d Normal;

            /// <summary>The wall's offset c.n along the normal, m.</summary>
            public double Offset;

            /// <summary>The wire's radius r, m.</summary>
            public double Radius;

            /// <summary>Distance that the substep requires, r or less, m.</summary>
            public double Clearance;

            /// <summary>The inverse mass W along the normal, 1/kg.</summary>
            public double Inverse;

            /// <summary>The inverse mass V against slip, 1/kg.</summary>
            public double InverseOfSlip;

            /// <summary>The multiplier lambda of the normal force, kg m.</summary>
            public double NormalImpulse;

            /// <summary>The multiplier f of friction, kg m.</summary>
            public Vector3d FrictionImpulse;

            /// <summary>What the substeps before have left of the slip, m.</summary>
            public Vector3d Slip;

            /// <summary>r f x n along the axes of an element of this orientation: the couple of f, kg m^2.</summary>
            public readonly Vector3d Couple(in Quaterniond q) => Couple(q, FrictionImpulse);

            /// <summary>Gives the same for another f.</summary>
            public readonly Vector3d Couple(in Quaterniond q, in Vector3d friction) =>
                Quaterniond.Rotate(q.Conjugate, Radius * Vector3d.Cross(friction, Normal));
        }
    }

    /// <summary>The contact forces on a wire with compliance at the end of the last substep, for the search for a
    /// nearby rest shape: constant forces, each with a stiff spring along its normal.</summary>
    /// <remarks>The spring is the contact's own, or where that is rigid 10 EA/l of the stiffest element, as that on
    /// which <see cref="SupportSpring"/> holds a node. Friction is a force alone.</remarks>
    internal sealed class ContactLoads : EnergyTerm
    {
        private const double OverAxialSpring = 10.0;

        private readonly CompliantContacts _contacts;
        private readonly double _stiffness;    // N/m
        private readonly double _perSquare;    // 1/h^2

        /// <summary>Forces of these contacts.</summary>
        /// <param name="stiffness">Of a contact, N/m; 0 for rigid ones.</param>
        /// <param name="substep">h, s.</param>
        public ContactLoads(CompliantContacts contacts, MaterialRod rod, double stiffness, double substep)
        {
            _contacts = contacts;
            _perSquare = 1.0 / (substep * substep);
            _stiffness = stiffness;
            for (int j = 0; stiffness == 0.0 && j < rod.ElementCount; j++)
            {
                _stiffness = Math.Max(_stiffness, OverAxialSpring * rod.StretchStiffness[j] / rod.Length[j]);
            }
        }

        /// <summary>Says that the term stores no energy, because only its slopes count.</summary>
        public override bool StoresEnergy => false;

        /// <inheritdoc/>
        public override double Value(RodShape shape) => 0.0;

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                CompliantContacts.Contact contact = _contacts[k];
                if (contact.NormalImpulse > 0.0 && contact.Element >= from && contact.Element < to)
                {
                    Add(contact, shape, gradient);
                }
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                CompliantContacts.Contact contact = _contacts[k];
                int j = contact.Element;
                if (contact.NormalImpulse > 0.0 && j >= from && j < to)
                {
                    Add(contact, shape, gradient);
                    RodBlock.AddAt(ref blocks[j], ref blocks[j + 1], contact.Position,
                        Symmetric3.Outer(_stiffness, contact.Normal));
                }
            }
        }

        private void Add(in CompliantContacts.Contact contact, RodShape shape, RodVector[] gradient)
        {
            int j = contact.Element;
            Vector3d force = _perSquare * (contact.NormalImpulse * contact.Normal + contact.FrictionImpulse);
            gradient[j].AddX(-((1.0 - contact.Position) * force));
            gradient[j + 1].AddX(-(contact.Position * force));
            Vector3d couple = _perSquare * contact.Couple(shape.Q[j]);
            gradient[j].AddT(-couple);
        }
    }
}
