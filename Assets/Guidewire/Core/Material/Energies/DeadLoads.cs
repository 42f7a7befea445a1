namespace Guidewire.Core
{
    /// <summary>Forces on the nodes that keep their direction in the world: weight, tip force, axial force. Energy
    /// -sum f_i . x_i.</summary>
    internal sealed class DeadLoads : EnergyTerm
    {
        /// <summary>No load on any of the n+1 nodes.</summary>
        public DeadLoads(int elementCount)
        {
            Force = new Vector3d[elementCount + 1];
        }

        /// <summary>Force on each node, N.</summary>
        public Vector3d[] Force { get; }

        /// <summary>Sets the weight of the rod under gravity g (m/s^2), on each node what the mass rule gives it, and
        /// adds the force at the tip (N).</summary>
        public void Set(MaterialRod rod, MassRule rule, in Vector3d gravity, in Vector3d tipForce)
        {
            int n = rod.ElementCount;
            double mass = 0.0;
            for (int i = 0; i <= n; i++)
            {
                Force[i] = Vector3d.Zero;
            }
            for (int j = 0; j < n; j++)
            {
                double m = rod.LineDensity[j] * rod.Length[j];
                mass += m;
                Force[j] += (0.5 * m) * gravity;
                Force[j + 1] += (0.5 * m) * gravity;
            }
            if (rule == MassRule.Uniform)
            {
                for (int i = 0; i <= n; i++)
                {
                    Force[i] = (mass / (n + 1)) * gravity;
                }
            }
            Force[n] += tipForce;
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int i = 0; i < Force.Length; i++)
            {
                sum -= Vector3d.Dot(Force[i], shape.X[i]);
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to)
        {
            for (int i = from; i < to; i++)
            {
                gradient[i].X1 -= Force[i].X;
                gradient[i].X2 -= Force[i].Y;
                gradient[i].X3 -= Force[i].Z;
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            AddGradient(shape, gradient, from, to);
        }
    }
}
