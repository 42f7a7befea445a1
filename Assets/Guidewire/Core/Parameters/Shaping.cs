namespace Guidewire.Core
{
    /// <summary>A bend that is put into a wire before the run, over a mandrel: what remains of it is what the core's
    /// law leaves after spring-back.</summary>
    public sealed class Shaping
    {
        /// <summary>Where it begins, units from the hub.</summary>
        public double From { get; set; }

        /// <summary>Where it ends, units from the hub.</summary>
        public double To { get; set; }

        /// <summary>Radius of the mandrel, units; null: as the angle needs.</summary>
        public double? Radius { get; set; }

        /// <summary>Angle that remains, rad; null: as the radius leaves.</summary>
        public double? Angle { get; set; }
    }
}
