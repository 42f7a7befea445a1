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

        [Test]
        public void TableOfOneRow_IsAFactorOnTheLoad(
            [Values(Solver.Direct, Solver.Xpbd, Solver.Explicit)] Solver solver)
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

        /// <summary>A couple that turns with the tip and jumps within a step: as accurate as where it lies between
        /// two where no step has to be cut.</summary>
        [Test]
        public void JumpOfATipMoment_CostsNoAccuracyWithinAStep()
        {
            double between = TurnedBack(1e-3, 0.042);
            double within = TurnedBack(1e-3, 0.0424);
            TestContext.WriteLine("{0:G4} {1:G4}", between, within);
            Assert.That(within, Is.LessThan(2.0 * between));
        }

        // The error at the tip.
        private static double TurnedBack(double step, double time)
        {
            return Vector3d.Distance(Turned(Integrator.Esdirk4, step, time), Turned(Integrator.Esdirk4, 2e-4, time));
        }

        private static Vector3d Turned(Integrator integrator, double step, double time)
        {
            SimulationParameters parameters = Rods.Clamped(12, Solver.Direct, step, (int)Math.Round(0.08 / step));
            parameters.Method.Integrator = integrator;
            parameters.Scene.TipMoment = new Vector3d(0.3 * Rods.BendForce * Rods.Length, 0.0, 0.0);
            parameters.Scene.TipMomentTable = new TimeTable(new[] { 0.0, time, time }, new[] { 1.0, 1.0, -1.0 });
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
            while (simulation.Outcome == Outcome.Running)
            {
                simulation.Step();
            }
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
            SimulationParameters parameters = Rods.Clamped(8, solver, 1e-3, 20);
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
