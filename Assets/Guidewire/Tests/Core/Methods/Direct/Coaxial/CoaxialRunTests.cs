using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Runs of a wire in a catheter: rest shapes, snapshots, hubs that meet, friction.</summary>
    public sealed class CoaxialRunTests
    {
        private const double Unit = 1e-3;   // m

        [Test]
        public void MotionSettlesToTheRestShape([Values(Integrator.ImplicitEuler, Integrator.Bdf2, Integrator.Trbdf2,
            Integrator.Esdirk3, Integrator.Esdirk4)] Integrator integrator)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(integrator);
            parameters.Drive.InsertionSpeed = 0.02;
            parameters.Material.MassDamping = 60.0;
            parameters.Method.TimeStep = 4e-3;
            parameters.Method.MaxSimulationSteps = 100;
            Simulation run = Simulation.Create(parameters);
            Wires.Finish(run);
            SimulationParameters resting = parameters.Copy();
            resting.Drive.InsertionSpeed = 0.0;
            resting.Method.MaxSimulationSteps = 1000;
            resting.Method.DeltaThreshold = 1e-4;
            run = Wires.Run(run.Continue(resting));
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            // The same place of both hubs, from the start at rest there.
            SimulationParameters still = CoaxialScenes.Pair(integrator);
            still.Scene.InitialState = InitialState.Equilibrium;
            still.Scene.GuidewireOffset += 0.02 * 0.4 / Unit;
            ((Catheter)still.Scene.Catheters[0]).Start -= 0.02 * 0.4 / Unit;
            still.Method.MaxSimulationSteps = 0;
            Simulation rest = Simulation.Create(still);
            Assert.That(rest.Outcome, Is.EqualTo(Outcome.Converged), rest.Reason);
            Assert.That(Wires.Distance(run.State, rest.State), Is.LessThan(1e-3));
            Assert.That(run.Coaxial()!.Extension, Is.EqualTo(rest.Coaxial()!.Extension).Within(1e-9));
        }

        [Test]
        public void RunThatIsRestored_TakesTheSameSteps([Values(Integrator.ImplicitEuler, Integrator.Esdirk3)]
            Integrator integrator)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(integrator);
            parameters.Drive.InsertionSpeed = 0.2;
            parameters.Drive.RotationSpeed = 2.0;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = 0.07;
            parameters.Method.MaxSimulationSteps = 160;
            Simulation run = Wires.RunAndRestore(parameters, 70);
            parameters.Scene.Catheters = Array.Empty<Catheter>();
            Assert.That(() => run.Continue(parameters), Throws.ArgumentException.With.Message.StartsWith("catheters"));
        }

        [TestCase(0.4, 0.0)]
        [TestCase(-0.6, 0.0)]
        [TestCase(0.0, 0.5)]
        [TestCase(0.0, -0.5)]
        public void HubsGoAsFarAsTheyMay(double wire, double catheter)
        {
            // Steered, for what a file asks beyond is refused: in till the hubs meet and on together, back till the tip
            // is in the catheter's first element, the catheter over the wire and back with its hub.
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Drive.Steering = new Steering { Push = wire / Unit * parameters.Method.TimeStep };
            parameters.Scene.Catheters[0].Drive.Steering =
                new Steering { Push = catheter / Unit * parameters.Method.TimeStep };
            Simulation run = Simulation.Create(parameters);
            double start = run.Coaxial()!.Extension;
            double went = 0.0;
            double wireWent = 0.0;
            CoaxialRecord record = run.Coaxial()!;
            for (int k = 0; k < 500 && run.Outcome == Outcome.Running; k++)
            {
                double from = record.Insertion;
                double wireFrom = run.Hub()!.Insertion;
                run.Step();
                record = run.Coaxial()!;
                went += Math.Abs(record.Insertion - from);
                wireWent += Math.Abs(run.Hub()!.Insertion - wireFrom);
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            double asked = 500.0 * parameters.Method.TimeStep;
            Assert.That(record.CommandedDisplacement, Is.EqualTo(asked * Math.Abs(catheter)).Within(1e-9));
            Assert.That(record.WireCommandedDisplacement, Is.EqualTo(asked * Math.Abs(wire)).Within(1e-9));
            Assert.That(record.Displacement, Is.EqualTo(catheter == 0.0 ? 0.0 : went).Within(1e-9));
            Assert.That(record.WireDisplacement, Is.EqualTo(wire == 0.0 ? 0.0 : wireWent).Within(1e-9));
            double gone = run.Hub()!.Insertion - record.Insertion;
            bool isOut = wire > 0.0 || catheter < 0.0;
            Assert.That(wire != 0.0 ? wireWent + record.WireShortfall : went + record.Shortfall,
                Is.EqualTo(asked * Math.Abs(wire + catheter)).Within(1e-9));
            Assert.That(record.Shortfall + record.WireShortfall, isOut ? Is.Zero : Is.GreaterThan(0.1));
            double expected = isOut ? 0.1 : -(start + 0.25 - 0.01);
            Assert.That(gone, Is.EqualTo(expected).Within(1e-9));
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running));
        }

        [Test]
        public void TipInside_LiesInTheBallOfTheTipAroundIt_OrHasANodeOfItsOwn(
            [Values(4, 8, 40, 200)] int elements, [Values(0.3, 0.445, 0.58)] double radius)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Scene.NumberRodElements = elements;
            parameters.Scene.Catheters[0].Start = 152.0;    // the tip 2 mm inside
            parameters.Material.WireRadius = radius * Unit;
            double[] times = { 0.0, 0.2, 0.4 };
            parameters.Drive.Table = new DriveTable(new TimeTable(times, new[] { 0.0, 4e-3, 0.0 }),
                new TimeTable(times, new double[3]));
            MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
            var run = (DirectStep)start.Stepper;
            int within = run.Dynamics.Terms.Rod.ElementCount;
            int with = 0;
            for (int k = 1; k <= 200; k++)
            {
                run.Advance(start.State);
                Assert.That(run.Failure, Is.Null);
                double beyond = 2e-3 - Math.Abs(k * parameters.Method.TimeStep - 0.2) * 0.02;
                bool hasNode = run.Dynamics.Terms.Rod.ElementCount > within;
                Assert.That(hasNode || beyond + radius * Unit < 0.83e-3 + 1e-9, beyond + " m beyond, without a node");
                Assert.That(!hasNode || beyond > 0.0, beyond + " m beyond, with a node");
                with += hasNode ? 1 : 0;
            }
            Assert.That(with, Is.GreaterThan(70));
        }

        [Test]
        public void RestShape_HasThePlayOfItsOverlap()
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Method.MaxSimulationSteps = 0;
            CoaxialRecord record = Simulation.Create(parameters).Coaxial()!;
            // The catheter's bent tip over a straight part of the wire: sqrt(3 d k) and sqrt(12 d/k).
            double mismatch = new Vector3d(30.0, 10.0, 0.0).Length;
            double play = 0.6e-3 - 0.445e-3;
            Assert.That(record.PlayAngle, Is.EqualTo(180.0 / Math.PI * Math.Sqrt(3.0 * play * mismatch)).Within(1e-9));
            Assert.That(record.PlayLength, Is.EqualTo(Math.Sqrt(12.0 * play / mismatch)).Within(1e-12));
        }

        // A wire is bent by a load beyond a straight guide: a sheath, or a catheter 9,000 times stiffer. It is driven
        // back by M^2/2B, and either has its own error of second order in that.
        [Test]
        public void StiffStraightCatheter_IsASheath()
        {
            Simulation sheath = Guided(60, false);
            Simulation catheter = Guided(60, true);
            Vector3d tip = sheath.State.Positions[60] - catheter.State.Positions[60];
            double force = sheath.Hub()!.Force;
            TestContext.WriteLine("tips {0:G3} mm apart, forces {1:G5} and {2:G5} N", tip.Length, force,
                catheter.Hub()!.Force);
            Assert.That(sheath.State.Positions[60].X, Is.GreaterThan(8.0), "mm: it is bent");
            Assert.That(tip.Length, Is.LessThan(1e-3 * 140.0));
            Assert.That(catheter.Hub()!.Force, Is.EqualTo(force).Within(1e-2 * Math.Abs(force)));
        }

        // 300 mm of wire of which 142.5 are beyond the guide, between two nodes.
        private static Simulation Guided(int elements, bool hasCatheter)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            Catheter catheter = parameters.Scene.Catheters[0];
            parameters.Scene.Catheters = Array.Empty<Catheter>();
            parameters.Scene.GuidewireLength = 300.0;
            parameters.Scene.NumberRodElements = elements;
            parameters.Scene.TipForce = new Vector3d(0.02, 0.0, 0.0);
            parameters.Scene.Walls = new ContactShape[] { new PlaneShape(new Vector3d(0.0, -500.0, 0.0),
                Vector3d.UnitY) };
            parameters.Material.Sections = Array.Empty<WireSection>();
            parameters.Material.MassDamping = 30.0;
            parameters.Drive.InsertionSpeed = 0.0;
            parameters.Method.TimeStep = 0.05;
            parameters.Method.MaxSimulationSteps = 200;
            if (hasCatheter)
            {
                catheter.Length = 157.5;
                catheter.Elements = elements / 2;
                catheter.Start = 0.0;
                catheter.Material.Sections = Array.Empty<WireSection>();
                catheter.Material.YoungsModulus = 1e3 * parameters.Material.YoungsModulus;
                catheter.Material.ShearModulus = 1e3 * parameters.Material.ShearModulus;
                parameters.Scene.Catheters = new[] { catheter };
            }
            else
            {
                parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, 157.5) };
            }
            Simulation run = Simulation.Create(parameters);
            Wires.Finish(run);
            return run;
        }

        // Both lie in a straight gutter and move together; the wire's tip is inside. What holds them back is the weight
        // of both times the coefficient of the catheter's outside, and drag.
        [TestCase(0.3, 0.0)]
        [TestCase(0.0, 0.3)]
        [TestCase(double.NaN, 0.2)]
        public void CatheterHasItsOwnFrictionOnWalls(double outside, double wall)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            Catheter catheter = parameters.Scene.Catheters[0];
            parameters.Scene.GuidewireLength = 340.0;
            parameters.Material.Sections = Array.Empty<WireSection>();
            catheter.Material.Sections = Array.Empty<WireSection>();
            catheter.FrictionCoefficient = outside;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.Walls = new ContactShape[]
            {
                new PlaneShape(new Vector3d(0.0, -0.9, 0.0), Vector3d.UnitY) { FrictionCoefficient = wall },
            };
            parameters.Material.MassDamping = 2.0;
            const double speed = 5e-3;
            parameters.Drive.InsertionSpeed = speed;
            catheter.Drive.InsertionSpeed = speed;
            parameters.Method.TimeStep = 0.02;
            parameters.Method.MaxSimulationSteps = 101;
            Simulation run = Simulation.Create(parameters);
            double sum = 0.0;
            double normal = 0.0;
            for (int k = 0; k < 100; k++)
            {
                run.Step();
                sum += k < 50 ? 0.0 : run.Contacts!.Reaction.Z / 50.0;
                normal += k < 50 ? 0.0 : run.Contacts!.WallForces[0].Y / 50.0;
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            Assert.That(run.Coaxial()!.Extension, Is.LessThan(0.0));
            // A plane carries all of it but what hangs on the hub.
            double coefficient = double.IsNaN(outside) ? wall : outside;
            double drag = 2.0 * speed * normal / 9.81;
            Assert.That(normal, Is.GreaterThan(1e-3));
            Assert.That(sum, Is.EqualTo(coefficient * normal + drag).Within(0.01 * normal));
        }

        // Both tips come up against a wall across their axis, with the force at which a hub slips.
        [TestCase(0.03, 0.0)]
        [TestCase(0.0, 0.05)]
        [TestCase(0.03, 0.2)]
        public void HubSlips_WhereItWouldTakeMoreThanItsForce(double wire, double catheter)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            Catheter outer = parameters.Scene.Catheters[0];
            parameters.Scene.Walls = new ContactShape[]
            {
                new PlaneShape(new Vector3d(0.0, 0.0, 402.0), -Vector3d.UnitZ),
            };
            parameters.Drive.InsertionSpeed = 0.1;
            parameters.Drive.HubForceLimit = wire;
            outer.Drive.InsertionSpeed = 0.1;
            outer.Drive.HubForceLimit = catheter;
            parameters.Method.MaxSimulationSteps = 150;
            Simulation run = Simulation.Create(parameters);
            double maxWire = 0.0;
            double maxCatheter = 0.0;
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
                maxWire = Math.Max(maxWire, Math.Abs(run.Coaxial()!.WireForce));
                maxCatheter = Math.Max(maxCatheter, Math.Abs(run.Coaxial()!.Force));
            }
            CoaxialRecord record = run.Coaxial()!;
            TestContext.WriteLine("{0:G4} and {1:G4} N, short by {2:G4} and {3:G4} m", maxWire, maxCatheter,
                record.WireShortfall, record.Shortfall);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(maxWire, wire > 0.0 ? Is.InRange(0.9 * wire, 1.001 * wire) : Is.GreaterThan(0.0));
            Assert.That(maxCatheter, catheter > 0.0 ? Is.LessThan(1.001 * catheter) : Is.GreaterThan(0.0));
            Assert.That(record.WireShortfall > 1e-3, Is.EqualTo(wire > 0.0));
            Assert.That(record.WireCommandedDisplacement,
                Is.EqualTo(record.WireDisplacement + record.WireShortfall).Within(1e-12));
            Assert.That(record.CommandedDisplacement, Is.EqualTo(record.Displacement + record.Shortfall).Within(1e-12));
            Assert.That(run.Contacts!.Passages, Is.Zero);
        }

        // All three go on together, and the wire's tip comes up against a wall across its axis.
        [TestCase(0.03, 0.0, 0.0)]
        [TestCase(0.03, 0.006, 0.0)]
        [TestCase(0.03, 0.006, 0.05)]
        public void HubsOfThree_SlipWhereTheyWouldTakeMoreThanTheirForces(double wire, double inner, double outer)
        {
            SimulationParameters parameters = CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Scene.Walls = new ContactShape[]
            {
                new PlaneShape(new Vector3d(0.0, 0.0, 402.0), -Vector3d.UnitZ),
            };
            parameters.Drive.InsertionSpeed = 0.1;
            parameters.Drive.HubForceLimit = wire;
            double[] limits = { outer, inner };
            for (int k = 0; k < 2; k++)
            {
                parameters.Scene.Catheters[k].Drive.InsertionSpeed = 0.1;
                parameters.Scene.Catheters[k].Drive.HubForceLimit = limits[k];
            }
            parameters.Method.MaxSimulationSteps = 120;
            Simulation run = Simulation.Create(parameters);
            var most = new double[3];
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
                CoaxialRecord record = run.Coaxial()!;
                double[] forces = { record.Force, record.Inside!.Force, record.WireForce };
                for (int k = 0; k < 3; k++)
                {
                    most[k] = Math.Max(most[k], Math.Abs(forces[k]));
                }
            }
            TestContext.WriteLine("{0:G4}, {1:G4} and {2:G4} N", most[0], most[1], most[2]);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(most[2], Is.InRange(0.9 * wire, 1.001 * wire));
            for (int k = 0; k < 2; k++)
            {
                Assert.That(most[k], limits[k] > 0.0 ? Is.InRange(0.9 * limits[k], 1.001 * limits[k])
                    : Is.GreaterThan(0.01));
            }
            Assert.That(run.Coaxial()!.WireShortfall, Is.GreaterThan(1e-3));
            Assert.That(run.Contacts!.Passages, Is.Zero);
        }
    }
}
