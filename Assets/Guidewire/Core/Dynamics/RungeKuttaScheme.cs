using System;

namespace Guidewire.Core
{
    /// <summary>The coefficients of a diagonally implicit Runge-Kutta scheme, all L-stable and stiffly accurate: the
    /// last stage is the end of the step, so what is stiff (stretch, shear) is at rest there.</summary>
    internal sealed class RungeKuttaScheme
    {
        private RungeKuttaScheme(double[][] rows)
        {
            Rows = rows;
            Diagonal = rows[rows.Length - 1][rows.Length - 1];
            Times = new double[rows.Length];
            for (int i = 0; i < rows.Length; i++)
            {
                foreach (double a in rows[i])
                {
                    Times[i] += a;
                }
            }
        }

        /// <summary>Lower triangle a_ij of the coefficients; row i has i+1 entries.</summary>
        public double[][] Rows { get; }

        /// <summary>c_i, the stages' times in units of the time step.</summary>
        public double[] Times { get; }

        /// <summary>gamma, the same on the whole diagonal.</summary>
        public double Diagonal { get; }

        /// <summary>Number of stages.</summary>
        public int StageCount => Rows.Length;

        /// <summary>Backward Euler, order 1.</summary>
        public static RungeKuttaScheme ImplicitEuler()
        {
            return new RungeKuttaScheme(new[] { new[] { 1.0 } });
        }

        /// <summary>Two stages, order 2, gamma = 1 - 1/sqrt(2) (Alexander 1977).</summary>
        public static RungeKuttaScheme Sdirk2()
        {
            double g = 1.0 - Math.Sqrt(0.5);
            return new RungeKuttaScheme(new[] { new[] { g }, new[] { 1.0 - g, g } });
        }

        /// <summary>Three stages, order 3 (Alexander 1977); gamma is the root of g^3 - 3 g^2 + 3 g/2 - 1/6 near 0.436.
        /// </summary>
        public static RungeKuttaScheme Sdirk3()
        {
            const double g = 0.43586652150845899942;
            return new RungeKuttaScheme(new[]
            {
                new[] { g },
                new[] { 0.5 * (1.0 - g), g },
                new[] { -0.25 * (6.0 * g * g - 16.0 * g + 1.0), 0.25 * (6.0 * g * g - 20.0 * g + 5.0), g },
            });
        }

        /// <summary>Five stages, order 4, gamma = 1/4 (Hairer and Wanner, Solving ODEs II, table IV.6.5).</summary>
        public static RungeKuttaScheme Sdirk4()
        {
            return new RungeKuttaScheme(new[]
            {
                new[] { 0.25 },
                new[] { 0.5, 0.25 },
                new[] { 17.0 / 50.0, -1.0 / 25.0, 0.25 },
                new[] { 371.0 / 1360.0, -137.0 / 2720.0, 15.0 / 544.0, 0.25 },
                new[] { 25.0 / 24.0, -49.0 / 48.0, 125.0 / 16.0, -85.0 / 12.0, 0.25 },
            });
        }
    }
}
