using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Snaps and violent releases in steps that are far longer than they: steps without a solution are
    /// halved.</summary>
    public sealed class SnapTests
    {
        /// <summary>A wire that is a coil at rest is let go from straight, and comes to rest in its coil.</summary>
        [TestCase(1.5, Integrator.ImplicitEuler)]
        [TestCase(3.0, Integrator.Esdirk3)]
        [TestCase(6.0, Integrator.Esdirk3, Category = "Long")]
        [TestCase(6.0, Integrator.Bdf2)]
        [TestCase(4.0, Integrator.Trbdf2)]
        public void CoilLetGoFromStraight_WindsUp(double turns, Integrator integrator)
        {
            const int N = 40;
            SimulationParameters parameters = Rods.Clamped(N, Solver.Direct, 0.01, 400);
            parameters.Method.Integrator = integrator;
            parameters.Method.DeltaThreshold = 0.01;
            parameters.Material.MassDamping = 10.0;
            parameters.Material.RestCurvature = new Vector3d(2.0 * Math.PI * turns / Rods.Length, 0.0, 0.0);
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            TestContext.WriteLine("{0} halved", run.Report()!.HalvedSteps);
            Vector3d expected = Rods.Length / N * parameters.Material.RestCurvature;
            for (int j = 3; j < N; j++)
            {
                Vector3d turn = RotationVector.Log(
                    run.State.Orientations[j - 1].Conjugate * run.State.Orientations[j]);
                Assert.That((turn - expected).Length, Is.LessThan(0.01 * expected.Length), "joint " + j);
            }
        }

        /// <summary>An arch under a weight that grows through it: from where the arch without disturbances is unstable
        /// on only steps of milliseconds have a solution, and steps of 0.1 s are followed in such pieces until it has
        /// snapped through. Where each step began from its whole length, 3735 pieces had none.</summary>
        [TestCase(0.1)]
        [TestCase(0.07)]
        public void ArchUnderAGrowingWeight_SnapsThrough_InFewPiecesWithoutASolution(double timeStep)
        {
            SimulationParameters parameters = Rods.Clamped(40, Solver.Direct, timeStep, (int)(40.0 / timeStep));
            parameters.Method.Integrator = Integrator.ImplicitEuler;
            parameters.Material.MassDamping = 30.0;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalDisplacement = -30.0;
            parameters.Scene.Gravity = new Vector3d(0.0, -2306.184323858744, 0.0);
            parameters.Scene.GravityTable = new TimeTable(new[] { 0.0, 2.0, 40.0 }, new[] { -0.1, 0.0, 1.0 });
            Simulation run = Simulation.Create(parameters);
            double highest = double.NegativeInfinity;
            while (run.Outcome == Outcome.Running)
            {
                highest = Math.Max(highest, run.State.Positions[20].Y);
                run.Step();
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            TestContext.WriteLine("{0} halved, {1} pieces", run.Report()!.HalvedSteps, run.Report()!.InnerSteps);
            Assert.That(highest, Is.GreaterThan(50.0));
            Assert.That(run.State.Positions[20].Y, Is.LessThan(-50.0));
            Assert.That(run.Report()!.HalvedSteps, Is.InRange(5.0, 100.0));
        }

        /// <summary>Between walls, with so few iterations that only the shortest pieces have a solution, or none: the
        /// run fails at once and says what is too small.</summary>
        [TestCase(1)]
        [TestCase(2)]
        [TestCase(3)]
        public void StepWithTooFewIterations_FailsAfterABoundedNumberOfThem(int most)
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.02, 100.0, 100.0);
            parameters.Method.MaxNewtonIterations = most;
            Simulation run = Simulation.Create(parameters);
            double before = 0.0;
            while (run.Outcome == Outcome.Running)
            {
                before = run.Report()!.WallIterations;
                run.Step();
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed));
            Assert.That(run.Reason, Does.Contain("maxNewtonIterations is below its default"));
            // One solution more than the step may take, and what the last piece may.
            Assert.That(run.Report()!.WallIterations - before, Is.LessThanOrEqualTo((200 + 1 + 11) * most));
        }

        /// <summary>5 N at once on the tip of a wire of 0.3 mm along the axis of a tube bent to and fro: it is
        /// pulled against the walls within the first step, and steps of 2 to 16 ms all come to the same shape. Halved
        /// no further than to 1/64 the first step by esdirk3 has no solution, to 1/16 by neither.</summary>
        [TestCase(Integrator.ImplicitEuler)]
        [TestCase(Integrator.Esdirk3, Category = "Long")]
        public void LoadAtOnceBetweenWalls_EndsInTheSameShapeWhateverTheStep(Integrator integrator)
        {
            const double Tolerance = 1e-3;  // mm
            Vector3d[]? first = null;
            foreach (double step in new[] { 0.016, 0.008, 0.004, 0.002 })
            {
                SimulationParameters parameters = PulledInATube(step);
                parameters.Method.Integrator = integrator;
                Vector3d tip = parameters.Scene.Start!.Positions[parameters.Scene.NumberRodElements];
                Simulation run = Wires.Finish(parameters);
                Assert.That(run.Report()!.HalvedSteps, Is.GreaterThan(0L), "no step was too long");
                Vector3d[] x = run.State.Positions;
                Assert.That(Vector3d.Distance(x[x.Length - 1], tip), Is.GreaterThan(1.0), "the slack is pulled out");
                first ??= (Vector3d[])x.Clone();
                double farthest = Wires.Distance(x, first);
                TestContext.WriteLine("{0} s: {1} halved, {2:G3} mm", step, run.Report()!.HalvedSteps, farthest);
                Assert.That(farthest, Is.LessThan(Tolerance), "steps of " + step + " s");
            }
        }

        // Along the axis of a tube of radius 1 mm: straight, two quarters of circles of 22 mm, straight.
        private static SimulationParameters PulledInATube(double step)
        {
            const int N = 60;
            const double Length = 100.0;
            const double R = 22.0;
            const int Pieces = 20;
            var knots = new List<Vector3d> { Vector3d.Zero };
            for (int k = 0; k <= Pieces; k++)
            {
                double angle = 0.5 * Math.PI * k / Pieces;
                knots.Add(new Vector3d(R * (1.0 - Math.Cos(angle)), 0.0, 30.0 + R * Math.Sin(angle)));
            }
            for (int k = 1; k <= Pieces; k++)
            {
                double angle = 0.5 * Math.PI * k / Pieces;
                knots.Add(new Vector3d(R + R * Math.Sin(angle), R * (1.0 - Math.Cos(angle)), 30.0 + R));
            }
            knots.Add(new Vector3d(2.0 * R, R + 100.0, 30.0 + R));
            SimulationParameters parameters = WallScenes.Soft(WallScenes.Wire(N, 0.15e-3), 1e10);
            parameters.Material.MassDamping = 50.0;
            parameters.Method.TimeStep = step;
            parameters.Method.MaxSimulationSteps = (int)Math.Round(0.16 / step);
            parameters.Scene.GuidewireLength = Length;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.TipForce = 5.0 * Vector3d.Normalize(new Vector3d(0.433, 0.866, 0.25));
            parameters.Scene.Walls = new ContactShape[]
            {
                new TubeShape(knots.ToArray(), knots.ConvertAll(_ => 1.0).ToArray(), true, true),
            };
            parameters.Scene.Start = Along(knots, N, Length);
            return parameters;
        }

        // At rest, from 2 mm behind the first knot on, its frames carried along without twist.
        private static RodStart Along(List<Vector3d> knots, int n, double length)
        {
            var x = new Vector3d[n + 1];
            var q = new Quaterniond[n];
            int knot = 1;
            double behind = 0.0;
            for (int i = 0; i <= n; i++)
            {
                double s = 2.0 + length * i / n;
                while (s - behind > Vector3d.Distance(knots[knot - 1], knots[knot]))
                {
                    behind += Vector3d.Distance(knots[knot - 1], knots[knot]);
                    knot++;
                }
                x[i] = knots[knot - 1] + (s - behind) * Vector3d.Normalize(knots[knot] - knots[knot - 1]);
            }
            Quaterniond frame = Quaterniond.Identity;
            for (int j = 0; j < n; j++)
            {
                Vector3d along = Vector3d.Normalize(x[j + 1] - x[j]);
                Vector3d across = Vector3d.Cross(frame.Director3, along);
                if (across.Length > 1e-12)
                {
                    double angle = Math.Atan2(across.Length, Vector3d.Dot(frame.Director3, along));
                    frame = Quaterniond.Normalize(
                        Quaterniond.FromAxisAngle(Vector3d.Normalize(across), angle) * frame);
                }
                q[j] = frame;
            }
            return new RodStart(x, q, new Vector3d[n + 1], new Vector3d[n]);
        }
    }
}
