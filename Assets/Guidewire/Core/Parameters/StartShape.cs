namespace Guidewire.Core
{
    /// <summary>The initial shape of a run with a material.</summary>
    public enum StartShape
    {
        /// <summary>The wire starts straight along z.</summary>
        Straight,

        /// <summary>A closed circle through sphere 0 in the y-z plane; both ends have one position and one
        /// frame.</summary>
        Ring,

        /// <summary>A helix about the z axis.</summary>
        Helix,
    }
}
