using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>How many Newton iterations the steps of a run may take beyond those that solve them as asked: many at
    /// once, and a few a step in the long run.</summary>
    /// <remarks>Counted is what a step takes after its first halving or its first trial of another displacement of a
    /// hub; the others are not, however many intervals they have. A snap takes a thousand iterations once. A wire that
    /// coils up and jams under a steady push takes hundreds in every step: what is left then falls to nothing, and the
    /// run ends. Where half is left hubs look no further for the displacement that their limit allows, so that the
    /// step can still be solved with the best that was found. Iterations are counted, no times: a run ends at the same
    /// step on every machine.</remarks>
    internal sealed class WorkLimit
    {
        private const int AtOnce = 200;   // times the iterations that one solution may take
        private const int AStep = 4;      // the same

        private readonly int _maxIterations;
        private readonly int _times;
        private long _left;               // iterations
        private bool _isCounted;

        /// <summary>Begins with all of it.</summary>
        /// <param name="maxIterations">That one solution may take.</param>
        /// <param name="limitedHubs">Hubs with a limit. Each one after the first takes four times the work, because for
        /// each of its displacements those of the hubs inside it are found anew.</param>
        public WorkLimit(int maxIterations, int limitedHubs = 0)
        {
            _maxIterations = maxIterations;
            _times = 1 << 2 * Math.Max(0, limitedHubs - 1);
            _left = Max;
        }

        /// <summary>Whether nothing is left.</summary>
        public bool IsOver => _left < 0;

        /// <summary>Whether less than half of the most is left.</summary>
        public bool IsScarce => _left < Max / 2;

        /// <summary>That nothing is left, in one phrase.</summary>
        public string Text => string.Format(CultureInfo.InvariantCulture,
            "steps that were halved took more Newton iterations than a run may ({0} times maxNewtonIterations at once, "
            + "{1} times a step), as where a wire coils up or jams", AtOnce * _times, AStep * _times);

        /// <summary>Begins a step.</summary>
        public void BeginStep()
        {
            _isCounted = false;
            _left = Math.Min(_left + (long)AStep * _times * _maxIterations, Max);
        }

        /// <summary>What the step takes from now on is counted.</summary>
        public void Count() => _isCounted = true;

        /// <summary>Takes iterations that were made.</summary>
        public void Spend(long iterations) => _left -= _isCounted ? iterations : 0;

        /// <summary>Writes or restores what is left.</summary>
        public void Serialize(Snapshot snapshot) => snapshot.Serialize(ref _left);

        private long Max => (long)AtOnce * _times * _maxIterations;
    }
}
