using System;
using System.Collections.Generic;
using System.Diagnostics;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Runs a simulation from its parameters to a folder of results: positions.json, parameters.json,
    /// summary.json. The console program and Unity's batch mode share it.</summary>
    public sealed class SimulationRun
    {
        private readonly ParameterHandler _handler;
        private readonly string _folder;
        private readonly int? _repeat;

        /// <summary>Makes a run into a folder.</summary>
        /// <param name="handler">The parameters.</param>
        /// <param name="folder">The folder of the results; made where it is missing. Null or empty:
        /// logFilePath.</param>
        /// <param name="repeat">Number of a timed repeat, or null.</param>
        /// <exception cref="ParameterException">No folder is named.</exception>
        public SimulationRun(ParameterHandler handler, string? folder, int? repeat)
        {
            _handler = handler;
            _folder = string.IsNullOrEmpty(folder) ? handler.Values.LogFilePath : folder!;
            _repeat = repeat;
            if (_folder.Length == 0)
            {
                throw new ParameterException(CommandLineHandler.Source
                    + ": no folder for the results: give -out DIR, or logFilePath in the parameter file");
            }
        }

        /// <summary>Asked before every step; true ends the run as interrupted. May be set from another
        /// thread.</summary>
        public Func<bool>? StopRequested { get; set; }

        /// <summary>Called after every step, with the wall time in ms since the run's start.</summary>
        public Action<Simulation, double>? Progress { get; set; }

        /// <summary>The folder of the results.</summary>
        public string Folder => _folder;

        /// <summary>Whether the run leaves all three files (default), or summary.json only.</summary>
        public bool KeepsLog { get; set; } = true;

        /// <summary>Runs to the end, or takes over what the folder already holds.</summary>
        /// <param name="existing">What becomes of a run that the folder holds.</param>
        /// <exception cref="ParameterException">The folder cannot be written, or holds a run that is to be kept;
        /// nothing has been written.</exception>
        public RunResult Execute(Existing existing)
        {
            EarlierRun? earlier = existing == Existing.Replace ? null : EarlierRun.In(_folder);
            if (earlier != null && earlier.IsSame(_handler, _repeat))
            {
                return new RunResult(earlier.Outcome, earlier.Reason, earlier.IsReliable, true);
            }
            if (earlier != null)
            {
                throw new ParameterException("out = " + _folder + " holds a complete run already ("
                    + earlier.Difference(_handler, _repeat)
                    + "): give another folder, or --force to replace that run once the new one is complete");
            }
            long before = Stopwatch.GetTimestamp();
            Simulation simulation = Simulation.Create(_handler.Values.Simulation);
            double setUp = (Stopwatch.GetTimestamp() - before) * RunFolder.ToMilliseconds;
            using RunFolder results = RunFolder.Open(_handler, _folder, _repeat, KeepsLog);
            results.OutcomesKeepingPreviousRun = new[] { Outcome.Interrupted, Outcome.Failed };
            results.Begin(simulation, setUp);
            if (_handler.Values.Simulation.Method.MaxSimulationSteps == 0 && simulation.Outcome == Outcome.Running)
            {
                simulation.End(Outcome.Finished, "no steps were asked for");
            }
            while (simulation.Outcome == Outcome.Running)
            {
                if (StopRequested != null && StopRequested())
                {
                    simulation.End(Outcome.Interrupted, "stopped from outside after step " + simulation.StepCount);
                    break;
                }
                results.Step(simulation);
                Progress?.Invoke(simulation, results.Elapsed);
            }
            results.Finish(simulation);
            return new RunResult(simulation.Outcome, simulation.Reason, simulation.IsReliable, false,
                results.KeptPreviousRun)
            {
                Warnings = simulation.Warnings,
            };
        }
    }

    /// <summary>What became of a run.</summary>
    public sealed class RunResult
    {
        internal RunResult(Outcome outcome, string reason, bool isReliable, bool reused, bool keptEarlier = false)
        {
            IsReliable = isReliable;
            Outcome = outcome;
            Reason = reason;
            Reused = reused;
            KeptPreviousRun = keptEarlier;
        }

        /// <summary>The outcome's one word, as in summary.json.</summary>
        public string Word => RunSummary.Word(Outcome);

        /// <summary>Says how the run ended.</summary>
        public Outcome Outcome { get; }

        /// <summary>Why, in one line.</summary>
        public string Reason { get; }

        /// <summary>Whether the result can be trusted, as far as the run can tell; see <see
        /// cref="Simulation.IsReliable"/>.</summary>
        public bool IsReliable { get; }

        /// <summary>What is not as it should be at its end, one line each.</summary>
        public IReadOnlyList<string> Warnings { get; internal set; } = Array.Empty<string>();

        /// <summary>True when an earlier result of the same parameters stood in for it.</summary>
        public bool Reused { get; }

        /// <summary>True when the run came to no end of its own, and a whole result that the folder held before it is
        /// there still.</summary>
        public bool KeptPreviousRun { get; }
    }

    /// <summary>What a process tells its caller.</summary>
    public static class ExitCodes
    {
        /// <summary>Bad arguments or parameters, or an output folder that cannot be written.</summary>
        public const int BadInput = 2;

        /// <summary>An error of the program itself.</summary>
        public const int Internal = 70;

        /// <summary>Gives the code of an outcome.</summary>
        /// <exception cref="ArgumentOutOfRangeException">A run that has not ended has none.</exception>
        public static int Of(Outcome outcome)
        {
            switch (outcome)
            {
                case Outcome.Converged:
                case Outcome.Finished:
                    return 0;
                case Outcome.Diverged:
                    return 4;
                case Outcome.Failed:
                    return 5;
                case Outcome.Interrupted:
                    return 130;
                default:
                    throw new ArgumentOutOfRangeException(nameof(outcome), outcome, "the run has not ended");
            }
        }
    }

    /// <summary>One run from its arguments to its exit code. The console program, Unity's editor in batch mode and a
    /// player without a screen differ only in where they say what happened.</summary>
    public sealed class RunCommand
    {
        private readonly bool _logFileIsOurs;

        /// <param name="logFileIsOurs">Whether <c>-logFile DIR</c> stands for <c>-out</c>; in Unity it is
        /// Unity's.</param>
        public RunCommand(bool logFileIsOurs)
        {
            _logFileIsOurs = logFileIsOurs;
        }

        /// <summary>Takes warnings, and what ended the run badly.</summary>
        public Action<string> Error { get; set; } = _ => { };

        /// <summary>Takes what ended the run.</summary>
        public Action<string> Say { get; set; } = _ => { };

        /// <summary>Asked before every step; true ends the run as interrupted.</summary>
        public Func<bool>? StopRequested { get; set; }

        /// <summary>Called after every step, with the wall time in ms since the run's start.</summary>
        public Action<Simulation, double>? Progress { get; set; }

        /// <summary>The folder of the results, once it is known: where the trace of an internal error
        /// belongs.</summary>
        public string? Folder { get; private set; }

        /// <summary>Steps of the run at most, once they are known.</summary>
        public int MaxSteps { get; private set; }

        /// <summary>Runs to the end.</summary>
        /// <param name="arguments">As <see cref="CommandLineHandler.Read"/> takes them.</param>
        /// <returns>The exit code of the outcome.</returns>
        /// <exception cref="ParameterException">Bad arguments or parameters; nothing was written.</exception>
        public int Execute(IReadOnlyList<string> arguments)
        {
            CommandLine line = CommandLineHandler.Read(arguments, _logFileIsOurs);
            ParameterHandler handler = ParameterHandler.Load(line.ParameterFile, line.Overrides);
            var run = new SimulationRun(handler, line.Out, line.Repeat)
            {
                StopRequested = StopRequested,
                Progress = Progress,
            };
            Folder = run.Folder;
            MaxSteps = handler.Values.Simulation.Method.MaxSimulationSteps;
            Warn(handler.Warnings);
            RunResult result = run.Execute(line.Force ? Existing.Replace : Existing.Keep);
            Warn(result.Warnings);
            bool isDone = result.Outcome == Outcome.Converged || result.Outcome == Outcome.Finished;
            string ending = result.Word + (isDone && !result.IsReliable ? ", not reliable: " : ": ") + result.Reason;
            if (result.KeptPreviousRun)
            {
                ending += "; the complete run that " + run.Folder + " held before is kept, the log of the new one is "
                    + RunFolder.PartialLogOf(handler);
            }
            if (result.Outcome == Outcome.Failed)
            {
                Error(ending);
            }
            else if (result.Reused)
            {
                Say("already there: " + run.Folder + " (" + ending + "); --force runs it again");
            }
            else
            {
                Say(ending + (result.KeptPreviousRun ? "" : " -> " + run.Folder));
            }
            return ExitCodes.Of(result.Outcome);
        }

        private void Warn(IReadOnlyList<string> warnings)
        {
            foreach (string warning in warnings)
            {
                Error("warning: " + warning);
            }
        }
    }
}
