using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>What a hub does at its limit: since when it has slipped, and what force steps had beyond it.</summary>
    internal sealed class SlipRecord
    {
        private const double Exact = 1e-3;      // of the limit

        private readonly HubLimit _limit;
        private double _first = double.NaN;     // s
        private int _stepsBeyond;
        private double _maxBeyond;              // N

        /// <summary>Of a hub that has not moved.</summary>
        public SlipRecord(in HubLimit limit)
        {
            _limit = limit;
        }

        /// <summary>The end of the first step in which it slipped, s; NaN where there is none.</summary>
        public double SlippedFrom => _first;

        /// <summary>That it slipped, in one phrase, or null.</summary>
        public string? Why => double.IsNaN(_first) ? null : string.Format(CultureInfo.InvariantCulture,
            "it slipped at its hubForceLimit of {0:G3} N{1}, first at t = {2:G4} s", _limit.Push,
            _limit.IsOfHand ? ", that of a hand" : "", _first);

        /// <summary>Takes a step that has ended.</summary>
        /// <param name="slipped">Whether it went another way than it was asked, at its limit.</param>
        /// <param name="force">N.</param>
        /// <param name="time">s.</param>
        public void Record(bool slipped, double force, double time)
        {
            bool isBeyond = Math.Abs(force) > (1.0 + Exact) * _limit.Of(force);
            if ((slipped || isBeyond) && double.IsNaN(_first))
            {
                _first = time;
            }
            if (isBeyond)
            {
                _stepsBeyond++;
                _maxBeyond = Math.Max(_maxBeyond, Math.Abs(force));
            }
        }

        /// <summary>That it had more than its limit, or null.</summary>
        /// <param name="name">What the warning calls the hub.</param>
        public RunWarning? FindExcess(string name)
        {
            return _stepsBeyond == 0 ? (RunWarning?)null
                : WarningTable.HubForce.With(name, _maxBeyond, Math.Min(_limit.Push, _limit.Pull), _stepsBeyond);
        }

        /// <summary>Writes or restores all of it.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _stepsBeyond);
            snapshot.Serialize(ref _maxBeyond);
            snapshot.Serialize(ref _first);
        }
    }
}
