namespace Guidewire.Core
{
    /// <summary>A step that is not sound of itself: small steps or few sweeps may leave the wire wrong, or blow it
    /// up.</summary>
    internal interface IWatchedStep
    {
        /// <summary>How the last step lost the wire, in one line, or null. The state is that of the step
        /// before.</summary>
        string? Divergence { get; }

        /// <summary>What is wrong with the steps so far, and what helps, in one line, or null.</summary>
        string? Doubt { get; }
    }
}
