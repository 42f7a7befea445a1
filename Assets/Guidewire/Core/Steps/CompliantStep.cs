using System;

namespace Guidewire.Core
{
    /// <summary>One step of extended position-based dynamics (Macklin 2016): the time step is divided into substeps,
    /// each a prediction and m sweeps over all constraints with compliance, whose multipliers start at 0.</summary>
    /// <remarks>Where the sweeps have converged a substep is one of implicit Euler, whatever m is. Orientations carry
    /// the wire's own rotary inertia rho I l (2 rho I l about the axis), 400 to 4,000 times less than a sphere's mass
    /// times l^2: twist then moves as it should, but a correction runs along the wire one element a sweep, and the
    /// light orientations follow their neighbours instead of pulling them, so that many sweeps or many substeps are
    /// needed. A step counts as converged where what the sweeps have still to correct, estimated from the ratio of the
    /// last two, is below 1 % of the motion in the substep; with fewer than three sweeps this is not known and counts
    /// as not converged.</remarks>
    internal sealed class CompliantStep : ITimeStep, IReportingStep
    {
        private const double ConvergedShare = 0.01;
        private const double Rounding = 1e-12;  // radians, or of L: corrections this small say nothing of convergence

        private readonly MaterialScene _scene;
        private readonly MaterialDrive _drive;
        private readonly DeadLoads _loads;
        private readonly NodalInertia _inertia;
        private readonly CompliantStretch _stretch;
        private readonly CompliantBendTwist _bendTwist;
        private readonly RodShape _shape;
        private readonly RodShape _old;
        private readonly Vector3d[] _velocities;
        private readonly Vector3d[] _spins;
        private readonly double _timeStep;
        private readonly double _kept;
        private readonly int _substeps;
        private readonly int _sweeps;
        private readonly double _length;
        private double _time;

        /// <summary>A step for this scene.</summary>
        /// <param name="sweeps">m, sweeps a substep.</param>
        public CompliantStep(MaterialScene scene, MaterialDrive drive, SimulationParameters parameters, int sweeps,
            SolverReport report)
        {
            _scene = scene;
            _drive = drive;
            _loads = new DeadLoads(scene.Rod.ElementCount);
            _inertia = new NodalInertia(scene.Rod, scene.Supports);
            _stretch = new CompliantStretch(scene.Rod, _inertia.InverseMass, _inertia.InverseInertia);
            _bendTwist = new CompliantBendTwist(scene.Rod, scene.Supports, _inertia.InverseInertia);
            _shape = scene.Shape;
            _old = new RodShape(_shape.ElementCount);
            _velocities = scene.Velocities;
            _spins = scene.Spins;
            _timeStep = parameters.TimeStep;
            _kept = Math.Pow(1.0 - parameters.Damping, 1.0 / parameters.Material.Substeps);
            _substeps = parameters.Material.Substeps;
            _sweeps = sweeps;
            _length = scene.Rod.TotalLength;
            Report = report;
            Report.LargestError = 0.0;
        }

        /// <inheritdoc/>
        public double PredictionError { get; private set; }

        /// <inheritdoc/>
        public string? Failure => null;

        /// <inheritdoc/>
        public SolverReport Report { get; }

        /// <inheritdoc/>
        public void Advance(RodState state)
        {
            double h = _timeStep / _substeps;
            double error = 0.0;
            _drive.Prepare(_shape, _time);
            for (int k = 1; k <= _substeps; k++)
            {
                error = Math.Max(error, Substep(_time + k * h, h));
            }
            _time += _timeStep;
            Report.LargestError = Math.Max(Report.LargestError, error);
            if (!(error <= ConvergedShare))
            {
                Report.StepsNotConverged++;
            }
            _scene.Write(state, _shape, _velocities, _spins);
        }

        /// <inheritdoc/>
        public void CompleteReport()
        {
            Report.Method = "Gauss-Seidel with compliance; each substep is one of implicit Euler where it has converged";
        }

        private double Substep(double time, double h)
        {
            int last = _shape.ElementCount;
            _old.CopyFrom(_shape);
            _scene.Schedule.SetLoads(_scene.Rod, _scene.Supports.Mass, _loads, time);
            for (int i = 0; i <= last; i++)
            {
                _velocities[i] = _kept * _velocities[i] + (h * _inertia.InverseMass[i]) * _loads.Force[i];
                if (_inertia.InverseMass[i] > 0.0)
                {
                    _shape.X[i] += h * _velocities[i];
                }
            }
            for (int j = 0; j < last; j++)
            {
                _spins[j] = _kept * _spins[j];
                _shape.Q[j] = Quaterniond.Normalize(_shape.Q[j] * RotationVector.Exp(h * _spins[j]));
            }
            PlaceEnds(time);
            Vector3d predictedTip = _shape.X[last];
            double error = Sweep(h);
            PredictionError = Vector3d.Distance(predictedTip, _shape.X[last]) / _scene.Metres;
            double motion = Rounding;
            double rate = 1.0 / h;
            for (int i = 0; i <= last; i++)
            {
                Vector3d d = _shape.X[i] - _old.X[i];
                _velocities[i] = rate * d;
                motion = Math.Max(motion, d.Length / _length);
            }
            for (int j = 0; j < last; j++)
            {
                Vector3d turn = RotationVector.Log(_old.Q[j].Conjugate * _shape.Q[j]);
                _spins[j] = rate * turn;
                motion = Math.Max(motion, turn.Length);
            }
            return error / motion;
        }

        private double Sweep(double h)
        {
            double size = 0.0;
            double before = 0.0;
            _stretch.Reset();
            _bendTwist.Reset();
            for (int m = 0; m < _sweeps; m++)
            {
                before = size;
                size = 0.0;
                _stretch.Sweep(_shape, h, _length, ref size);
                _bendTwist.Sweep(_shape, h, ref size);
            }
            if (_sweeps < 3)
            {
                return double.PositiveInfinity;
            }
            if (size < Rounding)
            {
                return size;
            }
            double ratio = size / before;
            return ratio < 1.0 ? size * ratio / (1.0 - ratio) : double.PositiveInfinity;
        }

        private void PlaceEnds(double time)
        {
            RodSchedule schedule = _scene.Schedule;
            schedule.TurnFrames(_shape, schedule.ProximalTurnAt(time), schedule.DistalTurnAt(time));
            if (_scene.Supports.Proximal != ProximalEnd.Free)
            {
                _shape.X[0] = schedule.ProximalPositionAt(time);
            }
            if (_scene.Supports.Distal != DistalEnd.Free)
            {
                _shape.X[_shape.ElementCount] = schedule.DistalPositionAt(time);
            }
        }
    }
}
