using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Steps of a wire in a catheter or in a sheath leave nothing for the garbage collector, also where an
    /// element comes or goes.</summary>
    public sealed class CoaxialGarbageTests
    {
        private const int Steps = 200;
        private const int First = 20;   // until all memory that steps use again is there

        // Both hubs go and turn, at speeds with which nodes come in and go.
        [TestCase(0.2, 0.07)]
        [TestCase(-0.3, 0.0, Category = "Long")]
        [TestCase(0.0, -0.2, Category = "Long")]
        public void Step_LeavesNothing(double wire, double catheter)
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
        public void StepOfThree_LeavesNothing(double wire, double middle, double outer)
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
        public void Step_LeavesNothing_InAVessel(double wire, double catheter, double limit, int minChanged)
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
            AssertNothingIsLeft(parameters, minChanged);
        }

        [TestCase(0.0)]
        [TestCase(0.004)]
        public void StepOfAWireInASheath_LeavesNothing(double limit)
        {
            SimulationParameters parameters = SheathScenes.Sheathed(80, 0.4, 5.0);
            parameters.Method.MaxSimulationSteps = Steps;
            parameters.Drive.InsertionSpeed = 0.06;
            parameters.Drive.HubForceLimit = limit;
            AssertNothingIsLeft(parameters, 5);
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

        private static void AssertNothingIsLeft(SimulationParameters parameters, int minChanged)
        {
            // Twice the same steps: what the runtime leaves as it compiles comes once.
            MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
            MethodStart other = MethodBuilder.Build(parameters, new Scene(parameters));
            var run = (DirectStep)start.Stepper;
            var left = new List<string>();
            int changed = 0;
            for (int k = 0; k < Steps; k++)
            {
                double before = CoaxialScenes.ElementsOf(run);
                long bytes = Garbage.LeftBy(() => run.Advance(start.State));
                bytes = System.Math.Min(bytes, Garbage.LeftBy(() => other.Stepper.Advance(other.State)));
                Assert.That(run.Failure, Is.Null);
                bool isChanged = CoaxialScenes.ElementsOf(run) != before;
                changed += isChanged ? 1 : 0;
                if (bytes > 0 && k >= First)
                {
                    left.Add("step " + k + (isChanged ? ", other elements: " : ": ") + bytes);
                }
            }
            TestContext.WriteLine("{0} steps in which an element comes or goes", changed);
            Assert.That(changed, Is.InRange(minChanged, Steps / 2));
            Assert.That(left, Is.Empty);
        }
    }
}
