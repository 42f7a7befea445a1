using System;
using System.Collections.Generic;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Makes keys of the parameter table, each of a kind.</summary>
    internal static class Key
    {
        public static ValueEntry<double> Number(string key, string unit, NumberRange range, string help) =>
            new ValueEntry<double>(key, unit, Kinds.Number(range), help);

        public static ValueEntry<double?> OptionalNumber(string key, string unit, NumberRange range, string help) =>
            new ValueEntry<double?>(key, unit, Kinds.OptionalNumber(range), help);

        public static ValueEntry<double> NumberOr(string key, string unit, NumberRange range, string word,
            string help) => new ValueEntry<double>(key, unit, Kinds.NumberOr(range, word), help);

        public static ValueEntry<int> Whole(string key, string unit, int minimum, int maximum, string help) =>
            new ValueEntry<int>(key, unit, Kinds.Whole(minimum, maximum), help);

        public static ValueEntry<Vector3d> Vector(string key, string unit, bool mayBeZero, string help) =>
            new ValueEntry<Vector3d>(key, unit, Kinds.Vector(mayBeZero), help);

        public static ValueEntry<bool> Switch(string key, string help) => Of(Kinds.Switch, key, help);

        public static ValueEntry<bool?> OptionalSwitch(string key, string help) =>
            Of(Kinds.OptionalSwitch, key, help);

        public static ValueEntry<string> Text(string key, string help) => Of(Kinds.Text, key, help);

        public static ValueEntry<string> Axes(string key, string help) => Of(Kinds.Axes, key, help);

        public static ValueEntry<JToken?> End(string key, string help) => Of(Kinds.End, key, help);

        public static ValueEntry<JToken?> Json(string key, JTokenType type, string allowed, string help) =>
            Of(Kinds.Json(type, allowed), key, help);

        public static ValueEntry<T> Choice<T>(string key, string help, params (string Old, string New)[] older)
            where T : struct, Enum => Of(Kinds.Choice<T>(older), key, help);

        public static ValueEntry<T> Of<T>(Kind<T> kind, string key, string help) =>
            new ValueEntry<T>(key, "", kind, help);
    }

    /// <summary>The methods that take a key.</summary>
    internal static class Takers
    {
        /// <summary>Every method.</summary>
        public static IReadOnlyList<Solver> All { get; } = Where(method => true);

        /// <summary>Those whose wire has a stiffness per iteration.</summary>
        public static IReadOnlyList<Solver> Pbd { get; } = Where(method => !method.TakesMaterial);

        /// <summary>Those whose wire is a material.</summary>
        public static IReadOnlyList<Solver> Material { get; } = Where(method => method.TakesMaterial);

        /// <summary>Those that meet walls.</summary>
        public static IReadOnlyList<Solver> Walls { get; } = Where(method => method.MeetsWalls);

        /// <summary>Gives these methods.</summary>
        public static IReadOnlyList<Solver> Only(params Solver[] methods) => methods;

        private static List<Solver> Where(Predicate<MethodTraits> takes)
        {
            var methods = new List<Solver>();
            foreach (MethodTraits method in MethodTable.All)
            {
                if (takes(method))
                {
                    methods.Add(method.Solver);
                }
            }
            return methods;
        }
    }

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

    /// <summary>The keys of group "material": the wire as a material.</summary>
    internal static class MaterialEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "material", "the wire as a material", p => p.Simulation.Material, new ParameterEntry[]
        {
            Key.Text(InstrumentLayer.Key,
                "name of a file in the folder instruments beside this file or in the program's; it stands for keys of "
                + "the wire (docs/instruments.md)")
                .OnlyWith(Takers.Material),
            Key.Number("youngsModulus", "Pa", NumberRange.Positive, "E"),
            Key.Number("shearModulus", "Pa", NumberRange.Positive, "G"),
            Key.Number("density", "kg/m^3", NumberRange.Positive, "rho; the wire's mass follows from it"),
            Key.Number("wireRadius", "m", NumberRange.Positive, "radius of the wire as a material"),
            Key.Number("innerRadius", "m", NumberRange.NotNegative,
                "inner radius of a hollow wire, less than wireRadius; 0 for a solid wire"),
            Key.OptionalNumber("coreDiameter", "m", NumberRange.Positive,
                "diameter of the thickest solid part, the core or the wire of a coil, of which strains are taken; "
                + "null: "
                + "that of the wire"),
            Key.Choice<CoreMaterial>("material",
                "material of the core, which gives way beyond its elastic range (docs/materials.md); sets E, G and rho "
                + "where they are not given")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Of(Kinds.Optional(WireKinds.Plateau), "plateau",
                "plateau of a superelastic core by numbers; null: none")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.OptionalNumber("yieldStress", "Pa", NumberRange.Positive,
                "stress at which the core yields and keeps a bend; null: none")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.OptionalNumber("hardening", "Pa", NumberRange.NotNegative,
                "slope of the stress over the core's own strain beyond plateau or yield; null: E/1000")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Whole("fibres", "", 0, 16,
                "rings of fibres in a section with such a law, each of 4 (rings - 1) fibres; 0: 4 to 7 by material")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Of(Kinds.Optional(WireKinds.Shaped), "shaped",
                "bend put into the wire over a mandrel before the run, towards -d2; spring-back is the core's law")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Number("shearFactor", "", NumberRange.Positive,
                "shear correction factor of GA: 0.9 for a round wire, about 0.5 for a thin-walled tube"),
            Key.OptionalNumber("bendingStiffness", "N m^2", NumberRange.Positive,
                "EI of the whole wire, which determines E instead of youngsModulus; a section of another material or "
                + "radius has its own"),
            Key.OptionalNumber("torsionalStiffness", "N m^2", NumberRange.Positive,
                "GJ of the whole wire, which determines G instead of shearModulus"),
            Key.OptionalNumber("axialStiffness", "N", NumberRange.Positive,
                "EA of the whole wire, instead of the value from E and the radius, as for a coiled wire; EI is "
                    + "unchanged"),
            Key.OptionalNumber("massPerLength", "kg/m", NumberRange.Positive,
                "rho A of the whole wire, which determines rho instead of density"),
            Key.Vector("restCurvature", "rad/m", true, "curvature about d1 and d2 and twist about d3 at rest"),
            Key.Of(WireKinds.Sections, "wireSections",
                "sections with their own material, rest curvature or elements, such as a soft, bent tip; stiffness and "
                + "mass given directly replace the material's").In(nameof(MaterialParameters.Sections)),
            Key.Number("massDamping", "1/s", NumberRange.NotNegative,
                "a in the force -a M v: a mode of angular frequency w has the damping ratio a/(2 w) at any timeStep"),
            Key.Number("materialDamping", "s", NumberRange.NotNegative,
                "b in the stress b K times the strain rate (Kelvin-Voigt): damping ratio b w/2 at any timeStep")
                .OnlyWith(Takers.Only(Solver.Direct)),
            Key.Choice<ClampRule>("clampRule",
                "weights of the joints at a clamp: order 4 under transverse loads, order 2 (exact for an arc), order "
                + "1"),
            Key.Choice<MassRule>("massRule",
                "mass matrix; xpbd and explicit take \"consistent\" as \"lumped\""),
            Key.Choice<BendLaw>("bendLaw", "couple of a joint: K times the angle, or K sin(angle)"),
        },
            Takers.Material);
    }
}
