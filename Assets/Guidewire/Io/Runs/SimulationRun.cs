using System;
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
}
