using System;
using System.IO;
using Guidewire.Io;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Cli
{
    /// <summary>Takes one run after another, so that a sweep pays for no process start: a JSON request a line, a JSON
    /// answer a line. A request that cannot be run gets its answer and the next one is taken.</summary>
    internal static class RequestLoop
    {
        /// <summary>Serves until the end of the input, or until a stop is requested.</summary>
        /// <param name="input">The requests.</param>
        /// <param name="output">Takes the answers.</param>
        /// <param name="execute">What is done with the parameters of a request for a run.</param>
        /// <param name="stopRequested">Asked between requests, and between the steps of a session.</param>
        public static int Serve(TextReader input, TextWriter output,
            Func<RunRequest, ParameterHandler, RunResult> execute, Func<bool> stopRequested)
        {
            var meshes = new KeptMeshes(SessionHost.MeshesKept);
            var sessions = new SessionHost(stopRequested, meshes);
            var mesh = new LastMesh(meshes);
            string? line;
            while (!stopRequested() && (line = input.ReadLine()) != null)
            {
                if (line.Trim().Length == 0)
                {
                    continue;
                }
                output.WriteLine(Answer(line, execute, sessions, mesh).ToString(Formatting.None));
                output.Flush();
            }
            return stopRequested() ? ExitCodes.Of(Core.Outcome.Interrupted) : 0;
        }

        private static JObject Answer(string line, Func<RunRequest, ParameterHandler, RunResult> execute,
            SessionHost sessions, LastMesh mesh)
        {
            var answer = new JObject
            {
                ["id"] = null,
                ["exitCode"] = ExitCodes.BadInput,
                ["outcome"] = null,
                ["message"] = "",
                ["out"] = null,
            };
            string? folder = null;
            bool isRead = false;
            try
            {
                RunRequest request = RunRequest.Parse(line);
                isRead = true;
                answer["id"] = request.Id;
                if (request.Session != null)
                {
                    sessions.Answer(request, answer);
                    answer["exitCode"] = 0;
                    return answer;
                }
                ParameterHandler handler = ParameterHandler.Load(
                    ParameterSource.OfRequest(request.ParameterFile, mesh), request.Overrides, false);
                if (request.IsCheck)
                {
                    answer["exitCode"] = 0;
                    answer["address"] = RunSummary.Address(handler);
                    answer["version"] = RunSummary.Maker;
                    return answer;
                }
                folder = string.IsNullOrEmpty(request.Out) ? handler.Values.LogFilePath : request.Out;
                answer["out"] = folder;
                RunResult result = execute(request, handler);
                answer["exitCode"] = ExitCodes.Of(result.Outcome);
                answer["outcome"] = result.Word;
                answer["message"] = result.Reason;
            }
            catch (ParameterException error)
            {
                answer["message"] = error.Message;
                if (!isRead)
                {
                    answer["id"] = RunRequest.IdOf(line);
                }
            }
            catch (Exception error)
            {
                answer["exitCode"] = ExitCodes.Internal;
                answer["message"] = ErrorTrace.Write(error, folder);
            }
            return answer;
        }
    }
}
