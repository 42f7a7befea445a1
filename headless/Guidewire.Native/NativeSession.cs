using System;
using System.Text;
using Guidewire.Cli;
using Guidewire.Core;
using Guidewire.Io;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Native
{
    /// <summary>One session of the library. One thread asks it at a time.</summary>
    internal sealed class NativeSession
    {
        private readonly SessionHost _host;
        private readonly SessionState _state = new SessionState();
        private PictureView _picture = new PictureView();
        private byte[] _view = Array.Empty<byte>();    // the text of it

        /// <param name="meshes">Meshes that other sessions have read, too.</param>
        public NativeSession(KeptMeshes meshes)
        {
            _host = new SessionHost(() => false, meshes);
        }

        /// <summary>The answer for a number that no session has.</summary>
        public static string Closed => Refusal(ExitCodes.BadInput, "request: this session is closed");

        /// <summary>Why the last call was refused, as an answer.</summary>
        public string Problem { get; private set; } = "";

        /// <summary>Answers a request, as the runner does.</summary>
        public string Ask(string request)
        {
            var answer = new JObject { ["exitCode"] = 0 };
            try
            {
                _host.Answer(RunRequest.Parse(request), answer);
                return answer.ToString(Formatting.None);
            }
            catch (Exception error)
            {
                return Refusal(error);
            }
        }

        /// <summary>As <see cref="Exports.Step"/> says.</summary>
        public bool Step(ReadOnlySpan<double> motion, int steps, Span<double> head)
        {
            try
            {
                Simulation simulation = _host.Step(motion, steps);
                head[0] = simulation.StepCount;
                head[1] = simulation.Time;
                head[2] = simulation.Outcome == Outcome.Running ? 0.0 : 1.0;
                head[3] = simulation.PredictionError;
                return true;
            }
            catch (Exception error)
            {
                Problem = Refusal(error);
                return false;
            }
        }

        /// <summary>As <see cref="Exports.State"/> says.</summary>
        public int Read(StatePart part, Span<double> numbers)
        {
            try
            {
                _state.Read(_host.Session, part);
                if (numbers.Length >= _state.Count)
                {
                    _state.Numbers.AsSpan(0, _state.Count).CopyTo(numbers);
                }
                return _state.Count;
            }
            catch (Exception error)
            {
                Problem = Refusal(error);
                return -1;
            }
        }

        /// <summary>The walls of the open scene, as <see cref="SessionWalls"/> has them.</summary>
        public byte[] Walls() => _host.Walls();

        /// <summary>As <see cref="Exports.Picture"/> says.</summary>
        public int Picture(ReadOnlySpan<byte> view, ReadOnlySpan<double> positions, Span<byte> grey)
        {
            try
            {
                if (!view.SequenceEqual(_view))
                {
                    _picture = PictureRequest.Read(JsonText.ParseObject(Encoding.UTF8.GetString(view), "request"));
                    _view = view.ToArray();
                }
                int count = _picture.Pixels * _picture.Pixels;
                if (grey.Length == count)
                {
                    _host.Picture(_picture, positions, grey);
                }
                return count;
            }
            catch (Exception error)
            {
                Problem = Refusal(error);
                return 0;
            }
        }

        private static string Refusal(Exception error)
        {
            return error is ParameterException ? Refusal(ExitCodes.BadInput, error.Message)
                : Refusal(ExitCodes.Internal, ErrorTrace.Write(error, null));
        }

        private static string Refusal(int code, string message) =>
            new JObject { ["exitCode"] = code, ["message"] = message }.ToString(Formatting.None);
    }
}
