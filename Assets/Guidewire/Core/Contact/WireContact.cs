namespace Guidewire.Core
{
    /// <summary>A sphere or a rod element that is near a wall, and where.</summary>
    internal readonly struct WireContact
    {
        /// <summary>The wall, by its index in the scene's list.</summary>
        public readonly int Wall;

        /// <summary>The sphere, 0 to n, or the rod element, 0 to n - 1, from sphere Index to Index + 1.</summary>
        public readonly int Index;

        /// <summary>True for a rod element, false for a sphere.</summary>
        public readonly bool IsElement;

        /// <summary>Where it comes nearest to the wall; its position runs along the element.</summary>
        public readonly SurfaceContact Nearest;

        /// <summary>Makes a contact with these values.</summary>
        public WireContact(int wall, int index, bool isElement, in SurfaceContact nearest)
        {
            Wall = wall;
            Index = index;
            IsElement = isElement;
            Nearest = nearest;
        }
    }
}
