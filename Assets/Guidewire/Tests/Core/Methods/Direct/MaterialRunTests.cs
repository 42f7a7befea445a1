using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Runs with a material through <see cref="Simulation"/>: units, solvers against each other, ends that
    /// are turned, and how a run fails.</summary>
    public sealed class MaterialRunTests
    {
        [Test]
        public void Units_AreThoseOfTheScene()
        {
            // The same wire stated in millimetres and in metres.
            SimulationParameters millimetres = Cantilever(12, Solver.Direct, Integrator.Esdirk3, 1e-3, 40);
            SimulationParameters metres = Cantilever(12, Solver.Direct, Integrator.Esdirk3, 1e-3, 40);
            metres.Scene.GuidewireLength = Rods.Length;
            metres.Scene.MetresPerUnit = 1.0;
            RodState a = Wires.Run(millimetres).State;
            RodState b = Wires.Run(metres).State;
            for (int i = 0; i <= 12; i++)
            {
                Assert.That(Vector3d.Distance(1e-3 * a.Positions[i], b.Positions[i]), Is.LessThan(1e-12));
                Assert.That(Vector3d.Distance(1e-3 * a.Velocities[i], b.Velocities[i]), Is.LessThan(1e-9));
            }
        }

        [Test]
        public void RestShapeWithoutTime_IsAllThatIsComputed()
        {
            SimulationParameters parameters = Cantilever(30, Solver.Direct, Integrator.Esdirk3, 1e-3, 0);
            parameters.Scene.Gravity = Vector3d.Zero;
            parameters.Scene.TipForce = new Vector3d(0.0, Rods.BendForce, 0.0);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged));
            Assert.That(run.State.Positions[30].Y, Is.EqualTo(300.0 * 0.301720774).Within(0.3));
            SolverReport report = run.Report()!;
            // The clamp carries the load, and the couple F times the tip's distance along z.
            Assert.That(report.ProximalForce!.Value.Y, Is.EqualTo(-Rods.BendForce).Within(1e-6 * Rods.BendForce));
            double couple = Rods.BendForce * 1e-3 * run.State.Positions[30].Z;
            Assert.That(Math.Abs(report.ProximalMoment!.Value.X), Is.EqualTo(couple).Within(1e-3 * couple));
            Assert.That(report.SmallestEigenvalue, Is.GreaterThan(0.0));
        }

        [Test]
        public void ExplicitAndDirect_MoveTheSame()
        {
            // Both on lumped masses, so both discretise the same chain; 2 ms from the straight start under gravity.
            SimulationParameters direct = Lumped(8, Solver.Direct, Integrator.Esdirk4, 5e-5, 40);
            SimulationParameters other = Lumped(8, Solver.Explicit, Integrator.Esdirk4, 5e-5, 40);
            other.Method.Substeps = 400;
            double fall = 0.5 * 9810.0 * 0.002 * 0.002;
            Assert.That(Wires.Distance(Wires.Run(direct).State, Wires.Run(other).State), Is.LessThan(1e-3 * fall));
        }

        [TestCase(Solver.Direct, Integrator.ImplicitEuler)]
        [TestCase(Solver.Direct, Integrator.Esdirk3)]
        [TestCase(Solver.Explicit, Integrator.Esdirk3)]
        public void StatedReaction_AndWeight_ChangeTheMomentum(Solver solver, Integrator integrator)
        {
            // Momentum from the nodes' velocities alone: an element's is that of its middle.
            const int N = 8;
            const double Step = 1e-3;
            SimulationParameters parameters = Cantilever(N, solver, integrator, Step, 20);
            parameters.Method.SolverTolerance = 1e-14;
            parameters.Method.Substeps = solver == Solver.Explicit ? 5000 : 1;
            parameters.Method.StatesReactions = true;
            Simulation run = Simulation.Create(parameters);
            MaterialRod rod = Rods.Wire(N);
            double mass = rod.LineDensity[0] * rod.Length[0];
            Vector3d before = Vector3d.Zero;
            double worst = 0.0;
            double peak = 0.0;
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
                Vector3d after = Vector3d.Zero;
                for (int j = 0; j < N; j++)
                {
                    after += (0.5e-3 * mass) * (run.State.Velocities[j] + run.State.Velocities[j + 1]);
                }
                Vector3d reaction = run.Contacts!.Reaction;
                Vector3d weight = (N * mass) * parameters.Scene.Gravity;
                worst = Math.Max(worst, ((after - before) / Step - reaction - weight).Length);
                peak = Math.Max(peak, reaction.Length);
                before = after;
            }
            Assert.That(worst, Is.LessThan(1e-6 * peak));
        }

        [Test]
        public void CompliantSolver_WhereItHasConverged_IsImplicitEuler()
        {
            SimulationParameters direct = Lumped(6, Solver.Direct, Integrator.ImplicitEuler, 2e-6, 100);
            SimulationParameters other = Lumped(6, Solver.Xpbd, Integrator.ImplicitEuler, 2e-6, 100);
            other.Method.ConstraintSolverSteps = 60;
            Simulation run = Wires.Run(other);
            Assert.That(run.Report()!.StepsNotConverged, Is.Zero);
            double fall = 0.5 * 9810.0 * 2e-4 * 2e-4;
            Assert.That(Wires.Distance(Wires.Run(direct).State, run.State), Is.LessThan(1e-3 * fall));
        }

        [Test]
        public void CompliantSolver_SaysWhenItHasNotConverged()
        {
            SimulationParameters parameters = Cantilever(30, Solver.Xpbd, Integrator.ImplicitEuler, 1e-3, 5);
            parameters.Method.ConstraintSolverSteps = 5;
            Assert.That(Wires.Run(parameters).Report()!.StepsNotConverged, Is.EqualTo(5));
        }

        [TestCase(0.05)]
        [TestCase(0.01)]
        public void LongStepsUnderGravity_ComeToRestInTheSag(double step)
        {
            SimulationParameters parameters = Cantilever(30, Solver.Direct, Integrator.ImplicitEuler, step, 400);
            Simulation run = Wires.Finish(parameters);
            Assert.That(run.State.Positions[30].Y, Is.EqualTo(-17.0399963).Within(0.9));
        }

        [TestCase(Integrator.Bdf2)]
        [TestCase(Integrator.Trbdf2)]
        [TestCase(Integrator.Esdirk3)]
        [TestCase(Integrator.Esdirk4)]
        public void LongSteps_EndOrSayWhy(Integrator scheme)
        {
            // 50 ms is five periods of the third mode a step, and the load 100 times the wire's weight.
            SimulationParameters parameters = Cantilever(20, Solver.Direct, scheme, 0.05, 60);
            parameters.Scene.Gravity = new Vector3d(300.0, -700.0, 400.0);
            Simulation run = Wires.Run(parameters);
            // A scheme that is not stable for large turns may gain energy from such steps; the run then says so.
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished).Or.EqualTo(Outcome.Failed)
                .Or.EqualTo(Outcome.Diverged));
            if (run.Outcome == Outcome.Diverged)
            {
                Assert.That(run.Reason, Does.Contain("the energy that was put into it"));
            }
            Assert.That(run.Reason, Is.Not.Empty);
            for (int i = 0; i <= 20; i++)
            {
                Assert.That(run.State.Positions[i].IsFinite, Is.True);
                Assert.That(run.State.Positions[i].Length, Is.LessThan(303.0));
            }
        }

        [Test]
        public void TooFewIterations_FailTheRun()
        {
            SimulationParameters parameters = Cantilever(30, Solver.Direct, Integrator.Esdirk3, 1e-3, 10);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.TipForce = new Vector3d(0.0, 100.0 * Rods.BendForce, 0.0);
            parameters.Method.MaxNewtonIterations = 1;
            parameters.Method.SolverTolerance = 1e-12;
            parameters.Scene.Gravity = new Vector3d(0.0, 5000.0, 0.0);
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed));
            Assert.That(run.Reason, Does.Contain("no rest shape"));
            run.Step();
            Assert.That(run.StepCount, Is.Zero);
        }

        [Test]
        public void CoordinatesTooLargeForTheElements_AreTheReason()
        {
            SimulationParameters parameters = Cantilever(30, Solver.Direct, Integrator.Esdirk3, 1e-3, 0);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.GuidewireOffset = 1e12;    // the last bit is a hundredth of an element
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed));
            Assert.That(run.Reason, Does.Contain("no rest shape").And.Not.Contain("Infinity")
                .And.Contain("move the scene nearer to the origin"));
        }

        [TestCase(0.0)]
        [TestCase(0.05)]
        public void EndTurnedByManyTurns_WindsTheWireUp(double ramp)
        {
            // 2.5 turns at once or ramped: the frames' turns from clamp to clamp add up to all of it.
            SimulationParameters parameters = Cantilever(40, Solver.Direct, Integrator.ImplicitEuler, 5e-3, 40);
            parameters.Scene.Gravity = Vector3d.Zero;
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalRotation = 5.0 * Math.PI;
            parameters.Scene.DistalRampTime = ramp;
            // Stiff in bending against twist, so that it stays straight: Greenhill's moment is 8.99 EI/L, here 15.7
            // GJ/L.
            parameters.Material.ShearModulus = 0.2 * Rods.Young;
            Simulation run = Wires.Finish(parameters);
            double turn = 0.0;
            for (int j = 1; j < 40; j++)
            {
                turn += RotationVector.Log(run.State.Orientations[j - 1].Conjugate * run.State.Orientations[j]).Z;
            }
            // The two clamps' springs stand for 3/8 of an element each.
            Assert.That(turn, Is.EqualTo(5.0 * Math.PI * (40.0 - 0.75) / 40.0).Within(0.05));
        }

        [Test]
        [Category("Row")]
        public void TwistedAndShortened_TheWireLocalisesIntoAHelix()
        {
            // Infinite rod: M/(2 sqrt(B T)) = 0.914778 and a largest angle of 47.65 degrees with the axis, for B =
            // 1.345, C = 0.789, L = 100, ends 3 closer, 27 turns.
            const double B = 1.345;
            const double C = 0.789;
            const double Radius = 0.1;
            const int N = 120;
            SimulationParameters parameters = Cantilever(N, Solver.Direct, Integrator.Esdirk3, 1e-3, 0);
            parameters.Scene.Gravity = Vector3d.Zero;
            parameters.Scene.GuidewireLength = 100.0;
            parameters.Scene.MetresPerUnit = 1.0;
            parameters.Material.WireRadius = Radius;
            parameters.Material.YoungsModulus = B * 4.0 / (Math.PI * Math.Pow(Radius, 4));
            parameters.Material.ShearModulus = C * 2.0 / (Math.PI * Math.Pow(Radius, 4));
            parameters.Material.Density = 1.0;
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalDisplacement = -3.0;
            parameters.Scene.DistalRotation = 27.0 * 2.0 * Math.PI;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            double angle = 0.0;
            foreach (Quaterniond q in run.State.Orientations)
            {
                angle = Math.Max(angle, Math.Acos(q.Director3.Z) * 180.0 / Math.PI);
            }
            SolverReport report = run.Report()!;
            double ratio = report.DistalMoment!.Value.Z / (2.0 * Math.Sqrt(B * report.DistalForce!.Value.Z));
            const string What = "localised helix, 27 turns, n = 120: ";
            Row.Holds(What + "largest angle, of 47.65°", angle / 47.65, 1.0, 0.05);
            Row.Holds(What + "M/(2 sqrt(B T)), of Coyne's 0.914778", ratio / 0.914778, 1.0, 0.05);
        }

        [TestCase(Solver.Direct, Integrator.Esdirk3)]
        [TestCase(Solver.Direct, Integrator.Bdf2)]
        [TestCase(Solver.Xpbd, Integrator.Esdirk3)]
        [TestCase(Solver.Explicit, Integrator.Esdirk3)]
        public void Step_AllocatesNothing(Solver solver, Integrator scheme)
        {
            SimulationParameters parameters = Cantilever(20, solver, scheme, 1e-5, 1000);
            parameters.Method.Substeps = 50;
            Simulation run = Simulation.Create(parameters);
            long left = Garbage.LeftBySteps(run, 100, 100);
            Assert.That(left, Is.Zero);
            Assert.That(run.StepCount, Is.EqualTo(200));
        }

        /// <summary>The wire, clamped at one end, under gravity, in millimetres.</summary>
        // On lumped masses every method has the same chain.
        private static SimulationParameters Lumped(int n, Solver solver, Integrator scheme, double step, int steps)
        {
            SimulationParameters parameters = Cantilever(n, solver, scheme, step, steps);
            parameters.Material.MassRule = MassRule.Lumped;
            parameters.Method.SolverTolerance = 1e-12;
            return parameters;
        }

        private static SimulationParameters Cantilever(int n, Solver solver, Integrator scheme, double step, int steps)
        {
            SimulationParameters parameters = Rods.Clamped(n, solver, step, steps);
            parameters.Method.Integrator = scheme;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            return parameters;
        }
    }
}
