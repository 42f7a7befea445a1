using System;
using System.Linq;

namespace Guidewire.Core
{
    /// <summary>A conflict of a parameter with the method or with another parameter.</summary>
    public sealed class ParameterConflict
    {
        // In the order in which they are reported. With pbd proximalEnd "held" is the default and says nothing, and
        // there is no "free".
        private static readonly Rule[] Always =
        {
            new Rule("integrator", p => p.Traits.Integrators.Count > 0 && !Contains(p.Traits, p.Method.Integrator),
                p => "one of \"" + string.Join("\", \"", Words(p.Traits)) + "\" with solver \"" + Word(p.Method.Solver)
                    + "\""),
            new Rule("vessel", p => !p.Traits.MeetsWalls && p.HasWalls,
                "solver pbd, xpbd or direct: explicit does not support walls"),
            new Rule("initialState",
                p => p.IsMaterial && p.HasWalls && p.Scene.InitialState == InitialState.Equilibrium,
                "\"straight\" between walls: the search for rest shapes does not support them"),
            new Rule("integrator",
                p => p.HasFriction && p.Traits.HasBarriers && p.Method.Integrator != Integrator.ImplicitEuler,
                "implicitEuler where a wall has a frictionCoefficient, or the wire selfFriction"),
            new Rule("elementContact",
                p => p.HasFriction && !p.IsMaterial && p.Contact.ElementContact == ElementContact.Thesis,
                "\"barycentric\" or \"none\" where a wall has a frictionCoefficient"),
            new Rule("solver", p => !p.Traits.TakesSteering && p.Drive.Steering != null,
                "pbd or direct where the wire is steered by hand"),
            new Rule("damping", p => p.IsMaterial && p.Method.Damping != 0.0,
                "solver pbd: a material has massDamping (1/s), which is damping over timeStep, and materialDamping"
                + " (s)"),
            new Rule("materialDamping",
                p => p.Material.MaterialDamping != 0.0 && p.Method.Solver != Solver.Direct && p.IsMaterial,
                "solver direct: the others have no strain rates"),
            new Rule("tipMoment", p => !p.Traits.TakesTipMoment && p.Scene.TipMoment != Vector3d.Zero,
                "solver direct or explicit: the others do not support couples"),
            new Rule("bendLaw", p => !p.Traits.TakesDarbouxLaw && p.Material.BendLaw == BendLaw.Darboux,
                "solver direct or explicit: xpbd supports the rotation vector only"),
            new Rule("timeStepError", p => p.Method.TimeStepError > 0.0
                && (p.Method.Integrator == Integrator.ImplicitEuler || p.Method.Integrator == Integrator.Bdf2),
                "integrator trbdf2, esdirk3 or esdirk4: the others have no error estimate"),

            new Rule("proximalEnd", p => !p.IsMaterial && p.Scene.ProximalEnd == ProximalEnd.Free,
                "\"held\" or \"clamped\" with solver pbd; drive \"force\" frees sphere 0"),
            new Rule("drive",
                p => p.IsMaterial && p.Drive.Kind == Drive.Force && p.Scene.ProximalEnd != ProximalEnd.Free,
                "proximalEnd \"free\" with \"force\", which holds nothing"),
            new Rule("drive",
                p => !p.IsMaterial && p.Drive.Kind == Drive.Force && p.Scene.ProximalEnd == ProximalEnd.Clamped,
                "proximalEnd \"held\" with \"force\", which frees sphere 0"),
            new Rule("distalEnd", p => !p.Traits.Slides && p.Scene.DistalEnd == DistalEnd.Sliding,
                "\"free\" or \"clamped\": only solver direct lets an end slide"),
            new Rule("distalEnd", p => !p.IsMaterial && p.Scene.DistalEnd == DistalEnd.Held,
                "\"free\" or \"clamped\" with solver pbd"),
            new Rule("distalRotation", p => p.Scene.DistalEnd == DistalEnd.Held && p.Scene.DistalRotation != 0.0,
                "distalEnd \"clamped\" or \"sliding\": an end that is only held can rotate freely"),
            // The last joint takes a rotation at once for one by less than half a turn, in the shorter direction.
            new Rule("distalRotation", p => !p.Traits.TakesSuddenRotation && p.Scene.DistalEnd == DistalEnd.Clamped
                && p.Scene.DistalRampTime == 0.0 && Math.Abs(p.Scene.DistalRotation) > 1.0,
                "solver direct, or a distalRampTime > 0, for a sudden rotation of more than 1 rad"),
            new Rule("twistPerStep", p => p.IsMaterial && p.Drive.TwistPerStep != 0.0 && !p.IsClamped,
                "proximalEnd \"clamped\" in a run with a material"),
            new Rule("proximalEnd", p => p.IsMaterial && p.Scene.ProximalEnd == ProximalEnd.Free && p.MovesSphere0,
                "\"held\" or \"clamped\" with a drive that moves sphere 0"),

            // Each group of keys defines the motion of the hub on its own.
            new Rule("displacementPerStep", p => p.IsMaterial && p.Drive.DisplacementPerStep != 0.0
                && (p.Drive.InsertionSpeed != 0.0 || p.Drive.Table != null),
                "0 with an insertionSpeed or a driveFile"),
            new Rule("twistPerStep", p => p.IsMaterial && p.Drive.TwistPerStep != 0.0
                && (p.Drive.RotationSpeed != 0.0 || p.Drive.Table != null),
                "0 with a rotationSpeed or a driveFile"),
            new Rule("driveFile", p => p.IsMaterial && p.Drive.Table != null
                && (p.Drive.InsertionSpeed != 0.0 || p.Drive.RotationSpeed != 0.0),
                "insertionSpeed and rotationSpeed to be 0: the file contains both"),
            new Rule("driveFile", p => p.IsMaterial && p.Drive.Table != null && !p.IsClamped, ClampedByDrive),
            new Rule("rotationSpeed", p => p.IsMaterial && p.Drive.RotationSpeed != 0.0 && !p.IsClamped,
                ClampedByDrive),
            new Rule("proximalEnd", p => p.IsMaterial && p.Drive.Steering != null && !p.IsClamped,
                "\"clamped\" where a wire with a material is steered by hand"),
            new Rule("driveFile", p => p.IsMaterial && p.Drive.Table != null && !p.MovesSphere0, MovingDrive),
            new Rule("insertionSpeed", p => p.IsMaterial && p.Drive.InsertionSpeed != 0.0 && !p.MovesSphere0,
                MovingDrive),

            new Rule("coreDiameter", p => p.IsMaterial && p.Material.CoreDiameter > 2.0 * p.Material.WireRadius,
                "at most twice wireRadius: it is what is solid in the wire"),
            new Rule("wireSections", p => p.IsMaterial && HasCoreTooWide(p.Material),
                "a coreDiameter of at most twice the wireRadius there"),
            new Rule("yieldStress", p => p.Material.YieldStress.HasValue && p.Material.Plateau != null,
                "null with a plateau: a core has one law"),
            new Rule("material", p => p.Material.Material != CoreMaterial.Linear
                && (p.Material.YieldStress.HasValue || p.Material.Plateau != null),
                "\"linear\" with a plateau or a yieldStress: the material has a law of its own"),
            new Rule("material", p => p.Method.Solver != Solver.Direct && p.IsMaterial && (p.Material.Plateau != null
                || p.Material.YieldStress.HasValue || p.Material.Material != CoreMaterial.Linear),
                "\"linear\", without plateau and yieldStress, with this solver: only direct has laws with a memory"),
            new Rule("fibres", p => p.Material.Fibres == 1 || p.Material.Fibres == 2, "0, or 3 to 16"),
            new Rule("wireSections", p => Array.Exists(SectionsOf(p.Material), section =>
                (section.YieldStress.HasValue ? 1 : 0) + (section.Plateau != null ? 1 : 0)
                + (section.Material > CoreMaterial.Linear ? 1 : 0) > 1),
                "one of material, plateau and yieldStress in a section"),
            OfLaw("yieldStress", p => p.Material.YieldStress.HasValue),
            OfLaw("plateau", p => p.Material.Plateau != null),
            OfLaw("material", p => p.Material.Material != CoreMaterial.Linear),
            OfLaw("wireSections", p => true),
            new Rule("shaped", p => p.IsMaterial && p.Material.Shaped is Shaping shaped && HasStiffness(p)
                && !HasHollowTooWide(p.Material)
                && (shaped.To > p.Scene.GuidewireLength
                    || Mandrel.Find(shaped, p.Material, p.Scene.MetresPerUnit) == null),
                "a part of the wire whose core yields (material steel, annealedSteel or platinum, or a "
                + "yieldStress), and "
                + "an angle that a mandrel can leave there"),
            new Rule("innerRadius", p => p.IsMaterial && p.Material.InnerRadius >= p.Material.WireRadius,
                "less than wireRadius"),
            new Rule("elasticSlip", p => p.Traits.HasBarriers && p.Contact.ElasticSlip > p.Material.WireRadius,
                "at most wireRadius: contacts that give way elastically over more have hardly any friction"),
            new Rule("wireSections", p => p.IsMaterial && HasHollowTooWide(p.Material),
                "every wireRadius larger than innerRadius"),
            new Rule("wireRadius", p => p.IsMaterial && !HasStiffness(p),
                "a finite bending stiffness over guidewireLength^2 above 0 (see youngsModulus and "
                + "metresPerUnit)"),
            new Rule("wireSections", p => ElementLayout.FindProblem(p.All) != null,
                p => ElementLayout.FindProblem(p.All)!),
            new Rule("displacementDirection", p => p.Drive.DisplacementDirection.Length == 0.0,
                "a length other than 0"),
            new Rule("startTurns", p => p.Scene.StartShape == StartShape.Helix
                && 2.0 * Math.PI * Math.Abs(p.Scene.StartTurns) * p.Scene.StartRadius >= p.Scene.GuidewireLength,
                "a helix shorter than guidewireLength: 2 pi startTurns startRadius is larger"),
            new Rule("initialState", p => p.IsMaterial && p.Scene.InitialState == InitialState.Equilibrium
                && !p.IsClamped && !p.HasDistalClamp && !p.IsHeldAtBothEnds,
                "a clamped end, or both held: a wire that can rotate freely has no unique rest shape"),
            new Rule("pointLoads", p => p.IsMaterial && Array.Exists(p.Scene.PointLoads,
                load => load.At > p.Scene.GuidewireLength), "every \"at\" to be at most guidewireLength"),
        };

        // Of parameters that are complete, with walls and tables.
        private static readonly Rule[] InScene =
        {
            OfMotion("proximalMotionFile", p => p.Scene.ProximalMotion,
                p => p.Scene.ProximalEnd != ProximalEnd.Free && p.Drive.Kind == Drive.Hold
                    && p.Drive.Steering == null && p.Drive.Displacement == 0.0 && p.Drive.TwistPerStep == 0.0
                    && p.Drive.RotationSpeed == 0.0,
                "proximalEnd \"clamped\" or \"held\" and drive \"hold\" without displacement or rotation"),
            OfMotion("proximalMotionFile", p => p.Scene.ProximalMotion,
                p => p.IsClamped || !p.Scene.ProximalMotion!.Turns, "rotations of 0 where the end is only held"),
            OfMotion("distalMotionFile", p => p.Scene.DistalMotion,
                p => p.Scene.DistalEnd != DistalEnd.Free && p.Scene.DistalRotation == 0.0
                    && p.Scene.DistalDisplacement == 0.0,
                "a distalEnd other than \"free\", and distalRotation and distalDisplacement 0"),
            OfMotion("distalMotionFile", p => p.Scene.DistalMotion,
                p => p.HasDistalClamp || !p.Scene.DistalMotion!.Turns, "rotations of 0 where the end is only held"),
            OfSheath(p => p.Scene.ProximalMotion == null, "no proximalMotionFile"),
            new Rule("hubForceLimit", p => p.Drive.HubForceLimit > 0.0 && !p.HasWalls, NoSlipWithoutWalls),
            new Rule("timeStep", p => Array.Exists(p.Scene.Walls, wall => wall.Motion?.Cycles.Any(
                cycle => cycle.Period * (1.0 + 1e-9) < FewestStepsOfCycle * p.Method.TimeStep) == true),
                "at most an eighth of each period in a wall's motion: longer steps would not see it move"),
            new Rule("vessel.motion", p => !p.Traits.HasBarriers
                && Array.Exists(p.Scene.Walls, wall => wall.Motion?.Cycles.Count > 0),
                "solver direct: with the others walls stand still"),
            new Rule("vessel.beam", p => !p.Traits.HasBarriers
                && Array.Exists(p.Scene.Walls, wall => wall.Motion?.Beam != null),
                "solver direct: with the others a vessel does not give way"),
            OfSheath(p => p.HasWalls, "a vessel"),
            OfSheath(p => p.IsClamped, "proximalEnd \"clamped\""),
            OfSheath(p => p.Drive.Steering != null || p.Drive.Kind == Drive.Displace || p.Drive.Kind == Drive.Hold,
                "drive \"displace\" or \"hold\""),
            OfSheath(p => p.Scene.DistalEnd == DistalEnd.Free, "distalEnd \"free\""),
            OfSheath(p => p.Scene.PointLoads.Length == 0, "no pointLoads"),
            OfSheath(p => p.Scene.StartShape == StartShape.Straight, "startShape \"straight\""),
            OfSheath(p => p.Method.Integrator == Integrator.ImplicitEuler, "integrator \"implicitEuler\""),
            OfSheath(p => p.Material.BendLaw == BendLaw.RotationVector, "bendLaw \"rotationVector\""),
            OfSheath(p => p.Drive.Displacement == 0.0 || p.Drive.Kind != Drive.Hold, "displacement 0"),
            OfCatheters(p => p.Scene.Catheters.Count <= 2, "no more than two catheters"),
            OfCatheters(p => p.Traits.HasBarriers, "solver direct"),
            OfCatheters(p => !p.HasWalls || p.Method.Integrator == Integrator.ImplicitEuler,
                "integrator \"implicitEuler\" between walls"),
            NoSlipOf(0),
            NoSlipOf(1),
            OfCatheters(p => p.IsClamped, "proximalEnd \"clamped\""),
            OfCatheters(p => p.Drive.Kind == Drive.Displace || p.Drive.Kind == Drive.Hold,
                "drive \"displace\" or \"hold\""),
            OfCatheters(p => p.Drive.Kind == Drive.Hold || Vector3d.Dot(Vector3d.Normalize(
                p.Drive.DisplacementDirection), p.Scene.StartAxis?.Direction ?? Vector3d.UnitZ) > 1.0 - 1e-12,
                "displacementDirection along the wire, [0, 0, 1] without an inlet"),
            OfCatheters(p => p.Drive.Displacement == 0.0 || p.Drive.Kind != Drive.Hold, "displacement 0"),
            OfCatheters(p => p.Scene.DistalEnd == DistalEnd.Free, "distalEnd \"free\""),
            OfCatheters(p => p.Scene.StartShape == StartShape.Straight, "startShape \"straight\""),
            OfCatheters(p => p.Scene.Start == null || p.Scene.Start.IsReached || p.Scene.Start.Hub != null,
                "a \"hub\" in the startFile or start"),
            new Rule("initialState",
                p => p.Scene.Start?.Hub != null && p.Scene.InitialState == InitialState.Equilibrium,
                "\"straight\" where a start has a \"hub\": it says where all instruments are"),
            OfCatheters(p => p.Scene.TipMoment == Vector3d.Zero && p.Scene.TipFollowerForce == Vector3d.Zero,
                "no tipMoment and no tipFollowerForce"),
            OfCatheters(p => p.Material.MaterialDamping == 0.0, "materialDamping 0"),
            OfCatheters(p => p.Material.ClampRule != ClampRule.WholeElement, "no clampRule \"wholeElement\""),
            OfCatheters(p => p.Material.BendLaw == BendLaw.RotationVector, "bendLaw \"rotationVector\""),
        };

        private const double FewestStepsOfCycle = 8.0;
        private const string NoSlipWithoutWalls = "a vessel or obstacles: without walls the hub does not slip";
        private const string ClampedByDrive = "proximalEnd \"clamped\", and no drive \"force\"";
        private const string MovingDrive = "drive \"displace\" or \"push\"";

        /// <param name="key">The parameter's key in files, or the path of a part of one.</param>
        /// <param name="needed">What it needs, as a noun phrase.</param>
        internal ParameterConflict(string key, string needed)
        {
            Key = key;
            Needed = needed;
        }

        /// <summary>The parameter's key in files, or the path of a part of one, such as catheters[0].start.</summary>
        public string Key { get; }

        /// <summary>What it needs, as a noun phrase.</summary>
        public string Needed { get; }

        /// <summary>The first conflict of these parameters, or null; walls and tables need not have been
        /// read.</summary>
        public static ParameterConflict? Find(SimulationParameters parameters) => First(Always, parameters);

        /// <summary>The first conflict of parameters that are complete, or null.</summary>
        public static ParameterConflict? FindInScene(SimulationParameters parameters)
        {
            return First(Always, parameters) ?? First(InScene, parameters) ?? FindInCatheters(parameters)
                ?? SoftWallConflict.Find(parameters);
        }

        private static ParameterConflict? First(Rule[] rules, SimulationParameters parameters)
        {
            var facts = new Facts(parameters);
            Rule? broken = Array.Find(rules, rule => rule.IsBroken(facts));
            return broken == null ? null : new ParameterConflict(broken.Key, broken.Needed(facts));
        }

        /// <summary>Error of the deflection of a clamped wire by the lengths of its elements (<see
        /// cref="MaterialRod.ClampError"/>).</summary>
        public static double ClampError(SimulationParameters parameters)
        {
            double[] lengths = ElementLayout.Lengths(parameters, 1.0, out _);
            return MaterialScene.CreateRod(parameters, lengths).ClampError(new RodSupports
            {
                Proximal = parameters.Drive.Kind == Drive.Force ? ProximalEnd.Free : parameters.Scene.ProximalEnd,
                Distal = parameters.Scene.DistalEnd,
                Clamp = parameters.Material.ClampRule,
            });
        }

        private static Rule OfCatheters(Predicate<Facts> holds, string needed) =>
            new Rule("catheters", p => p.Scene.Catheters.Count > 0 && !holds(p), needed);

        private static Rule NoSlipOf(int catheter)
        {
            return new Rule("catheters[" + catheter + "].hubForceLimit", p => p.Scene.Catheters.Count > catheter
                && !p.HasWalls && p.Scene.Catheters[catheter].Drive.HubForceLimit > 0.0, NoSlipWithoutWalls);
        }

        private static ParameterConflict? FindInCatheters(SimulationParameters parameters) =>
            parameters.Scene.Catheters.Count > 0 ? CoaxialStart.FindProblem(parameters) : null;

        private static Rule OfSheath(Predicate<Facts> holds, string needed) =>
            new Rule("sheath", p => p.Scene.Sheath != null && !holds(p), needed);

        private static Rule OfMotion(string key, Func<Facts, EndMotion?> motion, Predicate<Facts> holds,
            string needed) =>
            new Rule(key, p => motion(p) != null && !(p.Method.Solver == Solver.Direct && holds(p)), needed);

        private static bool HasHollowTooWide(MaterialParameters material)
        {
            foreach (WireSection section in material.Sections)
            {
                // Where a section begins or ends is where something changes.
                if (!(CrossSection.At(material, section.From, false).StretchStiffness > 0.0)
                    || !(CrossSection.At(material, section.To, false).StretchStiffness > 0.0))
                {
                    return true;
                }
            }
            return false;
        }

        private static WireSection[] SectionsOf(MaterialParameters material) =>
            System.Linq.Enumerable.ToArray(material.Sections);

        private static Rule OfLaw(string key, Predicate<Facts> states) =>
            new Rule(key, p => states(p) && LawProblem(p) != null, p => LawProblem(p)!);

        // What is wrong with the laws along the wire, or null.
        private static string? LawProblem(Facts p)
        {
            double length = p.Scene.GuidewireLength;
            if (!p.IsMaterial || !HasStiffness(p) || HasHollowTooWide(p.Material)
                || p.Material.InnerRadius >= p.Material.WireRadius)
            {
                return null;
            }
            foreach (CrossSection piece in new WireProfile(p.Material, length).Pieces)
            {
                if (piece.Fibres == null)
                {
                    continue;
                }
                if (!(piece.Fibres.ElasticStrain < 1.0))
                {
                    return "plateau and yield stresses below Young's modulus of the core";
                }
                if (piece.BendStiffness1 != piece.BendStiffness2)
                {
                    return "no law (material, plateau, yieldStress) where bendingStiffness1 and 2 differ: fibres are"
                        + " those of a round core";
                }
                if (p.Material.BendLaw == BendLaw.Darboux)
                {
                    return "no law (material, plateau, yieldStress) with bendLaw \"darboux\"";
                }
            }
            return null;
        }

        private static bool HasCoreTooWide(MaterialParameters material)
        {
            foreach (WireSection section in material.Sections)
            {
                CrossSection here = CrossSection.At(material, section.From, false);
                if (here.CoreRadius > here.Radius)
                {
                    return true;
                }
            }
            return false;
        }

        // The scale of all bending forces; 0 or infinite as a double, it measures nothing.
        private static bool HasStiffness(Facts p)
        {
            double length = p.Scene.MetresPerUnit * p.Scene.GuidewireLength;
            double force = CrossSection.At(p.Material, 0.0, false).BendStiffness1 / (length * length);
            return force > 0.0 && !double.IsInfinity(force);
        }

        private static bool Contains(MethodTraits method, Integrator integrator)
        {
            foreach (Integrator own in method.Integrators)
            {
                if (own == integrator)
                {
                    return true;
                }
            }
            return false;
        }

        private static string[] Words(MethodTraits method)
        {
            var words = new string[method.Integrators.Count];
            for (int k = 0; k < words.Length; k++)
            {
                words[k] = Word(method.Integrators[k]);
            }
            return words;
        }

        // As in files: in camelCase.
        private static string Word(Enum value)
        {
            string name = value.ToString();
            return char.ToLowerInvariant(name[0]) + name.Substring(1);
        }

        private sealed class Rule
        {
            public Rule(string key, Predicate<Facts> isBroken, string needed)
                : this(key, isBroken, p => needed)
            {
            }

            public Rule(string key, Predicate<Facts> isBroken, Func<Facts, string> needed)
            {
                Key = key;
                IsBroken = isBroken;
                Needed = needed;
            }

            public string Key { get; }

            public Predicate<Facts> IsBroken { get; }

            public Func<Facts, string> Needed { get; }
        }

        // The parameters, and what several rules ask of them.
        private sealed class Facts
        {
            public Facts(SimulationParameters parameters)
            {
                All = parameters;
                Traits = MethodTable.Of(parameters.Method.Solver);
            }

            public SimulationParameters All { get; }

            public MethodTraits Traits { get; }

            public SceneParameters Scene => All.Scene;

            public DriveParameters Drive => All.Drive;

            public MaterialParameters Material => All.Material;

            public ContactParameters Contact => All.Contact;

            public MethodParameters Method => All.Method;

            public bool IsMaterial => Traits.TakesMaterial;

            public bool HasWalls => Scene.Walls.Length > 0;

            public bool HasFriction => Array.Exists(Scene.Walls, wall => wall.FrictionCoefficient > 0.0)
                || (Traits.HasBarriers && Contact.SelfFriction > 0.0 && Contact.TouchesItself(Scene.Walls.Length));

            public bool IsClamped => Scene.ProximalEnd == ProximalEnd.Clamped && Drive.Kind != Core.Drive.Force;

            public bool HasDistalClamp => Scene.DistalEnd == DistalEnd.Clamped || Scene.DistalEnd == DistalEnd.Sliding;

            public bool IsHeldAtBothEnds => Scene.DistalEnd == DistalEnd.Held
                && Scene.ProximalEnd != ProximalEnd.Free && Drive.Kind != Core.Drive.Force;

            public bool MovesSphere0 => Drive.Kind == Core.Drive.Displace || Drive.Kind == Core.Drive.Push;
        }
    }
}
