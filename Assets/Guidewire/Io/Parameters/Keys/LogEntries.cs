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
            new IntegerEntry("logEvery", "steps", 1, 1_000_000_000, "every k-th step is logged"),
            new ChoiceEntry<LoggedSpheres>("logSpheres", "which spheres are logged"),
            new ChoiceEntry<LogFormat>("logFormat",
                "format of the log: positions.json, or positions.npz with arrays of 64-bit or 32-bit numbers"),
            new SwitchEntry("logOrientations", "whether orientations are logged too"),
            new SwitchEntry("logStrains",
                "whether each log entry also has \"stress\": curvature, couple, strain and force along the wire, "
                + "angular velocities and energies")
            {
                Methods = Takers.Material,
            },
            new SwitchEntry("logHub",
                "whether each log entry also has \"hub\": insertion, turn, force, torque, direction of the tip, twist, "
                + "largest curvature")
            {
                Methods = Takers.Only(Solver.Direct),
            },
            new SwitchEntry("logContacts",
                "whether each log entry also has \"contact\": the walls' forces and the first sphere's reaction; xpbd "
                + "has them only between walls")
            {
                Getter = p => p.LogContacts,
                Setter = (p, v) => p.LogContacts = p.Simulation.Method.StatesReactions = v,
                Methods = Takers.All,
            },
            new TextEntry("logFilePath", "folder of the results, unless -out gives one")
            {
                IsOutputPath = true,
            },
        });
    }
}
