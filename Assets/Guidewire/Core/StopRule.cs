using static System.FormattableString;

namespace Guidewire.Core
{
    /// <summary>Decides after each step whether a run has ended, and with which outcome: by the report of the method
    /// (failed, diverged, steady state), a number that is not finite, the last step.</summary>
    internal sealed class StopRule
    {
        private readonly int _maxSteps;

        /// <param name="maxSteps">Steps after which the run is finished.</param>
        public StopRule(int maxSteps)
        {
            _maxSteps = maxSteps;
        }

        /// <summary>The first of the steps that make the steady state, or -1 before there is one.</summary>
        public int SteadyStateStep { get; private set; } = -1;

        /// <summary>One line that says why, once <see cref="Check"/> answers anything but Running.</summary>
        public string Reason { get; private set; } = "";

        /// <summary>The outcome after <paramref name="step"/> steps.</summary>
        public Outcome Check(RodState state, TimeStepper stepper, int step)
        {
            if (stepper.Failure != null)
            {
                return End(Outcome.Failed, stepper.Failure);
            }
            // A number that is not finite says more than what was made of it.
            string? loss = FindNotFinite(state, step) ?? stepper.Divergence;
            if (loss != null)
            {
                return End(Outcome.Diverged, loss);
            }
            if (stepper.SteadyState != null)
            {
                SteadyStateStep = step - stepper.SteadySteps + 1;
                return End(Outcome.Converged, stepper.SteadyState);
            }
            return step < _maxSteps ? Outcome.Running
                : End(Outcome.Finished, Invariant($"all {_maxSteps} steps are done"));
        }

        private Outcome End(Outcome outcome, string reason)
        {
            Reason = reason;
            return outcome;
        }

        /// <summary>What of a state is not a finite number, in one line, or null.</summary>
        public static string? FindNotFinite(RodState state, int step)
        {
            for (int i = 0; i < state.SphereCount; i++)
            {
                if (!state.Positions[i].IsFinite)
                {
                    return Invariant($"sphere {i} has no finite position at step {step}");
                }
                if (!state.Velocities[i].IsFinite)
                {
                    return Invariant($"sphere {i} has no finite velocity at step {step}");
                }
            }
            return null;
        }
    }

    /// <summary>How a run ended.</summary>
    public enum Outcome
    {
        /// <summary>It has not ended.</summary>
        Running,

        /// <summary>It reached a steady state.</summary>
        Converged,

        /// <summary>All its steps are done.</summary>
        Finished,

        /// <summary>The wire was lost.</summary>
        Diverged,

        /// <summary>A solver gave up, or the output was lost.</summary>
        Failed,

        /// <summary>It was stopped from outside.</summary>
        Interrupted,
    }
}
