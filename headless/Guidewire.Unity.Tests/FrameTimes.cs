using System;
using System.Diagnostics;
using System.Globalization;

namespace Guidewire.Unity.Tests
{
    /// <summary>How long frames take that are played one by one: what a frame has time for is printed, not asserted,
    /// since machines do other things too.</summary>
    internal sealed class FrameTimes
    {
        private readonly double[] _milliseconds;
        private readonly Stopwatch _monitor = new Stopwatch();
        private int _count;

        /// <summary>For so many frames at most; none of them leaves garbage.</summary>
        public FrameTimes(int most)
        {
            _milliseconds = new double[most];
        }

        /// <summary>Plays frames.</summary>
        public void Play(int count)
        {
            for (int k = 0; k < count; k++)
            {
                _monitor.Restart();
                Stage.Frames(1);
                _milliseconds[_count++] = _monitor.Elapsed.TotalMilliseconds;
            }
        }

        /// <summary>What they took, in one line.</summary>
        /// <param name="simulated">Time that was simulated in them, s.</param>
        public string Text(double simulated)
        {
            double[] sorted = new double[_count];
            Array.Copy(_milliseconds, sorted, _count);
            Array.Sort(sorted);
            return string.Format(CultureInfo.InvariantCulture,
                "{0} frames of {1:0.0} ms: steps and views take {2:0.00} ms (median), 99 of 100 less than {3:0.00} ms,"
                + " the longest {4:0.0} ms; {5:0.0} % of their time was simulated", _count, 1e3 * Stage.Frame,
                sorted[_count / 2], sorted[_count * 99 / 100], sorted[_count - 1],
                100.0 * simulated / (_count * Stage.Frame));
        }
    }
}
