namespace Guidewire.Core
{
    /// <summary>How a fluoroscopic picture shows the vessel.</summary>
    public enum VesselContrast
    {
        /// <summary>Not at all: without contrast agent blood attenuates as the tissue around it.</summary>
        None,

        /// <summary>Filled with contrast agent: darker than the background.</summary>
        Contrast,

        /// <summary>As a road map, a picture with contrast that was subtracted from those that follow: brighter than
        /// the background, without hiding instruments.</summary>
        RoadMap,

        /// <summary>Where contrast agent is injected: darker by its part of the blood there.</summary>
        Injected,
    }
}
