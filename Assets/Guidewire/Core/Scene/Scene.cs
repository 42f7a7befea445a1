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
}
