using System;
using System.IO;
using System.Runtime.InteropServices;
using System.Threading;
using Guidewire.Core;
using Guidewire.Io;

namespace Guidewire.Cli
{
    /// <summary>The console program: one run from its arguments, or one run after another from standard input.</summary>
    internal static class Program
    {
        private const string Usage =
            "usage: Guidewire.Cli -parameters FILE -out DIR [-KEY VALUE]...\n"
            + "       Guidewire.Cli -lines      one JSON request a line on standard input, one answer a line on standard output:\n"
            + "           {\"id\": TEXT, \"parameters\": FILE, \"set\": {KEY: VALUE}, \"out\": DIR, \"repeat\": K, \"reuse\": true}\n"
            + "       Guidewire.Cli --keys      the parameters as a Markdown table\n"
            + "       Guidewire.Cli --version\n"
            + "       Guidewire.Cli --help\n";

        private static int _stopRequested;

        private static bool StopRequested => Volatile.Read(ref _stopRequested) != 0;

        private static int Main(string[] arguments)
        {
            string? folder = null;
            try
            {
                using PosixSignalRegistration interrupt = OnSignal(PosixSignal.SIGINT);
                using PosixSignalRegistration terminate = OnSignal(PosixSignal.SIGTERM);
                switch (arguments.Length == 0 ? "" : arguments[0])
                {
                    case "":
                        Console.Error.WriteLine("guidewire: nothing to run: give -parameters FILE -out DIR, or --help");
                        return ExitCodes.BadInput;
                    case "--help":
                    case "-help":
                    case "-h":
                        Console.Out.Write(CommandLineHandler.Help(Usage));
                        return 0;
                    case "--version":
                    case "-version":
                        Console.Out.WriteLine("guidewire " + RunSummary.Version);
                        return 0;
                    case "--keys":
                    case "-keys":
                        Console.Out.Write(ParameterTable.ToMarkdown());
                        return 0;
                    case "--lines":
                    case "-lines":
                        return RequestLoop.Serve(Console.In, Console.Out, () => StopRequested);
                    default:
                        return RunOnce(arguments, out folder);
                }
            }
            catch (ParameterException error)
            {
                Console.Error.WriteLine("guidewire: " + error.Message);
                return ExitCodes.BadInput;
            }
            catch (Exception error)
            {
                Console.Error.WriteLine("guidewire: " + ErrorTrace.Write(error, folder));
                return ExitCodes.Internal;
            }
        }

        private static int RunOnce(string[] arguments, out string? folder)
        {
            folder = null;
            CommandLine line = CommandLineHandler.Read(arguments, logFileIsOurs: true);
            ParameterHandler handler = ParameterHandler.Load(line.ParameterFile, line.Overrides);
            var run = new SimulationRun(handler, line.Out, line.Repeat);
            folder = run.Folder;
            foreach (string warning in handler.Warnings)
            {
                Console.Error.WriteLine("guidewire: warning: " + warning);
            }
            run.StopRequested = () => StopRequested;
            using var progress = new ProgressLine(handler.Values.Simulation.MaxSimulationSteps);
            run.Progress = progress.Show;
            RunResult result = run.Execute(reuse: false);
            progress.Dispose();
            string ending = result.Word + ": " + result.Reason;
            if (result.Outcome == Outcome.Failed)
            {
                Console.Error.WriteLine("guidewire: " + ending);
            }
            else
            {
                Console.Out.WriteLine(ending + " -> " + run.Folder);
            }
            return ExitCodes.Of(result.Outcome);
        }

        private static PosixSignalRegistration OnSignal(PosixSignal signal)
        {
            return PosixSignalRegistration.Create(signal, context =>
            {
                context.Cancel = true;
                Volatile.Write(ref _stopRequested, 1);
            });
        }
    }
}
