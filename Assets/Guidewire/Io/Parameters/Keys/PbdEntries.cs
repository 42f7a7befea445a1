using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The keys of group "gains": the wire as gains.</summary>
    internal static class PbdEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "gains", "the wire as gains", new ParameterEntry[]
        {
            new NumberEntry("totalMass", "mass units", NumberRange.Positive, "M, shared evenly by the spheres",
                p => p.Simulation.Pbd.TotalMass, (p, v) => p.Simulation.Pbd.TotalMass = v)
            {
                Methods = Takers.Pbd,
            },
            new NumberEntry("stretchStiffness", "", NumberRange.NotNegative,
                "k_A, gain of the stretch constraint an iteration; 2 and more break down",
                p => p.Simulation.Pbd.StretchStiffness, (p, v) => p.Simulation.Pbd.StretchStiffness = v)
            {
                Methods = Takers.Pbd,
            },
            new NumberEntry("bendStiffness", "units", NumberRange.NotNegative,
                "k_B, gain of the bend-twist constraint an iteration; more than L/n breaks down",
                p => p.Simulation.Pbd.BendStiffness, (p, v) => p.Simulation.Pbd.BendStiffness = v)
            {
                Methods = Takers.Pbd,
            },
        });
    }
}
