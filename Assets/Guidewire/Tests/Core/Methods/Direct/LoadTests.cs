using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Loads along the wire and over time.</summary>
    public sealed class LoadTests
    {
        /// <summary>Under a small force q per length the tip goes q L^4/(8 EI) + q L^2/(2 k GA).</summary>
        [Test]
        public void DistributedForce_BendsTheCantileverAsTheBeam()
        {
            const double Force = 1e-4;
            SimulationParameters parameters = AtRest(30);
            parameters.Scene.DistributedForce = new Vector3d(0.0, Force * Rods.BendForce / Rods.Length, 0.0);
            double shear = parameters.Material.ShearFactor * Rods.Shear * Rods.Area;
            double tip = Force * (Rods.Length / 8.0 + Rods.BendForce * Rods.Length / (2.0 * shear));
            // The clamp's rule is of fourth order; the force itself is taken by halves of elements.
            Assert.That(1e-3 * Tip(parameters).Y, Is.EqualTo(tip).Within(0.01).Percent);
        }

        [TestCase(Solver.Direct)]
        [TestCase(Solver.Xpbd)]
        [TestCase(Solver.Explicit)]
        public void DistributedForceOfTheWiresWeight_MovesItAsGravityDoes(Solver solver)
        {
            SimulationParameters heavy = Moving(solver);
            heavy.Scene.Gravity = new Vector3d(0.0, -9.81, 1.0);
            SimulationParameters pushed = Moving(solver);
            pushed.Scene.DistributedForce = (Rods.Density * Rods.Area) * heavy.Scene.Gravity;
            Assert.That(Vector3d.Distance(Tip(heavy), Tip(pushed)), Is.LessThan(1e-6 * Tip(heavy).Length));
        }

        [TestCase(Solver.Direct)]
        [TestCase(Solver.Xpbd)]
        [TestCase(Solver.Explicit, Category = "Long")]
        public void TableOfOneRow_IsAFactorOnTheLoad(Solver solver)
        {
            SimulationParameters half = Moving(solver);
            half.Scene.TipForce = new Vector3d(0.0, Rods.BendForce, 0.0);
            half.Scene.DistributedForce = new Vector3d(0.0, 0.0, 0.1);
            half.Scene.Gravity = new Vector3d(1.0, 0.0, 0.0);
            SimulationParameters plain = Moving(solver);
            plain.Scene.TipForce = 0.5 * half.Scene.TipForce;
            plain.Scene.DistributedForce = 0.25 * half.Scene.DistributedForce;
            plain.Scene.Gravity = -2.0 * half.Scene.Gravity;
            half.Scene.TipForceTable = new TimeTable(new[] { 0.0 }, new[] { 0.5 });
            half.Scene.DistributedForceTable = new TimeTable(new[] { 0.0 }, new[] { 0.25 });
            half.Scene.GravityTable = new TimeTable(new[] { 0.0 }, new[] { -2.0 });
            Assert.That(Tip(half), Is.EqualTo(Tip(plain)));
        }

        [Test]
        public void Table_IsLinearBetweenItsRows_AndEvenBeyondThem()
        {
            var table = new TimeTable(new[] { 1.0, 2.0, 4.0 }, new[] { 3.0, 5.0, -1.0 });
            Assert.That(table.At(0.0), Is.EqualTo(3.0));
            Assert.That(table.At(1.5), Is.EqualTo(4.0));
            Assert.That(table.At(2.0), Is.EqualTo(5.0));
            Assert.That(table.At(3.0), Is.EqualTo(2.0));
            Assert.That(table.At(9.0), Is.EqualTo(-1.0));
        }

        [Test]
        public void TableWithTwoRowsOfOneTime_Jumps()
        {
            var table = new TimeTable(new[] { 0.0, 1.0, 1.0, 2.0, 2.0 }, new[] { 1.0, 3.0, 5.0, 4.0, 0.0 });
            Assert.That(table.At(0.5), Is.EqualTo(2.0));
            Assert.That(table.At(1.0), Is.EqualTo(3.0), "before it");
            Assert.That(table.At(1.5), Is.EqualTo(4.5));
            Assert.That(table.At(2.0), Is.EqualTo(4.0));
            Assert.That(table.At(2.1), Is.EqualTo(0.0));
            Assert.That(table.ChangesFrom(2.0), Is.True);
            Assert.That(table.ChangesFrom(2.1), Is.False);
            Assert.That(table.NextJump(0.0), Is.EqualTo(1.0));
            Assert.That(table.NextJump(1.0), Is.EqualTo(2.0));
            Assert.That(table.NextJump(2.0), Is.EqualTo(double.PositiveInfinity));
            Assert.That(table.NextRow(1.0), Is.EqualTo(2.0));
            Assert.Throws<ArgumentException>(() => _ = new TimeTable(new[] { 1.0, 1.0, 1.0 }, new double[3]));
            var still = new TimeTable(new[] { 0.0 }, new[] { 0.0 });
            Assert.Throws<ArgumentException>(() => _ = new DriveTable(table, still), "a hub does not jump");
        }

        /// <summary>A load that a table takes off at once, or within a ten-millionth of a second, costs no more
        /// accuracy than one with a release time, wherever in a step the jump lies: against esdirk4 in steps of
        /// 62.5 us.</summary>
        [TestCase(Integrator.Esdirk3, 4e-3, 0.0502)]
        [TestCase(Integrator.Esdirk3, 4e-3, 0.048)]
        [TestCase(Integrator.Esdirk4, 1e-3, 0.0502)]
        [TestCase(Integrator.Esdirk4, 1e-3, 0.05)]
        [TestCase(Integrator.Trbdf2, 1e-3, 0.0507)]
        public void LoadLetGoByATable_IsAsAccurateAsOneWithAReleaseTime(Integrator integrator, double step, double time)
        {
            Vector3d exact = LetGo(Integrator.Esdirk4, 6.25e-5, time, "release");
            double release = Vector3d.Distance(LetGo(integrator, step, time, "release"), exact);
            double jump = Vector3d.Distance(LetGo(integrator, step, time, "jump"), exact);
            double steep = Vector3d.Distance(LetGo(integrator, step, time, "steep"), exact);
            TestContext.WriteLine("{0:G4} {1:G4} {2:G4}", release, jump, steep);
            Assert.That(jump, Is.EqualTo(release).Within(1e-3 * release), "two rows of one time");
            Assert.That(steep, Is.EqualTo(release).Within(0.02 * release), "a steep ramp");
        }

        /// <summary>A load that turns with the tip and jumps within a step: no less accurate than where it jumps
        /// between two. A step that ran across the jump would be off by 0.3 mm and more.</summary>
        [TestCase("moment")]
        [TestCase("force")]
        public void JumpOfALoadThatTurnsWithTheTip_CostsNoAccuracyWithinAStep(string load)
        {
            // Damped, so that steps of 2 ms resolve what the jump sets off: of an undamped wire each tip lies where
            // the phase of its fast modes has it, and single errors tell nothing.
            const double Least = 2e-4;  // mm; a thousandth of what a step across the jump costs
            double between = TurnedBack(load, 0.0);
            foreach (double fraction in new[] { 1e-3, 0.5, 0.9 })
            {
                double within = TurnedBack(load, fraction);
                TestContext.WriteLine("{0}: {1:G3} and {2:G3} mm", fraction, between, within);
                Assert.That(within, Is.LessThan(Math.Max(2.0 * between, Least)));
            }
        }

        /// <summary>Every load that can have a table has its jump found, and only where there is such a load.</summary>
        [Test]
        public void NextJump_IsFoundOfEachLoad()
        {
            var across = new Vector3d(0.0, 1e-3, 0.0);
            var actions = new Action<SceneParameters, TimeTable>[]
            {
                (scene, table) => (scene.Gravity, scene.GravityTable) = (across, table),
                (scene, table) => (scene.TipForce, scene.TipForceTable) = (across, table),
                (scene, table) => (scene.DistributedForce, scene.DistributedForceTable) = (across, table),
                (scene, table) => (scene.AxialForce, scene.AxialForceTable) = (1e-3, table),
                (scene, table) => (scene.TipMoment, scene.TipMomentTable) = (across, table),
                (scene, table) => (scene.TipFollowerForce, scene.TipFollowerForceTable) = (across, table),
            };
            const double Never = 1e6;  // s, and later
            SimulationParameters all = AtRest(4);
            for (int k = 0; k < actions.Length; k++)
            {
                double time = 0.1 * (k + 1);
                SimulationParameters one = AtRest(4);
                actions[k](one.Scene, JumpAt(time));
                actions[k](all.Scene, JumpAt(time));
                RodSchedule schedule = new Scene(one).Schedule;
                Assert.That(schedule.NextJump(0.0), Is.EqualTo(time), "load " + k);
                Assert.That(schedule.NextJump(time), Is.GreaterThan(Never), "load " + k);
            }
            RodSchedule every = new Scene(all).Schedule;
            for (int k = 0; k < actions.Length; k++)
            {
                Assert.That(every.NextJump(0.1 * k), Is.EqualTo(0.1 * (k + 1)), "of all, load " + k);
            }
            SimulationParameters none = AtRest(4);
            none.Scene.TipMomentTable = JumpAt(0.1);
            Assert.That(new Scene(none).Schedule.NextJump(0.0), Is.GreaterThan(Never), "no moment");
        }

        private static TimeTable JumpAt(double time) =>
            new TimeTable(new[] { 0.0, time, time }, new[] { 1.0, 1.0, -1.0 });

        // How far off the tip is, mm, after a load turned back this fraction of a step after the 20th of 40.
        private static double TurnedBack(string load, double fraction)
        {
            const int Steps = 40;
            const double Step = 2e-3;
            const int Finer = 10;
            double time = (0.5 * Steps + fraction) * Step;
            return Vector3d.Distance(Turned(load, Step, Steps, time), Turned(load, Step / Finer, Finer * Steps, time));
        }

        private static Vector3d Turned(string load, double step, int steps, double time)
        {
            SimulationParameters parameters = Rods.Clamped(12, Solver.Direct, step, steps);
            parameters.Method.Integrator = Integrator.Esdirk4;
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Material.MassDamping = 20.0;
            parameters.Material.MaterialDamping = 1e-3;
            if (load == "moment")
            {
                parameters.Scene.TipMoment = new Vector3d(0.3 * Rods.BendForce * Rods.Length, 0.0, 0.0);
                parameters.Scene.TipMomentTable = JumpAt(time);
            }
            else
            {
                parameters.Scene.TipFollowerForce = new Vector3d(0.0, 0.3 * Rods.BendForce, 0.0);
                parameters.Scene.TipFollowerForceTable = JumpAt(time);
            }
            return Tip(parameters);
        }

        private static Vector3d LetGo(Integrator integrator, double step, double time, string how)
        {
            const double End = 0.1;
            SimulationParameters parameters = Rods.Clamped(12, Solver.Direct, step, (int)Math.Round(End / step));
            parameters.Method.Integrator = integrator;
            parameters.Scene.TipForce = new Vector3d(0.0, -0.02, 0.0);
            if (how == "release")
            {
                parameters.Scene.TipForceReleaseTime = time;
            }
            else
            {
                double after = how == "jump" ? time : time + 1e-7;
                parameters.Scene.TipForceTable = new TimeTable(new[] { 0.0, time, after }, new[] { 1.0, 1.0, 0.0 });
            }
            return Tip(parameters);
        }

        /// <summary>A free wire under gravity times t/T: its velocity is g T/2 after T. Implicit midpoint stages of a
        /// linear ramp are exact under schemes of order 2 and more.</summary>
        [Test]
        public void RampOfGravity_GivesItsIntegral()
        {
            SimulationParameters parameters = Moving(Solver.Direct);
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            parameters.Scene.Gravity = new Vector3d(0.0, -10.0, 0.0);
            parameters.Scene.GravityTable = new TimeTable(new[] { 0.0, 0.02 }, new[] { 0.0, 1.0 });
            Assert.That(Wires.Run(parameters).State.Velocities[3].Y, Is.EqualTo(-100.0).Within(1e-6));
        }

        /// <summary>Statics from the tip on: the force in every element is what acts beyond it, the couple at every
        /// joint the force's moment about it, and curvature is couple over EI.</summary>
        [Test]
        public void StressOfARestShape_BalancesTheTipForce()
        {
            var force = new Vector3d(0.4 * Rods.BendForce, Rods.BendForce, -0.3 * Rods.BendForce);
            SimulationParameters parameters = AtRest(12);
            parameters.Scene.TipForce = force;
            Simulation simulation = Simulation.Create(parameters);
            StressRecord stress = simulation.Stress()!;
            Vector3d[] x = simulation.State.Positions;
            double elastic = 0.0;
            for (int j = 0; j < 12; j++)
            {
                Vector3d moment = Vector3d.Cross(1e-3 * (x[12] - x[j]), force);
                Assert.That(Vector3d.Distance(stress.Force[j], force), Is.LessThan(1e-6 * force.Length), "force " + j);
                Assert.That(Vector3d.Distance(stress.Couple[j], moment),
                    Is.LessThan(1e-6 * force.Length * Rods.Length), "couple " + j);
                Vector3d bent = stress.Curvature[j];
                double curvature = Math.Sqrt(bent.X * bent.X + bent.Y * bent.Y);
                // Bending couple and its part along the element: EI^2 k^2 + GJ^2 t^2 = m^2, the frames of one joint.
                double twist = Rods.TwistStiffness * bent.Z;
                Assert.That(Math.Sqrt(Math.Pow(Rods.BendStiffness * curvature, 2) + twist * twist),
                    Is.EqualTo(moment.Length).Within(2).Percent, "curvature " + j);
                double weight = new[] { 3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0 }[Math.Min(j, 2)];
                weight = j > 2 ? 1.0 : weight;
                elastic += 0.5 * Rods.Length / 12.0 * weight
                    * (Rods.BendStiffness * curvature * curvature + Rods.TwistStiffness * bent.Z * bent.Z);
            }
            Assert.That(stress.Couple[12], Is.EqualTo(Vector3d.Zero));
            Assert.That(stress.ElasticEnergy, Is.EqualTo(elastic).Within(0.1).Percent, 
                "stretch and shear are the rest");
            Assert.That(stress.PotentialEnergy, Is.EqualTo(-Vector3d.Dot(force, 1e-3 * x[12])).Within(1e-9));
            Assert.That(stress.KineticEnergy, Is.Zero);
        }

        [Test]
        public void EnergiesOfAFreeMotion_StayTheirSum([Values(Solver.Direct, Solver.Explicit)] Solver solver)
        {
            SimulationParameters parameters = Moving(solver);
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, -1.0);
            Simulation simulation = Simulation.Create(parameters);
            StressRecord stress = simulation.Stress()!;
            double lifted = Rods.Density * Rods.Area * Rods.Length * 0.5 * Rods.Length;
            Assert.That(stress.PotentialEnergy, Is.EqualTo(lifted).Within(1e-9).Percent,
                "before the first step too: half of the wire's length against 1 m/s^2");
            double start = stress.ElasticEnergy + stress.KineticEnergy + stress.PotentialEnergy;
            Wires.Run(simulation);
            stress = simulation.Stress()!;
            double end = stress.ElasticEnergy + stress.KineticEnergy + stress.PotentialEnergy;
            Assert.That(stress.KineticEnergy, Is.GreaterThan(0.0));
            Assert.That(end - start, Is.EqualTo(0.0).Within(0.01 * stress.KineticEnergy));
        }

        private static SimulationParameters AtRest(int n)
        {
            SimulationParameters parameters = Rods.Clamped(n, Solver.Direct, 1e-3, 0);
            parameters.Method.Integrator = Integrator.Esdirk3;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            return parameters;
        }

        private static SimulationParameters Moving(Solver solver)
        {
            SimulationParameters parameters = Rods.Clamped(8, solver, 1e-3, solver == Solver.Explicit ? 8 : 20);
            parameters.Method.Integrator = solver == Solver.Direct ? Integrator.Esdirk3 : Integrator.Verlet;
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Method.Substeps = solver == Solver.Direct ? 1 : solver == Solver.Xpbd ? 200 : 5000;
            return parameters;
        }

        private static Vector3d Tip(SimulationParameters parameters)
        {
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished).Or.EqualTo(Outcome.Converged), run.Reason);
            RodState state = run.State;
            return state.Positions[state.ElementCount];
        }
    }
}
