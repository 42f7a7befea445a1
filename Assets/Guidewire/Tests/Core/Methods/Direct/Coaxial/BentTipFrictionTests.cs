using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A catheter with a curved end in a straight tube with friction, a wire in it: what its hub has to push
    /// with, in closed form, and what becomes of it where the hub has less.</summary>
    /// <remarks>The end of stiffness B and rest curvature k is straight on one side of the tube but for the last a =
    /// sqrt(12 d/k), over which it comes to the other side, d the clearance on either: y'' = k u/a from there on, y =
    /// k u^3/(6 a) and 2 d = k a^2/6. Its tip presses with B k/a, and as much holds it where it leaves the wall. So
    /// friction takes 2 mu B k/a, and no less will do.</remarks>
    public sealed class BentTipFrictionTests
    {
        private const double Friction = 0.25;
        private const double Clearance = 1e-3;   // m, less half of the distance at which contact begins
        private const double Radius = 0.8e-3;
        private const double Lumen = 0.6e-3;
        private const double Young = 3e9;
        private const double Asked = 6.0;        // units

        [TestCase(15.0)]
        [TestCase(30.0)]
        public void HubSlips_WhereFrictionOfTheBentTipTakesMoreThanItsForce(double curvature)
        {
            if (curvature < 30.0)
            {
                Rods.OnlyInFull("a tip that is bent twice as much");
            }
            double needed = Needed(curvature);
            Simulation free = Push(curvature, 0.0);
            double force = free.Coaxial()!.Force;
            TestContext.WriteLine("{0:G4} N, closed form {1:G4} N", force, needed);
            Assert.That(force, Is.EqualTo(needed).Within(0.1 * needed));
            Assert.That(free.Coaxial()!.Shortfall, Is.Zero);
            CoaxialRecord held = Push(curvature, 0.7 * force).Coaxial()!;
            CoaxialRecord goes = Push(curvature, 1.3 * force).Coaxial()!;
            TestContext.WriteLine("with 0.7 of it {0:G4} units, with 1.3 {1:G4}", 1e3 * held.Displacement,
                1e3 * goes.Displacement);
            // What it goes is what it yields: as much where the hub is asked twice as long.
            if (Rods.InFull)
            {
                CoaxialRecord longer = Push(curvature, 0.7 * force, 120).Coaxial()!;
                TestContext.WriteLine("asked twice as long {0:G4}", 1e3 * longer.Displacement);
                Assert.That(longer.Displacement, Is.EqualTo(held.Displacement).Within(0.02 * held.Displacement));
            }
            Assert.That(1e3 * (held.Displacement + held.Shortfall), Is.EqualTo(Asked).Within(1e-9));
            Assert.That(Math.Abs(held.Force), Is.LessThan(0.7001 * force));
            Assert.That(1e3 * goes.Displacement, Is.EqualTo(Asked).Within(0.01 * Asked));
        }

        private static double Needed(double curvature)
        {
            double bending = Math.PI / 4.0 * (Math.Pow(Radius, 4.0) - Math.Pow(Lumen, 4.0)) * Young;
            return 2.0 * Friction * bending * curvature / Math.Sqrt(12.0 * Clearance / curvature);
        }

        // Both hubs have a limit; the wire's, which meets nothing, is the smaller one.
        private static Simulation Push(double curvature, double limit, int steps = 60)
        {
            SimulationParameters parameters = SimulationParameters.DefaultsOf(Solver.Direct);
            parameters.Scene.GuidewireLength = 240.0;
            parameters.Scene.NumberRodElements = 24;
            parameters.Scene.GuidewireOffset = -100.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Scene.Walls = WallScenes.Tube(-10.0, 300.0, 1e3 * (Radius + Clearance), friction: Friction);
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.HubForceLimit = 0.7 * limit;
            parameters.Material.WireRadius = 0.4e-3;
            parameters.Material.YoungsModulus = 5e9;
            parameters.Material.MassDamping = 100.0;
            parameters.Method.Integrator = Integrator.ImplicitEuler;
            parameters.Method.TimeStep = 0.02;
            parameters.Method.DeltaThreshold = 0.0;
            parameters.Method.MaxSimulationSteps = steps;
            var catheter = new Catheter { Length = 200.0, Elements = 80, Start = 100.0 };
            catheter.Material.WireRadius = Radius;
            catheter.Material.InnerRadius = Lumen;
            catheter.Material.YoungsModulus = Young;
            catheter.Material.ShearModulus = Young / 2.6;
            catheter.Material.Density = 1200.0;
            catheter.Material.Sections = new[]
            {
                new WireSection { From = 0.0, To = 200.0, RestCurvature = new Vector3d(curvature, 0.0, 0.0) },
            };
            catheter.Drive.InsertionSpeed = 1e-3 * Asked / 1.2;
            catheter.Drive.HubForceLimit = limit;
            parameters.Scene.Catheters = new[] { catheter };
            return Wires.Finish(parameters);
        }
    }
}
