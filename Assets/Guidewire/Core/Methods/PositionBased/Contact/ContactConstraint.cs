using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Holds a point of the wire at a clearance from a wall: a point of a rod element with weights a_1 = 1 - s
    /// and a_2 = s of its spheres, or a sphere's centre with weights 1 and 0 (thesis 3.1.2, without its drag along the
    /// wall). With contact point c and unit normal n: g = max(0, clearance - (a_1 p_1 + a_2 p_2 - c).n), dp_i = gain
    /// w_i a_i g n/(w_1 a_1^2 + w_2 a_2^2), per iteration.</summary>
    /// <remarks>The point then moves by gain g n, and the two spheres share the correction by the lever rule: a force F
    /// at s is (1 - s) F and s F on them. It never attracts; along the wall it pulls by <see cref="WallFriction"/>
    /// alone. The clearance is r + margin and the gain k_C in [0, 1], or a bare clearance with gain 1 where the swept
    /// test met the wall. A sphere of inverse mass 0 is not moved.</remarks>
    internal sealed class ContactConstraint
    {
        private readonly double[] _inverseMasses;
        private readonly int[] _first;         // sphere
        private readonly int[] _second;        // that of a sphere's own contact is the same
        private readonly double[] _position;   // s
        private readonly double[] _inverseUnit; // w of the unit of mass of impulses: a sphere's own, else 1
        private readonly double[] _firstInverse;   // w_1 over it
        private readonly double[] _secondInverse;
        private readonly double[] _denominator;    // w_1 a_1^2 + w_2 a_2^2
        private readonly Vector3d[] _normal;
        private readonly double[] _offset;     // (c.n + clearance), units
        private readonly double[] _gain;
        private readonly double[] _impulse;    // sum of gain g / denominator, unit mass * unit
        private readonly WallFriction _friction;
        private Vector3d[] _from;              // where the solve began, units

        /// <param name="state">The wire, with its final masses.</param>
        /// <param name="capacity">Contacts that fit; what comes on top is left out.</param>
        /// <param name="iterations">m of a solve, for friction.</param>
        public ContactConstraint(RodState state, int capacity, int iterations = 1)
        {
            _inverseMasses = state.InverseMasses;
            _first = new int[capacity];
            _second = new int[capacity];
            _position = new double[capacity];
            _inverseUnit = new double[capacity];
            _firstInverse = new double[capacity];
            _secondInverse = new double[capacity];
            _denominator = new double[capacity];
            _normal = new Vector3d[capacity];
            _offset = new double[capacity];
            _gain = new double[capacity];
            _impulse = new double[capacity];
            _friction = new WallFriction(capacity, iterations);
            _from = state.Positions;
        }

        /// <summary>Counts the contacts at present.</summary>
        public int Count { get; private set; }

        /// <summary>Forgets all contacts; friction of those to come acts on the motion from these n + 1
        /// positions.</summary>
        public void Clear(Vector3d[] from)
        {
            _from = from;
            Count = 0;
        }

        /// <summary>Adds the contact of a sphere.</summary>
        public void AddSphere(int sphere, in SurfaceContact contact, double clearance, double gain,
            double friction = 0.0) =>
            Add(sphere, sphere, 0.0, _inverseMasses[sphere], contact, clearance, gain, friction);

        /// <summary>Adds the contact of an element.</summary>
        public void AddElement(int element, in SurfaceContact contact, double clearance, double gain,
            double friction = 0.0) =>
            Add(element, element + 1, contact.Position, 1.0, contact, clearance, gain, friction);

        /// <summary>The spheres that contact k moves.</summary>
        public void SpheresOf(int k, out int first, out int last)
        {
            first = _first[k];
            last = _second[k];
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
            int i = _first[k];
            int j = _second[k];
            double s = _position[k];
            Vector3d n = _normal[k];
            double gap = _offset[k] - (1.0 - s) * Vector3d.Dot(x[i], n) - s * Vector3d.Dot(x[j], n);
            if (gap > 0.0)
            {
                double impulse = _gain[k] * gap / _denominator[k];
                _impulse[k] += impulse;
                x[i] += (impulse * (1.0 - s) * _firstInverse[k]) * n;
                x[j] += (impulse * s * _secondInverse[k]) * n;
            }
            if (_friction.HasFriction(k, _impulse[k]))
            {
                ApplyFriction(k, x);
                return true;
            }
            return gap > 0.0;
        }

        /// <summary>Adds to each sphere the momentum over dt, in mass unit * unit, that its contacts gave it; a held
        /// sphere's part is what its holder took.</summary>
        public void AddImpulses(Vector3d[] impulses)
        {
            for (int k = 0; k < Count; k++)
            {
                double s = _position[k];
                double unit = _inverseUnit[k];
                impulses[_first[k]] += (_impulse[k] * (1.0 - s) / unit) * _normal[k];
                impulses[_second[k]] += (_impulse[k] * s / unit) * _normal[k];
                if (_friction.HasFriction(k, _impulse[k]))
                {
                    Vector3d impulse = (1.0 / _denominator[k]) * _friction.Taken(k);
                    impulses[_first[k]] += ((1.0 - s) / unit) * impulse;
                    impulses[_second[k]] += (s / unit) * impulse;
                }
            }
        }

        private void Add(int first, int second, double s, double inverseUnit, in SurfaceContact contact,
            double clearance, double gain, double friction)
        {
            double a = _inverseMasses[first] / inverseUnit;
            double b = _inverseMasses[second] / inverseUnit;
            double denominator = (1.0 - s) * (1.0 - s) * a + s * s * b;
            if (Count == _first.Length || !(denominator > 0.0))
            {
                return;
            }
            _first[Count] = first;
            _second[Count] = second;
            _position[Count] = s;
            _inverseUnit[Count] = inverseUnit;
            _firstInverse[Count] = a;
            _secondInverse[Count] = b;
            _denominator[Count] = denominator;
            _normal[Count] = contact.Normal;
            _offset[Count] = Vector3d.Dot(contact.Point, contact.Normal) + clearance;
            _gain[Count] = gain;
            _impulse[Count] = 0.0;
            _friction.Add(Count, friction);
            Count++;
        }

        // A displacement t of the contact point is an impulse t/denominator, shared by the lever rule as its normal
        // correction is.
        private void ApplyFriction(int k, Vector3d[] x)
        {
            int i = _first[k];
            int j = _second[k];
            double s = _position[k];
            Vector3d motion = (1.0 - s) * (x[i] - _from[i]) + s * (x[j] - _from[j]);
            Vector3d impulse = (1.0 / _denominator[k])
                * _friction.Correct(k, motion, _normal[k], _impulse[k] * _denominator[k]);
            x[i] += ((1.0 - s) * _firstInverse[k]) * impulse;
            x[j] += (s * _secondInverse[k]) * impulse;
        }
    }
}
