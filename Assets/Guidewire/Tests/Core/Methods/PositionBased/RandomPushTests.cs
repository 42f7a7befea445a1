using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Passages are counted where there are some, and nowhere else.</summary>
    internal sealed class RandomPushTests
    {
        [Test]
        public void Wire_ThatBacksOutOfTheOpenRim_HasPassedNoWall()
        {
            // The base is drawn out and aside, 20 radii a step: the straight path of a whole step cuts the rim's edge,
            // around which the wire really went.
            Simulation simulation = Simulation.Create(new SimulationParameters
            {
                Scene =
                {
                    NumberRodElements = 30, GuidewireOffset = -310.0, Walls = new ContactShape[] { ArchVessel.Shape },
                },
                Contact = { SphereRadius = 2.0, CollisionStiffness = 0.1 },
                Drive =
                {
                    Kind = Drive.Displace,
                    DisplacementDirection = new Vector3d(0.0, 0.6, -1.0),
                    DisplacementPerStep = 40.0,
                },
                Method = { DeltaThreshold = 0.0, MaxSimulationSteps = 6, Damping = 0.1 },
            });
            int outside = 0;
            while (simulation.Outcome == Outcome.Running)
            {
                simulation.Step();
                outside += ArchVessel.PointsOutside(simulation.State);
            }
            Vector3d[] x = simulation.State.Positions;
            Assert.That(Array.FindAll(x, sphere => sphere.Z < ArchVessel.Entrance), Has.Length.GreaterThan(3));
            Assert.That(simulation.Contacts!.Passages, Is.EqualTo(0));
            Assert.That(outside, Is.EqualTo(0));
        }

        [Test]
        public void Count_SeesTheWireOutside_UnderThePublishedRule()
        {
            long passages = 0;
            int outside = 0;
            for (int seed = 0; seed < 10 && (passages == 0 || outside == 0); seed++)
            {
                var push = new RandomPush(seed, ElementContact.Thesis);
                passages += push.Contacts.Passages;
                outside += push.PointsOutside;
            }
            TestContext.WriteLine(passages + " passages, " + outside + " points outside after a step");
            Assert.That(passages, Is.GreaterThan(0));
            Assert.That(outside, Is.GreaterThan(0));
        }

        [Test]
        public void Element_CutsThroughAThinWall_WithSphereContactOnly_AndIsHeldByElementContact()
        {
            // An element of length 10 falls on a post of radius 0.5 between its spheres of radius 1.
            foreach (ElementContact rule in NoneAndLever)
            {
                Simulation simulation = Simulation.Create(new SimulationParameters
                {
                    Scene =
                    {
                        NumberRodElements = 1,
                        GuidewireLength = 10.0,
                        GuidewireOffset = 0.0,
                        Gravity = new Vector3d(0.0, -10.0, 0.0),
                        Walls = new ContactShape[]
                    {
                        ConvexObstacle.Capsule(
                            new Vector3d(-5.0, -3.0, 5.0), new Vector3d(5.0, -3.0, 5.0), 0.5),
                    },
                    },
                    Contact = { SphereRadius = 1.0, CollisionStiffness = 0.5, ElementContact = rule },
                    Drive = { Kind = Drive.Force },
                    Method = { ConstraintSolverSteps = 20, DeltaThreshold = 0.0, MaxSimulationSteps = 200 },
                });
                while (simulation.Outcome == Outcome.Running && simulation.State.Positions[0].Y > -8.0)
                {
                    simulation.Step();
                }
                bool cut = rule == ElementContact.None;
                Assert.That(simulation.State.Positions[0].Y < -8.0, Is.EqualTo(cut), rule.ToString());
                Assert.That(simulation.Contacts!.Passages > 0, Is.EqualTo(cut), rule.ToString());
            }
        }

        private static readonly ElementContact[] NoneAndLever = { ElementContact.None, ElementContact.Barycentric };
    }
}
