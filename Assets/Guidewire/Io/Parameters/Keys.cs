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

        /// <summary>Methods whose wire has a stiffness per iteration.</summary>
        public static IReadOnlyList<Solver> Pbd { get; } = Where(method => !method.TakesMaterial);

        /// <summary>Methods whose wire is a material.</summary>
        public static IReadOnlyList<Solver> Material { get; } = Where(method => method.TakesMaterial);

        /// <summary>Methods that meet walls.</summary>
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

    /// <summary>The keys of group "pbd": the wire of pbd, stiffness per iteration.</summary>
    internal static class PbdEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "pbd", "mass and stiffness per iteration of the wire", p => p.Simulation.Pbd, new ParameterEntry[]
        {
            Key.Number("totalMass", "mass units", NumberRange.Positive, "M, distributed evenly over the spheres"),
            Key.Number("stretchStiffness", "", NumberRange.NotNegative,
                "k_A, stiffness of the stretch constraint per iteration; unstable from 2 on"),
            Key.Number("bendStiffness", "units", NumberRange.NotNegative,
                "k_B, stiffness of the bend-twist constraint per iteration; unstable above L/n"),
        },
            Takers.Pbd);
    }

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

    /// <summary>The keys of group "contact": how the wire touches walls.</summary>
    internal static class ContactEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "contact", "how the wire touches walls", p => p.Simulation.Contact, new ParameterEntry[]
        {
            Key.Number("sphereRadius", "units", NumberRange.Positive, "r").With(Takers.Pbd),
            Key.Number("contactDistance", "m", NumberRange.NotNegative,
                "gap between the wire's surface and a wall below which the contact force acts; 0: chosen from radius, "
                + "drive and clearance").With(Takers.Only(Solver.Direct)),
            Key.Number("contactStiffness", "N/m", NumberRange.NotNegative,
                "k; direct: the normal force at half the contactDistance is 1.19 k times it, 0: chosen; xpbd: k times "
                + "the penetration depth, 0: rigid").With(Takers.Only(Solver.Xpbd, Solver.Direct)),
            Key.Number("elasticSlip", "m", NumberRange.NotNegative,
                "elastic tangential displacement up to which a contact sticks, at most wireRadius; 0: a hundredth of "
                + "that").With(Takers.Only(Solver.Direct)),
            Key.OptionalSwitch("selfContact", "whether the wire touches itself; null: where it has walls")
                .With(Takers.Only(Solver.Direct)),
            Key.Number("selfFriction", "", NumberRange.NotNegative, "friction coefficient of the wire on itself")
                .With(Takers.Only(Solver.Direct)),
            Key.Number("collisionMargin", "units", NumberRange.NotNegative, "gap kept beyond the radius")
                .With(Takers.Pbd),
            Key.Number("collisionStiffness", "", NumberRange.Fraction,
                "k_C, stiffness of the contact constraint per iteration").With(Takers.Pbd),
            Key.Choice<ElementContact>("elementContact",
                "contact of rod elements, in addition to spheres: with forces by the lever rule, none, or by "
                + "the thesis's rule", ("seed", "thesis")).With(Takers.Pbd),
        });
    }

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

    /// <summary>The keys of group "method": how it is simulated, and what ends the run.</summary>
    internal static class MethodEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "method", "how it is simulated, and what ends the run", p => p.Simulation.Method, new ParameterEntry[]
        {
            Key.Choice<Solver>("solver",
                "the method: pbd (stiffness per iteration), or xpbd, direct and explicit (a material)"),
            Key.Number("timeStep", "s", NumberRange.Positive, "dt"),
            Key.Whole("maxSimulationSteps", "steps", 0, 1_000_000_000, "largest number of steps of the run"),
            Key.OptionalNumber("duration", "s", NumberRange.NotNegative,
                "simulated time of the run, instead of maxSimulationSteps, which is then derived from it; the "
                + "last step may end later"),
            Key.Whole("constraintSolverSteps", "iterations per step", 0, 1_000_000,
                "m, Gauss-Seidel iterations per step, with xpbd per substep; with pbd, more iterations make a "
                    + "stiffer wire").With(Takers.Only(Solver.Pbd, Solver.Xpbd)),
            Key.Choice<Integrator>("integrator",
                "pbd: how positions are predicted; direct: esdirk3 for most motions, esdirk4 for smooth ones, trbdf2 "
                + "for short steps; bdf2 and implicitEuler damp more",
                ("sdirk2", "trbdf2"), ("sdirk3", "esdirk3"), ("sdirk4", "esdirk4"))
                .With(Takers.Only(Solver.Pbd, Solver.Direct)),
            Key.Switch("VerletIntegration", "older name of integrator: true is \"verlet\", false \"euler\"")
                .By(p => p.Simulation.Method.Integrator == Integrator.Verlet,
                    (p, v) => p.Simulation.Method.Integrator = v ? Integrator.Verlet : Integrator.Euler)
                .With(Takers.Pbd),
            Key.Choice<SweepOrder>("sweepOrder", "order of the elements within an iteration").With(Takers.Pbd),
            Key.Whole("substeps", "", 1, 100_000_000, "parts of a time step")
                .With(Takers.Only(Solver.Xpbd, Solver.Explicit)),
            Key.Number("solverTolerance", "rad, or displacement over L", NumberRange.PositiveUpTo(1e-2),
                "residual error allowed in a stage of direct, and in a step's force balance over the largest force; "
                + "forces between walls need 1e-5").With(Takers.Material),
            Key.Number("timeStepError", "rad, or displacement over L", NumberRange.NotNegative,
                "tolerance of the step size control with trbdf2, esdirk3 and esdirk4, which subdivides steps, down to "
                + "1/1024 of timeStep; 0: no control").With(Takers.Only(Solver.Direct)),
            Key.Whole("maxNewtonIterations", "", 1, 1_000_000,
                "iterations after which the direct solver gives up a stage; ten times as many for a rest shape")
                .With(Takers.Material),
            Key.Number("damping", "", NumberRange.Fraction,
                "fraction of its velocity that a sphere loses per step; a material has massDamping and materialDamping")
                .Replacing("massDamping (1/s), which is damping over timeStep, or materialDamping (s)")
                .OnlyWith(Takers.Pbd),
            Key.Number("deltaThreshold", "units", NumberRange.NotNegative,
                "ends the run in a steady state; pbd: prediction errors below it; a material: distance from rest and "
                + "any swing below it; 0: never"),
            Key.Whole("steadyStateHold", "steps", 1, 1_000_000_000,
                "number of successive prediction errors below deltaThreshold that make a steady state")
                .With(Takers.Pbd),
        });
    }
}
