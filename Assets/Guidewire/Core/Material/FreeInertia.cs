namespace Guidewire.Core
{
    /// <summary>Kinetic energy, by the mass matrix, of the free nodes only: the speed of a support is
    /// prescribed.</summary>
    internal sealed class FreeInertia : IKineticEnergy
    {
        private readonly RodMass _mass;
        private readonly int _first;
        private readonly int _held;

        /// <summary>Makes that of a wire between these supports.</summary>
        public FreeInertia(RodMass mass, RodSupports supports)
        {
            _mass = mass;
            _first = supports.Proximal == ProximalEnd.Free ? 0 : 1;
            _held = supports.HoldsLastNode ? 1 : 0;
        }

        /// <inheritdoc/>
        public double KineticEnergy(Vector3d[] velocities, Vector3d[] spins) =>
            _mass.KineticEnergy(velocities, spins, _first, _mass.ElementCount - _held);
    }
}
