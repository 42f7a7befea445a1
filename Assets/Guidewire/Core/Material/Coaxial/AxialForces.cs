using System;

namespace Guidewire.Core
{
    /// <summary>Stretch of coaxial instruments that slide along their common axis without friction: each is a bar from
    /// its own hub to its tip and bears its own loads.</summary>
    /// <remarks>A chain's node is one of the outermost instrument there. N_i is the sum of the axial parts of the loads
    /// on instrument i beyond a position. From its own hub on it is longer by e_i = sum of c_i N_i, where c_i = l/EA_i
    /// of each element. What else is along the axis (walls, inertia, what bending makes of a force) is not known by
    /// instrument. An element gives way to it as all that are in it together, c = l/sum EA; and the element at a tip by
    /// what the instruments that go on have besides from their hubs,
    ///   c = 1/sum 1/C_i - sum of c before it, C_i = sum of c_i from its hub to the element's end.
    /// So a force on one beyond all others stretches that one by C_i, and one without stiffness changes nothing. An
    /// element's rest length is then l + e - c sum N_i, with e of the outermost one; at a tip e has what the one that
    /// goes on is longer than the chain is before it. The force of the hubs of those that go on strains what of them is
    /// inside, and no other: the tip around them bears the rest Q of the element's thrust (M^2/2B of a mouth). So that
    /// element and the next one are longer by (c - l/sum EA) Q, with Q of the last step: it hardly depends on strains,
    /// while c holds the force of a tip that is pressed. What is before the chain in a sheath is as one more element of
    /// all of them.
    ///
    /// Directions of loads are those of the shape that <see cref="Take"/> had last.</remarks>
    internal sealed class AxialForces
    {
        private const double Follow = 0.25;     // of a change of Q, taken in a step: all at once may swing

        private readonly CoaxialJoints _joints;
        private readonly Vector3d[] _load;      // on each element, of each instrument, N
        private readonly Vector3d[] _levered;   // times the fraction of its length where they are
        private readonly double[] _shift;       // e of each element, m
        private readonly double[] _force;       // sum of N, N
        private readonly double[] _strain;      // largest of all instruments
        private readonly double[] _slide;       // of each instrument at the nodes, m
        private readonly double[] _compliance;  // of the chain, m/N
        private readonly double[] _leadForce;   // of each before the chain, N
        private readonly double[] _next;        // Q of the next step
        private readonly double[] _mean;        // N of each in an element, N
        private readonly double[] _borne;       // Q by the first instrument that goes on, N

        /// <summary>Makes one of a chain without loads.</summary>
        public AxialForces(CoaxialJoints joints)
        {
            _joints = joints;
            int capacity = joints.Capacity;
            _load = new Vector3d[joints.Count * capacity];
            _levered = new Vector3d[joints.Count * capacity];
            _shift = new double[capacity];
            _force = new double[capacity];
            _strain = new double[capacity];
            _slide = new double[joints.Count * (capacity + 1)];
            _compliance = new double[capacity];
            _leadForce = new double[joints.Count];
            _mean = new double[joints.Count * capacity];
            _borne = new double[joints.Count];
            _next = new double[joints.Count];
        }

        // Elements.
        private int N => _joints.ElementCount;

        /// <summary>The chain has other elements, without loads, and no tip bears anything until <see
        /// cref="BeginStep"/>: so masses, and what else is taken of the lengths, do not depend on the past.</summary>
        public void Remesh()
        {
            ClearLoads();
            Array.Clear(_borne, 0, _borne.Length);
            Array.Clear(_shift, 0, N);
            Array.Clear(_force, 0, N);
            Array.Clear(_strain, 0, N);
            Array.Clear(_slide, 0, _joints.Count * (N + 1));
            Array.Clear(_leadForce, 0, _leadForce.Length);
            Array.Clear(_mean, 0, _joints.Count * N);
        }

        /// <summary>There are no loads.</summary>
        public void ClearLoads()
        {
            Array.Clear(_load, 0, _joints.Count * N);
            Array.Clear(_levered, 0, _joints.Count * N);
        }

        /// <summary>Adds a load on an instrument, N.</summary>
        /// <param name="fraction">Of the element's length.</param>
        public void AddLoad(int instrument, int element, double fraction, in Vector3d load)
        {
            _load[instrument * N + element] += load;
            _levered[instrument * N + element] += fraction * load;
        }

        /// <summary>How far the material of an instrument in an element is ahead of the chain's, m.</summary>
        /// <param name="fraction">Of the element's length.</param>
        public double SlideAt(int instrument, int element, double fraction)
        {
            int at = instrument * (N + 1) + element;
            return _joints.CarrierOf(element) == instrument ? 0.0
                : (1.0 - fraction) * _slide[at] + fraction * _slide[at + 1];
        }

        /// <summary>The largest axial strain of the instruments in an element.</summary>
        /// <param name="length">Distance of its ends, m.</param>
        public double StrainAt(int element, double length)
        {
            double rest = _joints.Stations[element + 1] - _joints.Stations[element];
            double other = (length - RestLengthOf(element)) / _compliance[element] - _force[element];
            return _strain[element] + Math.Abs(other) * _joints[element].Axial / rest;
        }

        /// <summary>The axial strain of an instrument in an element: that of its own loads, and its part of what else
        /// is along the axis.</summary>
        /// <param name="force">Along the element's axis, of the chain, N.</param>
        public double StrainOf(int instrument, int element, double force)
        {
            double rest = _joints.Stations[element + 1] - _joints.Stations[element];
            int at = instrument * (N + 1) + element;
            double stretch = _slide[at + 1] - _slide[at] + _shift[element];
            return (stretch + (force - _force[element]) * _joints[element].Axial) / rest;
        }

        /// <summary>Finds the compliance of element j of the chain, m/N, after a change of the hubs; those before it
        /// first.</summary>
        /// <param name="before">In and out: of all before it.</param>
        public double FindCompliance(int j, ref double before)
        {
            double compliance = _joints[j].Axial;
            if (_joints.IsTip(j))
            {
                double stiffness = 0.0;
                for (int i = _joints.CarrierOf(j); i < _joints.Count; i++)
                {
                    stiffness += GoesOn(i, j) ? 1.0 / FromHub(i, j) : 0.0;
                }
                compliance = 1.0 / stiffness - before;
            }
            before += compliance;
            _compliance[j] = compliance;
            return compliance;
        }

        /// <summary>Gives a derivative of that.</summary>
        /// <param name="axial">Of the compliance of all in the element, held together.</param>
        /// <param name="own">Of that of each from its hub to the element's end.</param>
        /// <param name="before">Of that of all elements before it.</param>
        public double ComplianceRateOf(int j, double axial, double[] own, double before)
        {
            if (!_joints.IsTip(j))
            {
                return axial;
            }
            double stiffness = 0.0;
            double rate = 0.0;
            for (int i = _joints.CarrierOf(j); i < _joints.Count; i++)
            {
                double each = GoesOn(i, j) ? 1.0 / FromHub(i, j) : 0.0;
                stiffness += each;
                rate += each * each * own[i];
            }
            return rate / (stiffness * stiffness) - before;
        }

        /// <summary>Gives the sum of N on an element, N.</summary>
        public double LoadOn(int element) => _force[element];

        /// <summary>Gives N of an instrument before the chain, N.</summary>
        public double LeadForceOf(int instrument) => _leadForce[instrument];

        /// <summary>The sum of these, N.</summary>
        public double LeadLoad
        {
            get
            {
                double sum = 0.0;
                foreach (double force in _leadForce)
                {
                    sum += force;
                }
                return sum;
            }
        }

        /// <summary>Rest length from the outermost hub to the chain, m.</summary>
        public double LeadLength => _joints.Stations[0] + _joints.LeadStretchOf(0) * _leadForce[0]
            - _joints.LeadAxial * LeadLoad;

        /// <summary>Length of an instrument from a place before the chain up to it, m.</summary>
        /// <param name="place">m from the outermost hub.</param>
        /// <param name="thrust">Of the hubs on all that are there, N.</param>
        public double LeadFrom(double place, int instrument, double thrust)
        {
            double all = _joints.AxialBetween(Math.Max(place, 0.0), _joints.Stations[0], instrument, out double own);
            return _joints.Stations[0] - place + own * _leadForce[instrument] - all * (thrust + LeadLoad);
        }

        /// <summary>Energy that the chain has from its loads alone, sum of 1/2 c (sum N)^2, J: of one whose nodes are
        /// where the loads have them it is no energy of the instruments.</summary>
        public double PreloadEnergy
        {
            get
            {
                double sum = 0.0;
                for (int j = 0; j < N; j++)
                {
                    sum += 0.5 * _compliance[j] * _force[j] * _force[j];
                }
                return sum;
            }
        }

        /// <summary>Gives the rest length of element j of the chain, m.</summary>
        public double RestLengthOf(int j)
        {
            int tip = _joints.IsTip(j) || !_joints.IsTip(j - 1) ? j : j - 1;
            double borne = BorneAt(tip);
            return _joints.Stations[j + 1] - _joints.Stations[j] + _shift[j] - _compliance[j] * _force[j]
                + (borne == 0.0 ? 0.0
                    : ShareOf(j, tip, 0.0, out _) * BorneLengthAt(tip));
        }

        /// <summary>Gives Q of element j, the part of its thrust that the tip before it bears, N; 0 where none
        /// is.</summary>
        public double BorneAt(int j) => _joints.IsTip(j) ? _borne[_joints.CarrierOf(j)] : 0.0;

        /// <summary>By how much Q makes element j, at a tip, and the next one longer, m.</summary>
        public double BorneLengthAt(int j) => (_compliance[j] - _joints[j].Axial) * BorneAt(j);

        /// <summary>The fraction by which an element takes part in what Q makes the one at a tip longer by. That may
        /// be very short: so it and the next one do by their lengths.</summary>
        /// <param name="tip">The one at the tip.</param>
        /// <param name="grows">Derivative of that one's length.</param>
        /// <param name="rate">The fraction's derivative.</param>
        public double ShareOf(int j, int tip, double grows, out double rate)
        {
            rate = 0.0;
            if (tip + 1 >= N || _joints.IsTip(tip + 1))
            {
                return j == tip ? 1.0 : 0.0;
            }
            double own = _joints.Stations[tip + 1] - _joints.Stations[tip];
            double both = _joints.Stations[tip + 2] - _joints.Stations[tip];
            double share = own / both;
            rate = (1.0 - share) * grows / both;
            rate = j == tip ? rate : -rate;
            return j == tip ? share : 1.0 - share;
        }

        /// <summary>Takes Q of all tips for the next step from the same instruments in another chain.</summary>
        public void TakeBorne(AxialForces other) => Array.Copy(other._next, _next, _next.Length);

        /// <summary>Q that was set last counts from now on.</summary>
        public void BeginStep() => Array.Copy(_next, _borne, _borne.Length);

        /// <summary>Sets Q of an element at a tip for the next step, N.</summary>
        /// <returns>By how much the element becomes longer, m.</returns>
        public double SetBorne(int j, double borne)
        {
            int carrier = _joints.CarrierOf(j);
            double change = borne - _borne[carrier];
            _next[carrier] = _borne[carrier] + Follow * change;
            return (_compliance[j] - _joints[j].Axial) * change;
        }

        /// <summary>What the hub of an instrument has to push for the thrust of an element, N less: the loads on it
        /// before that element.</summary>
        public double LoadBefore(int instrument, int element) =>
            _leadForce[instrument] - _mean[instrument * N + element];

        /// <summary>Takes the directions of the loads.</summary>
        /// <returns>The largest change of what an element is longer by, m.</returns>
        public double UpdateDirections(RodShape shape)
        {
            Array.Clear(_force, 0, N);
            Array.Clear(_strain, 0, N);
            for (int i = 0; i < _joints.Count; i++)
            {
                Stretch(shape, i);
            }
            double largest = 0.0;
            double lead = _slide[0];
            double before = lead;     // of the chain's node before the element
            for (int j = 0; j < N; j++)
            {
                double after = _slide[_joints.CarrierOf(j) * (N + 1) + j + 1];
                largest = Math.Max(largest, Math.Abs(after - before - _shift[j]));
                _shift[j] = after - before;
                before = after;
            }
            for (int k = N; k >= 0; k--)
            {
                double node = k == 0 ? lead : _slide[_joints.CarrierOf(k - 1) * (N + 1) + k];
                for (int i = 0; i < _joints.Count; i++)
                {
                    _slide[i * (N + 1) + k] -= node;
                }
            }
            return largest;
        }

        /// <summary>Writes or restores what the loads do to the chain.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(_shift, N);
            snapshot.Serialize(_force, N);
            snapshot.Serialize(_strain, N);
            snapshot.Serialize(_slide, _joints.Count * (N + 1));
            snapshot.Serialize(_borne);
            snapshot.Serialize(_next);
            snapshot.Serialize(_mean, _joints.Count * N);
            snapshot.Serialize(_leadForce);
        }

        /// <summary>Whether an instrument is in all of an element at a tip.</summary>
        public bool GoesOn(int instrument, int element)
        {
            return instrument == _joints.CarrierOf(element)
                || _joints.Hubs.Ends[instrument] >= _joints.Stations[element + 1];
        }

        // C_i to an element's end, m/N.
        private double FromHub(int instrument, int element)
        {
            double own = _joints.LeadStretchOf(instrument);
            for (int k = 0; k <= element; k++)
            {
                own += _joints.StretchOf(instrument, k);
            }
            return own;
        }

        // How much farther from its hub an instrument's loads bring it at each node; first N before each.
        private void Stretch(RodShape shape, int instrument)
        {
            int at = instrument * (N + 1);
            double force = 0.0;
            for (int j = N - 1; j >= 0; j--)
            {
                Vector3d axis = shape.Q[j].Director3;
                double levered = Vector3d.Dot(axis, _levered[instrument * N + j]);
                _force[j] += force + levered;
                _mean[instrument * N + j] = force + levered;
                double length = _joints.Stations[j + 1] - _joints.Stations[j];
                double part = Math.Min(1.0, (_joints.Hubs.Ends[instrument] - _joints.Stations[j]) / length);
                double mean = part > 0.0 ? force + levered / part : 0.0;
                double stretch = _joints.StretchOf(instrument, j) * mean;
                _strain[j] = Math.Max(_strain[j], part > 0.0 ? Math.Abs(stretch) / (part * length) : 0.0);
                _slide[at + j + 1] = stretch;
                force += Vector3d.Dot(axis, _load[instrument * N + j]);
            }
            _leadForce[instrument] = force;
            _slide[at] = _joints.LeadStretchOf(instrument) * force;
            for (int j = 0; j < N; j++)
            {
                _slide[at + j + 1] += _slide[at + j];
            }
        }
    }
}
