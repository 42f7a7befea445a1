using System;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire of random properties that is pushed, and perhaps turned, into the arch by a random step
    /// until 200 units were asked of it, and what came of that.</summary>
    internal sealed class RandomPush
    {
        private const double Asked = 200.0;    // units
        private readonly SimulationParameters _parameters;
        private readonly Vector3d[] _start;
        private double _path;                  // length of the path of sphere 0, units

        /// <summary>Draws the wire and pushes it to its end.</summary>
        public RandomPush(int seed, ElementContact rule)
        {
            Seed = seed;
            _parameters = Draw(new RandomGeometry(seed), rule);
            Simulation = Simulation.Create(_parameters);
            _start = (Vector3d[])Simulation.State.Positions.Clone();
            Run();
        }

        public int Seed { get; }

        public Simulation Simulation { get; }

        public ContactRecord Contacts => Simulation.Contacts!;

        /// <summary>Points of the wire that lay outside the wall after a step, summed over the steps.</summary>
        public int PointsOutside { get; private set; }

        /// <summary>Mean distance of the spheres from their start, as a fraction of the displacement asked
        /// for.</summary>
        public double Reached
        {
            get
            {
                double sum = 0.0;
                for (int i = 0; i < _start.Length; i++)
                {
                    sum += Vector3d.Distance(_start[i], Simulation.State.Positions[i])
                        / (Contacts.DriveAsked * _start.Length);
                }
                return sum;
            }
        }

        /// <summary>Fraction of the displacement asked for in which sphere 0 was not held back by the walls.</summary>
        public double Driven => 1.0 - Contacts.DriveShortfall / Contacts.DriveAsked;

        /// <summary>How far sphere 0 came along the sheath, as a fraction of the displacement asked for.</summary>
        public double Advance => (Simulation.State.Positions[0].Z - _start[0].Z) / Contacts.DriveAsked;

        /// <summary>Length of wire that does not reach forward, as a fraction of the displacement asked for: in the
        /// sheath what is not along z, in the vessel what is compressed.</summary>
        public double TakenUp
        {
            get
            {
                RodState state = Simulation.State;
                double sum = 0.0;
                for (int j = 0; j < state.ElementCount; j++)
                {
                    Vector3d along = state.Positions[j + 1] - state.Positions[j];
                    bool isInSheath = state.Positions[j].Z < ArchVessel.SheathEnd
                        && state.Positions[j + 1].Z < ArchVessel.SheathEnd;
                    sum += state.ElementLength - (isInSheath ? along.Z : along.Length);
                }
                return sum / Contacts.DriveAsked;
            }
        }

        /// <summary>Fraction of the motion that the wire lacks and neither its base nor its shape accounts for: what
        /// sphere 0 did not advance (shortfall, or turned aside) is lost to all spheres, what buckles and compression
        /// take up at most to all. A tenth is left to the bend, whose chord is shorter than the path.</summary>
        public double Unexplained => 0.9 - Reached - (1.0 - Advance) - TakenUp;

        public override string ToString()
        {
            return "seed " + Seed + ": n " + _parameters.Scene.NumberRodElements
                + ", m " + _parameters.Method.ConstraintSolverSteps
                + ", r " + _parameters.Contact.SphereRadius.ToString("F2")
                + ", kC " + _parameters.Contact.CollisionStiffness.ToString("F4")
                + ", per step " + _parameters.Drive.DisplacementPerStep.ToString("F1")
                + ", " + Simulation.Outcome + " after " + Simulation.StepCount
                + ", passages " + Contacts.Passages
                + ", outside " + PointsOutside
                + ", reached " + Reached.ToString("F3")
                + ", driven " + Driven.ToString("F3")
                + ", advance " + Advance.ToString("F3")
                + ", taken up " + TakenUp.ToString("F3")
                + ", path " + _path.ToString("F1")
                + ", deepest " + Contacts.MaxPenetration.ToString("F2")
                + ", tip " + Simulation.State.Positions[^1];
        }

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
                Vector3d before = Simulation.State.Positions[0];
                Simulation.Step();
                _path += Vector3d.Distance(before, Simulation.State.Positions[0]);
                PointsOutside += ArchVessel.PointsOutside(Simulation.State);
            }
        }
    }
}
