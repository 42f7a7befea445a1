using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Intervals by a Runge-Kutta scheme, each of one or more stages. None goes beyond a jump of a load whose
    /// time is known, nor beyond a row of a load's table.</summary>
    /// <remarks>An explicit first stage has the rates of the last one before; at the start and after a jump of a load
    /// or of a support those of <see cref="ConsistentStart"/>. Where these are more than a step can resolve (a support
    /// that was displaced at once, a wire far from its rest shape) the motion begins with a step of <see
    /// cref="RungeKuttaScheme.Start"/>, which brings what is stiff to rest; so does an interval of which a stage has no
    /// solution.</remarks>
    internal sealed class RungeKuttaStepper : ImplicitStepper
    {
        private const double LargestStart = 0.5;   // radians, or L, by which rates at the start may move the rod
        private const double SamePosition = 1e-9;  // radians, or of L

        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly RodMotion _motion;
        private readonly RungeKuttaScheme _scheme;
        private readonly RungeKuttaScheme _starter = RungeKuttaScheme.Start();
        private readonly ConsistentStart _start;
        private bool _hasRates;               // the last stage has the rates of the next step's start
        private Vector3d _proximalVelocity;   // of the supports in the last step, m/s
        private Vector3d _distalVelocity;

        /// <summary>Makes a stepper of a rod under these terms.</summary>
        public RungeKuttaStepper(RungeKuttaScheme scheme, RodTerms terms, RodSchedule schedule, RodMotion motion)
            : base(new ImplicitStage(terms, schedule, motion, scheme.StageCount, scheme.IsFirstExplicit),
                new StepControl(scheme.EmbeddedOrder))
        {
            _scheme = scheme;
            _terms = terms;
            _schedule = schedule;
            _motion = motion;
            _start = new ConsistentStart(terms, Stage.Damping, Stage.Inner);
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
            _distalVelocity = _motion.Velocities[_motion.Shape.ElementCount];
        }

        /// <inheritdoc/>
        public override bool StopsAtJumps => true;

        /// <inheritdoc/>
        public override string? Step(in Interval interval)
        {
            bool isStart = _scheme.IsFirstExplicit && (!InitialiseRates(interval) || interval.IsRestarted);
            if (interval.IsRestarted)
            {
                Stage.Forget();
            }
            MayRestart = _scheme.IsFirstExplicit && !isStart;
            RungeKuttaScheme used = isStart ? _starter : _scheme;
            double time = interval.Start;
            double dt = interval.Length;
            Stage.BeginStep(time, dt);
            double[] final = used.Rows[used.StageCount - 1];
            int first = used.IsFirstExplicit ? 1 : 0;
            if (first > 0)
            {
                Stage.Reactions.AddStage(interval.Fraction * final[0]);
            }
            for (int s = first; s < used.StageCount; s++)
            {
                Stage.BeginStage(used.Rows[s], dt);
                StagePredictor predictor = Stage.HasPast ? used.Predictors[s] : StagePredictor.Of(Math.Max(s - 1, 0));
                // That of a start ends the step as the scheme's own last one does.
                int stage = s == used.StageCount - 1 ? _scheme.StageCount - 1 : s;
                string? failure = Stage.Solve(time + used.Times[s] * dt, interval.Jump, stage, predictor);
                if (failure != null)
                {
                    return failure;
                }
                Stage.Reactions.AddStage(interval.Fraction * final[s]);
            }
            Stage.Accept();
            Error = used.ErrorWeights == null ? 0.0
                : Stage.Rates.Error(used.ErrorWeights, dt, _terms.Rod.TotalLength);
            _hasRates = true;
            Stage.HasPast = !isStart;
            Stage.EndStep();
            return null;
        }

        /// <inheritdoc/>
        public override void Remesh()
        {
            base.Remesh();
            _hasRates = false;
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            base.Serialize(snapshot);
            snapshot.Serialize(ref _proximalVelocity);
            snapshot.Serialize(ref _distalVelocity);
            if (snapshot.IsStep)
            {
                snapshot.Serialize(ref _hasRates);
                return;
            }
            Control.Serialize(snapshot);
            // Rates are those of this rod under these loads; a reader on which other forces act starts again.
            _terms.SetTime(_schedule, Stage.Frames.Time);
            double own = _start.CheckSum(_motion.Shape);
            double sum = own;
            snapshot.Serialize(ref sum);
            snapshot.Serialize(ref _hasRates);
            _hasRates &= sum == own;
        }

        /// <summary>Sets the rates of an explicit first stage.</summary>
        /// <returns>False where they are more than the interval can resolve.</returns>
        private bool InitialiseRates(in Interval interval)
        {
            double time = interval.Start;
            double h = interval.Length;
            double after = time + interval.Nearly;
            StageRates rates = Stage.Rates;
            Vector3d proximal = _schedule.Hub.VelocityAt(after);
            Vector3d distal = _schedule.Distal.VelocityAt(after);
            bool isInPlace = _start.IsHeldAt(_motion.Shape, _schedule, time,
                SamePosition * _terms.Rod.TotalLength)
                && Stage.Frames.AreInPlace(time, SamePosition);
            bool jumps = proximal != _proximalVelocity || distal != _distalVelocity;
            if (_hasRates && isInPlace && !jumps && _schedule.NextJump(time - interval.Nearly) > after)
            {
                rates.SetFirst(_motion.Velocities, _motion.Spins, true);
                Stage.Inner.SetFirst(true);
                return true;
            }
            if (jumps || !_hasRates)
            {
                _start.Jump(_motion.Velocities, proximal, distal);
                Stage.Reactions.AddImpulse(_start.Forces, interval.StepLength);
            }
            _proximalVelocity = proximal;
            _distalVelocity = distal;
            Stage.HasPast = false;
            Stage.BeginRates(after, h);
            double move = _start.SetRates(_motion.Shape, _motion.Spins, rates.Acceleration[0], rates.SpinRate[0]);
            if (!isInPlace || !(h * h * move <= LargestStart))
            {
                rates.Clear();
                Stage.Inner.Clear();
                return false;
            }
            rates.SetFirst(_motion.Velocities, _motion.Spins, false);
            Stage.Inner.SetFirst(false);
            Stage.Reactions.Record(_start.Forces);
            return true;
        }
    }
}
