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
                    Step(Opened(), request);
                    break;
                case "change":
                    Change(Opened(), request);
                    answer["effective"] = _session!.EffectiveParameters;
                    break;
                case "reset":
                    Opened().Reset();
                    break;
                case "save":
                    answer["snapshot"] = Convert.ToBase64String(Opened().Save());
                    return;
                case "restore":
                    Opened().Restore(Bytes(request.Snapshot));
                    break;
                default:
                    throw new ParameterException("request", "session", "\"" + request.Session + "\"",
                        "one of \"open\", \"step\", \"change\", \"reset\", \"save\", \"restore\"");
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

        // The push and turn of a request are distributed evenly over its steps.
        private void Step(SimulationSession session, RunRequest request)
        {
            if (!session.IsSteered && (request.Push != 0.0 || request.Turn != 0.0))
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
            for (int k = 0; k < request.Steps && session.Simulation.Outcome == Outcome.Running && !_stopRequested(); k++)
            {
                session.Step(request.Push / request.Steps, request.Turn / request.Steps);
            }
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
            RodState state = simulation.State;
            bool hasEnded = simulation.Outcome != Outcome.Running;
            answer["outcome"] = hasEnded ? simulation.Outcome.ToString().ToLowerInvariant() : null;
            answer["message"] = simulation.Reason;
            answer["step"] = simulation.StepCount;
            answer["time"] = simulation.Time;
            answer["predictionError"] = simulation.PredictionError;
            answer["positions"] = Text(state.Positions);
            answer["velocities"] = Text(state.Velocities);
            answer["orientations"] = Text(state.Orientations);
            answer["angularVelocities"] = Text(state.AngularVelocities);
            if (simulation.Contacts is ContactRecord contacts)
            {
                answer["contactForces"] = Text(contacts.Forces);
                answer["reaction"] = Text(new[] { contacts.Reaction });
            }
            if (simulation.Hub() is HubRecord hub)
            {
                answer["hub"] = RunSummary.Hub(hub, state);
            }
            if (simulation.Stress() is StressRecord stress)
            {
                answer["strain"] = Text(stress.Strain);
                answer["force"] = Text(stress.Force);
                answer["curvature"] = Text(stress.Curvature);
                answer["couple"] = Text(stress.Couple);
                answer["energy"] = new JObject
                {
                    ["kineticEnergy"] = stress.KineticEnergy,
                    ["elasticEnergy"] = stress.ElasticEnergy,
                    ["potentialEnergy"] = stress.PotentialEnergy,
                };
            }
        }

        private string Text(Vector3d[] values)
        {
            Span<byte> bytes = Room(3 * values.Length);
            for (int i = 0; i < values.Length; i++)
            {
                Put(bytes, 3 * i, values[i].X);
                Put(bytes, 3 * i + 1, values[i].Y);
                Put(bytes, 3 * i + 2, values[i].Z);
            }
            return Convert.ToBase64String(bytes);
        }

        private string Text(Quaterniond[] values)
        {
            Span<byte> bytes = Room(4 * values.Length);
            for (int j = 0; j < values.Length; j++)
            {
                Put(bytes, 4 * j, values[j].X);
                Put(bytes, 4 * j + 1, values[j].Y);
                Put(bytes, 4 * j + 2, values[j].Z);
                Put(bytes, 4 * j + 3, values[j].W);
            }
            return Convert.ToBase64String(bytes);
        }

        private Span<byte> Room(int numbers)
        {
            if (_bytes.Length < sizeof(double) * numbers)
            {
                _bytes = new byte[sizeof(double) * numbers];
            }
            return _bytes.AsSpan(0, sizeof(double) * numbers);
        }

        private static void Put(Span<byte> bytes, int place, double value)
        {
            System.Buffers.Binary.BinaryPrimitives.WriteDoubleLittleEndian(bytes.Slice(sizeof(double) * place), value);
        }
    }
}
