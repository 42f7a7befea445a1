using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Holds the point at position s of a rod element at a clearance from a wall. With weights a_j = 1 - s,
    /// a_{j+1} = s, contact point c and unit normal n: g = max(0, clearance - (a_j p_j + a_{j+1} p_{j+1} - c).n), dp_i
    /// = gain w_i a_i g n/(w_j a_j^2 + w_{j+1} a_{j+1}^2), per iteration.</summary>
    /// <remarks>The point then moves by gain g n, and the two spheres share the correction by the lever rule: a force F
    /// at s is (1 - s) F and s F on them. It never attracts; along the wall it pulls by <see cref="WallFriction"/>
    /// alone.</remarks>
    internal sealed class ElementContactConstraint
    {
        private readonly double[] _inverseMasses;
        private readonly int[] _element;
        private readonly double[] _position;   // s
        private readonly double[] _denominator; // w_j a_j^2 + w_{j+1} a_{j+1}^2
        private readonly Vector3d[] _normal;
        private readonly double[] _offset;     // (c.n + clearance), units
        private readonly double[] _gain;
        private readonly double[] _impulse;    // sum of gain g / denominator, mass unit * unit
        private readonly WallFriction _friction;
        private Vector3d[] _from;              // where the solve began, units

        /// <param name="state">The wire, with its final masses.</param>
        /// <param name="capacity">Contacts that fit; what comes on top is left out.</param>
        /// <param name="iterations">m of a solve, for friction.</param>
        public ElementContactConstraint(RodState state, int capacity, int iterations = 1)
        {
            _inverseMasses = state.InverseMasses;
            _element = new int[capacity];
            _position = new double[capacity];
            _denominator = new double[capacity];
            _normal = new Vector3d[capacity];
            _offset = new double[capacity];
            _gain = new double[capacity];
            _impulse = new double[capacity];
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

        /// <summary>Adds the contact of an element.</summary>
        public void Add(int element, in SurfaceContact contact, double clearance, double gain, double friction = 0.0)
        {
            double s = contact.Position;
            double denominator = (1.0 - s) * (1.0 - s) * _inverseMasses[element] + s * s * _inverseMasses[element + 1];
            if (Count == _element.Length || !(denominator > 0.0))
            {
                return;
            }
            _element[Count] = element;
            _position[Count] = s;
            _denominator[Count] = denominator;
            _normal[Count] = contact.Normal;
            _offset[Count] = Vector3d.Dot(contact.Point, contact.Normal) + clearance;
            _gain[Count] = gain;
            _impulse[Count] = 0.0;
            _friction.Add(Count, friction);
            Count++;
        }

        /// <summary>The element of contact k.</summary>
        public int ElementOf(int k)
        {
            return _element[k];
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
            int j = _element[k];
            double s = _position[k];
            Vector3d n = _normal[k];
            double gap = _offset[k] - (1.0 - s) * Vector3d.Dot(x[j], n) - s * Vector3d.Dot(x[j + 1], n);
            if (gap > 0.0)
            {
                double impulse = _gain[k] * gap / _denominator[k];
                _impulse[k] += impulse;
                x[j] += (impulse * (1.0 - s) * _inverseMasses[j]) * n;
                x[j + 1] += (impulse * s * _inverseMasses[j + 1]) * n;
            }
            if (_friction.HasFriction(k, _impulse[k]))
            {
                ApplyFriction(k, x);
                return true;
            }
            return gap > 0.0;
        }

        // A displacement t of the contact point is an impulse t/denominator, shared by the lever rule as its normal
        // correction is.
        private void ApplyFriction(int k, Vector3d[] x)
        {
            int j = _element[k];
            double s = _position[k];
            Vector3d motion = (1.0 - s) * (x[j] - _from[j]) + s * (x[j + 1] - _from[j + 1]);
            Vector3d impulse = (1.0 / _denominator[k])
                * _friction.Correct(k, motion, _normal[k], _impulse[k] * _denominator[k]);
            x[j] += ((1.0 - s) * _inverseMasses[j]) * impulse;
            x[j + 1] += (s * _inverseMasses[j + 1]) * impulse;
        }

        /// <summary>Adds to each sphere the momentum over dt, in mass unit * unit, that its elements' contacts gave it;
        /// a held sphere's part is what its holder took.</summary>
        public void AddImpulses(Vector3d[] impulses)
        {
            for (int k = 0; k < Count; k++)
            {
                impulses[_element[k]] += (_impulse[k] * (1.0 - _position[k])) * _normal[k];
                impulses[_element[k] + 1] += (_impulse[k] * _position[k]) * _normal[k];
                if (_friction.HasFriction(k, _impulse[k]))
                {
                    Vector3d impulse = (1.0 / _denominator[k]) * _friction.Taken(k);
                    impulses[_element[k]] += (1.0 - _position[k]) * impulse;
                    impulses[_element[k] + 1] += _position[k] * impulse;
                }
            }
        }
    }
}
