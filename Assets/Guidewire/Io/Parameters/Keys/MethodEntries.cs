using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The keys of group "method": how it is simulated, and what ends the run.</summary>
    internal static class MethodEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "method", "how it is simulated, and what ends the run", new ParameterEntry[]
        {
            new ChoiceEntry<Solver>("solver",
                "the method: pbd (stiffness per iteration), or xpbd, direct and explicit (a material)",
                p => p.Simulation.Method.Solver, (p, v) => p.Simulation.Method.Solver = v),
            new NumberEntry("timeStep", "s", NumberRange.Positive, "dt",
                p => p.Simulation.Method.TimeStep, (p, v) => p.Simulation.Method.TimeStep = v),
            new IntegerEntry("maxSimulationSteps", "steps", 0, 1_000_000_000, "largest number of steps of the run",
                p => p.Simulation.Method.MaxSimulationSteps, (p, v) => p.Simulation.Method.MaxSimulationSteps = v),
            new IntegerEntry("constraintSolverSteps", "iterations per step", 0, 1_000_000,
                "m, Gauss-Seidel iterations, with xpbd of each substep; with pbd, more of them make a stiffer wire",
                p => p.Simulation.Method.ConstraintSolverSteps,
                (p, v) => p.Simulation.Method.ConstraintSolverSteps = v)
            {
                Methods = Takers.Only(Solver.Pbd, Solver.Xpbd),
            },
            new ChoiceEntry<Integrator>("integrator",
                "pbd: how positions are predicted; direct: esdirk3 for most motions, esdirk4 for smooth ones, trbdf2 "
                + "where steps are short anyway; bdf2 loses 0.2 % of a release and 0.1 % of a spin, implicitEuler "
                + "damps all but slow motions; with a stiff EA, rotations converge with order 2 to 2.5 in all of them",
                p => p.Simulation.Method.Integrator, (p, v) => p.Simulation.Method.Integrator = v)
            {
                OlderWords = new Dictionary<string, Integrator>
                {
                    ["sdirk2"] = Integrator.Trbdf2,
                    ["sdirk3"] = Integrator.Esdirk3,
                    ["sdirk4"] = Integrator.Esdirk4,
                },
                Methods = Takers.Only(Solver.Pbd, Solver.Direct),
            },
            new SwitchEntry("VerletIntegration", "older word for integrator: true is \"verlet\", false \"euler\"",
                p => p.Simulation.Method.Integrator == Integrator.Verlet,
                (p, v) => p.Simulation.Method.Integrator = v ? Integrator.Verlet : Integrator.Euler)
            {
                Methods = Takers.Pbd,
            },
            new ChoiceEntry<SweepOrder>("sweepOrder", "order of the elements within an iteration",
                p => p.Simulation.Method.SweepOrder, (p, v) => p.Simulation.Method.SweepOrder = v)
            {
                Methods = Takers.Pbd,
            },
            new IntegerEntry("substeps", "", 1, 100_000_000, "parts of a time step",
                p => p.Simulation.Method.Substeps, (p, v) => p.Simulation.Method.Substeps = v)
            {
                Methods = Takers.Only(Solver.Xpbd, Solver.Explicit),
            },
            new NumberEntry("solverTolerance", "rad, or displacement over L", NumberRange.PositiveUpTo(1e-2),
                "residual error allowed in a stage of the direct solver; also that of the force balance in a step, "
                + "relative to the largest force",
                p => p.Simulation.Method.SolverTolerance, (p, v) => p.Simulation.Method.SolverTolerance = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("timeStepError", "rad, or displacement over L", NumberRange.NotNegative,
                "tolerance of the step size control, for the error estimate of trbdf2, esdirk3 and esdirk4: steps are "
                + "subdivided within timeStep, down to 1/1024 of it; 0: no step size control",
                p => p.Simulation.Method.TimeStepError, (p, v) => p.Simulation.Method.TimeStepError = v)
            {
                Methods = Takers.Only(Solver.Direct),
            },
            new IntegerEntry("maxNewtonIterations", "", 1, 1_000_000,
                "iterations after which the direct solver gives up a stage; ten times as many for a rest shape",
                p => p.Simulation.Method.MaxNewtonIterations, (p, v) => p.Simulation.Method.MaxNewtonIterations = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("damping", "", NumberRange.Between(0.0, 1.0),
                "fraction of its velocity that a sphere loses per step; a material has massDamping and materialDamping",
                p => p.Simulation.Method.Damping, (p, v) => p.Simulation.Method.Damping = v)
            {
                Methods = Takers.Pbd,
                IsRefusedElsewhere = true,
                Instead = "massDamping (1/s), which is damping over timeStep, or materialDamping (s)",
            },
            new NumberEntry("deltaThreshold", "units", NumberRange.NotNegative,
                "ends the run in a steady state: with pbd, prediction errors below it; with a material, distance from"
                + " the rest shape and amplitude of any swing below it, whatever the timeStep; 0: never",
                p => p.Simulation.Method.DeltaThreshold, (p, v) => p.Simulation.Method.DeltaThreshold = v),
            new IntegerEntry("steadyStateHold", "steps", 1, 1_000_000_000,
                "how long the prediction errors must stay below deltaThreshold",
                p => p.Simulation.Method.SteadyStateHold, (p, v) => p.Simulation.Method.SteadyStateHold = v)
            {
                Methods = Takers.Pbd,
            },
        });
    }
}
