using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class SteeringTests
    {
        private readonly Steering _hand = new Steering();

        private Simulation Create(DistalEnd end = DistalEnd.Free)
        {
            _hand.Push = 0.0;
            _hand.Turn = 0.0;
            return Simulation.Create(new SimulationParameters
            {
                Scene = { DistalEnd = end },
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

        [TestCase(1.0)]
        [TestCase(-1.0)]
        public void WireWhoseTipIsHeld_SlipsInALimitedHand_AndFollowsItBack(double sign)
        {
            _hand.SlipStrain = 0.1;
            Simulation simulation = Create(DistalEnd.Clamped);
            double start = simulation.State.Positions[0].Z;
            _hand.Push = sign * 0.4;
            Wires.Step(simulation, 3000);
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running), "1,200 units, four times its length");
            Assert.That(sign * (simulation.State.Positions[0].Z - start), Is.InRange(1.0, 0.11 * 300.0));
            for (int j = 1; j <= 30; j++)
            {
                Vector3d[] x = simulation.State.Positions;
                Assert.That(Vector3d.Distance(x[j], x[j - 1]), Is.EqualTo(10.0).Within(0.2 * 10.0));
            }
            double slipped = simulation.State.Positions[0].Z;
            _hand.Push = -sign * 0.4;
            Wires.Step(simulation, 5);
            Assert.That(simulation.State.Positions[0].Z - slipped, Is.EqualTo(-sign * 2.0).Within(1e-9));
            _hand.SlipStrain = double.PositiveInfinity;
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
