using System;
using System.Collections.Generic;
using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>What a run with a material asks of its parameters together. A run has gains or a material: what the
    /// user sets on the command line must belong to the one it has; what a scene's file holds of the other is passed
    /// over. The ends of the wire belong to both.</summary>
    internal static class MaterialRules
    {
        private static readonly string[] WallKeys = { "vessel", "obstacles" };
        private static readonly string[] EndKeys =
        {
            "proximalEnd", "distalEnd", "distalRotation", "distalDisplacement", "distalRampTime",
        };

        private static readonly string[] GainKeys = { "stretchStiffness", "bendStiffness", "totalMass" };

        /// <summary>Sets the defaults that depend on the solver, and checks what belongs together.</summary>
        /// <param name="values">The parameters; integrator and displacement may change where they were not
        /// given.</param>
        /// <param name="given">Key, value and source of all that was given.</param>
        public static void Apply(RunParameters values, Dictionary<string, (JToken Value, string Source)> given)
        {
            SimulationParameters simulation = values.Simulation;
            bool gains = simulation.Method.Solver == Solver.Pbd;
            foreach (ParameterEntry entry in MaterialEntries.Material)
            {
                if (gains && Array.IndexOf(EndKeys, entry.Key) < 0)
                {
                    Forbid(given, entry.Key, "solver xpbd, direct or explicit: pbd takes gains, not a material");
                }
            }
            if (!gains)
            {
                foreach (string key in GainKeys)
                {
                    Forbid(given, key, "solver pbd: this run has a material, not gains");
                }
                if (!given.ContainsKey("displacement"))
                {
                    simulation.Drive.Displacement = 0.0;
                }
                if (!given.ContainsKey("constraintSolverSteps"))
                {
                    simulation.Method.ConstraintSolverSteps = 1;
                }
            }
            ChooseIntegrator(simulation, given);
            if (gains)
            {
                CheckEndsWithGains(simulation.Scene, given);
            }
            else
            {
                CheckTogether(simulation, given);
            }
        }

        private static void ChooseIntegrator(SimulationParameters simulation,
            Dictionary<string, (JToken Value, string Source)> given)
        {
            bool direct = simulation.Method.Solver == Solver.Direct;
            bool implicitScheme = simulation.Method.Integrator >= Integrator.ImplicitEuler;
            if (direct == implicitScheme || simulation.Method.Solver == Solver.Xpbd
                || simulation.Method.Solver == Solver.Explicit)
            {
                return;
            }
            if (given.TryGetValue("integrator", out var integrator))
            {
                throw new ParameterException(integrator.Source, "integrator",
                    integrator.Value.ToString(Formatting.None), direct
                    ? "one of \"implicitEuler\", \"bdf2\", \"sdirk2\", \"sdirk3\", \"sdirk4\" with solver \"direct\""
                    : "one of \"verlet\", \"euler\", \"orientationVerlet\", \"eulerOrientationVerlet\""
                    + " with solver \"pbd\"");
            }
            simulation.Method.Integrator = Integrator.Sdirk3;
        }

        private static void CheckTogether(SimulationParameters simulation,
            Dictionary<string, (JToken Value, string Source)> given)
        {
            bool freeStart = simulation.Drive.Kind == Drive.Force || simulation.Scene.ProximalEnd == ProximalEnd.Free;
            bool clamped = simulation.Scene.ProximalEnd == ProximalEnd.Clamped && !freeStart;
            foreach (string key in WallKeys)
            {
                if (given.TryGetValue(key, out var wall) && wall.Value.HasValues)
                {
                    throw new ParameterException(wall.Source, key, wall.Value.ToString(Formatting.None),
                        "solver pbd: a wire with a material meets no walls");
                }
            }
            if (simulation.Drive.TwistPerStep != 0.0 && !clamped)
            {
                Refuse(given, "twistPerStep", "proximalEnd \"clamped\" in a run with a material");
            }
            if (simulation.Scene.InitialState == InitialState.Equilibrium && !clamped
                && simulation.Scene.DistalEnd == DistalEnd.Free)
            {
                Refuse(given, "initialState", "a clamped end: a wire that turns freely has no single rest shape");
            }
            if (simulation.Method.Solver == Solver.Xpbd && simulation.Scene.TipMoment != Vector3d.Zero)
            {
                Refuse(given, "tipMoment", "solver direct or explicit: xpbd has no couples");
            }
            if (simulation.Method.Solver != Solver.Direct && simulation.Scene.DistalEnd == DistalEnd.Sliding)
            {
                Refuse(given, "distalEnd", "solver direct: the others cannot slide");
            }
            if (simulation.Method.Solver != Solver.Direct)
            {
                CheckTurn(simulation.Scene, given);
            }
            if (simulation.Method.Solver == Solver.Xpbd && simulation.Material.BendLaw == BendLaw.Darboux)
            {
                Refuse(given, "bendLaw", "solver direct or explicit: xpbd has the rotation vector only");
            }
            if (simulation.Scene.StartShape == StartShape.Helix && 2.0 * Math.PI * Math.Abs(simulation.Scene.StartTurns)
                * simulation.Scene.StartRadius >= simulation.Scene.GuidewireLength)
            {
                Refuse(given, "startTurns",
                    "a helix shorter than guidewireLength: 2 pi startTurns startRadius is more");
            }
            if (simulation.Drive.Kind == Drive.Hold || simulation.Drive.Kind == Drive.Force)
            {
                return;
            }
            if (freeStart)
            {
                Refuse(given, "proximalEnd", "\"held\" or \"clamped\" with a drive that moves sphere 0");
            }
        }

        private static void CheckEndsWithGains(SceneParameters scene,
            Dictionary<string, (JToken Value, string Source)> given)
        {
            if (scene.ProximalEnd == ProximalEnd.Free)
            {
                Refuse(given, "proximalEnd",
                    "\"held\" or \"clamped\" with solver pbd; drive \"force\" frees sphere 0");
            }
            if (scene.DistalEnd == DistalEnd.Sliding)
            {
                Refuse(given, "distalEnd", "\"free\" or \"clamped\" with solver pbd; sliding takes solver direct");
            }
            CheckTurn(scene, given);
        }

        // The last joint sees a turn at once as one by less than half a turn, and the shorter way round.
        private static void CheckTurn(SceneParameters scene,
            Dictionary<string, (JToken Value, string Source)> given)
        {
            if (scene.DistalEnd == DistalEnd.Clamped && Math.Abs(scene.DistalRotation) > 1.0
                && scene.DistalRampTime == 0.0)
            {
                Refuse(given, "distalRotation",
                    "solver direct, or a distalRampTime > 0: turned at once by more than 1 rad");
            }
        }

        private static void Forbid(Dictionary<string, (JToken Value, string Source)> given, string key, string needed)
        {
            if (given.TryGetValue(key, out var value) && value.Source == CommandLineHandler.Source)
            {
                throw new ParameterException(value.Source, key, value.Value.ToString(Formatting.None), needed);
            }
        }

        private static void Refuse(Dictionary<string, (JToken Value, string Source)> given, string key, string needed)
        {
            if (given.TryGetValue(key, out var value))
            {
                throw new ParameterException(value.Source, key, value.Value.ToString(Formatting.None), needed);
            }
            throw new ParameterException("defaults: " + key + " needs " + needed);
        }
    }
}
