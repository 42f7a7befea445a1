namespace Guidewire.Core
{
    /// <summary>What touches a wall besides the spheres.</summary>
    public enum ElementContact
    {
        /// <summary>Rod elements; their spheres share the correction by the lever rule.</summary>
        Barycentric,

        /// <summary>Nothing.</summary>
        None,

        /// <summary>Rod elements, by the rule as published (thesis 3.1.2).</summary>
        Seed,
    }
}
