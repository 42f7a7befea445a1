using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>The effect of contacts on the wire in the iterations of a solver. One implementation per contact rule,
    /// chosen once.</summary>
    internal interface IContactResponse
    {
        /// <summary>Forgets all contacts and takes over those of a search.</summary>
        /// <param name="found">The search, after its update.</param>
        /// <param name="from">Where the motion that it searched begins, n + 1 positions in units, which stay as they
        /// are until the next start.</param>
        /// <param name="x">Where it searched: the n + 1 predicted positions in units.</param>
        void Start(IContactSearch found, Vector3d[] from, Vector3d[] x);

        /// <summary>Holds spheres and elements off the points of impact of the swept test.</summary>
        void Stop(StructList<WireContact> impacts);

        /// <summary>Projects all contacts once.</summary>
        /// <param name="x">n + 1 positions in units, corrected in place.</param>
        void Iterate(Vector3d[] x);

        /// <summary>Projects the stops of the swept test once, and nothing else.</summary>
        void IterateStops(Vector3d[] x);

        /// <summary>Contacts at present, in the order of an iteration.</summary>
        int ContactCount { get; }

        /// <summary>Which spheres contact k moves: one, or the two of an element.</summary>
        void SpheresOf(int k, out int first, out int last);

        /// <summary>Projects contact k once, by its spheres alone; false where it moved nothing.</summary>
        bool Project(int k, Vector3d[] x);

        /// <summary>Adds the momentum over dt, in mass unit * unit, that contacts gave each sphere.</summary>
        void AddImpulses(Vector3d[] impulses);
    }

    /// <summary>Contact of spheres and of rod elements by the lever rule, with hard stops where the swept test met a
    /// wall; see <see cref="ContactConstraint"/>. With friction, see <see cref="WallFriction"/>.</summary>
    internal sealed class ContactResponse : IContactResponse
    {
        private const int ContactsPerSphere = 8;
        private readonly double _clearance;
        private readonly double _gain;
        private readonly double _stop;    // clearance of a stop between core line and wall, units
        private readonly double[] _friction;    // mu, per wall
        private readonly ContactConstraint _spheres;
        private readonly ContactConstraint _elements;
        private readonly ContactConstraint _sphereStops;
        private readonly ContactConstraint _elementStops;
        private readonly ContactConstraint[] _all;    // in the order of an iteration

        /// <param name="state">The wire, with its final masses.</param>
        /// <param name="walls">Walls of the scene.</param>
        /// <param name="radius">r in units.</param>
        /// <param name="clearance">r + margin in units: the clearance of contacts.</param>
        /// <param name="gain">k_C in [0, 1], per iteration.</param>
        /// <param name="iterations">m of a solve.</param>
        public ContactResponse(RodState state, ContactShape[] walls, double radius, double clearance, double gain,
            int iterations)
        {
            int capacity = ContactsPerSphere * walls.Length * state.SphereCount;
            _friction = Array.ConvertAll(walls, wall => wall.FrictionCoefficient);
            _clearance = clearance;
            _gain = gain;
            _stop = 2.0 * SweptSearch.ClearanceFor(radius);
            _spheres = new ContactConstraint(state, capacity, iterations);
            _elements = new ContactConstraint(state, capacity, iterations);
            _sphereStops = new ContactConstraint(state, capacity, iterations);
            _elementStops = new ContactConstraint(state, capacity, iterations);
            _all = new[] { _spheres, _elements, _elementStops, _sphereStops };
        }

        /// <inheritdoc/>
        public int ContactCount => _spheres.Count + _elements.Count + _elementStops.Count + _sphereStops.Count;

        /// <inheritdoc/>
        public void Start(IContactSearch found, Vector3d[] from, Vector3d[] x)
        {
            foreach (ContactConstraint contacts in _all)
            {
                contacts.Clear(from);
            }
            Add(found.Contacts, _spheres, _elements, _clearance, _gain);
            Stop(found.Impacts);
        }

        /// <inheritdoc/>
        public void Stop(StructList<WireContact> impacts) => Add(impacts, _sphereStops, _elementStops, _stop, 1.0);

        /// <inheritdoc/>
        public void Iterate(Vector3d[] x)
        {
            foreach (ContactConstraint contacts in _all)
            {
                contacts.Iterate(x);
            }
        }

        /// <inheritdoc/>
        public void IterateStops(Vector3d[] x)
        {
            _elementStops.Iterate(x);
            _sphereStops.Iterate(x);
        }

        /// <inheritdoc/>
        public void SpheresOf(int k, out int first, out int last) => At(ref k).SpheresOf(k, out first, out last);

        /// <inheritdoc/>
        [MethodImpl(Compiled.AtOnce)]
        public bool Project(int k, Vector3d[] x) => At(ref k).Project(k, x);

        /// <inheritdoc/>
        public void AddImpulses(Vector3d[] impulses)
        {
            foreach (ContactConstraint contacts in _all)
            {
                contacts.AddImpulses(impulses);
            }
        }

        // Where contact k of an iteration is stored, and which it is there.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private ContactConstraint At(ref int k)
        {
            int list = 0;
            while (k >= _all[list].Count)
            {
                k -= _all[list++].Count;
            }
            return _all[list];
        }

        private void Add(StructList<WireContact> contacts, ContactConstraint spheres, ContactConstraint elements,
            double clearance, double gain)
        {
            for (int k = 0; k < contacts.Count; k++)
            {
                ref readonly WireContact contact = ref contacts[k];
                double friction = _friction[contact.Wall];
                if (contact.IsElement)
                {
                    elements.AddElement(contact.Index, contact.Nearest, clearance, gain, friction);
                }
                else
                {
                    spheres.AddSphere(contact.Index, contact.Nearest, clearance, gain, friction);
                }
            }
        }
    }

    /// <summary>Contact as published (thesis 3.1.2): each sphere of a touching element is drawn to the point
    /// c + (r + margin) n_i, dp_i = k_C (c + (r + margin) n_i - p_i) per iteration. Nothing prevents the wire from
    /// passing a wall.</summary>
    /// <remarks>For a sphere's own contact n_i = n. For an element's, with d = x_{j+1} - x_j and t = (c -
    /// x_j).d/|d|^2, n_i is the normal times 0.01 (1 - t) and 0.01 t for t below 0.5, and the two exchanged from 0.5
    /// on (eq. 3.5 is not dimensionless as printed; the factor makes a percentage of it). The rule attracts, drags
    /// sideways and puts the larger weight on the farther sphere beyond the middle; it stands here to be compared
    /// with.</remarks>
    internal sealed class ThesisContactResponse : IContactResponse
    {
        private const int ContactsPerSphere = 4;
        private const double WeightScale = 0.01;
        private readonly double[] _inverseMasses;
        private readonly double _clearance;
        private readonly double _gain;
        private readonly int[] _sphere;
        private readonly Vector3d[] _target;
        private readonly Vector3d[] _moved;

        /// <param name="state">The wire, with its final masses.</param>
        /// <param name="wallCount">Walls of the scene.</param>
        /// <param name="clearance">r + margin in units.</param>
        /// <param name="gain">k_C, per iteration.</param>
        public ThesisContactResponse(RodState state, int wallCount, double clearance, double gain)
        {
            int capacity = ContactsPerSphere * wallCount * state.SphereCount;    // what comes on top is left out
            _inverseMasses = state.InverseMasses;
            _clearance = clearance;
            _gain = gain;
            _sphere = new int[capacity];
            _target = new Vector3d[capacity];
            _moved = new Vector3d[capacity];
        }

        /// <inheritdoc/>
        public int ContactCount { get; private set; }

        /// <inheritdoc/>
        public void Start(IContactSearch found, Vector3d[] from, Vector3d[] x)
        {
            ContactCount = 0;
            for (int k = 0; k < found.Contacts.Count; k++)
            {
                ref readonly WireContact contact = ref found.Contacts[k];
                if (contact.IsElement)
                {
                    AddElement(contact.Index, contact.Nearest, x);
                }
                else
                {
                    Add(contact.Index, contact.Nearest.Point, contact.Nearest.Normal);
                }
            }
        }

        /// <inheritdoc/>
        public void Stop(StructList<WireContact> impacts) =>
            throw new InvalidOperationException("the published rule has no swept test");

        /// <inheritdoc/>
        public void IterateStops(Vector3d[] x)
        {
        }

        /// <inheritdoc/>
        public void Iterate(Vector3d[] x)
        {
            for (int k = 0; k < ContactCount; k++)
            {
                Project(k, x);
            }
        }

        /// <inheritdoc/>
        public void SpheresOf(int k, out int first, out int last) => first = last = _sphere[k];

        /// <inheritdoc/>
        [MethodImpl(Compiled.AtOnce)]
        public bool Project(int k, Vector3d[] x)
        {
            int i = _sphere[k];
            Vector3d correction = _gain * (_target[k] - x[i]);
            _moved[k] += correction;
            x[i] += correction;
            return true;
        }

        /// <inheritdoc/>
        public void AddImpulses(Vector3d[] impulses)
        {
            for (int k = 0; k < ContactCount; k++)
            {
                impulses[_sphere[k]] += _moved[k] / _inverseMasses[_sphere[k]];
            }
        }

        // One contact for each of its spheres.
        private void AddElement(int element, in SurfaceContact contact, Vector3d[] x)
        {
            Vector3d d = x[element + 1] - x[element];
            double t = Vector3d.Dot(contact.Point - x[element], d) / d.LengthSquared;
            double first = WeightScale * (t < 0.5 ? 1.0 - t : t);
            double second = WeightScale * (t < 0.5 ? t : 1.0 - t);
            Add(element, contact.Point, first * contact.Normal);
            Add(element + 1, contact.Point, second * contact.Normal);
        }

        private void Add(int sphere, in Vector3d c, in Vector3d weightedNormal)
        {
            if (ContactCount == _sphere.Length || _inverseMasses[sphere] == 0.0)
            {
                return;
            }
            _sphere[ContactCount] = sphere;
            _target[ContactCount] = c + _clearance * weightedNormal;
            _moved[ContactCount] = Vector3d.Zero;
            ContactCount++;
        }
    }
}
