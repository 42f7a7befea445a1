using System;
using System.Collections.Generic;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The hub of a wire with a material: how it is driven, what is read off there, and how it gives
    /// way.</summary>
    public sealed class HubTests
    {
        private const double Unit = 1.0 / 1024.0;     // m; with the step below sums and differences are exact
        private const double TimeStep = 1.0 / 512.0;  // s
        private const int Steps = 24;

        [Test]
        public void PushesOfAHand_GiveTheBitsOfATableOfThem()
        {
            var hand = new Steering();
            SimulationParameters live = Pushed();
            live.Drive.Steering = hand;
            SimulationParameters listed = Pushed();
            listed.Drive.Table = Table(out double[] pushes, out double[] turns);
            Simulation steered = Simulation.Create(live);
            Simulation driven = Simulation.Create(listed);
            for (int k = 0; k < Steps; k++)
            {
                hand.Push = pushes[k];
                hand.Turn = turns[k];
                steered.Step();
                driven.Step();
                if (k == Steps / 2)
                {
                    driven = Simulation.Restore(listed, driven.Save());
                }
                Assert.That(steered.State.Positions, Is.EqualTo(driven.State.Positions), "step " + k);
            }
            Assert.That(steered.State.Orientations, Is.EqualTo(driven.State.Orientations));
            Assert.That(driven.Hub()!.Insertion, Is.EqualTo(Unit * pushes.Sum()));
            Assert.That(driven.Hub()!.Turn, Is.EqualTo(turns.Sum()));
            Assert.That(steered.Hub()!.Force, Is.EqualTo(driven.Hub()!.Force).And.Not.Zero);
        }

        [Test]
        public void ConstantSpeeds_AreWayAndTurnPerStepOverIt()
        {
            SimulationParameters speeds = Pushed();
            speeds.Drive.InsertionSpeed = Unit * 0.0625 / TimeStep;
            speeds.Drive.RotationSpeed = 0.03125 / TimeStep;
            SimulationParameters perStep = Pushed();
            perStep.Drive.DisplacementPerStep = 0.0625;
            perStep.Drive.TwistPerStep = 0.03125;
            Assert.That(Wires.Finish(speeds).State.Positions, Is.EqualTo(Wires.Finish(perStep).State.Positions));
        }

        [Test]
        public void HandThatAsksForNothing_LeavesTheWireAsItIs()
        {
            SimulationParameters held = Pushed();
            held.Drive.Kind = Drive.Hold;
            held.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            SimulationParameters steered = Pushed();
            steered.Drive.Kind = Drive.Hold;
            steered.Scene.Gravity = held.Scene.Gravity;
            steered.Drive.Steering = new Steering();
            Simulation byHand = Simulation.Create(steered);
            Wires.Step(byHand, held.Method.MaxSimulationSteps);
            Assert.That(byHand.State.Positions, Is.EqualTo(Wires.Finish(held).State.Positions));
        }

        [TestCase(1.3, 0.0)]
        [TestCase(0.0, 0.5)]
        public void ForceTorqueAndTwist_AreThoseOfABar(double turn, double pull)
        {
            // GJ phi/L and EA d/L; the hub holds back what the far end turns and pulls.
            SimulationParameters parameters = WallScenes.Wire(20, 0.4e-3);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalRotation = turn;
            parameters.Scene.DistalDisplacement = pull;
            parameters.Method.MaxSimulationSteps = 0;
            HubRecord hub = Simulation.Create(parameters).Hub()!;
            double area = Math.PI * 0.16e-6;
            CrossSection section = CrossSection.At(parameters.Material, 0.0);
            Assert.That(section.StretchStiffness, Is.EqualTo(parameters.Material.YoungsModulus * area).Within(1e-9));
            Assert.That(hub.Torque, Is.EqualTo(-section.TwistStiffness * turn / 0.3).Within(1e-9 * 1e-3));
            Assert.That(hub.Force, Is.EqualTo(-section.StretchStiffness * pull / 300.0).Within(1e-6));
            Assert.That(hub.Twist, Is.EqualTo(turn).Within(1e-9));
            Assert.That(Vector3d.Distance(hub.TipDirection, Vector3d.UnitZ), Is.LessThan(1e-9));
            Assert.That(hub.LargestCurvature, Is.LessThan(1e-6));
        }

        [Test]
        public void HubThatMeetsItsLimit_PushesNoHarder_AndSaysWhatItLost()
        {
            // A straight wire against a plane: below Euler's load it can only be pressed together, by F L/EA.
            const double Limit = 0.01;
            SimulationParameters parameters = WallScenes.Wire(20, 0.4e-3);
            double buckling = Math.PI * Math.PI * CrossSection.At(parameters.Material, 0.0).BendStiffness1
                / (4.0 * 0.09);
            Assert.That(Limit, Is.LessThan(0.5 * buckling));
            parameters.Scene.GuidewireOffset = -301.0;
            parameters.Scene.Walls = new ContactShape[] { new PlaneShape(Vector3d.Zero, -1.0 * Vector3d.UnitZ) };
            parameters.Material.MassDamping = 100.0;
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.InsertionSpeed = 0.02;
            parameters.Drive.HubForceLimit = Limit;
            parameters.Method.MaxSimulationSteps = 200;
            parameters.Method.TimeStep = 2e-3;
            Simulation run = Wires.Finish(parameters);
            HubRecord hub = run.Hub()!;
            Assert.That(hub.Force, Is.EqualTo(Limit).Within(1e-6));
            double asked = 1e3 * 0.02 * 0.4;
            Assert.That(run.Contacts!.DriveAsked, Is.EqualTo(asked).Within(1e-9));
            Assert.That(1e3 * hub.Insertion + run.Contacts.DriveShortfall, Is.EqualTo(asked).Within(1e-6));
            // The gap is a millimetre less the wire's radius, of which the barrier keeps a part.
            Assert.That(1e3 * hub.Insertion, Is.InRange(0.5, 0.61));
            Assert.That(run.Reason, Does.Contain("slipped at its hubForceLimit of 0.01 N, first at t = "));
        }

        [Test]
        public void DisplacementAskedFor_IsWhatWasGoneAndWhatIsMissing_ThereAndBack([Values(1e-9, 0.01)] double limit)
        {
            // In the sense of each move: the hub goes on to a wall, waits, goes back, waits in a run that is restored,
            // and goes on again. A hub that gives way at next to nothing is carried by the wire to and fro.
            const double Step = 0.01;  // s
            SimulationParameters parameters = WallScenes.Arch(30, Step, 0.0, 0.0);
            parameters.Drive.HubForceLimit = limit;
            parameters.Drive.Table = new DriveTable(
                new TimeTable(new[] { 0.0, 0.6, 0.7, 1.0, 1.1, 1.4 }, new[] { 0.0, 0.06, 0.06, 0.03, 0.03, 0.06 }),
                new TimeTable(new[] { 0.0 }, new[] { 0.0 }));
            parameters.Method.MaxSimulationSteps = 140;
            Simulation run = Simulation.Create(parameters);
            double gone = 0.0;
            double before = 0.0;
            while (run.Outcome == Outcome.Running)
            {
                double sense = run.StepCount >= 70 && run.StepCount < 110 ? -1.0 : 1.0;
                run = run.StepCount == 102 ? Simulation.Restore(parameters, run.Save()) : run;
                run.Step();
                gone += sense * 1e3 * (run.Hub()!.Insertion - before);
                before = run.Hub()!.Insertion;
                // Node 0 is behind the hub by F over the support's stiffness, less than 1e-9 m.
                Assert.That(gone + run.Contacts!.DriveShortfall, Is.EqualTo(run.Contacts.DriveAsked).Within(1e-6));
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(run.Contacts!.DriveAsked, Is.EqualTo(60.0 + 30.0 + 30.0).Within(1e-9));
            Assert.That(run.Contacts.DriveShortfall, Is.Not.EqualTo(0.0).Within(1.0), "it slipped");
        }

        [Test]
        public void SpringThatGivesWay_HasTheDerivativesOfItsEnergy([Values(0.0, 2.0)] double limit,
            [Values(double.PositiveInfinity, 2e-7, 0.0)] double most)
        {
            MaterialRod rod = MaterialRod.Round(1, 0.1, 0.4e-3, 60e9, 23e9, 6450.0);
            var spring = new SupportSpring(rod, HubLimit.OfForce(limit)) 
            {
                Axis = new Vector3d(0.48, 0.6, 0.64),
                MostBack = most,
                MostForward = most,
            };
            var shape = new RodShape(1);
            shape.X[0] = new Vector3d(-3e-6, -1e-6, 2e-6);
            const double Step = 1e-7;
            var gradient = new RodVector[3];
            var blocks = new RodBlock[3];
            spring.AddBlocks(shape, blocks, gradient, 0, 2);
            double[] slopes = { gradient[0].X1, gradient[0].X2, gradient[0].X3 };
            double[] diagonal = { blocks[0].A11, blocks[0].A22, blocks[0].A33 };
            Vector3d[] axes = { Vector3d.UnitX, Vector3d.UnitY, Vector3d.UnitZ };
            Vector3d start = shape.X[0];
            double middle = spring.Value(shape);
            for (int k = 0; k < 3; k++)
            {
                shape.X[0] = start + Step * axes[k];
                double after = spring.Value(shape);
                shape.X[0] = start - Step * axes[k];
                double before = spring.Value(shape);
                shape.X[0] = start;
                // Of a square: exact but for rounding.
                Assert.That(slopes[k], Is.EqualTo((after - before) / (2.0 * Step)).Within(1e-6 * middle / Step));
                Assert.That(diagonal[k],
                    Is.EqualTo((after - 2.0 * middle + before) / (Step * Step)).Within(1e-6 * middle / (Step * Step)));
            }
        }

        [Test]
        public void WhatDoesNotGoTogether_IsRefused()
        {
            Refused("displacementPerStep", p => p.Drive.InsertionSpeed = p.Drive.DisplacementPerStep = 1.0);
            Refused("twistPerStep", p => p.Drive.RotationSpeed = p.Drive.TwistPerStep = 1.0);
            Refused("insertionSpeed", p =>
            {
                p.Drive.InsertionSpeed = 1.0;
                p.Drive.Kind = Drive.Hold;
            });
            Refused("rotationSpeed", p =>
            {
                p.Drive.RotationSpeed = 1.0;
                p.Scene.ProximalEnd = ProximalEnd.Held;
            });
            Refused("driveFile", p =>
            {
                p.Drive.InsertionSpeed = 1.0;
                p.Drive.Table = Table(out _, out _);
            });
            Refused("proximalEnd", p =>
            {
                p.Drive.Steering = new Steering();
                p.Scene.ProximalEnd = ProximalEnd.Held;
            });
            Refused("hubForceLimit", p =>
            {
                p.Drive.HubForceLimit = 1.0;
                p.Scene.Walls = Array.Empty<ContactShape>();
            });
        }

        private static void Refused(string key, Action<SimulationParameters> change)
        {
            SimulationParameters parameters = Pushed();
            change(parameters);
            Assert.That(() => Simulation.Create(parameters),
                Throws.TypeOf<ArgumentException>().With.Message.StartsWith(key + " needs"));
        }

        // Displacements (units) and rotations that are sums of powers of two, with a pause, a pull and a change of
        // direction.
        private static DriveTable Table(out double[] pushes, out double[] turns)
        {
            pushes = new double[Steps];
            turns = new double[Steps];
            var times = new List<double> { 0.0 };
            var positions = new List<double> { 0.0 };
            var turn = new List<double> { 0.0 };
            for (int k = 0; k < Steps; k++)
            {
                pushes[k] = k % 8 == 7 ? -0.03125 : k % 8 == 3 ? 0.0 : 0.0625;
                turns[k] = k < 8 ? 0.03125 : -0.0625;
                times.Add((k + 1) * TimeStep);
                positions.Add(positions[k] + Unit * pushes[k]);
                turn.Add(turn[k] + turns[k]);
            }
            return new DriveTable(new TimeTable(times.ToArray(), positions.ToArray()),
                new TimeTable(times.ToArray(), turn.ToArray()));
        }

        private static SimulationParameters Pushed()
        {
            SimulationParameters parameters = WallScenes.Arch(40, TimeStep, 0.0, 0.0);
            parameters.Scene.MetresPerUnit = Unit;
            parameters.Method.MaxSimulationSteps = Steps;
            parameters.Scene.GuidewireOffset = -290.0;
            return parameters;
        }
    }
}
