using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Wires and catheters so stiff that rounding of positions, times EA/l, is a force beyond the loads: they
    /// bend as they should, soft pieces of them too, and their hubs' forces are those of the loads.</summary>
    public sealed class BalanceRoundingTests
    {
        private const double Length = 0.2;     // m
        private const double Load = 0.01;      // N, across the tip
        private const double Young = 6e10;     // Pa, times the scale
        private const double Shear = 2.3e10;

        [TestCase(0.1e-3, 10)]
        [TestCase(0.35e-3, 40)]
        [TestCase(1e-3, 150)]
        public void StiffWire_BendsUnderItsLoad(double radius, int elements)
        {
            for (double scale = 1e3; scale < 2e9; scale *= Rods.InFull ? 10.0 : 1e3)
            {
                foreach (bool hasWall in new[] { false, true })
                {
                    Simulation run = Simulation.Create(Wire(scale, radius, elements, hasWall));
                    Wires.Finish(run);
                    string which = "scale " + scale + ", wall " + hasWall;
                    double bending = Math.PI / 4.0 * Math.Pow(radius, 4.0) * Young * scale;
                    double shear = 5.0 / 6.0 * Math.PI * radius * radius * Shear * scale;
                    double tip = Load * Length * Length * Length / (3.0 * bending) + Load * Length / shear;
                    TestContext.WriteLine("{0}: {1:G6} of {2:G6} m", which, 1e-3 * run.State.Positions[elements].Y,
                        tip);
                    Assert.That(1e-3 * run.State.Positions[elements].Y, Is.EqualTo(tip).Within(0.01 * tip), which);
                    Assert.That(run.Hub()!.TipDirection.Y, Is.EqualTo(0.5 * Load * Length * Length / bending)
                        .Within(0.01 * tip / Length), which);
                    Assert.That(run.Hub()!.Force, Is.Zero.Within(1e-3 * Load), which);
                }
            }
        }

        // A beam clamped at both ends under its weight w per length: w l^4/(384 EI) at the middle.
        [TestCase(false)]
        [TestCase(true)]
        public void StiffWireHeldAtBothEnds_Bends_AndIsSaidToHaveUncertainForces(bool hasWall)
        {
            for (double scale = Rods.InFull ? 1e-2 : 1e2; scale < 2e9; scale *= 100.0)
            {
                SimulationParameters parameters = Wire(scale, 0.35e-3, 40, hasWall);
                parameters.Scene.TipForce = Vector3d.Zero;
                parameters.Scene.DistalEnd = DistalEnd.Clamped;
                parameters.Scene.Gravity = new Vector3d(0.0, Math.Min(9.81, 1e-2 * scale), 0.0);
                Simulation run = Simulation.Create(parameters);
                Wires.Finish(run);
                double area = Math.PI * 0.35e-3 * 0.35e-3;
                double weight = area * parameters.Material.Density * parameters.Scene.Gravity.Y;
                double bending = 0.25 * area * 0.35e-3 * 0.35e-3 * Young * scale;
                double shear = 5.0 / 6.0 * area * Shear * scale;
                double middle = weight * Math.Pow(Length, 4.0) / (384.0 * bending)
                    + weight * Length * Length / (8.0 * shear);
                TestContext.WriteLine("scale {0}: {1:G5} of {2:G5} m {3}", scale, 1e-3 * run.State.Positions[20].Y,
                    middle, run.Reason);
                Assert.That(1e-3 * run.State.Positions[20].Y, Is.EqualTo(middle).Within(0.01 * middle));
                Assert.That(run.IsReliable, Is.EqualTo(scale < 1e3), run.Reason);
                Assert.That(run.Reason.Contains("both ends uncertain"), Is.EqualTo(scale > 1e3), run.Reason);
            }
        }

        [TestCase(0.1e-3)]
        [TestCase(0.35e-3)]
        public void WireBeyondAStiffStraightCatheter_IsDrivenOutAsFromAGuide(double radius)
        {
            for (double scale = 1e4; scale < 2e9; scale *= Rods.InFull ? 10.0 : 1e3)
            {
                foreach (bool hasWall in new[] { false, true })
                {
                    string which = "scale " + scale + ", wall " + hasWall;
                    double error = GuideError(scale, radius, 20, hasWall);
                    TestContext.WriteLine("{0}: {1:G3}", which, error);
                    Assert.That(Math.Abs(error), Is.LessThan(0.01), which);
                }
            }
        }

        // The force of the wire's hub against M^2/2B, M the moment at the catheter's tip; the catheter's hub has the
        // opposite one. Elements of 1/n of what is beyond.
        private static double GuideError(double scale, double radius, int n, bool hasWall)
        {
            SimulationParameters parameters = Wire(1.0, radius, 2 * n, hasWall);
            var catheter = new Catheter { Length = 500.0 * Length, Elements = n };
            catheter.Material.WireRadius = 2.5 * radius;
            catheter.Material.InnerRadius = 1.5 * radius;
            catheter.Material.YoungsModulus = 0.04 * Young * scale;
            catheter.Material.ShearModulus = 0.04 * Shear * scale;
            parameters.Scene.Catheters = new[] { catheter };
            // A quarter of a radian at the tip.
            double bending = Math.PI / 4.0 * Math.Pow(radius, 4.0) * Young;
            double load = 0.5 * bending / (0.25 * Length * Length);
            parameters.Scene.TipForce = new Vector3d(0.0, load, 0.0);
            Simulation run = Simulation.Create(parameters);
            Wires.Finish(run);
            CoaxialRecord record = run.Coaxial()!;
            double arm = 1e-3 * (run.State.Positions[2 * n].Z - record.Positions[n].Z);
            double guide = Math.Pow(load * arm, 2.0) / (2.0 * bending);
            Assert.That(record.Force, Is.EqualTo(-record.WireForce).Within(2e-3 * guide));
            return -record.WireForce / guide - 1.0;
        }

        private static SimulationParameters Wire(double scale, double radius, int elements, bool hasWall)
        {
            SimulationParameters parameters = SimulationParameters.DefaultsOf(Solver.Direct);
            parameters.Scene.GuidewireLength = 1e3 * Length;
            parameters.Scene.NumberRodElements = elements;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Scene.TipForce = new Vector3d(0.0, Load, 0.0);
            parameters.Material.WireRadius = radius;
            parameters.Material.YoungsModulus = Young * scale;
            parameters.Material.ShearModulus = Shear * scale;
            parameters.Material.MassDamping = 200.0;
            parameters.Method.Integrator = Integrator.ImplicitEuler;
            parameters.Method.TimeStep = 0.05;
            parameters.Method.DeltaThreshold = 0.0;
            parameters.Method.MaxSimulationSteps = 60;
            if (hasWall)
            {
                parameters.Scene.Walls = WallScenes.Floor(-50.0);
            }
            return parameters;
        }
    }
}
