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
            Key.Text(InstrumentLayer.Key,
                "name of a file in the folder instruments beside this file or in the program's; it stands for keys of "
                + "the wire (docs/instruments.md)")
                .OnlyWith(Takers.Material),
            Key.Number("youngsModulus", "Pa", NumberRange.Positive, "E"),
            Key.Number("shearModulus", "Pa", NumberRange.Positive, "G"),
            Key.Number("density", "kg/m^3", NumberRange.Positive, "rho; the wire's mass follows from it"),
            Key.Number("wireRadius", "m", NumberRange.Positive, "radius of the wire as a material"),
            Key.Number("innerRadius", "m", NumberRange.NotNegative,
                "inner radius of a hollow wire, less than wireRadius; 0 for a solid wire"),
            Key.OptionalNumber("coreDiameter", "m", NumberRange.Positive,
                "diameter of the thickest solid part, the core or the wire of a coil, of which strains are taken; "
                + "null: "
                + "that of the wire"),
            Key.Choice<CoreMaterial>("material",
                "material of the core, which gives way beyond its elastic range (docs/materials.md); sets E, G and rho "
                + "where they are not given")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Of(Kinds.Optional(WireKinds.Plateau), "plateau",
                "plateau of a superelastic core by numbers; null: none")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.OptionalNumber("yieldStress", "Pa", NumberRange.Positive,
                "stress at which the core yields and keeps a bend; null: none")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.OptionalNumber("hardening", "Pa", NumberRange.NotNegative,
                "slope of the stress over the core's own strain beyond plateau or yield; null: E/1000")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Whole("fibres", "", 0, 16,
                "rings of fibres in a section with such a law, each of 4 (rings - 1) fibres; 0: 4 to 7 by material")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Of(Kinds.Optional(WireKinds.Shaped), "shaped",
                "bend put into the wire over a mandrel before the run, towards -d2; spring-back is the core's law")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Number("shearFactor", "", NumberRange.Positive,
                "shear correction factor of GA: 0.9 for a round wire, about 0.5 for a thin-walled tube"),
            Key.OptionalNumber("bendingStiffness", "N m^2", NumberRange.Positive,
                "EI of the whole wire, which determines E instead of youngsModulus; a section of another material or "
                + "radius has its own"),
            Key.OptionalNumber("torsionalStiffness", "N m^2", NumberRange.Positive,
                "GJ of the whole wire, which determines G instead of shearModulus"),
            Key.OptionalNumber("axialStiffness", "N", NumberRange.Positive,
                "EA of the whole wire, instead of the value from E and the radius, as for a coiled wire; EI is "
                    + "unchanged"),
            Key.OptionalNumber("massPerLength", "kg/m", NumberRange.Positive,
                "rho A of the whole wire, which determines rho instead of density"),
            Key.Vector("restCurvature", "rad/m", true, "curvature about d1 and d2 and twist about d3 at rest"),
            Key.Of(WireKinds.Sections, "wireSections",
                "sections with their own material, rest curvature or elements, such as a soft, bent tip; stiffness and "
                + "mass given directly replace the material's").In(nameof(MaterialParameters.Sections)),
            Key.Number("massDamping", "1/s", NumberRange.NotNegative,
                "a in the force -a M v: a mode of angular frequency w has the damping ratio a/(2 w) at any timeStep"),
            Key.Number("materialDamping", "s", NumberRange.NotNegative,
                "b in the stress b K times the strain rate (Kelvin-Voigt): damping ratio b w/2 at any timeStep")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Choice<ClampRule>("clampRule",
                "weights of the joints at a clamp: order 4 under transverse loads, order 2 (exact for an arc), order "
                + "1"),
            Key.Choice<MassRule>("massRule",
                "mass matrix; xpbd and explicit take \"consistent\" as \"lumped\""),
            Key.Choice<BendLaw>("bendLaw", "couple of a joint: K times the angle, or K sin(angle)"),
        },
            Takers.Material);
    }
}
