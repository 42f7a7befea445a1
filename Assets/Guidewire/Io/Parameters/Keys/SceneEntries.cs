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
                "n; the wire has n + 1 spheres and elements of L/n; where wireSections have a number of their own, that"
                + " of the rest of the wire, shared out by length",
                p => p.Simulation.Scene.NumberRodElements, (p, v) => p.Simulation.Scene.NumberRodElements = v),
            new NumberEntry("guidewireOffset", "units", NumberRange.Any, "z of sphere 0 before its displacement",
                p => p.Simulation.Scene.GuidewireOffset, (p, v) => p.Simulation.Scene.GuidewireOffset = v),
            new NumberEntry("rodElementLength", "units", NumberRange.Positive,
                "in older files; guidewireLength / numberRodElements counts, and a warning says where they differ",
                p => p.Simulation.Scene.GuidewireLength / p.Simulation.Scene.NumberRodElements, (p, v) => { }),
            new NumberEntry("metresPerUnit", "m", NumberRange.Positive, "length of one unit",
                p => p.Simulation.Scene.MetresPerUnit, (p, v) => p.Simulation.Scene.MetresPerUnit = v)
            {
                Methods = Takers.Material,
            },
            new TextEntry("startFile",
                "JSON file with positions, orientations, velocities and angularVelocities to start from; its name"
                + " counts from the parameter file's folder",
                p => p.StartFile, (p, v) => p.StartFile = v),
            new ChoiceEntry<StartShape>("startShape", "the shape to set out from; a ring has both ends in one place",
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
                "start in the start shape, or in the rest shape under gravity, tip loads and supports; with"
                + " maxSimulationSteps 0 the rest shape is all that is computed",
                p => p.Simulation.Scene.InitialState, (p, v) => p.Simulation.Scene.InitialState = v)
            {
                Methods = Takers.Material,
            },
            new ChoiceEntry<ProximalEnd>("proximalEnd", "sphere 0 held, also its frame clamped, or"
                + " nothing held; with gains \"held\" or \"clamped\"",
                p => p.Simulation.Scene.ProximalEnd, (p, v) => p.Simulation.Scene.ProximalEnd = v),
            new ChoiceEntry<DistalEnd>("distalEnd",
                "nothing held; place and frame held; frame held and free to slide along the frame's axis (direct"
                + " only)",
                p => p.Simulation.Scene.DistalEnd, (p, v) => p.Simulation.Scene.DistalEnd = v),
            new NumberEntry("distalRotation", "rad", NumberRange.Any,
                "turn of the distal clamp about its own axis; more than one turn counts",
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
                "CSV files of time (s) and a factor (without unit) on that load, linear between the rows, the first and"
                + " last value before and after them; two rows of one time are a jump; steps of direct end at each row;"
                + " a name counts from the parameter file's folder",
                p => p.LoadTables, (p, v) => p.LoadTables = v)
            {
                Methods = Takers.Material,
                IsRefusedElsewhere = true,
            },
            new NumberEntry("tipForceReleaseTime", "s", NumberRange.NotNegative, "when the tip force ends",
                p => p.Simulation.Scene.TipForceReleaseTime, (p, v) => p.Simulation.Scene.TipForceReleaseTime = v)
            {
                Methods = Takers.Material,
            },
            new VectorEntry("tipFollowerForce", "N", true,
                "force on the last sphere along the axes of the wire's end, with which it turns: [0, 0, -1] is a thrust"
                + " of 1 N along the tip's tangent; it has no potential, so a rest shape is where a wire with drag"
                + " comes to rest",
                p => p.Simulation.Scene.TipFollowerForce, (p, v) => p.Simulation.Scene.TipFollowerForce = v)
            {
                Methods = Takers.Material,
                IsRefusedElsewhere = true,
            },
            new VectorEntry("tipMoment", "N m", true,
                "couple at the wire's end along the axes there, with which it turns",
                p => p.Simulation.Scene.TipMoment, (p, v) => p.Simulation.Scene.TipMoment = v)
            {
                Methods = Takers.Only(Solver.Direct, Solver.Explicit),
                IsRefusedElsewhere = true,
            },
            new JsonEntry("vessel", JTokenType.Object,
                "null, {\"shape\": \"plane\", \"point\", \"normal\"}, {\"shape\":"
                + " \"tube\", \"knots\", \"radius\", \"openStart\", \"openEnd\", \"smooth\"} or {\"shape\": \"mesh\","
                + " \"file\", \"metresPerUnit\", \"openRims\"}",
                "the wall around the wire; smooth (false) rounds a tube's corners: forces of a wire that slides"
                + " along them do not ripple with its knots; a mesh file's name counts from the parameter"
                + " file's folder, openRims names a point near the middle of each open rim; any may have a"
                + " \"frictionCoefficient\" (0)",
                p => p.Vessel, (p, v) => p.Vessel = v)
            {
                Methods = Takers.Walls,
                IsRefusedElsewhere = true,
            },
            new JsonEntry("sheath", JTokenType.Object, "null or {\"exit\", \"direction\"}, each [x, y, z]",
                "a straight guide without friction around the wire's proximal part, on the axis on which it starts:"
                + " only what is beyond its exit (units) is simulated, the rest is a spring along and about the axis;"
                + " without an exit it ends one element inside the vessel's inlet, without a direction it leads along"
                + " the wire; needs a vessel, proximalEnd \"clamped\" and drive \"displace\"",
                p => p.Sheath, (p, v) => p.Sheath = v)
            {
                Methods = Takers.Only(Solver.Direct),
                IsRefusedElsewhere = true,
            },
            new JsonEntry("obstacles", JTokenType.Array, "null or a list of {\"shape\": \"sphere\", \"centre\","
                + " \"radius\"}, {\"shape\": \"capsule\", \"from\", \"to\", \"radius\"}, {\"shape\": \"box\","
                + " \"centre\", \"halfSize\", \"rotation\"}, {\"shape\": \"hull\", \"points\", \"radius\"}",
                "convex bodies in the wire's way (units, degrees); each may have a \"frictionCoefficient\" (0)",
                p => p.Obstacles, (p, v) => p.Obstacles = v)
            {
                Methods = Takers.Walls,
                IsRefusedElsewhere = true,
            },
            new VectorEntry("position", "units", true, "where the vessel lies",
                p => p.Position, (p, v) => p.Position = v)
            {
                Methods = Takers.Walls,
            },
            new VectorEntry("scale", "", false, "factors on the vessel's size",
                p => p.Scale, (p, v) => p.Scale = v)
            {
                Methods = Takers.Walls,
            },
            new VectorEntry("rotation", "degrees", true, "the vessel's Euler angles, about z, then x, then y",
                p => p.Rotation, (p, v) => p.Rotation = v)
            {
                Methods = Takers.Walls,
            },
        });
    }
}
