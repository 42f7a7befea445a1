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

    /// <summary>A wire of random properties that is pushed, and perhaps turned, into the arch by a random step
    /// until 200 units were asked of it, and what came of that.</summary>
    internal sealed class RandomPush
    {
        private const double Asked = 200.0;    // units
        private readonly SimulationParameters _parameters;

        /// <summary>Draws the wire and pushes it to its end.</summary>
        public RandomPush(int seed, ElementContact rule)
        {
            _parameters = Draw(new RandomGeometry(seed), rule);
            Simulation = Simulation.Create(_parameters);
            Run();
        }

        public Simulation Simulation { get; }

        public ContactRecord Contacts => Simulation.Contacts!;

        /// <summary>Points of the wire that lay outside the wall after a step, summed over the steps.</summary>
        public int PointsOutside { get; private set; }

        // The order of the draws is what a seed means.
        private static SimulationParameters Draw(RandomGeometry random, ElementContact rule)
        {
            var parameters = new SimulationParameters
            {
                Scene = { GuidewireOffset = -310.0, Walls = new ContactShape[] { ArchVessel.Shape } },
                Contact = { ElementContact = rule },
                Method = { DeltaThreshold = 0.0 },
                Drive = { Kind = Drive.Push },
            };
            parameters.Scene.NumberRodElements = 5 + random.Index(56);
            parameters.Method.ConstraintSolverSteps = 50 + random.Index(451);
            parameters.Pbd.StretchStiffness = random.Number(0.1, 1.5);
            parameters.Pbd.BendStiffness = Math.Pow(10.0, random.Number(-2.0, 0.3));
            parameters.Scene.Gravity = random.Number(0.0, 10.0) * random.Direction();
            parameters.Contact.SphereRadius = random.Number(1.0, 5.0);
            parameters.Contact.CollisionStiffness = Math.Pow(10.0, random.Number(-3.0, 0.0));
            parameters.Contact.CollisionMargin = random.Number(0.0, 1.0);
            parameters.Method.Damping = random.Number(0.0, 0.3);
            parameters.Method.TimeStep = Math.Pow(10.0, random.Number(-4.0, -1.0));
            parameters.Pbd.TotalMass = Math.Pow(10.0, random.Number(-3.0, 0.0));
            parameters.Drive.TwistPerStep = random.Index(2) == 0 ? 0.0 : random.Number(-0.5, 0.5);
            parameters.Drive.DisplacementPerStep = random.Number(0.05, 20.0) * parameters.Contact.SphereRadius;
            parameters.Method.MaxSimulationSteps = (int)Math.Ceiling(Asked / parameters.Drive.DisplacementPerStep);
            return parameters;
        }

        private void Run()
        {
            while (Simulation.Outcome == Outcome.Running)
            {
                Simulation.Step();
                PointsOutside += ArchVessel.PointsOutside(Simulation.State);
            }
        }
    }
}
