using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Contacts among sweeps in lanes do what they do after each scalar sweep, bit for bit.</summary>
    [Category("Target")]
    public sealed class PipelinedContactsTests
    {
        private const int Elements = 30;
        private const double Length = 300.0;      // units
        private const int Iterations = 43;        // no multiple of the lanes
        private const int Steps = 60;

        [Test]
        public void WiresAlongWalls_MoveAsTheyDoOneSweepAfterTheOther(
            [Values(4, 8)] int lanes,
            [Values] ElementContact rule,
            [Values("plane", "planes", "ball")] string walls)
        {
            SimulationParameters parameters = Scene(rule, walls);
            var expected = new RodState(Elements, Length, 0.01, 0.0);
            var state = new RodState(Elements, Length, 0.01, 0.0);
            PositionBasedStep reference = StepOf(expected, parameters, null);
            var used = new CountingSweeps(lanes);
            PositionBasedStep step = StepOf(state, parameters, used);
            for (int k = 0; k < Steps; k++)
            {
                reference.Advance(expected);
                step.Advance(state);
                Assert.That(state.Positions, Is.EqualTo(expected.Positions), "step " + k);
                Assert.That(state.Orientations, Is.EqualTo(expected.Orientations), "step " + k);
                Assert.That(step.Contacts!.Impulses, Is.EqualTo(reference.Contacts!.Impulses), "step " + k);
            }
            Assert.That(Wires.IsFinite(state));
            Assert.That(used.WithContacts, Is.GreaterThan(0), "contacts in lanes");
        }

        // A wire that is pushed along its axis and falls: its one end on a slope, its other against a wall, its middle
        // on a ball. Where nearly all of it touches, lanes gain nothing and take no part.
        private static SimulationParameters Scene(ElementContact rule, string walls)
        {
            var slope = new PlaneShape(new Vector3d(0.0, -0.7, 0.0), new Vector3d(0.0, 1.0, 0.01));
            slope.FrictionCoefficient = rule == ElementContact.Thesis ? 0.0 : 0.2;
            var side = new PlaneShape(new Vector3d(-7.1, 0.0, 0.0), new Vector3d(1.0, 0.1, -0.02));
            ContactShape[] shapes =
                walls == "plane" ? new ContactShape[] { slope }
                : walls == "planes" ? new ContactShape[] { slope, side }
                : new ContactShape[] { ConvexObstacle.Sphere(new Vector3d(0.5, -4.0, 150.0), 3.0) };
            return new SimulationParameters
            {
                Contact =
                {
                    SphereRadius = 1.0,
                    CollisionMargin = 0.1,
                    CollisionStiffness = 0.05,
                    ElementContact = rule,
                },
                Scene = { Walls = shapes },
            };
        }

        private static PositionBasedStep StepOf(RodState state, SimulationParameters parameters,
            CountingSweeps? counting)
        {
            state.InverseMasses[0] = 0.0;
            var scalar = new ScalarIterations(
                new StretchConstraint(state, 0.3), new BendTwistConstraint(state, 0.2), SweepOrder.Naive);
            IIterations sweeps = counting == null ? scalar : (IIterations)counting.Of(scalar);
            ContactParameters contact = parameters.Contact;
            ContactShape[] walls = parameters.Scene.Walls;
            double radius = contact.SphereRadius;
            double reach = radius + contact.CollisionMargin;
            bool asPublished = contact.ElementContact == ElementContact.Thesis;
            IContactResponse response = asPublished
                ? (IContactResponse)new ThesisContactResponse(state, walls.Length, reach, contact.CollisionStiffness)
                : new ContactResponse(state, walls, radius, reach, contact.CollisionStiffness, Iterations);
            IContactSearch search = asPublished ? (IContactSearch)new ThesisContactSearch(walls, Elements, radius)
                : new ContactSearch(walls, Elements, Length / Elements, radius, reach,
                    contact.ElementContact == ElementContact.Barycentric);
            var record = new ContactRecord(state.SphereCount);
            double dt = parameters.Method.TimeStep;
            return new PositionBasedStep(dt, new VerletPrediction(0.02, new Vector3d(-3.0, -10.0, 0.0)),
                new OrientationEulerPrediction(), new ProximalDrive(new AlongFirstElement(), 0.3),
                new ContactSolver(state, dt, new GaussSeidelSolver(Iterations, scalar, sweeps, response), search,
                    response, record), record);
        }

        // Counts the solves with contacts that lanes took.
        private sealed class CountingSweeps : IIterations
        {
            private readonly int _lanes;
            private IIterations? _sweeps;

            public CountingSweeps(int lanes)
            {
                _lanes = lanes;
            }

            public int WithContacts { get; private set; }

            public CountingSweeps Of(ScalarIterations scalar)
            {
                _sweeps = IterationChoice.WithLanes(scalar, _lanes);
                if (_sweeps == null)
                {
                    Assert.Ignore("no registers of " + _lanes + " lanes here");
                }
                return this;
            }

            public bool Iterate(Vector3d[] x, Quaterniond[] q, int iterations, IContactResponse? contacts)
            {
                bool taken = _sweeps!.Iterate(x, q, iterations, contacts);
                if (taken && contacts!.ContactCount > 0)
                {
                    WithContacts++;
                }
                return taken;
            }

            public double Cost(int iterations) => _sweeps!.Cost(iterations);
        }
    }
}
