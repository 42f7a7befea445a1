using System;

namespace Guidewire.Core
{
    /// <summary>How far a hub goes in a step, where more would take more than the force at which it slips.</summary>
    /// <remarks>The displacement is found by repeated steps: F(u) is the hub's force after a step with its displacement
    /// u. Between one with too much force and one with no more than the limit the interval is halved, or cut where a
    /// straight line has the limit, until the force is within 2 % below it. A hub that may not even rest gives
    /// way.</remarks>
    internal sealed class HubSlip
    {
        private const double Close = 0.02;      // of the limit
        private const int MostTrials = 24;

        private readonly MaterialDrive _drive;
        private readonly double _limit;         // N
        private readonly double _shortest;      // m, by which a hub that may not rest gives way at first
        private double _allowed;                // m, displacement with no more than the limit
        private double _allowedForce;           // N
        private double _tooFar;                 // m
        private double _tooMuch;                // N
        private bool _hasAllowed;
        private int _trials;

        /// <summary>For a hub.</summary>
        /// <param name="limit">N; 0: it never slips.</param>
        /// <param name="shortest">m.</param>
        public HubSlip(MaterialDrive drive, double limit, double shortest)
        {
            _drive = drive;
            _limit = limit > 0.0 ? limit : double.PositiveInfinity;
            _shortest = shortest;
        }

        /// <summary>Whether there is a limit.</summary>
        public bool IsLimited => _limit < double.PositiveInfinity;

        /// <summary>A step begins, as it is asked for.</summary>
        public void Begin()
        {
            _trials = 0;
            _hasAllowed = false;
            Displacement = null;
        }

        /// <summary>What the hub is to go in the next trial, m; null: what it is asked.</summary>
        public double? Displacement { get; private set; }

        /// <summary>Takes a trial.</summary>
        /// <param name="moved">What the hub went, m.</param>
        /// <param name="force">On its instrument after it, N, a thrust positive; NaN where the step has no
        /// solution.</param>
        /// <returns>Whether another one is needed.</returns>
        public bool NeedsAnother(double moved, double force)
        {
            bool isTooMuch = !(Math.Abs(force) <= _limit);
            if (!IsLimited || (!isTooMuch && (_trials == 0 || Math.Abs(force) >= (1.0 - Close) * _limit)))
            {
                return false;
            }
            if (_trials++ >= MostTrials)
            {
                // Where the force jumps past the limit, as far as it is no more.
                Displacement = _allowed;
                return isTooMuch && _hasAllowed && _trials == MostTrials + 1;
            }
            if (isTooMuch)
            {
                // Where both senses are too much, the last one counts.
                _tooFar = moved;
                _tooMuch = double.IsNaN(force) ? double.NaN : force;
            }
            else
            {
                _hasAllowed = true;
                _allowed = moved;
                _allowedForce = force;
            }
            Displacement = _hasAllowed ? Between() : Back(moved, force);
            return Displacement != moved;
        }

        // Rest first, then farther and farther back.
        private double Back(double moved, double force)
        {
            double sense = double.IsNaN(force) ? Math.Sign(_drive.Asked == 0.0 ? -moved : moved) : Math.Sign(force);
            return moved * sense > 0.0 ? 0.0 : moved == 0.0 ? -sense * _shortest : 2.0 * moved;
        }

        private double Between()
        {
            double fraction = 0.5;
            if (!double.IsNaN(_tooMuch) && _trials % 3 != 0)
            {
                double target = Math.Sign(_tooMuch) * (1.0 - 0.5 * Close) * _limit;
                fraction = Math.Min(0.95, Math.Max(0.05, (target - _allowedForce) / (_tooMuch - _allowedForce)));
            }
            return _allowed + fraction * (_tooFar - _allowed);
        }
    }
}
