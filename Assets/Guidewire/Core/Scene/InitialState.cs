namespace Guidewire.Core
{
    /// <summary>How a run with a material starts.</summary>
    public enum InitialState
    {
        /// <summary>In its start shape, at rest.</summary>
        Straight,

        /// <summary>In the rest shape under gravity, tip loads and supports, reached from the start shape.</summary>
        Equilibrium,
    }
}
