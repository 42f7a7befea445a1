namespace Guidewire.Core
{
    /// <summary>A way to share a wire's mass out, as far as the energy of its motion goes.</summary>
    internal interface IKineticEnergy
    {
        /// <summary>Kinetic energy, J.</summary>
        /// <param name="velocities">Of the n+1 nodes, m/s.</param>
        /// <param name="spins">Of the n elements along their own axes, rad/s.</param>
        double KineticEnergy(Vector3d[] velocities, Vector3d[] spins);
    }
}
