using System;

namespace Guidewire.Core
{
    /// <summary>Distribution of a rod's mass over its nodes and elements.</summary>
    internal sealed class RodMass
    {
        private readonly MaterialRod _rod;
        private readonly MassRule _rule;

        /// <summary>The mass of a rod under one rule.</summary>
        public RodMass(MaterialRod rod, MassRule rule)
        {
            _rod = rod;
            _rule = rule;
            Nodal = new double[rod.Capacity + 1];
            Diagonal = new double[rod.Capacity + 1];
            Coupling = new double[rod.Capacity];
            Rotary = new Vector3d[rod.Capacity];
            Remesh();
        }

        /// <summary>Elements of the rod.</summary>
        public int ElementCount => _rod.ElementCount;

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            MaterialRod rod = _rod;
            MassRule rule = _rule;
            int n = rod.ElementCount;
            Total = 0.0;
            Array.Clear(Nodal, 0, n + 1);
            Array.Clear(Diagonal, 0, n + 1);
            for (int j = 0; j < n; j++)
            {
                double mass = rod.LineDensity[j] * rod.Length[j];
                double fraction = rule == MassRule.Consistent ? mass / 3.0 : 0.5 * mass;
                Nodal[j] += 0.5 * mass;
                Nodal[j + 1] += 0.5 * mass;
                Diagonal[j] += fraction;
                Diagonal[j + 1] += fraction;
                Coupling[j] = rule == MassRule.Consistent ? mass / 6.0 : 0.0;
                double first = rod.RotaryInertia1[j] * rod.Length[j];
                double second = rod.RotaryInertia2[j] * rod.Length[j];
                Rotary[j] = new Vector3d(first, second, first + second);
                Total += mass;
            }
            if (rule == MassRule.Uniform)
            {
                Array.Fill(Nodal, Total / (n + 1), 0, n + 1);
                Array.Fill(Diagonal, Total / (n + 1), 0, n + 1);
            }
        }

        /// <summary>The rod's mass, kg.</summary>
        public double Total { get; private set; }

        /// <summary>Mass of each node, kg, n+1: half of each neighbouring element, or an equal part.</summary>
        public double[] Nodal { get; }

        /// <summary>Diagonal of the mass matrix, kg, n+1.</summary>
        public double[] Diagonal { get; }

        /// <summary>The mass matrix between nodes i and i+1, kg, n.</summary>
        public double[] Coupling { get; }

        /// <summary>I = l (rho I1, rho I2, rho (I1 + I2)) about d1, d2 and d3, kg m^2, n.</summary>
        public Vector3d[] Rotary { get; }

        /// <summary>Gives w x I w of element j over I: as I3 = I1 + I2, (w2 w3, -w1 w3, w1 w2 (I2 - I1)/I3).</summary>
        public Vector3d Precession(int j, in Vector3d w)
        {
            Vector3d i = Rotary[j];
            return new Vector3d(w.Y * w.Z, -(w.X * w.Z), (i.Y - i.X) / i.Z * (w.X * w.Y));
        }

        /// <summary>Kinetic energy, J, of these velocities and angular velocities.</summary>
        public double KineticEnergy(Vector3d[] velocities, Vector3d[] spins) =>
            KineticEnergy(velocities, spins, 0, ElementCount);

        /// <summary>The same where only the nodes from one to another one count.</summary>
        public double KineticEnergy(Vector3d[] velocities, Vector3d[] spins, int first, int last)
        {
            double sum = 0.0;
            for (int i = 0; i <= ElementCount; i++)
            {
                sum += i >= first && i <= last ? 0.5 * Diagonal[i] * velocities[i].LengthSquared : 0.0;
                if (i < ElementCount)
                {
                    Vector3d w = spins[i];
                    double both = i >= first && i < last
                        ? Coupling[i] * Vector3d.Dot(velocities[i], velocities[i + 1]) : 0.0;
                    sum += both
                        + 0.5 * (Rotary[i].X * w.X * w.X + Rotary[i].Y * w.Y * w.Y + Rotary[i].Z * w.Z * w.Z);
                }
            }
            return sum;
        }
    }

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
