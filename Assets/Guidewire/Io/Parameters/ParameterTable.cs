using System;
using System.Collections.Generic;
using System.Text;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Every key that a parameter file or the command line may hold, once.</summary>
    public static class ParameterTable
    {
        private const int MostElements = 1_000_000;
        private const int MostSteps = 1_000_000_000;

        private static readonly Dictionary<string, ParameterEntry> ByKey = new Dictionary<string, ParameterEntry>();

        static ParameterTable()
        {
            foreach (ParameterEntry entry in Entries)
            {
                ByKey.Add(entry.Key, entry);
            }
        }

        /// <summary>The keys in the order of the help text.</summary>
        public static IReadOnlyList<ParameterEntry> Entries { get; } = Join(new ParameterEntry[]
        {
            MaterialEntries.Solver,
            new IntegerEntry("constraintSolverSteps", "iterations a step", 0, 1_000_000,
                "m, Gauss-Seidel iterations; with gains, more of them make a stiffer wire; with xpbd 1 a substep if"
                + " not given",
                p => p.Simulation.Method.ConstraintSolverSteps,
                (p, v) => p.Simulation.Method.ConstraintSolverSteps = v),
            new NumberEntry("timeStep", "s", NumberRange.Positive, "dt",
                p => p.Simulation.Method.TimeStep, (p, v) => p.Simulation.Method.TimeStep = v),
            new NumberEntry("guidewireLength", "units", NumberRange.Positive, "L",
                p => p.Simulation.Scene.GuidewireLength, (p, v) => p.Simulation.Scene.GuidewireLength = v),
            new IntegerEntry("numberRodElements", "", 1, MostElements,
                "n; the wire has n + 1 spheres and elements of L/n",
                p => p.Simulation.Scene.NumberRodElements, (p, v) => p.Simulation.Scene.NumberRodElements = v),
            new NumberEntry("totalMass", "mass units", NumberRange.Positive, "M, shared evenly by the spheres",
                p => p.Simulation.Gains.TotalMass, (p, v) => p.Simulation.Gains.TotalMass = v),
            new NumberEntry("guidewireOffset", "units", NumberRange.Any, "z of sphere 0 before its displacement",
                p => p.Simulation.Scene.GuidewireOffset, (p, v) => p.Simulation.Scene.GuidewireOffset = v),
            new NumberEntry("stretchStiffness", "", NumberRange.NotNegative,
                "k_A, gain of the stretch constraint an iteration; 2 and more break down",
                p => p.Simulation.Gains.StretchStiffness, (p, v) => p.Simulation.Gains.StretchStiffness = v),
            new NumberEntry("bendStiffness", "units", NumberRange.NotNegative,
                "k_B, gain of the bend-twist constraint an iteration; more than L/n breaks down",
                p => p.Simulation.Gains.BendStiffness, (p, v) => p.Simulation.Gains.BendStiffness = v),
            new NumberEntry("sphereRadius", "units", NumberRange.Positive, "r",
                p => p.Simulation.Contact.SphereRadius, (p, v) => p.Simulation.Contact.SphereRadius = v),
            new NumberEntry("collisionMargin", "units", NumberRange.NotNegative, "distance kept beyond the radius",
                p => p.Simulation.Contact.CollisionMargin, (p, v) => p.Simulation.Contact.CollisionMargin = v),
            new NumberEntry("collisionStiffness", "", NumberRange.Between(0.0, 1.0),
                "k_C, gain of a contact an iteration",
                p => p.Simulation.Contact.CollisionStiffness, (p, v) => p.Simulation.Contact.CollisionStiffness = v),
            new ChoiceEntry<Drive>("drive",
                "what moves sphere 0: one displacement, then held; a fixed axis each step; the first element's"
                + " direction each step; externalForce", p => p.Simulation.Drive.Kind,
                (p, v) => p.Simulation.Drive.Kind = v),
            new NumberEntry("displacement", "units", NumberRange.Any,
                "displacement of sphere 0 at the start, drive \"hold\"",
                p => p.Simulation.Drive.Displacement, (p, v) => p.Simulation.Drive.Displacement = v),
            new VectorEntry("displacementDirection", "", false, "its direction, and that of drive \"displace\"",
                p => p.Simulation.Drive.DisplacementDirection, (p, v) => p.Simulation.Drive.DisplacementDirection = v),
            new NumberEntry("displacementPerStep", "units a step", NumberRange.Any,
                "motion of sphere 0 with drive \"displace\" or \"push\"",
                p => p.Simulation.Drive.DisplacementPerStep, (p, v) => p.Simulation.Drive.DisplacementPerStep = v),
            new NumberEntry("twistPerStep", "radians a step", NumberRange.Any,
                "turn of element 0 about its own axis, with a material of its clamp; with gains, where it is not 0 the"
                + " element's frame is held",
                p => p.Simulation.Drive.TwistPerStep, (p, v) => p.Simulation.Drive.TwistPerStep = v),
            new VectorEntry("externalForce", "mass unit * unit/s^2; with a material N", true,
                "force on sphere 0 with drive \"force\"",
                p => p.Simulation.Drive.ExternalForce, (p, v) => p.Simulation.Drive.ExternalForce = v),
            new VectorEntry("gravity", "unit/s^2; with a material m/s^2", true, "acceleration of every free sphere",
                p => p.Simulation.Scene.Gravity, (p, v) => p.Simulation.Scene.Gravity = v),
            new NumberEntry("damping", "", NumberRange.Between(0.0, 1.0),
                "share of its velocity that a sphere loses a step",
                p => p.Simulation.Method.Damping, (p, v) => p.Simulation.Method.Damping = v),
            new ChoiceEntry<Integrator>("integrator", "how positions are predicted",
                p => p.Simulation.Method.Integrator, (p, v) => p.Simulation.Method.Integrator = v),
            new ChoiceEntry<SweepOrder>("sweepOrder", "order of one sweep over the elements",
                p => p.Simulation.Method.SweepOrder, (p, v) => p.Simulation.Method.SweepOrder = v),
            new NumberEntry("deltaThreshold", "units", NumberRange.NotNegative,
                "prediction errors below it make a steady state, which ends the run; 0 never does",
                p => p.Simulation.Method.DeltaThreshold, (p, v) => p.Simulation.Method.DeltaThreshold = v),
            new IntegerEntry("steadyStateHold", "steps", 1, MostSteps, "how long a steady state must last",
                p => p.Simulation.Method.SteadyStateHold, (p, v) => p.Simulation.Method.SteadyStateHold = v),
            new IntegerEntry("maxSimulationSteps", "steps", 0, MostSteps, "where the run ends at the latest",
                p => p.Simulation.Method.MaxSimulationSteps, (p, v) => p.Simulation.Method.MaxSimulationSteps = v),
            new ChoiceEntry<ElementContact>("elementContact",
                "what touches a wall besides the spheres: rod elements by the"
                + " lever rule, nothing, or rod elements by the rule as published",
                p => p.Simulation.Contact.ElementContact, (p, v) => p.Simulation.Contact.ElementContact = v),
            new JsonEntry("vessel", JTokenType.Object,
                "null, {\"shape\": \"plane\", \"point\", \"normal\"}, {\"shape\":"
                + " \"tube\", \"knots\", \"radius\", \"openStart\", \"openEnd\"} or {\"shape\": \"mesh\", \"file\","
                + " \"metresPerUnit\", \"openRims\"}",
                "the wall around the wire; a mesh file's name counts from the parameter"
                + " file's folder, openRims names a point near the middle of each open rim",
                p => p.Vessel, (p, v) => p.Vessel = v),
            new JsonEntry("obstacles", JTokenType.Array, "null or a list of {\"shape\": \"sphere\", \"centre\","
                + " \"radius\"}, {\"shape\": \"capsule\", \"from\", \"to\", \"radius\"}, {\"shape\": \"box\","
                + " \"centre\", \"halfSize\", \"rotation\"}, {\"shape\": \"hull\", \"points\", \"radius\"}",
                "convex bodies in the wire's way (units, degrees)", p => p.Obstacles, (p, v) => p.Obstacles = v),
            new VectorEntry("position", "units", true, "where the vessel lies",
                p => p.Position, (p, v) => p.Position = v),
            new VectorEntry("scale", "", false, "factors on the vessel's size",
                p => p.Scale, (p, v) => p.Scale = v),
            new VectorEntry("rotation", "degrees", true, "the vessel's Euler angles, about z, then x, then y",
                p => p.Rotation, (p, v) => p.Rotation = v),
            new TextEntry("startFile",
                "JSON file with positions, orientations, velocities and angularVelocities to start from",
                p => p.StartFile, (p, v) => p.StartFile = v),
            new IntegerEntry("logEvery", "steps", 1, MostSteps, "every k-th step is logged",
                p => p.LogEvery, (p, v) => p.LogEvery = v),
            new ChoiceEntry<LoggedSpheres>("logSpheres", "which spheres are logged",
                p => p.LogSpheres, (p, v) => p.LogSpheres = v),
            new SwitchEntry("logOrientations", "whether orientations are logged too",
                p => p.LogOrientations, (p, v) => p.LogOrientations = v),
            new SwitchEntry("logContacts",
                "whether each entry of the log also has \"contact\": the walls' force on each sphere"
                + " they touch, their total, and the first sphere's reaction (mass unit * unit/s^2; with a material N,"
                + " its mean over the step, direct and explicit only)",
                p => p.LogContacts, (p, v) => p.LogContacts = p.Simulation.Method.StatesReactions = v),
            new TextEntry("logFilePath", "folder of the results, where -out does not name one",
                p => p.LogFilePath, (p, v) => p.LogFilePath = v) { IsOutputPath = true },
            new NumberEntry("rodElementLength", "units", NumberRange.Positive,
                "in older files; guidewireLength / numberRodElements counts, and a warning says where they differ",
                p => p.Simulation.Scene.GuidewireLength / p.Simulation.Scene.NumberRodElements, (p, v) => { }),
            new SwitchEntry("VerletIntegration", "older word for integrator: true is \"verlet\", false \"euler\"",
                p => p.Simulation.Method.Integrator == Integrator.Verlet,
                (p, v) => p.Simulation.Method.Integrator = v ? Integrator.Verlet : Integrator.Euler),
            new SwitchEntry("SteadyState", "older word for drive: true is \"hold\", false \"displace\", each step by"
                + " displacement where displacementPerStep is not given",
                p => p.Simulation.Drive.Kind == Drive.Hold,
                (p, v) => p.Simulation.Drive.Kind = v ? Drive.Hold : Drive.Displace),
        }, MaterialEntries.Material);

        private static ParameterEntry[] Join(IReadOnlyList<ParameterEntry> first, IReadOnlyList<ParameterEntry> second)
        {
            var all = new List<ParameterEntry>(first);
            all.AddRange(second);
            return all.ToArray();
        }

        /// <summary>The entry of a key, or null.</summary>
        public static ParameterEntry? Find(string key)
        {
            return ByKey.TryGetValue(key, out ParameterEntry? entry) ? entry : null;
        }

        /// <summary>The key that a misspelt one most likely meant, or null where none is near.</summary>
        public static string? Nearest(string key)
        {
            string? best = null;
            int bestDistance = 1 + Math.Max(2, key.Length / 3);
            foreach (ParameterEntry entry in Entries)
            {
                int distance = Spelling.Distance(key.ToUpperInvariant(), entry.Key.ToUpperInvariant());
                if (distance < bestDistance)
                {
                    best = entry.Key;
                    bestDistance = distance;
                }
            }
            return best;
        }

        /// <summary>The table as Markdown, as the README shows it.</summary>
        public static string ToMarkdown()
        {
            var text = new StringBuilder("| key | allowed | default | meaning |\n|---|---|---|---|\n");
            foreach (ParameterEntry entry in Entries)
            {
                text.Append("| `").Append(entry.Key).Append("` | ").Append(entry.Allowed).Append(" | `")
                    .Append(entry.Default).Append("` | ").Append(entry.Help).Append(" |\n");
            }
            return text.ToString();
        }
    }
}
