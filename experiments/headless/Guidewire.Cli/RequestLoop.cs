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
        public static int Serve(TextReader input, TextWriter output, Func<bool> stopRequested)
        {
            string? line;
            while (!stopRequested() && (line = input.ReadLine()) != null)
            {
                if (line.Trim().Length == 0)
                {
                    continue;
                }
                output.WriteLine(Answer(line, stopRequested).ToString(Formatting.None));
                output.Flush();
            }
            return stopRequested() ? ExitCodes.Of(Core.Outcome.Interrupted) : 0;
        }

        private static JObject Answer(string line, Func<bool> stopRequested)
        {
            var answer = new JObject
            {
                ["id"] = RunRequest.IdOf(line),
                ["exitCode"] = ExitCodes.BadInput,
                ["outcome"] = null,
                ["message"] = "",
                ["out"] = null,
                ["reused"] = false,
            };
            string? folder = null;
            try
            {
                RunRequest request = RunRequest.Parse(line);
                ParameterHandler handler = ParameterHandler.Load(request.ParameterFile, request.Overrides);
                var run = new SimulationRun(handler, request.Out, request.Repeat) { StopRequested = stopRequested };
                folder = run.Folder;
                answer["out"] = folder;
                RunResult result = run.Execute(request.Reuse);
                answer["exitCode"] = ExitCodes.Of(result.Outcome);
                answer["outcome"] = result.Word;
                answer["message"] = result.Reason;
                answer["reused"] = result.Reused;
            }
            catch (ParameterException error)
            {
                answer["message"] = error.Message;
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
