using System;
using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
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
