using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class StepTests
    {
        [TestCase(Integrator.Verlet, SweepOrder.Naive)]
        [TestCase(Integrator.Euler, SweepOrder.Bilateral)]
        public void Step_AllocatesNothing(Integrator integrator, SweepOrder order)
        {
            Simulation run = Simulation.Create(new SimulationParameters
            {
                Method =
                {
                    Integrator = integrator,
                    SweepOrder = order,
                    ConstraintSolverSteps = 10,
                    DeltaThreshold = 0.0,
                },
                Drive = { Kind = Drive.Push, DisplacementPerStep = 0.01 },
                Scene = { Gravity = new Vector3d(0.0, -1.0, 0.0) },
            });
            long left = Garbage.LeftBySteps(run, 50, 500);
            Assert.That(left, Is.Zero);
            Assert.That(run.StepCount, Is.EqualTo(550));
        }

        [Test]
        public void SameParameters_GiveTheSameBits()
        {
            var parameters = new SimulationParameters
            {
                Scene =
                {
                    NumberRodElements = 17,
                    Start = Wires.Random(17, 300.0, 4),
                    Gravity = new Vector3d(1.0, -2.0, 0.5),
                },
                Method = { DeltaThreshold = 0.0, MaxSimulationSteps = 100, ConstraintSolverSteps = 50 },
            };
            RodState first = Wires.Run(parameters).State;
            RodState second = Wires.Run(parameters).State;
            Assert.That(first.Positions, Is.EqualTo(second.Positions));
            Assert.That(first.Orientations, Is.EqualTo(second.Orientations));
        }

        [Category("Row")]
        [TestCase(Solver.Pbd, BendLaw.RotationVector)]
        [TestCase(Solver.Explicit, BendLaw.RotationVector)]
        [TestCase(Solver.Xpbd, BendLaw.RotationVector)]
        [TestCase(Solver.Direct, BendLaw.RotationVector)]
        [TestCase(Solver.Direct, BendLaw.Darboux)]
        public void TurnedScene_GivesTheTurnedResult(Solver solver, BendLaw law)
        {
            // The equations know no direction: turn everything by one rotation, and the result is turned by it.
            const int N = 9;
            Quaterniond turn = Quaterniond.FromAxisAngle(Vector3d.Normalize(new Vector3d(1.0, -2.0, 0.7)), 2.1);
            RodStart start = Wires.Random(N, 90.0, 8);
            var positions = new Vector3d[N + 1];
            var velocities = new Vector3d[N + 1];
            var orientations = new Quaterniond[N];
            for (int i = 0; i <= N; i++)
            {
                positions[i] = Quaterniond.Rotate(turn, start.Positions[i]);
                velocities[i] = Quaterniond.Rotate(turn, start.Velocities[i]);
            }
            for (int j = 0; j < N; j++)
            {
                orientations[j] = turn * start.Orientations[j];
            }
            var turned = new RodStart(positions, orientations, velocities, start.AngularVelocities);
            var loads = new Vector3d(1.0, -9.81, 3.0);
            Simulation plain = Free(start, N, solver, law, loads);
            Simulation rotated = Free(turned, N, solver, law, Quaterniond.Rotate(turn, loads));
            for (int step = 0; step < 50; step++)
            {
                plain.Step();
                rotated.Step();
            }
            Vector3d[] expected = Array.ConvertAll(plain.State.Positions, x => Quaterniond.Rotate(turn, x));
            Row.Holds("everything turned, " + solver + ", " + law + ": distance of a sphere of 90 units' length",
                Wires.Distance(rotated.State.Positions, expected), 0.0, solver == Solver.Xpbd ? 1e-9 : 1e-10);
        }

        [Test]
        public void OneElement_IsAWireToo()
        {
            SimulationParameters parameters = Wires.Longitudinal(200);
            parameters.Scene.NumberRodElements = 1;
            parameters.Pbd.TotalMass = 1e-6;
            Simulation run = Wires.Finish(parameters);
            Assert.That(run.State.Positions[1].Z, Is.EqualTo(190.0).Within(1e-9));
        }

        // Soft, so that steps of 0.1 ms are short; under its weight and a force at its tip.
        private static Simulation Free(RodStart start, int n, Solver solver, BendLaw law, in Vector3d loads)
        {
            var parameters = new SimulationParameters
            {
                Scene = { NumberRodElements = n, GuidewireLength = 10.0 * n, Start = start, Gravity = loads },
                Drive = { Kind = Drive.Force },
                Method = { DeltaThreshold = 0.0, ConstraintSolverSteps = 30 },
            };
            if (solver != Solver.Pbd)
            {
                parameters = Rods.Clamped(n, solver, 1e-4, 1000);
                parameters.Scene.GuidewireLength = 10.0 * n;
                parameters.Scene.Start = start;
                parameters.Scene.Gravity = loads;
                parameters.Scene.TipForce = 1e-4 * loads;
                parameters.Scene.ProximalEnd = ProximalEnd.Free;
                parameters.Material.WireRadius = 1e-3;
                parameters.Material.YoungsModulus = 1e6;
                parameters.Material.ShearModulus = 4e5;
                parameters.Material.BendLaw = law;
                parameters.Method.SolverTolerance = 1e-12;
                parameters.Method.Substeps = solver == Solver.Direct ? 1 : 10;
            }
            return Simulation.Create(parameters);
        }
    }
}
