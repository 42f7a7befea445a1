using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The keys of group "material": the wire as a material.</summary>
    internal static class MaterialEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "material", "the wire as a material", p => p.Simulation.Material, new ParameterEntry[]
        {
            new TextEntry(InstrumentLayer.Key,
                "name of a file in the folder instruments beside the parameter file or in the program's: it stands for"
                + " the wire's length, elements, radii, stiffnesses, density, sections and tip shape, and for the"
                + " frictionCoefficient of walls that state none (docs/instruments.md); other keys of the file override"
                + " it; on the command line it replaces the file's wire, except guidewireLength and numberRodElements")
                .OnlyWith(Takers.Material),
            new NumberEntry("youngsModulus", "Pa", NumberRange.Positive, "E"),
            new NumberEntry("shearModulus", "Pa", NumberRange.Positive, "G"),
            new NumberEntry("density", "kg/m^3", NumberRange.Positive, "rho; the wire's mass follows from it"),
            new NumberEntry("wireRadius", "m", NumberRange.Positive, "radius of the wire as a material"),
            new NumberEntry("innerRadius", "m", NumberRange.NotNegative,
                "inner radius of a hollow wire, less than wireRadius; 0 for a solid wire"),
            new NumberEntry("shearFactor", "", NumberRange.Positive,
                "shear correction factor of GA: 0.9 for a round wire, about 0.5 for a thin-walled tube"),
            new OptionalNumberEntry("bendingStiffness", "N m^2", NumberRange.Positive,
                "EI of the whole wire, which determines E instead of youngsModulus; a section of another material or "
                + "radius has its own"),
            new OptionalNumberEntry("torsionalStiffness", "N m^2", NumberRange.Positive,
                "GJ of the whole wire, which determines G instead of shearModulus"),
            new OptionalNumberEntry("axialStiffness", "N", NumberRange.Positive,
                "EA of the whole wire, instead of the value from E and the radius, as for a coiled wire; EI is "
                    + "unchanged"),
            new OptionalNumberEntry("massPerLength", "kg/m", NumberRange.Positive,
                "rho A of the whole wire, which determines rho instead of density"),
            new VectorEntry("restCurvature", "rad/m", true, "curvature about d1 and d2 and twist about d3 at rest"),
            new SectionsEntry("wireSections",
                "sections of the wire with their own material, rest curvature or elements, such as a soft, bent tip;"
                + " an element across a boundary has the length-weighted mean of compliance, mass and rest curvature;"
                + " stiffness and mass given directly replace those from material and radius, and the rotary inertia"
                + " about each axis is then massPerLength EI/EA")
            {
                Property = nameof(MaterialParameters.Sections),
            },
            new NumberEntry("massDamping", "1/s", NumberRange.NotNegative,
                "a in the force -a M v: a mode of angular frequency w has the damping ratio a/(2 w) at any timeStep"),
            new NumberEntry("materialDamping", "s", NumberRange.NotNegative,
                "b in the stress b K times the strain rate (Kelvin-Voigt): damping ratio b w/2 at any timeStep")
                .OnlyWith(Takers.Only(Solver.Direct)),
            new ChoiceEntry<ClampRule>("clampRule",
                "weights of the joints at a clamp: order 4 under transverse loads, order 2 (exact for an arc), order"
                + " 1; with any of them a buckling load is too low by (k l)^2/12, k the wave number of the buckled "
                + "shape (clamped at both ends: 0.8 % at 20 elements)"),
            new ChoiceEntry<MassRule>("massRule",
                "mass matrix; xpbd and explicit take \"consistent\" as \"lumped\""),
            new ChoiceEntry<BendLaw>("bendLaw", "couple of a joint: K times the angle, or K sin(angle)"),
        },
            Takers.Material);
    }
}
