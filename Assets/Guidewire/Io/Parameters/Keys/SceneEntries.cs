using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>The keys of group "scene": what is simulated.</summary>
    internal static class SceneEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "scene", "what is simulated", new ParameterEntry[]
        {
            new NumberEntry("guidewireLength", "units", NumberRange.Positive, "L",
                p => p.Simulation.Scene.GuidewireLength, (p, v) => p.Simulation.Scene.GuidewireLength = v),
            new IntegerEntry("numberRodElements", "", 1, 1_000_000,
                "n; the wire has n + 1 spheres and elements of length L/n; where wireSections state a number of"
                + " their own, n is that of the rest of the wire, distributed by length",
                p => p.Simulation.Scene.NumberRodElements, (p, v) => p.Simulation.Scene.NumberRodElements = v),
            new NumberEntry("guidewireOffset", "units", NumberRange.Any, "z of sphere 0 before its displacement",
                p => p.Simulation.Scene.GuidewireOffset, (p, v) => p.Simulation.Scene.GuidewireOffset = v),
            new NumberEntry("rodElementLength", "units", NumberRange.Positive,
                "no effect, from older files: elements have guidewireLength / numberRodElements; a warning if it"
                + " differs",
                p => p.Simulation.Scene.GuidewireLength / p.Simulation.Scene.NumberRodElements, (p, v) => { }),
            new NumberEntry("metresPerUnit", "m", NumberRange.Positive, "length of one unit",
                p => p.Simulation.Scene.MetresPerUnit, (p, v) => p.Simulation.Scene.MetresPerUnit = v)
            {
                Methods = Takers.Material,
            },
            new TextEntry("startFile",
                "JSON file with positions, orientations, velocities and angularVelocities to start from; the"
                + " path is relative to the parameter file's folder",
                p => p.StartFile, (p, v) => p.StartFile = v),
            new ChoiceEntry<StartShape>("startShape", "shape of the wire at the start; the two ends of a ring coincide",
                p => p.Simulation.Scene.StartShape, (p, v) => p.Simulation.Scene.StartShape = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("startRadius", "units", NumberRange.Positive, "radius of startShape \"helix\"",
                p => p.Simulation.Scene.StartRadius, (p, v) => p.Simulation.Scene.StartRadius = v)
            {
                Methods = Takers.Material,
            },
            new NumberEntry("startTurns", "", NumberRange.Any, "turns of startShape \"helix\"",
                p => p.Simulation.Scene.StartTurns, (p, v) => p.Simulation.Scene.StartTurns = v)
            {
                Methods = Takers.Material,
            },
            new ChoiceEntry<InitialState>("initialState",
                "start from the start shape, or from the rest shape under gravity, tip loads and supports; with"
                + " maxSimulationSteps 0 only the rest shape is computed",
                p => p.Simulation.Scene.InitialState, (p, v) => p.Simulation.Scene.InitialState = v)
            {
                Methods = Takers.Material,
            },
            new ChoiceEntry<ProximalEnd>("proximalEnd", "held: position of sphere 0; clamped: its frame"
                + " too; free: neither; pbd takes \"held\" and \"clamped\"",
                p => p.Simulation.Scene.ProximalEnd, (p, v) => p.Simulation.Scene.ProximalEnd = v),
            new ChoiceEntry<DistalEnd>("distalEnd",
                "free: nothing held; clamped: position and frame held; sliding: frame held, free to slide along its"
                + " axis (direct only)",
                p => p.Simulation.Scene.DistalEnd, (p, v) => p.Simulation.Scene.DistalEnd = v),
            new NumberEntry("distalRotation", "rad", NumberRange.Any,
                "rotation of the distal clamp about its own axis, also by more than one turn",
                p => p.Simulation.Scene.DistalRotation, (p, v) => p.Simulation.Scene.DistalRotation = v),
            new NumberEntry("distalDisplacement", "units", NumberRange.Any,
                "displacement of the distal clamp along its own axis",
                p => p.Simulation.Scene.DistalDisplacement, (p, v) => p.Simulation.Scene.DistalDisplacement = v),
            new NumberEntry("distalRampTime", "s", NumberRange.NotNegative,
                "time over which distalRotation and distalDisplacement grow; 0: at once",
                p => p.Simulation.Scene.DistalRampTime, (p, v) => p.Simulation.Scene.DistalRampTime = v),
            new NumberEntry("axialForce", "N", NumberRange.Any, "pull on a sliding distal end along its axis",
                p => p.Simulation.Scene.AxialForce, (p, v) => p.Simulation.Scene.AxialForce = v)
            {
                Methods = Takers.Only(Solver.Direct),
            },
            new VectorEntry("gravity", "unit/s^2", true, "acceleration of every free sphere",
                p => p.Simulation.Scene.Gravity, (p, v) => p.Simulation.Scene.Gravity = v)
            {
                MaterialUnit = "m/s^2",
            },
            new VectorEntry("tipForce", "N", true, "force on the last sphere",
                p => p.Simulation.Scene.TipForce, (p, v) => p.Simulation.Scene.TipForce = v)
            {
                Methods = Takers.Material,
            },
            new VectorEntry("distributedForce", "N/m", true, "force per length of the wire at rest",
                p => p.Simulation.Scene.DistributedForce, (p, v) => p.Simulation.Scene.DistributedForce = v)
            {
                Methods = Takers.Material,
            },
            new JsonEntry("loadTables", JTokenType.Object,
                "null or {\"tipForce\": FILE, ..}, with any of gravity, tipForce, distributedForce, axialForce,"
                + " tipMoment, tipFollowerForce",
                "CSV files of time (s) and a factor (without unit) on that load, linear between rows, constant"
                + " before the first and after the last; two rows with the same time are a jump; time steps of direct"
                + " end at each row; paths are relative to the parameter file's folder",
                p => p.LoadTables, (p, v) => p.LoadTables = v)
            {
                Methods = Takers.Material,
                IsRefusedElsewhere = true,
            },
            new NumberEntry("tipForceReleaseTime", "s", NumberRange.NotNegative, "time at which the tip force ends",
                p => p.Simulation.Scene.TipForceReleaseTime, (p, v) => p.Simulation.Scene.TipForceReleaseTime = v)
            {
                Methods = Takers.Material,
            },
            new VectorEntry("tipFollowerForce", "N", true,
                "follower force on the last sphere, in the axes of the tip, with which it rotates: [0, 0, -1] is a"
                + " thrust of 1 N along the tip's tangent; it has no potential, so the rest shape is where a wire with"
                + " drag comes to rest",
                p => p.Simulation.Scene.TipFollowerForce, (p, v) => p.Simulation.Scene.TipFollowerForce = v)
            {
                Methods = Takers.Material,
                IsRefusedElsewhere = true,
            },
            new VectorEntry("tipMoment", "N m", true,
                "follower couple at the tip, in the axes of the tip, with which it rotates",
                p => p.Simulation.Scene.TipMoment, (p, v) => p.Simulation.Scene.TipMoment = v)
            {
                Methods = Takers.Only(Solver.Direct, Solver.Explicit),
                IsRefusedElsewhere = true,
            },
            new JsonEntry("vessel", JTokenType.Object,
                "null, {\"shape\": \"plane\", \"point\", \"normal\"}, {\"shape\":"
                + " \"tube\", \"knots\", \"radius\", \"openStart\", \"openEnd\", \"smooth\"} or {\"shape\": \"mesh\","
                + " \"file\", \"metresPerUnit\", \"openRims\", \"anatomy\"}",
                "the wall around the wire; smooth (false) rounds a tube's corners, so that contact forces of a"
                + " sliding wire do not ripple from knot to knot; the path of a mesh is relative to the parameter"
                + " file's folder, openRims names a point near the middle of each open rim;"
                + " anatomy is the file of the mesh's ends and"
                + " centreline that 'guidewire.py anatomy' writes, which names the rims"
                + " too; each shape may have a"
                + " \"frictionCoefficient\" (0)",
                p => p.Vessel, (p, v) => p.Vessel = v)
            {
                Methods = Takers.Walls,
                IsRefusedElsewhere = true,
            },
            new JsonEntry("sheath", JTokenType.Object, "null or {\"exit\", \"direction\"}, each [x, y, z]",
                "a straight, frictionless guide around the proximal part of the wire, on the wire's initial axis:"
                + " only what is beyond its exit (units) is simulated, the rest is an axial and a torsional spring; the"
                + " default exit is one element inside the vessel's inlet, the default direction that of the wire;"
                + " needs a vessel, proximalEnd \"clamped\" and drive \"displace\"",
                p => p.Sheath, (p, v) => p.Sheath = v)
            {
                Methods = Takers.Only(Solver.Direct),
                IsRefusedElsewhere = true,
            },
            new EndEntry("inlet",
                "end of the vessel at which the wire starts, straight along the centreline there, whatever z is;"
                + " guidewireOffset is then measured from that end, positive into the vessel; its default puts the tip"
                + " one element out of the sheath, which ends one radius inside; the drive moves along the same"
                + " direction; a point is that of the nearest end; needs vessel.anatomy",
                p => p.Inlet, (p, v) => p.Inlet = v)
            {
                Methods = Takers.Walls,
                IsRefusedElsewhere = true,
            },
            new EndEntry("target",
                "end or branch of the vessel, or a point of its lumen: the summary says whether and when the tip comes"
                + " within a radius of it along the centreline; of a branch: when it is a radius beyond its root; needs"
                + " inlet", p => p.Target, (p, v) => p.Target = v)
            {
                Methods = Takers.Walls,
                IsRefusedElsewhere = true,
            },
            new JsonEntry("obstacles", JTokenType.Array, "null or a list of {\"shape\": \"sphere\", \"centre\","
                + " \"radius\"}, {\"shape\": \"capsule\", \"from\", \"to\", \"radius\"}, {\"shape\": \"box\","
                + " \"centre\", \"halfSize\", \"rotation\"}, {\"shape\": \"hull\", \"points\", \"radius\"}",
                "convex bodies in the wire's path (units, degrees); each may have a \"frictionCoefficient\" (0)",
                p => p.Obstacles, (p, v) => p.Obstacles = v)
            {
                Methods = Takers.Walls,
                IsRefusedElsewhere = true,
            },
            new VectorEntry("position", "units", true, "position of the vessel",
                p => p.Position, (p, v) => p.Position = v)
            {
                Methods = Takers.Walls,
            },
            new VectorEntry("scale", "", false, "scale factors of the vessel",
                p => p.Scale, (p, v) => p.Scale = v)
            {
                Methods = Takers.Walls,
            },
            new VectorEntry("rotation", "degrees", true, "Euler angles of the vessel, about z, then x, then y",
                p => p.Rotation, (p, v) => p.Rotation = v)
            {
                Methods = Takers.Walls,
            },
        });
    }
}
