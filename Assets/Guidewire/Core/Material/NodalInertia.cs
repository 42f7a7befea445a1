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

    /// <summary>Inverse masses of nodes and inverse inertias of elements, for methods that need them
    /// individually.</summary>
    internal sealed class NodalInertia : IKineticEnergy
    {
        /// <summary>Makes those of a rod; 0 for a held node.</summary>
        public NodalInertia(RodMass mass, RodSupports supports)
        {
            int n = mass.Rotary.Length;
            InverseMass = new double[n + 1];
            InverseInertia = new Vector3d[n];
            for (int j = 0; j < n; j++)
            {
                Vector3d rotary = mass.Rotary[j];
                InverseInertia[j] = new Vector3d(1.0 / rotary.X, 1.0 / rotary.Y, 1.0 / rotary.Z);
            }
            for (int i = 0; i <= n; i++)
            {
                InverseMass[i] = 1.0 / mass.Nodal[i];
            }
            if (supports.Proximal != ProximalEnd.Free)
            {
                InverseMass[0] = 0.0;
            }
            if (supports.Distal != DistalEnd.Free)
            {
                InverseMass[n] = 0.0;
            }
        }

        /// <summary>The inverse masses of the n + 1 nodes, 1/kg.</summary>
        public double[] InverseMass { get; }

        /// <summary>1/I along the element's axes, 1/(kg m^2), n.</summary>
        public Vector3d[] InverseInertia { get; }

        /// <summary>Kinetic energy of what is not held, J.</summary>
        public double KineticEnergy(Vector3d[] velocities, Vector3d[] spins)
        {
            double twice = 0.0;
            for (int i = 0; i < velocities.Length; i++)
            {
                if (InverseMass[i] > 0.0)
                {
                    twice += velocities[i].LengthSquared / InverseMass[i];
                }
            }
            for (int j = 0; j < spins.Length; j++)
            {
                Vector3d w = spins[j];
                Vector3d inverse = InverseInertia[j];
                twice += w.X * w.X / inverse.X + w.Y * w.Y / inverse.Y + w.Z * w.Z / inverse.Z;
            }
            return 0.5 * twice;
        }
    }

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
