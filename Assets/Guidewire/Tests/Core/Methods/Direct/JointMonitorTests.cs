using System;
using System.Text.RegularExpressions;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Wires wound up by more than their joints can tell: a run fails and says what would do, or its couple is
    /// GJ phi/L.</summary>
    public sealed class JointMonitorTests
    {
        private const int N = 30;

        // A pull that keeps the wire straight: Greenhill's couple M_c = 2 sqrt(EI T) of a long wire, with a margin.
        private static double Pull(double turn)
        {
            double couple = Rods.TwistStiffness * turn / Rods.Length;
            return 1.1 * couple * couple / (4.0 * Rods.BendStiffness);
        }

        // The joint next to a fourth-order clamp stands for 7/6 of an element: half a turn is there at 80.8 rad.
        [TestCase(78.0, true)]
        [TestCase(95.0, false)]
        [TestCase(150.0, false)]
        [TestCase(-314.0, false)]
        [TestCase(500.0, false)]
        public void WoundUpAtRest_TheCoupleIsThatOfAllTurns_OrTheRunFails(double turn, bool isWithin)
        {
            if (Math.Abs(turn) > 300.0)
            {
                Rods.OnlyInFull("fewer turns");
            }
            Simulation run = Simulation.Create(Wound(N, turn));
            if (isWithin)
            {
                CheckCouple(run, turn);
                return;
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed));
            Assert.That(run.Reason, Does.Match(@"joint (1|29) is turned by 3\.\d+ rad"));
            int proposed = Proposed(run.Reason);
            Assert.That(proposed, Is.GreaterThan(N * Math.Abs(turn) / (0.98 * Math.PI * N)));
            Assert.That(proposed, Is.LessThan(1.5 * Math.Abs(turn)));
            CheckCouple(Simulation.Create(Wound(proposed, turn)), turn);
        }

        /// <summary>Twist of far more than a wire without a pull can hold straight: each time it has bent into a loop
        /// it could pass through itself and lose two turns; rest without a word would be a straight wire without a
        /// couple.</summary>
        [TestCase(150.0)]
        [TestCase(-60.0)]
        public void WireThatPassesThroughItself_Fails(double turn)
        {
            SimulationParameters parameters = Wound(60, turn);
            parameters.Scene.AxialForce = 0.0;
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            Assert.That(run.Reason, Does.Contain("passed through itself"));
            Assert.That(run.Reason, Does.Contain("distalRotation"));
        }

        /// <summary>Bent, tilted and twisted by whole turns, a wire that points forward has the turn of its clamps
        /// whatever its shape: Fuller's theorem, on a shape made for it.</summary>
        [TestCase(0.0)]
        [TestCase(11.0)]
        [TestCase(-37.0)]
        public void TurnFromClampToClamp_IsThatOfTheClamps_HoweverTheWireIsBent(double turn)
        {
            SimulationParameters parameters = Rods.Clamped(N, Solver.Direct, 1e-3, 1);
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalRotation = turn;
            var scene = new MaterialScene(parameters, new Scene(parameters));
            RodShape shape = scene.Shape;
            var watch = new LinkMonitor(scene.Supports, scene.Schedule, shape);
            var random = new System.Random(4);
            for (int j = 0; j < N; j++)
            {
                Vector3d tilt = Wires.Any(random);
                shape.Q[j] = RotationVector.Exp(0.8 * new Vector3d(tilt.X, tilt.Y, 0.0))
                    * Quaterniond.FromAxisAngle(Vector3d.UnitZ, turn * (j + 0.5) / N);
            }
            scene.Schedule.TurnFrames(shape, 0.0, turn, 0.0);
            Assert.That(watch.FindLost(shape, turn), Is.Null);
            Assert.That(watch.FindLost(shape, turn + 4.0 * Math.PI), Does.Contain("has lost 2:"));
        }

        [TestCase(Solver.Direct, 1)]
        [TestCase(Solver.Xpbd, 200)]
        [TestCase(Solver.Explicit, 2000)]
        public void WoundUpInMotion_TheRunFails(Solver solver, int substeps)
        {
            // 4 rad a joint in the end, in a ramp of 20 ms, 130 times what a wave of twist takes along the wire.
            SimulationParameters parameters = Rods.Clamped(6, solver, 2e-4, 200);
            parameters.Method.Substeps = substeps;
            parameters.Material.WireRadius = 2e-3;
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalRotation = 24.0;
            parameters.Scene.DistalRampTime = 0.02;
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            Assert.That(run.Reason, Does.Match(@"joint \d is turned by 3\.\d+ rad"));
            Assert.That(Proposed(run.Reason), Is.GreaterThanOrEqualTo(24.0 / (0.98 * Math.PI)));
        }

        [Test]
        public void TwistedAtOnce_AndLetGo_TheRunFails_ThoughNoStepEndsNearHalfATurn()
        {
            // 0.5 rad a step until 60 turns are in: joints pass half a turn between two looks.
            SimulationParameters parameters = Rods.Clamped(3, Solver.Direct, 1e-3, 800);
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Drive.TwistPerStep = 2.5;
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            Assert.That(run.Reason, Does.Match(@"joint \d"));
        }

        [Test]
        public void SignsOfAStart_AreNoTurns()
        {
            // q and -q are the same orientation.
            SimulationParameters parameters = Rods.Clamped(8, Solver.Direct, 1e-3, 3);
            RodStart start = Wires.Random(8, 300.0, 5);
            for (int j = 0; j < 8; j += 3)
            {
                start.Orientations[j] = -1.0 * start.Orientations[j];
            }
            parameters.Scene.Start = start;
            Assert.That(Wires.Run(parameters).Outcome, Is.EqualTo(Outcome.Finished));
        }

        /// <summary>A piece that is a million times softer, shorter than an element, takes the whole turn of a folded
        /// wire: no number of elements of the rest changes that, and none is proposed.</summary>
        [Test]
        public void HingeOfOneJoint_IsTooSharp_WithoutANumberThatWouldDo([Values(1, 3)] int elements)
        {
            SimulationParameters parameters = Rods.Clamped(N, Solver.Direct, 1e-3, 2000);
            double length = parameters.Scene.GuidewireLength;
            double from = 0.5 * length;
            parameters.Material.Sections = new[]
            {
                new WireSection
                {
                    From = from, To = from + 0.1 * length / N, YoungsModulus = 1e-5 * parameters.Material.YoungsModulus,
                    NumberRodElements = elements,
                },
            };
            parameters.Scene.TipForce = new Vector3d(0.0, -3.0 * Rods.BendForce, -10.0 * Rods.BendForce);
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            Assert.That(run.Reason, Does.StartWith("joint ").And.Not.Contain("would do = "));
            Assert.That(run.Reason, Does.Not.Match("numberRodElements = [0-9]"));
        }

        private static SimulationParameters Wound(int n, double turn)
        {
            SimulationParameters parameters = Rods.Clamped(n, Solver.Direct, 1e-3, 0);
            parameters.Scene.DistalEnd = DistalEnd.Sliding;
            parameters.Scene.AxialForce = Pull(turn);
            parameters.Scene.DistalRotation = turn;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            return parameters;
        }

        private static int Proposed(string reason) =>
            int.Parse(Regex.Match(reason, @"numberRodElements = (\d+) would do").Groups[1].Value);

        private static void CheckCouple(Simulation run, double turn)
        {
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            double expected = Rods.TwistStiffness * turn / Rods.Length;
            Assert.That(run.Report()!.DistalMoment!.Value.Z, Is.EqualTo(expected).Within(1e-8 * Math.Abs(expected)));
        }
    }
}
