namespace Guidewire.Core
{
    /// <summary>What contacts do to the wire in the sweeps of a solver. One implementation a rule of contact, chosen
    /// once.</summary>
    internal interface IContactResponse
    {
        /// <summary>Forgets all contacts and takes over those of a search.</summary>
        /// <param name="found">The search, after it has looked.</param>
        /// <param name="from">Where the motion that it looked at begins, n + 1 positions in units, which stay as they
        /// are until the next start.</param>
        /// <param name="x">Where it looked: the n + 1 predicted positions in units.</param>
        void Start(IContactSearch found, Vector3d[] from, Vector3d[] x);

        /// <summary>Holds spheres and elements off the places where the swept test met a wall.</summary>
        void Stop(StructList<WireContact> impacts);

        /// <summary>Projects all contacts once.</summary>
        /// <param name="x">n + 1 positions in units, corrected in place.</param>
        void Iterate(Vector3d[] x);

        /// <summary>Projects once what holds the wire off places that the swept test met, and nothing else.</summary>
        void IterateStops(Vector3d[] x);

        /// <summary>Contacts at present, in the order of a sweep.</summary>
        int ContactCount { get; }

        /// <summary>Which spheres contact k moves: one, or the two of an element.</summary>
        void SpheresOf(int k, out int first, out int last);

        /// <summary>Projects contact k once, by its spheres alone; false where it moved nothing.</summary>
        bool Project(int k, Vector3d[] x);

        /// <summary>Adds the momentum over dt, in mass unit * unit, that contacts gave each sphere.</summary>
        void AddImpulses(Vector3d[] impulses);
    }
}
