using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Steps of a wire in a catheter leave nothing for the garbage collector, but those in which an element
    /// comes or goes, and what is simulated is rebuilt.</summary>
    public sealed class CoaxialGarbageTests
    {
        private const int Steps = 200;
        private const int First = 20;   // until all memory that steps use again is there

        // Both hubs go and turn, at speeds with which nodes come in and go.
        [TestCase(0.2, 0.07)]
        [TestCase(-0.3, 0.0, Category = "Long")]
        [TestCase(0.0, -0.2, Category = "Long")]
        public void StepThatKeepsItsElements_LeavesNothing(double wire, double catheter)
        {
            // Schemes of several steps and of several stages keep more; implicitEuler is that of the vessels below.
            foreach (Integrator integrator in Rods.InFull
                ? new[] { Integrator.ImplicitEuler, Integrator.Bdf2, Integrator.Esdirk3 }
                : new[] { catheter == 0.0 ? Integrator.Bdf2 : Integrator.Esdirk3 })
            {
                AssertNothingIsLeft(Moving(integrator, wire, catheter), 3);
            }
        }

        [TestCase(0.2, 0.05, 0.07)]
        [TestCase(-0.1, -0.2, 0.05, Category = "Long")]
        public void StepOfThreeThatKeepsItsElements_LeavesNothing(double wire, double middle, double outer)
        {
            SimulationParameters parameters = CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Method.MaxSimulationSteps = Steps;
            parameters.Drive.InsertionSpeed = wire;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = outer;
            parameters.Scene.Catheters[1].Drive.InsertionSpeed = middle;
            parameters.Scene.Catheters[1].Drive.RotationSpeed = 2.0;
            AssertNothingIsLeft(parameters, 3);
        }

        // In a tube that the bent tips touch, with friction on it and in the lumen.
        [TestCase(0.1, 0.05, 0.0, 2)]
        [TestCase(-0.1, 0.05, 0.0, 3)]
        [TestCase(0.1, 0.1, 0.5, 0)]
        [TestCase(0.3, 0.1, 0.02, 0)]
        public void StepThatKeepsItsElements_LeavesNothing_InAVessel(double wire, double catheter, double limit,
            int minBuilt)
        {
            if (limit > 0.0 && limit < 0.1)
            {
                Rods.OnlyInFull("a hub that slips at a larger force");
            }
            SimulationParameters parameters = Moving(Integrator.ImplicitEuler, wire, catheter);
            parameters.Scene.Walls = WallScenes.Tube(-10.0, 700.0, 6.0, friction: 0.1);
            parameters.Drive.HubForceLimit = limit;
            parameters.Scene.Catheters[0].Drive.HubForceLimit = limit;
            parameters.Scene.Catheters[0].LumenFriction = 0.1;
            AssertNothingIsLeft(parameters, minBuilt);
        }

        private static SimulationParameters Moving(Integrator integrator, double wire, double catheter)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(integrator);
            parameters.Method.MaxSimulationSteps = Steps;
            parameters.Drive.InsertionSpeed = wire;
            parameters.Drive.RotationSpeed = 2.0;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = catheter;
            parameters.Scene.Catheters[0].Drive.RotationSpeed = -1.0;
            return parameters;
        }

        private static void AssertNothingIsLeft(SimulationParameters parameters, int minBuilt)
        {
            // Twice the same steps: what the runtime leaves as it compiles comes once.
            MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
            MethodStart other = MethodBuilder.Build(parameters, new Scene(parameters));
            var run = (DirectStep)start.Stepper;
            var left = new List<string>();
            int built = 0;
            long most = 0;
            for (int k = 0; k < Steps; k++)
            {
                RodDynamics before = run.Dynamics;
                long bytes = Garbage.LeftBy(() => run.Advance(start.State));
                bytes = System.Math.Min(bytes, Garbage.LeftBy(() => other.Stepper.Advance(other.State)));
                Assert.That(run.Failure, Is.Null);
                bool isKept = run.Dynamics == before;
                built += isKept ? 0 : 1;
                most = isKept ? most : System.Math.Max(most, bytes);
                if (isKept && bytes > 0 && k >= First)
                {
                    left.Add("step " + k + ": " + bytes);
                }
            }
            TestContext.WriteLine("{0} steps in which an element comes or goes, with {1} bytes at most", built, most);
            Assert.That(built, Is.InRange(minBuilt, Steps / 2));
            Assert.That(left, Is.Empty);
        }
    }
}
