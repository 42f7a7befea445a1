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
}
