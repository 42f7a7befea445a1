namespace Guidewire.Core
{
    /// <summary>An introducer sheath: a straight guide without friction around the wire's proximal part, along the axis
    /// on which the wire starts.</summary>
    public sealed class Sheath
    {
        /// <summary>Where it ends, units; null: one element inside the vessel's inlet.</summary>
        public Vector3d? Exit { get; set; }

        /// <summary>The direction in which it leads, of any length; null: along the wire.</summary>
        public Vector3d? Direction { get; set; }
    }
}
