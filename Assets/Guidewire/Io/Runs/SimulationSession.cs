using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Globalization;
using System.Linq;
using System.Security.Cryptography;
using System.Text;
using System.Threading;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>One run that a user steers: built from a parameter file, changed while it goes on, logged where asked
    /// for. Its host, such as a Unity scene, decides when to step.</summary>
    public sealed class SimulationSession : IDisposable
    {
        private const double Smoothing = 0.02;     // weight of the newest step in the step time shown

        private const string NotTaken = "no run takes its tables: ";

        private readonly ParameterSource _from;
        private readonly List<KeyValuePair<string, JToken>> _overrides;
        private ParameterHandler _handler;
        private readonly Steering? _steering;
        private readonly bool _statesReactions;
        private RunFolder? _results;
        private bool _isNoted;
        private byte[] _start;
        private bool _isStartFormer;           // parameters have changed since, perhaps those of the start
        private readonly CancellationToken _cancellation;
        private readonly bool _limitsHubs;
        private readonly double[] _motion;     // of the hubs, where one moves
        private DriveTableRecord? _steered;       // of a session that records it

        private SimulationSession(ParameterSource from, List<KeyValuePair<string, JToken>> overrides,
            ParameterHandler handler, bool isSteered, bool limitsHubs = false, CancellationToken cancellation = default)
        {
            _cancellation = cancellation;
            _limitsHubs = limitsHubs && isSteered;
            Prepare(handler);
            _steering = isSteered ? HandLimit.Hand(_limitsHubs) : null;
            _statesReactions = handler.Values.Simulation.Method.StatesReactions;
            handler.Values.Simulation.Drive.Steering = _steering;
            _from = from;
            _overrides = overrides;
            _handler = handler;
            ParameterConflict? conflict = ParameterConflict.Find(handler.Values.Simulation);
            if (conflict != null)
            {
                throw new ParameterException((from.Name ?? from.OverridesFrom) + ": " + conflict.Key + " needs "
                    + conflict.Needed);
            }
            _motion = new double[2 * InstrumentCount];
            Simulation = Simulation.Create(handler.Values.Simulation);
            Contrast = SessionContrast.Of(handler.Values.Anatomy, 1e3 * Parameters.Scene.MetresPerUnit);
            _start = Simulation.Save();
        }

        /// <summary>The run as it is now; another object after <see cref="Set"/>.</summary>
        public Simulation Simulation { get; private set; }

        /// <summary>The effective parameters.</summary>
        public SimulationParameters Parameters => _handler.Values.Simulation;

        /// <summary>What is allowed but most likely not meant, one line each.</summary>
        public IReadOnlyList<string> Warnings => _handler.Warnings;

        /// <summary>Wall time of a step in ms, smoothed over some 50 steps; 0 before the first.</summary>
        public double StepTime { get; private set; }

        /// <summary>All effective values of the keys that the method takes.</summary>
        internal JObject EffectiveParameters => _handler.ToJson();

        /// <summary>Whether the user holds the first element, instead of the drive.</summary>
        public bool IsSteered => _steering != null;

        /// <summary>Why no table says how this session was steered since its start, in one phrase; empty where one
        /// does; null where it is not recorded.</summary>
        internal string? Unrecorded => _steered?.Problem;

        /// <summary>Contrast agent in the blood, which no step depends on; null where the vessel has no
        /// centreline.</summary>
        public SessionContrast? Contrast { get; }

        /// <summary>Where an instrument is in its vessel now; null where the run has no inlet.</summary>
        /// <param name="points">Of its spheres, from the hub on, units.</param>
        public LumenPlace? PlaceOf(Vector3d[] points) => _handler.Values.Places?.Of(points, Simulation.FieldOf(0));

        /// <summary>The centreline from the inlet to the target, as <see cref="CentrelinePath.RouteToTarget"/> has it;
        /// null where the run has no target.</summary>
        internal JObject? RouteToTarget()
        {
            CentrelinePath? path = _handler.Values.Path;
            return path == null || path.Target < 0 ? null : path.RouteToTarget();
        }

        /// <summary>Where the tip is to come, units; null where the run has no target.</summary>
        public Vector3d? Target => _handler.Values.Path?.TargetPoint;

        /// <summary>A run at its start that is not logged, and states contact forces and reactions wherever its method
        /// has them.</summary>
        /// <param name="file">Parameter file, or null for the defaults.</param>
        /// <param name="overrides">KEY=VALUE each: parameters that count instead of the file's.</param>
        /// <param name="isSteered">Whether the user holds the first element, instead of the drive; null: with
        /// pbd.</param>
        /// <exception cref="ParameterException">The file or a value cannot be used.</exception>
        public static SimulationSession Open(string? file, IEnumerable<string> overrides, bool? isSteered) =>
            Open(file, CommandLineHandler.ReadAssignments(overrides), isSteered);

        internal static SimulationSession Open(string? file, IEnumerable<KeyValuePair<string, JToken>> overrides,
            bool? isSteered, LastMesh? mesh = null)
        {
            var given = new List<KeyValuePair<string, JToken>>(overrides);
            ParameterSource from = ParameterSource.OfRequest(file, mesh ?? new LastMesh());
            ParameterHandler handler = ParameterHandler.Load(from, given, isSteered == true);
            MethodParameters method = handler.Values.Simulation.Method;
            MethodTraits traits = MethodTable.Of(method.Solver);
            if (isSteered == true && !traits.TakesSteering)
            {
                string solver = (string)ParameterTable.Find("solver")!.Write(handler.Values)!;
                throw new ParameterException((file ?? from.OverridesFrom) + ": a wire of solver " + solver
                    + " is not steered interactively: its file's drive moves it");
            }
            method.StatesReactions |= CanStateReactions(method);
            return new SimulationSession(from, given, handler,
                isSteered ?? (traits.TakesSteering && !traits.TakesMaterial));
        }

        /// <summary>Gives a run at its start.</summary>
        /// <param name="file">Parameter file.</param>
        /// <param name="overrides">KEY=VALUE each: parameters that count instead of the file's.</param>
        /// <param name="logFolder">Folder that takes the results; empty for a run that is not logged.</param>
        /// <param name="isSteered">Whether the user holds the first element, instead of the drive.</param>
        /// <exception cref="ParameterException">The file, a value or the folder cannot be used.</exception>
        public static SimulationSession Open(string file, IEnumerable<string> overrides,
            string logFolder, bool isSteered) =>
            Open(ParameterSource.OfFile(file, new LastMesh()), overrides, logFolder, isSteered);

        /// <summary>A run at its start; errors as of the other.</summary>
        /// <param name="from">The parameters' source.</param>
        /// <param name="overrides">KEY=VALUE each: parameters that count instead of the source's.</param>
        /// <param name="logFolder">Folder that takes the results; empty for a run that is not logged.</param>
        /// <param name="isSteered">Whether the user holds the first element, instead of the drive.</param>
        /// <param name="limitsHubs">Whether hubs slip in the hand where the parameters state no hubForceLimit: at the
        /// push at which the instrument, coiled up in its lumen, would yield.</param>
        /// <param name="cancellation">Ends a long step from another thread, with an <see
        /// cref="OperationCanceledException"/>; the session can then only be disposed of.</param>
        public static SimulationSession Open(ParameterSource from, IEnumerable<string> overrides, string logFolder,
            bool isSteered, bool limitsHubs = false, CancellationToken cancellation = default)
        {
            List<KeyValuePair<string, JToken>> given = CommandLineHandler.ReadAssignments(overrides);
            ParameterHandler handler = ParameterHandler.Load(from, given, isSteered);
            long before = Stopwatch.GetTimestamp();
            var session = new SimulationSession(from, given, handler, isSteered, limitsHubs, cancellation);
            double setUp = (Stopwatch.GetTimestamp() - before) * RunFolder.ToMilliseconds;
            if (logFolder.Length > 0)
            {
                session._results = RunFolder.Open(handler, logFolder, null, keepsLog: true);
                session._results.Begin(session.Simulation, setUp);
                if (isSteered)
                {
                    session.Note("steered by hand");
                }
                if (from.Walls.Length > 0)
                {
                    session.Note("with walls that are in no file");
                }
            }
            return session;
        }

        /// <summary>Instruments, the wire among them.</summary>
        public int InstrumentCount => 1 + Parameters.Scene.Catheters.Count;

        /// <summary>The name by which the parameters give an instrument; empty where they state its numbers.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        public string NameOf(int instrument)
        {
            return instrument == 0 ? _handler.Values.Instrument
                : (string?)_handler.Values.Catheters![instrument - 1]!["instrument"] ?? "";
        }

        /// <summary>What an instrument is called: by its name, or else as what it is.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        public string TitleOf(int instrument)
        {
            string name = NameOf(instrument);
            return name.Length > 0 ? name : instrument == 0 ? "guidewire"
                : InstrumentCount > 2 ? "catheter " + instrument : "catheter";
        }

        /// <summary>Names of instruments that can replace one: those in memory, of the folder beside the parameter file
        /// and the program's; for a catheter only catheters. Empty where the method takes no instrument.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        public IReadOnlyList<string> ChoicesOf(int instrument)
        {
            return ParameterTable.Find("instrument")!.IsTakenBy(Parameters.Method.Solver)
                ? InstrumentLibrary.Names(_from, instrument > 0) : Array.Empty<string>();
        }

        /// <summary>The key that names an instrument.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        public static string KeyOf(int instrument) =>
            instrument == 0 ? "instrument" : "catheters[" + (instrument - 1) + "].instrument";

        /// <summary>One step. A run that is not steered takes no notice of push and turn.</summary>
        /// <param name="push">Motion of sphere 0 along the first element in it (thesis eq. 3.6), units; negative values
        /// pull.</param>
        /// <param name="turn">Turn of the first element about its axis in it, rad.</param>
        /// <param name="hub">Whose hub the user holds: 0 the wire's, 1 that of the first catheter. The others
        /// rest.</param>
        /// <exception cref="ParameterException">There is no such hub; nothing has changed.</exception>
        public void Step(double push, double turn, int hub = 0)
        {
            CheckHub(hub);
            Array.Clear(_motion, 0, _motion.Length);
            _motion[2 * hub] = push;
            _motion[2 * hub + 1] = turn;
            StepByMotion();
        }

        /// <summary>One step of all hubs. A run that is not steered takes no notice of their motion.</summary>
        /// <param name="motion">Push (units) and turn (rad) of each hub in it, the wire's first; the last ones may be
        /// left out and rest.</param>
        /// <exception cref="ParameterException">There are fewer hubs; nothing has changed.</exception>
        public void Step(ReadOnlySpan<double> motion)
        {
            CheckHub((motion.Length - 1) / 2);
            Array.Clear(_motion, 0, _motion.Length);
            motion.CopyTo(_motion);
            StepByMotion();
        }

        /// <summary>Records from now, the start, on how the hubs are steered. Their motion is then rounded by less than
        /// 2e-15 m and 5e-13 rad a step, so that a table repeats it.</summary>
        public void RecordSteering()
        {
            _steered = new DriveTableRecord(Parameters);
        }

        /// <summary>Gives the table for driveFile that repeats the motion of a hub since the start.</summary>
        /// <param name="hub">0 the wire's, k that of catheter k.</param>
        /// <exception cref="ParameterException">There is no such hub, or no table repeats it; the line says
        /// why.</exception>
        public string DriveTable(int hub)
        {
            CheckHub(hub);
            return DriveTables()[hub];
        }

        /// <summary>Gives the tables of all hubs, the wire's first; errors as of one.</summary>
        internal string[] DriveTables()
        {
            string? problem = _steered == null ? "this session does not record how it is steered"
                : _steered.Problem.Length > 0 ? _steered.Problem : FindProblemOfTables(_steered);
            return problem == null ? Enumerable.Range(0, InstrumentCount).Select(_steered!.ToCsv).ToArray()
                : throw new ParameterException(problem);
        }

        // Why a run that the tables drive is refused, or begins with other bits than this one.
        private string? FindProblemOfTables(DriveTableRecord steered)
        {
            SimulationParameters driven = ParameterHandler.Load(_from, _overrides, true).Values.Simulation;
            steered.SetDrives(driven);
            try
            {
                string? refusal = Simulation.FindProblemOfStart(driven);
                double own = Simulation.Report()!.ContactDistance;
                double other = refusal != null ? own : Simulation.Create(driven).Report()!.ContactDistance;
                return refusal != null ? NotTaken + refusal : own.Equals(other) ? null : FormattableString.Invariant(
                    $"a drive as fast has a contactDistance of {other:G4} m, and the hand {own:G4} m: state it");
            }
            catch (ArgumentException error)
            {
                return NotTaken + error.Message;
            }
        }

        private void StepByMotion()
        {
            int done = Simulation.StepCount;
            _steered?.Round(_motion);
            if (_steering != null)
            {
                for (int hub = 0; hub < InstrumentCount; hub++)
                {
                    Steering steering = hub == 0 ? _steering : Parameters.Scene.Catheters[hub - 1].Drive.Steering!;
                    steering.Push = _motion[2 * hub];
                    steering.Turn = _motion[2 * hub + 1];
                }
            }
            long before = Stopwatch.GetTimestamp();
            if (_results != null)
            {
                _results.Step(Simulation);
            }
            else
            {
                Simulation.Step();
            }
            Contrast?.Flow.Advance(Parameters.Method.TimeStep);
            if (Simulation.StepCount > done)
            {
                _steered?.Add(_motion, Simulation);
            }
            double time = (Stopwatch.GetTimestamp() - before) * RunFolder.ToMilliseconds;
            StepTime = StepTime == 0.0 ? time : StepTime + Smoothing * (time - StepTime);
        }

        /// <summary>Whether there is such a hub.</summary>
        /// <exception cref="ParameterException">There is none.</exception>
        public void CheckHub(int hub)
        {
            if (hub < 0 || hub >= InstrumentCount)
            {
                throw new ParameterException("request", "hub", hub.ToString(CultureInfo.InvariantCulture),
                    InstrumentCount == 1 ? "0, the wire's, where there is no catheter"
                        : "0, the wire's, or that of a catheter, from 1 to " + (InstrumentCount - 1));
            }
        }

        /// <summary>Gives the value of a parameter, as it stands behind KEY=.</summary>
        public string Text(string key)
        {
            JToken value = ParameterTable.Find(key)!.Write(_handler.Values);
            return value.Type == JTokenType.String ? (string)value! : value.ToString(Newtonsoft.Json.Formatting.None);
        }

        private static bool CanStateReactions(MethodParameters method) =>
            ParameterTable.Find("logContacts")!.IsTakenBy(method.Solver);

        /// <summary>All that the next steps depend on, as bytes: this run or another one of the same parameters goes on
        /// from there with the same bits.</summary>
        public byte[] Save() => SessionSnapshot.Of(Simulation.Save(), _handler.Hash, IsSteered);

        /// <summary>Goes on from what was saved. Not for a run that is logged: a log goes forward in time.</summary>
        /// <param name="saved">What <see cref="Save"/> gave, here or in another run of the same parameters; one of
        /// another build of the program goes on from the same state, with bits of its own.</param>
        /// <exception cref="ParameterException">It did not; nothing has changed.</exception>
        public void Restore(byte[] saved)
        {
            byte[] numbers = SessionSnapshot.NumbersOf(saved, _handler.Hash, IsSteered, out bool isOfThisBuild);
            try
            {
                Simulation = Simulation.Restore(_handler.Values.Simulation, numbers);
            }
            catch (Exception error) when (!isOfThisBuild && error is ArgumentException)
            {
                throw new ParameterException("the snapshot was saved by another build and is not "
                    + "compatible: " + error.Message);
            }
            _steered?.End("an earlier state was restored within the run: start anew to record");
        }

        /// <summary>Back to the start. As <see cref="Restore"/>, not for a run that is logged.</summary>
        public void Reset()
        {
            if (_isStartFormer)
            {
                _isStartFormer = false;
                _start = StartOf(_handler.Values.Simulation) ?? _start;
            }
            Simulation = Simulation.Restore(_handler.Values.Simulation, _start);
            Contrast?.Flow.Clear();
            _steered = _steered == null ? null : new DriveTableRecord(Parameters);
        }

        // Null where no wire starts so, as one outside a wall that was moved; the first step then says it.
        private static byte[]? StartOf(SimulationParameters parameters)
        {
            try
            {
                return Simulation.Create(parameters).Save();
            }
            catch (ArgumentException)
            {
                return null;
            }
        }

        /// <summary>Changes a parameter; the wire continues from its current state.</summary>
        /// <param name="value">As it stands behind KEY=.</param>
        /// <exception cref="ParameterException">The value is not allowed; nothing has changed.</exception>
        /// <exception cref="ArgumentException">This wire cannot go on with it; nothing has changed.</exception>
        public void Set(string key, string value) =>
            Set(CommandLineHandler.ReadAssignments(new[] { key + "=" + value }));

        internal void Set(IReadOnlyCollection<KeyValuePair<string, JToken>> values, string? change = null)
        {
            var changed = new List<KeyValuePair<string, JToken>>(_overrides);
            foreach (KeyValuePair<string, JToken> value in values)
            {
                changed.RemoveAll(pair => ParameterPath.IsWithin(pair.Key, value.Key));
                changed.Add(value);
            }
            ParameterHandler handler = ParameterHandler.Load(_from, changed, _steering != null);
            MethodParameters method = handler.Values.Simulation.Method;
            Prepare(handler);
            method.StatesReactions |= _statesReactions && CanStateReactions(method);
            handler.Values.Simulation.Drive.Steering = _steering;
            Simulation next = Simulation.Continue(handler.Values.Simulation);
            // A start of other instruments is another one.
            _isStartFormer = next.HasElementsOf(Simulation);
            _start = _isStartFormer ? _start : Simulation.Create(handler.Values.Simulation).Save();
            Simulation = next;
            Note("parameters changed by hand");
            _steered?.End((change ?? string.Join(", ", values.Select(value => value.Key)) + " was changed")
                + " within the run: start anew to record");
            _handler = handler;
            _overrides.Clear();
            _overrides.AddRange(changed);
        }

        /// <summary>Puts another instrument in the place of one that is withdrawn: its tip is where that one's was, and
        /// the rest goes on.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        /// <param name="values">KEY=VALUE each: parameters of it, such as its name, length and elements.</param>
        /// <exception cref="ParameterException">It is in the vessel, or a value is not allowed; nothing has
        /// changed.</exception>
        /// <exception cref="ArgumentException">It does not fit the others; nothing has changed.</exception>
        public void Exchange(int instrument, IEnumerable<string> values) =>
            Exchange(instrument, CommandLineHandler.ReadAssignments(values));

        internal void Exchange(int instrument, IReadOnlyCollection<KeyValuePair<string, JToken>> values)
        {
            CheckHub(instrument);
            string? problem = Simulation.FindInVessel(instrument);
            if (problem != null)
            {
                throw new ParameterException("request: " + problem);
            }
            SceneParameters scene = Parameters.Scene;
            string own = instrument == 0 ? "guidewireLength" : "catheters[" + (instrument - 1) + "].length";
            double before = instrument == 0 ? scene.GuidewireLength : scene.Catheters[instrument - 1].Length;
            JToken? asked = values.LastOrDefault(value => value.Key == own).Value;
            double longer = asked?.Type is JTokenType.Float or JTokenType.Integer ? (double)asked! - before : 0.0;
            var all = new List<KeyValuePair<string, JToken>>(values);
            if (longer != 0.0)
            {
                if (instrument == 0)
                {
                    all.Add(KeyValuePair.Create("guidewireOffset", (JToken)(scene.GuidewireOffset - longer)));
                }
                for (int k = 0; k < scene.Catheters.Count; k++)
                {
                    // From the wire's hub.
                    double start = scene.Catheters[k].Start
                        + (instrument == 0 ? longer : k == instrument - 1 ? -longer : 0.0);
                    all.Add(KeyValuePair.Create("catheters[" + k + "].start", (JToken)start));
                }
            }
            Set(all, "an instrument was exchanged");
        }

        private void Prepare(ParameterHandler handler)
        {
            handler.Values.Simulation.Method.Cancellation = _cancellation;
            if (_limitsHubs)
            {
                HandLimit.Set(handler.Values.Simulation);
            }
        }

        /// <summary>Changes a parameter of a few words to the next one that this run can go on with.</summary>
        /// <returns>False where there is none; nothing has changed then.</returns>
        public bool Switch(string key)
        {
            IReadOnlyList<string> choices = ParameterTable.Find(key)!.Choices;
            string now = Text(key);
            int index = 0;
            while (index < choices.Count && choices[index] != now)
            {
                index++;
            }
            for (int k = 1; k < choices.Count; k++)
            {
                try
                {
                    Set(key, choices[(index + k) % choices.Count]);
                    return true;
                }
                catch (Exception error) when (error is ParameterException || error is ArgumentException)
                {
                    continue;    // not with this wire: the next one
                }
            }
            return false;
        }

        /// <summary>Ends a run that goes on as interrupted, and its log with it.</summary>
        public void Dispose()
        {
            if (_results == null)
            {
                return;
            }
            if (Simulation.Outcome == Outcome.Running)
            {
                Simulation.End(Outcome.Interrupted, "stopped by hand after step " + Simulation.StepCount);
            }
            _results.Finish(Simulation);
            _results.Dispose();
            _results = null;
        }

        private void Note(string what)
        {
            if (_results != null && !_isNoted)
            {
                _isNoted = true;
                _results.Note(what + " from step " + Simulation.StepCount + " on");
            }
        }
    }

    /// <summary>Bytes of a session's state: a line that says of what they are and whether they are whole, and the
    /// numbers that a run goes on from.</summary>
    internal static class SessionSnapshot
    {
        private const string Magic = "guidewire-snapshot";
        private const int LongestHead = 256;       // bytes of the line

        /// <summary>Gives the bytes of a state.</summary>
        /// <param name="numbers">All that the next steps depend on.</param>
        /// <param name="hash">Of the parameters.</param>
        /// <param name="isSteered">Whether a user moves the hubs.</param>
        public static byte[] Of(byte[] numbers, string hash, bool isSteered)
        {
            byte[] head = Encoding.ASCII.GetBytes(Head(numbers, hash, isSteered));
            var saved = new byte[head.Length + numbers.Length];
            head.CopyTo(saved, 0);
            numbers.CopyTo(saved, head.Length);
            return saved;
        }

        /// <summary>Gives the numbers of such bytes, for a session with these parameters.</summary>
        /// <param name="isOfThisBuild">Whether this build of the program has saved them.</param>
        /// <exception cref="ParameterException">They are of other parameters, of another format, or not
        /// whole.</exception>
        public static byte[] NumbersOf(byte[] saved, string hash, bool isSteered, out bool isOfThisBuild)
        {
            int end = Array.IndexOf(saved, (byte)'\n', 0, Math.Min(saved.Length, LongestHead)) + 1;
            var numbers = new byte[saved.Length - end];
            Array.Copy(saved, end, numbers, 0, numbers.Length);
            string[] head = Encoding.ASCII.GetString(saved, 0, end).Split(' ');
            string[] here = Head(numbers, hash, isSteered).Split(' ');
            if (head.Length == here.Length - 1)
            {
                head = head.Take(1).Append("1").Concat(head.Skip(1)).ToArray();    // version 1 did not always state it
            }
            if (head.Length == here.Length && head[0] == Magic && int.TryParse(head[1], NumberStyles.None,
                    CultureInfo.InvariantCulture, out int format) && format != FileFormat.Version)
            {
                throw new ParameterException("the snapshot has format " + format + ": guidewire "
                    + ProgramVersion.Number + " reads format " + FileFormat.Version + ": save it anew");
            }
            // Of another build the parameters may have had fewer keys: their hash says nothing then.
            isOfThisBuild = head.Length == here.Length && head[3] == here[3];
            if (head.Length != here.Length || head[0] != Magic || (isOfThisBuild && head[2] != here[2])
                || head[4] != here[4] || head[5] != here[5])
            {
                throw new ParameterException("the snapshot was not saved by a session with these parameters, "
                    + "or is incomplete");
            }
            return numbers;
        }

        // What a snapshot must agree in with who reads it, and a sum that says whether it is whole.
        private static string Head(byte[] numbers, string hash, bool isSteered)
        {
            using SHA256 sha = SHA256.Create();
            string sum = BitConverter.ToString(sha.ComputeHash(numbers), 0, 8).Replace("-", "");
            string holds = isSteered ? "hand" : "drive";
            return string.Join(" ", Magic, FileFormat.Version, hash, RunSummary.CoreBuild, holds, sum) + "\n";
        }
    }

    /// <summary>The force beyond which a hub slips in the hand, where the parameters state none: the push at which the
    /// instrument, coiled up in its lumen, is strained by what it bears without yielding.</summary>
    /// <remarks>A shaft of bending stiffness EI under a thrust F lies as a helix on the wall of a lumen whose clearance
    /// from its axis is r, with the pitch p = 2 pi sqrt(2 EI/F) (Lubinski, Althouse and Logan 1962, J Petrol Technol
    /// 14:655). Its curvature r (2 pi/p)^2 = F r/(2 EI) strains the outer fibre, at the radius a, by F r a/(2 EI).
    /// Nitinol and steel of instruments bear about <see cref="Elastic"/>.</remarks>
    internal static class HandLimit
    {
        private const double Elastic = 0.01;    // strain

        // Of an element of a pbd wire, which has no force: half of that which loses a run where it stays. A wire that
        // is pushed freely through an arch has 0.04.
        private const double Slip = 0.1;

        /// <summary>A hand, whose pbd wire slips before it is lost if it is limited.</summary>
        public static Steering Hand(bool isLimited) =>
            new Steering { SlipStrain = isLimited ? Slip : double.PositiveInfinity };

        /// <summary>Sets the hubForceLimit of each hub that has none, where the method takes one.</summary>
        public static void Set(SimulationParameters parameters)
        {
            SceneParameters scene = parameters.Scene;
            if (!MethodTable.Of(parameters.Method.Solver).TakesMaterial || scene.Walls.Length == 0
                || !ParameterTable.Find("hubForceLimit")!.IsTakenBy(parameters.Method.Solver))
            {
                return;
            }
            double clearance = Clearance(parameters) * scene.MetresPerUnit;
            if (clearance == 0.0)
            {
                return;
            }
            parameters.Drive.HubForceLimit = Limit(parameters.Drive, parameters.Material, clearance);
            foreach (Catheter catheter in scene.Catheters)
            {
                catheter.Drive.HubForceLimit = Limit(catheter.Drive, catheter.Material, clearance);
            }
        }

        private static double Limit(DriveParameters drive, MaterialParameters material, double clearance)
        {
            double stiffness = material.YoungsModulus * material.SecondMomentOfArea;
            return !double.IsNaN(drive.HubForceLimit) ? drive.HubForceLimit
                : Math.Min(HubLimit.Grip, 2.0 * stiffness * Elastic / (clearance * material.WireRadius));
        }

        // The widest place of the lumen in which the straight wire lies at the start, units: there it buckles first.
        private static double Clearance(SimulationParameters parameters)
        {
            SceneParameters scene = parameters.Scene;
            double widest = 0.0;
            for (int i = 0; i <= scene.NumberRodElements; i++)
            {
                var node = new Vector3d(0.0, 0.0,
                    scene.GuidewireOffset + scene.GuidewireLength * i / scene.NumberRodElements);
                double least = double.PositiveInfinity;
                foreach (ContactShape wall in scene.Walls)
                {
                    int hint = -1;
                    if (!wall.Contains(node))
                    {
                        least = 0.0;
                    }
                    else if (wall.Nearest(node, node, double.PositiveInfinity, ref hint, out SurfaceContact contact))
                    {
                        least = Math.Min(least, contact.Distance);
                    }
                }
                widest = double.IsInfinity(least) ? widest : Math.Max(widest, least);
            }
            return widest;
        }
    }
}
