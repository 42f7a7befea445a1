using System;

namespace Guidewire.Core
{
    /// <summary>Sums over whole vectors of a rod.</summary>
    internal static class RodVectors
    {
        /// <summary>Takes the scalar product a . b, of the first vectors or of all.</summary>
        public static double Dot(RodVector[] a, RodVector[] b, int count = int.MaxValue)
        {
            double sum = 0.0;
            for (int i = 0; i < Math.Min(count, a.Length); i++)
            {
                sum += RodVector.Dot(a[i], b[i]);
            }
            return sum;
        }

        /// <summary>Gives the largest sum of the forces on nodes 0 to k, over all k.</summary>
        /// <param name="count">Vectors that count.</param>
        /// <param name="couples">Sum of the magnitudes of all components of the couples.</param>
        public static double LargestPartialForce(RodVector[] v, int count, out double couples)
        {
            double x = 0.0;
            double y = 0.0;
            double z = 0.0;
            double largest = 0.0;
            couples = 0.0;
            for (int i = 0; i < count; i++)
            {
                x += v[i].X1;
                y += v[i].X2;
                z += v[i].X3;
                largest = Math.Max(largest, x * x + y * y + z * z);
                couples += Math.Abs(v[i].T1) + Math.Abs(v[i].T2) + Math.Abs(v[i].T3);
            }
            return Math.Sqrt(largest);
        }

        /// <summary>Adds: to += scale v.</summary>
        public static void AddScaled(RodVector[] to, double scale, RodVector[] v)
        {
            for (int i = 0; i < to.Length; i++)
            {
                to[i].AddScaled(scale, v[i]);
            }
        }

        /// <summary>Multiplies in place: v *= scale.</summary>
        public static void Scale(RodVector[] v, double scale)
        {
            for (int i = 0; i < v.Length; i++)
            {
                v[i].X1 *= scale;
                v[i].X2 *= scale;
                v[i].X3 *= scale;
                v[i].T1 *= scale;
                v[i].T2 *= scale;
                v[i].T3 *= scale;
            }
        }

        /// <summary>Gives the largest force of all nodes, or couple of all elements over a length.</summary>
        public static double Largest(RodVector[] v, double length)
        {
            double largest = 0.0;
            for (int i = 0; i < v.Length; i++)
            {
                double x = v[i].X1 * v[i].X1 + v[i].X2 * v[i].X2 + v[i].X3 * v[i].X3;
                double t = v[i].T1 * v[i].T1 + v[i].T2 * v[i].T2 + v[i].T3 * v[i].T3;
                largest = Math.Max(largest, Math.Max(x, t / (length * length)));
            }
            return Math.Sqrt(largest);
        }

        /// <summary>A fixed vector without symmetry, so that no mode of a rod is orthogonal to it.</summary>
        public static void SetWithoutSymmetry(RodVector[] v, double length)
        {
            for (int i = 0; i < v.Length; i++)
            {
                double a = Math.Sin(12.9898 * i + 1.0);
                v[i] = new RodVector
                {
                    X1 = a * length, X2 = (0.5 - a * a) * length, X3 = 0.3 * a * length,
                    T1 = Math.Sin(78.233 * i), T2 = Math.Cos(37.719 * i), T3 = 0.7 + a,
                };
            }
            v[v.Length - 1] = default;
        }
    }
}
