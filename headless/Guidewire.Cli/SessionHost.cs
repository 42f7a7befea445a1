using System;
using System.Collections.Generic;
using System.Linq;
using System.Runtime.InteropServices;
using Guidewire.Core;
using Guidewire.Io;
using Newtonsoft.Json.Linq;

namespace Guidewire.Cli
{
    /// <summary>The run that requests step by hand, one at a time in a process: opened, stepped, saved, restored, set
    /// back. Its state stands in each answer, arrays as base64 of little-endian doubles, so that they keep their
    /// bits.</summary>
    internal sealed class SessionHost
    {
        /// <summary>Meshes that a process keeps for its sessions: those of the few vessels that they have.</summary>
        public const int MeshesKept = 6;

        private readonly Func<bool> _stopRequested;
        private readonly LastMesh _mesh;       // for the sessions that are opened here one after another
        private SimulationSession? _session;
        private readonly SessionState _state = new SessionState();
        private byte[] _bytes = Array.Empty<byte>();
        private RunPictures? _pictures;
        private readonly List<Vector3d[]> _centrelines = new List<Vector3d[]>();
        private readonly List<Vector3d[]> _displacements = new List<Vector3d[]>();

        /// <param name="stopRequested">Asked before every step.</param>
        /// <param name="meshes">Meshes that other sessions have read, too.</param>
        public SessionHost(Func<bool> stopRequested, KeptMeshes meshes)
        {
            _stopRequested = stopRequested;
            _mesh = new LastMesh(meshes);
        }

        /// <summary>Does what a request asks for and fills its answer.</summary>
        /// <exception cref="ParameterException">A request that cannot be met; nothing has changed.</exception>
        public void Answer(RunRequest request, JObject answer)
        {
            switch (request.Session)
            {
                case "open":
                    _pictures = null;
                    _session = SimulationSession.Open(request.ParameterFile, request.Overrides, request.Hand, _mesh);
                    if (request.Record)
                    {
                        _session.RecordSteering();
                    }
                    answer["hand"] = _session.IsSteered;
                    answer["warnings"] = new JArray(_session.Warnings);
                    answer["effective"] = _session.EffectiveParameters;
                    break;
                case "step":
                    Step(Motion(request), request.Steps);
                    break;
                case "picture":
                    TakePicture(request, answer);
                    return;
                case "describe":
                    Describe(answer);
                    return;
                case "agent":
                    answer["agent"] = Text(AgentRequest.Answer(Opened(), request, answer));
                    return;
                case "walls":
                    answer["walls"] = Convert.ToBase64String(Walls(request.Middle, request.Reach, Doubles(request)));
                    return;
                case "places":
                    TakePlaces(request, answer);
                    return;
                case "drive":
                    answer["tables"] = new JArray(Opened().DriveTables());
                    return;
                case "change":
                    _pictures = null;
                    Change(() => Opened().Set(request.Overrides));
                    answer["effective"] = _session!.EffectiveParameters;
                    break;
                case "exchange":
                    Change(() => Opened().Exchange(request.Hub, request.Overrides));
                    _pictures = null;
                    answer["effective"] = _session!.EffectiveParameters;
                    break;
                case "reset":
                    Opened().Reset();
                    break;
                case "state":
                    Opened();
                    break;
                case "save":
                    answer["snapshot"] = Convert.ToBase64String(Opened().Save());
                    return;
                case "restore":
                    Opened().Restore(Bytes(request.Snapshot, "snapshot"));
                    break;
                default:
                    throw new ParameterException("request", "session", "\"" + request.Session + "\"",
                        "one of \"open\", \"step\", \"state\", \"picture\", \"describe\", \"places\", \"walls\","
                            + " \"agent\", \"drive\", \"change\", \"exchange\", \"reset\", \"save\", \"restore\"");
            }
            if (_session!.Unrecorded is string why && request.Session != "step")
            {
                answer["unrecorded"] = why;
            }
            State(_session.Simulation, answer);
        }

        /// <summary>The session as it is now.</summary>
        /// <exception cref="ParameterException">No session is open.</exception>
        public SimulationSession Session => Opened();

        private SimulationSession Opened()
        {
            return _session
                ?? throw new ParameterException("request: no session is open: \"session\": \"open\" opens one");
        }

        private static void Change(Action change)
        {
            try
            {
                change();
            }
            catch (ArgumentException error)
            {
                throw new ParameterException("request: " + error.Message);
            }
        }

        /// <summary>Makes steps, as many as the run still has.</summary>
        /// <param name="motion">Push (units) and turn (rad) of each hub in each step, the wire's first, of a session
        /// that is steered; the last ones may be left out and rest.</param>
        /// <param name="steps">How many.</param>
        /// <exception cref="ParameterException">The session cannot be stepped so; nothing has changed.</exception>
        public Simulation Step(ReadOnlySpan<double> motion, int steps)
        {
            SimulationSession session = Opened();
            if (!session.IsSteered && motion.Trim(0.0).Length > 0)
            {
                throw new ParameterException("request: push and turn need a steered session; here the parameters'"
                    + " drive moves the wire (open it with \"hand\": true to steer it)");
            }
            session.CheckHub((motion.Length - 1) / 2);
            if (session.Simulation.Outcome != Outcome.Running)
            {
                throw new ParameterException("request: the run has ended after step " + session.Simulation.StepCount
                    + " (" + session.Simulation.Outcome.ToString().ToLowerInvariant() + ": "
                    + session.Simulation.Reason + "): reset or restore continues from an earlier state");
            }
            for (int k = 0; k < steps && session.Simulation.Outcome == Outcome.Running && !_stopRequested(); k++)
            {
                session.Step(motion);
            }
            return session.Simulation;
        }

        // In each step, of as many hubs as the request moves.
        private double[] Motion(RunRequest request)
        {
            bool isOfAll = request.Pushes != null || request.Turns != null;
            Opened().CheckHub(isOfAll ? 0 : request.Hub);
            int hubs = isOfAll ? Opened().InstrumentCount : request.Hub + 1;
            var motion = new double[2 * hubs];
            if (isOfAll)
            {
                Put(request.Pushes, "push", 0, request.Steps, motion);
                Put(request.Turns, "turn", 1, request.Steps, motion);
            }
            else
            {
                motion[^2] = request.Push / request.Steps;
                motion[^1] = request.Turn / request.Steps;
            }
            return motion;
        }

        private static void Put(double[]? values, string key, int place, int steps, double[] motion)
        {
            if (values != null && 2 * values.Length != motion.Length)
            {
                throw new ParameterException("request", key, values.Length + " numbers", "one for each of the "
                    + motion.Length / 2 + " hubs");
            }
            for (int hub = 0; values != null && hub < values.Length; hub++)
            {
                motion[2 * hub + place] = values[hub] / steps;
            }
        }

        /// <summary>Takes a fluoroscopic picture.</summary>
        /// <param name="view">Which.</param>
        /// <param name="positions">x, y and z of each node of the wire and then of each catheter, units; and, if known,
        /// of the displacement of soft walls at each element, m. None: as they are now.</param>
        /// <param name="grey">Takes the grey levels, row by row.</param>
        /// <exception cref="ParameterException">No session is open, or another number of nodes.</exception>
        public void Picture(PictureView view, ReadOnlySpan<double> positions, Span<byte> grey)
        {
            SimulationSession session = Opened();
            _pictures ??= new RunPictures(session.Parameters);
            TakeCentrelines(session.Simulation, positions);
            if (_pictures.Contrast != session.Contrast?.Flow)
            {
                _pictures.Contrast = session.Contrast?.Flow;
            }
            _pictures.Draw(_centrelines, view, grey, _displacements,
                positions.Length == 0 ? session.Simulation : null);
        }

        // Those of a request, or as they are now.
        private void TakeCentrelines(Simulation simulation, ReadOnlySpan<double> positions)
        {
            _centrelines.Clear();
            _centrelines.AddRange(simulation.Centrelines());
            _displacements.Clear();
            _displacements.AddRange(SoftWallDisplacements.Of(simulation));
            if (positions.Length == 0)
            {
                return;
            }
            int nodes = _centrelines.Sum(one => one.Length);
            int elements = _displacements.Sum(one => one.Length);
            if (positions.Length != 3 * nodes && positions.Length != 3 * (nodes + elements))
            {
                throw new ParameterException("request: positions needs to be of " + nodes
                    + " nodes" + (elements > 0 ? ", and may have displacements of walls at " + elements + " elements"
                    : "") + ", three numbers each");
            }
            TakeVectors(positions.Slice(0, 3 * nodes), _centrelines);
            if (positions.Length > 3 * nodes)
            {
                TakeVectors(positions.Slice(3 * nodes), _displacements);
            }
            else
            {
                _displacements.Clear();
            }
        }

        // In arrays of their own, as long as those that are there.
        private static void TakeVectors(ReadOnlySpan<double> numbers, List<Vector3d[]> lists)
        {
            ReadOnlySpan<Vector3d> vectors = MemoryMarshal.Cast<double, Vector3d>(numbers);
            int start = 0;
            for (int k = 0; k < lists.Count; k++)
            {
                lists[k] = vectors.Slice(start, lists[k].Length).ToArray();
                start += lists[k].Length;
                if (!Array.TrueForAll(lists[k], vector => vector.IsFinite))
                {
                    throw new ParameterException("request: positions needs finite numbers");
                }
            }
        }

        /// <summary>The walls as <see cref="SessionWalls"/> has them.</summary>
        /// <param name="middle">Where the picture's middle is, units; null: between the
        /// wire's ends.</param>
        /// <param name="reach">How far from there a wall without end is drawn, units; null: as far as the wire is
        /// long.</param>
        /// <param name="positions">As of <see cref="Picture"/>; none: walls are at rest.</param>
        /// <exception cref="ParameterException">No session is open, or another number of nodes.</exception>
        public byte[] Walls(Vector3d? middle = null, double? reach = null, ReadOnlySpan<double> positions = default)
        {
            SimulationSession session = Opened();
            TakeCentrelines(session.Simulation, positions);
            if (positions.Length == 0)
            {
                _displacements.Clear();
            }
            Vector3d[] wire = session.Simulation.State.Positions;
            double length = 0.0;
            for (int i = 1; i < wire.Length; i++)
            {
                length += (wire[i] - wire[i - 1]).Length;
            }
            return SessionWalls.ToBytes(session.Parameters, middle ?? 0.5 * (wire[0] + wire[^1]), reach ?? length,
                _centrelines, _displacements);
        }

        // What X-rays see of the instruments, and the path to the target, for whoever draws pictures of their own.
        private void Describe(JObject answer)
        {
            SimulationSession session = Opened();
            _pictures ??= new RunPictures(session.Parameters);
            answer["millimetresPerUnit"] = _pictures.MillimetresPerUnit;
            var instruments = new JArray();
            for (int k = 0; k < _pictures.Instruments.Count; k++)
            {
                ImagedInstrument instrument = _pictures.Instruments[k];
                var described = new JObject
                {
                    ["title"] = session.TitleOf(k),
                    ["name"] = session.NameOf(k),
                    ["key"] = SimulationSession.KeyOf(k),
                    ["choices"] = new JArray(session.ChoicesOf(k)),
                    ["radii"] = new JArray(instrument.Radii),
                    ["innerRadii"] = new JArray(instrument.InnerRadii),
                    ["attenuations"] = new JArray(instrument.Attenuations),
                    ["bands"] = new JArray(instrument.Bands.Select(band => new JArray(band.Element, band.From, band.To,
                        band.Attenuation))),
                };
                AddLoads(session.Parameters, k, described);
                instruments.Add(described);
            }
            answer["instruments"] = instruments;
            answer["cells"] = AgentRequest.Cells(session.Contrast?.Flow, _pictures.MillimetresPerUnit);
            answer["target"] = session.RouteToTarget();
            answer["motions"] = new JArray(session.Parameters.Scene.Walls.Select(wall => MotionOf(wall.Motion)));
            answer["patient"] = session.Parameters.Scene.PatientAxes is PatientAxes axes ? new JObject
            {
                ["left"] = Vector(axes.Left),
                ["chest"] = Vector(axes.Chest),
                ["head"] = Vector(axes.Head),
                ["origin"] = session.Parameters.Scene.PatientOrigin is Vector3d origin ? Vector(origin) : null,
            }
            : null;
        }

        // What pictures draw of a wall's motion, cycle by cycle; nothing where it stands still.
        private static JArray MotionOf(WallMotion? motion)
        {
            const int Phases = 32;
            var cycles = new JArray();
            for (int m = 0; m < (motion?.Cycles.Count ?? 0); m++)
            {
                var points = motion!.PointsOf(m).SelectMany(branch => branch).DefaultIfEmpty()
                    .SelectMany(point => new[] { (float)point.X, (float)point.Y, (float)point.Z }).ToArray();
                cycles.Add(new JObject
                {
                    ["period"] = motion.Cycles[m].Period,
                    ["phase"] = motion.Cycles[m].Phase,
                    ["ramp"] = motion.RampTime,
                    ["spacing"] = motion.Spacing,
                    ["points"] = Floats(points),
                    ["displacements"] = Floats(motion.Displacements(m, Phases)),
                });
            }
            return cycles;
        }

        private static string Floats(float[] numbers) =>
            Convert.ToBase64String(MemoryMarshal.AsBytes<float>(numbers));

        // The loads at which an instrument of a material bows out, N; nothing of one with gains.
        private static void AddLoads(SimulationParameters parameters, int instrument, JObject described)
        {
            if (MethodTable.Of(parameters.Method.Solver).TakesMaterial)
            {
                SceneParameters scene = parameters.Scene;
                Catheter? catheter = instrument == 0 ? null : scene.Catheters[instrument - 1];
                MaterialParameters material = catheter?.Material ?? parameters.Material;
                described["tipLoad"] = BucklingLoad.OfTip(material, catheter?.Length ?? scene.GuidewireLength,
                    scene.MetresPerUnit);
                described["shaftLoad"] = BucklingLoad.OfShaft(material);
            }
        }

        // Where the wire is in its vessel, of as many states as there are positions: rows as of the array "lumen".
        private void TakePlaces(RunRequest request, JObject answer)
        {
            SimulationSession session = Opened();
            double[] numbers = Doubles(request);
            int nodes = session.Simulation.State.SphereCount;
            if (numbers.Length % (3 * nodes) != 0)
            {
                throw new ParameterException("request: positions needs to be of " + nodes
                    + " nodes a state, three numbers each");
            }
            _state.ReadPlaces(session, numbers, nodes);
            answer["lumen"] = Text(_state.Numbers.AsSpan(0, _state.Count));
        }

        private static JArray Vector(in Vector3d vector) => new JArray(vector.X, vector.Y, vector.Z);

        private void TakePicture(RunRequest request, JObject answer)
        {
            PictureView view = PictureRequest.Read(request.View);
            double[] positions = Doubles(request);
            var grey = new byte[view.Pixels * view.Pixels];
            Picture(view, positions, grey);
            answer["pixels"] = view.Pixels;
            answer["grey"] = Convert.ToBase64String(grey);
        }

        private static double[] Doubles(RunRequest request)
        {
            byte[] bytes = Bytes(request.Positions, "positions");
            if (bytes.Length % sizeof(double) != 0)
            {
                throw new ParameterException("request: positions needs whole doubles");
            }
            var positions = new double[bytes.Length / sizeof(double)];
            Buffer.BlockCopy(bytes, 0, positions, 0, bytes.Length);
            return positions;
        }

        private static byte[] Bytes(string text, string name)
        {
            try
            {
                return Convert.FromBase64String(text);
            }
            catch (FormatException)
            {
                throw new ParameterException("request: " + name + " is no base64");
            }
        }

        private void State(Simulation simulation, JObject answer)
        {
            bool hasEnded = simulation.Outcome != Outcome.Running;
            answer["outcome"] = hasEnded ? simulation.Outcome.ToString().ToLowerInvariant() : null;
            answer["reliable"] = hasEnded ? simulation.IsReliable : (bool?)null;
            answer["message"] = simulation.Reason;
            answer["step"] = simulation.StepCount;
            answer["time"] = simulation.Time;
            answer["predictionError"] = simulation.PredictionError;
            _state.Read(Opened());
            int start = 0;
            foreach (SessionState.Field field in _state.Fields)
            {
                answer[field.Name] = Text(_state.Numbers.AsSpan(start, field.Count));
                start += field.Count;
            }
        }

        private string Text(ReadOnlySpan<double> numbers)
        {
            if (_bytes.Length < sizeof(double) * numbers.Length)
            {
                _bytes = new byte[sizeof(double) * numbers.Length];
            }
            Span<byte> bytes = _bytes.AsSpan(0, sizeof(double) * numbers.Length);
            for (int k = 0; k < numbers.Length; k++)
            {
                System.Buffers.Binary.BinaryPrimitives.WriteDoubleLittleEndian(bytes.Slice(sizeof(double) * k),
                    numbers[k]);
            }
            return Convert.ToBase64String(bytes);
        }
    }
}
