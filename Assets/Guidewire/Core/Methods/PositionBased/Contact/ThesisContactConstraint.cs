using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Contact as published (thesis 3.1.2): each sphere of a touching element is drawn to the point
    /// c + (r + margin) n_i, dp_i = k_C (c + (r + margin) n_i - p_i) per iteration.</summary>
    /// <remarks>For a sphere's own contact n_i = n. For an element's, with d = x_{j+1} - x_j and t = (c -
    /// x_j).d/|d|^2, n_i is the normal times 0.01 (1 - t) and 0.01 t for t below 0.5, and the two exchanged from 0.5
    /// on (eq. 3.5 is not dimensionless as printed; the factor makes a percentage of it). The rule attracts, drags
    /// sideways and puts the larger weight on the farther sphere beyond the middle; it stands here to be compared
    /// with.</remarks>
    internal sealed class ThesisContactConstraint
    {
        private const double WeightScale = 0.01;
        private readonly double[] _inverseMasses;
        private readonly double _clearance;
        private readonly double _gain;
        private readonly int[] _sphere;
        private readonly Vector3d[] _target;
        private readonly Vector3d[] _moved;

        /// <param name="state">The wire, with its final masses.</param>
        /// <param name="capacity">Contacts that fit; what comes on top is left out.</param>
        /// <param name="clearance">r + margin in units.</param>
        /// <param name="gain">k_C.</param>
        public ThesisContactConstraint(RodState state, int capacity, double clearance, double gain)
        {
            _inverseMasses = state.InverseMasses;
            _clearance = clearance;
            _gain = gain;
            _sphere = new int[capacity];
            _target = new Vector3d[capacity];
            _moved = new Vector3d[capacity];
        }

        /// <summary>Contacts at present, two for an element's.</summary>
        public int Count { get; private set; }

        /// <summary>Forgets all contacts.</summary>
        public void Clear()
        {
            Count = 0;
        }

        /// <summary>Adds a sphere's own contact.</summary>
        public void AddSphere(int sphere, in SurfaceContact contact)
        {
            Add(sphere, contact.Point, contact.Normal);
        }

        /// <summary>Adds an element's contact, one for each of its spheres.</summary>
        public void AddElement(int element, in SurfaceContact contact, Vector3d[] x)
        {
            Vector3d d = x[element + 1] - x[element];
            double t = Vector3d.Dot(contact.Point - x[element], d) / d.LengthSquared;
            double first = WeightScale * (t < 0.5 ? 1.0 - t : t);
            double second = WeightScale * (t < 0.5 ? t : 1.0 - t);
            Add(element, contact.Point, first * contact.Normal);
            Add(element + 1, contact.Point, second * contact.Normal);
        }

        /// <summary>The sphere of contact k.</summary>
        public int SphereOf(int k)
        {
            return _sphere[k];
        }

        /// <summary>Draws all spheres once, in the order in which contacts were added.</summary>
        /// <param name="x">n + 1 positions in units, corrected in place.</param>
        public void Iterate(Vector3d[] x)
        {
            for (int k = 0; k < Count; k++)
            {
                Project(k, x);
            }
        }

        /// <summary>Draws the sphere of contact k once.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Project(int k, Vector3d[] x)
        {
            int i = _sphere[k];
            Vector3d correction = _gain * (_target[k] - x[i]);
            _moved[k] += correction;
            x[i] += correction;
        }

        /// <summary>Adds to each sphere the momentum over dt, in mass unit * unit, that its contacts gave it.</summary>
        public void AddImpulses(Vector3d[] impulses)
        {
            for (int k = 0; k < Count; k++)
            {
                impulses[_sphere[k]] += _moved[k] / _inverseMasses[_sphere[k]];
            }
        }

        private void Add(int sphere, in Vector3d c, in Vector3d weightedNormal)
        {
            if (Count == _sphere.Length || _inverseMasses[sphere] == 0.0)
            {
                return;
            }
            _sphere[Count] = sphere;
            _target[Count] = c + _clearance * weightedNormal;
            _moved[Count] = Vector3d.Zero;
            Count++;
        }
    }
}
