using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A value over time, such as a factor on a load: linear between the rows, the first and the last value
    /// before and after them. Two rows of one time are a jump: at that time itself the value is the first row's, after
    /// it the second's.</summary>
    public sealed class TimeTable
    {
        private readonly double[] _times;
        private readonly double[] _values;
        private readonly double[] _jumps;  // times, s

        /// <summary>Makes a table of k rows.</summary>
        /// <param name="times">s, increasing, at least one; two may be the same, three not.</param>
        /// <param name="values">The value at each time.</param>
        /// <exception cref="ArgumentException">No rows, not as many of both, or times that do not increase
        /// or are the same in three rows.</exception>
        public TimeTable(double[] times, double[] values)
        {
            if (times.Length == 0 || values.Length != times.Length)
            {
                throw new ArgumentException("a table needs at least one row, each with a time and a value");
            }
            var jumps = new List<double>();
            for (int i = 1; i < times.Length; i++)
            {
                if (!(times[i] >= times[i - 1]))
                {
                    throw new ArgumentException("a table needs times that increase from row to row");
                }
                if (i > 1 && times[i] == times[i - 2])
                {
                    throw new ArgumentException("a table has at most two rows of one time, a jump");
                }
                if (times[i] == times[i - 1])
                {
                    jumps.Add(times[i]);
                }
            }
            _times = (double[])times.Clone();
            _values = (double[])values.Clone();
            _jumps = jumps.ToArray();
        }

        /// <summary>The time from which on the value no longer changes, s; where it jumps, after that
        /// time.</summary>
        public double End => _times[_times.Length - 1];

        /// <summary>Whether the value jumps anywhere.</summary>
        internal bool HasJumps => _jumps.Length > 0;

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

        /// <summary>Gives the values of the rows from time 0 up to a time, s, and that at the time.</summary>
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

        /// <summary>Gives the value at this time, s.</summary>
        public double At(double time)
        {
            int next = FirstFrom(time);
            if (next < _times.Length && _times[next] == time)
            {
                return _values[next];
            }
            if (next == 0 || next == _times.Length)
            {
                return _values[Math.Max(next - 1, 0)];
            }
            double fraction = (time - _times[next - 1]) / (_times[next] - _times[next - 1]);
            return _values[next - 1] + fraction * (_values[next] - _values[next - 1]);
        }

        /// <summary>Whether the value changes at this time, s, or after it.</summary>
        internal bool ChangesFrom(double time) =>
            time < End || (time == End && _jumps.Length > 0 && _jumps[_jumps.Length - 1] == End);

        /// <summary>The time of the first row after this time, s; infinite where there is none.</summary>
        internal double NextRow(double time)
        {
            int next = FirstFrom(time);
            while (next < _times.Length && _times[next] == time)
            {
                next++;
            }
            return next < _times.Length ? _times[next] : double.PositiveInfinity;
        }

        /// <summary>The first time after this one, s, at which the value jumps; infinite where it does not.</summary>
        internal double NextJump(double time)
        {
            foreach (double jump in _jumps)
            {
                if (jump > time)
                {
                    return jump;
                }
            }
            return double.PositiveInfinity;
        }

        // The first row that is not before this time.
        private int FirstFrom(double time)
        {
            int next = Array.BinarySearch(_times, time);
            next = next >= 0 ? next : ~next;
            return next > 0 && next < _times.Length && _times[next - 1] == time ? next - 1 : next;
        }
    }

    /// <summary>Motion of a hub over time: insertion along its axis and rotation about it. Only differences
    /// matter.</summary>
    public sealed class DriveTable
    {
        /// <summary>Makes a table of both.</summary>
        /// <param name="insertion">m.</param>
        /// <param name="rotation">rad; more than one turn counts.</param>
        /// <exception cref="ArgumentException">A hub that jumps.</exception>
        public DriveTable(TimeTable insertion, TimeTable rotation)
        {
            if (insertion.HasJumps || rotation.HasJumps)
            {
                throw new ArgumentException("the hub cannot be at two positions at one time: times have to increase "
                    + "from row to row");
            }
            Insertion = insertion;
            Rotation = rotation;
        }

        /// <summary>The insertion over time, m.</summary>
        public TimeTable Insertion { get; }

        /// <summary>The rotation over time, rad.</summary>
        public TimeTable Rotation { get; }

        /// <summary>The time from which on the hub stands still, s.</summary>
        public double End => Insertion.End;
    }
}
