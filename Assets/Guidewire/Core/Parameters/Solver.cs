namespace Guidewire.Core
{
    /// <summary>What holds the wire together. The first takes pbd stiffness per iteration, the others a
    /// material.</summary>
    public enum Solver
    {
        /// <summary>Gauss-Seidel with pbd stiffness (the thesis).</summary>
        Pbd,

        /// <summary>Gauss-Seidel with compliance, multipliers and substeps (Macklin 2016).</summary>
        Xpbd,

        /// <summary>Newton's method over the whole rod, block-tridiagonal.</summary>
        Direct,

        /// <summary>Forces and explicit steps.</summary>
        Explicit,
    }
}
