using System;

namespace Guidewire.Core
{
    /// <summary>The coefficients of a diagonally implicit Runge-Kutta scheme, all L-stable and stiffly accurate: the
    /// last stage is the end of the step, so what is stiff (stretch, shear) is at rest there.</summary>
    /// <remarks>All but the simplest have an explicit first stage, whose rates are those at the step's start: their
    /// other stages are of order 2, and where rotation excites the stiff stretch all the time the step stays at least
    /// that order. With implicit stages alone, which are of order 1, it does not.</remarks>
    internal sealed class RungeKuttaScheme
    {
        private RungeKuttaScheme(double[][] rows, double[]? embedded)
        {
            Rows = rows;
            double[] weights = rows[rows.Length - 1];
            Diagonal = weights[weights.Length - 1];
            Times = new double[rows.Length];
            for (int i = 0; i < rows.Length; i++)
            {
                foreach (double a in rows[i])
                {
                    Times[i] += a;
                }
            }
            Times[rows.Length - 1] = 1.0;  // without the rounding of the sum
            foreach (double b in weights)
            {
                WeightSum += Math.Abs(b);
            }
            if (embedded != null)
            {
                ErrorWeights = new double[embedded.Length];
                for (int i = 0; i < embedded.Length; i++)
                {
                    ErrorWeights[i] = weights[i] - embedded[i];
                }
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

        /// <summary>Sum of the magnitudes of the weights b_i: the factor by which stage errors enter a step.</summary>
        public double WeightSum { get; }

        /// <summary>From which stages each is predicted.</summary>
        public StagePredictor[] Predictors { get; }

        /// <summary>gamma, the same on the whole diagonal.</summary>
        public double Diagonal { get; }

        /// <summary>Number of stages, an explicit one counted.</summary>
        public int StageCount => Rows.Length;

        /// <summary>Whether the first stage is the step's start.</summary>
        public bool IsFirstExplicit => Rows[0][0] == 0.0;

        /// <summary>b_i - b^_i, by which the stages' rates give the difference to the embedded solution; null where
        /// there is none.</summary>
        public double[]? ErrorWeights { get; }

        /// <summary>Order of the embedded solution.</summary>
        public int EmbeddedOrder { get; private set; }

        /// <summary>Gives backward Euler, order 1.</summary>
        public static RungeKuttaScheme ImplicitEuler() => new RungeKuttaScheme(new[] { new[] { 1.0 } }, null);

        /// <summary>Two implicit stages, order 2, gamma = 1 - 1/sqrt(2) (Alexander 1977): takes nothing from the rates
        /// at the step's start, so a motion may begin with it far from balance.</summary>
        public static RungeKuttaScheme Start()
        {
            double g = 1.0 - Math.Sqrt(0.5);
            return new RungeKuttaScheme(new[] { new[] { g }, new[] { 1.0 - g, g } }, null);
        }

        /// <summary>Gives TR-BDF2 (Bank et al. 1985; as a Runge-Kutta scheme Hosea and Shampine 1996): order 2,
        /// embedded 3;
        /// d = 1 - 1/sqrt(2), w = sqrt(2)/4.</summary>
        public static RungeKuttaScheme TrBdf2()
        {
            double d = 1.0 - Math.Sqrt(0.5);
            double w = 0.25 * Math.Sqrt(2.0);
            return new RungeKuttaScheme(new[] { new[] { 0.0 }, new[] { d, d }, new[] { w, w, d } },
                new[] { (1.0 - w) / 3.0, (3.0 * w + 1.0) / 3.0, d / 3.0 })
            {
                EmbeddedOrder = 3,
            };
        }

        /// <summary>Gives ESDIRK3(2)4L[2]SA, the implicit part of ARK3(2)4L[2]SA (Kennedy and Carpenter 2003): order 3,
        /// embedded 2.</summary>
        public static RungeKuttaScheme Esdirk3()
        {
            const double g = 1767732205903.0 / 4055673282236.0;
            return new RungeKuttaScheme(new[]
            {
                new[] { 0.0 },
                new[] { g, g },
                new[] { 2746238789719.0 / 10658868560708.0, -640167445237.0 / 6845629431997.0, g },
                new[]
                {
                    1471266399579.0 / 7840856788654.0, -4482444167858.0 / 7529755066697.0,
                    11266239266428.0 / 11593286722821.0, g,
                },
            }, new[]
            {
                2756255671327.0 / 12835298489170.0, -10771552573575.0 / 22201958757719.0,
                9247589265047.0 / 10645013368117.0, 2193209047091.0 / 5459859503100.0,
            })
            {
                EmbeddedOrder = 2,
            };
        }

        /// <summary>Gives ESDIRK4(3)6L[2]SA, the implicit part of ARK4(3)6L[2]SA (Kennedy and Carpenter 2003): order 4,
        /// embedded 3, gamma = 1/4.</summary>
        public static RungeKuttaScheme Esdirk4()
        {
            const double g = 0.25;
            return new RungeKuttaScheme(new[]
            {
                new[] { 0.0 },
                new[] { g, g },
                new[] { 8611.0 / 62500.0, -1743.0 / 31250.0, g },
                new[] { 5012029.0 / 34652500.0, -654441.0 / 2922500.0, 174375.0 / 388108.0, g },
                new[]
                {
                    15267082809.0 / 155376265600.0, -71443401.0 / 120774400.0, 730878875.0 / 902184768.0,
                    2285395.0 / 8070912.0, g,
                },
                new[] { 82889.0 / 524892.0, 0.0, 15625.0 / 83664.0, 69875.0 / 102672.0, -2260.0 / 8211.0, g },
            }, new[]
            {
                4586570599.0 / 29645900160.0, 0.0, 178811875.0 / 945068544.0, 814220225.0 / 1159782912.0,
                -3700637.0 / 11593932.0, 61727.0 / 225920.0,
            })
            {
                EmbeddedOrder = 3,
            };
        }

        /// <summary>The line through two of the known stages, those before this one and, one step earlier, the others,
        /// that is least wrong at this stage's time: of the pairs, the one with the smallest product of the two
        /// distances, which goes with the second derivative, and the weights' magnitudes, which go with
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
                    double fraction = first / (first - second);
                    double wrong = Math.Abs(first * second) * (Math.Abs(fraction) + Math.Abs(1.0 - fraction));
                    if (Math.Abs(first) < Math.Abs(second) && wrong < least)
                    {
                        least = wrong;
                        best = new StagePredictor { First = i, Second = k, Fraction = fraction };
                    }
                }
            }
            return best;
        }
    }
}
