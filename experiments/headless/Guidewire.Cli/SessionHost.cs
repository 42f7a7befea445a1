using System;
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
        private readonly Func<bool> _stopRequested;
        private SimulationSession? _session;
        private readonly SessionState _state = new SessionState();
        private byte[] _bytes = Array.Empty<byte>();

        /// <param name="stopRequested">Asked before every step.</param>
        public SessionHost(Func<bool> stopRequested)
        {
            _stopRequested = stopRequested;
        }

        /// <summary>Does what a request asks for and fills its answer.</summary>
        /// <exception cref="ParameterException">A request that cannot be met; nothing has changed.</exception>
        public void Answer(RunRequest request, JObject answer)
        {
            switch (request.Session)
            {
                case "open":
                    _session = SimulationSession.Open(request.ParameterFile, request.Overrides, request.Hand);
                    answer["hand"] = _session.IsSteered;
                    answer["warnings"] = new JArray(_session.Warnings);
                    answer["effective"] = _session.EffectiveParameters;
                    break;
                case "step":
                    Step(request.Push / request.Steps, request.Turn / request.Steps, request.Steps);
                    break;
                case "change":
                    Change(Opened(), request);
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
                    Opened().Restore(Bytes(request.Snapshot));
                    break;
                default:
                    throw new ParameterException("request", "session", "\"" + request.Session + "\"",
                        "one of \"open\", \"step\", \"state\", \"change\", \"reset\", \"save\", \"restore\"");
            }
            State(_session!.Simulation, answer);
        }

        private SimulationSession Opened()
        {
            return _session ?? throw new ParameterException("request: no session is open: \"session\": \"open\" opens one");
        }

        private static void Change(SimulationSession session, RunRequest request)
        {
            try
            {
                session.Set(request.Overrides);
            }
            catch (ArgumentException error)
            {
                throw new ParameterException("request: " + error.Message);
            }
        }

        /// <summary>Makes steps, as many as the run still has.</summary>
        /// <param name="push">In each step, of a session that is steered, units.</param>
        /// <param name="turn">In each step, rad.</param>
        /// <exception cref="ParameterException">The session cannot be stepped so; nothing has changed.</exception>
        public Simulation Step(double push, double turn, int steps)
        {
            SimulationSession session = Opened();
            if (!session.IsSteered && (push != 0.0 || turn != 0.0))
            {
                throw new ParameterException("request: push and turn need a steered session; here the parameters'"
                    + " drive moves the wire (open it with \"hand\": true to steer it)");
            }
            if (session.Simulation.Outcome != Outcome.Running)
            {
                throw new ParameterException("request: the run has ended after step " + session.Simulation.StepCount
                    + " (" + session.Simulation.Outcome.ToString().ToLowerInvariant() + ": "
                    + session.Simulation.Reason + "): reset or restore goes on from where it had not");
            }
            for (int k = 0; k < steps && session.Simulation.Outcome == Outcome.Running && !_stopRequested(); k++)
            {
                session.Step(push, turn);
            }
            return session.Simulation;
        }

        private static byte[] Bytes(string text)
        {
            try
            {
                return Convert.FromBase64String(text);
            }
            catch (FormatException)
            {
                throw new ParameterException("request: snapshot is no base64");
            }
        }

        private void State(Simulation simulation, JObject answer)
        {
            bool hasEnded = simulation.Outcome != Outcome.Running;
            answer["outcome"] = hasEnded ? simulation.Outcome.ToString().ToLowerInvariant() : null;
            answer["message"] = simulation.Reason;
            answer["step"] = simulation.StepCount;
            answer["time"] = simulation.Time;
            answer["predictionError"] = simulation.PredictionError;
            _state.Read(simulation);
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
