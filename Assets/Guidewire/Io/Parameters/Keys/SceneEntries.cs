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
            Key.Number("guidewireLength", "units", NumberRange.Positive, "L"),
            Key.Whole("numberRodElements", "", 1, 1_000_000,
                "n; the wire has n + 1 spheres and elements of length L/n; elements that wireSections state come on "
                + "top, n is the rest's"),
            Key.Number("guidewireOffset", "units", NumberRange.Any, "z of sphere 0 before its displacement"),
            Key.Number("rodElementLength", "units", NumberRange.Positive,
                "no effect, from older files: the length of an element is guidewireLength / numberRodElements; a "
                    + "warning if it differs")
                .By(p => p.Simulation.Scene.GuidewireLength / p.Simulation.Scene.NumberRodElements, (p, v) => { }),
            Key.Number("metresPerUnit", "m", NumberRange.Positive, "length of one unit").With(Takers.Material),
            Key.Text("startFile",
                "JSON file with positions, orientations, velocities and angularVelocities to start from; the"
                + " path is relative to the parameter file's folder"),
            Key.Json("start", JTokenType.Object,
                "null or {\"positions\", \"orientations\", \"velocities\", \"angularVelocities\", \"proximalFrame\","
                + " \"distalFrame\", \"hub\", \"catheters\"}, all but the first optional",
                "what a startFile holds, in its place"),
            Key.Choice<StartShape>("startShape", "shape of the wire at the start; the two ends of a ring coincide")
                .With(Takers.Material),
            Key.Number("startRadius", "units", NumberRange.Positive, "radius of startShape \"helix\"")
                .With(Takers.Material),
            Key.Number("startTurns", "", NumberRange.Any, "turns of startShape \"helix\"").With(Takers.Material),
            Key.Choice<InitialState>("initialState",
                "the start shape, or the rest shape under gravity, tip loads and supports; with maxSimulationSteps 0 "
                + "the rest shape is the result").With(Takers.Material),
            Key.Choice<ProximalEnd>("proximalEnd", "held: position of sphere 0; clamped: its frame"
                + " too; free: neither; pbd takes \"held\" and \"clamped\""),
            Key.Choice<DistalEnd>("distalEnd",
                "free; clamped: position and frame held; sliding: frame held, free along its axis (direct); held: "
                + "position held, a ball joint (a material)"),
            Key.Number("distalRotation", "rad", NumberRange.Any,
                "rotation of the distal clamp about its own axis, also by more than one turn"),
            Key.Number("distalDisplacement", "units", NumberRange.Any,
                "displacement of the distal clamp along its own axis"),
            Key.Number("distalRampTime", "s", NumberRange.NotNegative,
                "time over which distalRotation and distalDisplacement increase linearly; 0: applied at once"),
            Key.Text("proximalMotionFile",
                "CSV file of time (s), displacement x, y, z (m) and rotation vector x, y, z (rad) of the proximal end; "
                + "needs drive \"hold\"").OnlyWith(Takers.Only(Solver.Direct)),
            Key.Text("distalMotionFile",
                "the same for the distal end, instead of distalRotation and distalDisplacement; a sliding end remains "
                + "free along its axis").OnlyWith(Takers.Only(Solver.Direct)),
            Key.Number("axialForce", "N", NumberRange.Any, "pull on a sliding distal end along its axis")
                .With(Takers.Only(Solver.Direct)),
            Key.Vector("gravity", "unit/s^2", true, "acceleration of every free sphere").OfMaterial("m/s^2"),
            Key.Vector("tipForce", "N", true, "force on the last sphere").With(Takers.Material),
            Key.Vector("distributedForce", "N/m", true, "force per length of the wire at rest").With(Takers.Material),
            Key.Json("pointLoads", JTokenType.Array, "null or a list of {\"at\" (units), \"force\" [x, y, z] (N)}",
                "forces of constant direction at points of the wire, \"at\" from sphere 0 along the wire at rest")
                .OnlyWith(Takers.Material),
            Key.Json("loadTables", JTokenType.Object,
                "null or {\"tipForce\": FILE, ..}, with any of gravity, tipForce, distributedForce, pointLoads,"
                + " axialForce, tipMoment, tipFollowerForce",
                "CSV files of time (s) and a factor on that load, linear between rows; two rows of one time are a jump")
                .OnlyWith(Takers.Material),
            Key.Number("tipForceReleaseTime", "s", NumberRange.NotNegative, "time at which the tip force ends")
                .With(Takers.Material),
            Key.Vector("tipFollowerForce", "N", true,
                "force on the last sphere that turns with the tip, in its axes: [0, 0, -1] is a thrust of 1 N along "
                + "the tangent").OnlyWith(Takers.Material),
            Key.Vector("tipMoment", "N m", true,
                "follower couple at the tip, in the axes of the tip, with which it rotates")
                .OnlyWith(Takers.Only(Solver.Direct, Solver.Explicit)),
            Key.Json("vessel", JTokenType.Object,
                "null, {\"shape\": \"plane\", \"point\", \"normal\"}, {\"shape\":"
                + " \"tube\", \"knots\", \"radius\", \"openStart\", \"openEnd\", \"smooth\"} or {\"shape\": \"mesh\","
                + " \"file\", \"metresPerUnit\", \"openRims\", \"warp\", \"anatomy\"}",
                "the wall around the wire; smooth (false) rounds a tube's corners; openRims names a point near each "
                + "rim; warp, nine numbers from -1 to 1, moves the mesh by smooth waves;"
                + " wallStiffness makes it soft (docs/soft-walls.md), motion lets it move and beam lets it give way as "
                + "a whole (docs/moving-vessels.md)")
                .OnlyWith(Takers.Walls),
            Key.Json("sheath", JTokenType.Object, "null or {\"exit\", \"direction\"}, each [x, y, z]",
                "a straight, frictionless guide around the proximal part; needs a vessel, proximalEnd \"clamped\" and "
                + "drive \"displace\"")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Json("catheters", JTokenType.Array, "null or a list of one or two {\"start\", \"length\","
                + " \"elements\", \"wireRadius\", \"lumenRadius\", ...}",
                "catheters over the wire, the outermost first, on one shared centreline (docs/coaxial.md); needs "
                + "proximalEnd \"clamped\"").OnlyWith(Takers.Only(Solver.Direct)),
            Key.End("inlet",
                "end of the vessel at which the wire starts, along the centreline; guidewireOffset then counts from "
                + "it; a point means the nearest end; needs vessel.anatomy").OnlyWith(Takers.Walls),
            Key.End("target",
                "end, branch or point of the vessel: the summary says whether and when the tip came within its radius; "
                + "needs inlet").OnlyWith(Takers.Walls),
            Key.Axes("patientAxes",
                "where x, y and z point in the patient, such as \"LPS\" for left, posterior, superior; empty: as "
                + "vessel.anatomy says, or unknown"),
            Key.Of(Kinds.OptionalVector, "patientOrigin",
                "where the scene's origin lies in the generic patient that the page draws around the vessel: mm to the "
                + "left, the back and the head from the body's middle beside the eighth thoracic vertebra; null: no "
                + "patient is drawn, nor without patientAxes"),
            Key.Json("obstacles", JTokenType.Array, "null or a list of {\"shape\": \"sphere\", \"centre\","
                + " \"radius\"}, {\"shape\": \"capsule\", \"from\", \"to\", \"radius\"}, {\"shape\": \"box\","
                + " \"centre\", \"halfSize\", \"rotation\"}, {\"shape\": \"hull\", \"points\", \"radius\"},"
                + " {\"shape\": \"cylinder\", \"point\", \"axis\", \"radius\"}, {\"shape\": \"cone\", \"from\","
                + " \"to\", \"fromRadius\", \"toRadius\"}, {\"shape\": \"plane\", \"point\", \"normal\"}",
                "convex bodies in the wire's path (units, degrees); ends of capsules and cones are round, cylinders "
                + "infinite; a plane's normal points to the wire").OnlyWith(Takers.Walls),
            Key.Vector("position", "units", true, "position of the vessel").With(Takers.Walls),
            Key.Vector("scale", "", false, "scale factors of the vessel").With(Takers.Walls),
            Key.Vector("rotation", "degrees", true, "Euler angles of the vessel, about z, then x, then y")
                .With(Takers.Walls),
        });
    }
}
