using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>The results of one run as they come to be: its log, parameters.json, summary.json in a folder.
    /// Whoever steps a simulation, a loop of its own or Unity's frames, steps it through here to have it
    /// logged.</summary>
    /// <remarks>All three are written as *.partial and renamed at the end, the summary last, so that an earlier result
    /// stays whole until the new one is, and stays where the new one does not come to an end of its own. What a killed
    /// run leaves is the log's *.partial.</remarks>
    public sealed class RunFolder : IDisposable
    {
        internal const string ParametersFile = "parameters.json";
        internal static readonly double ToMilliseconds = 1000.0 / Stopwatch.Frequency;    // of a Stopwatch's ticks

        private readonly ParameterHandler _handler;
        private readonly string _folder;
        private readonly int? _repeat;
        private readonly StateLog? _logger;    // null: no log was asked for
        private readonly StepTimes _times = new StepTimes();
        private readonly Stopwatch _clock = new Stopwatch();
        private readonly List<string> _notes = new List<string>();
        private readonly TargetRecord? _target;
        private double _setUp;    // ms
        private int _lastLogged = -1;
        private bool _lost;

        private RunFolder(ParameterHandler handler, string folder, int? repeat, StateLog? logger)
        {
            _handler = handler;
            _folder = folder;
            _repeat = repeat;
            _logger = logger;
            _target = handler.Values.Places is LumenPlaces places
                ? new TargetRecord(handler.Values.Path!, places) : null;
        }

        /// <summary>Wall time since the run's start in ms.</summary>
        public double Elapsed => _clock.Elapsed.TotalMilliseconds;

        /// <summary>Outcomes that replace no result that the folder held before; none where this is not set.</summary>
        public IReadOnlyList<Outcome> OutcomesKeepingPreviousRun { get; set; } = Array.Empty<Outcome>();

        /// <summary>Whether such a result is there still, after <see cref="Finish"/>.</summary>
        public bool KeptPreviousRun { get; private set; }

        /// <summary>A folder that takes a run; made where it is missing.</summary>
        /// <param name="handler">The parameters.</param>
        /// <param name="folder">The folder.</param>
        /// <param name="repeat">Number of a timed repeat, or null.</param>
        /// <param name="keepsLog">Whether there are to be a positions.json and a parameters.json.</param>
        /// <exception cref="ParameterException">The folder cannot be written; nothing has been.</exception>
        public static RunFolder Open(ParameterHandler handler, string folder, int? repeat, bool keepsLog)
        {
            try
            {
                Directory.CreateDirectory(folder);
                string log = Path.Combine(folder, PartialLogOf(handler));
                return new RunFolder(handler, folder, repeat, keepsLog ? StateLog.Open(log, handler.Values) : null);
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException
                || error is ArgumentException || error is NotSupportedException)
            {
                throw new ParameterException("out = " + folder + " cannot be written (" + error.Message
                    + "): needs a folder that this user may write to and no other run is writing to");
            }
        }

        /// <summary>Name of a log that is not whole yet.</summary>
        internal static string PartialLogOf(ParameterHandler handler) =>
            StateLog.NameOf(handler.Values.LogFormat) + AtomicFile.Partial;

        /// <summary>Starts the clock and logs the state before the first step.</summary>
        /// <param name="simulation">The run at its start.</param>
        /// <param name="setUp">Wall time that building it took, its rest shape among it, ms.</param>
        public void Begin(Simulation simulation, double setUp)
        {
            _setUp = setUp;
            _clock.Start();
            Follow(simulation);
            Log(simulation);
        }

        /// <summary>Makes one step, times it and logs it where logEvery says so and it has a state of its own. A disk
        /// that is full or gone ends the run as Failed.</summary>
        public void Step(Simulation simulation)
        {
            long before = Stopwatch.GetTimestamp();
            simulation.Step();
            _times.Add((Stopwatch.GetTimestamp() - before) * ToMilliseconds);
            Follow(simulation);
            if (simulation.StepCount % _handler.Values.LogEvery == 0)
            {
                Log(simulation);
            }
        }

        /// <summary>Says in the summary that something other than the parameters made this run: it has no parameter
        /// hash then, and no later run relies on it.</summary>
        /// <param name="line">What it was, in one line.</param>
        public void Note(string line) => _notes.Add(line);

        /// <summary>Logs the last state, closes the log and writes the summary. What cannot be written turns the
        /// outcome into Failed.</summary>
        /// <param name="simulation">The run at its end.</param>
        public void Finish(Simulation simulation)
        {
            Log(simulation);
            try
            {
                if (!_lost)
                {
                    _logger?.Close();
                    if (!MustKeepEarlierRun(simulation))
                    {
                        Publish(simulation);
                    }
                    return;
                }
            }
            catch (Exception error) when (IsDisk(error))
            {
                Lose(simulation, "the log could not be written: " + error.Message);
            }
            if (MustKeepEarlierRun(simulation))
            {
                return;
            }
            try
            {
                string? log = _logger == null ? null
                    : File.Exists(Path.Combine(_folder, PartialLogOf(_handler))) ? PartialLogOf(_handler) : LogName;
                AtomicFile.Write(Path.Combine(_folder, RunSummary.FileName), Summary(simulation, log));
            }
            catch (Exception error) when (IsDisk(error))
            {
                Lose(simulation, "the summary could not be written: " + error.Message);
            }
        }

        /// <summary>Closes the log as it is; a log for which the disk had no space at all is deleted.</summary>
        public void Dispose()
        {
            _logger?.Dispose();
            var log = new FileInfo(Path.Combine(_folder, PartialLogOf(_handler)));
            if (_lost && log.Exists && log.Length == 0)
            {
                log.Delete();
            }
        }

        private static bool IsDisk(Exception error) => error is IOException || error is UnauthorizedAccessException;

        private void Follow(Simulation simulation)
        {
            if (simulation.HasStateOfStep)
            {
                _target?.Update(simulation.State.Positions, simulation.Time, simulation.FieldOf(0));
            }
        }

        private void Log(Simulation simulation)
        {
            if (_lost || _logger == null || !simulation.HasStateOfStep || _lastLogged == simulation.StepCount)
            {
                return;
            }
            try
            {
                _logger.Log(simulation, Elapsed);
                _lastLogged = simulation.StepCount;
            }
            catch (Exception error) when (IsDisk(error))
            {
                Lose(simulation, "the log could not be written: " + error.Message);
            }
        }

        // The first reason of a failure is the one to tell.
        private void Lose(Simulation simulation, string reason)
        {
            _lost = true;
            if (simulation.Outcome != Outcome.Failed)
            {
                simulation.End(Outcome.Failed, reason);
            }
        }

        private bool MustKeepEarlierRun(Simulation simulation)
        {
            foreach (Outcome outcome in OutcomesKeepingPreviousRun)
            {
                KeptPreviousRun |= simulation.Outcome == outcome && EarlierRun.In(_folder) != null;
            }
            return KeptPreviousRun;
        }

        private void Publish(Simulation simulation)
        {
            // First what may not fit on the disk; from then on names only change. Without its summary an earlier result
            // does not count, so no mixture of two runs ever does.
            string parameters = Path.Combine(_folder, ParametersFile);
            string summary = Path.Combine(_folder, RunSummary.FileName);
            if (_logger == null)
            {
                AtomicFile.Prepare(summary, Summary(simulation, null));
                File.Delete(summary);    // an earlier run's, as the others
                DeleteLogs(null);
                File.Delete(parameters);
                AtomicFile.Publish(summary);
                return;
            }
            JObject content = _handler.ToJson();
            content.AddFirst(new JProperty(FileFormat.Key, FileFormat.Version));
            AtomicFile.Prepare(parameters, content.ToString(Formatting.Indented) + "\n");
            try
            {
                AtomicFile.Prepare(summary, Summary(simulation, LogName));
            }
            catch (Exception error) when (IsDisk(error))
            {
                File.Delete(parameters + AtomicFile.Partial);
                throw;
            }
            File.Delete(summary);
            DeleteLogs(LogName);
            AtomicFile.Publish(Path.Combine(_folder, LogName));
            AtomicFile.Publish(parameters);
            AtomicFile.Publish(summary);
        }

        private string LogName => StateLog.NameOf(_handler.Values.LogFormat);

        // Logs of an earlier run, which may have had another format.
        private void DeleteLogs(string? kept)
        {
            foreach (LogFormat format in Enum.GetValues(typeof(LogFormat)))
            {
                if (StateLog.NameOf(format) != kept)
                {
                    File.Delete(Path.Combine(_folder, StateLog.NameOf(format)));
                }
            }
        }

        private string Summary(Simulation simulation, string? log)
        {
            return RunSummary.Text(simulation, _handler, _times, 1e-3 * _setUp, _clock.Elapsed.TotalSeconds, _repeat,
                log, _notes, _target);
        }
    }

    /// <summary>Sum and median of step times in constant memory: the median from classes 1 % wide, so it is within 0.5
    /// %.</summary>
    internal sealed class StepTimes
    {
        private const double Smallest = 1e-5;         // ms
        private const double Ratio = 1.01;
        private readonly long[] _classes = new long[2800];   // up to 1e7 ms
        private long _count;

        /// <summary>The sum of all steps' times, ms.</summary>
        public double Sum { get; private set; }

        /// <summary>Mean in ms; 0 without steps.</summary>
        public double Average => _count == 0 ? 0.0 : Sum / _count;

        /// <summary>Takes one step's time.</summary>
        public void Add(double milliseconds)
        {
            Sum += milliseconds;
            _count++;
            double bin = Math.Log(Math.Max(milliseconds, Smallest) / Smallest) / Math.Log(Ratio);
            _classes[(int)Math.Min(bin, _classes.Length - 1)]++;
        }

        /// <summary>Median in ms; 0 without steps.</summary>
        public double Median()
        {
            long below = 0;
            for (int k = 0; k < _classes.Length; k++)
            {
                below += _classes[k];
                if (2 * below >= _count && _count > 0)
                {
                    return Smallest * Math.Pow(Ratio, k + 0.5);
                }
            }
            return 0.0;
        }
    }
}
