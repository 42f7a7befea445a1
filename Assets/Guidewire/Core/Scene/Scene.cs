using System;

namespace Guidewire.Core
{
    /// <summary>What is simulated, the same for every method: the wire's start, what is prescribed in time, what drives
    /// it, and the walls. Lengths are in the method's own: units with pbd, metres with a material.</summary>
    internal sealed class Scene
    {
        /// <summary>The scene of these parameters.</summary>
        /// <exception cref="ArgumentException">The start has another number of elements than the wire, or a helix is
        /// longer than it.</exception>
        public Scene(SimulationParameters parameters)
        {
            SceneParameters scene = parameters.Scene;
            DriveParameters drive = parameters.Drive;
            UnitLength = MethodTable.Of(parameters.Method.Solver).TakesMaterial ? scene.MetresPerUnit : 1.0;
            ElementLengths = ElementLayout.Lengths(parameters, UnitLength, out double[] stations);
            Stations = stations;
            int n = ElementLengths.Length;
            Shape = new RodShape(n);
            Velocities = new Vector3d[n + 1];
            Spins = new Vector3d[n];
            SetStart(scene);
            Walls = scene.Walls;
            Steering = drive.Steering;
            Drive = CreateDrive(drive);
            double twistRate = drive.RotationSpeed != 0.0 ? drive.RotationSpeed
                : drive.TwistPerStep / parameters.Method.TimeStep;
            Schedule = new RodSchedule(new PrescribedLoads(scene, UnitLength,
                drive.Kind == Core.Drive.Force ? drive.ExternalForce : Vector3d.Zero),
                new HubMotion(Shape.X[0], Shape.ProximalFrame, twistRate, scene.ProximalMotion),
                new DistalMotion(scene, UnitLength, Shape.X[n], Shape.DistalFrame));
            if (drive.Kind == Core.Drive.Hold)
            {
                Displacement = (UnitLength * drive.Displacement) * Vector3d.Normalize(drive.DisplacementDirection);
            }
        }

        /// <summary>Length of one unit in the method's lengths: 1 with pbd, metresPerUnit with a material.</summary>
        public double UnitLength { get; }

        /// <summary>The length of each of the n elements at rest; L/n (thesis eq. 3.1) but where sections have a
        /// number of elements of their own.</summary>
        public double[] ElementLengths { get; }

        /// <summary>Where each of the n + 1 spheres stands along the wire at rest, from sphere 0 on.</summary>
        public double[] Stations { get; }

        /// <summary>Where the wire is at the start, before the displacement of sphere 0.</summary>
        public RodShape Shape { get; }

        /// <summary>Whether a run had come there (<see cref="RodStart.IsReached"/>).</summary>
        public bool IsReached { get; private set; }

        /// <summary>Where the sheath of that run ends, m (<see cref="RodStart.ExitOfSheath"/>).</summary>
        public Vector3d? ExitOfSheath { get; private set; }

        /// <summary>Velocities of the n + 1 spheres at the start.</summary>
        public Vector3d[] Velocities { get; }

        /// <summary>Angular velocities of the n elements at the start along their own axes, rad/s.</summary>
        public Vector3d[] Spins { get; }

        /// <summary>What is prescribed in time: loads, and the motion of held ends.</summary>
        public RodSchedule Schedule { get; }

        /// <summary>The direction in which the drive moves sphere 0 in every step, or null where it does not.</summary>
        public IDriveDirection? Drive { get; }

        /// <summary>Displacement of sphere 0 at the start; 0 but for <see cref="Core.Drive.Hold"/>.</summary>
        public Vector3d Displacement { get; }

        /// <summary>The vessel and what stands in it.</summary>
        public ContactShape[] Walls { get; }

        /// <summary>User steering instead of the drive, or null.</summary>
        public Steering? Steering { get; }

        private static IDriveDirection? CreateDrive(DriveParameters drive)
        {
            switch (drive.Kind)
            {
                case Core.Drive.Displace:
                    return new FixedAxis(drive.DisplacementDirection);
                case Core.Drive.Push:
                    return new AlongFirstElement();
                default:
                    return null;
            }
        }

        private void SetStart(SceneParameters scene)
        {
            var start = new Vector3d(0.0, 0.0, UnitLength * scene.GuidewireOffset);
            switch (scene.StartShape)
            {
                case StartShape.Ring:
                    StartShapes.Ring(Shape, start, ElementLengths);
                    break;
                case StartShape.Helix:
                    StartShapes.Helix(Shape, start, ElementLengths, UnitLength * scene.StartRadius,
                        scene.StartTurns);
                    break;
                default:
                    if (scene.StartAxis is StartAxis axis)
                    {
                        start = UnitLength * (axis.Origin + scene.GuidewireOffset * axis.Direction);
                    }
                    Shape.SetStraight(start, scene.StartAxis?.Frame ?? Quaterniond.Identity, Stations);
                    break;
            }
            if (scene.Start != null && scene.Start.Hub == null)
            {
                StartFrom(scene.Start);
                IsReached = scene.Start.IsReached;
                ExitOfSheath = scene.Start.ExitOfSheath;
            }
        }

        /// <summary>Takes where the wire is from a start.</summary>
        public void StartFrom(RodStart start)
        {
            if (start.Orientations.Length != Shape.ElementCount)
            {
                throw new ArgumentException("the start has " + start.Orientations.Length + " elements, the wire "
                    + Shape.ElementCount);
            }
            for (int i = 0; i < Shape.X.Length; i++)
            {
                Shape.X[i] = UnitLength * start.Positions[i];
                Velocities[i] = UnitLength * start.Velocities[i];
            }
            for (int j = 0; j < Shape.Q.Length; j++)
            {
                Shape.Q[j] = Normalized(start, start.Orientations[j]);
                Spins[j] = start.AngularVelocities[j];
            }
            Shape.ProximalFrame = Normalized(start, start.ProximalFrame ?? start.Orientations[0]);
            Shape.DistalFrame = Normalized(
                start, start.DistalFrame ?? start.Orientations[Shape.ElementCount - 1]);
        }

        // That of a run is normalised; once more would change its bits, and with them the axis of a sheath.
        private static Quaterniond Normalized(RodStart start, in Quaterniond q) =>
            start.IsReached ? q : Quaterniond.Normalize(q);
    }

    /// <summary>The line on which a straight wire starts, instead of z.</summary>
    public sealed class StartAxis
    {
        /// <summary>Makes the line through a point along a direction.</summary>
        /// <param name="origin">From which guidewireOffset is measured, units.</param>
        /// <param name="direction">Of the wire, of any length but 0.</param>
        public StartAxis(in Vector3d origin, in Vector3d direction)
        {
            Origin = origin;
            Direction = Vector3d.Normalize(direction);
        }

        /// <summary>The point from which guidewireOffset is measured, units.</summary>
        public Vector3d Origin { get; }

        /// <summary>The direction of the wire, of length 1.</summary>
        public Vector3d Direction { get; }

        /// <summary>The frame of every element: z turned into the direction by the smallest rotation, about x where
        /// that is half a turn.</summary>
        internal Quaterniond Frame
        {
            get
            {
                Vector3d axis = Vector3d.Cross(Vector3d.UnitZ, Direction);
                double sine = axis.Length;
                double angle = Math.Atan2(sine, Direction.Z);
                return Quaterniond.FromAxisAngle(sine > 0.0 ? (1.0 / sine) * axis : Vector3d.UnitX, angle);
            }
        }
    }

    /// <summary>Start shapes other than the straight wire.</summary>
    internal static class StartShapes
    {
        /// <summary>A polygon on a circle through the start, closed, in the y-z plane, tangent to z at the start. Both
        /// clamps have the frame of the start.</summary>
        public static void Ring(RodShape shape, in Vector3d start, double[] lengths)
        {
            int n = shape.ElementCount;
            double total = Sum(lengths);
            double s = 0.0;
            shape.X[0] = start;
            for (int j = 0; j < n; j++)
            {
                // Turned about -x, so that the ring rises into +y.
                double angle = 2.0 * Math.PI * (s + 0.5 * lengths[j]) / total;
                Quaterniond frame = Quaterniond.FromAxisAngle(-Vector3d.UnitX, angle);
                s += lengths[j];
                shape.Q[j] = frame;
                shape.X[j + 1] = shape.X[j] + lengths[j] * frame.Director3;
            }
            shape.X[n] = start;
            shape.ProximalFrame = Quaterniond.Identity;
            shape.DistalFrame = Quaterniond.Identity;
        }

        /// <summary>A helix about the z axis through the start, of this radius (m) and number of turns; its frames
        /// follow the tangent without turning about it. The clamps' frames look along z.</summary>
        /// <exception cref="ArgumentException">The wire is too short for so many turns.</exception>
        public static void Helix(RodShape shape, in Vector3d start, double[] lengths, double radius, double turns)
        {
            int n = shape.ElementCount;
            double total = Sum(lengths);
            double around = 2.0 * Math.PI * turns * radius / total;
            if (!(Math.Abs(around) < 1.0))
            {
                throw new ArgumentException("a helix of this radius and number of turns is longer than the wire");
            }
            double along = Math.Sqrt(1.0 - around * around);
            Quaterniond frame = Quaterniond.Identity;
            double s = 0.0;
            shape.X[0] = start;
            for (int j = 0; j < n; j++)
            {
                double angle = 2.0 * Math.PI * turns * (s + 0.5 * lengths[j]) / total;
                var tangent = new Vector3d(-around * Math.Sin(angle), around * Math.Cos(angle), along);
                frame = RodStart.Turned(frame, tangent);
                shape.Q[j] = frame;
                shape.X[j + 1] = shape.X[j] + lengths[j] * tangent;
                s += lengths[j];
            }
            shape.ProximalFrame = Quaterniond.Identity;
            shape.DistalFrame = Quaterniond.Identity;
        }

        private static double Sum(double[] lengths)
        {
            double total = 0.0;
            foreach (double l in lengths)
            {
                total += l;
            }
            return total;
        }
    }
}
