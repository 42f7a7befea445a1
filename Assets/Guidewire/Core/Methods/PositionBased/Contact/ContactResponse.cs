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
}
