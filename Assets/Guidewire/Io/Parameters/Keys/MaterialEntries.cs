using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The keys of group "material": the wire as a material.</summary>
    internal static class MaterialEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "material", "the wire as a material", new ParameterEntry[]
        {
            new TextEntry(InstrumentLayer.Key,
                "name of a file in the folder instruments beside the parameter file or in the program's: it stands for"
                + " the wire's length, elements, radii, stiffnesses, density, sections and tip shape, and for the"
                + " frictionCoefficient of walls that state none (docs/instruments.md); other keys of the file override"
                + " it; on the command line it replaces the file's wire but for guidewireLength and numberRodElements",
                p => p.Instrument, (p, v) => p.Instrument = v)
            {
                Methods = Takers.Material,
                IsRefusedElsewhere = true,
            },
            new NumberEntry("youngsModulus", "Pa", NumberRange.Positive, "E",
                p => p.Simulation.Material.YoungsModulus, (p, v) => p.Simulation.Material.YoungsModulus = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("shearModulus", "Pa", NumberRange.Positive, "G",
                p => p.Simulation.Material.ShearModulus, (p, v) => p.Simulation.Material.ShearModulus = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("density", "kg/m^3", NumberRange.Positive, "rho; the wire's mass follows from it",
                p => p.Simulation.Material.Density, (p, v) => p.Simulation.Material.Density = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("wireRadius", "m", NumberRange.Positive, "radius of the wire as a material",
                p => p.Simulation.Material.WireRadius, (p, v) => p.Simulation.Material.WireRadius = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("innerRadius", "m", NumberRange.NotNegative,
                "inner radius of a hollow wire, less than wireRadius; 0 for a solid wire",
                p => p.Simulation.Material.InnerRadius, (p, v) => p.Simulation.Material.InnerRadius = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("shearFactor", "", NumberRange.Positive,
                "shear correction factor of GA: 0.9 for a round wire, about 0.5 for a thin-walled tube",
                p => p.Simulation.Material.ShearFactor, (p, v) => p.Simulation.Material.ShearFactor = v)
            {
                Methods = Takers.Material,
            },
            new OptionalNumberEntry("bendingStiffness", "N m^2", NumberRange.Positive,
                "EI of the whole wire, which sets E instead of youngsModulus; a section of another material or radius"
                + " has its own",
                p => p.BendingStiffness, (p, v) => p.BendingStiffness = v)
            {
                Methods = Takers.Material,
            },
            new OptionalNumberEntry("torsionalStiffness", "N m^2", NumberRange.Positive,
                "GJ of the whole wire, which sets G instead of shearModulus",
                p => p.TorsionalStiffness, (p, v) => p.TorsionalStiffness = v)
            {
                Methods = Takers.Material,
            },
            new OptionalNumberEntry("axialStiffness", "N", NumberRange.Positive,
                "EA of the whole wire instead of that from E and the radius, as for a coiled wire; EI is unchanged",
                p => p.Simulation.Material.AxialStiffness, (p, v) => p.Simulation.Material.AxialStiffness = v)
            {
                Methods = Takers.Material,
            },
            new OptionalNumberEntry("massPerLength", "kg/m", NumberRange.Positive,
                "rho A of the whole wire, which sets rho instead of density",
                p => p.MassPerLength, (p, v) => p.MassPerLength = v)
            {
                Methods = Takers.Material,
            },
            new VectorEntry("restCurvature", "rad/m", true, "curvature about d1 and d2 and twist about d3 at rest",
                p => p.Simulation.Material.RestCurvature, (p, v) => p.Simulation.Material.RestCurvature = v)
            {
                Methods = Takers.Material,
            },
            new SectionsEntry("wireSections",
                "sections of the wire with their own material, rest curvature or elements, such as a soft, bent tip;"
                + " an element across a boundary has the length-weighted mean of compliance, mass and rest curvature;"
                + " stiffness and mass given directly replace those from material and radius, and the rotary inertia"
                + " about each axis is then massPerLength EI/EA",
                p => p.Simulation.Material.Sections, (p, v) => p.Simulation.Material.Sections = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("massDamping", "1/s", NumberRange.NotNegative,
                "a in the force -a M v: a mode of angular frequency w has the damping ratio a/(2 w) at any timeStep",
                p => p.Simulation.Material.MassDamping, (p, v) => p.Simulation.Material.MassDamping = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("materialDamping", "s", NumberRange.NotNegative,
                "b in the stress b K times the strain rate (Kelvin-Voigt): damping ratio b w/2 at any timeStep",
                p => p.Simulation.Material.MaterialDamping, (p, v) => p.Simulation.Material.MaterialDamping = v)
            {
                Methods = Takers.Only(Solver.Direct),
                IsRefusedElsewhere = true,
            },
            new ChoiceEntry<ClampRule>("clampRule",
                "weights of the joints at a clamp: order 4 under transverse loads, order 2 (exact for an arc), order"
                + " 1; with any of them a buckling load is low by (k l)^2/12, k the wave number of the buckled shape"
                + " (clamped at both ends: 0.8 % at 20 elements)",
                p => p.Simulation.Material.ClampRule, (p, v) => p.Simulation.Material.ClampRule = v)
            {
                Methods = Takers.Material,
            },
            new ChoiceEntry<MassRule>("massRule",
                "mass matrix; xpbd and explicit take \"consistent\" as \"lumped\"",
                p => p.Simulation.Material.MassRule, (p, v) => p.Simulation.Material.MassRule = v)
            {
                Methods = Takers.Material,
            },
            new ChoiceEntry<BendLaw>("bendLaw", "couple of a joint: K times the angle, or K sin(angle)",
                p => p.Simulation.Material.BendLaw, (p, v) => p.Simulation.Material.BendLaw = v)
            {
                Methods = Takers.Material,
            },
        });
    }
}
