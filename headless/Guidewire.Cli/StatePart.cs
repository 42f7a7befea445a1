namespace Guidewire.Cli
{
    /// <summary>The parts of a session's state, each read off at once, in the order in which an answer has
    /// them.</summary>
    internal enum StatePart
    {
        /// <summary>Positions, orientations, their rates, contact forces and the support's.</summary>
        Motion,

        /// <summary>The hub, and the catheters.</summary>
        Instruments,

        /// <summary>Strains, the forces and couples in the wire, and its energies.</summary>
        Strains,
    }
}
