namespace Guidewire.Core
{
    /// <summary>How the proximal end is moved: by a drive, or by user steering instead.</summary>
    public sealed class DriveParameters
    {
        /// <summary>What moves sphere 0.</summary>
        public Drive Kind { get; set; } = Drive.Hold;

        /// <summary>Displacement of sphere 0 at the start in units; only with <see cref="Core.Drive.Hold"/>.</summary>
        public double Displacement { get; set; } = 10.0;

        /// <summary>Direction of the displacement; any length but 0, it is normalised.</summary>
        public Vector3d DisplacementDirection { get; set; } = Vector3d.UnitZ;

        /// <summary>Motion of sphere 0 in units a step; with <see cref="Core.Drive.Displace"/> and
        /// <see cref="Core.Drive.Push"/>.</summary>
        public double DisplacementPerStep { get; set; }

        /// <summary>Turn of element 0 about its own axis in radians a step; where it is not 0 the element's frame is
        /// held.</summary>
        public double TwistPerStep { get; set; }

        /// <summary>Speed of sphere 0 in m/s, with <see cref="Core.Drive.Displace"/> and <see cref="Core.Drive.Push"/>:
        /// for a wire with a material instead of <see cref="DisplacementPerStep"/>.</summary>
        public double InsertionSpeed { get; set; }

        /// <summary>Turning of the proximal clamp about its axis in rad/s, instead of <see
        /// cref="TwistPerStep"/>.</summary>
        public double RotationSpeed { get; set; }

        /// <summary>Displacement and turn of the proximal clamp over time, instead of the speeds, or null.</summary>
        public DriveTable? Table { get; set; }

        /// <summary>The axial force in N at which the hub slips; 0: never; NaN: that of a hand.</summary>
        public double HubForceLimit { get; set; } = double.NaN;

        /// <summary>How fast a hub slips at most, m/s; 0: as fast as its force asks.</summary>
        /// <remarks>A hand that reaches over L within T goes at most at 15/8 L/T (least jerk, Flash and Hogan 1985,
        /// J Neurosci 5:1688), with 0.3 m in about a second some 0.5 m/s; fingers let a shaft through no
        /// faster.</remarks>
        public double SlipSpeed { get; set; } = 0.5;

        /// <summary>Force on sphere 0 in mass unit * unit / s^2; with <see cref="Core.Drive.Force"/>.</summary>
        public Vector3d ExternalForce { get; set; }

        /// <summary>User steering that pushes and turns the wire interactively, instead of the drive's motion, or
        /// null.</summary>
        public Steering? Steering { get; set; }

        /// <summary>The farthest that speeds or table move the hub within a time from the start, s; 0 with user
        /// steering. In m.</summary>
        internal double LargestInsertion(double duration)
        {
            if (Steering != null || Table == null)
            {
                return Steering != null ? 0.0 : System.Math.Max(0.0, InsertionSpeed * duration);
            }
            double largest = 0.0;
            foreach (double value in Table.Insertion.ValuesUntil(duration))
            {
                largest = System.Math.Max(largest, value - Table.Insertion.At(0.0));
            }
            return largest;
        }

        /// <summary>The farthest that it moves the hub in one step, m; 0 with user steering.</summary>
        /// <param name="timeStep">s.</param>
        /// <param name="unitLength">m.</param>
        internal double LargestMove(double timeStep, double unitLength)
        {
            double speed = System.Math.Max(System.Math.Abs(InsertionSpeed), Table?.Insertion.LargestRate ?? 0.0);
            return Steering != null ? 0.0
                : System.Math.Max(speed * timeStep, unitLength * System.Math.Abs(DisplacementPerStep));
        }

        /// <summary>The farthest that a hub slips in one step, m.</summary>
        /// <param name="timeStep">s.</param>
        internal double LargestSlip(double timeStep) =>
            SlipSpeed > 0.0 ? SlipSpeed * timeStep : double.PositiveInfinity;

        /// <summary>Gives a copy of the values; lists and walls are shared.</summary>
        internal DriveParameters Copy() => (DriveParameters)MemberwiseClone();
    }

    /// <summary>What moves sphere 0.</summary>
    public enum Drive
    {
        /// <summary>One displacement at the start, then held: the steady-state simulation of thesis 3.1.4.</summary>
        Hold,

        /// <summary>Moved every step along a fixed direction.</summary>
        Displace,

        /// <summary>Moved every step along the first rod element (thesis eq. 3.6).</summary>
        Push,

        /// <summary>Free, under an external force.</summary>
        Force,
    }

    /// <summary>User steering of the wire: set between two steps, read in the next.</summary>
    public sealed class Steering
    {
        /// <summary>Motion of sphere 0 along the first element in the next step (thesis eq. 3.6), units; negative
        /// values pull.</summary>
        public double Push { get; set; }

        /// <summary>Turn of element 0 about its own axis in the next step, rad.</summary>
        public double Turn { get; set; }

        /// <summary>Strain of an element at which a pbd wire slips in the hand; infinite: never.</summary>
        public double SlipStrain { get; set; } = double.PositiveInfinity;
    }

    /// <summary>What holds the proximal end of a material rod.</summary>
    public enum ProximalEnd
    {
        /// <summary>Sphere 0 is held, its frame turns freely: a ball joint.</summary>
        Held,

        /// <summary>Position and frame are held, through a bending spring to the clamp's frame.</summary>
        Clamped,

        /// <summary>Nothing: the rod flies.</summary>
        Free,
    }

    /// <summary>What holds the distal end of a material rod.</summary>
    public enum DistalEnd
    {
        /// <summary>Nothing is held.</summary>
        Free,

        /// <summary>Position and frame are held.</summary>
        Clamped,

        /// <summary>The frame and the position across an axis are held; along the axis the end is free.</summary>
        Sliding,

        /// <summary>The last sphere is held, its frame turns freely: a ball joint, as <see
        /// cref="ProximalEnd.Held"/>.</summary>
        Held,
    }
}
