using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Contact of spheres and of rod elements by the lever rule, with hard stops where the swept test met a
    /// wall; see <see cref="SphereContactConstraint"/> and <see cref="ElementContactConstraint"/>. With friction, see
    /// <see cref="WallFriction"/>.</summary>
    internal sealed class ContactResponse : IContactResponse
    {
        private const int ContactsPerSphere = 8;
        private readonly double _clearance;
        private readonly double _gain;
        private readonly double _stop;    // clearance of a stop between core line and wall, units
        private readonly double[] _friction;    // mu, per wall
        private readonly SphereContactConstraint _spheres;
        private readonly ElementContactConstraint _elements;
        private readonly SphereContactConstraint _sphereStops;
        private readonly ElementContactConstraint _elementStops;

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
            _spheres = new SphereContactConstraint(state, capacity, iterations);
            _elements = new ElementContactConstraint(state, capacity, iterations);
            _sphereStops = new SphereContactConstraint(state, capacity, iterations);
            _elementStops = new ElementContactConstraint(state, capacity, iterations);
        }

        /// <inheritdoc/>
        public int ContactCount => _spheres.Count + _elements.Count + _elementStops.Count + _sphereStops.Count;

        /// <inheritdoc/>
        public void Start(IContactSearch found, Vector3d[] from, Vector3d[] x)
        {
            _spheres.Clear(from);
            _elements.Clear(from);
            _sphereStops.Clear(from);
            _elementStops.Clear(from);
            Add(found.Contacts, _spheres, _elements, _clearance, _gain);
            Stop(found.Impacts);
        }

        /// <inheritdoc/>
        public void Stop(StructList<WireContact> impacts)
        {
            Add(impacts, _sphereStops, _elementStops, _stop, 1.0);
        }

        /// <inheritdoc/>
        public void Iterate(Vector3d[] x)
        {
            _spheres.Iterate(x);
            _elements.Iterate(x);
            _elementStops.Iterate(x);
            _sphereStops.Iterate(x);
        }

        /// <inheritdoc/>
        public void IterateStops(Vector3d[] x)
        {
            _elementStops.Iterate(x);
            _sphereStops.Iterate(x);
        }

        /// <inheritdoc/>
        public void SpheresOf(int k, out int first, out int last)
        {
            SphereContactConstraint? spheres = At(ref k, out ElementContactConstraint? elements);
            first = spheres?.SphereOf(k) ?? elements!.ElementOf(k);
            last = spheres != null ? first : first + 1;
        }

        /// <inheritdoc/>
        [MethodImpl(Compiled.AtOnce)]
        public bool Project(int k, Vector3d[] x)
        {
            SphereContactConstraint? spheres = At(ref k, out ElementContactConstraint? elements);
            return spheres != null ? spheres.Project(k, x) : elements!.Project(k, x);
        }

        /// <inheritdoc/>
        public void AddImpulses(Vector3d[] impulses)
        {
            _spheres.AddImpulses(impulses);
            _elements.AddImpulses(impulses);
            _elementStops.AddImpulses(impulses);
            _sphereStops.AddImpulses(impulses);
        }

        // Where contact k of an iteration is stored, and which it is there: spheres, or where that is null, elements.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private SphereContactConstraint? At(ref int k, out ElementContactConstraint? elements)
        {
            elements = null;
            if (k < _spheres.Count)
            {
                return _spheres;
            }
            k -= _spheres.Count;
            if (k < _elements.Count)
            {
                elements = _elements;
                return null;
            }
            k -= _elements.Count;
            if (k < _elementStops.Count)
            {
                elements = _elementStops;
                return null;
            }
            k -= _elementStops.Count;
            return _sphereStops;
        }

        private void Add(StructList<WireContact> contacts, SphereContactConstraint spheres,
            ElementContactConstraint elements, double clearance, double gain)
        {
            for (int k = 0; k < contacts.Count; k++)
            {
                ref readonly WireContact contact = ref contacts[k];
                double friction = _friction[contact.Wall];
                if (contact.IsElement)
                {
                    elements.Add(contact.Index, contact.Nearest, clearance, gain, friction);
                }
                else
                {
                    spheres.Add(contact.Index, contact.Nearest, clearance, gain, friction);
                }
            }
        }
    }
}
