using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>One step of extended position-based dynamics (Macklin 2016): the time step is divided into substeps,
    /// each a prediction and m iterations over all constraints with compliance.</summary>
    /// <remarks>Where the iterations have converged a substep is one of implicit Euler, whatever m is.
    ///
    /// Multipliers start from those of the last substep, not from 0, and move the wire before the first iteration, all
    /// in the predicted shape. There are two reasons. A wire at rest then needs no correction at all, so its shape does
    /// not depend on m. And an iteration from 0 passes through shapes in which the first joints already pull and the
    /// last do not yet: elements are turned by h^2 K theta/J in between, and their forces retain the directions that
    /// they had there. No number of iterations takes that out again; such forces have no potential, and a twisted ring
    /// that should hold left its plane at 0.96 of its critical twist. Multipliers that would turn an element, or shift
    /// a node over its length, by more than 0.1 belong to a wave that a substep does not resolve, and are dropped.
    ///
    /// Orientations carry the wire's own rotary inertia rho I l (2 rho I l about the axis), 4 (l/r)^2 times less than a
    /// sphere's mass times l^2: 1,600 times in an element 20 radii long. So bending, shear and twist move as they do
    /// under every other solver, and waves of twist run at sqrt(G/rho). What an element does against its own shear, at
    /// 2 sqrt(G/rho)/r, is too fast for a substep and is damped away, as implicit Euler does; it does not bound the
    /// substep. What bounds it is sound along the wire, because an iteration brings a correction one element back: on
    /// wires with l/r from 2 to 100 runs converge up to h sqrt(E/rho)/l = 0.5 with m = 1, 1 with 3, 2 with 10, and
    /// diverge soon after.
    ///
    /// Between walls <see cref="CompliantWalls"/> stands around each substep, and <see cref="CompliantContacts"/> has a
    /// part in every iteration.
    ///
    /// How far the iterations were from convergence is measured in substeps 1, 2, 4, 8 .. and the last of each step,
    /// each for the time since the one before, because what a step changes is over in its first substeps; see <see
    /// cref="ConvergenceRecord"/>.</remarks>
    internal sealed class CompliantStep : TimeStepper
    {
        private const double LargestStart = 0.1;    // radians, or of an element's length

        private readonly MaterialScene _scene;
        private readonly MaterialDrive _drive;
        private readonly RodTerms _terms;
        private readonly RodVector[] _loadGradient;
        private readonly NodalInertia _inertia;
        private readonly CompliantStretch _stretch;
        private readonly CompliantBendTwist _bendTwist;
        private readonly RodShape _shape;
        private readonly RodShape _old;
        private readonly Vector3d[] _velocities;
        private readonly Vector3d[] _spins;
        private readonly Vector3d[] _shift;
        private readonly Vector3d[] _turn;
        private readonly double _timeStep;
        private readonly double _remainingVelocity;
        private readonly int _substeps;
        private readonly int _iterations;
        private readonly DirectionError _directions;
        private readonly ConvergenceRecord _convergence;
        private readonly HeldEnds _ends;
        private readonly EnergyMonitor _energy;
        private readonly RestMonitor _rest;
        private readonly SolverReport _report;
        private readonly CompliantWalls? _walls;
        private readonly double _contactStiffness;    // N/m
        private Vector3d _supportForce;    // sum over the substeps, N
        private StressRecord? _stress;
        private Vector3d _predictedTip;
        private double _time;

        /// <summary>A step for this scene.</summary>
        /// <param name="contactStiffness">Of a contact, N/m; 0 for rigid ones.</param>
        public CompliantStep(MaterialScene scene, RodTerms terms, MethodParameters method,
            SolverReport report, double contactStiffness)
        {
            _scene = scene;
            _drive = scene.Drive;
            _terms = terms;
            _loadGradient = new RodVector[scene.Rod.ElementCount + 2];
            _inertia = new NodalInertia(terms.Mass, terms.Supports);
            _stretch = new CompliantStretch(scene.Rod, _inertia.InverseMass, _inertia.InverseInertia);
            _bendTwist = new CompliantBendTwist(scene.Rod, scene.Supports, _inertia.InverseInertia);
            _shape = scene.Shape;
            _old = new RodShape(_shape.ElementCount);
            _shift = new Vector3d[_shape.ElementCount + 1];
            _turn = new Vector3d[_shape.ElementCount];
            _velocities = scene.Velocities;
            _spins = scene.Spins;
            _timeStep = method.TimeStep;
            _remainingVelocity = Math.Exp(-scene.Rod.MassDamping * method.TimeStep / method.Substeps);
            _substeps = method.Substeps;
            _iterations = method.ConstraintSolverSteps;
            _contactStiffness = contactStiffness;
            _walls = scene.Walls.Length > 0 ? new CompliantWalls(scene, _inertia, contactStiffness) : null;
            _directions = new DirectionError(scene, _inertia, _stretch, _bendTwist, _walls?.Contacts);
            _convergence = new ConvergenceRecord(scene.Rod.TotalLength);
            _ends = new HeldEnds(terms, scene.Schedule);
            _energy = new EnergyMonitor(terms, _inertia, _shape, _velocities, _spins, _ends);
            _rest = new RestMonitor(scene, terms, _velocities, _spins, method, _walls == null ? null
                : new ContactLoads(_walls.Contacts, scene.Rod, contactStiffness, _timeStep / _substeps));
            _report = report;
        }

        /// <inheritdoc/>
        public override string? AccuracyWarning => _convergence.Warning;

        /// <inheritdoc/>
        public override ContactRecord? Contacts => _walls?.Record;

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            double h = _timeStep / _substeps;
            var residual = default(IterationResidual);
            int measured = 0;
            _drive.Prepare(_shape, _time);
            _ends.Carry(_scene.Schedule.Hub.Velocity.Length, Math.Abs(_scene.Schedule.Hub.TwistRate));
            Vector3d start = _shape.X[0];
            Vector3d velocity = _velocities[0];
            _supportForce = Vector3d.Zero;
            _walls?.BeginStep(_shape);
            for (int k = 1; k <= _substeps; k++)
            {
                bool isMeasured = k == _substeps || (k & (k - 1)) == 0;
                Substep(_time + k * h, h, isMeasured);
                if (isMeasured)
                {
                    residual.Include(Residual(h), (k - measured) / (double)_substeps);
                    measured = k;
                }
            }
            _time += _timeStep;
            _convergence.Add(residual);
            Divergence = _energy.Blowup();
            if (Divergence != null)
            {
                // The state stays that of the step before, and so does what contact and drive came to.
                Divergence += "; raise substeps or constraintSolverSteps";
                return;
            }
            if (_walls != null)
            {
                EndStep(_walls, h, start, velocity);
            }
            Failure = _scene.Joints.FindLost(_shape, _time);
            SteadyState = _rest.FindRest(_time);
            PredictionError = Vector3d.Distance(_predictedTip, _shape.X[_shape.ElementCount]) / _scene.Metres;
            _scene.Write(state, _shape, _velocities, _spins);
        }

        // Between walls: forces, and the displacement of node 0 that the drive asked for and walls prevented.
        private void EndStep(CompliantWalls walls, double h, in Vector3d start, in Vector3d velocity)
        {
            walls.EndStep(h, _substeps);
            if (_scene.Supports.Proximal == ProximalEnd.Free)
            {
                return;
            }
            ContactRecord record = walls.Record;
            Vector3d inertia = (_terms.Mass.Nodal[0] / _timeStep) * (_velocities[0] - velocity);
            record.Reaction = inertia + (1.0 / _substeps) * _supportForce - record.Forces[0];
            // A drive continues from where node 0 is; a held node is asked for until it has arrived.
            Vector3d position = _scene.Schedule.Hub.PositionAt(_time);
            if (_drive.Axis == Vector3d.Zero)
            {
                double owed = record.DriveShortfall;
                record.AddDrive(Vector3d.Distance(position, start) / _scene.Metres - owed,
                    Vector3d.Distance(position, _shape.X[0]) / _scene.Metres - owed);
                return;
            }
            // Of the displacement of node 0 only the component along the drive counts: walls may move it aside.
            double asked = _drive.Asked / _scene.Metres;
            record.AddDrive(asked, asked - _drive.Gone(start, _shape.X[0]) / _scene.Metres);
        }

        /// <inheritdoc/>
        public override StressRecord? Stress()
        {
            _stress ??= new StressRecord(_scene.Rod, _scene.Supports);
            _terms.SetTime(_scene.Schedule, _time);
            _stress.Take(_terms, _shape, _inertia.KineticEnergy(_velocities, _spins));
            return _stress;
        }

        /// <inheritdoc/>
        public override SolverReport? Report()
        {
            _report.Method = "Gauss-Seidel with compliance; each substep is one of implicit Euler where it has"
                + " converged";
            _report.LargestError = _convergence.LargestError;
            _report.StepsNotConverged = _convergence.StepsAbove;
            _report.ContactStiffness = _walls == null || _contactStiffness == 0.0 ? double.NaN : _contactStiffness;
            return _report;
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            MaterialSnapshot.Serialize(snapshot, _scene.Schedule, _shape, _velocities, _spins, ref _time);
            _ends.SerializeTurns(snapshot);
            int walls = _scene.Walls.Length;
            if (!snapshot.Section(walls == 0 ? "xpbd" : "xpbd, walls " + walls, SerializeOwn))
            {
                _energy.Start();
            }
        }

        private void SerializeOwn(Snapshot snapshot)
        {
            _terms.Serialize(snapshot);
            _energy.Serialize(snapshot);
            _ends.SerializeWork(snapshot);
            _convergence.Serialize(snapshot);
            _rest.Serialize(snapshot);
            _report.Serialize(snapshot);
            _walls?.Serialize(snapshot);
            // A multiplier is a force times h^2.
            snapshot.Section((_timeStep / _substeps).ToString("R", CultureInfo.InvariantCulture), SerializeMultipliers);
        }

        private void SerializeMultipliers(Snapshot snapshot)
        {
            _stretch.Serialize(snapshot);
            _bendTwist.Serialize(snapshot);
            _walls?.Contacts.Serialize(snapshot);
        }

        private void Substep(double time, double h, bool isMeasured)
        {
            int last = _shape.ElementCount;
            _old.CopyFrom(_shape);
            _terms.SetTime(_scene.Schedule, time);
            Array.Clear(_loadGradient, 0, _loadGradient.Length);
            _terms.AddLoadGradient(_shape, _loadGradient);
            for (int i = 0; i <= last; i++)
            {
                ref RodVector g = ref _loadGradient[i];
                _velocities[i] = _remainingVelocity * _velocities[i]
                    - (h * _inertia.InverseMass[i]) * new Vector3d(g.X1, g.X2, g.X3);
                if (_inertia.InverseMass[i] > 0.0)
                {
                    _shape.X[i] += h * _velocities[i];
                }
            }
            for (int j = 0; j < last; j++)
            {
                ref RodVector g = ref _loadGradient[j];
                Vector3d inverse = _inertia.InverseInertia[j];
                _spins[j] = _remainingVelocity * _spins[j]
                    - h * new Vector3d(inverse.X * g.T1, inverse.Y * g.T2, inverse.Z * g.T3);
                _shape.Q[j] = Quaterniond.Normalize(_shape.Q[j] * RotationVector.Exp(h * _spins[j]));
            }
            _ends.Place(_shape, time);
            _predictedTip = _shape.X[last];
            if (isMeasured)
            {
                _directions.Begin(_shape);
            }
            _walls?.BeginSubstep(_old, _shape, h);
            StartFromMultipliers();
            for (int m = 0; m < _iterations; m++)
            {
                _stretch.Iterate(_shape, h);
                _bendTwist.Iterate(_shape, h);
                _walls?.Contacts.Iterate(_shape);
            }
            if (_walls != null)
            {
                _walls.EndSubstep(_shape);
                RodVector g = _loadGradient[0];
                _supportForce += new Vector3d(g.X1, g.X2, g.X3) + (1.0 / (h * h)) * _stretch.FirstMultiplier(_shape);
            }
            double rate = 1.0 / h;
            for (int i = 0; i <= last; i++)
            {
                _velocities[i] = rate * (_shape.X[i] - _old.X[i]);
            }
            for (int j = 0; j < last; j++)
            {
                _spins[j] = rate * RotationVector.Log(_old.Q[j].Conjugate * _shape.Q[j]);
            }
        }

        private IterationResidual Residual(double h)
        {
            var sum = default(IterationResidual);
            _stretch.AddResidual(_shape, h, ref sum);
            _bendTwist.AddResidual(_shape, h, ref sum);
            _walls?.Contacts.AddResidual(_shape, ref sum);
            _directions.Add(_shape, h, ref sum);
            return sum;
        }

        private void StartFromMultipliers()
        {
            Array.Clear(_shift, 0, _shift.Length);
            Array.Clear(_turn, 0, _turn.Length);
            _stretch.AddMotion(_shape, _shift, _turn);
            _bendTwist.AddMotion(_shape, _turn);
            _walls?.Contacts.AddMotion(_shape, _shift, _turn);
            double largest = 0.0;
            double[] length = _scene.Rod.Length;
            for (int j = 0; j < _turn.Length; j++)
            {
                largest = Math.Max(largest, _turn[j].LengthSquared);
                largest = Math.Max(largest, _shift[j + 1].LengthSquared / (length[j] * length[j]));
            }
            if (!(largest < LargestStart * LargestStart))
            {
                _stretch.Reset();
                _bendTwist.Reset();
                _walls?.Contacts.Reset();
                return;
            }
            for (int i = 0; i < _shift.Length; i++)
            {
                _shape.X[i] += _shift[i];
            }
            for (int j = 0; j < _turn.Length; j++)
            {
                _shape.Q[j] = Quaterniond.Normalize(_shape.Q[j] * RotationVector.Exp(_turn[j]));
            }
        }
    }
}
