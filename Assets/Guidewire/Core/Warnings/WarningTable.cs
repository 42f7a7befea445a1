using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;
using System.Text.RegularExpressions;

namespace Guidewire.Core
{
    /// <summary>A kind of warning: its line, what that means, and whether the result of a run with it can be
    /// trusted.</summary>
    public sealed class WarningKind
    {
        // "*name*" or "*name:format*"
        private static readonly Regex Placeholder = new Regex(@"\*(?<name>[^:*]+)(:(?<format>[^*]+))?\*");

        private readonly string _line;

        /// <param name="name">Unique, in one word.</param>
        /// <param name="line">With placeholders: *name*, or *name:format* with a .NET format.</param>
        /// <param name="meaning">Markdown.</param>
        internal WarningKind(string name, WarningPlace place, bool isReliable, string line, string meaning)
        {
            Name = name;
            Place = place;
            IsReliable = isReliable;
            _line = line;
            Meaning = meaning;
        }

        /// <summary>Its name, in one word.</summary>
        public string Name { get; }

        /// <summary>Where it is told.</summary>
        public WarningPlace Place { get; }

        /// <summary>Whether the result of a run with this warning can be trusted.</summary>
        public bool IsReliable { get; }

        /// <summary>What it means, in Markdown.</summary>
        public string Meaning { get; }

        /// <summary>The line with names in place of its values, such as *k*.</summary>
        public string Line => Placeholder.Replace(_line, "*${name}*");

        /// <summary>Gives the line of one run.</summary>
        /// <param name="values">One for each placeholder, in order.</param>
        /// <exception cref="ArgumentException">There are more or fewer.</exception>
        public string Text(params object[] values)
        {
            int next = 0;
            string text = Placeholder.Replace(_line, match =>
            {
                object value = next < values.Length ? values[next] : throw Miscounted(values);
                next++;
                string format = match.Groups["format"].Value;
                return value is IFormattable number
                    ? number.ToString(format.Length == 0 ? null : format, CultureInfo.InvariantCulture)
                    : value.ToString()!;
            });
            return next == values.Length ? text : throw Miscounted(values);
        }

        internal RunWarning With(params object[] values) => new RunWarning(this, Text(values));

        private ArgumentException Miscounted(object[] values) =>
            new ArgumentException(Name + " does not have " + values.Length + " values");
    }

    /// <summary>Where a warning is told.</summary>
    public enum WarningPlace
    {
        /// <summary>Before the first step: it is about the parameters.</summary>
        Start,

        /// <summary>After the reason of a completed run, with ", but".</summary>
        Reason,

        /// <summary>The warning stands at the end of the run, on a line of its own.</summary>
        End,
    }

    /// <summary>A warning of one run.</summary>
    internal readonly struct RunWarning
    {
        /// <param name="text">Its line.</param>
        public RunWarning(WarningKind kind, string text)
        {
            Kind = kind;
            Text = text;
        }

        /// <summary>What it warns of.</summary>
        public WarningKind Kind { get; }

        /// <summary>The warning's line.</summary>
        public string Text { get; }

        /// <inheritdoc/>
        public override string ToString() => Text;
    }

    /// <summary>When a hub that moved less than it was asked makes a run unreliable.</summary>
    internal static class Shortfall
    {
        private const double OfAsked = 1e-3;
        private const double OfLength = 1e-6;    // of the wire: the give of a hub that rests

        /// <summary>Whether a shortfall counts; all in one unit of length.</summary>
        /// <param name="shortfall">What is missing; negative where the hub went farther than asked.</param>
        /// <param name="asked">The motion that was asked, there and back both counted.</param>
        /// <param name="length">Of the wire.</param>
        public static bool Counts(double shortfall, double asked, double length) =>
            Math.Abs(shortfall) > Math.Max(OfAsked * asked, OfLength * length);
    }

    /// <summary>Every warning of the program, once: its line and what it means for <see
    /// cref="Simulation.IsReliable"/>.</summary>
    public static class WarningTable
    {
        private static readonly List<WarningKind> Kinds = new List<WarningKind>();

        /// <summary>Keys that the solver ignores.</summary>
        public static readonly WarningKind IgnoredKeys = AtStart("ignoredKeys",
            "solver *s* does not take *keys*: ignored", "`ignored`; the keys are those of another solver");

        /// <summary>An older word of a key.</summary>
        public static readonly WarningKind OlderName = AtStart("olderName",
            "*file*: *key* = *value* is an older name and means \"*newer*\"", "the run is that of the newer name");

        /// <summary>rodElementLength is not L/n.</summary>
        public static readonly WarningKind ElementLength = AtStart("elementLength",
            "*file*: rodElementLength = *l* is not guidewireLength / numberRodElements = *m*; the latter is used",
            "remove the key, or correct the one that is wrong");

        /// <summary>A key of older files that is none any more.</summary>
        public static readonly WarningKind FormerKey = AtStart("formerKey",
            "*file*: *key* is no longer a key and has no effect: *what counts instead*",
            "remove it; the run is the same");

        /// <summary>A key whose value nothing reads.</summary>
        public static readonly WarningKind IdleKey = AtStart("idleKey",
            "*file*: *key* has no effect without *what it needs*", "add what it needs, or remove it");

        /// <summary>A pbd stiffness for stretching that is unstable.</summary>
        public static readonly WarningKind StretchStiffness = AtStart("stretchStiffness",
            "stretchStiffness = *k* is at or beyond 2, where transversal motion becomes unstable",
            "pbd: the run may end as `diverged`");

        /// <summary>A pbd stiffness for bending that is unstable.</summary>
        public static readonly WarningKind BendStiffness = AtStart("bendStiffness",
            "bendStiffness = *k* is beyond the element length *l*, where bending becomes unstable",
            "pbd: the run may end as `diverged`");

        /// <summary>A section beyond the wire.</summary>
        public static readonly WarningKind SectionBeyond = AtStart("sectionBeyond",
            "wireSections[*i*] from *a* to *b* lies beyond the wire's end: it has no effect",
            "positions are counted from the hub, in units");

        /// <summary>A section that ends beyond the wire.</summary>
        public static readonly WarningKind SectionCut = AtStart("sectionCut",
            "wireSections[*i*] from *a* to *b* reaches beyond the wire's end at *L*: only the part up to there counts",
            "positions are counted from the hub, in units");

        /// <summary>A section without a length.</summary>
        public static readonly WarningKind SectionThin = AtStart("sectionThin",
            "wireSections[*i*] from *a* to *b* is shorter than rounding, 1e-9 of guidewireLength: it has no effect",
            "make it longer, or remove it");

        /// <summary>Two sections with different values in one place.</summary>
        public static readonly WarningKind SectionOverlap = AtStart("sectionOverlap",
            "wireSections[*i*] and wireSections[*j*] both state *key* from *a* to *b*: there the second "
            + "applies", "of sections that overlap, the last in the list with a value applies");

        /// <summary>Moduli that no isotropic material has.</summary>
        public static readonly WarningKind PoissonRatio = AtStart("poissonRatio",
            "*where* has a Poisson's ratio E/(2 G) - 1 of *nu:G3*, by youngsModulus = *E:G3* and shearModulus = *G:G3* "
            + "Pa: that of an isotropic material lies between -1 and 0.5",
            "often a digit too much, or a stiffness of the wrong unit; a coil or a braid may have it");

        /// <summary>A section shorter than half an element.</summary>
        public static readonly WarningKind SectionShort = AtStart("sectionShort",
            "wireSections[*i*] from *a* to *b* is *f:G3* of an element long and only contributes to the average of "
            + "that element; give it a numberRodElements of its own", "the section is coarser than it was given");

        /// <summary>Elements at a clamp for which its rule has another order.</summary>
        public static readonly WarningKind ClampElements = AtStart("clampElements",
            "the elements at a clamp are too few or too different for its rule of fourth order: the deflection by a "
            + "load at the other end is *p:G2* % off; equal elements there, or more, avoid that",
            "by more than 1 %, of a wire of one material");

        /// <summary>An element of a start file that is sheared by much.</summary>
        public static readonly WarningKind ShearedStart = AtStart("shearedStart",
            "*file*: *which element of the start is sheared*",
            "pbd: an element of the start is not along its orientation; with a material it is an error");

        /// <summary>Sizes of vessel and wire that hardly belong together.</summary>
        public static readonly WarningKind OddSizes = AtStart("oddSizes",
            "*file*: vessel and wire differ implausibly in size: the vessel is *a:G3* units long and its wall *b:G3* "
            + "units from the wire's tip, the wire *c:G3* units long with a radius of *r:G3*; scale and metresPerUnit "
            + "change a vessel's size", "often a mesh in other units than the wire");

        /// <summary>A mesh that goes through itself.</summary>
        public static readonly WarningKind SelfIntersection = AtStart("selfIntersection",
            "*file*: the mesh intersects itself: *k* edges pierce a triangle, the first at (*x:G6*, *y:G6*, *z:G6*); "
            + "there the inside is not defined", "a wire may pass where the sheets cross; then `passages` or "
                + "`maxPenetration` makes the run unreliable. `anatomy FILE` mends such a mesh");

        /// <summary>How well a motion fits the meshes that it was made of.</summary>
        public static readonly WarningKind FrameMisfit = AtStart("frameMisfit",
            "vessel.motion.frames: the meshes are *a:G3* units beside the fitted motion in the mean, *b:G3* at most",
            "sections stay round, and move with the centreline ([moving-vessels.md](moving-vessels.md))");

        /// <summary>A soft wall that is as good as rigid.</summary>
        public static readonly WarningKind SoftStiff = AtStart("softStiff",
            "*wall*: wallStiffness = *K:G3* Pa is as good as rigid; without it the run takes less time",
            "above 1e7 Pa ([soft-walls.md](soft-walls.md))");

        /// <summary>Elements that are long for a soft wall.</summary>
        public static readonly WarningKind SoftElements = AtStart("softElements",
            "elements of *l:G3* m are longer than *m:G3* m, over which the wire spreads a load on the wall of *wall*; "
            + "with *f:G3* m, by more numberRodElements, its displacement is 1 % off",
            "longer than (4 EI/K)^(1/4): the wall's displacement depends on the number of elements");

        /// <summary>xpbd: steps that have not converged.</summary>
        public static readonly WarningKind NotConverged = AfterReason("notConverged",
            "*a* of *b* steps had not converged (*kind* up to *p:0.#* % off); raise substeps or "
            + "constraintSolverSteps",
            "xpbd: an error above 0.5 % of the largest bending, twist, or stretch and shear, or contacts that move by "
            + "0.5 % of the radius");

        /// <summary>pbd: a drive that does not get on.</summary>
        public static readonly WarningKind DriveStuck = AfterReason("driveStuck",
            "the drive is stuck: in the last *k* steps the walls gave sphere 0 less than 1 % of its displacement",
            "pbd: for the last ten steps or more; the drive asks for more displacement than the walls allow, and "
            + "`driveShortfall` says how much");

        /// <summary>pbd: a joint beyond half a turn.</summary>
        public static readonly WarningKind LostTurn = AfterReason("lostTurn",
            "joint *j* was turned over half a turn in step *k*, and the wire lost a turn: more constraintSolverSteps, "
            + "or less twistPerStep, avoid that", "pbd: the correction of a joint is proportional to the sine of its "
            + "angle, so beyond half a turn it unwinds in the opposite direction");

        /// <summary>direct: a hub that did not move as far as asked.</summary>
        public static readonly WarningKind HubShortfall = AfterReason("hubShortfall",
            "*hub* fell short by *s:G3* m: *why*", "direct: over a thousandth of its motion is missing. It slipped at "
                + "`hubForceLimit`, an end of the `sheath` was reached, or hubs or tips met");

        /// <summary>direct: a hub that exceeded its limit.</summary>
        public static readonly WarningKind HubForce = AfterReason("hubForce",
            "*hub* had up to *F:G3* N, above its hubForceLimit of *L:G3* N, in *k* of the steps: it slips no "
            + "faster than its slipSpeed, or every displacement that was tried needed more", "the force jumps past the "
            + "limit, often in the first step, when bent tips that start straight spring to the walls");

        /// <summary>direct: elements too long for the forces of several hubs.</summary>
        public static readonly WarningKind HubForceError = AfterReason("hubForceError",
            "the force of *hub* is uncertain by *e:G2* N, and the largest force at any hub is *F:G3* N: beyond the tip "
            + "around it an element is *r:G2* times as long as the bend there, sqrt(B/f); use shorter elements there, "
            + "by numberRodElements or a section",
                "with `catheters`: above 5 % of the largest force, or 0.5 times. The sum "
            + "of all hubs' forces is not affected ([coaxial.md](coaxial.md))");

        /// <summary>direct: a wire too stiff for its elements.</summary>
        public static readonly WarningKind Rounding = AfterReason("rounding",
            "rounding of positions makes the forces at both ends uncertain by *F:G2* N: the wire is too stiff "
            + "(youngsModulus, wireRadius) for such short elements", "direct, both ends held: a last bit of the length "
                + "is a force above 1e-7 N");

        /// <summary>direct: a free wire that spins too fast for its steps.</summary>
        public static readonly WarningKind SpinLost = AfterReason("spinLost",
            "the free wire turned by up to *a:G2* rad a step, which changes its angular momentum by some *p:G2* % "
            + "(docs/verification.md); a shorter timeStep or another integrator conserves it better",
            "direct: by more than 1 %");

        /// <summary>A motion that a disturbance would leave.</summary>
        public static readonly WarningKind Unstable = AfterReason("unstable",
            "the wire ends in an unstable shape, as beyond a critical load: any disturbance would grow, but a "
            + "symmetric motion has none; a small load across the wire shows where it goes",
            "without walls, near a balance of forces: the second derivative of the energy has a negative eigenvalue at "
            + "the end, and the wire has not moved by 1e-4 L along its mode");

        /// <summary>A vessel whose sections turned beyond small angles.</summary>
        public static readonly WarningKind VesselTurn = AfterReason("vesselTurn",
            "the vessel's sections turned by up to *a:G2* rad: its beam is one of small angles, 0.3 rad at most",
            "`vessel.beam`: the vessel's own stiffness is only roughly that of the larger turn");

        /// <summary>Energy that the scheme takes.</summary>
        public static readonly WarningKind EnergyLost = AfterReason("energyLost",
            "the integrator dissipated *p:0* % of the energy of an undamped motion; its estimated error reached "
            + "*e:G2* rad, or that part of L, in a step: set timeStepError, or a shorter timeStep",
            "direct with an error estimate, without walls and moving ends: more than 10 % of all that was put in");

        /// <summary>explicit: substeps beyond stability.</summary>
        public static readonly WarningKind SubstepUnstable = AfterReason("substepUnstable",
            "the substep of *h:G4* s is above *s:G4* s, where explicit steps become unstable; raise substeps",
            "explicit: above 2 over the wire's highest angular frequency");

        /// <summary>Strands that passed one another.</summary>
        public static readonly WarningKind StrandPassages = AtEnd("strandPassages",
            "an instrument passed through itself *k* times",
            "pairs of elements that crossed between steps; direct has contact of a wire with itself (`selfContact`)");

        /// <summary>Points that passed a wall.</summary>
        public static readonly WarningKind Passages = AtEnd("passages", "*k* points of the wire passed a wall",
            "`passages`");

        /// <summary>Penetration beyond what the method allows.</summary>
        public static readonly WarningKind Penetration = AtEnd("penetration",
            "the wire penetrated a wall by *d:G3* units, *r:G3* units are allowed",
            "`maxPenetration`; pbd allows the radius, xpbd a twentieth of it, direct nothing");

        /// <summary>A wire of another length.</summary>
        public static readonly WarningKind Length = AtEnd("length",
            "the wire is *p:0.0* % *shorter or longer* than at rest", "by more than 1 %, more than a metal wire can "
            + "withstand; with pbd too soft, or compressed between walls");

        /// <summary>Bent to less than five times its radius.</summary>
        public static readonly WarningKind Strain = AtEnd("strain",
            "the outermost fibre was strained by up to *p:0* % *when* s: a real instrument would have kinked",
            "direct: `strain` of `extremes` above 20 %, of the core a bend of less than five radii (`coreDiameter`). "
            + "Twist does not count. `stress` shows where");

        /// <summary>An instrument that goes through itself.</summary>
        public static readonly WarningKind SelfOverlap = AtEnd("selfOverlap",
            "*instrument* goes through itself: at t = *t:G4* s the axes of its parts at *a:G4* and *b:G4* units from "
            + "the proximal end are *r:G2* of a diameter apart",
            "the nearest of all steps, beyond what bending brings together. Without self-contact an instrument does "
            + "not meet itself");

        /// <summary>A core strained beyond its law.</summary>
        public static readonly WarningKind BeyondLaw = AtEnd("beyondLaw",
            "the core was strained by up to *p:0.0* %, *d:G4* mm from the hub: beyond the range of its material's law",
            "`coreStrain` of `extremes`: nitinol beyond its plateau, steel near fracture "
            + "([materials.md](materials.md))");

        /// <summary>A linear core strained beyond the elastic range of metals.</summary>
        public static readonly WarningKind BeyondElastic = Add("beyondElastic", WarningPlace.End, true,
            "the wire was strained by up to *p:0.0* %: nitinol and steel leave their elastic line at 0.8 %; the key "
            + "material takes that into account", "a linear wire as stiff as metal; forces of bends are too large "
            + "([materials.md](materials.md))");

        /// <summary>A drive that the walls kept back.</summary>
        public static readonly WarningKind DriveShortfall = AtEnd("driveShortfall",
            "the drive fell short: of *a:G4* units that it asked of the first sphere *b:G3* are missing",
            "`driveShortfall`, above a thousandth of `driveAsked` and above a millionth of the wire's length, the give "
            + "of a hub that rests");

        /// <summary>Play of instruments in one another.</summary>
        public static readonly WarningKind Play = AtEnd("play",
            "the *inner* has *d:G3* mm of play in the *outer*, which is not simulated: at the tip their axes may "
            + "differ by up to *a:G3* degrees, and *l:G3* mm of *o:G3* mm of overlap are not coupled",
            "with `catheters`: by 15 degrees or more, or 5 degrees and a tenth of the overlap. A real tip has another "
            + "direction ([coaxial.md](coaxial.md))");

        /// <summary>A tip that left by an open rim.</summary>
        public static readonly WarningKind OpenRim = Add("openRim", WarningPlace.End, true,
            "the tip left the vessel by an open rim at (*x:G4*, *y:G4*, *z:G4*) at t = *t:G6* s",
            "the tip was first outside there and then. It is no error. There is no wall beyond, but with direct the "
            + "mesh's outside is one");

        /// <summary>A soft wall near its limit.</summary>
        public static readonly WarningKind SoftLimit = Add("softLimit", WarningPlace.End, true,
            "a wall gave way by up to *u:G3* m, *p:0* % of its softLimit: there it was almost rigid",
            "direct: above 90 %. A lower wallStiffness makes no more difference there");

        /// <summary>All of them, in the order of the docs.</summary>
        public static IReadOnlyList<WarningKind> All => Kinds;

        /// <summary>Gives the kind of a name.</summary>
        internal static WarningKind Find(string name) => Kinds.Find(kind => kind.Name == name)!;

        /// <summary>The table as Markdown, as docs/runs.md shows it, a part for each time at which a run
        /// warns.</summary>
        public static string ToMarkdown()
        {
            var text = new StringBuilder();
            foreach ((WarningPlace place, string when) in new[] { (WarningPlace.Start, "before the run"),
                (WarningPlace.Reason, "after the reason"), (WarningPlace.End, "at the end") })
            {
                text.Append(text.Length == 0 ? "" : "\n").Append("| ").Append(when)
                    .Append(" | `reliable` | meaning |\n|---|---|---|\n");
                foreach (WarningKind kind in Kinds.FindAll(kind => kind.Place == place))
                {
                    text.Append("| ").Append(kind.Line).Append(kind.IsReliable ? " | - | " : " | false | ")
                        .Append(kind.Meaning).Append(" |\n");
                }
            }
            return text.ToString();
        }

        private static WarningKind AtStart(string name, string line, string meaning) =>
            Add(name, WarningPlace.Start, true, line, meaning);

        private static WarningKind AfterReason(string name, string line, string meaning) =>
            Add(name, WarningPlace.Reason, false, line, meaning);

        private static WarningKind AtEnd(string name, string line, string meaning) =>
            Add(name, WarningPlace.End, false, line, meaning);

        private static WarningKind Add(string name, WarningPlace place, bool isReliable, string line, string meaning)
        {
            var kind = new WarningKind(name, place, isReliable, line, meaning);
            Kinds.Add(kind);
            return kind;
        }
    }
}
