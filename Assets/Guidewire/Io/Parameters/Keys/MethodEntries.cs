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
            Key.Choice<Solver>("solver",
                "the method: pbd (stiffness per iteration), or xpbd, direct and explicit (a material)"),
            Key.Number("timeStep", "s", NumberRange.Positive, "dt"),
            Key.Whole("maxSimulationSteps", "steps", 0, 1_000_000_000, "largest number of steps of the run"),
            Key.OptionalNumber("duration", "s", NumberRange.NotNegative,
                "simulated time of the run, instead of maxSimulationSteps, which is then derived from it; the "
                + "last step may end later"),
            Key.Whole("constraintSolverSteps", "iterations per step", 0, 1_000_000,
                "m, Gauss-Seidel iterations per step, with xpbd per substep; with pbd, more iterations make a "
                    + "stiffer wire").With(Takers.Only(Solver.Pbd, Solver.Xpbd)),
            Key.Choice<Integrator>("integrator",
                "pbd: how positions are predicted; direct: esdirk3 for most motions, esdirk4 for smooth ones, trbdf2 "
                + "for short steps; bdf2 and implicitEuler damp more",
                ("sdirk2", "trbdf2"), ("sdirk3", "esdirk3"), ("sdirk4", "esdirk4"))
                .With(Takers.Only(Solver.Pbd, Solver.Direct)),
            Key.Switch("VerletIntegration", "older name of integrator: true is \"verlet\", false \"euler\"")
                .By(p => p.Simulation.Method.Integrator == Integrator.Verlet,
                    (p, v) => p.Simulation.Method.Integrator = v ? Integrator.Verlet : Integrator.Euler)
                .With(Takers.Pbd),
            Key.Choice<SweepOrder>("sweepOrder", "order of the elements within an iteration").With(Takers.Pbd),
            Key.Whole("substeps", "", 1, 100_000_000, "parts of a time step")
                .With(Takers.Only(Solver.Xpbd, Solver.Explicit)),
            Key.Number("solverTolerance", "rad, or displacement over L", NumberRange.PositiveUpTo(1e-2),
                "residual error allowed in a stage of direct, and in a step's force balance over the largest force; "
                + "forces between walls need 1e-5").With(Takers.Material),
            Key.Number("timeStepError", "rad, or displacement over L", NumberRange.NotNegative,
                "tolerance of the step size control with trbdf2, esdirk3 and esdirk4, which subdivides steps, down to "
                + "1/1024 of timeStep; 0: no control").With(Takers.Only(Solver.Direct)),
            Key.Whole("maxNewtonIterations", "", 1, 1_000_000,
                "iterations after which the direct solver gives up a stage; ten times as many for a rest shape")
                .With(Takers.Material),
            Key.Number("damping", "", NumberRange.Fraction,
                "fraction of its velocity that a sphere loses per step; a material has massDamping and materialDamping")
                .Replacing("massDamping (1/s), which is damping over timeStep, or materialDamping (s)")
                .OnlyWith(Takers.Pbd),
            Key.Number("deltaThreshold", "units", NumberRange.NotNegative,
                "ends the run in a steady state; pbd: prediction errors below it; a material: distance from rest and "
                + "any swing below it; 0: never"),
            Key.Whole("steadyStateHold", "steps", 1, 1_000_000_000,
                "number of successive prediction errors below deltaThreshold that make a steady state")
                .With(Takers.Pbd),
        });
    }
}
