using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Wires with rest curvatures of many turns.</summary>
    public sealed class CoilTests
    {
        [TestCase(12.0, 0.0, 300)]
        [TestCase(12.0, 40.0, 300)]
        [TestCase(20.0, 0.0, 400)]
        [TestCase(50.0, 300.0, 1000)]
        public void UnloadedCoil_IsAtRestAtOnce_InItsRestCurvature(double turns, double twist, int n)
        {
            SimulationParameters parameters = Coil(turns, twist, n);
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            Assert.That(run.Report()!.EquilibriumIterations, Is.LessThanOrEqualTo(2));
            // Each joint inside turns by l times the rest curvature.
            Vector3d expected = Rods.Length / n * parameters.Material.RestCurvature;
            for (int j = 3; j < n; j++)
            {
                Vector3d turn = RotationVector.Log(
                    run.State.Orientations[j - 1].Conjugate * run.State.Orientations[j]);
                Assert.That((turn - expected).Length, Is.LessThan(1e-9), "joint " + j);
            }
        }

        [TestCase(12.0, 300)]
        [TestCase(20.0, 400)]
        public void LoadedCoil_ComesToRest_InBalance(double turns, int n)
        {
            // Of 12 turns the spring gives 0.36 L under EI/L^2: k = EI/(L R^2) along its axis.
            SimulationParameters parameters = Coil(turns, 100.0, n);
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.TipForce = new Vector3d(0.0, 0.5 * Rods.BendForce, 0.2 * Rods.BendForce);
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            Assert.That(run.Report()!.EquilibriumResidual, Is.LessThan(1e-6));
            Vector3d weight = Rods.Density * Rods.Area * Rods.Length * parameters.Scene.Gravity;
            Vector3d sum = run.Report()!.ProximalForce!.Value + weight + parameters.Scene.TipForce;
            Assert.That(sum.Length, Is.LessThan(1e-6 * Rods.BendForce));
        }

        [Test]
        public void JointsTurnedTooFarAtRest_FailTheRun_AndTheProposedNumberDoes()
        {
            // 3 rad an element, 3.5 at the joint that stands for 7/6 of one.
            SimulationParameters parameters = Coil(30.0 / (2.0 * Math.PI), 0.0, 10);
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed));
            Assert.That(run.Reason, Does.Contain("restCurvature turns joint 1 by 3.5 rad").And.Contain("l = 0.03 m")
                .And.Contain("numberRodElements = 13 would do"));
            Assert.That(Simulation.Create(Coil(30.0 / (2.0 * Math.PI), 0.0, 13)).Outcome,
                Is.EqualTo(Outcome.Converged));
        }

        [TestCase(0.9, Outcome.Converged)]
        [TestCase(1.01, Outcome.Failed)]
        public void SineLaw_HasNoRestTurnBeyondTwo(double fraction, Outcome outcome)
        {
            // 2 sin(angle/2) = l kappa.
            const int N = 12;
            SimulationParameters parameters = Coil(fraction * 2.0 * N / (2.0 * Math.PI), 0.0, N);
            parameters.Material.BendLaw = BendLaw.Darboux;
            parameters.Material.ClampRule = ClampRule.WholeElement;
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(outcome), run.Reason);
        }

        private static SimulationParameters Coil(double turns, double twist, int n)
        {
            SimulationParameters parameters = Rods.Clamped(n, Solver.Direct, 1e-3, 0);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Material.RestCurvature = new Vector3d(2.0 * Math.PI * turns / Rods.Length, 0.0, twist);
            return parameters;
        }
    }
}
