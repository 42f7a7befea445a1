using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
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
