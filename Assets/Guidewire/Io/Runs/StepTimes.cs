using System;

namespace Guidewire.Io
{
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
