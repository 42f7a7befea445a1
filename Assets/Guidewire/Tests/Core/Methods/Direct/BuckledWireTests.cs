using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire clamped at both ends and shortened, against its elastica: four equal quarters of an
    /// inflectional elastica, P = 16 K(m)^2 EI/L^2 and shortening 2 (1 - E(m)/K(m)) L (Love 1927, 262 ff).</summary>
    public sealed class BuckledWireTests
    {
        // The chain's own dispersion: a thrust P bends it in waves of k with 2 (1 - cos k l)/l^2 = P/EI, which is k^2
        // (1 - (k l)^2/12) where the elastica has k^2; with k = 2 pi/L.
        private static double Dispersion(int n) => -Math.Pow(2.0 * Math.PI / n, 2) / 12.0;

        [TestCase(20, 0.001)]
        [TestCase(20, 0.01)]
        [TestCase(40, 0.01)]
        [TestCase(20, 0.1)]
        [TestCase(40, 0.1)]
        [TestCase(80, 0.1)]
        public void Thrust_IsThatOfTheElastica_LessTheChainsDispersion(int n, double shortening)
        {
            double error = Thrust(n, shortening) / Elastica(shortening) - 1.0;
            Assert.That(error, Is.EqualTo(Dispersion(n)).Within(0.1 * -Dispersion(n)));
        }

        [Test]
        public void Thrust_IsOfSecondOrder_AtLargeShorteningToo([Values(0.3, 0.5)] double shortening)
        {
            double coarse = Thrust(20, shortening) / Elastica(shortening) - 1.0;
            double fine = Thrust(40, shortening) / Elastica(shortening) - 1.0;
            Assert.That(Math.Log(coarse / fine, 2.0), Is.EqualTo(2.0).Within(0.2));
            Assert.That(coarse, Is.EqualTo(Dispersion(20)).Within(0.3 * -Dispersion(20)));
        }

        private static double Thrust(int n, double shortening)
        {
            SimulationParameters parameters = Rods.Clamped(n, Solver.Direct, 1e-3, 0);
            // So thin that its compression, (pi r/L)^2 of L at the critical thrust, is below 1e-7.
            parameters.Material.WireRadius = 2e-5;
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalDisplacement = -300.0 * shortening;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            double stiffness = 0.25 * Math.PI * Math.Pow(2e-5, 4) * Rods.Young;
            return Math.Abs(run.Report()!.DistalForce!.Value.Z) * Rods.Length * Rods.Length / stiffness;
        }

        // P L^2/EI.
        private static double Elastica(double shortening)
        {
            double modulus = Bisection.Limit(0.0, 0.99, k =>
            {
                Complete(k, out double first, out double second);
                return 2.0 * (1.0 - second / first) < shortening;
            });
            Complete(modulus, out double quarter, out _);
            return 16.0 * quarter * quarter;
        }

        // K(m) and E(m) by the arithmetic-geometric mean (Abramowitz and Stegun 17.6).
        private static void Complete(double m, out double first, out double second)
        {
            double a = 1.0;
            double b = Math.Sqrt(1.0 - m);
            double sum = m;
            double weight = 1.0;
            for (int k = 0; k < 30; k++)
            {
                double c = 0.5 * (a - b);
                double mean = 0.5 * (a + b);
                b = Math.Sqrt(a * b);
                a = mean;
                weight *= 2.0;
                sum += weight * c * c;
            }
            first = 0.5 * Math.PI / a;
            second = first * (1.0 - 0.5 * sum);
        }
    }
}
