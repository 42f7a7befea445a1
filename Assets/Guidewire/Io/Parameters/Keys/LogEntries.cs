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
                "whether each log entry also has \"stress\": curvature and twist (rad/m) and couple (N m) at the n + 1"
                + " joints, strain (shear, shear, stretch) and force (N) of the n elements, their angular velocities"
                + " (rad/s, own axes), and kinetic, elastic and potential energy (J); forces and couples are those "
                + "of the distal part on the proximal one, in world axes, from strains only, without damping")
            {
                Methods = Takers.Material,
            },
            new SwitchEntry("logHub",
                "whether each log entry also has \"hub\": insertion (m), turn (rad), force (N) and torque (N m)"
                + " of the hub, direction of the tip, twist from hub to tip (rad), largest curvature (1/m)")
            {
                Methods = Takers.Only(Solver.Direct),
            },
            new SwitchEntry("logContacts",
                "whether each log entry also has \"contact\": the walls' force on each sphere they touch, their"
                + " total, and the first sphere's reaction (mass unit * unit/s^2; with a material N, averaged over the"
                + " step); with direct also the normal force on each element and of each wall, and the largest pressure"
                + " (Pa); xpbd reports it only between walls")
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
