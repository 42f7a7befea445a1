using System;
using System.Diagnostics;

namespace Guidewire.Runtime
{
    /// <summary>How fast a run goes, of what its pace asks for.</summary>
    internal sealed class SpeedMeter
    {
        private double _asked;      // s of in-game time since it was measured last
        private double _lastTime;   // in-game, s

        /// <summary>Simulated over asked, at most 1.</summary>
        public double Speed { get; private set; } = 1.0;

        /// <summary>Begins with another run.</summary>
        public void Begin() => (Speed, _asked, _lastTime) = (1.0, 0.0, 0.0);

        /// <summary>A frame has asked for in-game time.</summary>
        /// <param name="seconds">s.</param>
        /// <param name="span">s over which the speed is measured.</param>
        /// <param name="time">In-game time of the newest state, s.</param>
        public void Ask(double seconds, double span, double time)
        {
            _asked += seconds;
            if (_asked >= span)
            {
                Speed = Math.Min(1.0, (time - _lastTime) / _asked);
                (_asked, _lastTime) = (0.0, time);
            }
        }
    }

    /// <summary>Work between two frames, where no thread does it.</summary>
    internal sealed class FrameBudget
    {
        private readonly Stopwatch _clock = new Stopwatch();

        /// <summary>Works until nothing is left, or one of the limits is reached.</summary>
        /// <param name="most">Pieces of work, steps among them.</param>
        /// <param name="milliseconds">Looked at between two pieces: at least one is done.</param>
        public void Work(WireRun run, int most, double milliseconds)
        {
            _clock.Restart();
            int done = 0;
            while (done < most && (done == 0 || _clock.Elapsed.TotalMilliseconds < milliseconds) && run.Work())
            {
                done++;
            }
        }
    }
}
