using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Two and three instruments in a sheath, what is deep in it left out, against all of them.</summary>
    /// <remarks>What is left out has no mass and takes no drag of the fluid in lumens: so they weigh next to nothing
    /// here. It is rigid, where each joint that is simulated keeps 1e-8 of its compliance.</remarks>
    public sealed class SheathWindowTests
    {
        private const double Length = 400.0;     // mm
        private const int Steps = 30;

        // Limits of the wire's hub and of each catheter's, N; 0: none. The search for a hub's place ends within 2 % of
        // its limit, and rounding may end it elsewhere.
        [TestCase(false, 0.0, 0.0, 1e-8)]
        [TestCase(true, 0.0, 0.0, 1e-8)]
        [TestCase(true, 0.1, 0.1, 1e-8)]
        [TestCase(false, 2e-3, 0.02, 1e-8, Category = "Long")]
        [TestCase(false, 0.02, 5e-3, 1e-6, Category = "Long")]
        [TestCase(false, 0.5, 2e-3, 1e-6, Category = "Long")]
        [TestCase(true, 0.02, 0.02, 1e-6, Category = "Long")]
        [TestCase(true, 0.1, 2e-3, 1e-6, Category = "Long")]
        [TestCase(true, 0.5, 0.1, 1e-6, Category = "Long")]
        public void WhatIsLeftOut_ChangesNeitherShapesNorForces(bool isThree, double wireLimit, double catheterLimit,
            double within)
        {
            SimulationParameters parameters = Scene(isThree, wireLimit, catheterLimit);
            DirectStep part = Run(parameters, false, out RodState state);
            DirectStep whole = Run(parameters, true, out RodState wholeState);
            int most = 0;
            int least = int.MaxValue;
            double apart = 0.0;
            double force = 0.0;
            double largest = 0.0;
            for (int k = 0; k < 5 * Steps; k++)
            {
                // In, turned against one another by more than a turn; on and back; out again; at rest.
                double push = k < Steps ? 2.5 : k < 2 * Steps ? 0.0 : k < 3 * Steps ? 0.3 : k < 4 * Steps ? -2.0 : 0.0;
                double turn = k < Steps || k >= 4 * Steps ? 0.0 : k < 2 * Steps ? 0.2 : -0.05;
                Steer(parameters, push, turn);
                part.Advance(state);
                whole.Advance(wholeState);
                Assert.That(part.Failure ?? whole.Failure, Is.Null);
                for (int i = 0; i < part.Slips.Length && wireLimit > 0.0; i++)
                {
                    double limit = i == part.Slips.Length - 1 ? wireLimit : catheterLimit;
                    Assert.That(Math.Abs(part.ForceOf(i)), Is.LessThan(1.001 * limit), "N, of hub {0}", i);
                }
                Assert.That(((CoaxialInstruments)whole).Chain.Rod.Joints.First, Is.Zero);
                int first = ((CoaxialInstruments)part).Chain.Rod.Joints.First;
                (most, least) = (Math.Max(most, first), Math.Min(least, first));
                apart = Math.Max(apart, Wires.Distance(state.Positions, wholeState.Positions));
                CoaxialRecord? one = part.Coaxial();
                for (CoaxialRecord? other = whole.Coaxial(); other != null; other = other.Inside, one = one.Inside)
                {
                    apart = Math.Max(apart, Wires.Distance(one!.Positions, other.Positions));
                    force = Math.Max(force, Math.Abs(one.Force - other.Force));
                    largest = Math.Max(largest, Math.Abs(other.Force));
                }
                force = Math.Max(force, Math.Abs(part.Hub()!.Force - whole.Hub()!.Force));
                largest = Math.Max(largest, Math.Abs(whole.Hub()!.Force));
            }
            TestContext.WriteLine("{0} to {1} elements left out: {2:G3} of L apart, {3:G3} N of {4:G3} N", least, most,
                apart / Length, force, largest);
            Assert.That(most - least, Is.GreaterThan(3), "elements come and go");
            Assert.That(apart, Is.LessThan(1e-6 * Length), "mm");
            Assert.That(force, Is.LessThan(within), "N");
        }

        private static DirectStep Run(SimulationParameters parameters, bool isWhole, out RodState state)
        {
            MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
            state = start.State;
            ((CoaxialInstruments)start.Stepper).Chain.IsWhole = isWhole;
            return (DirectStep)start.Stepper;
        }

        private static SimulationParameters Scene(bool isThree, double wireLimit, double catheterLimit)
        {
            SimulationParameters parameters = isThree ? CoaxialScenes.Three(Integrator.ImplicitEuler)
                : CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Method.TimeStep = 0.05;
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Method.MaxSimulationSteps = 1000;
            parameters.Scene.TipForce = new Vector3d(0.01, 0.0, 0.0);
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, 260.0) };
            parameters.Scene.Walls = WallScenes.Floor(-500.0);
            parameters.Drive.Steering = new Steering();
            (parameters.Drive.HubForceLimit, parameters.Drive.SlipSpeed) = (wireLimit, 0.0);
            SetLight(parameters.Material);
            foreach (Catheter catheter in parameters.Scene.Catheters)
            {
                catheter.Drive.Steering = new Steering();
                (catheter.Drive.HubForceLimit, catheter.Drive.SlipSpeed) = (catheterLimit, 0.0);
                catheter.LumenFriction = 0.1;
                SetLight(catheter.Material);
            }
            return parameters;
        }

        private static void SetLight(MaterialParameters material)
        {
            material.Density *= 1e-5;
            material.MassDamping = 0.0;
        }

        // The hubs of catheters go half as far, and turn the other way.
        private static void Steer(SimulationParameters parameters, double push, double turn)
        {
            (parameters.Drive.Steering!.Push, parameters.Drive.Steering.Turn) = (push, turn);
            foreach (Catheter catheter in parameters.Scene.Catheters)
            {
                (catheter.Drive.Steering!.Push, catheter.Drive.Steering.Turn) = (0.5 * push, -turn);
            }
        }
    }
}
