namespace Guidewire.Core
{
    /// <summary>How a run with a material starts.</summary>
    public enum InitialState
    {
        /// <summary>The wire starts in its start shape, at rest.</summary>
        Straight,

        /// <summary>The wire starts in the rest shape under gravity, tip loads and supports, reached from the start
        /// shape; where that is straight and one end is free, from the shape that the rest curvature alone
        /// gives.</summary>
        Equilibrium,
    }
}
