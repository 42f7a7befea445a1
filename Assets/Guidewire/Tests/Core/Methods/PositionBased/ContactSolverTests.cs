using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>How a step between walls is divided, what of the drive is left, and how deep the wire is said to
    /// lie.</summary>
    [Category("Target")]
    internal sealed class ContactSolverTests
    {
        private const int Elements = 6;
        private const double Length = 60.0;
        private const double Radius = 2.0;
        private static readonly double[] Wide = { 20.0, 20.0 };

        [Test]
        public void Step_ThatIsJammed_TakesOneSolveAPartAndEight_HoweverHardTheWireIsPressed(
            [Values(0.5, 3.0, 40.0, 500.0)] double asked)
        {
            // A solver that throws the wire at the wall each time: no part of it can be clear.
            RodState state = Wire();
            var thrown = new ThrowingSolver(new Vector3d(0.0, -50.0, 0.0));
            ContactSolver solver = Between(state, thrown, out ContactRecord record);
            double parts = Math.Ceiling(asked / Math.Min(Radius, 0.5 * Length / Elements));
            for (int k = 0; k < 5; k++)
            {
                Predict(state, asked);
                thrown.Solves = 0;
                solver.Solve(state);
                Assert.That(thrown.Solves, Is.EqualTo(parts + 8.0));
                for (int i = 0; i <= Elements; i++)
                {
                    Assert.That(state.PredictedPositions[i].Y, Is.GreaterThan(0.0), "sphere " + i);
                }
                state.Advance();
            }
            Assert.That(record.DriveAsked, Is.EqualTo(5.0 * asked).Within(1e-12 * asked));
        }

        [Test]
        public void Jam_EndsWithThePartThatPasses_AndHalvesFollowIt([Values(0, 1, 7)] int jammed)
        {
            // Nine solves of the first part and its halves, one of each jammed part and of the one that passes; the
            // others are halves, each of one.
            const double Parts = 20.0;
            RodState state = Wire();
            var thrown = new ThrowingSolver(new Vector3d(0.0, -50.0, 0.0)) { Until = 9 + jammed };
            ContactSolver solver = Between(state, thrown, out ContactRecord _);
            Predict(state, Parts * Radius);
            solver.Solve(state);
            Assert.That(thrown.Solves, Is.EqualTo(9.0 + jammed + 1.0 + 2.0 * (Parts - 2.0 - jammed)));
        }

        [Test]
        public void Impulses_AreWhatWallsTakeOfTheMotion_InAWedgeToo([Values(0.0, 1.2)] double slope)
        {
            // The step is one part, of which two halves count, each after three solves.
            var walls = new ContactShape[]
            {
                new PlaneShape(Vector3d.Zero, Vector3d.Normalize(new Vector3d(slope, 1.0, 0.0))),
                new PlaneShape(Vector3d.Zero, Vector3d.Normalize(new Vector3d(-slope, 1.0, 0.0))),
            };
            RodState state = Wire();
            var by = new Vector3d(3.0, -50.0, 0.0);
            ContactSolver solver = Between(state, new ThrowingSolver(by), out ContactRecord record, walls);
            Predict(state, 0.5);
            solver.Solve(state);
            for (int i = 1; i <= Elements; i++)
            {
                Vector3d free = state.Positions[i] + 0.5 * Vector3d.UnitZ + 6.0 * by;
                Vector3d taken = state.PredictedPositions[i] - free;
                Assert.That(Vector3d.Distance(state.InverseMasses[i] * record.Impulses[i], taken),
                    Is.LessThan(1e-6 * taken.Length), "sphere " + i);
            }
        }

        [Test]
        public void Drive_OfMorePartsThanFiveHundred_GoesAllTheWay()
        {
            double gone = Driven(1500.0, out ContactRecord record);
            Assert.That(gone, Is.EqualTo(1500.0).Within(1e-9));
            Assert.That(record.DriveShortfall, Is.EqualTo(0.0).Within(1e-9));
        }

        [Test]
        public void Drive_ThatAsksForMoreThanAStepCanDivide_IsGivenTheRestAsShortfall()
        {
            double gone = Driven(1e9, out ContactRecord record);
            Assert.That(gone, Is.EqualTo(4096.0 * Radius).Within(1e-3));
            Assert.That(gone + record.DriveShortfall, Is.EqualTo(1e9).Within(1e-3));
        }

        // How far sphere 0 goes of what the drive asks for in a step.
        private static double Driven(double asked, out ContactRecord record)
        {
            RodState state = Wire();
            ContactSolver solver = Between(state, new ThrowingSolver(Vector3d.Zero), out record);
            Vector3d from = state.Positions[0];
            Predict(state, asked);
            solver.Solve(state);
            return Vector3d.Distance(from, state.PredictedPositions[0]);
        }

        [Test]
        public void Element_PressedAgainstAWall_Slides_AndLeaves()
        {
            // Pressed down for 200 parts it keeps its distance; drawn along it follows; lifted it goes.
            var plane = new PlaneShape(Vector3d.Zero, Vector3d.UnitY);
            const double Clearance = 1e-3;
            var a = new Vector3d(0.0, 1.5 * Clearance, 0.0);
            var b = new Vector3d(0.0, 1.5 * Clearance, 1.0);
            foreach (ContactShape wall in new ContactShape[] { plane, FlatTube() })
            {
                Vector3d at = a;
                Vector3d end = b;
                for (int k = 0; k < 200; k++)
                {
                    Vector3d shift = new Vector3d(0.0, -0.1, 0.0);
                    double free = wall.TimeOfImpact(at, end, at + shift, end + shift, Clearance, out _);
                    Assert.That(free, Is.LessThanOrEqualTo(1.0));
                    at += free * shift;
                    end += free * shift;
                }
                Assert.That(at.Y, Is.GreaterThan(0.99 * Clearance));
                foreach (Vector3d shift in new[] { 0.5 * Vector3d.UnitZ, 0.5 * Vector3d.UnitY })
                {
                    Assert.That(wall.TimeOfImpact(at, end, at + shift, end + shift, Clearance, out _),
                        Is.EqualTo(ContactShape.NoImpact), "along " + shift);
                }
            }
        }

        [Test]
        public void MaxPenetration_IsThatOfTheDeepestSphereOrElement_TheDrivenOneToo(
            [Values(ElementContact.Barycentric, ElementContact.None, ElementContact.Thesis)] ElementContact rule)
        {
            Simulation simulation = Simulation.Create(new SimulationParameters
            {
                Scene =
                {
                    NumberRodElements = 8, GuidewireLength = 80.0, GuidewireOffset = 0.0,
                    Walls = new ContactShape[]
                    {
                        new PlaneShape(-4.0 * Vector3d.UnitY, Vector3d.UnitY),
                        ConvexObstacle.Sphere(new Vector3d(0.0, -3.0, 45.0), 0.5),
                    },
                },
                Contact = { SphereRadius = 3.0, CollisionStiffness = 0.01, ElementContact = rule },
                Drive =
                {
                    Kind = Drive.Displace, DisplacementDirection = new Vector3d(0.0, -1.0, 0.2),
                    DisplacementPerStep = 0.7,
                },
                Method = { DeltaThreshold = 0.0, MaxSimulationSteps = 12, ConstraintSolverSteps = 20 },
            });
            double deepest = Depth(simulation);
            while (simulation.Outcome == Outcome.Running)
            {
                simulation.Step();
                deepest = Math.Max(deepest, Depth(simulation));
            }
            Assert.That(deepest, Is.GreaterThan(2.9), "the base reaches the wall");
            Assert.That(simulation.Contacts!.MaxPenetration, Is.EqualTo(deepest).Within(1e-9));
        }

        // Of the plane y = -4 and the ball of radius 0.5 about (0, -3, 45), in closed form.
        private static double Depth(Simulation simulation)
        {
            Vector3d[] x = simulation.State.Positions;
            var centre = new Vector3d(0.0, -3.0, 45.0);
            double least = double.PositiveInfinity;
            for (int j = 0; j + 1 < x.Length; j++)
            {
                Vector3d u = x[j + 1] - x[j];
                double s = Math.Min(1.0, Math.Max(0.0, Vector3d.Dot(centre - x[j], u) / u.LengthSquared));
                double fromSphere = Vector3d.Distance(centre, x[j] + s * u) - 0.5;
                least = Math.Min(least, Math.Min(fromSphere, Math.Min(x[j].Y, x[j + 1].Y) + 4.0));
            }
            return Math.Max(0.0, 3.0 - least);
        }

        // Its lowest line is y = 0.
        private static TubeShape FlatTube()
        {
            var low = new Vector3d(0.0, 20.0, -50.0);
            return new TubeShape(new[] { low, low + 100.0 * Vector3d.UnitZ }, Wide, true, true);
        }

        private static RodState Wire()
        {
            var state = new RodState(Elements, Length, 0.01, 0.0);
            for (int i = 0; i <= Elements; i++)
            {
                state.Positions[i] = new Vector3d(0.0, 1.0, Length * i / Elements);
            }
            state.InverseMasses[0] = 0.0;
            return state;
        }

        private static ContactSolver Between(RodState state, IConstraintSolver solver, out ContactRecord record,
            ContactShape[]? walls = null)
        {
            walls ??= new ContactShape[] { new PlaneShape(Vector3d.Zero, Vector3d.UnitY) };
            var search = new ContactSearch(walls, Elements, Length / Elements, Radius, Radius, true);
            var response = new ContactResponse(state, walls, Radius, Radius, 0.1, iterations: 1);
            record = new ContactRecord(state.SphereCount);
            return new ContactSolver(state, 0.01, solver, search, response, record);
        }

        // The base goes along z, and the rest follows.
        private static void Predict(RodState state, double shift)
        {
            for (int i = 0; i <= Elements; i++)
            {
                state.PredictedPositions[i] = state.Positions[i] + shift * Vector3d.UnitZ;
            }
            Array.Copy(state.Orientations, state.PredictedOrientations, Elements);
        }

        // Moves every free sphere by the same, whatever stands in the way.
        private sealed class ThrowingSolver : IConstraintSolver
        {
            private readonly Vector3d _by;

            public ThrowingSolver(in Vector3d by)
            {
                _by = by;
            }

            public int Solves { get; set; }

            public int Until { get; set; } = int.MaxValue;

            public void Solve(RodState state)
            {
                Solves++;
                for (int i = 1; i < state.SphereCount && Solves <= Until; i++)
                {
                    state.PredictedPositions[i] += _by;
                }
            }

            public void Serialize(Snapshot snapshot)
            {
            }
        }
    }
}
