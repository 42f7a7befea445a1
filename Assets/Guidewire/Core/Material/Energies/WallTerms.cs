namespace Guidewire.Core
{
    /// <summary>What walls add to a wire's energy: their barriers, and the spring on which node 0 then follows its
    /// support.</summary>
    internal sealed class WallTerms
    {
        /// <summary>Those of a rod.</summary>
        /// <param name="holdsStart">Whether a support holds node 0.</param>
        public WallTerms(BarrierEnergy barrier, SupportSpring spring, bool holdsStart)
        {
            Barrier = barrier;
            Spring = spring;
            All = holdsStart ? new EnergyTerm[] { barrier, spring } : new EnergyTerm[] { barrier };
            HoldsStart = holdsStart;
        }

        /// <summary>Contact.</summary>
        public BarrierEnergy Barrier { get; }

        /// <summary>The spring; of no effect where nothing holds node 0.</summary>
        public SupportSpring Spring { get; }

        /// <summary>Whether a support holds node 0.</summary>
        public bool HoldsStart { get; }

        /// <summary>Force of the support on node 0, N.</summary>
        public Vector3d SupportForce(RodShape shape)
        {
            return HoldsStart ? Spring.Force(shape) : Vector3d.Zero;
        }

        /// <summary>The terms that act.</summary>
        public EnergyTerm[] All { get; }
    }
}
