using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The keys of group "drive": what moves the proximal end.</summary>
    internal static class DriveEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "drive", "what moves the proximal end", new ParameterEntry[]
        {
            new ChoiceEntry<Drive>("drive",
                "what moves sphere 0: one displacement, then held; a fixed axis each step; the first element's"
                + " direction each step; externalForce on a free sphere 0, with a material proximalEnd \"free\"",
                p => p.Simulation.Drive.Kind, (p, v) => p.Simulation.Drive.Kind = v),
            new SwitchEntry("SteadyState", "older word for drive: true is \"hold\", false \"displace\", each step by"
                + " displacement where displacementPerStep is not given",
                p => p.Simulation.Drive.Kind == Drive.Hold,
                (p, v) => p.Simulation.Drive.Kind = v ? Drive.Hold : Drive.Displace),
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
            new NumberEntry("insertionSpeed", "m/s", NumberRange.Any,
                "speed of sphere 0 with drive \"displace\" or \"push\", in place of displacementPerStep;"
                + " negative values pull", p => p.Simulation.Drive.InsertionSpeed,
                (p, v) => p.Simulation.Drive.InsertionSpeed = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("rotationSpeed", "rad/s", NumberRange.Any,
                "turning of the proximal clamp about its axis, in place of twistPerStep",
                p => p.Simulation.Drive.RotationSpeed, (p, v) => p.Simulation.Drive.RotationSpeed = v)
            {
                Methods = Takers.Material,
            },
            new TextEntry("driveFile", "CSV file of time (s), insertion (m) and rotation (rad) of the proximal clamp,"
                + " in place of the speeds: linear between the rows, at rest before and after; only differences count;"
                + " a name counts from the parameter file's folder", p => p.DriveFile, (p, v) => p.DriveFile = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("hubForceLimit", "N", NumberRange.NotNegative,
                "between walls: axial force at which the hub gives way, so that it pushes and pulls no harder; what is"
                + " lost of its way is driveShortfall; 0: it never gives way",
                p => p.Simulation.Drive.HubForceLimit, (p, v) => p.Simulation.Drive.HubForceLimit = v)
            {
                Methods = Takers.Only(Solver.Direct),
            },
            new VectorEntry("externalForce", "mass unit * unit/s^2", true,
                "force on sphere 0 with drive \"force\"",
                p => p.Simulation.Drive.ExternalForce, (p, v) => p.Simulation.Drive.ExternalForce = v)
            {
                MaterialUnit = "N",
            },
        });
    }
}
