using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class DriveTests
    {
        [Test]
        public void Hold_KeepsTheFirstSphereWhereItWasPut_InAnyDirection()
        {
            foreach (Integrator integrator in new[] { Integrator.Verlet, Integrator.Euler })
            {
                SimulationParameters parameters = Wires.Transversal(50);
                parameters.Drive.DisplacementDirection = new Vector3d(1.0, 2.0, -2.0);
                parameters.Drive.Displacement = 6.0;
                parameters.Method.Integrator = integrator;
                Simulation run = Wires.Run(parameters);
                Assert.That(Vector3d.Distance(run.State.Positions[0], new Vector3d(2.0, 4.0, -124.0)),
                    Is.LessThan(1e-13));
                Assert.That(run.State.Velocities[0], Is.EqualTo(Vector3d.Zero));
            }
        }

        [Test]
        public void Displace_MovesTheFirstSphereAlongAFixedAxis()
        {
            SimulationParameters parameters = Wires.Longitudinal(40);
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.DisplacementPerStep = 0.25;
            parameters.Drive.DisplacementDirection = new Vector3d(0.0, 3.0, 4.0);
            Simulation run = Wires.Run(parameters);
            Assert.That(run.State.Positions[0].Y, Is.EqualTo(40 * 0.25 * 0.6).Within(1e-12));
            Assert.That(run.State.Positions[0].Z, Is.EqualTo(-120.0 + 40 * 0.25 * 0.8).Within(1e-12));
            Assert.That(run.State.Velocities[0].Y, Is.EqualTo(0.25 * 0.6 / 0.01).Within(1e-9), "v = motion / dt");
        }

        [Test]
        public void Push_MovesTheFirstSphereAlongTheFirstElement()
        {
            RodStart start = Wires.Random(10, 300.0, 3);
            Simulation run = Simulation.Create(new SimulationParameters
            {
                Scene = { NumberRodElements = 10, Start = start },
                Drive = { Kind = Drive.Push, DisplacementPerStep = 0.5 },
            });
            for (int step = 0; step < 20; step++)
            {
                Vector3d before = run.State.Positions[0];
                Vector3d direction = Vector3d.Normalize(run.State.Positions[1] - before);
                run.Step();
                Assert.That(Vector3d.Distance(run.State.Positions[0], before + 0.5 * direction), Is.LessThan(1e-12));
            }
        }

        [Test]
        public void Force_AcceleratesTheWholeWire()
        {
            // Constraints are inner forces: the centre of mass moves with F/M. After k steps of symplectic Euler from
            // rest it has gone a dt^2 k (k + 1)/2.
            Simulation run = Simulation.Create(new SimulationParameters
            {
                Drive = { Kind = Drive.Force, ExternalForce = new Vector3d(0.0, 0.003, -0.002) },
                Pbd = { TotalMass = 0.01 },
                Method = { ConstraintSolverSteps = 20 },
            });
            Wires.Step(run, 50);
            Vector3d centre = Vector3d.Zero;
            foreach (Vector3d x in run.State.Positions)
            {
                centre += x / 31.0;
            }
            double fall = 1e-4 * 50 * 51 / 2.0;
            Assert.That(centre.Y, Is.EqualTo(0.3 * fall).Within(1e-10));
            Assert.That(centre.Z - 30.0, Is.EqualTo(-0.2 * fall).Within(1e-10));
        }

        [Test]
        public void Gravity_MakesAFreeWireFallAsOne()
        {
            Simulation run = Simulation.Create(new SimulationParameters
            {
                Drive = { Kind = Drive.Force },
                Scene = { Gravity = new Vector3d(0.0, -9.81, 0.0) },
                Method = { Integrator = Integrator.Euler },
            });
            Wires.Step(run, 100);
            foreach (Vector3d x in run.State.Positions)
            {
                Assert.That(x.Y, Is.EqualTo(-9.81 * 1e-4 * 100 * 101 / 2.0).Within(1e-10));
            }
        }

        [Test]
        public void PushAlongAStraightWire_EqualsDisplacementAlongItsAxis()
        {
            SimulationParameters push = Wires.Longitudinal(60);
            push.Drive.Kind = Drive.Push;
            push.Drive.DisplacementPerStep = 0.1;
            SimulationParameters displace = Wires.Longitudinal(60);
            displace.Drive.Kind = Drive.Displace;
            displace.Drive.DisplacementPerStep = 0.1;
            Assert.That(Wires.Distance(Wires.Run(push).State, Wires.Run(displace).State), Is.LessThan(1e-10));
            Assert.That(Math.Abs(Wires.Run(push).State.Positions[0].Z + 114.0), Is.LessThan(1e-10));
        }
    }
}
