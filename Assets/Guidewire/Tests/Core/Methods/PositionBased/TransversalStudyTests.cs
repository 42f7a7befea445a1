using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Thesis 4.2, the wire displaced across its axis.</summary>
    [Category("Target")]
    public sealed class TransversalStudyTests
    {
        [TestCase(Integrator.Verlet)]
        [TestCase(Integrator.Euler)]
        public void DisplacementAlongY_GivesTheIndependentPrototypesPositions(Integrator integrator)
        {
            // Last sphere's y and z - z(0) of an independent double-precision implementation.
            SimulationParameters parameters = Wires.Transversal(1000);
            parameters.Method.Integrator = integrator;
            Simulation run = Simulation.Create(parameters);
            foreach ((int step, double y, double z) in new[]
            {
                (50, -5.10683898, -0.165288662), (200, -2.34444617, -0.329733078), (1000, -5.88824229, -0.421021043),
            })
            {
                while (run.StepCount < step)
                {
                    run.Step();
                }
                Vector3d tip = run.State.Positions[30];
                Assert.That(tip.Y, Is.EqualTo(y).Within(1e-8), "y at step " + step);
                Assert.That(tip.Z - 180.0, Is.EqualTo(z).Within(1e-9), "z at step " + step);
                Assert.That(tip.X, Is.Zero, "x at step " + step);
            }
        }

        [Test]
        public void VerletAndEuler_Agree_WithDampingToo()
        {
            // Without damping both are those of the prototype, above.
            int steps = Rods.InFull ? 500 : 200;
            foreach (double damping in Rods.InFull ? new[] { 0.0, 0.01 } : new[] { 0.01 })
            {
                SimulationParameters verlet = Wires.Transversal(steps);
                verlet.Method.Damping = damping;
                SimulationParameters euler = Wires.Transversal(steps);
                euler.Method.Damping = damping;
                euler.Method.Integrator = Integrator.Euler;
                Assert.That(Wires.Distance(Wires.Run(verlet).State, Wires.Run(euler).State), Is.LessThan(1e-9),
                    "damping " + damping);
            }
        }

        [Test]
        public void AllSpheres_StayInThePlaneOfTheDisplacement()
        {
            Simulation run = Wires.Run(Wires.Transversal(300));
            foreach (Vector3d x in run.State.Positions)
            {
                Assert.That(x.X, Is.Zero);
            }
        }
    }
}
