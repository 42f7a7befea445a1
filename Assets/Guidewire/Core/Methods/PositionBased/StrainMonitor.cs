using System;

namespace Guidewire.Core
{
    /// <summary>Compares the largest strain of one window of steps with that of the window before.</summary>
    internal sealed class StrainMonitor
    {
        private readonly int _length;
        private int _step;
        private double _largest;
        private double _previousLargest = double.PositiveInfinity;

        /// <param name="length">Steps in a window.</param>
        public StrainMonitor(int length)
        {
            _length = length;
        }

        /// <summary>The largest strain of the window that ended last, dimensionless.</summary>
        public double Largest { get; private set; }

        /// <summary>Writes into a snapshot, or restores from one, the windows so far.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Largest = snapshot.Serialize(Largest);
            snapshot.Serialize(ref _step);
            snapshot.Serialize(ref _largest);
            snapshot.Serialize(ref _previousLargest);
        }

        /// <summary>Takes one step's largest strain; true at the end of a window that, like the one before, went above
        /// the limit, and in which the largest strain has not fallen.</summary>
        /// <param name="strain">|length/l - 1| of the worst element.</param>
        /// <param name="limit">What counts as wrong in length.</param>
        public bool HasNotFallen(double strain, double limit)
        {
            _largest = Math.Max(_largest, strain);
            if (++_step < _length)
            {
                return false;
            }
            Largest = _largest;
            bool notFallen = _largest > limit && _previousLargest > limit && _largest >= _previousLargest;
            _previousLargest = _largest;
            _largest = 0.0;
            _step = 0;
            return notFallen;
        }
    }
}
