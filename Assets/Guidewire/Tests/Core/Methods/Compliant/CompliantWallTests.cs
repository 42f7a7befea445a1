using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire with compliance (xpbd) between walls, against closed forms and the direct solver.</summary>
    public sealed class CompliantWallTests
    {
        private const double Young = 1e8;     // Pa
        private const double Gravity = 9.81;  // m/s^2

        [Category("Row")]
        [TestCase(0.0)]
        [TestCase(1e5)]
        public void Cantilever_OnAPlane_PressesAsTheBoundaryValueProblemSays(double stiffness)
        {
            // As direct's: r = 0.3 mm over a plane 20 mm below the axis presses with 1.16164 mN. Ten times as thick
            // under a hundred times the gravity it has the same shape and ten thousand times the force, and a wave
            // along it takes ten times longer beside its swing. Shear, of order (r/L)^2 = 1e-4, is left out of that.
            // A contact with a stiffness gives way by the force over it; the plane is higher by so much.
            const double force = 1.16164e-3 * 1e4;
            double depth = stiffness == 0.0 ? 0.0 : 1e3 * force / stiffness;
            SimulationParameters scene = WallScenes.OverPlane(10, 3e-3);
            scene.Scene.Gravity = new Vector3d(0.0, -100.0 * Gravity, 0.0);
            scene.Scene.Walls = WallScenes.Floor(depth - 23.0);
            scene.Contact.ContactStiffness = stiffness;
            scene.Material.MassDamping = 200.0;    // 1/s
            Simulation run = Wires.Run(WallScenes.Compliant(scene, 60e9));
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            Assert.That(run.Report()!.StepsNotConverged, Is.EqualTo(0), run.Reason);
            Row.Holds("cantilever at rest on a plane, r = 3 mm, xpbd: force, of the BVP's",
                run.Contacts!.Total.Y / force, 1.0, 0.01);
            Assert.That(run.Contacts.Forces[10].Y, Is.EqualTo(run.Contacts.Total.Y).Within(1e-6 * force),
                "at the tip alone");
            Assert.That(run.State.Positions[10].Y, Is.EqualTo(-20.0).Within(1e-6 + 0.01 * depth));
            Assert.That(run.Contacts.Passages, Is.EqualTo(0));
        }

        [Test]
        public void Wire_LyingInATube_IsCarriedWhole()
        {
            SimulationParameters scene = Lying(0.0);
            scene.Scene.Walls = WallScenes.Tube(-10.0, 310.0, 1.0);
            scene.Material.MassDamping = 40.0;    // 1/s
            scene.Method.MaxSimulationSteps = 40;
            Simulation run = Wires.Run(WallScenes.Compliant(scene, Young));
            double weight = 6450.0 * Math.PI * 0.16e-6 * 0.3 * Gravity;
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(run.Contacts!.Total.Y, Is.EqualTo(weight).Within(1e-6 * weight));
            Assert.That(Math.Abs(run.Contacts.Total.X), Is.LessThan(1e-6 * weight));
            Assert.That(Vector3d.Distance(run.Contacts.WallForces[0], run.Contacts.Total), Is.LessThan(1e-9 * weight));
            Assert.That(run.Contacts.MaxPenetration, Is.LessThan(1e-3 * 0.4));
        }

        // Along the slope nothing turns; tan(angle) = 0.3.
        [TestCase(0.2, 0.1)]
        [TestCase(0.0, 0.3)]
        public void Wire_AlongASlope_SlipsAboveTheAngleOfFriction(double friction, double excess)
        {
            SimulationParameters scene = WallScenes.Compliant(Lying(friction), Young);
            scene.Scene.Gravity = Slope(Vector3d.UnitZ);
            double acceleration = Acceleration(scene, Vector3d.UnitZ, out _);
            Assert.That(acceleration, Is.EqualTo(excess * Gravity / Math.Sqrt(1.09)).Within(1e-3 * Gravity));
        }

        // One sweep a substep leaves elements that pitch, and a creep of 0.02 mm/s; three hold.
        [TestCase(1, 0.4, 20, 6e-3)]
        [TestCase(3, 0.4, 100, 1e-4, Category = "Long")]
        [TestCase(10, 0.05, 5, 1e-4)]
        public void Wire_AlongASlope_StaysBelowTheAngleOfFriction(int sweeps, double fraction, int steps, double creep)
        {
            SimulationParameters scene = WallScenes.Compliant(Lying(0.4), Young, fraction);
            scene.Scene.Gravity = Slope(Vector3d.UnitZ);
            scene.Method.ConstraintSolverSteps = sweeps;
            scene.Method.MaxSimulationSteps = steps;
            Simulation run = Wires.Finish(scene);
            Assert.That(run.State.Positions[5].Z, Is.EqualTo(150.0).Within(creep));
        }

        // A cylinder rolls with 2/3 of the slope's component of gravity where friction is above a third of tan(angle),
        // and slips and spins below; a smooth slope does not turn it.
        [TestCase(0.2, 0.2, 1.0)]
        [TestCase(0.05, 0.25, 0.4)]
        [TestCase(0.0, 0.3, 0.0)]
        public void Wire_AcrossASlope_RollsAndSlipsAsACylinder(double friction, double excess, double rolled)
        {
            SimulationParameters scene = WallScenes.Compliant(Lying(friction), Young);
            scene.Scene.Gravity = Slope(Vector3d.UnitX);
            double acceleration = Acceleration(scene, Vector3d.UnitX, out Simulation run);
            double expected = excess * Gravity / Math.Sqrt(1.09);
            Assert.That(acceleration, Is.EqualTo(expected).Within(1e-3 * Gravity));
            // Down along x the axis z turns backwards. Slipping it has spun up by mu m g r t/I = 2 mu g t/r, and runs
            // at (0.3 - mu) g t: 0.4 of rolling at mu = 0.05.
            double speed = 1e-3 * run.State.Velocities[5].X;
            Assert.That(-0.4e-3 * run.State.AngularVelocities[5].Z,
                Is.EqualTo(rolled * speed).Within(0.01 * speed));
        }

        [Test]
        public void Push_ThroughARoughArch_GoesAsDirectHasIt()
        {
            // 200 pieces: at the edges of coarser ones barriers of any width round off what rigid contact does not.
            SimulationParameters scene = Arch(24, WallScenes.ArchTube(200));
            scene.Scene.Walls[0].FrictionCoefficient = 0.2;
            Simulation run = Wires.Run(WallScenes.Compliant(scene, Young));
            SimulationParameters direct = WallScenes.Soft(scene, Young);
            direct.Contact.ContactDistance = 1e-5;
            direct.Contact.ContactStiffness = 10.0;
            direct.Method.TimeStep = 1e-3;
            direct.Drive.DisplacementPerStep *= 0.1;
            direct.Method.MaxSimulationSteps *= 10;
            Simulation exact = Wires.Run(direct);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(run.Warnings, Is.Empty);
            Assert.That(run.Contacts!.Passages, Is.EqualTo(0));
            Assert.That(run.Contacts.DriveAsked, Is.EqualTo(60.0).Within(1e-9));
            // Direct in steps of 0.2 ms with barriers of 1 um is 0.044 units from this one, and xpbd 0.033 from that.
            Assert.That(Wires.Distance(run.State, exact.State), Is.LessThan(0.044 + 0.033));
            Assert.That(Vector3d.Distance(run.State.Positions[24], exact.State.Positions[24]), Is.LessThan(0.02));
            Assert.That(Vector3d.Distance(run.Contacts.Reaction, exact.Contacts!.Reaction),
                Is.LessThan(0.03 * exact.Contacts.Reaction.Length));
        }

        [Test]
        public void Push_ThroughAMesh_PassesNoWall()
        {
            SimulationParameters scene = Arch(15, ArchVessel.Shape);
            scene.Scene.Gravity = new Vector3d(0.0, -Gravity, 0.0);
            Simulation run = Wires.Finish(WallScenes.Compliant(scene, Young));
            Assert.That(run.Contacts!.Passages, Is.EqualTo(0));
            Assert.That(ArchVessel.PointsOutside(run.State), Is.EqualTo(0));
            Assert.That(run.Contacts.LargestForce, Is.GreaterThan(0.0));
            Assert.That(run.Warnings, Is.Empty);
        }

        [Test]
        public void Forces_BalanceTheChangeOfMomentum()
        {
            SimulationParameters scene = Arch(10, WallScenes.ArchTube(40));
            scene.Scene.Walls[0].FrictionCoefficient = 0.1;
            scene.Material.MassDamping = 0.0;
            Simulation run = Simulation.Create(WallScenes.Compliant(scene, Young));
            double peak = 0.0;
            double worst = 0.0;
            Vector3d before = Vector3d.Zero;
            Wires.Finish(run, () =>
            {
                Vector3d momentum = WallScenes.Momentum(run.State);
                Vector3d given = run.Contacts!.Total + run.Contacts.Reaction;
                peak = Math.Max(peak, Math.Max(run.Contacts.Total.Length, run.Contacts.Reaction.Length));
                worst = Math.Max(worst, Vector3d.Distance((momentum - before) / scene.Method.TimeStep, given));
                before = momentum;
            });
            Assert.That(worst, Is.LessThan(1e-4 * peak), "as far as the first element's sweeps have converged");
        }

        [Test]
        public void Run_ThatIsContinued_TakesTheSameSteps()
        {
            SimulationParameters scene = Arch(10, WallScenes.ArchTube(40));
            scene.Scene.Walls[0].FrictionCoefficient = 0.1;
            scene.Drive.TwistPerStep = 0.02;
            SimulationParameters parameters = WallScenes.Compliant(scene, Young);
            Simulation whole = Wires.RunInParts(parameters, 50, 30, 40, out Simulation part);
            Assert.That(whole.Contacts!.Total.Length, Is.GreaterThan(0.0));
            Assert.That(part.Contacts!.Forces, Is.EqualTo(whole.Contacts.Forces));
            Assert.That(part.Contacts.DriveAsked, Is.EqualTo(whole.Contacts.DriveAsked));
        }

        [Test]
        public void Run_GoesOnWithoutItsWalls_AndBetweenThemAgain_AndFromAnotherMethod()
        {
            SimulationParameters scene = Arch(10, WallScenes.ArchTube(40));
            SimulationParameters between = WallScenes.Compliant(scene, Young);
            SimulationParameters without = between.Copy();
            without.Scene.Walls = Array.Empty<ContactShape>();
            SimulationParameters direct = WallScenes.Soft(scene, Young);
            Simulation run = Simulation.Create(direct);
            for (int k = 0; k < 40; k++)
            {
                run.Step();
                run = k == 5 || k == 7 || k == 35 ? run.Continue(between) : k == 6 ? run.Continue(without) : run;
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            Assert.That(run.Contacts!.Passages, Is.EqualTo(0));
            Assert.That(run.Contacts.Total.Length, Is.GreaterThan(0.0));
            Assert.That(run.StepCount, Is.EqualTo(40));
            Assert.That(run.State.Positions[0].Z, Is.EqualTo(-260.0).Within(1e-3));
        }

        [Test]
        public void Steps_LeaveNoGarbage()
        {
            SimulationParameters scene = Arch(10, WallScenes.ArchTube(40));
            scene.Scene.Walls[0].FrictionCoefficient = 0.1;
            Simulation run = Simulation.Create(WallScenes.Compliant(scene, Young));
            long left = Garbage.LeftBySteps(run, 40, 10);
            Assert.That(run.Contacts!.Total.Length, Is.GreaterThan(0.0));
            Assert.That(left, Is.EqualTo(0));
        }

        [Test]
        public void StartOutside_IsRefusedByItsElement()
        {
            SimulationParameters scene = Arch(10, WallScenes.ArchTube(40));
            scene.Material.WireRadius = 3.2e-3;
            ArgumentException? error = Assert.Throws<ArgumentException>(
                () => Simulation.Create(WallScenes.Compliant(scene, Young)));
            Assert.That(error!.Message, Does.Contain("rod element 0"));
            Assert.That(error.Message, Does.Contain("radius 3.2 units, reaches 0.2 units into the wall"));
        }

        [Test]
        public void Hub_ThatIsPulledAgainstAWall_FallsShort()
        {
            // Node 0 itself is pulled back to a wall across its path.
            SimulationParameters scene = Lying(0.0);
            scene.Scene.Gravity = Vector3d.Zero;
            scene.Scene.ProximalEnd = ProximalEnd.Clamped;
            scene.Scene.Walls = new ContactShape[]
            {
                new PlaneShape(new Vector3d(0.0, 0.0, -2.0), Vector3d.UnitZ),
            };
            scene.Drive.Kind = Drive.Displace;
            scene.Drive.DisplacementPerStep = -0.2;
            scene.Method.MaxSimulationSteps = 15;
            Simulation run = Wires.Finish(WallScenes.Compliant(scene, Young));
            ContactRecord contacts = run.Contacts!;
            Assert.That(contacts.Passages, Is.EqualTo(0));
            Assert.That(contacts.DriveAsked, Is.EqualTo(3.0).Within(1e-9));
            Assert.That(contacts.DriveShortfall, Is.EqualTo(1.4).Within(1e-9), "3 mm asked of 2 less r");
            Assert.That(-run.State.Positions[0].Z, Is.EqualTo(3.0 - contacts.DriveShortfall).Within(1e-6));
            Assert.That(run.Warnings, Has.Some.StartWith("the drive fell short"));
        }

        [Test]
        public void ContactThatIsMuchTooSoft_LetsNothingPass_AndIsWarnedOf()
        {
            // 200 g for 0.2 s on contacts of a nanonewton a metre: the core line stops where it would pass.
            SimulationParameters scene = Lying(0.0);
            scene.Scene.Gravity = new Vector3d(0.0, -200.0 * Gravity, 0.0);
            scene.Contact.ContactStiffness = 1e-9;
            Simulation run = Wires.Finish(WallScenes.Compliant(scene, Young));
            Assert.That(run.Contacts!.Passages, Is.EqualTo(0));
            for (int i = 0; i <= 10; i++)
            {
                Assert.That(run.State.Positions[i].Y, Is.GreaterThan(-0.4001));
            }
            Assert.That(run.Contacts.MaxPenetration, Is.GreaterThan(0.9 * 0.4));
            Assert.That(run.Warnings, Has.Some.StartWith("the wire penetrated a wall"));
        }

        [Test]
        public void DisplacementAskedFor_IsWhatNode0WentAndWhatIsMissing_WhereTheSweepsHaveNotConverged(
            [Values(1, 3, 10, 40)] int substeps, [Values(1, 3)] int sweeps)
        {
            // Pushed against a plane across its axis, 0.4 mm a step, with substeps that are too long. A step that
            // blew up leaves no state, so that the displacement it asked for is not counted either.
            SimulationParameters scene = Lying(0.0);
            scene.Scene.Gravity = Vector3d.Zero;
            scene.Scene.ProximalEnd = ProximalEnd.Clamped;
            scene.Scene.Walls = new ContactShape[]
            {
                new PlaneShape(new Vector3d(0.0, 0.0, 302.0), new Vector3d(0.0, 0.1, -1.0)),
            };
            scene.Drive.Kind = Drive.Displace;
            scene.Drive.DisplacementPerStep = 0.4;
            scene.Method.DeltaThreshold = 0.0;
            SimulationParameters compliant = WallScenes.Compliant(scene, Young);
            compliant.Method.Substeps = substeps;
            compliant.Method.ConstraintSolverSteps = sweeps;
            Simulation run = Simulation.Create(compliant);
            double start = run.State.Positions[0].Z;
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
                int kept = run.StepCount - (run.HasStateOfStep ? 0 : 1);
                double gone = run.State.Positions[0].Z - start;
                ContactRecord contacts = run.Contacts!;
                Assert.That(contacts.DriveAsked, Is.EqualTo(0.4 * kept).Within(1e-9), run.Reason);
                Assert.That(gone + contacts.DriveShortfall, Is.EqualTo(contacts.DriveAsked).Within(1e-9), run.Reason);
            }
            bool isWarned = run.Outcome == Outcome.Diverged || run.Reason.Contains("had not converged");
            Assert.That(isWarned, Is.True, "the scene is to be one that does not converge: " + run.Reason);
        }

        private static SimulationParameters Arch(int n, ContactShape vessel)
        {
            SimulationParameters scene = WallScenes.Arch(n, 0.01, 100.0, 60.0);
            scene.Scene.Walls = new[] { vessel };
            scene.Material.MassDamping = 20.0;    // 1/s
            return scene;
        }

        // 300 mm of wire a hair above a plane.
        private static SimulationParameters Lying(double friction)
        {
            SimulationParameters scene = WallScenes.Wire(10, 0.4e-3);
            scene.Scene.GuidewireOffset = 0.0;
            scene.Scene.ProximalEnd = ProximalEnd.Free;
            scene.Scene.Gravity = new Vector3d(0.0, -Gravity, 0.0);
            scene.Scene.Walls = new ContactShape[]
            {
                new PlaneShape(new Vector3d(0.0, -0.4001, 0.0), Vector3d.UnitY) { FrictionCoefficient = friction },
            };
            scene.Method.TimeStep = 0.01;
            scene.Method.MaxSimulationSteps = 20;
            return scene;
        }

        private static Vector3d Slope(in Vector3d down) => (Gravity / Math.Sqrt(1.09)) * (0.3 * down - Vector3d.UnitY);

        // Of the middle node in the second half of the run, m/s^2.
        private static double Acceleration(SimulationParameters scene, in Vector3d down, out Simulation run)
        {
            run = Simulation.Create(scene);
            double half = 0.0;
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
                half = run.StepCount == 10 ? Vector3d.Dot(run.State.Velocities[5], down) : half;
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            return 1e-3 * (Vector3d.Dot(run.State.Velocities[5], down) - half) / 0.1;
        }
    }
}
