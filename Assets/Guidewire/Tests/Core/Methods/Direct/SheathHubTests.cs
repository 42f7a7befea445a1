using System;
using NUnit.Framework;
using static Guidewire.Core.Tests.SheathScenes;

namespace Guidewire.Core.Tests
{
    /// <summary>The hub of a wire in a sheath: how far it goes, with which force, and where it is when a step has no
    /// solution.</summary>
    public sealed class SheathHubTests
    {
        private const string DrivesItselfOut = "the wire drives itself out of its sheath: hubForceLimit";

        [Test]
        public void HubGoesAsFarAsItIsAsked_WhereAStepIsTakenAgain()
        {
            // In one step of 10 ms the hub goes 10 mm on and turns by half a turn.
            SimulationParameters parameters = Straight(100, -700.0);
            parameters.Drive.Table = new DriveTable(
                new TimeTable(new[] { 0.0, 0.1, 0.11, 0.2 }, new[] { 0.0, 0.0, 0.01, 0.01 }),
                new TimeTable(new[] { 0.0, 0.1, 0.11, 0.2 }, new[] { 0.0, 0.3, 3.5, 3.5 }));
            parameters.Method.MaxSimulationSteps = 20;
            Simulation run = Wires.Finish(parameters);
            Assert.That(run.Hub()!.Insertion, Is.EqualTo(0.01).Within(1e-12));
            Assert.That(run.State.Positions[0].Z, Is.EqualTo(-285.0).Within(1e-3));
            Assert.That(run.State.Positions[100].Z, Is.EqualTo(15.0).Within(1e-3));
        }

        [Test]
        public void StepWithoutASolution_LeavesTheHubWhereTheWireIs()
        {
            SimulationParameters parameters = Sheathed(40, 0.2, 90.0);
            parameters.Drive.InsertionSpeed = Speed;
            parameters.Drive.RotationSpeed = 2.0;
            parameters.Method.MaxSimulationSteps = 50;
            Simulation start = Wires.Finish(parameters);
            parameters.Method.MaxSimulationSteps = 100;
            parameters.Method.MaxNewtonIterations = 1;
            Simulation run = start.Continue(parameters);
            HubRecord before;
            double insertion;
            double turn;
            double length;
            double asked;
            do
            {
                before = run.Hub()!;
                (insertion, turn, length) = (before.Insertion, before.Turn, before.LengthInBody!.Value);
                asked = run.Contacts!.DriveAsked;
                run.Step();
            }
            while (run.Outcome == Outcome.Running);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed));
            HubRecord end = run.Hub()!;
            Assert.That((end.Insertion, end.Turn, end.LengthInBody), Is.EqualTo((insertion, turn, (double?)length)));
            Assert.That(run.Contacts!.DriveAsked, Is.EqualTo(asked));
        }

        [Test]
        public void HubStopsWhereTheWireEnds_AndWhereTheTipIsBackInTheSheath([Values(-1.0, 1.0)] double sense)
        {
            SimulationParameters parameters = Sheathed(20, 0.1, 25.0);
            var hand = new Steering();
            parameters.Drive.Steering = hand;
            parameters.Scene.Walls = new ContactShape[] { Vessel(0.0) };
            parameters.Material.RestCurvature = Vector3d.Zero;
            parameters.Material.Sections = Array.Empty<WireSection>();
            Simulation run = Simulation.Create(parameters);
            Vector3d start = run.State.Positions[0];
            hand.Push = sense;
            Wires.Step(run, 100);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), "steering has no end: " + run.Reason);
            Assert.That(run.Hub()!.LengthInBody, Is.EqualTo(sense > 0.0 ? 0.1 : 0.0).Within(1e-4));
            double gone = sense * (run.State.Positions[0].Z - start.Z);
            Assert.That(1e3 * sense * run.Hub()!.Insertion, Is.EqualTo(gone).Within(1e-3));
            Assert.That(run.Contacts!.DriveAsked, Is.EqualTo(100.0).Within(1e-9));
            Assert.That(run.Contacts.DriveShortfall, Is.EqualTo(100.0 - gone).Within(1e-3));
            // It stays there, and comes away from there as soon as it is asked to.
            Vector3d end = run.State.Positions[0];
            run.Step();
            Assert.That(Vector3d.Distance(run.State.Positions[0], end), Is.LessThan(1e-6));
            hand.Push = -sense;
            Wires.Step(run, 10);
            Assert.That(sense * (end.Z - run.State.Positions[0].Z), Is.EqualTo(10.0).Within(1e-3));
            run.End(Outcome.Interrupted, "that will do");
            Assert.That(run.Reason, Does.Contain("reached an end of its sheath"));
        }

        [Test]
        public void HubThatSlips_NeverExceedsItsLimit([Values(1e-3, 5e-3, 1e-2)] double limit,
            [Values(0.01, 0.03)] double timeStep)
        {
            Simulation run = Simulation.Create(Weak(limit, timeStep));
            double largest = 0.0;
            Wires.Run(run, () =>
            {
                largest = Math.Max(largest, Math.Abs(run.Hub()!.Force));
                Assert.That(run.Report()!.Extremes!.AxialForce, Is.EqualTo(largest).Within(1e-12));
            });
            // With some limits a snap at the fork draws the wire out: with which, rounding decides.
            Assert.That(run.Outcome == Outcome.Finished
                || run.Reason.StartsWith(DrivesItselfOut, StringComparison.Ordinal), run.Reason);
            Assert.That(largest / limit, Is.InRange(0.9, 1.0 + 1e-9));
        }

        // 1e-3 N hold no snap: what the hub has beyond them is said, and it goes no faster than a hand lets it.
        [TestCase(0.02)]
        [TestCase(0.1)]
        public void HubThatSlips_IsNoFasterThanItsSlipSpeed(double speed)
        {
            SimulationParameters parameters = Weak(1e-3, 0.01);
            parameters.Drive.SlipSpeed = speed;
            Simulation run = Simulation.Create(parameters);
            TimeTable asked = parameters.Drive.Table!.Insertion;
            double before = 0.0;
            int slips = 0;
            double largest = 0.0;
            Wires.Run(run, () =>
            {
                double way = Math.Abs(asked.At(run.Time) - asked.At(run.Time - 0.01));
                double moved = Math.Abs(run.Hub()!.Insertion - before);
                before = run.Hub()!.Insertion;
                Assert.That(moved, Is.LessThanOrEqualTo(Math.Max(way, 0.01 * speed) + 1e-12));
                slips += way < 0.01 * speed && Math.Abs(moved - 0.01 * speed) < 1e-12 ? 1 : 0;
                largest = Math.Max(largest, Math.Abs(run.Hub()!.Force));
            });
            Assert.That(slips, Is.GreaterThan(0), "the snap asks for more");
            Assert.That(largest, Is.GreaterThan(1.1e-3));
            Assert.That(run.Reason, Does.Contain("above its hubForceLimit of 0.001 N"));
            Assert.That(run.Hub()!.SlippedFrom, Is.InRange(0.0, run.Time));
        }

        [Test]
        public void WireThatDrivesItselfOut_EndsTheRunWithThatReason()
        {
            // With which limits a snap does it, rounding decides.
            int failed = 0;
            foreach (double limit in new[] { 3e-4, 4e-4, 2e-3, 2.1e-3 })
            {
                Simulation run = Simulation.Create(Weak(limit, 0.01));
                Wires.Run(run, () =>
                    Assert.That(Math.Abs(run.Hub()!.Force), Is.LessThanOrEqualTo(limit * (1.0 + 1e-9))));
                if (run.Outcome == Outcome.Failed)
                {
                    failed++;
                    Assert.That(run.Reason, Does.StartWith(DrivesItselfOut));
                }
            }
            Assert.That(failed, Is.GreaterThan(0));
        }

        // A bent tip in a bend, on, round and back, under a hub that slips: the tip snaps, and is driven out of the
        // sheath with more than the hub holds.
        private static SimulationParameters Weak(double limit, double timeStep)
        {
            SimulationParameters parameters = Sheathed(60, 0.3, 90.0);
            parameters.Drive.SlipSpeed = 0.0;
            parameters.Drive.Table = new DriveTable(new TimeTable(new[] { 0.0, 2.0, 3.5, 4.5 },
                new[] { 0.0, 0.1, 0.1, 0.03 }), new TimeTable(new[] { 2.0, 3.5 }, new[] { 0.0, 9.0 }));
            parameters.Drive.HubForceLimit = limit;
            parameters.Method.TimeStep = timeStep;
            parameters.Method.MaxSimulationSteps = (int)(4.5 / timeStep);
            return parameters;
        }
    }
}
