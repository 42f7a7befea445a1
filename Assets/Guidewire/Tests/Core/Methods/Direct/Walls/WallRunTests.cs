using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire with a material between walls, through <see cref="Simulation"/>.</summary>
    public sealed class WallRunTests
    {
        [Test]
        [Category("Row")]
        public void Cantilever_OnAPlane_PressesAsTheBoundaryValueProblemSays()
        {
            // By its boundary value problem: r = 0.3 mm over a plane 20 mm below its axis. The wire's surface lies r +
            // gap above it, so the plane is lowered by both.
            Simulation run = PressedOn(30, 0.3e-3, -20.3, 1.16164e-3);
            Assert.That(run.Contacts!.Forces[30].Y, Is.EqualTo(run.Contacts.Total.Y).Within(1e-9), "at the tip alone");
            Assert.That(run.Contacts.MaxPenetration, Is.EqualTo(0.0));
        }

        [Test]
        [Category("Row")]
        public void ThinCantilever_LiesOnAPlane_FromWhereTheBoundaryValueProblemSays()
        {
            // r = 0.1 mm over a plane 20 mm below its axis: EI theta'' = (F - w (a - s)) cos(theta) between the clamp
            // and the place a where it begins to lie, theta = theta' = 0 there and a fall of 20 mm; by collocation to
            // 1e-10 a = 242.143 mm, and with the push F there the plane carries F + w (L - a) = 0.275078 mN.
            const double force = 2.75078e-4;
            const double liftOff = 242.143;
            Simulation run = PressedOn(120, 0.1e-3, -20.11, force);
            int first = Array.FindIndex(run.Contacts!.Forces, push => push.Y > 0.01 * force);
            Assert.That(300.0 * first / 120, Is.EqualTo(liftOff).Within(0.01 * 300.0));
        }

        // A cantilever at rest on a plane, which carries the force in N to 1 %; radius in m, the plane's height in mm.
        private static Simulation PressedOn(int n, double radius, double height, double force)
        {
            SimulationParameters parameters = WallScenes.OverPlane(n, radius);
            parameters.Contact.ContactDistance = 1e-5;
            parameters.Scene.Walls = WallScenes.Floor(height);
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            Row.Holds("cantilever at rest on a plane, r = " + 1e3 * radius + " mm, direct: force, of the BVP's",
                run.Contacts!.Total.Y / force, 1.0, 0.01);
            return run;
        }

        /// <summary>The means over a step balance its change of momentum, however many parts and stages it has; the
        /// forces at its end are those of the wire as it is logged: the first element bears what the hub
        /// exerts.</summary>
        [TestCase(Integrator.ImplicitEuler, 50.0)]
        [TestCase(Integrator.ImplicitEuler, 1500.0)]
        [TestCase(Integrator.Trbdf2, 300.0)]
        [TestCase(Integrator.Esdirk3, 120.0)]
        public void Forces_BalanceTheChangeOfMomentum_InEveryStep(Integrator integrator, double speed)
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, speed, 100.0);
            parameters.Method.Integrator = integrator;
            parameters.Scene.Walls[0].FrictionCoefficient = integrator == Integrator.ImplicitEuler ? 0.1 : 0.0;
            Simulation run = Simulation.Create(parameters);
            double peak = 0.0;
            double worst = 0.0;
            double worstAtEnd = 0.0;
            double meanOff = 0.0;
            Vector3d before = Vector3d.Zero;
            Wires.Finish(run, () =>
            {
                Vector3d momentum = WallScenes.Momentum(run.State);
                // Of what is asked of a node at rest at the start, one step is no motion by implicit stages alone.
                if (run.StepCount > 1)
                {
                    Vector3d change = (momentum - before) / 0.01;
                    Vector3d given = run.Contacts!.MeanTotal + run.Contacts.Reaction;
                    Vector3d stress = run.Stress()!.Force[0];
                    worstAtEnd = Math.Max(worstAtEnd, (run.Contacts.ReactionAtEnd + stress).Length);
                    meanOff = Math.Max(meanOff, (run.Contacts.Reaction + stress).Length);
                    peak = Math.Max(peak, Math.Max(run.Contacts.Total.Length, run.Contacts.Reaction.Length));
                    worst = Math.Max(worst, Vector3d.Distance(change, given));
                }
                before = momentum;
            });
            Assert.That(run.Report()!.HalvedSteps, Is.EqualTo(0.0));
            Assert.That(peak, Is.GreaterThan(0.1));
            Assert.That(worst, Is.LessThan(1e-6 * peak));
            Assert.That(worstAtEnd, Is.LessThan(1e-4 * peak), "but for the inertia of node 0");
            if (integrator != Integrator.ImplicitEuler)
            {
                Assert.That(meanOff, Is.GreaterThan(0.05 * peak), "the mean is another force");
            }
        }

        [Test]
        public void WireThatIsPressedTogetherBetweenWalls_SaysByHowMuch()
        {
            // 12 mm against the end of a tube that lets it bend nowhere.
            SimulationParameters parameters = WallScenes.Wire(30, 0.4e-3);
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.Walls = WallScenes.Tube(-50.0, 300.0, 0.5, openEnd: false);
            parameters.Drive.Kind = Drive.Push;
            parameters.Drive.HubForceLimit = 0.0;
            parameters.Drive.DisplacementPerStep = 1.0;
            parameters.Method.TimeStep = 0.01;
            parameters.Method.MaxSimulationSteps = 12;
            Simulation run = Wires.Finish(parameters);
            double change = (run.State.Positions[30].Z - run.State.Positions[0].Z) / 300.0 - 1.0;
            Assert.That(change, Is.LessThan(-0.02));
            Assert.That(run.Warnings, Does.Contain(string.Format(System.Globalization.CultureInfo.InvariantCulture,
                "the wire is {0:0.0} % shorter than at rest", -100.0 * change)));
            Assert.That(run.Warnings, Has.Some.StartWith("the drive fell short: of 12 units"));
        }

        [Test]
        [Category("Row")]
        public void Wire_LyingInATube_IsCarriedWhole()
        {
            SimulationParameters parameters = WallScenes.Wire(30, 0.4e-3);
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.Walls = WallScenes.Tube(-10.0, 310.0, 1.0);
            parameters.Method.TimeStep = 5e-3;
            parameters.Material.MassDamping = 40.0;    // 1/s
            parameters.Method.SolverTolerance = 1e-9;
            parameters.Method.MaxSimulationSteps = 400;
            Simulation run = Wires.Finish(parameters);
            double weight = 6450.0 * Math.PI * 0.16e-6 * 0.3 * 9.81;
            Row.Holds("wire that lies in a level tube: force of the tube, off the weight, of it",
                (run.Contacts!.Total - weight * Vector3d.UnitY).Length / weight, 0.0, 1e-6);
            Assert.That(Vector3d.Distance(run.Contacts.WallForces[0], run.Contacts.Total), Is.LessThan(1e-9 * weight));
            Assert.That(run.Contacts.LargestTotal, Is.GreaterThanOrEqualTo(run.Contacts.Total.Length));
            Assert.That(run.Contacts.LargestForce, Is.GreaterThan(weight / 31.0));
        }

        [TestCase(50.0, 0.01)]
        [TestCase(200.0, 0.01)]
        [TestCase(1000.0, 0.01)]
        public void Push_IntoAnArch_StaysInside(double speed, double timeStep)
        {
            Simulation run = Wires.Finish(WallScenes.Arch(60, timeStep, speed, 150.0));
            Assert.That(run.Contacts!.Passages, Is.EqualTo(0));
            Assert.That(run.Contacts.MaxPenetration, Is.EqualTo(0.0));
            Assert.That(run.Contacts.DriveAsked, Is.EqualTo(150.0).Within(1e-9));
            Assert.That(run.Contacts.DriveShortfall, Is.LessThan(1e-3));
            Vector3d tip = run.State.Positions[60];
            Assert.That(tip.Y, Is.GreaterThan(57.0), "behind the arch");
            Assert.That(tip.Z, Is.LessThan(-40.0));
        }

        [Test]
        public void ElementsBetweenNodes_KeepOffTheInnerWall()
        {
            // 12 elements of 25 mm: their chords would cut 3 mm into the inner side of the bend.
            Simulation run = Wires.Finish(WallScenes.Arch(24, 0.01, 50.0, 100.0));
            Assert.That(run.Contacts!.MaxPenetration, Is.EqualTo(0.0));
            Assert.That(run.State.Positions[24].Y, Is.GreaterThan(50.0));
        }

        [Test]
        public void Run_ThatIsContinued_TakesTheSameSteps()
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, 50.0, 100.0);
            parameters.Drive.TwistPerStep = 0.02;
            Simulation whole = Wires.RunInParts(parameters, 150, 100, 125, out Simulation part);
            Assert.That(part.Contacts!.DriveAsked, Is.EqualTo(whole.Contacts!.DriveAsked));
        }

        [TestCase(Solver.Direct)]
        [TestCase(Solver.Pbd)]
        public void Run_GoesOnAndIsRestored_WhenItsTipHasLeftByAnOpenEnd(Solver solver)
        {
            SimulationParameters parameters = WallScenes.Wire(30, 0.4e-3);
            if (solver == Solver.Pbd)
            {
                parameters = new SimulationParameters();
                parameters.Contact.SphereRadius = 0.4;
                parameters.Method.DeltaThreshold = 0.0;
            }
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.Walls = WallScenes.Tube(-50.0, 305.0, 2.0);
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.DisplacementPerStep = 1.0;
            parameters.Method.TimeStep = 0.01;
            parameters.Method.MaxSimulationSteps = 60;
            Simulation whole = Wires.RunInParts(parameters, 50, 30, 40, out _);
            Assert.That(whole.State.Positions[30].Z, Is.GreaterThan(320.0), whole.Reason);
            // Between walls that it is across it does not go on.
            SimulationParameters across = parameters.Copy();
            var knots = new[] { new Vector3d(0.0, 1.9, -50.0), new Vector3d(0.0, 1.9, 305.0) };
            across.Scene.Walls = new ContactShape[] { new TubeShape(knots, new[] { 2.0, 1.0 }, true, true) };
            Assert.Throws<ArgumentException>(() => whole.Continue(across));
        }

        [Test]
        public void Run_GoesOnWithoutItsWalls_AndBetweenThemAgain()
        {
            SimulationParameters between = WallScenes.Arch(30, 0.01, 50.0, 100.0);
            SimulationParameters without = between.Copy();
            without.Scene.Walls = Array.Empty<ContactShape>();
            Simulation run = Simulation.Create(between);
            for (int k = 0; k < 40; k++)
            {
                run.Step();
                run = k == 20 ? run.Continue(without) : k == 22 ? run.Continue(between) : run;
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            Assert.That(run.StepCount, Is.EqualTo(40));
            Assert.That(run.State.Positions[0].Z, Is.EqualTo(-280.0).Within(1e-3));
        }

        [Test]
        public void Steps_LeaveNoGarbage()
        {
            SimulationParameters parameters = WallScenes.Arch(60, 0.01, 50.0, 150.0);
            parameters.Scene.Walls[0].FrictionCoefficient = 0.1;
            Simulation run = Simulation.Create(parameters);
            long left = Garbage.LeftBySteps(run, 200, 20);
            Assert.That(run.Contacts!.Total.Length, Is.GreaterThan(0.0));
            Assert.That(left, Is.EqualTo(0));
        }

        [Test]
        public void StartOutside_IsRefusedByItsElement()
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, 50.0, 100.0);
            parameters.Material.WireRadius = 3.2e-3;
            ArgumentException? error = Assert.Throws<ArgumentException>(() => Simulation.Create(parameters));
            Assert.That(error!.Message, Does.Contain("rod element 0"));
            Assert.That(error.Message, Does.Contain("radius 3.2 units, reaches 0.2 units into the wall"));
            Assert.That(error.Message, Does.Contain("the vessel's radius is 3 units where it is narrowest"));
        }

        [TestCase(1e-300, 0.0, "contactStiffness = 1E-300 N/m is too soft")]
        [TestCase(1e300, 0.0, "contactStiffness = 1E+300 N/m is so large")]
        [TestCase(0.0, 1e-14, "contactDistance = 1E-14 m is too short")]
        [TestCase(0.0, 1.0, "contactDistance = 1 m is too long", Category = "Long")]
        public void BarrierThatCannotWork_IsNamedWhereAStepHasNoSolution(double stiffness, double distance,
            string named)
        {
            // Steps of 5 mm: a step is made in 64 parts at most, and the tip is soon at the bend.
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, 500.0, 100.0);
            parameters.Contact.ContactStiffness = stiffness;
            parameters.Contact.ContactDistance = distance;
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            Assert.That(run.Reason, Does.Contain(named));
        }

        /// <summary>A twentieth of the motion a step, whichever key states it, and the force of the wire's bending over
        /// spans of 90 radii.</summary>
        [TestCase(2.0, 0.0, 1e-4)]
        [TestCase(0.0, 0.2, 1e-4)]
        [TestCase(0.0, 0.01, 4e-5)]
        public void Barrier_ByRule_GoesWithTheMotionAStep(double perStep, double speed, double distance)
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, 50.0, 100.0);
            parameters.Drive.DisplacementPerStep = perStep;
            parameters.Drive.InsertionSpeed = speed;
            Simulation run = Simulation.Create(parameters);
            run.Step();
            Assert.That(run.Report()!.ContactDistance, Is.EqualTo(distance).Within(1e-12));
            double bend = parameters.Material.YoungsModulus * Math.PI / 4.0
                * Math.Pow(parameters.Material.WireRadius, 4.0);
            double span = 90.0 * parameters.Material.WireRadius;
            Assert.That(run.Report()!.ContactStiffness,
                Is.EqualTo(bend / (span * span * distance)).Within(1e-9).Percent);
        }

        /// <summary>A mesh caches the results of queries for all callers.</summary>
        [Test]
        public void TwoWiresInOneMesh_InTurns_MoveAsEachAlone()
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, 100.0, 40.0);
            parameters.Contact.ContactDistance = 5e-5;
            parameters.Scene.Walls = new ContactShape[] { WallScenes.ArchMesh(16, 24) };
            Vector3d alone = Wires.Run(parameters).State.Positions[30];
            parameters.Scene.Walls = new ContactShape[] { WallScenes.ArchMesh(16, 24) };
            Simulation first = Simulation.Create(parameters);
            Simulation second = Simulation.Create(parameters);
            for (int k = 0; first.Outcome == Outcome.Running || second.Outcome == Outcome.Running; k++)
            {
                if (first.Outcome == Outcome.Running)
                {
                    first.Step();
                }
                if (k >= 20 && second.Outcome == Outcome.Running)
                {
                    second.Step();
                }
            }
            Assert.That(first.Contacts!.LargestForce, Is.GreaterThan(0.0));
            Assert.That(first.State.Positions[30], Is.EqualTo(alone));
            Assert.That(second.State.Positions[30], Is.EqualTo(alone));
        }

        /// <summary>In a stenosis of 1.2 radii barriers of 2.5 times half of the clearance push from both sides.
        /// </summary>
        [Test]
        public void BarrierThatFillsAStenosis_IsNamed()
        {
            SimulationParameters parameters = WallScenes.Arch(60, 0.01, 50.0, 100.0);
            parameters.Scene.Walls = new ContactShape[] { new TubeShape(
                new[]
                {
                    new Vector3d(0.0, 0.0, -320.0), new Vector3d(0.0, 0.0, 10.0), new Vector3d(0.0, 0.0, 20.0),
                    new Vector3d(0.0, 0.0, 22.0), new Vector3d(0.0, 0.0, 32.0), new Vector3d(0.0, 40.0, 200.0),
                },
                new[] { 3.0, 3.0, 0.48, 0.48, 3.0, 3.0 }, true, true) };
            Simulation run = Wires.Finish(parameters);
            parameters.Contact.ContactDistance = 1e-4;
            run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            Assert.That(run.Reason, Does.Contain("contactDistance = 0.0001 m is too long")
                .And.Contain("4E-05 m is the default"));
        }

        [Test]
        public void DriveWhoseWayTheWallsBar_EndsTheRunWithAReason()
        {
            // The hub goes on straight where the tube bends: it asks for 72 mm beyond its wall.
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, 1000.0, 400.0);
            parameters.Drive.HubForceLimit = 0.0;
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            Assert.That(run.Reason, Does.Contain("the walls keep sphere 0 from the position of the drive"));
            Assert.That(run.Reason, Does.Contain("hubForceLimit"));
            // In the step of 10 mm before, the hub was no more than a tenth of an element off.
            Assert.That(run.Contacts!.DriveShortfall, Is.InRange(1.0, 11.0));
            Assert.That(run.State.Positions[0].Z + 300.0 + run.Contacts.DriveShortfall,
                Is.EqualTo(run.Contacts.DriveAsked).Within(0.01 * run.Contacts.DriveAsked));
            Assert.That(Wires.Run(WallScenes.Arch(30, 0.01, 50.0, 10.0)).Warnings, Is.Empty);
        }

        [Test]
        public void Speed_BeyondReason_EndsWithAReason()
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, 100_000.0, 3000.0);
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed).Or.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(run.Reason, Is.Not.Empty);
            Assert.That(run.Contacts!.Passages, Is.EqualTo(0));
        }
    }
}
