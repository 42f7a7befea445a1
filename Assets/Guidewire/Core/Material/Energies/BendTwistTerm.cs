namespace Guidewire.Core
{
    /// <summary>Bending and twist, whatever the joints' law, with the couples that its clamps exert.</summary>
    internal abstract class BendTwistTerm : EnergyTerm
    {
        /// <summary>Couple of the proximal clamp on the rod, N m, along the world's axes; 0 without a clamp.</summary>
        public abstract Vector3d ProximalCouple(RodShape shape);

        /// <summary>Couple of the distal clamp on the rod, N m, along the world's axes; 0 without a clamp.</summary>
        public abstract Vector3d DistalCouple(RodShape shape);
    }
}
