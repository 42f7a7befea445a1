namespace Guidewire.Core
{
    /// <summary>Steps by BDF2, each one implicit stage; the first, and the first of another length, is one of implicit
    /// Euler.</summary>
    internal sealed class Bdf2Stepper : ImplicitStepper
    {
        private readonly Bdf2History _history;
        private double _lastStep;  // s

        /// <summary>Makes a stepper of a rod under these terms.</summary>
        public Bdf2Stepper(RodTerms terms, RodSchedule schedule, RodMotion motion)
            : base(new ImplicitStage(terms, schedule, motion, 1, false), new StepControl(1))
        {
            _history = new Bdf2History(motion.Shape);
        }

        /// <inheritdoc/>
        public override string Key => "BDF2";

        /// <inheritdoc/>
        public override void Begin() => _history.Forget();

        /// <inheritdoc/>
        public override string? Step(in Interval interval)
        {
            double dt = interval.Length;
            if (dt != _lastStep)
            {
                _history.Forget();
                _lastStep = dt;
            }
            Stage.BeginStep(interval.Start, dt);
            Stage.BeginStage(_history, dt);
            string? failure = Stage.Solve(interval.Start + dt, double.PositiveInfinity, 0,
                Stage.HasPast ? StagePredictor.OneStage : StagePredictor.Of(0));
            if (failure == null)
            {
                Stage.Reactions.AddStage(interval.Fraction);
                Stage.Accept();
                Stage.EndStep();
                Stage.HasPast = true;
                _history.Complete();
            }
            return failure;
        }

        /// <inheritdoc/>
        public override void Remesh()
        {
            base.Remesh();
            _history.Forget();
            _lastStep = 0.0;
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            base.Serialize(snapshot);
            _history.Serialize(snapshot);
            snapshot.Serialize(ref _lastStep);
        }
    }

    /// <summary>State of a rod one step ago, for BDF2: y = 4/3 y_0 - 1/3 y_-1 + 2/3 dt y'. The first step is one of
    /// implicit Euler.</summary>
    internal sealed class Bdf2History
    {
        private readonly Vector3d[] _positions;
        private readonly Vector3d[] _velocities;
        private readonly Quaterniond[] _orientations;
        private readonly Vector3d[] _spins;
        private readonly RodShape _shape;    // of the rod
        private bool _isComplete;

        /// <summary>Makes an empty history of a rod.</summary>
        public Bdf2History(RodShape shape)
        {
            _shape = shape;
            _positions = new Vector3d[shape.X.Length];
            _velocities = new Vector3d[shape.X.Length];
            _orientations = new Quaterniond[shape.Q.Length];
            _spins = new Vector3d[shape.Q.Length];
        }

        /// <summary>Whether there is a step before the one that began last.</summary>
        public bool IsComplete => _isComplete;

        /// <summary>The next step is the first.</summary>
        public void Forget() => _isComplete = false;

        /// <summary>A step has been done: what <see cref="Prepare"/> took is its start.</summary>
        public void Complete() => _isComplete = true;

        /// <summary>Sets what a step of dt has from the two steps before it, and takes its start as history.</summary>
        /// <param name="inertia">Its step has begun; receives the stage.</param>
        /// <param name="velocityHistory">Receives v^, m/s.</param>
        /// <returns>h, the length of the step's one stage, s.</returns>
        public double Prepare(InertiaEnergy inertia, Vector3d[] positions, Vector3d[] velocities, Vector3d[] spins,
            Vector3d[] velocityHistory, double dt)
        {
            double h = _isComplete ? 2.0 / 3.0 * dt : dt;
            inertia.StageLength = h;
            for (int i = 0; i <= _shape.ElementCount; i++)
            {
                Vector3d x = positions[i];
                Vector3d v = velocities[i];
                if (_isComplete)
                {
                    x = (4.0 / 3.0) * x - (1.0 / 3.0) * _positions[i];
                    v = (4.0 / 3.0) * v - (1.0 / 3.0) * _velocities[i];
                }
                velocityHistory[i] = v;
                inertia.FreePositions[i] = x + h * v;
                _positions[i] = positions[i];
                _velocities[i] = velocities[i];
            }
            for (int j = 0; j < _shape.ElementCount; j++)
            {
                Vector3d turn = Vector3d.Zero;
                Vector3d spin = spins[j];
                if (_isComplete)
                {
                    Vector3d back = RotationVector.Log(inertia.Start[j].Conjugate * _orientations[j]);
                    turn = (-1.0 / 3.0) * RotationVector.Nearest(back, -0.5 * dt * (spins[j] + _spins[j]));
                    spin = (4.0 / 3.0) * spin - (1.0 / 3.0) * _spins[j];
                }
                inertia.TurnHistory[j] = turn;
                inertia.SpinHistory[j] = spin;
                _orientations[j] = inertia.Start[j];
                _spins[j] = spins[j];
            }
            return h;
        }

        /// <summary>Writes or restores the step before.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _isComplete);
            snapshot.Serialize(_positions, _shape.ElementCount + 1);
            snapshot.Serialize(_velocities, _shape.ElementCount + 1);
            snapshot.Serialize(_orientations, _shape.ElementCount);
            snapshot.Serialize(_spins, _shape.ElementCount);
        }
    }
}
