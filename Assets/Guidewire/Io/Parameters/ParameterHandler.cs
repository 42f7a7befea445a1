using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads the parameters of a run from a JSON file and from overrides (thesis 3.2.2), and checks them
    /// against the <see cref="ParameterTable"/>.</summary>
    public sealed class ParameterHandler
    {
        // An older word and the newer one that says the same and more.
        private static readonly (string Older, string Newer)[] Twins =
        {
            ("VerletIntegration", "integrator"),
            ("SteadyState", "drive"),
        };

        private const string Steps = "maxSimulationSteps";
        private const double PoissonRounding = 1e-3;    // E and G are written with few digits
        private const int FewestElements = 3;      // of which a clamp's rule can be of fourth order
        private const double OddClamp = 0.01;    // of a deflection
        private const int MaxSteps = 1_000_000_000;

        private readonly GivenParameters _given = new GivenParameters();

        private readonly List<string> _warnings = new List<string>();

        private readonly List<string> _ignored = new List<string>();

        private bool _isSteered;
        private readonly ParameterSource _from;

        private ParameterHandler(ParameterSource from)
        {
            _from = from;
        }

        /// <summary>The effective values.</summary>
        public RunParameters Values { get; private set; } = new RunParameters(Solver.Pbd);

        /// <summary>Keys of a file that the method does not use: they were ignored.</summary>
        public IReadOnlyList<string> Ignored => _ignored;

        /// <summary>What is allowed but most likely not meant, one line each.</summary>
        public IReadOnlyList<string> Warnings => _warnings;

        /// <summary>SHA-256 of all effective values but output paths, in hex: two runs with the same hash give the same
        /// result but for wall times.</summary>
        public string Hash { get; private set; } = "";

        /// <summary>The parameters of a file with overrides on top.</summary>
        /// <param name="file">A JSON file, or null for the defaults (thesis table 4.1).</param>
        /// <param name="overrides">KEY=VALUE each: parameters that count instead of the file's.</param>
        /// <param name="isSteered">Whether a user steers the wire instead of the drive.</param>
        /// <exception cref="ParameterException">A file that cannot be read, a key that is not known, a value that is
        /// not allowed, two keys that disagree.</exception>
        public static ParameterHandler Load(string? file, IEnumerable<string> overrides, bool isSteered = false) =>
            Load(file, CommandLineHandler.ReadAssignments(overrides), isSteered);

        internal static ParameterHandler Load(string? file, IEnumerable<KeyValuePair<string, JToken>> overrides,
            bool isSteered = false) => Load(ParameterSource.OfFile(file), overrides, isSteered);

        internal static ParameterHandler Load(ParameterSource from, IEnumerable<KeyValuePair<string, JToken>> overrides,
            bool isSteered)
        {
            var handler = new ParameterHandler(from) { _isSteered = isSteered };
            string? file = from.Name;
            if (from.Read() is JObject content)
            {
                FileFormat.Check(content[FileFormat.Key], file!);
                content.Remove(FileFormat.Key);
                foreach (JProperty property in content.Properties())
                {
                    handler._given.Add(property.Name, property.Value, file!);
                }
            }
            foreach (KeyValuePair<string, JToken> pair in overrides)
            {
                foreach ((string older, string newer) in Twins)
                {
                    // What the command line says in one word replaces what the file says in the other.
                    string? twin = pair.Key == older ? newer : pair.Key == newer ? older : null;
                    if (twin != null && handler._given.TryGet(twin, out var other) && other.Source == file)
                    {
                        handler._given.Remove(twin);
                    }
                }
                string? length = pair.Key == Steps ? "duration" : pair.Key == "duration" ? Steps : null;
                if (length != null && handler._given.TryGet(length, out var said) && said.Source == file)
                {
                    handler._given.Remove(length);
                }
                handler._given.Add(pair.Key, pair.Value, from.OverridesFrom);
                WireStiffness.Replace(handler._given, pair.Key, file);
            }
            handler._given.RefuseUnknown();
            InstrumentLayer.Expand(handler._given, file, from.Files);
            handler.Apply();
            return handler;
        }

        /// <summary>The parameters of an object within a file.</summary>
        /// <param name="values">Its keys, and who said each: a file, or "command line".</param>
        /// <param name="held">Files in memory.</param>
        /// <exception cref="ParameterException">As of a file of its own.</exception>
        internal static ParameterHandler Load(IEnumerable<(string Key, JToken Value, string Source)> values,
            IReadOnlyDictionary<string, byte[]> held)
        {
            var handler = new ParameterHandler(ParameterSource.OfFile(null));
            foreach ((string key, JToken value, string source) in values)
            {
                handler._given.Add(key, value, source);
            }
            handler._given.RefuseUnknown();
            InstrumentLayer.Expand(handler._given, handler._given.SourceOf(InstrumentLayer.Key), held);
            handler.Apply();
            return handler;
        }

        /// <summary>All effective values of the keys that the method takes; a parameter file that repeats the
        /// run.</summary>
        internal JObject ToJson()
        {
            var json = new JObject();
            foreach (ParameterEntry entry in Taken())
            {
                json[entry.Key] = entry.Write(Values);
            }
            return json;
        }

        /// <summary>The solver that a value of its key names.</summary>
        internal static bool TrySolver(JToken? value, out Solver solver)
        {
            var read = new RunParameters(Solver.Pbd);
            bool isKnown = value != null && ParameterTable.Find(ParameterTable.SolverKey)!.TryRead(read, value);
            solver = read.Simulation.Method.Solver;
            return isKnown;
        }

        private Solver Method => Values.Simulation.Method.Solver;

        private IEnumerable<ParameterEntry> Taken()
        {
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                if (entry.IsTakenBy(Method))
                {
                    yield return entry;
                }
            }
        }

        private void Apply()
        {
            ApplyKey(ParameterTable.SolverKey);
            Values = new RunParameters(Method);
            _given.ApplyParts(Values);
            PassOver();
            foreach ((string older, string _) in Twins)
            {
                ApplyKey(older);
            }
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                if (Array.FindIndex(Twins, twin => twin.Older == entry.Key) < 0)
                {
                    ApplyKey(entry.Key);
                }
            }
            foreach ((string older, string newer) in Twins)
            {
                RequireSameValue(older, newer);
            }
            ApplyDuration();
            SimulationParameters simulation = Values.Simulation;
            LengthDefaults.Convert(simulation, _given);
            WireStiffness.Apply(Values, _given);
            if (_given.Has("SteadyState") && simulation.Drive.Kind == Drive.Displace
                && !_given.Has("displacementPerStep"))
            {
                simulation.Drive.DisplacementPerStep = simulation.Drive.Displacement;
            }
            ParameterConflict? conflict = ParameterConflict.Find(simulation);
            if (conflict != null)
            {
                throw Refused(conflict.Key, conflict.Needed);
            }
            PointLoadReader.Read(Values, _given.SourceOf);
            LoadTableReader.Read(Values, _given.SourceOf);
            EndMotionReader.Read(Values, _given.SourceOf);
            DriveTableReader.Read(Values, _given.SourceOf("driveFile"));
            SheathReader.Read(Values, _given.SourceOf);
            ReadCatheters();
            ReadStart(simulation);
            InletReader.Read(Values, _given);
            if (_isSteered && (Values.Sheath != null || Values.Catheters != null))
            {
                simulation.Drive.Steering = new Steering(); // the drive asks for nothing then, and so not for too much
            }
            ReadWalls(simulation);
            Warn();
            Hash = ParameterHash.Of(Values, Taken());
        }

        private void ReadCatheters()
        {
            CatheterReader.Read(Values, _given.SourceOf, _warnings, _from.Files);
            foreach (Catheter catheter in Values.Simulation.Scene.Catheters)
            {
                catheter.Drive.Steering = _isSteered ? new Steering() : null;
            }
        }

        // Takes out what the method does not take: refuses it from the command line, notes it from a file.
        private void PassOver()
        {
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                if (entry.IsTakenBy(Method) || !_given.TryGet(entry.Key, out var given))
                {
                    continue;
                }
                if (!entry.TryRead(new RunParameters(Method), given.Value))
                {
                    throw new ParameterException(given.Source, entry.Key, given.Value.ToString(Formatting.None),
                        entry.Allowed);
                }
                if (CommandLineHandler.IsOverride(given.Source)
                    || (entry.IsRefusedElsewhere && HasEffect(entry, given)))
                {
                    throw Refused(entry.Key, "solver " + entry.MethodWords + "; this run has solver "
                        + Kinds.Word(Method.ToString())
                        + (entry.Instead == null ? "" : ", which takes " + entry.Instead));
                }
                _ignored.Add(entry.Key);
                _given.Remove(entry.Key);
            }
            if (_ignored.Count > 0)
            {
                AddWarning(WarningTable.IgnoredKeys, Kinds.Word(Method.ToString()),
                    string.Join(", ", _ignored));
            }
        }

        private bool HasEffect(ParameterEntry entry, (JToken Value, string Source) given)
        {
            var read = new RunParameters(Method);
            entry.TryRead(read, given.Value);
            return !JToken.DeepEquals(entry.Write(read), entry.Write(new RunParameters(Method)));
        }

        private ParameterException Refused(string path, string needed) =>
            _given.Refusal(path, needed, _from.Name ?? "defaults");

        private void ReadWalls(SimulationParameters simulation)
        {
            string vessel = _given.SourceOf("vessel");
            ContactShape[] stated = WallReader.Read(Values, _given.SourceOf, _warnings, _from);
            simulation.Scene.Walls = stated.Concat(_from.Walls).ToArray();
            if (simulation.Scene.Walls.Length > 0 && !_given.Has("integrator"))
            {
                simulation.Method.Integrator = MethodTable.Of(Method).IntegratorBetweenWalls
                    ?? simulation.Method.Integrator;
            }
            ParameterConflict? conflict = ParameterConflict.FindInScene(simulation);
            if (conflict != null)
            {
                throw Refused(conflict.Key, conflict.Needed);
            }
            string? problem = Simulation.FindProblemOfStart(simulation);
            if (problem != null)
            {
                bool isFile = Values.StartFile.Length > 0;
                throw new ParameterException(simulation.Scene.Start?.Hub != null
                    ? _given.SourceOf(isFile ? "startFile" : "start") + ": " + (isFile ? "startFile: " : "start: ")
                        + (isFile ? Values.StartFile + ": " : "") + problem
                    : _given.SourceOf(Values.Sheath != null ? "sheath" : vessel.Length > 0 ? "vessel" : "obstacles")
                        + ": " + problem);
            }
            _warnings.AddRange(SoftWallConflict.Warnings(simulation));
            string? sizes = WireStart.FindOddSizes(simulation, vessel);
            if (sizes != null)
            {
                _warnings.Add(sizes);
            }
        }

        private void ReadStart(SimulationParameters simulation)
        {
            bool isFile = Values.StartFile.Length > 0;
            string key = isFile ? "startFile" : "start";
            if (!isFile && Values.Start == null)
            {
                return;
            }
            if (isFile && Values.Start != null)
            {
                throw new ParameterException(_given.SourceOf("start") + ": start and startFile: give one of the two");
            }
            string name = key;
            try
            {
                if (isFile)
                {
                    name = Values.StartFile = NamedFile.Find(Values.StartFile, _given.SourceOf(key));
                }
                RodStart start = StartFileReader.Read(isFile ? JsonText.ReadObject(name) : (JObject)Values.Start!, name,
                    simulation);
                string? shear = start.FindShear() ?? start.Catheters.Select((one, k) => one.FindShear() is string its
                    ? CatheterReader.Key + "[" + k + "]: " + its : null).FirstOrDefault(its => its != null);
                if (shear != null && MethodTable.Of(Method).TakesMaterial)
                {
                    throw new ParameterException(name + ": " + shear);
                }
                if (shear != null)
                {
                    AddWarning(WarningTable.ShearedStart, name, shear);    // pbd stiffness may be that soft
                }
                simulation.Scene.Start = start;
            }
            catch (ParameterException error)
            {
                throw new ParameterException(_given.SourceOf(key) + ": " + (isFile ? "startFile: " : "")
                    + error.Message);
            }
        }

        private void ApplyKey(string key)
        {
            if (!_given.TryGet(key, out (JToken Value, string Source) given))
            {
                return;
            }
            ParameterEntry entry = ParameterTable.Find(key)!;
            if (!entry.TryRead(Values, given.Value))
            {
                throw new ParameterException(given.Source, key, given.Value.ToString(Formatting.None), entry.Allowed);
            }
        }

        // The least number of steps whose end is not before that time; rounding adds none.
        private void ApplyDuration()
        {
            if (!(Values.Duration is double duration))
            {
                return;
            }
            MethodParameters method = Values.Simulation.Method;
            double steps = Math.Ceiling(duration / method.TimeStep * (1.0 - 1e-12));
            if (!(steps <= MaxSteps))
            {
                throw Refused("duration", "at most " + MaxSteps + " steps of timeStep = "
                    + method.TimeStep.ToString(CultureInfo.InvariantCulture) + " s");
            }
            if (_given.Has(Steps) && method.MaxSimulationSteps != (int)steps)
            {
                throw Refused("duration", "no maxSimulationSteps beside it, which says "
                    + method.MaxSimulationSteps + " where this is " + (int)steps + " steps");
            }
            method.MaxSimulationSteps = (int)steps;
            Values.Duration = null;    // the number of steps says it, also in a run's own parameters
        }

        private void RequireSameValue(string older, string newer)
        {
            if (_given.TryGet(older, out var old) && _given.TryGet(newer, out var given)
                && !JToken.DeepEquals(ParameterTable.Find(older)!.Write(Values), old.Value))
            {
                throw new ParameterException(given.Source + ": " + newer + " = " + given.Value.ToString(Formatting.None)
                    + " and " + older + " = " + old.Value.ToString(Formatting.None) + " disagree: give one of the two");
            }
        }

        private void Warn()
        {
            foreach ((string key, string source) in _given.Former)
            {
                AddWarning(WarningTable.FormerKey, source, key, ParameterTable.Former[key]);
            }
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                if (_given.TryGet(entry.Key, out var given) && entry.NewerWord(given.Value) is string newer)
                {
                    AddWarning(WarningTable.OlderName, given.Source, entry.Key,
                        given.Value.ToString(Formatting.None), newer);
                }
            }
            SimulationParameters simulation = Values.Simulation;
            double l = simulation.Scene.GuidewireLength / simulation.Scene.NumberRodElements;
            WarnOfSections(simulation);
            WarnOfIdleKeys(simulation);
            if (MethodTable.Of(Method).TakesMaterial && (_given.Has("youngsModulus") || _given.Has("shearModulus"))
                && Values.BendingStiffness == null && Values.TorsionalStiffness == null)
            {
                WarnOfModuli(simulation.Material);
            }
            WarnOfClamps(simulation);
            if (_given.TryGet("rodElementLength", out var length) && Math.Abs((double)length.Value - l) > 1e-9 * l)
            {
                AddWarning(WarningTable.ElementLength, length.Source, (double)length.Value, l);
            }
            if (Method != Solver.Pbd)
            {
                return;
            }
            if (simulation.Pbd.StretchStiffness >= 2.0)
            {
                AddWarning(WarningTable.StretchStiffness, simulation.Pbd.StretchStiffness);
            }
            if (simulation.Pbd.BendStiffness > l)
            {
                AddWarning(WarningTable.BendStiffness, simulation.Pbd.BendStiffness, l);
            }
        }

        private void WarnOfClamps(SimulationParameters simulation)
        {
            if (Method != Solver.Pbd && simulation.Material.ClampRule == ClampRule.FourthOrder
                && simulation.Scene.Sheath == null && simulation.Scene.Catheters.Count == 0
                && ElementLayout.Count(simulation) >= FewestElements)
            {
                double error = ParameterConflict.ClampError(simulation);
                if (error > OddClamp)
                {
                    AddWarning(WarningTable.ClampElements, 100.0 * error);
                }
            }
        }

        // Sections that say nothing, too little, or what another one says otherwise.
        private void WarnOfSections(SimulationParameters simulation)
        {
            IReadOnlyList<WireSection> sections = simulation.Material.Sections;
            double length = simulation.Scene.GuidewireLength;
            double slack = ElementLayout.Rounding * length;
            for (int k = 0; k < sections.Count; k++)
            {
                WireSection section = sections[k];
                double fraction = ElementLayout.FractionOfAnElement(simulation, section);
                if (section.From >= length - slack)
                {
                    AddWarning(WarningTable.SectionBeyond, k, section.From, section.To);
                    continue;
                }
                if (section.To - section.From <= slack)
                {
                    AddWarning(WarningTable.SectionThin, k, section.From, section.To);
                    continue;
                }
                if (section.To > length + slack)
                {
                    AddWarning(WarningTable.SectionCut, k, section.From, section.To, length);
                }
                if (fraction < 0.5 && !section.IsMarker)
                {
                    AddWarning(WarningTable.SectionShort, k, section.From, section.To, fraction);
                }
                for (int j = k + 1; j < sections.Count; j++)
                {
                    double from = Math.Max(section.From, sections[j].From);
                    double to = Math.Min(Math.Min(section.To, sections[j].To), length);
                    if (to - from > slack && section.FirstOther(sections[j]) is string key)
                    {
                        AddWarning(WarningTable.SectionOverlap, k, j, key, from, to);
                    }
                }
            }
        }

        // E and G of the wire, and of sections that state one of them.
        private void WarnOfModuli(MaterialParameters material)
        {
            WarnOfModuli("the wire", material.YoungsModulus, material.ShearModulus);
            for (int k = 0; k < material.Sections.Count; k++)
            {
                WireSection section = material.Sections[k];
                if (section.YoungsModulus.HasValue || section.ShearModulus.HasValue)
                {
                    WarnOfModuli("wireSections[" + k + "]", section.YoungsModulus ?? material.YoungsModulus,
                        section.ShearModulus ?? material.ShearModulus);
                }
            }
        }

        private void WarnOfModuli(string where, double young, double shear)
        {
            double ratio = young / (2.0 * shear) - 1.0;
            if (ratio > 0.5 + PoissonRounding)    // -1 is below all that positive moduli make
            {
                AddWarning(WarningTable.PoissonRatio, where, ratio, young, shear);
            }
        }

        // Values that a scene states and no part of the run reads.
        private void WarnOfIdleKeys(SimulationParameters own)
        {
            SceneParameters scene = own.Scene;
            bool isFree = scene.DistalEnd == DistalEnd.Free;
            MaterialParameters wire = own.Material;
            bool hasLaw = wire.Material != CoreMaterial.Linear || wire.YieldStress.HasValue || wire.Plateau != null
                || wire.Sections.Any(section => section.Material > CoreMaterial.Linear || section.YieldStress.HasValue
                    || section.Plateau != null);
            foreach ((string key, bool isIdle, string needed) in new[]
            {
                ("externalForce", own.Drive.Kind != Drive.Force && own.Drive.ExternalForce.Length > 0.0,
                    "drive \"force\""),
                ("distalRotation", isFree && scene.DistalRotation != 0.0, "distalEnd \"clamped\" or \"sliding\""),
                ("distalDisplacement", isFree && scene.DistalDisplacement != 0.0, "distalEnd \"clamped\""),
                ("axialForce", scene.DistalEnd != DistalEnd.Sliding && scene.AxialForce != 0.0,
                    "distalEnd \"sliding\""),
                ("startTurns", scene.StartShape == StartShape.Straight && scene.StartTurns != 1.0,
                    "startShape \"helix\""),
                ("selfFriction", own.Contact.SelfContact == false && own.Contact.SelfFriction > 0.0,
                    "selfContact"),
                ("hardening", wire.Hardening.HasValue && !hasLaw, "material, plateau or yieldStress"),
                ("fibres", wire.Fibres > 0 && !hasLaw, "material, plateau or yieldStress"),
            })
            {
                if (isIdle && ParameterTable.Find(key)!.IsTakenBy(Method) && _given.TryGet(key, out var given))
                {
                    AddWarning(WarningTable.IdleKey, given.Source, key, needed);
                }
            }
        }

        private void AddWarning(WarningKind kind, params object[] values) => _warnings.Add(kind.Text(values));
    }
}
