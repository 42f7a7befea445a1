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
}
