using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class SteeringTests
    {
        private readonly Steering _hand = new Steering();

        private Simulation Create()
        {
            _hand.Push = 0.0;
            _hand.Turn = 0.0;
            return Simulation.Create(new SimulationParameters
            {
                Drive = { Displacement = 0.0, Steering = _hand },
                Method =
                {
                    ConstraintSolverSteps = 100,
                    DeltaThreshold = 0.0,
                    Damping = 0.05,
                    MaxSimulationSteps = 100_000,
                },
            });
        }

        private static double Turned(RodState state, int j)
        {
            Quaterniond q = state.Orientations[j];
            return 2.0 * Math.Atan2(q.Z, q.W);
        }

        [Test]
        public void Push_MovesSphere0AsFarAsAsked_AndTheTipFollows()
        {
            Simulation simulation = Create();
            double start = simulation.State.Positions[0].Z;
            double tip = simulation.State.Positions[30].Z;
            _hand.Push = 0.2;
            Wires.Step(simulation, 50);
            Assert.That(simulation.State.Positions[0].Z - start, Is.EqualTo(10.0).Within(1e-9));
            _hand.Push = 0.0;
            Wires.Step(simulation, 2000);
            Assert.That(simulation.State.Positions[0].Z - start, Is.EqualTo(10.0).Within(1e-9), "held where it is");
            Assert.That(simulation.State.Positions[30].Z - tip, Is.EqualTo(10.0).Within(1e-3),
                "a straight wire at rest");
        }

        [Test]
        public void Pull_IsTheOppositeOfPush()
        {
            Simulation simulation = Create();
            double start = simulation.State.Positions[0].Z;
            _hand.Push = -0.2;
            Wires.Step(simulation, 50);
            Assert.That(simulation.State.Positions[0].Z - start, Is.EqualTo(-10.0).Within(1e-9));
        }

        [Test]
        public void Turn_IsKeptAtTheBase_AndReachesAFreeTip()
        {
            Simulation simulation = Create();
            _hand.Turn = 0.01;
            Wires.Step(simulation, 100);
            Assert.That(Turned(simulation.State, 0), Is.EqualTo(1.0).Within(1e-9));
            _hand.Turn = 0.0;
            Wires.Step(simulation, 4000);
            Assert.That(Turned(simulation.State, 0), Is.EqualTo(1.0).Within(1e-9));
            Assert.That(Turned(simulation.State, 29), Is.EqualTo(1.0).Within(1e-2), "no torque holds the tip back");
        }

        [Test]
        public void WireOfAMethodWithoutWalls_IsNotSteered()
        {
            SimulationParameters parameters = SimulationParameters.DefaultsOf(Solver.Xpbd);
            parameters.Drive.Steering = _hand;
            Assert.That(() => Simulation.Create(parameters), Throws.ArgumentException.With.Message.Contains("pbd"));
        }

        [Test]
        public void Steering_TakesTheDrivesPlace()
        {
            var parameters = new SimulationParameters
            {
                Drive = { Kind = Drive.Push, DisplacementPerStep = 1.0, Steering = _hand },
                Method = { DeltaThreshold = 0.0 },
            };
            Simulation simulation = Simulation.Create(parameters);
            double start = simulation.State.Positions[0].Z;
            simulation.Step();
            Assert.That(simulation.State.Positions[0].Z, Is.EqualTo(start));
        }
    }
}
