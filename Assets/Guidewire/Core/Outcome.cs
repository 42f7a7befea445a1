namespace Guidewire.Core
{
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
