namespace Guidewire.Core
{
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
