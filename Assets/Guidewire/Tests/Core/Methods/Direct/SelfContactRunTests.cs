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
