using System;
using System.Collections.Concurrent;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Runtime.InteropServices;
using System.Threading;
using Guidewire.Core;
using Guidewire.Io;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Cli
{
    /// <summary>The console program: one run from its arguments, or one run after another from standard
    /// input.</summary>
    internal static class Program
    {
        private const string Usage =
            "usage: Guidewire.Cli -parameters FILE -out DIR [-force] [-KEY VALUE]...\n"
            + "       Guidewire.Cli -lines [-attached]      one JSON request a line on standard input, one answer a"
            + " line on standard output:\n"
            + "           {\"id\": TEXT, \"parameters\": FILE, \"set\": {KEY: VALUE}, \"out\": DIR, \"repeat\": K,"
            + " \"log\": true, \"check\": false}\n"
            + "           -attached: where the input ends, the run under way ends too, as by Ctrl-C\n"
            + "       Guidewire.Cli --modes FILE K   the K lowest frequencies and shapes of a material, as JSON\n"
            + "       Guidewire.Cli --mandrel FILE ANGLE [FROM TO]   the mandrel that leaves a bend (rad, units)\n"
            + "       Guidewire.Cli --keys      the parameters as a Markdown table\n"
            + "       Guidewire.Cli --warnings  the warnings as a Markdown table\n"
            + "       Guidewire.Cli --quantities  what logs, answers and summaries have, as JSON\n"
            + "       Guidewire.Cli --version\n"
            + "       Guidewire.Cli --help\n";

        private static int _stopRequested;

        private static bool StopRequested => Volatile.Read(ref _stopRequested) != 0;

        internal static int Main(string[] arguments)
        {
            var command = new RunCommand(logFileIsOurs: true);
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
                    case "keys":
                        Console.Out.Write(ParameterTable.ToMarkdown());
                        return 0;
                    case "--warnings":
                        Console.Out.Write(WarningTable.ToMarkdown());
                        return 0;
                    case "--quantities":
                        Console.Out.Write(Quantities.ToJson());
                        return 0;
                    case "--modes":
                        return PrintModes(arguments);
                    case "--mandrel":
                        return PrintMandrel(arguments);
                    case "--lines":
                    case "-lines":
                        return Serve(arguments);
                    default:
                        return RunOnce(arguments, command);
                }
            }
            catch (ParameterException error)
            {
                Console.Error.WriteLine("guidewire: " + error.Message);
                return ExitCodes.BadInput;
            }
            catch (Exception error)
            {
                Console.Error.WriteLine("guidewire: " + ErrorTrace.Write(error, command.Folder));
                return ExitCodes.Internal;
            }
        }

        private static RunResult Simulate(RunRequest request, ParameterHandler handler)
        {
            var run = new SimulationRun(handler, request.Out, request.Repeat)
            {
                StopRequested = () => StopRequested,
                KeepsLog = request.Log,
            };
            return run.Execute(Existing.Replace);
        }

        // Attached, the end of the input says that whoever started us is gone: nobody waits for the run under way, and
        // its folder should be free for whoever starts it again.
        private static int Serve(string[] arguments)
        {
            if (arguments.Length == 1)
            {
                return RequestLoop.Serve(Console.In, Console.Out, Simulate, () => StopRequested);
            }
            if (arguments.Length > 2 || arguments[1].TrimStart('-') != "attached")
            {
                throw new ParameterException(CommandLineHandler.Source + ": -lines takes -attached or nothing");
            }
            using var requests = new LinesAhead(Console.In, () => Volatile.Write(ref _stopRequested, 1));
            return RequestLoop.Serve(requests, Console.Out, Simulate, () => StopRequested);
        }

        private static int PrintMandrel(string[] arguments)
        {
            double[] numbers = Array.ConvertAll(arguments[Math.Min(2, arguments.Length)..],
                text => NumberText.TryRead(text, out double number) ? number : double.NaN);
            if ((numbers.Length != 1 && numbers.Length != 3) || !(Math.Abs(numbers[0]) > 0.0))
            {
                throw new ParameterException((arguments.Length > 1 ? arguments[1] : "--mandrel")
                    + ": --mandrel needs a parameter file, an angle (rad), and perhaps where the bend begins and ends");
            }
            SimulationParameters parameters = ParameterHandler.Load(arguments[1], Array.Empty<string>())
                .Values.Simulation;
            double end = numbers.Length == 3 ? numbers[2] : parameters.Scene.GuidewireLength - 2.0;
            var shaped = new Shaping
            {
                From = numbers.Length == 3 ? numbers[1] : end - 5.0, To = end, Angle = numbers[0],
            };
            double metres = parameters.Scene.MetresPerUnit;
            if (!(shaped.From >= 0.0) || !(shaped.To > shaped.From) || shaped.To > parameters.Scene.GuidewireLength
                || !(Mandrel.Find(shaped, parameters.Material, metres) is (double bent, double kept)))
            {
                throw new ParameterException(arguments[1] + ": no mandrel leaves that bend there: the core does not"
                    + " yield (material steel, annealedSteel or platinum, or a yieldStress), or not by so much");
            }
            Console.Out.WriteLine(new JObject
            {
                ["from"] = shaped.From,
                ["to"] = shaped.To,
                ["radius"] = Mandrel.RadiusOf(shaped, bent, parameters.Material, metres),
                ["bent"] = Math.Abs(numbers[0]) * bent / kept,
                ["strain"] = Mandrel.StrainOf(shaped, bent, parameters.Material),
            }.ToString(Formatting.None));
            return 0;
        }

        private static int PrintModes(string[] arguments)
        {
            if (arguments.Length != 3 || !int.TryParse(arguments[2], NumberStyles.None, CultureInfo.InvariantCulture,
                    out int count))
            {
                throw new ParameterException(CommandLineHandler.Source
                    + ": --modes needs a parameter file and a number");
            }
            ParameterHandler handler = ParameterHandler.Load(arguments[1], Array.Empty<KeyValuePair<string, JToken>>());
            string? walls = handler.Values.Vessel != null ? "vessel"
                : handler.Values.Simulation.Scene.Walls.Length > 0 ? "obstacles" : null;
            if (walls != null)
            {
                throw new ParameterException(arguments[1] + ": " + walls
                    + " needs to be null: modes are those of a wire"
                    + " without walls");
            }
            ModalAnalysis modes;
            try
            {
                modes = ModalAnalysis.Of(handler.Values.Simulation, count);
            }
            catch (ArgumentException error)
            {
                throw new ParameterException(arguments[1] + ": " + error.Message);
            }
            if (modes.Failure != null)
            {
                Console.Error.WriteLine("guidewire: " + modes.Failure);
                return ExitCodes.Of(Outcome.Failed);
            }
            var shapes = new JArray();
            foreach (Vector3d[] shape in modes.Shapes)
            {
                shapes.Add(Rows(shape));
            }
            Console.Out.WriteLine(new JObject
            {
                ["frequencies"] = new JArray(modes.Frequencies),
                ["positions"] = Rows(modes.Positions),
                ["shapes"] = shapes,
            }.ToString(Formatting.None));
            return 0;
        }

        private static JArray Rows(Vector3d[] vectors)
        {
            var rows = new JArray();
            foreach (Vector3d v in vectors)
            {
                rows.Add(new JArray(v.X, v.Y, v.Z));
            }
            return rows;
        }

        private static int RunOnce(string[] arguments, RunCommand command)
        {
            using var progress = new ProgressLine(command);
            command.Progress = progress.Show;
            command.StopRequested = () => StopRequested;
            command.Error = line =>
            {
                progress.Dispose();
                Console.Error.WriteLine("guidewire: " + line);
            };
            command.Say = line =>
            {
                progress.Dispose();
                Console.Out.WriteLine(line);
            };
            return command.Execute(arguments);
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

    /// <summary>Reads lines ahead of whoever takes them, so that the end of the input is known at once.</summary>
    internal sealed class LinesAhead : TextReader
    {
        private readonly BlockingCollection<string> _lines = new BlockingCollection<string>();

        /// <summary>Starts to read.</summary>
        /// <param name="input">The lines.</param>
        /// <param name="ended">Called, from another thread, where there are no more.</param>
        public LinesAhead(TextReader input, Action ended)
        {
            var reader = new Thread(() =>
            {
                string? line;
                while ((line = input.ReadLine()) != null)
                {
                    _lines.Add(line);
                }
                ended();
                _lines.CompleteAdding();
            });
            reader.IsBackground = true;
            reader.Start();
        }

        /// <inheritdoc/>
        public override string? ReadLine() => _lines.TryTake(out string? line, Timeout.Infinite) ? line : null;
    }

    /// <summary>One line on a terminal, written over again and again, that says how far a long run is; nothing where
    /// standard output or standard error is a file or a pipe.</summary>
    internal sealed class ProgressLine : IDisposable
    {
        private const double FirstAfter = 1000.0;     // ms
        private const double Every = 200.0;           // ms
        private const double Smoothing = 0.1;         // weight of the newest interval in the rate: some 2 s of it
        private const int NarrowestTerminal = 20;     // columns; what says less does not know

        private readonly RunCommand _command;
        private readonly bool _silent = Console.IsErrorRedirected || Console.IsOutputRedirected;
        private double _next = FirstAfter;
        private double _before;      // ms, when the line was last written
        private int _stepsBefore;    // steps done then
        private double _rate;        // steps/s
        private int _length;         // of the line on the screen

        /// <param name="command">The run.</param>
        public ProgressLine(RunCommand command)
        {
            _command = command;
        }

        /// <summary>Called after every step, with the wall time in ms.</summary>
        public void Show(Simulation simulation, double elapsed)
        {
            if (_silent || elapsed < _next)
            {
                return;
            }
            _next = elapsed + Every;
            double rate = 1000.0 * (simulation.StepCount - _stepsBefore) / (elapsed - _before);
            _rate = _rate == 0.0 ? rate : _rate + Smoothing * (rate - _rate);
            _before = elapsed;
            _stepsBefore = simulation.StepCount;
            Write(Line(simulation.StepCount, _command.MaxSteps, simulation.Time, _rate));
        }

        /// <summary>Takes the line off the screen.</summary>
        public void Dispose()
        {
            if (_length > 0)
            {
                Write("");
                Console.Error.Write('\r');
            }
        }

        /// <summary>What the line says; of a terminal of 80 columns it takes no second line.</summary>
        /// <param name="step">Steps done.</param>
        /// <param name="maxSteps">Steps of the run at most.</param>
        /// <param name="time">Simulated time in s.</param>
        /// <param name="rate">Steps a second of wall time.</param>
        private static string Line(int step, int maxSteps, double time, double rate)
        {
            return string.Format(CultureInfo.InvariantCulture,
                "step {0} of {1}, {2} left, {3} steps/s, t = {4:0.###} s, {5} x real time", step, maxSteps,
                Duration((maxSteps - step) / rate), Figures(rate), time, Figures(rate * time / step));
        }

        // Three figures, without an exponent.
        private static string Figures(double value) =>
            value.ToString(value >= 99.5 ? "0" : value >= 1e-3 ? "G3" : "0.0e+0", CultureInfo.InvariantCulture);

        private static string Duration(double seconds)
        {
            return seconds < 99.5 ? seconds.ToString("0", CultureInfo.InvariantCulture) + " s"
                : seconds < 99.5 * 60.0 ? (seconds / 60.0).ToString("0", CultureInfo.InvariantCulture) + " min"
                : (seconds / 3600.0).ToString("0.#", CultureInfo.InvariantCulture) + " h";
        }

        // A line as wide as the terminal would begin a new one.
        private void Write(string line)
        {
            string shown = line.Substring(0, Math.Min(line.Length, Columns() - 1));
            Console.Error.Write("\r" + shown.PadRight(_length));
            _length = shown.Length;
        }

        private static int Columns()
        {
            try
            {
                return Console.WindowWidth >= NarrowestTerminal ? Console.WindowWidth : 80;
            }
            catch (IOException)
            {
                return 80;
            }
        }
    }
}
