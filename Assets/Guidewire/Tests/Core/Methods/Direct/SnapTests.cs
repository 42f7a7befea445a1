using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Snaps and violent releases in steps that are far longer than they: steps without a solution are
    /// halved.</summary>
    public sealed class SnapTests
    {
        /// <summary>A wire that is a coil at rest is let go from straight, and comes to rest in its coil.</summary>
        [TestCase(1.5, Integrator.ImplicitEuler)]
        [TestCase(3.0, Integrator.Esdirk3)]
        [TestCase(6.0, Integrator.Esdirk3)]
        [TestCase(6.0, Integrator.Bdf2)]
        [TestCase(4.0, Integrator.Trbdf2)]
        public void CoilLetGoFromStraight_WindsUp(double turns, Integrator integrator)
        {
            const int N = 40;
            SimulationParameters parameters = Rods.Clamped(N, Solver.Direct, 0.01, 400);
            parameters.Method.Integrator = integrator;
            parameters.Method.DeltaThreshold = 0.01;
            parameters.Material.MassDamping = 10.0;
            parameters.Material.RestCurvature = new Vector3d(2.0 * Math.PI * turns / Rods.Length, 0.0, 0.0);
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            TestContext.WriteLine("{0} halved", run.Report()!.HalvedSteps);
            Vector3d expected = Rods.Length / N * parameters.Material.RestCurvature;
            for (int j = 3; j < N; j++)
            {
                Vector3d turn = RotationVector.Log(
                    run.State.Orientations[j - 1].Conjugate * run.State.Orientations[j]);
                Assert.That((turn - expected).Length, Is.LessThan(0.01 * expected.Length), "joint " + j);
            }
        }
    }
}
