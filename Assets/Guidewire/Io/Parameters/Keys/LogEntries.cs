using Guidewire.Core;

namespace Guidewire.Io
{
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
}
