using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    [TestFixture]
    public sealed class ContinueTests
    {
        // The first step after a change is Euler's, x + dt v with v = (x_k - x_{k-1})/dt: Verlet's to rounding.
        private const double Rounding = 1e-9;    // units, after 60 steps

        private static SimulationParameters Transversal()
        {
            return new SimulationParameters
            {
                Drive = { DisplacementDirection = Vector3d.UnitY },
                Method = { ConstraintSolverSteps = 50, DeltaThreshold = 0.0, MaxSimulationSteps = 100 },
            };
        }

        private static void Step(Simulation simulation, int count)
        {
            for (int k = 0; k < count; k++)
            {
                simulation.Step();
            }
        }

        [Test]
        public void Continue_ChangesNothing_WhenNothingIsChanged()
        {
            Simulation through = Simulation.Create(Transversal());
            Step(through, 100);
            Simulation first = Simulation.Create(Transversal());
            Step(first, 40);
            Simulation second = first.Continue(Transversal());
            Assert.That(second.StepCount, Is.EqualTo(40));
            Step(second, 60);
            for (int i = 0; i < through.State.SphereCount; i++)
            {
                Assert.That(Vector3d.Distance(second.State.Positions[i], through.State.Positions[i]),
                    Is.LessThan(Rounding), "sphere " + i);
            }
            Assert.That(second.Outcome, Is.EqualTo(Outcome.Finished), "its steps count on from the first's");
            Assert.That(second.Time, Is.EqualTo(through.Time).Within(1e-12));
        }

        [Test]
        public void Continue_CountsTimeOn_WhenTheStepChanges()
        {
            Simulation first = Simulation.Create(Transversal());
            Step(first, 10);
            SimulationParameters finer = Transversal();
            finer.Method.TimeStep = 0.001;
            Simulation second = first.Continue(finer);
            Step(second, 5);
            Assert.That(second.Time, Is.EqualTo(10 * 0.01 + 5 * 0.001).Within(1e-12));
        }

        [Test]
        public void Continue_LeavesTheFirstRunAlone()
        {
            Simulation first = Simulation.Create(Transversal());
            Step(first, 10);
            Vector3d tip = first.State.Positions[30];
            Step(first.Continue(Transversal()), 10);
            Assert.That(first.State.Positions[30], Is.EqualTo(tip));
        }

        [Test]
        public void Continue_LeavesTheParametersAlone()
        {
            Simulation first = Simulation.Create(Transversal());
            SimulationParameters parameters = Transversal();
            double displacement = parameters.Drive.Displacement;
            first.Continue(parameters);
            Assert.That(parameters.Scene.Start, Is.Null);
            Assert.That(parameters.Drive.Displacement, Is.EqualTo(displacement).And.Not.Zero);
        }

        [Test]
        public void Continue_Refuses_AnotherNumberOfElements()
        {
            Simulation first = Simulation.Create(Transversal());
            SimulationParameters longer = Transversal();
            longer.Scene.NumberRodElements = 31;
            Assert.Throws<ArgumentException>(() => first.Continue(longer));
        }
    }
}
