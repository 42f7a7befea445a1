using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The link of a wire between two clamps, against Gauss's integral, and runs that lose turns, whatever
    /// these are from.</summary>
    public sealed class LinkMonitorTests
    {
        private const int N = 60;

        // Curves with loops, whose elements point anywhere; both extensions go along z for ever.
        [TestCase(1)]
        [TestCase(2)]
        [TestCase(3)]
        [TestCase(4)]
        [TestCase(5)]
        [TestCase(6)]
        public void Link_IsTwistAndWrithe_HoweverTheWireIsBent(int seed)
        {
            var random = new System.Random(seed);
            RodShape shape = Rods.Straight(Rods.Wire(N));
            Vector3d[] waves = Array.ConvertAll(new int[8], _ => Wires.Any(random));
            for (int i = 0; i <= N; i++)
            {
                double s = (double)i / N;
                Vector3d x = s * Vector3d.UnitZ;
                for (int k = 0; k < waves.Length; k++)
                {
                    x += (0.4 * Math.Pow(Math.Sin(Math.PI * s), 2.0) * Math.Sin(Math.PI * (k + 1) * s + k)) * waves[k];
                }
                shape.X[i] = x;
            }
            double turn = 40.0 * (random.NextDouble() - 0.5);
            Quaterniond frame = Quaterniond.Identity;
            for (int j = 0; j < N; j++)
            {
                frame = RodStart.Turned(frame, shape.X[j + 1] - shape.X[j])
                    * Quaterniond.FromAxisAngle(Vector3d.UnitZ, turn / N);
                shape.Q[j] = frame;
            }
            shape.DistalFrame = RodStart.Turned(frame, Vector3d.UnitZ);
            double expected = turn + 2.0 * Math.PI * Writhe(shape);
            LinkMonitor monitor = Monitor(out RodSchedule _);
            double link = monitor.Measure(shape);
            Assert.That(link, Is.EqualTo(expected).Within(1e-3), "of two that do not know of one another");
            Assert.That(Math.Abs(link), Is.GreaterThan(0.1));
        }

        // A kink that goes through itself takes two turns along, whatever points back.
        [Test]
        public void LoopThatChangesSides_HasTwoTurnsLess()
        {
            LinkMonitor monitor = Monitor(out RodSchedule _);
            double right = monitor.Measure(Loop(0.02));
            double left = monitor.Measure(Loop(-0.02));
            Assert.That(Math.Abs(right - left), Is.EqualTo(4.0 * Math.PI).Within(1e-9));
            monitor.Begin(Loop(0.02), 5.0);
            Assert.That(monitor.FindLost(Loop(0.03), 5.0), Is.Null);
            Assert.That(monitor.FindLost(Loop(-0.02), 5.0), Does.Contain("has lost 2: "));
        }

        // Twist of a start that no clamp has made, of a wire that can slide and pays out as loops.
        [TestCase(Solver.Direct, 3.0)]
        [TestCase(Solver.Direct, -6.0)]
        public void TurnsOfAStart_ThatAreLost_EndTheRun(Solver solver, double turns)
        {
            SimulationParameters parameters = Twisted(solver, turns);
            parameters.Scene.Gravity = new Vector3d(0.0, -0.1, 0.0);
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            Assert.That(run.Reason, Does.Contain("passed through itself").Or.Contain("joint"));
        }

        // The same with a pull: Greenhill's couple 2 sqrt(EI T) of 60 N is that of 5.6 turns.
        [TestCase(Solver.Direct)]
        [TestCase(Solver.Xpbd)]
        public void TurnsOfAStart_ThatArePulledStraight_AreKept_AlsoWhereTheRunIsTakenUpAgain(Solver solver)
        {
            SimulationParameters parameters = Twisted(solver, 3.0);
            parameters.Scene.AxialForce = solver == Solver.Direct ? 60.0 : 0.0;
            parameters.Scene.DistalEnd = solver == Solver.Direct ? DistalEnd.Sliding : DistalEnd.Clamped;
            parameters.Scene.DistalRotation = 4.0;
            parameters.Scene.DistalRampTime = 0.2;
            parameters.Method.MaxSimulationSteps = 30;
            Simulation run = Wires.RunInParts(parameters, 30, 7, 14, out Simulation part);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(part.Outcome, Is.EqualTo(Outcome.Finished), part.Reason);
        }

        // Wound up between clamps that have come nearer, then moved on as a run of its own: turns of before.
        [Test]
        [Category("Long")]
        public void TurnsOfAnEarlierRun_ThatAreLost_EndTheNext()
        {
            SimulationParameters parameters = Rods.Clamped(N, Solver.Direct, 0.01, 250);
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalDisplacement = -80.0;
            parameters.Scene.DistalRotation = 7.0 * Math.PI;
            parameters.Scene.DistalRampTime = 1.75;
            parameters.Scene.Gravity = new Vector3d(0.0, -0.1, 0.0);
            parameters.Material.MassDamping = 20.0;
            Simulation run = Wires.Finish(parameters);
            SimulationParameters pulled = parameters.Copy();
            pulled.Scene.Start = run.State.ToStart(Quaterniond.Identity,
                Quaterniond.FromAxisAngle(Vector3d.UnitZ, 7.0 * Math.PI));
            pulled.Scene.DistalRotation = 0.0;
            pulled.Scene.DistalDisplacement = -30.0;
            pulled.Scene.DistalRampTime = 1.0;
            Simulation next = Wires.Run(pulled);
            Assert.That(next.Outcome, Is.EqualTo(Outcome.Failed), next.Reason);
            Assert.That(next.Reason, Does.Contain("of 3.5 turns").And.Contain("passed through itself"));
        }

        private static SimulationParameters Twisted(Solver solver, double turns)
        {
            SimulationParameters parameters = Rods.Clamped(N, solver, 0.01, 100);
            parameters.Method.Substeps = 50;
            parameters.Material.MassDamping = 20.0;
            parameters.Scene.DistalEnd = DistalEnd.Sliding;
            var positions = new Vector3d[N + 1];
            var orientations = new Quaterniond[N];
            for (int i = 0; i <= N; i++)
            {
                positions[i] = new Vector3d(0.0, 0.0, 300.0 * i / N);
            }
            for (int j = 0; j < N; j++)
            {
                orientations[j] = Quaterniond.FromAxisAngle(Vector3d.UnitZ, 2.0 * Math.PI * turns * (j + 0.5) / N);
            }
            parameters.Scene.Start = new RodStart(positions, orientations, null, null);
            return parameters;
        }

        private static LinkMonitor Monitor(out RodSchedule schedule)
        {
            SimulationParameters parameters = Rods.Clamped(N, Solver.Direct, 1e-3, 1);
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            var scene = new MaterialScene(parameters, new Scene(parameters));
            schedule = scene.Schedule;
            return new LinkMonitor(scene.Supports, scene.Schedule, scene.Shape);
        }

        // Along z with one loop, whose two strands cross at a distance, m.
        private static RodShape Loop(double apart)
        {
            // The last joint turns the frames back: the link is a whole number of turns.
            RodShape shape = Rods.Straight(Rods.Wire(N));
            Quaterniond frame = Quaterniond.Identity;
            for (int i = 0; i <= N; i++)
            {
                double u = 4.0 * i / N - 2.0;    // the loop is where |u| < 1
                double angle = Math.PI * (Math.Abs(u) < 1.0 ? u : Math.Sign(u));
                shape.X[i] = new Vector3d(apart * Math.Tanh(3.0 * u), 0.05 * (1.0 + Math.Cos(angle)),
                    0.02 * u + 0.05 * Math.Sin(angle) * -1.0);
            }
            for (int j = 0; j < N; j++)
            {
                frame = RodStart.Turned(frame, shape.X[j + 1] - shape.X[j]);
                shape.Q[j] = frame;
            }
            shape.DistalFrame = Quaterniond.Aligned(frame, Quaterniond.Identity);
            return shape;
        }

        // Gauss's integral of pairs of segments (Klenin and Langowski 2000), the extensions 1e6 times as long.
        private static double Writhe(RodShape shape)
        {
            var x = new Vector3d[N + 3];
            Array.Copy(shape.X, 0, x, 1, N + 1);
            x[0] = x[1] - 1e6 * Vector3d.UnitZ;
            x[N + 2] = x[N + 1] + 1e6 * Vector3d.UnitZ;
            double sum = 0.0;
            for (int i = 0; i < N + 2; i++)
            {
                for (int j = i + 2; j < N + 2; j++)
                {
                    Vector3d a = Unit(Vector3d.Cross(x[j] - x[i], x[j + 1] - x[i]));
                    Vector3d b = Unit(Vector3d.Cross(x[j + 1] - x[i], x[j + 1] - x[i + 1]));
                    Vector3d c = Unit(Vector3d.Cross(x[j + 1] - x[i + 1], x[j] - x[i + 1]));
                    Vector3d d = Unit(Vector3d.Cross(x[j] - x[i + 1], x[j] - x[i]));
                    double area = Angle(a, b) + Angle(b, c) + Angle(c, d) + Angle(d, a);
                    sum += area * Math.Sign(Vector3d.Dot(
                        Vector3d.Cross(x[j + 1] - x[j], x[i + 1] - x[i]), x[j] - x[i]));
                }
            }
            return sum / (2.0 * Math.PI);
        }

        private static double Angle(in Vector3d a, in Vector3d b) =>
            Math.Asin(Math.Max(-1.0, Math.Min(1.0, Vector3d.Dot(a, b))));

        private static Vector3d Unit(in Vector3d v) => v.Length > 0.0 ? (1.0 / v.Length) * v : Vector3d.Zero;
    }
}
