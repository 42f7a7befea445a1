namespace Guidewire.Core
{
    /// <summary>One part of the energy that a rod's shape minimises: its value, its gradient and its second
    /// derivatives by blocks. Derivatives are taken along x_i + dx and q_j exp(dtheta_j), with dtheta along the
    /// element's own axes.</summary>
    /// <remarks>A term may couple x_i, theta_i, x_(i+1) and theta_i, theta_(i+1), which is what keeps the matrix block-
    /// tridiagonal: stretch, bending, weight, inertia; a sphere's contact touches one A block, an element's contact
    /// x_i and x_(i+1). Terms work on ranges, so that a long rod is assembled and eliminated while its blocks are in
    /// the cache. A load without a potential (a couple that turns with the tip) is entered by its work since <see
    /// cref="Anchor"/>. </remarks>
    internal abstract class EnergyTerm
    {
        /// <summary>The energy in J of the whole rod in this shape.</summary>
        public abstract double Value(RodShape shape);

        /// <summary>Adds the gradient of what belongs to indices from (inclusive) to to (exclusive).</summary>
        public abstract void AddGradient(RodShape shape, RodVector[] gradient, int from, int to);

        /// <summary>Adds gradient and second derivatives of what belongs to indices from (inclusive) to to (exclusive).
        /// Only blocks from .. to are touched, the last by what its predecessor leaves on it.</summary>
        public abstract void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to);

        /// <summary>Takes this shape as the point from which work is counted; nothing to do for a true
        /// energy.</summary>
        public virtual void Anchor(RodShape shape)
        {
        }
    }
}
