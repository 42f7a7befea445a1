using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The keys of runs with a material, a part of the parameter table.</summary>
    internal static class MaterialEntries
    {
        /// <summary>The solver, which decides between gains and a material.</summary>
        public const string SolverKey = "solver";

        /// <summary>The keys of a wire's material, loads and ends; with gains only some of the ends mean
        /// anything.</summary>
        public static IReadOnlyList<ParameterEntry> Material { get; } = new ParameterEntry[]
        {
            new NumberEntry("youngsModulus", "Pa", NumberRange.Positive, "E",
                p => Of(p).YoungsModulus, (p, v) => Of(p).YoungsModulus = v),
            new NumberEntry("shearModulus", "Pa", NumberRange.Positive, "G",
                p => Of(p).ShearModulus, (p, v) => Of(p).ShearModulus = v),
            new NumberEntry("density", "kg/m^3", NumberRange.Positive, "rho; the wire's mass follows from it",
                p => Of(p).Density, (p, v) => Of(p).Density = v),
            new NumberEntry("wireRadius", "m", NumberRange.Positive, "radius of the wire as a material",
                p => Of(p).WireRadius, (p, v) => Of(p).WireRadius = v),
            new VectorEntry("restCurvature", "rad/m", true, "curvature about d1 and d2 and twist about d3 at rest",
                p => Of(p).RestCurvature, (p, v) => Of(p).RestCurvature = v),
            new SectionsEntry("wireSections",
                "pieces of the wire with a material or rest curvature of their own, such as a soft, bent tip",
                p => Of(p).Sections, (p, v) => Of(p).Sections = v),
            new NumberEntry("metresPerUnit", "m", NumberRange.Positive, "length of one unit",
                p => Of(p).MetresPerUnit, (p, v) => Of(p).MetresPerUnit = v),
            new VectorEntry("tipForce", "N", true, "force on the last sphere",
                p => Of(p).TipForce, (p, v) => Of(p).TipForce = v),
            new NumberEntry("tipForceReleaseTime", "s", NumberRange.NotNegative, "when the tip force ends",
                p => Of(p).TipForceReleaseTime, (p, v) => Of(p).TipForceReleaseTime = v),
            new VectorEntry("tipMoment", "N m", true,
                "couple at the wire's end along the axes there, with which it turns; direct and explicit only",
                p => Of(p).TipMoment, (p, v) => Of(p).TipMoment = v),
            new ChoiceEntry<InitialState>("initialState",
                "start in the start shape, or in the rest shape under gravity, tip loads and supports; with"
                + " maxSimulationSteps 0 the rest shape is all that is computed",
                p => Of(p).InitialState, (p, v) => Of(p).InitialState = v),
            new ChoiceEntry<StartShape>("startShape", "the shape to set out from; a ring has both ends in one place",
                p => Of(p).StartShape, (p, v) => Of(p).StartShape = v),
            new NumberEntry("startRadius", "units", NumberRange.Positive, "radius of startShape \"helix\"",
                p => Of(p).StartRadius, (p, v) => Of(p).StartRadius = v),
            new NumberEntry("startTurns", "", NumberRange.Any, "turns of startShape \"helix\"",
                p => Of(p).StartTurns, (p, v) => Of(p).StartTurns = v),
            new ChoiceEntry<ProximalEnd>("proximalEnd", "sphere 0 held, also its frame clamped, or"
                + " nothing held; with gains \"held\" or \"clamped\"",
                p => Of(p).ProximalEnd, (p, v) => Of(p).ProximalEnd = v),
            new ChoiceEntry<DistalEnd>("distalEnd",
                "nothing held; place and frame held; frame held and free to slide along the frame's axis (direct"
                + " only)",
                p => Of(p).DistalEnd, (p, v) => Of(p).DistalEnd = v),
            new NumberEntry("axialForce", "N", NumberRange.Any, "pull on a sliding distal end along its axis",
                p => Of(p).AxialForce, (p, v) => Of(p).AxialForce = v),
            new NumberEntry("distalRotation", "rad", NumberRange.Any,
                "turn of the distal clamp about its own axis; more than one turn counts",
                p => Of(p).DistalRotation, (p, v) => Of(p).DistalRotation = v),
            new NumberEntry("distalDisplacement", "units", NumberRange.Any,
                "displacement of the distal clamp along its own axis",
                p => Of(p).DistalDisplacement, (p, v) => Of(p).DistalDisplacement = v),
            new NumberEntry("distalRampTime", "s", NumberRange.NotNegative,
                "time over which distalRotation and distalDisplacement grow; 0: at once",
                p => Of(p).DistalRampTime, (p, v) => Of(p).DistalRampTime = v),
            new ChoiceEntry<ClampRule>("clampRule",
                "weights of the joints at a clamp: order 4, order 2 (exact for an arc), order 1",
                p => Of(p).ClampRule, (p, v) => Of(p).ClampRule = v),
            new ChoiceEntry<MassRule>("massRule",
                "mass matrix; xpbd and explicit take \"consistent\" as \"lumped\"",
                p => Of(p).MassRule, (p, v) => Of(p).MassRule = v),
            new ChoiceEntry<BendLaw>("bendLaw", "couple of a joint: K angle, or K sin(angle)",
                p => Of(p).BendLaw, (p, v) => Of(p).BendLaw = v),
            new IntegerEntry("substeps", "", 1, 100_000_000, "parts of a time step, xpbd and explicit",
                p => Of(p).Substeps, (p, v) => Of(p).Substeps = v),
            new NumberEntry("solverTolerance", "rad, or displacement over L", NumberRange.PositiveUpTo(1e-2),
                "error that the direct solver may leave in a stage; also of the balance of forces in a step, "
                + "over the largest",
                p => Of(p).SolverTolerance, (p, v) => Of(p).SolverTolerance = v),
            new IntegerEntry("maxNewtonIterations", "", 1, 1_000_000,
                "after which the direct solver gives up a stage; ten times as many for a rest shape",
                p => Of(p).MaxNewtonIterations, (p, v) => Of(p).MaxNewtonIterations = v),
        };

        /// <summary>The solver's own entry.</summary>
        public static ParameterEntry Solver { get; } = new ChoiceEntry<Solver>(SolverKey,
            "pbd takes gains; xpbd, direct and explicit take a material",
            p => p.Simulation.Solver, (p, v) => p.Simulation.Solver = v);

        private static MaterialParameters Of(RunParameters parameters)
        {
            return parameters.Simulation.Material;
        }
    }
}
