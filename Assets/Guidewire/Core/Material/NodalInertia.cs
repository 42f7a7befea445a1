using System;

namespace Guidewire.Core
{
    /// <summary>Inverse masses of nodes and inverse inertias of elements, for the methods that need them one by
    /// one.</summary>
    internal sealed class NodalInertia
    {
        /// <summary>Half of each element's mass on either node, or the whole mass spread evenly; 0 for a held
        /// node.</summary>
        public NodalInertia(MaterialRod rod, RodSupports supports)
        {
            int n = rod.ElementCount;
            InverseMass = new double[n + 1];
            InverseInertia = new Vector3d[n];
            double total = 0.0;
            for (int j = 0; j < n; j++)
            {
                double mass = rod.LineDensity[j] * rod.Length[j];
                double rotary = rod.RotaryInertia[j] * rod.Length[j];
                total += mass;
                InverseMass[j] += 0.5 * mass;
                InverseMass[j + 1] += 0.5 * mass;
                InverseInertia[j] = new Vector3d(1.0 / rotary, 1.0 / rotary, 0.5 / rotary);
            }
            if (supports.Mass == MassRule.Uniform)
            {
                Array.Fill(InverseMass, total / (n + 1));
            }
            for (int i = 0; i <= n; i++)
            {
                InverseMass[i] = 1.0 / InverseMass[i];
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

        /// <summary>1/kg, n+1.</summary>
        public double[] InverseMass { get; }

        /// <summary>1/(rho I l), 1/(rho I l), 1/(2 rho I l) along the element's axes, 1/(kg m^2), n.</summary>
        public Vector3d[] InverseInertia { get; }
    }
}
