namespace Guidewire.Core
{
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
}
