using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Small steps that are too long: the run ends as diverged, with a reason and a state of numbers.
    /// </summary>
    public sealed class BlowUpTests
    {
        // The limit by the wire's highest mode: all elements turn to and fro. With a = turn, b = shift of the nodes
        // between them, omega^2 is the largest eigenvalue of an endless chain, GA/(rho I) (1 + (r/l)^2) +
        // 4 E/(rho l^2).
        private static double Limit(int n, double radius)
        {
            double l = Rods.Length / n;
            double shear = 4.0 * new MaterialParameters().ShearFactor * Rods.Shear / (Rods.Density * radius * radius);
            return 2.0 / Math.Sqrt(shear * (1.0 + radius * radius / (l * l))
                + 4.0 * Rods.Young / (Rods.Density * l * l));
        }

        [TestCase(30, 0.5e-3)]
        [TestCase(20, 2e-3)]
        public void ExplicitStepsAboveTheirLimit_EndDiverged(int n, double radius)
        {
            Simulation run = Explicit(n, radius, 1.01 * Limit(n, radius));
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Diverged), run.Reason);
            Assert.That(run.Reason, Does.Contain("energy").And.Contain("raise substeps"));
            Assert.That(Wires.IsFinite(run.State), Is.True);
            Assert.That(double.IsNaN(run.PredictionError) || double.IsInfinity(run.PredictionError), Is.False);
        }

        [TestCase(30, 0.5e-3)]
        [TestCase(20, 2e-3)]
        public void ExplicitStepsBelowTheirLimit_EndFinishedWithoutAWarning(int n, double radius)
        {
            Simulation run = Explicit(n, radius, 0.98 * Limit(n, radius));
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(run.Reason, Does.Not.Contain("but"));
        }

        [Test]
        public void ExplicitStepsAboveTheirLimit_WarnOfIt_WhereNothingMovesYet()
        {
            SimulationParameters parameters = Wire(Solver.Explicit, 30, Rods.Radius, 3e-7, 10);
            parameters.Scene.Gravity = Vector3d.Zero;
            Simulation run = Wires.Finish(parameters);
            Assert.That(run.Reason, Does.Contain("unstable"));
        }

        [TestCase(1)]
        [TestCase(3)]
        public void TooFewSubsteps_EndDiverged_OrSayHowWrongTheyAre(int sweeps)
        {
            if (sweeps > 1)
            {
                Rods.OnlyInFull("one iteration a substep");
            }
            foreach (int substeps in new[] { 1, 4, 16, 64, 256 })
            {
                SimulationParameters parameters = Wire(Solver.Xpbd, 30, Rods.Radius, 1e-3, 100);
                parameters.Scene.TipForce = new Vector3d(0.0, 2.0 * Rods.BendForce, 0.0);
                parameters.Method.Substeps = substeps;
                parameters.Method.ConstraintSolverSteps = sweeps;
                Simulation run = Wires.Run(parameters);
                Assert.That(Wires.IsFinite(run.State), Is.True);
                if (run.Outcome != Outcome.Diverged)
                {
                    Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished));
                    Assert.That(run.Reason, Does.Match(@"all 100 steps are done, but \d+ of 100 steps had not converged"
                        + @" \(bending up to [\d.]+ % off\); raise substeps or constraintSolverSteps"));
                }
            }
        }

        [TestCase(0.05, 0.0)]
        [TestCase(0.0, 0.01)]
        public void ExplicitStepsCloseBelowTheirLimit_HoldAJump_AndATurn(double jump, double turn)
        {
            // A jump of sphere 0 puts its energy into the fastest modes, where 0.97 of the limit makes T 17 times too
            // high; a turn goes into a wave that gives almost all of it back to the clamp.
            double substep = 0.97 * Limit(9, 1.8e-3);
            SimulationParameters parameters = Wire(Solver.Explicit, 9, 1.8e-3, 2000.0 * substep, 20);
            parameters.Scene.Gravity = Vector3d.Zero;
            parameters.Drive.DisplacementDirection = Vector3d.UnitY;
            parameters.Drive.Displacement = jump;
            parameters.Drive.TwistPerStep = turn;
            parameters.Method.Substeps = 2000;
            Simulation run = Wires.Finish(parameters);
        }

        [TestCase(Solver.Explicit)]
        [TestCase(Solver.Xpbd)]
        public void EnergyPutIn_ByLoadsAndMovedEnds_IsNotTakenForABlowUp(Solver solver)
        {
            // A wire without a load is pushed, turned at one end and displaced at the other, and let go by its force.
            SimulationParameters parameters = Wire(solver, 8, 5e-3, 1e-4, 200);
            parameters.Drive.Kind = Drive.Push;
            parameters.Drive.DisplacementPerStep = 0.05;
            parameters.Drive.TwistPerStep = 0.02;
            parameters.Scene.Gravity = Vector3d.Zero;
            parameters.Method.Substeps = 100;
            parameters.Scene.TipForce = new Vector3d(0.0, 300.0, 100.0);
            parameters.Scene.TipForceReleaseTime = 0.01;
            Simulation run = Wires.Finish(parameters);
        }

        private static Simulation Explicit(int n, double radius, double substep)
        {
            SimulationParameters parameters = Wire(Solver.Explicit, n, radius, 1000.0 * substep, 20);
            parameters.Method.Substeps = 1000;
            return Wires.Run(parameters);
        }

        private static SimulationParameters Wire(Solver solver, int n, double radius, double step, int steps)
        {
            SimulationParameters parameters = Rods.Clamped(n, solver, step, steps);
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Material.WireRadius = radius;
            return parameters;
        }
    }
}
