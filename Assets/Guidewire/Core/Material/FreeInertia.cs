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
        public double KineticEnergy(Vector3d[] velocities, Vector3d[] spins)
        {
            double twice = 0.0;
            int last = _mass.ElementCount - _held;
            for (int i = _first; i <= last; i++)
            {
                twice += _mass.Diagonal[i] * velocities[i].LengthSquared;
                if (i < last)
                {
                    twice += 2.0 * _mass.Coupling[i] * Vector3d.Dot(velocities[i], velocities[i + 1]);
                }
            }
            for (int j = 0; j < _mass.ElementCount; j++)
            {
                Vector3d w = spins[j];
                Vector3d i = _mass.Rotary[j];
                twice += i.X * w.X * w.X + i.Y * w.Y * w.Y + i.Z * w.Z * w.Z;
            }
            return 0.5 * twice;
        }
    }
}
