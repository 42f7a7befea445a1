using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Runs in which a wire touches itself.</summary>
    public sealed class SelfContactRunTests
    {
        [TestCase(true, 0.0)]
        [TestCase(true, 0.2, Category = "Long")]
        [TestCase(false, 0.0, Category = "Long")]
        public void FedIntoASac_TheWirePassesItselfOnlyWithoutContact(bool hasContact, double friction)
        {
            SimulationParameters parameters = Sac(hasContact, friction, hasContact ? 120 : 150);
            Simulation simulation = Wires.Finish(parameters);
            if (hasContact)
            {
                Assert.That(simulation.Passages, Is.Zero);
                Assert.That(simulation.IsReliable, Is.True, simulation.Reason);
                Vector3d sum = Vector3d.Zero;
                Array.ForEach(simulation.Contacts!.StrandForces, force => sum += force);
                double largest = simulation.Report()!.Extremes!.StrandForce;
                Assert.That(largest, Is.Positive);
                Assert.That(sum.Length, Is.LessThan(1e-12 * largest), "strands act on one another alone");
                return;
            }
            Assert.That(simulation.Passages, Is.Positive);
            Assert.That(simulation.IsReliable, Is.False);
            Assert.That(simulation.Warnings, Has.Some.Contains("passed through itself"));
        }

        /// <summary>The feed that without contact passes itself, with every scheme and between soft walls.</summary>
        [Category("Long")]
        [TestCase(Integrator.Trbdf2, 0.0)]
        [TestCase(Integrator.Bdf2, 0.0)]
        [TestCase(Integrator.Esdirk3, 0.0)]
        [TestCase(Integrator.Esdirk4, 0.0)]
        [TestCase(Integrator.ImplicitEuler, 1e5)]
        [TestCase(Integrator.Esdirk3, 1e6)]
        public void FedIntoASac_StrandsStayApart_WithEveryScheme(Integrator integrator, double wallStiffness)
        {
            SimulationParameters parameters = Sac(true, 0.0, 120);
            parameters.Method.Integrator = integrator;
            parameters.Scene.Walls[0].Softness = wallStiffness > 0.0 ? new WallSoftness("vessel", wallStiffness) : null;
            Simulation run = Wires.Finish(parameters);
            TestContext.WriteLine("largest force of a strand {0:G3} N, {1} factorisations",
                run.Report()!.Extremes!.StrandForce, run.Report()!.Factorisations);
            Assert.That(run.Report()!.Extremes!.StrandForce, Is.Positive);
            Assert.That(run.Passages, Is.Zero);
        }

        /// <summary>A rope of 1.5 m, a coil in the air, falls on a plane as a pile and comes to rest.</summary>
        [TestCase(30, 0.0, Category = "Long")]
        [TestCase(100, 0.0, Category = "Long")]
        [TestCase(100, 0.3, Category = "Long")]
        public void RopeThatIsDropped_ComesToRestAsAPile(int n, double friction)
        {
            SimulationParameters parameters = Rods.Clamped(n, Solver.Direct, 0.01, 3000);
            parameters.Scene.GuidewireLength = 15.0 * n;
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            parameters.Scene.StartShape = StartShape.Helix;
            parameters.Scene.StartRadius = 40.0;
            parameters.Scene.StartTurns = 15.0 * n / Math.Sqrt(Math.Pow(80.0 * Math.PI, 2.0) + 144.0);
            parameters.Scene.Gravity = -9.81 * Vector3d.UnitZ;
            parameters.Scene.Walls = new ContactShape[]
            {
                new PlaneShape(new Vector3d(0.0, 0.0, -60.0), Vector3d.UnitZ) { FrictionCoefficient = 0.3 },
            };
            parameters.Material.WireRadius = 4e-3;
            parameters.Material.YoungsModulus = 1e6;
            parameters.Material.ShearModulus = 4e5;
            parameters.Material.Density = 1000.0;
            parameters.Material.MassDamping = 2.0;
            parameters.Contact.SelfFriction = friction;
            parameters.Method.DeltaThreshold = 1e-3;
            parameters.Method.Integrator = Integrator.ImplicitEuler;
            Simulation run = Wires.Run(parameters);
            TestContext.WriteLine("{0} at t = {1:G3} s, {2} factorisations", run.Outcome, run.Time,
                run.Report()!.Factorisations);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            Assert.That(run.Passages, Is.Zero);
            Assert.That(run.IsReliable, Is.True, run.Reason);
        }

        [Test]
        public void StartThatOverlaps_IsSaid()
        {
            SimulationParameters parameters = Rods.Clamped(40, Solver.Direct, 1e-3, 1);
            parameters.Contact.SelfContact = true;
            parameters.Scene.StartShape = StartShape.Helix;
            parameters.Scene.StartRadius = 10.0;
            parameters.Scene.StartTurns = 4.7743;    // as long as the wire: its turns lie on one another
            Assert.That(() => Simulation.Create(parameters),
                Throws.ArgumentException.With.Message.Contains("overlaps itself at the start"));
        }

        // 17 mm of sac at the end of a tube; a soft tip, bent by 60 1/m; 1 mm a step, and a weight across the bend.
        private static SimulationParameters Sac(bool hasContact, double friction, int steps)
        {
            var knots = new List<Vector3d> { new Vector3d(0.0, 0.0, -170.0), Vector3d.Zero };
            var radii = new List<double> { 3.0, 3.0 };
            foreach ((double z, double radius) in new[] { (8.0, 10.6), (12.0, 13.5), (16.0, 14.8), (18.6, 15.0),
                (21.0, 14.8), (25.0, 13.5), (29.0, 10.6), (39.0, 1.0) })
            {
                knots.Add(new Vector3d(0.0, 0.0, z));
                radii.Add(radius);
            }
            return new SimulationParameters
            {
                Method =
                {
                    Solver = Solver.Direct,
                    Integrator = Integrator.ImplicitEuler,
                    TimeStep = 0.05,
                    MaxSimulationSteps = steps,
                    DeltaThreshold = 0.0,
                    SolverTolerance = 1e-5,
                },
                Scene =
                {
                    GuidewireLength = 160.0,
                    NumberRodElements = 160,
                    GuidewireOffset = -162.0,
                    ProximalEnd = ProximalEnd.Clamped,
                    Gravity = 9.81 * Vector3d.UnitX,
                    Walls = new ContactShape[] { new TubeShape(knots.ToArray(), radii.ToArray(), true, false) },
                },
                Drive = { Kind = Drive.Displace, Displacement = 0.0, DisplacementPerStep = 1.0 },
                Material =
                {
                    WireRadius = 0.18e-3,
                    MassDamping = 20.0,
                    Sections = new[]
                    {
                        new WireSection
                        {
                            From = 140.0,
                            To = 160.0,
                            YoungsModulus = 6e9,
                            ShearModulus = 2.3e9,
                            RestCurvature = new Vector3d(60.0, 0.0, 0.0),
                        },
                    },
                },
                Contact = { SelfContact = hasContact, SelfFriction = friction },
            };
        }
    }
}
