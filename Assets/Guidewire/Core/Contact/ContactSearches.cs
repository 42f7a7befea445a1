namespace Guidewire.Core
{
    /// <summary>Finds the spheres and rod elements near the walls, without any response. One implementation per contact
    /// rule, chosen once.</summary>
    internal interface IContactSearch : IWallClearance
    {
        /// <summary>Whether spheres may not pass a wall, so that the swept test looks for points where they
        /// would.</summary>
        bool GuardsSpheres { get; }

        /// <summary>Whether rod elements may not pass either.</summary>
        bool GuardsElements { get; }

        /// <summary>What the last search found, wall by wall and along the wire.</summary>
        StructList<WireContact> Contacts { get; }

        /// <summary>The impacts that the swept test found; without stops there the motion would pass the wall.
        /// </summary>
        StructList<WireContact> Impacts { get; }

        /// <summary>Finds the contacts of a motion of the wire.</summary>
        /// <param name="from">Where the n + 1 spheres are, units; under a rule that guards, clear of the walls.</param>
        /// <param name="to">Where the prediction takes them.</param>
        void Find(Vector3d[] from, Vector3d[] to);
    }

    /// <summary>Lower bounds of the distances between a wire's elements and walls.</summary>
    internal interface IWallClearance
    {
        /// <summary>The walls from which distances count.</summary>
        ContactShape[] Walls { get; }

        /// <summary>Radius of the wire, its least where it varies, units.</summary>
        double Radius { get; }

        /// <summary>Lower bound of the distance of element j from wall w at the start of the motion under test,
        /// units.</summary>
        double ClearanceOf(int w, int j);
    }

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
