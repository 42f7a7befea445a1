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
                p => p.Simulation.Material.YoungsModulus, (p, v) => p.Simulation.Material.YoungsModulus = v),
            new NumberEntry("shearModulus", "Pa", NumberRange.Positive, "G",
                p => p.Simulation.Material.ShearModulus, (p, v) => p.Simulation.Material.ShearModulus = v),
            new NumberEntry("density", "kg/m^3", NumberRange.Positive, "rho; the wire's mass follows from it",
                p => p.Simulation.Material.Density, (p, v) => p.Simulation.Material.Density = v),
            new NumberEntry("wireRadius", "m", NumberRange.Positive, "radius of the wire as a material",
                p => p.Simulation.Material.WireRadius, (p, v) => p.Simulation.Material.WireRadius = v),
            new VectorEntry("restCurvature", "rad/m", true, "curvature about d1 and d2 and twist about d3 at rest",
                p => p.Simulation.Material.RestCurvature, (p, v) => p.Simulation.Material.RestCurvature = v),
            new SectionsEntry("wireSections",
                "pieces of the wire with a material or rest curvature of their own, such as a soft, bent tip",
                p => p.Simulation.Material.Sections, (p, v) => p.Simulation.Material.Sections = v),
            new NumberEntry("metresPerUnit", "m", NumberRange.Positive, "length of one unit",
                p => p.Simulation.Scene.MetresPerUnit, (p, v) => p.Simulation.Scene.MetresPerUnit = v),
            new VectorEntry("tipForce", "N", true, "force on the last sphere",
                p => p.Simulation.Scene.TipForce, (p, v) => p.Simulation.Scene.TipForce = v),
            new NumberEntry("tipForceReleaseTime", "s", NumberRange.NotNegative, "when the tip force ends",
                p => p.Simulation.Scene.TipForceReleaseTime, (p, v) => p.Simulation.Scene.TipForceReleaseTime = v),
            new VectorEntry("tipMoment", "N m", true,
                "couple at the wire's end along the axes there, with which it turns; direct and explicit only",
                p => p.Simulation.Scene.TipMoment, (p, v) => p.Simulation.Scene.TipMoment = v),
            new ChoiceEntry<InitialState>("initialState",
                "start in the start shape, or in the rest shape under gravity, tip loads and supports; with"
                + " maxSimulationSteps 0 the rest shape is all that is computed",
                p => p.Simulation.Scene.InitialState, (p, v) => p.Simulation.Scene.InitialState = v),
            new ChoiceEntry<StartShape>("startShape", "the shape to set out from; a ring has both ends in one place",
                p => p.Simulation.Scene.StartShape, (p, v) => p.Simulation.Scene.StartShape = v),
            new NumberEntry("startRadius", "units", NumberRange.Positive, "radius of startShape \"helix\"",
                p => p.Simulation.Scene.StartRadius, (p, v) => p.Simulation.Scene.StartRadius = v),
            new NumberEntry("startTurns", "", NumberRange.Any, "turns of startShape \"helix\"",
                p => p.Simulation.Scene.StartTurns, (p, v) => p.Simulation.Scene.StartTurns = v),
            new ChoiceEntry<ProximalEnd>("proximalEnd", "sphere 0 held, also its frame clamped, or"
                + " nothing held; with gains \"held\" or \"clamped\"",
                p => p.Simulation.Scene.ProximalEnd, (p, v) => p.Simulation.Scene.ProximalEnd = v),
            new ChoiceEntry<DistalEnd>("distalEnd",
                "nothing held; place and frame held; frame held and free to slide along the frame's axis (direct"
                + " only)",
                p => p.Simulation.Scene.DistalEnd, (p, v) => p.Simulation.Scene.DistalEnd = v),
            new NumberEntry("axialForce", "N", NumberRange.Any, "pull on a sliding distal end along its axis",
                p => p.Simulation.Scene.AxialForce, (p, v) => p.Simulation.Scene.AxialForce = v),
            new NumberEntry("distalRotation", "rad", NumberRange.Any,
                "turn of the distal clamp about its own axis; more than one turn counts",
                p => p.Simulation.Scene.DistalRotation, (p, v) => p.Simulation.Scene.DistalRotation = v),
            new NumberEntry("distalDisplacement", "units", NumberRange.Any,
                "displacement of the distal clamp along its own axis",
                p => p.Simulation.Scene.DistalDisplacement, (p, v) => p.Simulation.Scene.DistalDisplacement = v),
            new NumberEntry("distalRampTime", "s", NumberRange.NotNegative,
                "time over which distalRotation and distalDisplacement grow; 0: at once",
                p => p.Simulation.Scene.DistalRampTime, (p, v) => p.Simulation.Scene.DistalRampTime = v),
            new ChoiceEntry<ClampRule>("clampRule",
                "weights of the joints at a clamp: order 4, order 2 (exact for an arc), order 1",
                p => p.Simulation.Material.ClampRule, (p, v) => p.Simulation.Material.ClampRule = v),
            new ChoiceEntry<MassRule>("massRule",
                "mass matrix; xpbd and explicit take \"consistent\" as \"lumped\"",
                p => p.Simulation.Material.MassRule, (p, v) => p.Simulation.Material.MassRule = v),
            new ChoiceEntry<BendLaw>("bendLaw", "couple of a joint: K angle, or K sin(angle)",
                p => p.Simulation.Material.BendLaw, (p, v) => p.Simulation.Material.BendLaw = v),
            new IntegerEntry("substeps", "", 1, 100_000_000, "parts of a time step, xpbd and explicit",
                p => p.Simulation.Method.Substeps, (p, v) => p.Simulation.Method.Substeps = v),
            new NumberEntry("solverTolerance", "rad, or displacement over L", NumberRange.PositiveUpTo(1e-2),
                "error that the direct solver may leave in a stage; also of the balance of forces in a step, "
                + "over the largest",
                p => p.Simulation.Method.SolverTolerance, (p, v) => p.Simulation.Method.SolverTolerance = v),
            new IntegerEntry("maxNewtonIterations", "", 1, 1_000_000,
                "after which the direct solver gives up a stage; ten times as many for a rest shape",
                p => p.Simulation.Method.MaxNewtonIterations, (p, v) => p.Simulation.Method.MaxNewtonIterations = v),
        };

        /// <summary>The solver's own entry.</summary>
        public static ParameterEntry Solver { get; } = new ChoiceEntry<Solver>(SolverKey,
            "pbd takes gains; xpbd, direct and explicit take a material",
            p => p.Simulation.Method.Solver, (p, v) => p.Simulation.Method.Solver = v);
    }
}
