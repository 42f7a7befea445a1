using System;
using System.Globalization;
using System.IO;
using Guidewire.Core;
using Guidewire.Io;

namespace Guidewire.Cli
{
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
