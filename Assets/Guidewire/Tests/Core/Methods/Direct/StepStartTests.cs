using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A step that is repeated begins with the bits with which it began first.</summary>
    public sealed class StepStartTests
    {
        [TestCase(Integrator.ImplicitEuler)]
        [TestCase(Integrator.Bdf2)]
        [TestCase(Integrator.Trbdf2)]
        [TestCase(Integrator.Esdirk3)]
        [TestCase(Integrator.Esdirk4)]
        public void StepsTakenAgainAtRandom_LeaveTheSameBits_InAFreeMotion(Integrator integrator)
        {
            SimulationParameters parameters = Rods.Clamped(8, Solver.Direct, 2e-3, 40);
            parameters.Method.Integrator = integrator;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.TipForce = new Vector3d(0.02, 0.0, 0.0);
            parameters.Scene.TipForceReleaseTime = 0.031;
            parameters.Material.MassDamping = 3.0;
            parameters.Material.MaterialDamping = 1e-4;
            parameters.Drive.RotationSpeed = 4.0;
            parameters.Method.TimeStepError = integrator == Integrator.Esdirk3 ? 1e-5 : 0.0;
            AssertSameBits(parameters, 40, 1);
        }

        [TestCase(Integrator.ImplicitEuler)]
        [TestCase(Integrator.Esdirk3)]
        public void StepsTakenAgainAtRandom_LeaveTheSameBits_BetweenWallsThatRub(Integrator integrator)
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.02, 100.0, 100.0);
            parameters.Method.Integrator = integrator;
            parameters.Scene.Walls[0].FrictionCoefficient = 0.2;
            parameters.Drive.HubForceLimit = 0.2;
            parameters.Drive.RotationSpeed = 5.0;
            AssertSameBits(parameters, 45, 2);
        }

        [Test]
        public void StepsTakenAgainAtRandom_LeaveTheSameBits_OfAWireInASheath()
        {
            SimulationParameters parameters = WallScenes.Arch(60, 0.02, 100.0, 100.0);
            parameters.Scene.GuidewireOffset = -295.0;
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, -10.0) };
            parameters.Scene.Walls[0].FrictionCoefficient = 0.1;
            parameters.Drive.RotationSpeed = 5.0;
            parameters.Material.Sections = new[]
            {
                new WireSection { From = 270.0, To = 300.0, RestCurvature = new Vector3d(5.0, 0.0, 0.0) },
            };
            AssertSameBits(parameters, 45, 4);
        }

        /// <summary>What fibres remember is of a step, and of what is restored.</summary>
        [Test]
        public void StepsTakenAgainAtRandom_LeaveTheSameBits_OfCoresThatGiveWay(
            [Values("free", "walls", "sheath", "catheters")] string scene, [Values] bool isSteel)
        {
            SimulationParameters parameters = scene == "free" ? Rods.Clamped(8, Solver.Direct, 2e-3, 40)
                : scene == "catheters" ? CoaxialScenes.Three(Integrator.ImplicitEuler)
                : WallScenes.Arch(60, 0.02, 100.0, 100.0);
            if (scene == "free")
            {
                parameters.Scene.TipForce = new Vector3d(0.1, 0.0, 0.0);
                parameters.Scene.TipForceReleaseTime = 0.031;
                parameters.Method.TimeStepError = 1e-5;
            }
            else if (scene == "sheath")
            {
                parameters.Scene.GuidewireOffset = -295.0;
                parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, -10.0) };
                parameters.Material.Sections = new[]
                {
                    new WireSection { From = 270.0, To = 300.0, RestCurvature = new Vector3d(5.0, 0.0, 0.0) },
                };
            }
            parameters.Drive.RotationSpeed = 5.0;
            double stress = scene == "free" ? 50e6 : 60e6;
            parameters.Material.Plateau = isSteel ? null
                : new Plateau { Upper = stress, Lower = 0.5 * stress, Strain = 0.02 };
            parameters.Material.YieldStress = isSteel ? stress : (double?)null;
            Assert.That(AssertSameBits(parameters, 45, 6), Is.GreaterThan(0.0), "heat");
        }

        // Nodes come in and go, some of them in the steps that are repeated.
        [TestCase(0.2, 0.0, 0.0, true)]
        [TestCase(-0.3, 0.1, 0.0, true)]
        [TestCase(0.4, 0.1, 0.02, true)]
        [TestCase(0.0, 0.5, 0.0, false)]
        public void StepsTakenAgainAtRandom_LeaveTheSameBits_OfAWireInACatheter(double wire, double catheter,
            double limit, bool hasWalls)
        {
            if (limit > 0.0)
            {
                Rods.OnlyInFull("hubs whose force has no limit, at other speeds");
            }
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Method.TimeStep = 0.01;
            parameters.Drive.InsertionSpeed = wire;
            parameters.Drive.RotationSpeed = 5.0;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = catheter;
            parameters.Scene.Catheters[0].Drive.RotationSpeed = -3.0;
            parameters.Scene.Catheters[0].LumenFriction = 0.1;
            parameters.Drive.HubForceLimit = limit;
            parameters.Scene.Walls = hasWalls ? WallScenes.Tube(-10.0, 700.0, 5.0, friction: 0.1)
                : Array.Empty<ContactShape>();
            AssertSameBits(parameters, 45, 5);
        }

        [Test]
        public void StepWithoutASolution_LeavesTheNextTryNothing()
        {
            // A term that is no number from some evaluation on: whatever a stage has done until then is undone.
            var random = new System.Random(3);
            (RodDynamics a, _) = Failing(RungeKuttaScheme.Esdirk3());
            (RodDynamics b, NotANumber poison) = Failing(RungeKuttaScheme.Esdirk3());
            var start = new StepStart(b.Serialize);
            int failed = 0;
            for (int k = 0; k < 30; k++)
            {
                double dt = k < 15 ? 2e-3 : 1e-3;
                Assert.That(a.Step(dt), Is.Null);
                start.Save();
                poison.Evaluations = random.Next(1, 12);
                failed += b.Step(random.Next(2) == 0 ? dt : 0.5 * dt) == null ? 0 : 1;
                poison.Evaluations = int.MaxValue;
                start.Restore();
                Assert.That(b.Step(dt), Is.Null);
                Assert.That(b.Shape.X, Is.EqualTo(a.Shape.X), "step " + k);
                Assert.That(b.Shape.Q, Is.EqualTo(a.Shape.Q));
                Assert.That(b.Velocities, Is.EqualTo(a.Velocities));
                Assert.That(b.Reactions.Mean.Proximal, Is.EqualTo(a.Reactions.Mean.Proximal));
                Assert.That(b.Time, Is.EqualTo(a.Time));
            }
            Assert.That(failed, Is.GreaterThan(15));
        }

        [TestCase(Integrator.Bdf2)]
        [TestCase(Integrator.Esdirk3)]
        public void RestoredMotion_GoesOnWithTheSameBits_AfterAShorterStep(Integrator integrator)
        {
            // The history of a step of half the length is none for a whole one.
            RodDynamics a = Failing(DirectSetup.Scheme(integrator)).Motion;
            RodDynamics b = Failing(DirectSetup.Scheme(integrator)).Motion;
            const double dt = 1e-3;
            Assert.That(a.Step(dt), Is.Null);
            Assert.That(a.Step(0.5 * dt), Is.Null);
            Assert.That(a.Step(0.5 * dt), Is.Null);
            var snapshot = new Snapshot();
            a.Serialize(snapshot);
            a.SerializeHistory(snapshot, dt);
            Snapshot read = snapshot.ToRead();
            b.Serialize(read);
            b.SerializeHistory(read, dt);
            Assert.That(a.Step(dt), Is.Null);
            Assert.That(b.Step(dt), Is.Null);
            Assert.That(b.Shape.X, Is.EqualTo(a.Shape.X));
            Assert.That(b.Spins, Is.EqualTo(a.Spins));
        }

        [Test]
        public void KeepingAStep_LeavesNoGarbage()
        {
            (RodDynamics dynamics, _) = Failing(RungeKuttaScheme.Esdirk3());
            var start = new StepStart(dynamics.Serialize);
            start.Save();
            Assert.That(Garbage.LeftBy(() =>
            {
                start.Save();
                start.Restore();
            }), Is.Zero);
        }

        // Of two runs one takes steps at random, one or two of them, and then again from where they began.
        private static double AssertSameBits(SimulationParameters parameters, int steps, int seed)
        {
            var random = new System.Random(seed);
            MethodStart a = Start(parameters);
            MethodStart b = Start(parameters);
            int again = 0;
            for (int k = 0; k < steps; k++)
            {
                a.Stepper.Advance(a.State);
                if (random.Next(2) == 0)
                {
                    (Action<Snapshot> exchange, Action take) = StepOf(b);
                    var start = new StepStart(exchange);
                    start.Save();
                    for (int tries = random.Next(1, 3); tries > 0; tries--)
                    {
                        take();
                    }
                    start.Restore();
                    again++;
                }
                b.Stepper.Advance(b.State);
                Assert.That(a.Stepper.Failure, Is.Null);
                Assert.That(b.State.Positions, Is.EqualTo(a.State.Positions), "step " + k);
                Assert.That(b.State.Orientations, Is.EqualTo(a.State.Orientations));
                Assert.That(b.State.Velocities, Is.EqualTo(a.State.Velocities));
                Assert.That(b.State.AngularVelocities, Is.EqualTo(a.State.AngularVelocities));
                Assert.That(b.Stepper.Hub()!.Force, Is.EqualTo(a.Stepper.Hub()!.Force));
                Assert.That(b.Stepper.Hub()!.Insertion, Is.EqualTo(a.Stepper.Hub()!.Insertion));
                Assert.That(b.Stepper.Hub()!.Turn, Is.EqualTo(a.Stepper.Hub()!.Turn));
            }
            Assert.That(again, Is.GreaterThan(steps / 4));
            Assert.That(b.Stepper.Contacts?.Passages, Is.EqualTo(a.Stepper.Contacts?.Passages));
            Assert.That(b.Stepper.Contacts?.DriveAsked, Is.EqualTo(a.Stepper.Contacts?.DriveAsked));
            Assert.That(b.Stepper.Contacts?.DriveShortfall, Is.EqualTo(a.Stepper.Contacts?.DriveShortfall));
            Assert.That(b.Stepper.Report()!.InnerSteps, Is.EqualTo(a.Stepper.Report()!.InnerSteps));
            Assert.That(b.Stepper.Report()!.Extremes!.FrictionWork,
                Is.EqualTo(a.Stepper.Report()!.Extremes!.FrictionWork));
            double heat = a.Stepper.Report()!.Extremes!.MaterialLoss;
            Assert.That(b.Stepper.Report()!.Extremes!.MaterialLoss, Is.EqualTo(heat));
            return heat;
        }

        private static (Action<Snapshot> Exchange, Action Take) StepOf(MethodStart start)
        {
            var step = (DirectStep)start.Stepper;
            return (step.Serialize, () => step.Advance(start.State));
        }

        private static MethodStart Start(SimulationParameters parameters) =>
            MethodBuilder.Build(parameters, new Scene(parameters));

        private static (RodDynamics Motion, NotANumber Poison) Failing(RungeKuttaScheme? scheme)
        {
            MaterialRod rod = Rods.Wire(6);
            rod.MaterialDamping = 1e-4;
            var poison = new NotANumber();
            var terms = new RodTerms(rod, new RodSupports(), new SceneParameters(), poison);
            var schedule = Rods.Schedule(new SceneParameters { Gravity = new Vector3d(0.0, -9.81, 0.0) });
            var motion = new RodDynamics(terms, schedule, Rods.Straight(rod), scheme, 1e-7, 10)
            {
                Reactions = { AreKept = true },
            };
            return (motion, poison);
        }

        /// <summary>No energy, and after some evaluations no number.</summary>
        private sealed class NotANumber : EnergyTerm
        {
            public int Evaluations { get; set; } = int.MaxValue;

            public override double Value(RodShape shape) => Next();

            public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
                ref GradientMeasures measured) => gradient[shape.ElementCount].X1 += Next();

            public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to) =>
                gradient[shape.ElementCount].X1 += Next();

            private double Next() => --Evaluations > 0 ? 0.0 : double.NaN;
        }
    }
}
