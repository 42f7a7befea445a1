using System;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire with a material, of random properties, that is pushed, pulled back and turned in one of several
    /// vessels, and what came of that.</summary>
    internal sealed class RandomWallPush
    {
        // By seed modulo their number.
        private static readonly string[] Vessels =
        {
            "arch", "stenosis", "mesh arch", "mesh arch with a box", "bend with a capsule", "plane with a hull",
            "narrowing bend", "mesh tube with a box",
        };

        private const int Samples = 20;        // an element
        private static readonly MeshShape Arch = ArchVessel.Read();
        private readonly SimulationParameters _parameters;
        private readonly double _radius;       // units

        /// <summary>Draws the wire and takes it to its end.</summary>
        /// <param name="change">Makes another scene of what is drawn, or null.</param>
        public RandomWallPush(int seed, Func<SimulationParameters, SimulationParameters>? change = null)
        {
            Seed = seed;
            var random = new RandomGeometry(seed);
            _parameters = Draw(random, seed % Vessels.Length);
            _parameters = change == null ? _parameters : change(_parameters);
            _radius = _parameters.Material.WireRadius / _parameters.Scene.MetresPerUnit;
            Simulation = Simulation.Create(_parameters);
            double before = Simulation.State.Positions[0].Z;
            int half = _parameters.Method.MaxSimulationSteps / 2;
            while (Simulation.Outcome == Outcome.Running)
            {
                if (Simulation.StepCount == half && seed % 3 == 0)
                {
                    PullBack();
                }
                Simulation.Step();
                if (Simulation.Outcome != Outcome.Failed)
                {
                    Look();
                }
            }
        }

        public int Seed { get; }

        public Simulation Simulation { get; private set; }

        public ContactRecord Contacts => Simulation.Contacts!;

        /// <summary>Points of the wire's axis outside a wall after a step, summed over the steps.</summary>
        public int PointsOutside { get; private set; }

        /// <summary>Deepest that the wire's surface was in a wall at such a point, units.</summary>
        public double Deepest { get; private set; }

        /// <summary>Whether all numbers were finite.</summary>
        public bool IsFinite { get; private set; } = true;

        public override string ToString()
        {
            return "seed " + Seed + ": " + Vessels[Seed % Vessels.Length]
                + ", n " + _parameters.Scene.NumberRodElements
                + ", r " + _radius.ToString("F2")
                + ", dt " + _parameters.Method.TimeStep.ToString("G3")
                + ", per step " + _parameters.Drive.DisplacementPerStep.ToString("F2")
                + ", twist " + _parameters.Drive.TwistPerStep.ToString("F2")
                + ", " + Simulation.Outcome + " after " + Simulation.StepCount + " of "
                + _parameters.Method.MaxSimulationSteps
                + ", passages " + Contacts.Passages + ", outside " + PointsOutside
                + ", deepest " + Math.Max(Deepest, Contacts.MaxPenetration).ToString("G3")
                + ", asked " + Contacts.DriveAsked.ToString("F1") + ", short " + Contacts.DriveShortfall.ToString("G3")
                + ": " + Simulation.Reason;
        }

        // The order of the draws is what a seed means.
        private static SimulationParameters Draw(RandomGeometry random, int vessel)
        {
            double radius = new[] { 0.2e-3, 0.4e-3, 0.5e-3 }[random.Index(3)];
            SimulationParameters parameters = WallScenes.Wire(20 + random.Index(60), radius);
            parameters.Scene.GuidewireOffset = -300.0;
            parameters.Scene.Gravity = random.Number(0.0, 9.81) * random.Direction();
            parameters.Scene.Walls = Walls(random, vessel, 1e3 * radius);
            foreach (ContactShape wall in parameters.Scene.Walls)
            {
                // The arch is shared by runs: each sets its own.
                wall.FrictionCoefficient = random.Index(2) == 0 ? 0.0 : random.Number(0.0, 0.3);
            }
            parameters.Material.YoungsModulus = Math.Pow(10.0, random.Number(9.0, 11.0));
            parameters.Material.ShearModulus = 0.38 * parameters.Material.YoungsModulus;
            parameters.Material.RestCurvature = random.Index(2) == 0 ? Vector3d.Zero
                : new Vector3d(random.Number(-10.0, 10.0), 0.0, 0.0);
            parameters.Method.TimeStep = Math.Pow(10.0, random.Number(-3.0, -2.0));
            double speed = Math.Pow(10.0, random.Number(1.0, 3.0));
            double longest = 2.0 * 300.0 / parameters.Scene.NumberRodElements;
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.DisplacementPerStep = Math.Min(longest, speed * parameters.Method.TimeStep);
            parameters.Drive.TwistPerStep = random.Index(2) == 0 ? 0.0 : random.Number(-0.5, 0.5);
            parameters.Method.MaxSimulationSteps = Math.Min(300, (int)Math.Ceiling(
                random.Number(50.0, 200.0) / parameters.Drive.DisplacementPerStep));
            return parameters;
        }

        // A vessel of this number and what stands in it, wide enough for a radius, units.
        private static ContactShape[] Walls(RandomGeometry random, int vessel, double radius)
        {
            switch (vessel)
            {
                case 0:
                    return new ContactShape[] { WallScenes.ArchTube(10 + random.Index(40)) };
                case 1:
                    return new ContactShape[] { Stenosis(1.2 * radius + random.Number(0.0, 1.0)) };
                case 2:
                    return new ContactShape[] { Arch };
                case 3:
                    return new ContactShape[]
                    {
                        Arch,
                        ConvexObstacle.Box(new Vector3d(random.Number(-4.0, 4.0), random.Number(-4.0, 4.0), 15.0),
                            new Vector3d(1.0, 2.0, 3.0), random.Orientation()),
                    };
                case 4:
                    return new ContactShape[]
                    {
                        WallScenes.ArchTube(30),
                        ConvexObstacle.Capsule(new Vector3d(-4.0, 4.0, 15.0), new Vector3d(1.0, 3.0, 20.0), 0.5),
                    };
                case 5:
                    return new ContactShape[]
                    {
                        new PlaneShape(new Vector3d(0.0, -2.0, 0.0), new Vector3d(0.0, 1.0, -0.3)),
                        new ConvexObstacle(new[]
                        {
                            new Vector3d(1.0, 1.0, 20.0), new Vector3d(-3.0, 2.0, 21.0), new Vector3d(0.0, 5.0, 25.0),
                            new Vector3d(2.0, -1.0, 30.0), new Vector3d(-1.0, 1.0, 28.0),
                        }, random.Number(0.0, 0.5)),
                    };
                case 6:
                    return new ContactShape[] { NarrowingBend(random.Number(1.2 * radius, 2.0)) };
                default:
                    return new ContactShape[]
                    {
                        new MeshShape(TestMeshes.Tube(16, 8, 400.0).Build(
                            Vector3d.Zero, new Vector3d(0.0, 0.0, 400.0)),
                            new Placement(new Vector3d(0.0, 0.0, -320.0), Quaterniond.Identity,
                                new Vector3d(3.0, 3.0, 1.0))),
                        ConvexObstacle.Box(new Vector3d(2.0, 0.5, 20.0), new Vector3d(1.0, 1.0, 5.0),
                            random.Orientation()),
                    };
            }
        }

        private static TubeShape Stenosis(double narrow)
        {
            return new TubeShape(new[]
            {
                new Vector3d(0.0, 0.0, -320.0), new Vector3d(0.0, 0.0, 10.0), new Vector3d(0.0, 0.0, 20.0),
                new Vector3d(0.0, 0.0, 22.0), new Vector3d(0.0, 0.0, 32.0), new Vector3d(0.0, 40.0, 200.0),
            }, new[] { 3.0, 3.0, narrow, narrow, 3.0, 3.0 }, true, true);
        }

        private static TubeShape NarrowingBend(double narrow)
        {
            var knots = new Vector3d[14];
            var radii = new double[14];
            knots[0] = new Vector3d(0.0, 0.0, -320.0);
            radii[0] = 3.0;
            for (int k = 1; k < 14; k++)
            {
                double angle = 0.12 * (k - 1);
                knots[k] = new Vector3d(0.0, 40.0 * (1.0 - Math.Cos(angle)), 40.0 * Math.Sin(angle));
                radii[k] = 3.0 + (narrow - 3.0) * (k - 1) / 12.0;
            }
            return new TubeShape(knots, radii, true, true);
        }

        private void PullBack()
        {
            SimulationParameters back = _parameters.Copy();
            back.Drive.DisplacementPerStep *= -1.0;
            Simulation = Simulation.Continue(back);
        }

        private void Look()
        {
            Vector3d[] x = Simulation.State.Positions;
            foreach (ContactShape wall in _parameters.Scene.Walls)
            {
                for (int k = 0; k <= Samples * (x.Length - 1); k++)
                {
                    int j = Math.Min(k / Samples, x.Length - 2);
                    Vector3d point = Vector3d.Lerp(x[j], x[j + 1], (double)(k - j * Samples) / Samples);
                    IsFinite &= point.IsFinite;
                    int hint = -1;
                    if (wall.Nearest(point, point, _radius, ref hint, out SurfaceContact contact))
                    {
                        Deepest = Math.Max(Deepest, _radius - contact.Distance);
                        PointsOutside += contact.Distance <= 0.0 ? 1 : 0;
                    }
                }
            }
        }
    }
}
