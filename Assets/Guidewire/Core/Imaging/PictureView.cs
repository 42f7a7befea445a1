namespace Guidewire.Core
{
    /// <summary>The view of a run's picture, as requested. Lengths are in mm unless stated otherwise.</summary>
    public sealed class PictureView
    {
        /// <summary>LAO, degrees; RAO is negative.</summary>
        public double LeftOblique { get; set; }

        /// <summary>Degrees; caudal is negative.</summary>
        public double Cranial { get; set; }

        /// <summary>What is in the middle, units; null: the middle of the vessel, or without one of the wire.</summary>
        public Vector3d? Centre { get; set; }

        /// <summary>Side of the square, mm; null: so that the vessel, or without one the wire, is seen.</summary>
        public double? FieldOfView { get; set; }

        /// <summary>Pixels of a side.</summary>
        public int Pixels { get; set; } = 256;

        /// <summary>Linear attenuation coefficient of all instruments, 1/mm; null: by their materials.</summary>
        public double? Attenuation { get; set; }

        /// <summary>The settings of the picture, with mm in place of units.</summary>
        public FluoroscopySettings Settings { get; } = new FluoroscopySettings();
    }
}
