namespace Guidewire.Core
{
    /// <summary>How a wall gives way to the wire that presses on it: at each contact by its own displacement, while
    /// the wall elsewhere stays in place (Winkler's foundation).</summary>
    public sealed class WallSoftness
    {
        /// <summary>tipLength where none is given, m.</summary>
        public const double DefaultTipLength = 5e-3;

        /// <summary>u_max over the radius of the wire where none is given.</summary>
        public const double LimitOfRadius = 0.9;

        /// <param name="name">Where it is stated, such as vessel.</param>
        /// <param name="stiffness">K, Pa.</param>
        /// <param name="limit">u_max, m; 0: by the radius.</param>
        /// <param name="tipLength">m.</param>
        /// <param name="relaxationTime">s.</param>
        public WallSoftness(string name, double stiffness, double limit = 0.0,
            double tipLength = DefaultTipLength, double relaxationTime = 0.0)
        {
            Name = name;
            Stiffness = stiffness;
            Limit = limit;
            TipLength = tipLength;
            RelaxationTime = relaxationTime;
        }

        /// <summary>The key or the item of the parameters that states it.</summary>
        public string Name { get; }

        /// <summary>K, force per length of wire and displacement of the wall, Pa: more than 0.</summary>
        public double Stiffness { get; }

        /// <summary>u_max, displacement that the wall does not exceed, m; 0: <see cref="LimitOfRadius"/> times the
        /// wire's radius.</summary>
        public double Limit { get; }

        /// <summary>Length of wall that gives way with the tip, and times the angle in radians with a wall's edge, m:
        /// more than 0.</summary>
        public double TipLength { get; }

        /// <summary>Time in which the wall follows a force (Kelvin-Voigt), s; 0: at once.</summary>
        public double RelaxationTime { get; }

        /// <summary>K by place instead; null where it is the same everywhere.</summary>
        public WallRegions? Regions { get; set; }

        /// <summary>Says by how much a wire of a radius may displace a wall that stays where it is, m.</summary>
        internal double MaxOf(double radius) => Limit > 0.0 && Limit < radius ? Limit : LimitOfRadius * radius;
    }
}
