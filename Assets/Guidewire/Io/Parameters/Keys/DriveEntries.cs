using Guidewire.Core;

namespace Guidewire.Io
{
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
}
