using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The keys of group "method": how it is simulated, and what ends the run.</summary>
    internal static class MethodEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "method", "how it is simulated, and what ends the run", p => p.Simulation.Method, new ParameterEntry[]
        {
            new ChoiceEntry<Solver>("solver",
                "the method: pbd (stiffness per iteration), or xpbd, direct and explicit (a material)"),
            new NumberEntry("timeStep", "s", NumberRange.Positive, "dt"),
            new IntegerEntry("maxSimulationSteps", "steps", 0, 1_000_000_000, "largest number of steps of the run"),
            new OptionalNumberEntry("duration", "s", NumberRange.NotNegative,
                "simulated time of the run, instead of maxSimulationSteps, which is then derived from it; the "
                + "last step may end later"),
            new IntegerEntry("constraintSolverSteps", "iterations per step", 0, 1_000_000,
                "m, Gauss-Seidel iterations per step, with xpbd per substep; with pbd, more iterations make a "
                    + "stiffer wire")
            {
                Methods = Takers.Only(Solver.Pbd, Solver.Xpbd),
            },
            new ChoiceEntry<Integrator>("integrator",
                "pbd: how positions are predicted; direct: esdirk3 for most motions, esdirk4 for smooth ones, trbdf2 "
                + "for short steps; bdf2 and implicitEuler damp more")
            {
                OlderWords = new Dictionary<string, string>
                {
                    ["sdirk2"] = "trbdf2",
                    ["sdirk3"] = "esdirk3",
                    ["sdirk4"] = "esdirk4",
                },
                Methods = Takers.Only(Solver.Pbd, Solver.Direct),
            },
            new SwitchEntry("VerletIntegration", "older name of integrator: true is \"verlet\", false \"euler\"")
            {
                Getter = p => p.Simulation.Method.Integrator == Integrator.Verlet,
                Setter = (p, v) => p.Simulation.Method.Integrator = v ? Integrator.Verlet : Integrator.Euler,
                Methods = Takers.Pbd,
            },
            new ChoiceEntry<SweepOrder>("sweepOrder", "order of the elements within an iteration")
            {
                Methods = Takers.Pbd,
            },
            new IntegerEntry("substeps", "", 1, 100_000_000, "parts of a time step")
            {
                Methods = Takers.Only(Solver.Xpbd, Solver.Explicit),
            },
            new NumberEntry("solverTolerance", "rad, or displacement over L", NumberRange.PositiveUpTo(1e-2),
                "residual error allowed in a stage of direct, and in a step's force balance over the largest force; "
                + "forces between walls need 1e-5")
            {
                Methods = Takers.Material,
            },
            new NumberEntry("timeStepError", "rad, or displacement over L", NumberRange.NotNegative,
                "tolerance of the step size control with trbdf2, esdirk3 and esdirk4, which subdivides steps, down to "
                + "1/1024 of timeStep; 0: no control")
            {
                Methods = Takers.Only(Solver.Direct),
            },
            new IntegerEntry("maxNewtonIterations", "", 1, 1_000_000,
                "iterations after which the direct solver gives up a stage; ten times as many for a rest shape")
            {
                Methods = Takers.Material,
            },
            new NumberEntry("damping", "", NumberRange.Fraction,
                "fraction of its velocity that a sphere loses per step; a material has massDamping and materialDamping")
            {
                Instead = "massDamping (1/s), which is damping over timeStep, or materialDamping (s)",
            }.OnlyWith(Takers.Pbd),
            new NumberEntry("deltaThreshold", "units", NumberRange.NotNegative,
                "ends the run in a steady state; pbd: prediction errors below it; a material: distance from rest and "
                + "any swing below it; 0: never"),
            new IntegerEntry("steadyStateHold", "steps", 1, 1_000_000_000,
                "number of successive prediction errors below deltaThreshold that make a steady state")
                { Methods = Takers.Pbd },
        });
    }
}
