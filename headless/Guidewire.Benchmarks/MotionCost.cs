using Guidewire.Cli;
using Guidewire.Io;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Benchmarks
{
    /// <summary>What a scene's motion costs, in element-iterations of the scalar sweep for a simulated millisecond: the
    /// two are timed in turns in one process, so that the figure holds on a machine that does other things
    /// too.</summary>
    /// <remarks>The shortest time of each counts: a busy machine interrupts most turns of a long motion and hardly any
    /// of a short sweep, but not all of them. An element-iteration is the correction of one element's stretch and
    /// bend-twist, once, in a wire of n = 30. Finding the start, such as a rest shape, is not part of the
    /// motion.</remarks>
    internal static class MotionCost
    {
        /// <summary>Element-iterations of one step of <see cref="Sweep"/>.</summary>
        public const double ElementIterations = SweepElements * SweepIterations;

        private const int SweepElements = 30;
        private const int SweepIterations = 300;
        private const string Figure = "elementIterationsPerMillisecond";

        /// <summary>The sweep that a motion is timed against.</summary>
        public static SteppedWire Sweep() => new SteppedWire(SweepElements, SweepIterations, scalar => scalar);

        /// <summary>Measures the motion that a request describes, to its maxSimulationSteps, and writes
        /// parameters.json and summary.json into its folder.</summary>
        /// <exception cref="ParameterException">No folder is named, or there is nothing to time.</exception>
        public static RunResult Measure(RunRequest request, ParameterHandler handler)
        {
            SimulationParameters parameters = handler.Values.Simulation;
            if (string.IsNullOrEmpty(request.Out) || parameters.Method.MaxSimulationSteps == 0)
            {
                throw new ParameterException("request: a motion's cost needs a folder and at least one step");
            }
            string path = Path.Combine(request.Out!, RunSummary.FileName);
            Simulation motion = Simulation.Create(parameters);
            void Move()
            {
                while (motion.Outcome == Outcome.Running)
                {
                    motion.Step();
                }
            }
            var both = new Interleaved(Move, Sweep().Step, () => motion = Simulation.Create(parameters));
            double milliseconds = 1e3 * motion.Time;
            Directory.CreateDirectory(request.Out!);
            AtomicFile.Write(Path.Combine(request.Out!, "parameters.json"),
                handler.ToJson().ToString(Formatting.Indented) + "\n");
            AtomicFile.Write(path, new JObject
            {
                ["outcome"] = RunSummary.Word(motion.Outcome),
                ["reason"] = motion.Reason,
                ["steps"] = motion.StepCount,
                ["inGameTime"] = motion.Time,
                [Figure] = both.FirstBest / both.SecondBest * ElementIterations / milliseconds,
                ["wallTimePerSecond"] = 1e-6 * both.First / milliseconds,
                ["elementIterationTime"] = both.Second / ElementIterations,
                ["parameterHash"] = handler.Hash,
                ["complete"] = true,
            }.ToString(Formatting.Indented) + "\n");
            return new RunResult(motion.Outcome, motion.Reason, motion.Outcome == Outcome.Finished, false);
        }
    }

    /// <summary>What a fluoroscopic picture of a scene costs, in processor time of this thread's process, and against
    /// the steps of the scene.</summary>
    internal static class PictureCost
    {
        private const int Steps = 150;
        private const int Pictures = 2000;

        /// <summary>Makes steps, then takes pictures from one place, and prints both.</summary>
        /// <param name="file">A parameter file.</param>
        public static void Print(string file)
        {
            using SimulationSession session = SimulationSession.Open(
                file, Array.Empty<KeyValuePair<string, JToken>>(), false);
            Simulation run = session.Simulation;
            TimeSpan before = Processor();
            while (run.Outcome == Outcome.Running && run.StepCount < Steps)
            {
                run.Step();
            }
            double step = (Processor() - before).TotalMilliseconds / Math.Max(1, run.StepCount);
            var pictures = new RunPictures(session.Parameters);
            var centrelines = new List<Vector3d[]>(run.Centrelines());
            foreach ((int pixels, bool hasNoise) in new[] { (128, false), (256, false), (256, true), (512, true) })
            {
                var view = new PictureView { Pixels = pixels };
                view.Settings.Noise = hasNoise ? 0.03 : 0.0;
                view.Settings.Blur = hasNoise ? 0.3 : 0.0;
                var grey = new byte[pixels * pixels];
                TimeSpan start = default;
                for (int k = -Pictures / 2; k < Pictures; k++)
                {
                    start = k == 0 ? Processor() : start;
                    view.Settings.Seed = (uint)Math.Max(k, 0);
                    pictures.Draw(centrelines, view, grey);
                }
                double each = (Processor() - start).TotalMilliseconds / Pictures;
                Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                    "{0}, {1} x {1}{2}: {3:0.000} ms of a processor, {4:0} a second; {5:0.00} of a step ({6:0.00} ms)",
                    Path.GetFileName(file), pixels, hasNoise ? " with noise and blur" : "", each, 1e3 / each,
                        each / step,
                    step));
            }
        }

        private static TimeSpan Processor()
        {
            using var self = Process.GetCurrentProcess();
            return self.TotalProcessorTime;
        }
    }

    /// <summary>How many times faster than real time the scene of a parameter file runs: its steps, on one core, once
    /// its code is compiled as far as it will be.</summary>
    internal static class SceneRate
    {
        private const int WarmUp = 4;
        private const int Turns = 5;

        /// <summary>Makes the run in turns and prints the median and the best.</summary>
        /// <param name="file">A parameter file.</param>
        public static void Print(string file)
        {
            var rates = new List<double>();
            double first = 0.0;
            double iterations = 0.0;
            for (int k = 0; k < WarmUp + Turns; k++)
            {
                using SimulationSession session = SimulationSession.Open(
                    file, Array.Empty<KeyValuePair<string, JToken>>(), false);
                Simulation run = session.Simulation;
                long start = Stopwatch.GetTimestamp();
                while (run.Outcome == Outcome.Running)
                {
                    run.Step();
                }
                double seconds = (Stopwatch.GetTimestamp() - start) / (double)Stopwatch.Frequency;
                if (run.Outcome != Outcome.Finished || run.Contacts!.Passages > 0)
                {
                    throw new InvalidOperationException(run.Reason);
                }
                double rate = run.Time / seconds;
                first = k == 0 ? rate : first;
                iterations = run.Report()!.WallIterations / run.StepCount;
                if (k >= WarmUp)
                {
                    rates.Add(rate);
                }
            }
            rates.Sort();
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "{0}: {1:0.0} x real time, {2:0.0} at best, {3:0.0} in a process that has just begun; {4:0.0} Newton"
                + " iterations a step", Path.GetFileName(file), rates[Turns / 2], rates[Turns - 1], first,
                iterations));
        }
    }
}
