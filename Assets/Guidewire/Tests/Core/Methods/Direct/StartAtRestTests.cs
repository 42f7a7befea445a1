using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A start that states no frames of its clamps gets those of its ends.</summary>
    public sealed class StartAtRestTests
    {
        // Half an element's turn, which the clamp would be off by otherwise, moves the tip by 8 to 17 mm here; what the
        // extrapolation leaves is of third order in the element's length.
        [TestCase(ClampRule.FourthOrder, 1.0, 0.02)]
        [TestCase(ClampRule.FourthOrder, 4.0, 0.05)]
        [TestCase(ClampRule.HalfElement, 1.0, 0.02)]
        public void RestShape_UnderALoad_StaysAtRest(ClampRule rule, double k, double millimetres)
        {
            const int N = 30;
            SimulationParameters parameters = Loaded(N, rule, k);
            Simulation rest = Simulation.Create(parameters);
            Assert.That(rest.Outcome, Is.EqualTo(Outcome.Converged), rest.Reason);
            SimulationParameters again = Loaded(N, rule, k);
            again.Scene.InitialState = InitialState.Straight;
            again.Scene.Start = new RodStart(rest.State.Positions, rest.State.Orientations, null, null);
            again.Method.MaxSimulationSteps = 300;
            again.Method.DeltaThreshold = 0.0;
            Simulation simulation = Wires.Finish(again);
            Assert.That(Vector3d.Distance(simulation.State.Positions[N], rest.State.Positions[N]),
                Is.LessThan(millimetres));
        }

        [TestCase(ClampRule.FourthOrder, DistalEnd.Free)]
        [TestCase(ClampRule.HalfElement, DistalEnd.Clamped)]
        [TestCase(ClampRule.FourthOrder, DistalEnd.Clamped)]
        public void Arc_SampledAtTheElementsMiddles_HasTheFramesOfItsEnds(ClampRule rule, DistalEnd distal)
        {
            // kappa = 5/m, n = 12: each element turns by 0.125.
            const int N = 12;
            const double Turn = 0.125;
            var x = new Vector3d[N + 1];
            var q = new Quaterniond[N];
            for (int j = 0; j < N; j++)
            {
                q[j] = Quaterniond.FromAxisAngle(Vector3d.UnitX, Turn * (j + 0.5));
                x[j + 1] = x[j] + 25.0 * q[j].Director3;
            }
            SimulationParameters parameters = Loaded(N, rule, 0.0);
            parameters.Scene.Start = new RodStart(x, q, null, null);
            parameters.Scene.DistalEnd = distal;
            var scene = new MaterialScene(parameters, new Scene(parameters));
            Assert.That(Angle(scene.Shape.ProximalFrame, Quaterniond.Identity), Is.LessThan(1e-12));
            Quaterniond end = distal == DistalEnd.Free ? q[N - 1] : Quaterniond.FromAxisAngle(Vector3d.UnitX, N * Turn);
            Assert.That(Angle(scene.Shape.DistalFrame, end), Is.LessThan(1e-12));
            Assert.That(Angle(scene.Schedule.Hub.Frame, Quaterniond.Identity), Is.LessThan(1e-12));
        }

        [TestCase(1)]
        [TestCase(2)]
        [TestCase(4)]
        public void ShortOrStraightStart_KeepsItsFrame(int n)
        {
            var x = new Vector3d[n + 1];
            Quaterniond frame = Quaterniond.FromAxisAngle(Vector3d.UnitY, 0.7);
            var q = new Quaterniond[n];
            for (int j = 0; j < n; j++)
            {
                q[j] = frame;
                x[j + 1] = x[j] + 300.0 / n * frame.Director3;
            }
            SimulationParameters parameters = Loaded(n, ClampRule.FourthOrder, 0.0);
            parameters.Scene.Start = new RodStart(x, q, null, null);
            var scene = new MaterialScene(parameters, new Scene(parameters));
            Assert.That(Angle(scene.Shape.ProximalFrame, frame), Is.LessThan(1e-15));
        }

        [TestCase(0.0, false)]
        [TestCase(6e-18, false)]
        [TestCase(-1e-13, false)]
        [TestCase(-1e-6, true)]
        public void StartAtAWall_IsOutsideOnlyBeyondRounding(double gap, bool isOutside)
        {
            foreach (Solver solver in new[] { Solver.Direct, Solver.Xpbd })
            {
                SimulationParameters parameters = SimulationParameters.DefaultsOf(solver);
                parameters.Scene.NumberRodElements = 10;
                parameters.Scene.ProximalEnd = ProximalEnd.Free;
                parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
                parameters.Scene.Walls = WallScenes.Floor(-0.5 - gap);
                parameters.Method.Integrator = Integrator.ImplicitEuler;
                parameters.Method.TimeStep = 1e-3;
                parameters.Method.Substeps = 100;
                parameters.Method.MaxSimulationSteps = 20;
                parameters.Method.DeltaThreshold = 0.0;
                string? problem = Simulation.FindProblemOfStart(parameters);
                Assert.That(problem != null, Is.EqualTo(isOutside), problem ?? solver.ToString());
                if (!isOutside)
                {
                    Simulation simulation = Wires.Finish(parameters);
                    Assert.That(Math.Abs(simulation.State.Positions[5].Y), Is.LessThan(0.06), solver.ToString());
                }
            }
        }

        private static SimulationParameters Loaded(int n, ClampRule rule, double k)
        {
            SimulationParameters parameters = SimulationParameters.DefaultsOf(Solver.Direct);
            parameters.Scene.NumberRodElements = n;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.TipForce = new Vector3d(0.0, k * 2.945243e-3 / 0.09, 0.0);
            parameters.Material.ClampRule = rule;
            parameters.Material.MassDamping = 40.0;
            parameters.Method.MaxSimulationSteps = 0;
            parameters.Method.TimeStep = 2e-3;
            return parameters;
        }

        private static double Angle(in Quaterniond a, in Quaterniond b)
        {
            Quaterniond between = a.Conjugate * b;
            return 2.0 * between.Imaginary.Length;
        }
    }
}
