using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>The keys of group "scene": what is simulated.</summary>
    internal static class SceneEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "scene", "what is simulated", p => p.Simulation.Scene, new ParameterEntry[]
        {
            new NumberEntry("guidewireLength", "units", NumberRange.Positive, "L"),
            new IntegerEntry("numberRodElements", "", 1, 1_000_000,
                "n; the wire has n + 1 spheres and elements of length L/n; if wireSections have numbers of "
                + "their own, n is that of the rest of the wire, distributed by length"),
            new NumberEntry("guidewireOffset", "units", NumberRange.Any, "z of sphere 0 before its displacement"),
            new NumberEntry("rodElementLength", "units", NumberRange.Positive,
                "no effect, from older files: the length of an element is guidewireLength / numberRodElements; a "
                    + "warning if it differs")
            {
                Getter = p => p.Simulation.Scene.GuidewireLength / p.Simulation.Scene.NumberRodElements,
                Setter = (p, v) => { },
            },
            new NumberEntry("metresPerUnit", "m", NumberRange.Positive, "length of one unit")
            {
                Methods = Takers.Material,
            },
            new TextEntry("startFile",
                "JSON file with positions, orientations, velocities and angularVelocities to start from; the"
                + " path is relative to the parameter file's folder"),
            new JsonEntry("start", JTokenType.Object,
                "null or {\"positions\", \"orientations\", \"velocities\", \"angularVelocities\", \"proximalFrame\","
                + " \"distalFrame\"}, all but the first optional", "what a startFile holds, in its place"),
            new ChoiceEntry<StartShape>("startShape", "shape of the wire at the start; the two ends of a ring coincide")
            {
                Methods = Takers.Material,
            },
            new NumberEntry("startRadius", "units", NumberRange.Positive, "radius of startShape \"helix\"")
            {
                Methods = Takers.Material,
            },
            new NumberEntry("startTurns", "", NumberRange.Any, "turns of startShape \"helix\"")
            {
                Methods = Takers.Material,
            },
            new ChoiceEntry<InitialState>("initialState",
                "start from the start shape, or from the rest shape under gravity, tip loads and supports; with"
                + " maxSimulationSteps 0 only the rest shape is computed") { Methods = Takers.Material },
            new ChoiceEntry<ProximalEnd>("proximalEnd", "held: position of sphere 0; clamped: its frame"
                + " too; free: neither; pbd takes \"held\" and \"clamped\""),
            new ChoiceEntry<DistalEnd>("distalEnd",
                "free: nothing held; clamped: position and frame held; sliding: frame held, free to slide along its"
                + " axis (direct only); held: position of the last sphere, a ball joint or pin (with a material)"),
            new NumberEntry("distalRotation", "rad", NumberRange.Any,
                "rotation of the distal clamp about its own axis, also by more than one turn"),
            new NumberEntry("distalDisplacement", "units", NumberRange.Any,
                "displacement of the distal clamp along its own axis"),
            new NumberEntry("distalRampTime", "s", NumberRange.NotNegative,
                "time over which distalRotation and distalDisplacement increase linearly; 0: applied at once"),
            new TextEntry("proximalMotionFile",
                "CSV file of time (s), displacement x, y, z (m) and rotation vector x, y, z (rad) of the proximal "
                + "end, in world axes and relative to its start, with a first row of zeros: linear between rows, at "
                + "rest after the last; time steps end at rows; needs drive \"hold\"; the path is relative to the"
                + " parameter file's folder").OnlyWith(Takers.Only(Solver.Direct)),
            new TextEntry("distalMotionFile",
                "the same for the distal end, instead of distalRotation and distalDisplacement; a sliding end "
                + "remains free along its initial axis").OnlyWith(Takers.Only(Solver.Direct)),
            new NumberEntry("axialForce", "N", NumberRange.Any, "pull on a sliding distal end along its axis")
            {
                Methods = Takers.Only(Solver.Direct),
            },
            new VectorEntry("gravity", "unit/s^2", true, "acceleration of every free sphere")
            {
                MaterialUnit = "m/s^2",
            },
            new VectorEntry("tipForce", "N", true, "force on the last sphere") { Methods = Takers.Material },
            new VectorEntry("distributedForce", "N/m", true, "force per length of the wire at rest")
            {
                Methods = Takers.Material,
            },
            new JsonEntry("pointLoads", JTokenType.Array, "null or a list of {\"at\" (units), \"force\" [x, y, z] (N)}",
                "forces of constant direction at points of the wire, each given by its arc length at rest from sphere "
                + "0; between two spheres a force is distributed by the lever rule").OnlyWith(Takers.Material),
            new JsonEntry("loadTables", JTokenType.Object,
                "null or {\"tipForce\": FILE, ..}, with any of gravity, tipForce, distributedForce, pointLoads,"
                + " axialForce, tipMoment, tipFollowerForce",
                "CSV files of time (s) and a factor (without unit) on that load, linear between rows, constant"
                + " before the first and after the last; two rows with the same time are a jump; time steps of direct"
                + " end at each row; paths are relative to the parameter file's folder").OnlyWith(Takers.Material),
            new NumberEntry("tipForceReleaseTime", "s", NumberRange.NotNegative, "time at which the tip force ends")
            {
                Methods = Takers.Material,
            },
            new VectorEntry("tipFollowerForce", "N", true,
                "follower force on the last sphere, in the axes of the tip, with which it rotates: [0, 0, -1] is a"
                + " thrust of 1 N along the tip's tangent; it has no potential, so the rest shape is found by "
                + "motion with drag").OnlyWith(Takers.Material),
            new VectorEntry("tipMoment", "N m", true,
                "follower couple at the tip, in the axes of the tip, with which it rotates")
                .OnlyWith(Takers.Only(Solver.Direct, Solver.Explicit)),
            new JsonEntry("vessel", JTokenType.Object,
                "null, {\"shape\": \"plane\", \"point\", \"normal\"}, {\"shape\":"
                + " \"tube\", \"knots\", \"radius\", \"openStart\", \"openEnd\", \"smooth\"} or {\"shape\": \"mesh\","
                + " \"file\", \"metresPerUnit\", \"openRims\", \"anatomy\"}",
                "the wall around the wire; smooth (false) rounds a tube's corners, so that contact forces of a "
                + "sliding wire do not oscillate from knot to knot; the path of a mesh is relative to the parameter"
                + " file's folder, openRims names a point near the middle of each open rim;"
                + " anatomy is the file of the mesh's ends and centreline that the command anatomy writes, which "
                + "names the rims too; each shape may have a \"frictionCoefficient\" (0)").OnlyWith(Takers.Walls),
            new JsonEntry("sheath", JTokenType.Object, "null or {\"exit\", \"direction\"}, each [x, y, z]",
                "a straight, frictionless guide around the proximal part of the wire, on the wire's initial axis:"
                + " of a single wire only the part beyond its exit (units) is simulated, the rest is an axial and a "
                + "torsional spring; catheters are in the sheath, too; the default exit is one element inside the "
                + "vessel's inlet, the default direction that of the wire;"
                + " needs a vessel, proximalEnd \"clamped\" and drive \"displace\"")
                .OnlyWith(Takers.Only(Solver.Direct)),
            new JsonEntry("catheters", JTokenType.Array, "null or a list of one or two {\"start\", \"length\","
                + " \"elements\", \"wireRadius\", \"lumenRadius\", ...}",
                "catheters over the wire, the outermost one first, on one shared centreline: start is the distance of "
                + "its hub ahead of the wire's (units, 0), length (units), elements (30), wireRadius and lumenRadius "
                + "its outer and inner radius (m), frictionCoefficient that of its outside with all walls (by default "
                + "that of each wall), lumenFriction that between all that is in it and its lumen along the axis "
                + "(0); the other keys are as for the wire: instrument, youngsModulus, shearModulus, density,"
                + " shearFactor, bendingStiffness, torsionalStiffness, axialStiffness, massPerLength, restCurvature,"
                + " wireSections, insertionSpeed, rotationSpeed, driveFile, hubForceLimit,"
                + " tipForce, distributedForce and pointLoads, which act on the catheter; needs"
                + " proximalEnd \"clamped\"").OnlyWith(Takers.Only(Solver.Direct)),
            new EndEntry("inlet",
                "end of the vessel at which the wire starts, straight along the centreline there, regardless of z;"
                + " guidewireOffset is then measured from that end, positive into the vessel; its default puts the tip"
                + " two radii of the end inside, at least one element out of the sheath, which ends one radius inside;"
                + " the drive moves along the same direction; a point is that of the nearest end; needs"
                + " vessel.anatomy").OnlyWith(Takers.Walls),
            new EndEntry("target",
                "end or branch of the vessel, or a point of its lumen: the summary says whether and when the tip "
                + "comes within a radius of it along the centreline (for a branch: a radius beyond its root); needs "
                + "inlet").OnlyWith(Takers.Walls),
            new AxesEntry("patientAxes",
                "where x, y and z of the scene point in the patient: left or right (L, R), anterior or posterior (A,"
                + " P), superior or inferior (S, I); empty: as vessel.anatomy says, or unknown; a C-arm turns about"
                + " them"),
            new JsonEntry("obstacles", JTokenType.Array, "null or a list of {\"shape\": \"sphere\", \"centre\","
                + " \"radius\"}, {\"shape\": \"capsule\", \"from\", \"to\", \"radius\"}, {\"shape\": \"box\","
                + " \"centre\", \"halfSize\", \"rotation\"}, {\"shape\": \"hull\", \"points\", \"radius\"},"
                + " {\"shape\": \"cylinder\", \"point\", \"axis\", \"radius\"}, {\"shape\": \"cone\", \"from\","
                + " \"to\", \"fromRadius\", \"toRadius\"}, {\"shape\": \"plane\", \"point\", \"normal\"}",
                "convex bodies in the wire's path (units, degrees): capsules and cones have spherical ends, cylinders "
                + "and planes are infinite, a plane's normal points to the wire; each may have a"
                + " \"frictionCoefficient\" (0)").OnlyWith(Takers.Walls),
            new VectorEntry("position", "units", true, "position of the vessel") { Methods = Takers.Walls },
            new VectorEntry("scale", "", false, "scale factors of the vessel") { Methods = Takers.Walls },
            new VectorEntry("rotation", "degrees", true, "Euler angles of the vessel, about z, then x, then y")
            {
                Methods = Takers.Walls,
            },
        });
    }
}
