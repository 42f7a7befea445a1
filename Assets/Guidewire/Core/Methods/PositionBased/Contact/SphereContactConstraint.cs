using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Holds a sphere's centre p at a clearance from a wall: with contact point c and unit normal n, g =
    /// max(0, clearance - (p - c).n), dp = gain g n, per iteration (thesis 3.1.2 for a sphere, without its drag along
    /// the wall). It never attracts; along the wall it pulls by <see cref="WallFriction"/> alone.</summary>
    /// <remarks>The clearance is r + margin and the gain k_C in [0, 1], or a bare clearance with gain 1 where the swept
    /// test met the wall. A sphere of inverse mass 0 is not moved.</remarks>
    internal sealed class SphereContactConstraint
    {
        private readonly double[] _inverseMasses;
        private readonly int[] _sphere;
        private readonly Vector3d[] _normal;
        private readonly double[] _offset;     // (c.n + clearance), units
        private readonly double[] _gain;
        private readonly double[] _correction;     // sum of gain g over the iterations, units
        private readonly WallFriction _friction;
        private Vector3d[] _from;              // where the solve began, units

        /// <param name="state">The wire, with its final masses.</param>
        /// <param name="capacity">Contacts that fit; what comes on top is left out.</param>
        /// <param name="iterations">m of a solve, for friction.</param>
        public SphereContactConstraint(RodState state, int capacity, int iterations = 1)
        {
            _inverseMasses = state.InverseMasses;
            _sphere = new int[capacity];
            _normal = new Vector3d[capacity];
            _offset = new double[capacity];
            _gain = new double[capacity];
            _correction = new double[capacity];
            _friction = new WallFriction(capacity, iterations);
            _from = state.Positions;
        }

        /// <summary>Contacts at present.</summary>
        public int Count { get; private set; }

        /// <summary>Forgets all contacts; friction of those to come acts on the motion from these n + 1
        /// positions.</summary>
        public void Clear(Vector3d[] from)
        {
            _from = from;
            Count = 0;
        }

        /// <summary>Adds the contact of a sphere.</summary>
        public void Add(int sphere, in SurfaceContact contact, double clearance, double gain, double friction = 0.0)
        {
            if (Count == _sphere.Length || _inverseMasses[sphere] == 0.0)
            {
                return;
            }
            _sphere[Count] = sphere;
            _normal[Count] = contact.Normal;
            _offset[Count] = Vector3d.Dot(contact.Point, contact.Normal) + clearance;
            _gain[Count] = gain;
            _correction[Count] = 0.0;
            _friction.Add(Count, friction);
            Count++;
        }

        /// <summary>The sphere of contact k.</summary>
        public int SphereOf(int k)
        {
            return _sphere[k];
        }

        /// <summary>Projects all contacts once, in the order in which they were added.</summary>
        /// <param name="x">n + 1 positions in units, corrected in place.</param>
        public void Iterate(Vector3d[] x)
        {
            for (int k = 0; k < Count; k++)
            {
                Project(k, x);
            }
        }

        /// <summary>Projects contact k once; false where it moved nothing.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool Project(int k, Vector3d[] x)
        {
            int i = _sphere[k];
            Vector3d n = _normal[k];
            double gap = _offset[k] - Vector3d.Dot(x[i], n);
            if (gap > 0.0)
            {
                double correction = _gain[k] * gap;
                _correction[k] += correction;
                x[i] += correction * n;
            }
            if (_friction.HasFriction(k, _correction[k]))
            {
                x[i] += _friction.Correct(k, x[i] - _from[i], n, _correction[k]);
                return true;
            }
            return gap > 0.0;
        }

        /// <summary>Adds to each sphere the momentum over dt, dp/w, in mass unit * unit, that its contacts gave
        /// it.</summary>
        public void AddImpulses(Vector3d[] impulses)
        {
            for (int k = 0; k < Count; k++)
            {
                impulses[_sphere[k]] += (_correction[k] / _inverseMasses[_sphere[k]]) * _normal[k];
                if (_friction.HasFriction(k, _correction[k]))
                {
                    impulses[_sphere[k]] += (1.0 / _inverseMasses[_sphere[k]]) * _friction.Taken(k);
                }
            }
        }
    }
}
