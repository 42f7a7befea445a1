using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Detects an unstable motion: the wire has more kinetic energy than was ever put into it.</summary>
    /// <remarks>With T of motion and V of the strains, T + V is at most what it was at the start plus the work W of
    /// loads and held ends; damping and implicit steps only take from it. V is no less than 0, so T never exceeds the
    /// largest sum that start and W have had. T alone is compared: strains left by too few iterations hold energy on
    /// paper only, and such a wire is wrong but not lost. The margin allows a factor of 4, and more for explicit steps
    /// h near their limit, where T of a mode is too high by 1/(1 - (omega h/2)^2).</remarks>
    internal sealed class EnergyMonitor
    {
        /// <summary>The least that T may be over the energy put in.</summary>
        public const double MinAllowance = 4.0;

        private const double Rounding = 1e-9;   // of EI/L
        private readonly RodShape _shape;
        private readonly Vector3d[] _velocities;
        private readonly Vector3d[] _spins;
        private readonly RodTerms _terms;
        private readonly IKineticEnergy _inertia;
        private readonly HeldEnds _ends;
        private readonly RodShape _before;
        private double _start;                  // J, with what changes of the material have put in
        private double _loadWork;               // J
        private double _maxPutIn;              // J
        private int _step;

        /// <summary>Makes a monitor of a wire at its start.</summary>
        /// <param name="terms">Its energies and loads.</param>
        /// <param name="inertia">How its motion counts.</param>
        /// <param name="shape">Where it is, now and after each step.</param>
        /// <param name="velocities">Of its nodes, m/s, now and after each step.</param>
        /// <param name="spins">Of its elements, rad/s.</param>
        /// <param name="ends">The work of its supports.</param>
        public EnergyMonitor(RodTerms terms, IKineticEnergy inertia, RodShape shape, Vector3d[] velocities,
            Vector3d[] spins, HeldEnds ends)
        {
            _shape = shape;
            _velocities = velocities;
            _spins = spins;
            _terms = terms;
            _inertia = inertia;
            _ends = ends;
            _before = new RodShape(shape.ElementCount, shape.InnerCount, shape.Q.Length);
            Remesh();
        }

        /// <summary>The wire has other elements, and is at its start.</summary>
        public void Remesh()
        {
            (_loadWork, _step) = (0.0, 0);
            Start();
            _maxPutIn = Rounding * _terms.Rod.BendStiffness1[0] / _terms.Rod.TotalLength;
        }

        /// <summary>What T may be over the energy put in.</summary>
        public double Allowance { get; set; } = MinAllowance;

        /// <summary>The most that moving walls have put in, J.</summary>
        public double WallWork { get; set; }

        /// <summary>Takes the wire after a step that the loads acted in as they are now; one line where it has blown
        /// up, else null.</summary>
        public string? Blowup()
        {
            _step++;
            // What acts on a held node acts on its support.
            _before.X[0] = _ends.HoldsFirst ? _shape.X[0] : _before.X[0];
            int last = _shape.ElementCount;
            _before.X[last] = _ends.HoldsLast ? _shape.X[last] : _before.X[last];
            _loadWork += _terms.LoadWork(_before, _shape);
            _before.CopyFrom(_shape);
            double motion = Motion();
            double putIn = _start + _loadWork + _ends.MaxWork + WallWork;
            // A NaN fails every comparison, so the conditions state the good case.
            if (!(motion <= double.MaxValue))
            {
                return string.Format(CultureInfo.InvariantCulture,
                    "the wire has no finite kinetic energy at step {0}", _step);
            }
            if (motion <= Allowance * Math.Max(_maxPutIn, putIn))
            {
                _maxPutIn = Math.Max(_maxPutIn, putIn);
                return null;
            }
            return string.Format(CultureInfo.InvariantCulture,
                "the wire moves with {0:G3} times the energy that was put into it (step {1})",
                motion / Math.Max(_maxPutIn, putIn), _step);
        }

        /// <summary>What of the largest energy that was put in is in the wire no more, where its ends did no
        /// work.</summary>
        public double FractionLost
        {
            get
            {
                double most = Math.Max(_maxPutIn, _start + _loadWork);
                return (_start + _loadWork - Motion() - Kept) / most;
            }
        }

        /// <summary>The wire as it is now is the start.</summary>
        public void Start()
        {
            _before.CopyFrom(_shape);
            _start = Motion() + Kept;
        }

        /// <summary>Writes or restores the energies so far. A reader's wire is placed already; where it is heavier or
        /// stiffer than the writer's was, the same motion in the same shape holds more, and that was put in.</summary>
        public void Serialize(Snapshot snapshot)
        {
            if (snapshot.IsStep)
            {
                SerializeWork(snapshot);
                _before.Serialize(snapshot);
                return;
            }
            double ownMotion = Motion();
            double ownElastic = _terms.StoredEnergy(_shape);
            double motion = ownMotion;
            double elastic = ownElastic;
            snapshot.Serialize(ref motion);
            snapshot.Serialize(ref elastic);
            SerializeWork(snapshot);
            if (!snapshot.IsWritten)
            {
                _start += Math.Max(0.0, ownMotion - motion) + Math.Max(0.0, ownElastic - elastic);
                _before.CopyFrom(_shape);
            }
        }

        // What the wire stores, and what its material has turned into heat, J.
        private double Kept => _terms.StoredEnergy(_shape) + (_terms.Fibres?.Loss ?? 0.0);

        private void SerializeWork(Snapshot snapshot)
        {
            snapshot.Serialize(ref _start);
            snapshot.Serialize(ref _loadWork);
            snapshot.Serialize(ref _maxPutIn);
            snapshot.Serialize(ref _step);
        }

        // T, J.
        private double Motion() => _inertia.KineticEnergy(_velocities, _spins);
    }
}
