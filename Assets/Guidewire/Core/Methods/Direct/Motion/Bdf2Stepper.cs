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
        public override void SerializeStep(Snapshot snapshot)
        {
            base.SerializeStep(snapshot);
            SerializeOwn(snapshot);
        }

        /// <inheritdoc/>
        public override void SerializeHistory(Snapshot snapshot, double time)
        {
            base.SerializeHistory(snapshot, time);
            SerializeOwn(snapshot);
        }

        private void SerializeOwn(Snapshot snapshot)
        {
            _history.Serialize(snapshot);
            snapshot.Serialize(ref _lastStep);
        }
    }
}
