namespace Guidewire.Core
{
    /// <summary>Where a warning is told.</summary>
    public enum WarningPlace
    {
        /// <summary>Before the first step: it is about the parameters.</summary>
        Start,

        /// <summary>After the reason of a completed run, with ", but".</summary>
        Reason,

        /// <summary>The warning stands at the end of the run, on a line of its own.</summary>
        End,
    }
}
