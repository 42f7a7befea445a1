using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A value over time, such as a factor on a load: linear between the rows, the first and the last value
    /// before and after them.</summary>
    public sealed class TimeTable
    {
        private readonly double[] _times;
        private readonly double[] _values;

        /// <summary>A table of k rows.</summary>
        /// <param name="times">s, strictly increasing, at least one.</param>
        /// <param name="values">The value at each time.</param>
        /// <exception cref="ArgumentException">No rows, not as many of both, or times that do not increase.</exception>
        public TimeTable(double[] times, double[] values)
        {
            if (times.Length == 0 || values.Length != times.Length)
            {
                throw new ArgumentException("a table needs at least one row, each with a time and a value");
            }
            for (int i = 1; i < times.Length; i++)
            {
                if (!(times[i] > times[i - 1]))
                {
                    throw new ArgumentException("a table needs times that increase from row to row");
                }
            }
            _times = (double[])times.Clone();
            _values = (double[])values.Clone();
        }

        /// <summary>From when on the value no longer changes, s.</summary>
        public double End => _times[_times.Length - 1];

        /// <summary>The fastest that the value changes, 1/s.</summary>
        internal double LargestRate
        {
            get
            {
                double rate = 0.0;
                for (int i = 1; i < _times.Length; i++)
                {
                    rate = Math.Max(rate, Math.Abs((_values[i] - _values[i - 1]) / (_times[i] - _times[i - 1])));
                }
                return rate;
            }
        }

        /// <summary>The values of the rows from time 0 up to a time, s, and that at the time.</summary>
        internal IEnumerable<double> ValuesUntil(double time)
        {
            for (int i = 0; i < _times.Length; i++)
            {
                if (_times[i] >= 0.0 && _times[i] < time)
                {
                    yield return _values[i];
                }
            }
            yield return At(time);
        }

        /// <summary>The value at this time, s.</summary>
        public double At(double time)
        {
            int next = Array.BinarySearch(_times, time);
            if (next >= 0)
            {
                return _values[next];
            }
            next = ~next;
            if (next == 0 || next == _times.Length)
            {
                return _values[Math.Max(next - 1, 0)];
            }
            double share = (time - _times[next - 1]) / (_times[next] - _times[next - 1]);
            return _values[next - 1] + share * (_values[next] - _values[next - 1]);
        }
    }
}
