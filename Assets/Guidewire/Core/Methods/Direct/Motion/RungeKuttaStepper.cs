using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Steps by a Runge-Kutta scheme, each of one or more stages. A time step is divided at jumps of loads
    /// whose times are known, at each row of a load's table, and where <see cref="StepControl"/> cuts.</summary>
    /// <remarks>An explicit first stage has the rates of the last one before; at the start and after a jump of a load
    /// or of a support those of <see cref="ConsistentStart"/>. Where these are more than a step can resolve (a support
    /// that was displaced at once, a wire far from its rest shape) the motion begins with a step of <see
    /// cref="RungeKuttaScheme.Start"/>, which brings what is stiff to rest; so does a step of which a stage has no
    /// solution.</remarks>
    internal sealed class RungeKuttaStepper : ImplicitStepper
    {
        private const double LargestStart = 0.5;   // radians, or L, by which rates at the start may move the rod
        private const double SameTime = ImplicitStage.SameTime;  // of a step
        private const double SamePosition = 1e-9;  // radians, or of L

        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly RodMotion _motion;
        private readonly RungeKuttaScheme _scheme;
        private readonly RungeKuttaScheme _starter = RungeKuttaScheme.Start();
        private readonly ConsistentStart _start;
        private readonly StepStart _partStart;
        private readonly double _length;
        private bool _hasRates;               // the last stage has the rates of the next step's start
        private Vector3d _proximalVelocity;   // of the supports in the last step, m/s
        private Vector3d _distalVelocity;

        /// <summary>A stepper of a rod under these terms.</summary>
        public RungeKuttaStepper(RungeKuttaScheme scheme, RodTerms terms, RodSchedule schedule, RodMotion motion)
            : base(new ImplicitStage(terms, schedule, motion, scheme.StageCount, scheme.IsFirstExplicit),
                new StepControl(scheme.EmbeddedOrder))
        {
            _scheme = scheme;
            _terms = terms;
            _schedule = schedule;
            _motion = motion;
            _start = new ConsistentStart(terms, Stage.Damping, Stage.Inner);
            _partStart = new StepStart(SerializeStep);
            _length = terms.Rod.TotalLength;
        }

        /// <inheritdoc/>
        public override bool HasErrorEstimate => _scheme.ErrorWeights != null;

        /// <inheritdoc/>
        public override double WeightSum => _scheme.WeightSum;

        /// <inheritdoc/>
        public override string Key => _scheme.StageCount + " stages "
            + _scheme.Diagonal.ToString("R", CultureInfo.InvariantCulture);

        /// <inheritdoc/>
        public override void Begin()
        {
            _proximalVelocity = _motion.Velocities[0];
            _distalVelocity = _motion.Velocities[_motion.Velocities.Length - 1];
        }

        /// <inheritdoc/>
        public override string? Step(double time, double dt)
        {
            Stage.Reactions.BeginStep();
            string? failure = StepBetweenJumps(time, dt);
            Stage.Reactions.EndStep(dt, false);
            return failure;
        }

        /// <inheritdoc/>
        public override void SerializeStep(Snapshot snapshot)
        {
            base.SerializeStep(snapshot);
            snapshot.Serialize(ref _hasRates);
            snapshot.Serialize(ref _proximalVelocity);
            snapshot.Serialize(ref _distalVelocity);
        }

        /// <inheritdoc/>
        public override void SerializeHistory(Snapshot snapshot, double time)
        {
            base.SerializeHistory(snapshot, time);
            snapshot.Serialize(ref _proximalVelocity);
            snapshot.Serialize(ref _distalVelocity);
            Control.SerializeLength(snapshot);
            // Rates are those of this rod under these loads; a reader on which other forces act starts again.
            _terms.SetTime(_schedule, time);
            double own = _start.CheckSum(_motion.Shape);
            double sum = own;
            snapshot.Serialize(ref sum);
            snapshot.Serialize(ref _hasRates);
            _hasRates &= sum == own;
        }

        private string? StepBetweenJumps(double time, double dt)
        {
            double nearly = SameTime * dt;
            double done = 0.0;
            while (done < dt)
            {
                double jump = _schedule.NextBreak(time + done + nearly);
                double until = jump - time < dt - nearly ? jump - time : dt;
                while (done < until)
                {
                    string? failure = StepPart(time, until, jump, dt, ref done);
                    if (failure != null)
                    {
                        return failure;
                    }
                }
            }
            return null;
        }

        /// <summary>One step of the scheme within a logged one.</summary>
        /// <param name="start">Of the logged step, s.</param>
        /// <param name="until">Where it may end at the latest, s after the logged step's start.</param>
        /// <param name="jump">The next jump of a load, s.</param>
        /// <param name="dt">The logged step, s.</param>
        /// <param name="done">Where it begins, and then where it ended.</param>
        private string? StepPart(double start, double until, double jump, double dt, ref double done)
        {
            double time = start + done;
            double left = until - done;
            double h = Control.Propose(left);
            bool isStart = _scheme.IsFirstExplicit && !TakeFirstRates(time, h, dt);
            RungeKuttaScheme used = isStart ? _starter : _scheme;
            if (_scheme.IsFirstExplicit)
            {
                _partStart.Save();
            }
            while (true)
            {
                string? failure = StepStages(used, time, h, jump, h / dt);
                double error = failure != null || used.ErrorWeights == null ? 0.0
                    : Stage.Rates.Error(used.ErrorWeights, h, _length);
                bool isKept = Control.Accepts(error, h, dt, failure == null);
                bool restarts = isKept && failure != null && _scheme.IsFirstExplicit && !isStart;
                if (isKept && !restarts)
                {
                    done = h == left ? until : done + h;
                    _hasRates = true;
                    Stage.HasPast = !isStart;
                    if (failure == null)
                    {
                        Stage.EndStep();
                    }
                    return failure;
                }
                _partStart.Restore();
                if (restarts)
                {
                    isStart = true;
                    used = _starter;
                    Stage.Forget();
                }
                else
                {
                    h = Control.Propose(left);
                }
            }
        }

        /// <summary>Sets the rates of an explicit first stage.</summary>
        /// <returns>False where they are more than a step of length h can resolve.</returns>
        private bool TakeFirstRates(double time, double h, double dt)
        {
            double after = time + SameTime * dt;
            StageRates rates = Stage.Rates;
            Vector3d proximal = _schedule.Hub.VelocityAt(after);
            Vector3d distal = _schedule.Distal.VelocityAt(after);
            bool isInPlace = _start.IsHeldAt(_motion.Shape, _schedule, time, SamePosition * _length)
                && Stage.Frames.AreInPlace(time, SamePosition);
            bool jumps = proximal != _proximalVelocity || distal != _distalVelocity;
            if (_hasRates && isInPlace && !jumps && _schedule.NextJump(time - SameTime * dt) > after)
            {
                rates.SetFirst(_motion.Velocities, _motion.Spins, true);
                Stage.Inner?.SetFirst(true);
                return true;
            }
            if (jumps || !_hasRates)
            {
                _start.Jump(_motion.Velocities, proximal, distal);
                Stage.Reactions.AddImpulse(_start.Forces, dt);
            }
            _proximalVelocity = proximal;
            _distalVelocity = distal;
            Stage.HasPast = false;
            Stage.BeginRates(after, h);
            double move = _start.SetRates(_motion.Shape, _motion.Spins, rates.Acceleration[0], rates.SpinRate[0]);
            if (!isInPlace || !(h * h * move <= LargestStart))
            {
                rates.Clear();
                Stage.Inner?.Clear();
                return false;
            }
            rates.SetFirst(_motion.Velocities, _motion.Spins, false);
            Stage.Inner?.SetFirst(false);
            Stage.Reactions.Take(_start.Forces);
            return true;
        }

        private string? StepStages(RungeKuttaScheme scheme, double time, double dt, double jump, double fraction)
        {
            Stage.BeginStep(time, dt);
            double[] final = scheme.Rows[scheme.StageCount - 1];
            int first = scheme.IsFirstExplicit ? 1 : 0;
            if (first > 0)
            {
                Stage.Reactions.AddStage(fraction * final[0]);
            }
            for (int s = first; s < scheme.StageCount; s++)
            {
                Stage.BeginStage(scheme.Rows[s], dt);
                StagePredictor predictor = Stage.HasPast ? scheme.Predictors[s] : StagePredictor.Of(Math.Max(s - 1, 0));
                // That of a start ends the step as the scheme's own last one does.
                int stage = s == scheme.StageCount - 1 ? _scheme.StageCount - 1 : s;
                string? failure = Stage.Solve(time + scheme.Times[s] * dt, jump, stage, predictor);
                if (failure != null)
                {
                    return failure;
                }
                Stage.Reactions.AddStage(fraction * final[s]);
            }
            Stage.Accept();
            return null;
        }
    }
}
