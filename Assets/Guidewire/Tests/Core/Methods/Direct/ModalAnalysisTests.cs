using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Frequencies of a wire about its rest shape against the beam's.</summary>
    public sealed class ModalAnalysisTests
    {
        // Euler and Bernoulli: cos(b) cosh(b) = -1 clamped and free, +1 clamped at both ends.
        [TestCase(DistalEnd.Free, 1.8751040687, 4.6940911330, 7.8547574382)]
        [TestCase(DistalEnd.Clamped, 4.7300407449, 7.8532046241, 10.995607838)]
        public void StraightWire_HasTheBeamsFrequencies_TwiceEach(DistalEnd distal, double first, double second,
            double third)
        {
            SimulationParameters parameters = Clamped(60, distal);
            ModalAnalysis modes = ModalAnalysis.Of(parameters, 6);
            Assert.That(modes.Failure, Is.Null);
            double unit = Math.Sqrt(Rods.BendStiffness / (Rods.Density * Rods.Area)) / (Rods.Length * Rods.Length);
            for (int m = 0; m < 6; m++)
            {
                double root = new[] { first, second, third }[m / 2];
                double expected = root * root * unit / (2.0 * Math.PI);
                TestContext.WriteLine("{0:F4} Hz, the beam {1:F4}", modes.Frequencies[m], expected);
                Assert.That(modes.Frequencies[m], Is.EqualTo(expected).Within(0.1).Percent);
            }
        }

        [Test]
        public void ShapesOfTheCantilever_AreTheBeams()
        {
            // The tip of the clamped-free mode moves most; a zero of the second mode lies at 0.7834 L.
            ModalAnalysis modes = ModalAnalysis.Of(Clamped(60, DistalEnd.Free), 3);
            Assert.That(modes.Shapes[0][60].Length, Is.EqualTo(1.0).Within(1e-9));
            Vector3d[] shape = modes.Shapes[2];
            int node = 30;
            while (Vector3d.Dot(shape[node], shape[node + 1]) > 0.0)
            {
                node++;
            }
            Assert.That((node + 0.5) / 60.0, Is.EqualTo(0.7834).Within(0.5 / 60.0));
        }

        // Clamped at both ends, of which one slides, and buckled: it turns about its thrust without a force.
        [Test]
        public void BuckledWire_HasOneNeutralMode_WhateverRoundingMakesOfIt([Values(17, 30, 31, 64)] int n,
            [Values(1.02, 1.1, 1.3)] double load)
        {
            SimulationParameters parameters = Clamped(n, DistalEnd.Sliding);
            double critical = 4.0 * Math.PI * Math.PI * Rods.BendStiffness / (Rods.Length * Rods.Length);
            parameters.Scene.TipForce = new Vector3d(0.0, 0.0, -load * critical);
            ModalAnalysis modes = ModalAnalysis.Of(parameters, 4);
            Assert.That(modes.Failure, Is.Null);
            Assert.That(modes.Frequencies[0], Is.Zero);
            Assert.That(modes.Frequencies[1], Is.GreaterThan(0.1));
            Assert.That(modes.Frequencies, Is.Ordered);
        }

        [Test]
        public void Gains_HaveNoModes() =>
            Assert.That(() => ModalAnalysis.Of(new SimulationParameters(), 3), Throws.ArgumentException);

        private static SimulationParameters Clamped(int n, DistalEnd distal)
        {
            SimulationParameters parameters = Rods.Clamped(n, Solver.Direct, 1e-3, 0);
            parameters.Method.Integrator = Integrator.Esdirk3;
            parameters.Scene.DistalEnd = distal;
            return parameters;
        }
    }
}
