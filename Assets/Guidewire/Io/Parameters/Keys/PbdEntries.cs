namespace Guidewire.Io
{
    /// <summary>The keys of group "pbd": the wire of pbd, stiffness per iteration.</summary>
    internal static class PbdEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "pbd", "mass and stiffness per iteration of the wire", p => p.Simulation.Pbd, new ParameterEntry[]
        {
            Key.Number("totalMass", "mass units", NumberRange.Positive, "M, distributed evenly over the spheres"),
            Key.Number("stretchStiffness", "", NumberRange.NotNegative,
                "k_A, stiffness of the stretch constraint per iteration; unstable from 2 on"),
            Key.Number("bendStiffness", "units", NumberRange.NotNegative,
                "k_B, stiffness of the bend-twist constraint per iteration; unstable above L/n"),
        },
            Takers.Pbd);
    }
}
