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
            foreach (double b in rows[rows.Length - 1])
            {
                WeightSum += Math.Abs(b);
            }
            Predictors = new StagePredictor[rows.Length];
            for (int i = 0; i < rows.Length; i++)
            {
                Predictors[i] = PredictorOf(i);
            }
        }

        /// <summary>Lower triangle a_ij of the coefficients; row i has i+1 entries.</summary>
        public double[][] Rows { get; }

        /// <summary>c_i, the stages' times in units of the time step.</summary>
        public double[] Times { get; }

        /// <summary>Sum of the magnitudes of the weights b_i: by what the errors of the stages enter a step.</summary>
        public double WeightSum { get; }

        /// <summary>From which stages each is predicted.</summary>
        public StagePredictor[] Predictors { get; }

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

        /// <summary>The line through two of the stages at hand, those before this one and, one step earlier, the
        /// others, that is least wrong at this stage's time: of the pairs, the one with the smallest product of the
        /// two distances, which goes with the second derivative, and the weights' magnitudes, which go with
        /// noise.</summary>
        private StagePredictor PredictorOf(int stage)
        {
            double time = Times[stage];
            if (StageCount == 1)
            {
                return StagePredictor.OneStage;
            }
            int before = stage > 0 ? stage - 1 : StageCount - 1;
            var best = new StagePredictor { First = before, Second = before };
            double least = double.PositiveInfinity;
            for (int i = 0; i < StageCount; i++)
            {
                double first = time - Times[i] + (i < stage ? 0.0 : 1.0);
                for (int k = 0; k < StageCount; k++)
                {
                    double second = time - Times[k] + (k < stage ? 0.0 : 1.0);
                    double share = first / (first - second);
                    double wrong = Math.Abs(first * second) * (Math.Abs(share) + Math.Abs(1.0 - share));
                    if (Math.Abs(first) < Math.Abs(second) && wrong < least)
                    {
                        least = wrong;
                        best = new StagePredictor { First = i, Second = k, Share = share };
                    }
                }
            }
            return best;
        }
    }
}
