namespace Guidewire.Core
{
    /// <summary>The effect of contacts on the wire in the iterations of a solver. One implementation per contact rule,
    /// chosen once.</summary>
    internal interface IContactResponse
    {
        /// <summary>Forgets all contacts and takes over those of a search.</summary>
        /// <param name="found">The search, after its update.</param>
        /// <param name="from">Where the motion that it searched begins, n + 1 positions in units, which stay as they
        /// are until the next start.</param>
        /// <param name="x">Where it searched: the n + 1 predicted positions in units.</param>
        void Start(IContactSearch found, Vector3d[] from, Vector3d[] x);

        /// <summary>Holds spheres and elements off the points of impact of the swept test.</summary>
        void Stop(StructList<WireContact> impacts);

        /// <summary>Projects all contacts once.</summary>
        /// <param name="x">n + 1 positions in units, corrected in place.</param>
        void Iterate(Vector3d[] x);

        /// <summary>Projects the stops of the swept test once, and nothing else.</summary>
        void IterateStops(Vector3d[] x);

        /// <summary>Contacts at present, in the order of an iteration.</summary>
        int ContactCount { get; }

        /// <summary>Which spheres contact k moves: one, or the two of an element.</summary>
        void SpheresOf(int k, out int first, out int last);

        /// <summary>Projects contact k once, by its spheres alone; false where it moved nothing.</summary>
        bool Project(int k, Vector3d[] x);

        /// <summary>Adds the momentum over dt, in mass unit * unit, that contacts gave each sphere.</summary>
        void AddImpulses(Vector3d[] impulses);
    }
}
