using System;
using System.Diagnostics;
using System.IO;
using Guidewire.Core;
using Newtonsoft.Json;

namespace Guidewire.Io
{
    /// <summary>Runs a simulation from its parameters to a folder of results: positions.json, parameters.json,
    /// summary.json. The console program and Unity's batch mode share it.</summary>
    /// <remarks>All three are written as *.partial and renamed at the end, the summary last, so that an earlier result
    /// stays whole until the new one is. What a killed run leaves is positions.json.partial.</remarks>
    public sealed class SimulationRun
    {
        private const string PositionsFile = "positions.json";
        private const string ParametersFile = "parameters.json";

        private readonly ParameterHandler _handler;
        private readonly string _folder;
        private readonly int? _repeat;

        /// <summary>A run into a folder.</summary>
        /// <param name="handler">The parameters.</param>
        /// <param name="folder">The folder of the results; made where it is missing. Null or empty: logFilePath.</param>
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

        /// <summary>Asked before every step; true ends the run as interrupted. May be set from another thread.</summary>
        public Func<bool>? StopRequested { get; set; }

        /// <summary>Told after every step, with the wall time in ms since the run's start.</summary>
        public Action<Simulation, double>? Progress { get; set; }

        /// <summary>The folder of the results.</summary>
        public string Folder => _folder;

        /// <summary>Runs to the end, or takes over what the folder already holds.</summary>
        /// <param name="reuse">Whether a whole earlier result of the same parameters, repeat and build stands in.</param>
        /// <exception cref="ParameterException">The folder cannot be written; nothing has been.</exception>
        public RunResult Execute(bool reuse)
        {
            Outcome? earlier = reuse ? RunSummary.Reusable(_folder, _handler, _repeat) : null;
            if (earlier.HasValue)
            {
                return new RunResult(earlier.Value, "taken from an earlier run", true);
            }
            Simulation simulation = Simulation.Create(_handler.Values.Simulation);
            using DataLogger logger = OpenLog();
            var times = new StepTimes();
            Stopwatch clock = Stopwatch.StartNew();
            string log = PositionsFile + AtomicFile.Partial;
            try
            {
                Step(simulation, logger, times, clock);
                logger.Close();
                Publish();
                log = PositionsFile;
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException)
            {
                simulation.End(Outcome.Failed, "the log could not be written: " + error.Message);
            }
            try
            {
                AtomicFile.Write(Path.Combine(_folder, RunSummary.FileName), RunSummary.Text(simulation, _handler, times,
                    clock.Elapsed.TotalSeconds, _repeat, log));
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException)
            {
                if (simulation.Outcome != Outcome.Failed)
                {
                    simulation.End(Outcome.Failed, "the summary could not be written: " + error.Message);
                }
            }
            return new RunResult(simulation.Outcome, simulation.Reason, false);
        }

        private DataLogger OpenLog()
        {
            try
            {
                Directory.CreateDirectory(_folder);
                return new DataLogger(Path.Combine(_folder, PositionsFile + AtomicFile.Partial), _handler.Values);
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException
                || error is ArgumentException || error is NotSupportedException)
            {
                throw new ParameterException("out = " + _folder + " cannot be written (" + error.Message
                    + "): needs a folder that this user may write to and no other run is writing to");
            }
        }

        private void Step(Simulation simulation, DataLogger logger, StepTimes times, Stopwatch clock)
        {
            double toMilliseconds = 1000.0 / Stopwatch.Frequency;
            logger.Log(simulation, clock.Elapsed.TotalMilliseconds);
            int lastLogged = 0;
            if (_handler.Values.Simulation.MaxSimulationSteps == 0)
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
                long before = Stopwatch.GetTimestamp();
                simulation.Step();
                times.Add((Stopwatch.GetTimestamp() - before) * toMilliseconds);
                double elapsed = clock.Elapsed.TotalMilliseconds;
                if (simulation.StepCount % _handler.Values.LogEvery == 0)
                {
                    logger.Log(simulation, elapsed);
                    lastLogged = simulation.StepCount;
                }
                Progress?.Invoke(simulation, elapsed);
            }
            if (lastLogged != simulation.StepCount)
            {
                logger.Log(simulation, clock.Elapsed.TotalMilliseconds);
            }
        }

        private void Publish()
        {
            // Without its summary an earlier result does not count, so no mixture of two runs ever does.
            File.Delete(Path.Combine(_folder, RunSummary.FileName));
            AtomicFile.Publish(Path.Combine(_folder, PositionsFile));
            AtomicFile.Write(Path.Combine(_folder, ParametersFile), _handler.ToJson().ToString(Formatting.Indented) + "\n");
        }
    }
}
