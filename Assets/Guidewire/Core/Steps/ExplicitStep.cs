using System;

namespace Guidewire.Core
{
    /// <summary>The material's forces with explicit steps: half a step of motion, velocities from the forces there, the
    /// other half (position Verlet, order 2), on lumped masses and the wire's own rotary inertia.</summary>
    /// <remarks>Stable below 2/omega_max. The largest frequency is that of elements turning against their shear,
    /// sqrt(GA/(rho I)) = 2 sqrt(G/rho)/r, however coarse the wire is.</remarks>
    internal sealed class ExplicitStep : ITimeStep, IReportingStep, IContactStep
    {
        private readonly MaterialScene _scene;
        private readonly RodStatics _statics;
        private readonly MaterialDrive _drive;
        private readonly NodalInertia _inertia;
        private readonly RodShape _shape;
        private readonly Vector3d[] _velocities;
        private readonly Vector3d[] _spins;
        private readonly RodVector[] _gradient;
        private readonly double _timeStep;
        private readonly int _substeps;
        private readonly double _kept;
        private double _time;

        /// <summary>A step for this scene.</summary>
        /// <param name="record">Takes the support's force after each step, or null.</param>
        public ExplicitStep(MaterialScene scene, RodStatics statics, MaterialDrive drive,
            SimulationParameters parameters, SolverReport report, ContactRecord? record)
        {
            _scene = scene;
            _statics = statics;
            _drive = drive;
            _inertia = new NodalInertia(scene.Rod, scene.Supports);
            _shape = scene.Shape;
            _velocities = scene.Velocities;
            _spins = scene.Spins;
            _gradient = new RodVector[_shape.ElementCount + 2];
            _timeStep = parameters.TimeStep;
            _substeps = parameters.Material.Substeps;
            _kept = Math.Pow(1.0 - parameters.Damping, 1.0 / _substeps);
            Report = report;
            Record = record;
        }

        /// <inheritdoc/>
        public double PredictionError { get; private set; }

        /// <inheritdoc/>
        public string? Failure => null;

        /// <inheritdoc/>
        public SolverReport Report { get; }

        /// <inheritdoc/>
        public ContactRecord? Record { get; }

        /// <inheritdoc/>
        public void Advance(RodState state)
        {
            int last = _shape.ElementCount;
            double h = _timeStep / _substeps;
            Vector3d free = _shape.X[last] + _timeStep * _velocities[last];
            _drive.Prepare(_shape, _time);
            Vector3d reaction = Vector3d.Zero;
            for (int k = 0; k < _substeps; k++)
            {
                double start = _time + k * h;
                Drift(0.5 * h, start + 0.5 * h);
                Kick(h, start + 0.5 * h);
                reaction += new Vector3d(_gradient[0].X1, _gradient[0].X2, _gradient[0].X3);
                Drift(0.5 * h, start + h);
            }
            _time += _timeStep;
            PredictionError = Vector3d.Distance(free, _shape.X[last]) / _scene.Metres;
            if (Record != null)
            {
                Record.Reaction = reaction / _substeps;
            }
            _scene.Write(state, _shape, _velocities, _spins);
        }

        /// <inheritdoc/>
        public void CompleteReport()
        {
            Report.Method = "explicit; stable below a substep of " + StableTimeStep(_scene.Rod).ToString("G4",
                System.Globalization.CultureInfo.InvariantCulture) + " s";
        }

        /// <summary>2/omega_max of the shear mode and of the axial chain, whichever is less, s.</summary>
        public static double StableTimeStep(MaterialRod rod)
        {
            double largest = 0.0;
            for (int j = 0; j < rod.ElementCount; j++)
            {
                double shear = rod.ShearStiffness[j] / rod.RotaryInertia[j];
                double l = rod.Length[j];
                double axial = 4.0 * rod.StretchStiffness[j] / (l * l * rod.LineDensity[j]);
                largest = Math.Max(largest, Math.Max(shear, axial));
            }
            return 2.0 / Math.Sqrt(largest);
        }

        private void Drift(double h, double time)
        {
            for (int i = 0; i < _velocities.Length; i++)
            {
                _shape.X[i] += h * _velocities[i];
            }
            for (int j = 0; j < _spins.Length; j++)
            {
                Quaterniond q = _shape.Q[j] * RotationVector.Exp(h * _spins[j]);
                _shape.Q[j] = (1.5 - 0.5 * q.LengthSquared) * q;
            }
            RodSchedule schedule = _scene.Schedule;
            schedule.TurnFrames(_shape, schedule.ProximalTurnAt(time), schedule.DistalTurnAt(time));
            if (_scene.Supports.Proximal != ProximalEnd.Free)
            {
                _shape.X[0] = schedule.ProximalPositionAt(time);
            }
            if (_scene.Supports.Distal != DistalEnd.Free)
            {
                _shape.X[_spins.Length] = schedule.DistalPositionAt(time);
            }
        }

        private void Kick(double h, double time)
        {
            int n = _spins.Length;
            _scene.Schedule.SetLoads(_scene.Rod, _scene.Supports.Mass, _statics.Loads, time);
            Array.Clear(_gradient, 0, _gradient.Length);
            _statics.Stretch.AddGradient(_shape, _gradient, 0, n + 1);
            _statics.Bending.AddGradient(_shape, _gradient, 0, n + 1);
            _statics.Loads.AddGradient(_shape, _gradient, 0, n + 1);
            _statics.Moment.AddGradient(_shape, _gradient, 0, n + 1);
            for (int i = 0; i <= n; i++)
            {
                ref RodVector g = ref _gradient[i];
                _velocities[i] = _kept * _velocities[i] - (h * _inertia.InverseMass[i]) * new Vector3d(g.X1, g.X2, g.X3);
                if (i < n)
                {
                    Vector3d w = _spins[i];
                    Vector3d inverse = _inertia.InverseInertia[i];
                    // I' = diag(1, 1, 2): w x I w over I is (w2 w3, -w1 w3, 0).
                    _spins[i] = _kept * w - h * new Vector3d(inverse.X * g.T1 + w.Y * w.Z, inverse.Y * g.T2 - w.X * w.Z,
                        inverse.Z * g.T3);
                }
            }
        }
    }
}
