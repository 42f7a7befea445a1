namespace Guidewire.Core
{
    /// <summary>How an element's mass acts on its two nodes.</summary>
    public enum MassRule
    {
        /// <summary>Velocity linear along the element: rho A l times 1/3 on each node, 1/6 between them.</summary>
        Consistent,

        /// <summary>Half of each element's mass on either node.</summary>
        Lumped,

        /// <summary>The whole mass spread evenly over the n+1 nodes (thesis, eq. 3.2).</summary>
        Uniform,
    }
}
