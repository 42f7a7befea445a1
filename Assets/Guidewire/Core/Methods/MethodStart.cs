namespace Guidewire.Core
{
    /// <summary>A run as built by a method, before its first step.</summary>
    internal sealed class MethodStart
    {
        /// <summary>A wire and what steps it.</summary>
        public MethodStart(RodState state, TimeStepper stepper)
        {
            State = state;
            Stepper = stepper;
        }

        /// <summary>The wire at its start.</summary>
        public RodState State { get; }

        /// <summary>What steps the wire.</summary>
        public TimeStepper Stepper { get; }

        /// <summary>Why there is no start, in one line, or null.</summary>
        public string? Failure { get; set; }

        /// <summary>Whether the wire starts in its rest shape.</summary>
        public bool IsAtRest { get; set; }
    }
}
