using System;

namespace Guidewire.Core
{
    /// <summary>What a fluoroscopic picture shows, and its defects.</summary>
    public sealed class FluoroscopySettings
    {
        /// <summary>How the vessel is shown.</summary>
        public VesselContrast Vessel { get; set; } = VesselContrast.RoadMap;

        /// <summary>Linear attenuation coefficient of the contrast agent in the vessel, 1/unit, beyond that of the
        /// tissue that it is in.</summary>
        public double Contrast { get; set; } = 0.1;

        /// <summary>Brightness where there are neither instruments nor vessels, in (0, 1]; 1 is grey level
        /// 255.</summary>
        public double Background { get; set; } = 0.75;

        /// <summary>Standard deviation of the background's noise over its brightness; 0: none. Quanta are counted, so
        /// the variance is in proportion to the brightness.</summary>
        public double Noise { get; set; }

        /// <summary>Which of all noises it is; the same seed gives the same one.</summary>
        public uint Seed { get; set; }

        /// <summary>Standard deviation of the blur by the spot of the tube, units; 0: none.</summary>
        public double Blur { get; set; }

        /// <summary>What is wrong with these values in one phrase, or null.</summary>
        public string? FindProblem()
        {
            return !(Contrast >= 0.0) || double.IsInfinity(Contrast) ? "contrast needs to be a number >= 0"
                : !(Background > 0.0 && Background <= 1.0) ? "background needs to be a number > 0 and <= 1"
                : !(Noise >= 0.0 && Noise <= 1.0) ? "noise needs to be a number from 0 to 1"
                : !(Blur >= 0.0) || double.IsInfinity(Blur) ? "blur needs to be a number >= 0" : null;
        }

        /// <summary>Brightness of the vessel's layer where rays pass so much lumen, over the background's.</summary>
        /// <param name="thickness">Units.</param>
        internal double VesselFactor(double thickness)
        {
            switch (Vessel)
            {
                case VesselContrast.Contrast:
                    return Math.Exp(-Contrast * thickness);
                case VesselContrast.RoadMap:
                    return 1.0 + RoadMapContrast * (1.0 - Math.Exp(-Contrast * thickness));
                default:
                    return 1.0;
            }
        }

        // How much brighter than the background a road map is where it was opaque: at most 0.75 (1 + 0.3) = 0.975.
        private const double RoadMapContrast = 0.3;
    }

    /// <summary>How a fluoroscopic picture shows the vessel.</summary>
    public enum VesselContrast
    {
        /// <summary>Not at all: without contrast agent blood attenuates as the tissue around it.</summary>
        None,

        /// <summary>Filled with contrast agent: darker than the background.</summary>
        Contrast,

        /// <summary>A road map, which is a picture with contrast that is subtracted from those that follow: brighter
        /// than the background, without hiding instruments.</summary>
        RoadMap,

        /// <summary>Where contrast agent is injected: darker by its part of the blood there.</summary>
        Injected,
    }
}
