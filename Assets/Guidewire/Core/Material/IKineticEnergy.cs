namespace Guidewire.Core
{
    /// <summary>A distribution of a wire's mass, for its kinetic energy.</summary>
    internal interface IKineticEnergy
    {
        /// <summary>Gives the kinetic energy, J.</summary>
        /// <param name="velocities">Of the n+1 nodes, m/s.</param>
        /// <param name="spins">Of the n elements along their own axes, rad/s.</param>
        double KineticEnergy(Vector3d[] velocities, Vector3d[] spins);
    }
}
