namespace Guidewire.Core
{
    /// <summary>Contact of rod elements with walls, in addition to that of spheres.</summary>
    public enum ElementContact
    {
        /// <summary>Rod elements; the correction is split between their two spheres by the lever rule.</summary>
        Barycentric,

        /// <summary>Elements have no contact of their own.</summary>
        None,

        /// <summary>Rod elements, by the rule as published (thesis 3.1.2).</summary>
        Thesis,
    }
}
