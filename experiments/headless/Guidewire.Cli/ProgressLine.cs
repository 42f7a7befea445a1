using System;
using System.Globalization;
using Guidewire.Core;
using Guidewire.Io;

namespace Guidewire.Cli
{
    /// <summary>One line on a terminal that says how far a long run is; nothing where standard error is a
    /// file.</summary>
    internal sealed class ProgressLine : IDisposable
    {
        private const double FirstAfter = 1000.0;     // ms
        private const double Every = 200.0;           // ms

        private readonly RunCommand _command;
        private readonly bool _silent = Console.IsErrorRedirected;
        private double _next = FirstAfter;
        private bool _shown;

        /// <param name="command">The run.</param>
        public ProgressLine(RunCommand command)
        {
            _command = command;
        }

        /// <summary>Told after every step, with the wall time in ms.</summary>
        public void Show(Simulation simulation, double elapsed)
        {
            if (_silent || elapsed < _next)
            {
                return;
            }
            _next = elapsed + Every;
            _shown = true;
            Console.Error.Write(string.Format(CultureInfo.InvariantCulture,
                "\rstep {0} of at most {1}, {2:0.000} s in game, {3:0} s, prediction error {4:0.0e+0} units   ",
                simulation.StepCount, _command.MaxSteps, simulation.Time, 1e-3 * elapsed, simulation.PredictionError));
        }

        /// <summary>Ends the line.</summary>
        public void Dispose()
        {
            if (_shown)
            {
                _shown = false;
                Console.Error.WriteLine();
            }
        }
    }
}
