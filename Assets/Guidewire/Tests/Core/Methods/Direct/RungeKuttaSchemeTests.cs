using System;
using System.Numerics;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The coefficients of the schemes against the conditions of order (Hairer, Norsett and Wanner, Solving
    /// ODEs I, II.2) and of L-stability.</summary>
    public sealed class RungeKuttaSchemeTests
    {
        private const double Rounding = 1e-14;

        [TestCase(Integrator.Trbdf2, 2, 3)]
        [TestCase(Integrator.Esdirk3, 3, 2)]
        [TestCase(Integrator.Esdirk4, 4, 3)]
        public void Weights_MeetTheConditionsOfTheirOrders(Integrator integrator, int order, int embedded)
        {
            RungeKuttaScheme scheme = DirectSetup.Scheme(integrator)!;
            double[,] a = Matrix(scheme);
            double[] weights = Weights(scheme);
            double[] lower = new double[weights.Length];
            for (int i = 0; i < lower.Length; i++)
            {
                lower[i] = weights[i] - scheme.ErrorWeights![i];
            }
            Assert.That(scheme.EmbeddedOrder, Is.EqualTo(embedded));
            Assert.That(Worst(a, weights, order), Is.LessThan(Rounding));
            Assert.That(Worst(a, weights, order + 1), Is.GreaterThan(1e-4), "no higher order");
            Assert.That(Worst(a, lower, embedded), Is.LessThan(Rounding));
            Assert.That(Worst(a, lower, embedded + 1), Is.GreaterThan(1e-4), "no higher embedded order");
        }

        [TestCase(Integrator.Trbdf2)]
        [TestCase(Integrator.Esdirk3)]
        [TestCase(Integrator.Esdirk4)]
        public void Stages_AreOfOrderTwo_TheFirstExplicit_TheLastTheEnd(Integrator integrator)
        {
            RungeKuttaScheme scheme = DirectSetup.Scheme(integrator)!;
            double[,] a = Matrix(scheme);
            double[] c = Times(a);
            Assert.That(scheme.IsFirstExplicit, Is.True);
            Assert.That(c[c.Length - 1], Is.EqualTo(1.0).Within(Rounding));
            for (int i = 0; i < c.Length; i++)
            {
                double sum = 0.0;
                for (int j = 0; j < c.Length; j++)
                {
                    sum += a[i, j] * c[j];
                }
                Assert.That(sum, Is.EqualTo(0.5 * c[i] * c[i]).Within(Rounding), "stage " + i);
                Assert.That(scheme.Times[i], Is.EqualTo(c[i]).Within(Rounding));
                Assert.That(a[i, i], Is.EqualTo(i == 0 ? 0.0 : scheme.Diagonal));
            }
        }

        [TestCase(Integrator.ImplicitEuler)]
        [TestCase(Integrator.Trbdf2)]
        [TestCase(Integrator.Esdirk3)]
        [TestCase(Integrator.Esdirk4)]
        public void Scheme_IsLStable(Integrator integrator) =>
            // R has its only pole at 1/gamma > 0, so |R| <= 1 in the left half-plane where it is so on its border.
            AssertLStable(DirectSetup.Scheme(integrator)!);

        [Test]
        public void StartOfAMotionFarFromBalance_IsLStable_AndOfOrderTwo()
        {
            RungeKuttaScheme scheme = RungeKuttaScheme.Start();
            AssertLStable(scheme);
            Assert.That(Worst(Matrix(scheme), Weights(scheme), 2), Is.LessThan(Rounding));
        }

        private static void AssertLStable(RungeKuttaScheme scheme)
        {
            for (double y = 1e-3; y < 1e5; y *= 1.02)
            {
                Assert.That(Growth(scheme, new Complex(0.0, y)).Magnitude, Is.LessThan(1.0 + 1e-12), "" + y);
            }
            // R falls with 1/z.
            Assert.That(Growth(scheme, new Complex(-1e9, 0.0)).Magnitude, Is.LessThan(1e-6));
            Assert.That(Growth(scheme, new Complex(0.0, 1e9)).Magnitude, Is.LessThan(1e-6));
        }

        /// <summary>R(z) = 1 + z b^T (1 - z A)^-1 (1, .., 1).</summary>
        internal static Complex Growth(RungeKuttaScheme scheme, Complex z)
        {
            double[,] a = Matrix(scheme);
            double[] b = Weights(scheme);
            var stage = new Complex[b.Length];
            Complex sum = Complex.One;
            for (int i = 0; i < b.Length; i++)
            {
                Complex right = Complex.One;
                for (int j = 0; j < i; j++)
                {
                    right += z * a[i, j] * stage[j];
                }
                stage[i] = right / (1.0 - z * a[i, i]);
                sum += z * b[i] * stage[i];
            }
            // Stiffly accurate: the last stage is the step's end, without the cancellation of the sum at large z.
            return z.Magnitude < 1e3 ? sum : stage[b.Length - 1];
        }

        /// <summary>The largest error of the conditions up to an order.</summary>
        private static double Worst(double[,] a, double[] b, int order)
        {
            double[] c = Times(a);
            double[] one = Array.ConvertAll(c, x => 1.0);
            double[] square = Product(c, c);
            double[] cube = Product(square, c);
            double[] inner = DenseMatrix.Product(a, c);
            double worst = Math.Abs(DenseMatrix.Dot(b, one) - 1.0);
            worst = order < 2 ? worst : Math.Max(worst, Math.Abs(DenseMatrix.Dot(b, c) - 1.0 / 2.0));
            if (order >= 3)
            {
                worst = Math.Max(worst, Math.Abs(DenseMatrix.Dot(b, square) - 1.0 / 3.0));
                worst = Math.Max(worst, Math.Abs(DenseMatrix.Dot(b, inner) - 1.0 / 6.0));
            }
            if (order >= 4)
            {
                worst = Math.Max(worst, Math.Abs(DenseMatrix.Dot(b, cube) - 1.0 / 4.0));
                worst = Math.Max(worst, Math.Abs(DenseMatrix.Dot(b, Product(c, inner)) - 1.0 / 8.0));
                worst = Math.Max(worst, Math.Abs(DenseMatrix.Dot(b, DenseMatrix.Product(a, square)) - 1.0 / 12.0));
                worst = Math.Max(worst, Math.Abs(DenseMatrix.Dot(b, DenseMatrix.Product(a, inner)) - 1.0 / 24.0));
            }
            return order < 5 ? worst
                : Math.Max(worst, Math.Abs(
                    DenseMatrix.Dot(b, DenseMatrix.Product(a, DenseMatrix.Product(a, inner))) - 1.0 / 120.0));
        }

        private static double[,] Matrix(RungeKuttaScheme scheme)
        {
            int s = scheme.StageCount;
            var a = new double[s, s];
            for (int i = 0; i < s; i++)
            {
                for (int j = 0; j <= i; j++)
                {
                    a[i, j] = scheme.Rows[i][j];
                }
            }
            return a;
        }

        private static double[] Weights(RungeKuttaScheme scheme) => scheme.Rows[scheme.StageCount - 1];

        private static double[] Times(double[,] a)
        {
            double[] one = new double[a.GetLength(0)];
            for (int i = 0; i < one.Length; i++)
            {
                one[i] = 1.0;
            }
            return DenseMatrix.Product(a, one);
        }

        private static double[] Product(double[] x, double[] y)
        {
            double[] z = new double[x.Length];
            for (int i = 0; i < z.Length; i++)
            {
                z[i] = x[i] * y[i];
            }
            return z;
        }
    }
}
