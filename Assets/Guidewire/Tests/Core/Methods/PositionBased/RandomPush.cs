using System;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire of random properties that is pushed, and perhaps turned, into the arch by a random step
    /// until 200 units were asked of it, and what came of that.</summary>
    internal sealed class RandomPush
    {
        private const double Asked = 200.0;    // units
        private readonly SimulationParameters _parameters;

        /// <summary>Draws the wire and pushes it to its end.</summary>
        public RandomPush(int seed, ElementContact rule)
        {
            _parameters = Draw(new RandomGeometry(seed), rule);
            Simulation = Simulation.Create(_parameters);
            Run();
        }

        public Simulation Simulation { get; }

        public ContactRecord Contacts => Simulation.Contacts!;

        /// <summary>Points of the wire that lay outside the wall after a step, summed over the steps.</summary>
        public int PointsOutside { get; private set; }

        // The order of the draws is what a seed means.
        private static SimulationParameters Draw(RandomGeometry random, ElementContact rule)
        {
            var parameters = new SimulationParameters
            {
                Scene = { GuidewireOffset = -310.0, Walls = new ContactShape[] { ArchVessel.Shape } },
                Contact = { ElementContact = rule },
                Method = { DeltaThreshold = 0.0 },
                Drive = { Kind = Drive.Push },
            };
            parameters.Scene.NumberRodElements = 5 + random.Index(56);
            parameters.Method.ConstraintSolverSteps = 50 + random.Index(451);
            parameters.Pbd.StretchStiffness = random.Number(0.1, 1.5);
            parameters.Pbd.BendStiffness = Math.Pow(10.0, random.Number(-2.0, 0.3));
            parameters.Scene.Gravity = random.Number(0.0, 10.0) * random.Direction();
            parameters.Contact.SphereRadius = random.Number(1.0, 5.0);
            parameters.Contact.CollisionStiffness = Math.Pow(10.0, random.Number(-3.0, 0.0));
            parameters.Contact.CollisionMargin = random.Number(0.0, 1.0);
            parameters.Method.Damping = random.Number(0.0, 0.3);
            parameters.Method.TimeStep = Math.Pow(10.0, random.Number(-4.0, -1.0));
            parameters.Pbd.TotalMass = Math.Pow(10.0, random.Number(-3.0, 0.0));
            parameters.Drive.TwistPerStep = random.Index(2) == 0 ? 0.0 : random.Number(-0.5, 0.5);
            parameters.Drive.DisplacementPerStep = random.Number(0.05, 20.0) * parameters.Contact.SphereRadius;
            parameters.Method.MaxSimulationSteps = (int)Math.Ceiling(Asked / parameters.Drive.DisplacementPerStep);
            return parameters;
        }

        private void Run()
        {
            while (Simulation.Outcome == Outcome.Running)
            {
                Simulation.Step();
                PointsOutside += ArchVessel.PointsOutside(Simulation.State);
            }
        }
    }
}
