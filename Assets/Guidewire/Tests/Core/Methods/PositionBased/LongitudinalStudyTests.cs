using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Thesis 4.1, the wire displaced along its own axis.</summary>
    [Category("Target")]
    public sealed class LongitudinalStudyTests
    {
        private const double Rest = 180.0;    // z of the last sphere before the displacement: offset -120, L 300

        [Test]
        public void DefaultRun_IsSteadyFromStep197()
        {
            Simulation run = Wires.Run(new SimulationParameters());
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged));
            Assert.That(run.SteadyStateStep, Is.EqualTo(197));
            Assert.That(run.StepCount, Is.EqualTo(197 + 100 - 1));
        }

        [Test]
        public void DefaultRun_HasTheMeanDisplacementErrorOfTheThesis_AtThePeakNear219Steps()
        {
            // Fig. 4.4 prints 0.0049; the displacement error of thesis eq. 4.2, averaged over all spheres.
            Simulation run = Simulation.Create(new SimulationParameters());
            double peak = 0.0;
            double mean = 0.0;
            while (run.StepCount < 225)
            {
                run.Step();
                double tip = Math.Abs(run.State.Positions[30].Z - Rest - 10.0);
                if (run.StepCount >= 213 && tip > peak)
                {
                    peak = tip;
                    double sum = 0.0;
                    for (int i = 0; i <= 30; i++)
                    {
                        sum += Math.Abs(run.State.Positions[i].Z - (-120.0 + 10.0 * i) - 10.0);
                    }
                    mean = sum / 31.0;
                }
            }
            Assert.That(mean, Is.EqualTo(0.0049).Within(0.00005));
        }

        [Test]
        public void OtherGains_GiveTheIndependentPrototypesPositions()
        {
            // An independent double-precision implementation gives these digits.
            Simulation run = Simulation.Create(new SimulationParameters
            {
                Pbd = { StretchStiffness = 0.3, BendStiffness = 0.05 },
                Method = { DeltaThreshold = 0.0 },
            });
            Assert.That(TipAfter(run, 10), Is.EqualTo(10.2667809).Within(1e-7));
            Assert.That(TipAfter(run, 50), Is.EqualTo(10.0147801).Within(1e-7));
        }

        [Test]
        public void Positions_DoNotDependOnTheTimeStep()
        {
            // Without forces a step contains no dt: x_k - x_{k-1} is carried on, whatever time it took.
            Simulation coarse = Wires.Run(Wires.Longitudinal(120));
            foreach (double timeStep in new[] { 1e-4, 1e-1 })
            {
                SimulationParameters parameters = Wires.Longitudinal(120);
                parameters.Method.TimeStep = timeStep;
                Assert.That(Wires.Distance(coarse.State, Wires.Run(parameters).State), Is.LessThan(1e-9));
            }
        }

        [Test]
        [Category("Long")]
        public void BilateralOrder_ReachesTheSameRestState()
        {
            Rods.OnlyInFull("ClampedPbdTests, whose wires come to rest in both orders");
            SimulationParameters parameters = Wires.Longitudinal(1500);
            parameters.Method.SweepOrder = SweepOrder.Bilateral;
            Simulation bilateral = Wires.Run(parameters);
            Simulation naive = Wires.Run(Wires.Longitudinal(1500));
            Assert.That(Wires.Distance(bilateral.State, naive.State), Is.LessThan(1e-9));
            Assert.That(bilateral.State.Positions[30].Z, Is.EqualTo(Rest + 10.0).Within(1e-9));
        }

        private static double TipAfter(Simulation run, int steps)
        {
            while (run.StepCount < steps)
            {
                run.Step();
            }
            return run.State.Positions[30].Z - Rest;
        }
    }
}
