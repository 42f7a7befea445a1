using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What contact does to a wire: pushes straight, by the lever rule, with the force that loads
    /// it.</summary>
    [Category("Target")]
    internal sealed class ContactTests
    {
        private const double ForceTolerance = 1e-6;    // of the applied force
        private const double Length = 10.0;
        private const double Radius = 1.0;

        [Test]
        public void Element_OnASmallSphere_IsCarriedByTheLeverRule_AndDoesNotTurn(
            [Values(0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)] double s)
        {
            // A contact is found at the predicted state, which the loads have tilted by (2 s - 1) w F dt^2/l < 4e-8.
            const double Force = 2.0;
            Simulation simulation = OnASphere(s, ElementContact.Barycentric);
            simulation.State.Forces[0] = new Vector3d(0.0, -(1.0 - s) * Force, 0.0);
            simulation.State.Forces[1] = new Vector3d(0.0, -s * Force, 0.0);
            Wires.Step(simulation, 200);
            ContactRecord contacts = simulation.Contacts!;
            Vector3d[] x = simulation.State.Positions;
            Assert.That(contacts.Total.Y, Is.EqualTo(Force).Within(ForceTolerance * Force));
            Assert.That(contacts.Total.X, Is.EqualTo(0.0).Within(ForceTolerance * Force));
            Assert.That(contacts.Total.Z, Is.EqualTo(0.0).Within(ForceTolerance * Force));
            Assert.That(contacts.Forces[0].Y, Is.EqualTo((1.0 - s) * Force).Within(ForceTolerance * Force));
            Assert.That(contacts.Forces[1].Y, Is.EqualTo(s * Force).Within(ForceTolerance * Force));
            Assert.That(x[1].Y - x[0].Y, Is.EqualTo(0.0).Within(1e-6 * Length));
        }

        [Test]
        public void PublishedRule_TurnsTheElement_ThatTheLeverRuleKeepsLevel()
        {
            // Loaded and touching at s = 0.8: the published rule exchanges the weights there, so the load's nearer
            // sphere gets the smaller push.
            Simulation simulation = OnASphere(0.8, ElementContact.Thesis);
            simulation.State.Forces[0] = new Vector3d(0.0, -0.2, 0.0);
            simulation.State.Forces[1] = new Vector3d(0.0, -0.8, 0.0);
            Wires.Step(simulation, 900);
            Vector3d[] x = simulation.State.Positions;
            Assert.That(Math.Abs(x[1].Y - x[0].Y), Is.GreaterThan(0.01 * Length));
        }

        [Test]
        public void Contact_NeverAttracts_AndNeverPullsSideways()
        {
            var random = new RandomGeometry(41);
            for (int i = 0; i < RandomGeometry.Cases(10_000); i++)
            {
                var state = new RodState(1, 1.0, random.Number(0.01, 1.0), 0.0);
                state.InverseMasses[0] *= random.Number(0.5, 2.0);
                Vector3d n = random.Direction();
                double s = random.Number(0.0, 1.0);
                Vector3d c = random.Point();
                double reach = random.Number(0.0, 1.0);
                double gain = random.Number(0.0, 1.0);
                var elements = new ContactConstraint(state, 4);
                var spheres = new ContactConstraint(state, 4);
                elements.AddElement(0, new SurfaceContact(s, c, n, 0.0), reach, gain);
                spheres.AddSphere(0, new SurfaceContact(0.0, c, n, 0.0), reach, gain);
                var before = new[] { random.Point(), random.Point() };
                double gap = reach - Vector3d.Dot(Vector3d.Lerp(before[0], before[1], s) - c, n);
                var x = (Vector3d[])before.Clone();
                elements.Iterate(x);
                double moved = Vector3d.Dot(Vector3d.Lerp(x[0], x[1], s) - Vector3d.Lerp(before[0], before[1], s), n);
                Assert.That(moved, Is.EqualTo(gain * Math.Max(0.0, gap)).Within(1e-12), "element, case " + i);
                AssertAlong(x[0] - before[0], n);
                AssertAlong(x[1] - before[1], n);
                x = (Vector3d[])before.Clone();
                spheres.Iterate(x);
                gap = reach - Vector3d.Dot(before[0] - c, n);
                moved = Vector3d.Dot(x[0] - before[0], n);
                Assert.That(moved, Is.EqualTo(gain * Math.Max(0.0, gap)).Within(1e-12), "sphere, case " + i);
                AssertAlong(x[0] - before[0], n);
            }
        }

        [Test]
        public void ContactForces_OfAWireAtRestOnAPlane_AddUpToItsWeight()
        {
            // The last steps' mean: one-sided contacts let go and catch again, a jitter of some 1e-6 units, and the
            // mean differs from the weight by the change of momentum over that time only.
            const int Steps = 2000;
            SimulationParameters p = Wires.LyingOnAPlane(Drive.Force, 0.01);
            p.Method.Damping = 0.1;
            Simulation simulation = Simulation.Create(p);
            Vector3d sum = Vector3d.Zero;
            for (int k = 0; k < 2 * Steps; k++)
            {
                simulation.Step();
                sum += k >= Steps ? simulation.Contacts!.Total : Vector3d.Zero;
            }
            Vector3d mean = sum / Steps;
            double weight = p.Pbd.TotalMass * -p.Scene.Gravity.Y;
            Assert.That(mean.Y, Is.EqualTo(weight).Within(ForceTolerance * weight));
            Assert.That(mean.X, Is.EqualTo(0.0).Within(ForceTolerance * weight));
            Assert.That(simulation.Contacts!.Reaction, Is.EqualTo(Vector3d.Zero));
        }

        [Test]
        public void ContactForces_AndTheReactionOfAHeldSphere_AddUpToTheWeight()
        {
            // Held above the plane: the wire hangs from sphere 0 and rests with its far part.
            SimulationParameters p = Wires.LyingOnAPlane(Drive.Hold, 0.01);
            p.Drive.Displacement = 3.0;
            p.Drive.DisplacementDirection = Vector3d.UnitY;
            p.Method.Damping = 0.05;
            Simulation simulation = Simulation.Create(p);
            Wires.Step(simulation, 6000);
            double free = p.Pbd.TotalMass * p.Scene.NumberRodElements / (p.Scene.NumberRodElements + 1.0);
            double weight = free * -p.Scene.Gravity.Y;
            ContactRecord contacts = simulation.Contacts!;
            Assert.That(contacts.Total.Y, Is.GreaterThan(0.1 * weight));
            Assert.That(contacts.Reaction.Y, Is.GreaterThan(0.01 * weight));
            Assert.That(
                contacts.Total.Y + contacts.Reaction.Y, Is.EqualTo(weight).Within(ForceTolerance * weight));
        }

        [Test]
        public void ForceBalance_HoldsInEveryStep()
        {
            SimulationParameters p = Wires.LyingOnAPlane(Drive.Hold, 0.01);
            p.Drive.Displacement = 3.0;
            p.Drive.DisplacementDirection = Vector3d.UnitY;
            Simulation simulation = Simulation.Create(p);
            double weight = p.Pbd.TotalMass * -p.Scene.Gravity.Y;
            double mass = p.Pbd.TotalMass / (p.Scene.NumberRodElements + 1.0);
            for (int k = 0; k < 200; k++)
            {
                Vector3d before = Momentum(simulation.State, mass);
                simulation.Step();
                Vector3d change = (Momentum(simulation.State, mass) - before) / p.Method.TimeStep;
                Vector3d forces = simulation.Contacts!.Total + simulation.Contacts.Reaction
                    + (mass * p.Scene.NumberRodElements) * p.Scene.Gravity;
                Assert.That((change - forces).Length, Is.LessThan(ForceTolerance * 100.0 * weight), "step " + k);
            }
        }

        [Test]
        public void Drive_AgainstAWall_IsShortened_AndTheShortfallReported()
        {
            // Sphere 0 is asked 60 units across a tube of radius 8: it gets to the wall, less the clearance.
            var p = new SimulationParameters
            {
                Scene =
                {
                    NumberRodElements = 10,
                    GuidewireLength = 100.0,
                    GuidewireOffset = 0.0,
                    Walls = new ContactShape[]
                {
                    new TubeShape(new[] { Vector3d.Zero, 50.0 * Vector3d.UnitZ }, TubeRadii, true, true),
                },
                },
                Drive = { Kind = Drive.Displace, DisplacementPerStep = 6.0, DisplacementDirection = Vector3d.UnitY },
                Method = { MaxSimulationSteps = 10, ConstraintSolverSteps = 50, DeltaThreshold = 0.0 },
                Contact = { SphereRadius = 2.0, CollisionStiffness = 0.1 },
            };
            Simulation simulation = Wires.Run(p);
            double reached = simulation.State.Positions[0].Y;
            ContactRecord contacts = simulation.Contacts!;
            Assert.That(reached, Is.LessThan(8.0));
            Assert.That(reached, Is.GreaterThan(7.9));
            Assert.That(contacts.DriveAsked, Is.EqualTo(60.0).Within(1e-9));
            Assert.That(contacts.DriveShortfall, Is.EqualTo(60.0 - reached).Within(0.1));
            Assert.That(contacts.Passages, Is.EqualTo(0));
        }

        [Test]
        public void Displacement_AtTheStart_EndsAtTheWall()
        {
            SimulationParameters p = Wires.LyingOnAPlane(Drive.Hold, 0.01);
            p.Drive.Displacement = -50.0;
            p.Drive.DisplacementDirection = Vector3d.UnitY;
            Simulation simulation = Simulation.Create(p);
            Assert.That(simulation.State.Positions[0].Y, Is.GreaterThan(-1.0));
            Assert.That(simulation.State.Positions[0].Y, Is.LessThan(-0.99));
            Assert.That(simulation.Contacts!.DriveShortfall, Is.EqualTo(49.0).Within(0.01));
        }

        [Test]
        public void Wire_ThatStartsOutside_IsRefused()
        {
            SimulationParameters p = Wires.LyingOnAPlane(Drive.Hold, 0.01);
            p.Scene.Walls = new ContactShape[] { new PlaneShape(10.0 * Vector3d.UnitY, Vector3d.UnitY) };
            Assert.That(() => Simulation.Create(p), Throws.ArgumentException.With.Message.Contains("starts outside"));
        }

        [Test]
        public void Scene_WithAWallOutOfReach_MovesAsOneWithout_UpToRounding()
        {
            var p = new SimulationParameters
            {
                Method = { MaxSimulationSteps = 50 },
                Drive = { DisplacementDirection = Vector3d.UnitY },
            };
            Simulation free = Simulation.Create(p);
            p.Scene.Walls = new ContactShape[] { new PlaneShape(-1000.0 * Vector3d.UnitY, Vector3d.UnitY) };
            Simulation walled = Simulation.Create(p);
            Wires.Step(free, 50);
            Wires.Step(walled, 50);
            Assert.That(Wires.Distance(walled.State, free.State), Is.LessThan(1e-10));
        }

        [Test]
        public void Twist_OfTheBase_ReachesTheTip_OfAStraightWire()
        {
            var p = new SimulationParameters
            {
                Scene = { NumberRodElements = 10 },
                Drive = { Kind = Drive.Push, TwistPerStep = 0.01 },
                Method = { MaxSimulationSteps = 400, Damping = 0.1, DeltaThreshold = 0.0 },
                Pbd = { BendStiffness = 10.0 },
            };
            Simulation simulation = Simulation.Create(p);
            double tip = 0.0;
            Vector3d before = simulation.State.Orientations[9].Director1;
            while (simulation.Outcome == Outcome.Running)
            {
                simulation.Step();
                Vector3d after = simulation.State.Orientations[9].Director1;
                tip += Math.Atan2(Vector3d.Cross(before, after).Z, Vector3d.Dot(before, after));
                before = after;
            }
            Vector3d d1 = simulation.State.Orientations[0].Director1;
            Assert.That(Math.Atan2(d1.Y, d1.X), Is.EqualTo(4.0 - 2.0 * Math.PI).Within(1e-9));
            Assert.That(tip, Is.EqualTo(4.0).Within(0.4));
        }

        [Test]
        public void Step_WithContacts_AllocatesNothing()
        {
            SimulationParameters p = Wires.LyingOnAPlane(Drive.Push, 0.01);
            p.Drive.DisplacementPerStep = 3.0;
            p.Scene.Walls = new ContactShape[]
            {
                new MeshShape(TestMeshes.Tube(16, 40, 900.0).Build(Vector3d.Zero, new Vector3d(0.0, 0.0, 900.0)),
                    new Placement(new Vector3d(0.0, 2.0, -100.0), Quaterniond.Identity, new Vector3d(6.0, 6.0, 1.0))),
                ConvexObstacle.Box(new Vector3d(1.0, 0.0, 120.0), new Vector3d(1.0, 1.0, 1.0), Quaterniond.Identity),
            };
            Simulation simulation = Simulation.Create(p);
            long left = Garbage.LeftBySteps(simulation, 20, 200);
            Assert.That(left, Is.Zero);
            Assert.That(simulation.Contacts!.Total.Length, Is.GreaterThan(0.0));
        }

        private static readonly double[] TubeRadii = { 8.0, 8.0 };

        private static Simulation OnASphere(double s, ElementContact rule)
        {
            double small = Length / 100.0;
            return Simulation.Create(new SimulationParameters
            {
                Scene =
                {
                    NumberRodElements = 1,
                    GuidewireLength = Length,
                    GuidewireOffset = 0.0,
                    Walls = new ContactShape[]
                {
                    ConvexObstacle.Sphere(new Vector3d(0.0, -(Radius + small), s * Length), small),
                },
                },
                Contact = { SphereRadius = Radius, CollisionStiffness = 0.5, ElementContact = rule },
                Method =
                {
                    ConstraintSolverSteps = 20,
                    DeltaThreshold = 0.0,
                    TimeStep = 3e-4,
                    MaxSimulationSteps = 1000,
                },
                Drive = { Kind = Drive.Force },
                Pbd = { TotalMass = 1.0 },
            });
        }

        private static void AssertAlong(in Vector3d moved, in Vector3d n)
        {
            Assert.That((moved - Vector3d.Dot(moved, n) * n).Length, Is.LessThan(1e-12));
            Assert.That(Vector3d.Dot(moved, n), Is.GreaterThanOrEqualTo(-1e-15));
        }

        private static Vector3d Momentum(RodState state, double mass)
        {
            Vector3d sum = Vector3d.Zero;
            for (int i = 0; i < state.SphereCount; i++)
            {
                sum += (state.InverseMasses[i] > 0.0 ? mass : 0.0) * state.Velocities[i];
            }
            return sum;
        }
    }
}
