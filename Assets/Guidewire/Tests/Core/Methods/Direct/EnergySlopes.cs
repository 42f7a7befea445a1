using System;

namespace Guidewire.Core.Tests
{
    /// <summary>Slopes of a wire's energy, against which the forces of hubs are held.</summary>
    internal static class EnergySlopes
    {
        /// <summary>Central difference of a value that a step on and back changes.</summary>
        public static double Difference(double step, Func<double, double> value)
        {
            return (value(step) - value(-step)) / (2.0 * step);
        }

        /// <summary>E'(z1)(z0 - z1) of the coordinates, J: along straight lines of the nodes, rotation vectors of the
        /// elements and, with others inside, their twist.</summary>
        public static double Along(RodDynamics motion, RodShape before)
        {
            RodShape shape = motion.Shape;
            var gradient = new RodVector[motion.Terms.VectorCount];
            motion.Terms.AddGradient(shape, gradient);
            double sum = 0.0;
            int n = shape.ElementCount;
            for (int i = 0; i <= n; i++)
            {
                Vector3d move = before.X[i] - shape.X[i];
                RodVector g = gradient[i];
                sum += g.X1 * move.X + g.X2 * move.Y + g.X3 * move.Z;
                if (i < n)
                {
                    Vector3d turn = RotationVector.Log(shape.Q[i].Conjugate * before.Q[i]);
                    sum += g.T1 * turn.X + g.T2 * turn.Y + g.T3 * turn.Z;
                }
                for (int k = 0; i < n && k < shape.InnerCount; k++)
                {
                    RodVector z = gradient[n + 2 + i];
                    sum += (k == 0 ? z.T3 : z.T2) * (before.Twist[k * n + i] - shape.Twist[k * n + i]);
                }
            }
            return sum;
        }
    }
}
