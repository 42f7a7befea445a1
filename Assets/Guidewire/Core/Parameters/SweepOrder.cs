namespace Guidewire.Core
{
    /// <summary>The order in which one Gauss-Seidel iteration visits the rod elements.</summary>
    public enum SweepOrder
    {
        /// <summary>Elements are swept from sphere 0 to the last.</summary>
        Naive,

        /// <summary>Alternately from both ends inwards (Kugelstadt and Schoemer 2016, section 5).</summary>
        Bilateral,
    }
}
