using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The keys of group "gains": the wire as gains.</summary>
    internal static class GainEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "gains", "the wire as gains", new ParameterEntry[]
        {
            new NumberEntry("totalMass", "mass units", NumberRange.Positive, "M, shared evenly by the spheres",
                p => p.Simulation.Gains.TotalMass, (p, v) => p.Simulation.Gains.TotalMass = v)
            {
                Methods = Takers.Gains,
            },
            new NumberEntry("stretchStiffness", "", NumberRange.NotNegative,
                "k_A, gain of the stretch constraint an iteration; 2 and more break down",
                p => p.Simulation.Gains.StretchStiffness, (p, v) => p.Simulation.Gains.StretchStiffness = v)
            {
                Methods = Takers.Gains,
            },
            new NumberEntry("bendStiffness", "units", NumberRange.NotNegative,
                "k_B, gain of the bend-twist constraint an iteration; more than L/n breaks down",
                p => p.Simulation.Gains.BendStiffness, (p, v) => p.Simulation.Gains.BendStiffness = v)
            {
                Methods = Takers.Gains,
            },
        });
    }
}
