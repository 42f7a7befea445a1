using System.Collections.Generic;
using System.Text;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Every key that a parameter file or the command line may hold, once.</summary>
    public static class ParameterTable
    {
        /// <summary>The key that decides which others count.</summary>
        internal const string SolverKey = "solver";

        /// <summary>What older files may hold and is no longer a key, and what counts in its place.</summary>
        internal static readonly IReadOnlyDictionary<string, string> Former = new Dictionary<string, string>
        {
            ["frictionSpeed"] = "contacts stick at any speed, elastically up to elasticSlip",
        };

        private static readonly Dictionary<string, ParameterEntry> ByKey = new Dictionary<string, ParameterEntry>();

        static ParameterTable()
        {
            var entries = new List<ParameterEntry>();
            foreach (ParameterGroup group in Groups)
            {
                entries.AddRange(group.Entries);
            }
            foreach (ParameterEntry entry in entries)
            {
                ByKey.Add(entry.Key, entry);
            }
            Entries = entries;
        }

        /// <summary>The groups in the order of the help text.</summary>
        public static IReadOnlyList<ParameterGroup> Groups { get; } = new[]
        {
            MethodEntries.Group, SceneEntries.Group, DriveEntries.Group, PbdEntries.Group, MaterialEntries.Group,
            ContactEntries.Group, LogEntries.Group,
        };

        /// <summary>All keys, group by group.</summary>
        public static IReadOnlyList<ParameterEntry> Entries { get; }

        /// <summary>Gives the entry of a key, or null.</summary>
        public static ParameterEntry? Find(string key) =>
            ByKey.TryGetValue(key, out ParameterEntry? entry) ? entry : null;

        /// <summary>The table as Markdown, a part for each group, as docs/parameters.md shows it.</summary>
        public static string ToMarkdown()
        {
            var text = new StringBuilder();
            foreach (ParameterGroup group in Groups)
            {
                text.Append(text.Length == 0 ? "" : "\n").Append("## ").Append(group.Name).Append(": ")
                    .Append(group.About).Append("\n\n| key | allowed | default | solver | meaning |\n")
                    .Append("|---|---|---|---|---|\n");
                foreach (ParameterEntry entry in group.Entries)
                {
                    text.Append("| `").Append(entry.Key).Append("` | ").Append(entry.Allowed).Append(" | `")
                        .Append(entry.Defaults).Append("` | ")
                        .Append(entry.Methods.Count == Takers.All.Count ? "all" : entry.MethodWords).Append(" | ")
                        .Append(entry.Help).Append(" |\n");
                }
            }
            return text.ToString();
        }
    }

    /// <summary>The keys of group "pbd": the wire of pbd, stiffness per iteration.</summary>
    internal static class PbdEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "pbd", "mass and stiffness per iteration of the wire", p => p.Simulation.Pbd, new ParameterEntry[]
        {
            Key.Number("totalMass", "mass units", NumberRange.Positive, "M, distributed evenly over the spheres"),
            Key.Number("stretchStiffness", "", NumberRange.NotNegative,
                "k_A, stiffness of the stretch constraint per iteration; unstable from 2 on"),
            Key.Number("bendStiffness", "units", NumberRange.NotNegative,
                "k_B, stiffness of the bend-twist constraint per iteration; unstable above L/n"),
        },
            Takers.Pbd);
    }

    /// <summary>The keys of group "log": what is written.</summary>
    internal static class LogEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "log", "what is written", p => p, new ParameterEntry[]
        {
            Key.Whole("logEvery", "steps", 1, 1_000_000_000, "every k-th step is logged"),
            Key.Choice<LoggedSpheres>("logSpheres", "which spheres are logged"),
            Key.Choice<LogFormat>("logFormat",
                "format of the log: positions.json, or positions.npz with arrays of 64-bit or 32-bit numbers"),
            Key.Switch("logOrientations", "whether orientations are logged too"),
            Key.Switch("logStrains",
                "whether each log entry also has \"stress\": curvature, couple, strain and force along the wire, "
                + "angular velocities and energies").With(Takers.Material),
            Key.Switch("logHub",
                "whether each log entry also has \"hub\": insertion, turn, force, torque, direction of the tip, twist, "
                + "largest curvature").With(Takers.Only(Solver.Direct)),
            Key.Switch("logContacts",
                "whether each log entry also has \"contact\": the walls' forces and the first sphere's reaction; xpbd "
                + "has them only between walls")
                .By(p => p.LogContacts, (p, v) => p.LogContacts = p.Simulation.Method.StatesReactions = v)
                .With(Takers.All),
            Key.Text("logFilePath", "folder of the results, unless -out gives one").AsOutputPath(),
        });
    }

    /// <summary>The keys of group "contact": how the wire touches walls.</summary>
    internal static class ContactEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "contact", "how the wire touches walls", p => p.Simulation.Contact, new ParameterEntry[]
        {
            Key.Number("sphereRadius", "units", NumberRange.Positive, "r").With(Takers.Pbd),
            Key.Number("contactDistance", "m", NumberRange.NotNegative,
                "gap between the wire's surface and a wall below which the contact force acts; 0: chosen from radius, "
                + "drive and clearance").With(Takers.Only(Solver.Direct)),
            Key.Number("contactStiffness", "N/m", NumberRange.NotNegative,
                "k; direct: the normal force at half the contactDistance is 1.19 k times it, 0: chosen; xpbd: k times "
                + "the penetration depth, 0: rigid").With(Takers.Only(Solver.Xpbd, Solver.Direct)),
            Key.Number("elasticSlip", "m", NumberRange.NotNegative,
                "elastic tangential displacement up to which a contact sticks; 0: a hundredth of the wire's radius")
                .With(Takers.Only(Solver.Direct)),
            Key.OptionalSwitch("selfContact", "whether the wire touches itself; null: where it has walls")
                .With(Takers.Only(Solver.Direct)),
            Key.Number("selfFriction", "", NumberRange.NotNegative, "friction coefficient of the wire on itself")
                .With(Takers.Only(Solver.Direct)),
            Key.Number("collisionMargin", "units", NumberRange.NotNegative, "gap kept beyond the radius")
                .With(Takers.Pbd),
            Key.Number("collisionStiffness", "", NumberRange.Fraction,
                "k_C, stiffness of the contact constraint per iteration").With(Takers.Pbd),
            Key.Choice<ElementContact>("elementContact",
                "contact of rod elements, in addition to spheres: with forces by the lever rule, none, or by "
                + "the thesis's rule", ("seed", "thesis")).With(Takers.Pbd),
        });
    }

    /// <summary>The keys of group "drive": what moves the proximal end.</summary>
    internal static class DriveEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "drive", "what moves the proximal end", p => p.Simulation.Drive, new ParameterEntry[]
        {
            Key.Choice<Drive>("drive",
                "hold: one displacement at the start; displace: each step along a fixed axis; push: along the first "
                + "element; force: externalForce on a free sphere 0").In(nameof(DriveParameters.Kind)),
            Key.Switch("SteadyState", "older name of drive: true is \"hold\", false is \"displace\", by"
                + " displacement each step where displacementPerStep is not given")
                .By(p => p.Simulation.Drive.Kind == Drive.Hold,
                    (p, v) => p.Simulation.Drive.Kind = v ? Drive.Hold : Drive.Displace),
            Key.Number("displacement", "units", NumberRange.Any,
                "displacement of sphere 0 at the start with drive \"hold\""),
            Key.Vector("displacementDirection", "", false, "direction of displacement, and of drive \"displace\""),
            Key.Number("displacementPerStep", "units per step", NumberRange.Any,
                "motion of sphere 0 with drive \"displace\" or \"push\""),
            Key.Number("twistPerStep", "radians per step", NumberRange.Any,
                "rotation of element 0 about its own axis, with a material of its clamp; with pbd a value other than 0 "
                + "fixes the frame"),
            Key.Number("insertionSpeed", "m/s", NumberRange.Any,
                "speed of sphere 0 with drive \"displace\" or \"push\", instead of displacementPerStep;"
                + " negative values pull").With(Takers.Material),
            Key.Number("rotationSpeed", "rad/s", NumberRange.Any,
                "rotation speed of the proximal clamp about its axis, instead of twistPerStep").With(Takers.Material),
            Key.Text("driveFile", "CSV file of time (s), insertion (m) and rotation (rad) of the proximal clamp, "
                + "instead of the speeds; only differences matter").With(Takers.Material),
            Key.NumberOr("hubForceLimit", "N", NumberRange.NotNegative, "hand",
                "between walls: the largest axial force with which the hub pushes or pulls; beyond it the hub slips; "
                + "\"hand\": 10 N, and no thrust under which 20 mm of the shaft, clamped, buckle; null or 0: it never "
                + "slips").With(Takers.Only(Solver.Direct)),
            Key.Number("slipSpeed", "m/s", NumberRange.NotNegative,
                "how fast a hub that slips goes at most; 0: as fast as it takes").With(Takers.Only(Solver.Direct)),
            Key.Vector("externalForce", "mass unit * unit/s^2", true,
                "force on sphere 0 with drive \"force\"").OfMaterial("N"),
        });
    }

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
