using System;

namespace Guidewire.Core
{
    /// <summary>Limits the displacement of a hub in a step so that its force does not exceed its
    /// hubForceLimit.</summary>
    /// <remarks>The displacement is found by repeated steps: F(u) is the hub's force after a step with its displacement
    /// u. Between one with too much force and one with no more than the limit the interval is halved, or cut where a
    /// straight line has the limit, until the force is within 2 % below it. A hub that may not even rest gives
    /// way, farther and farther; where that went from too much of one sense to too much of the other, the displacement
    /// without force lies between. An instrument is stiff along its axis: what it may be displaced between both limits
    /// is some micrometres. Where the force jumps from beyond the limit in one sense to beyond it in the other, it is
    /// the least of those that were found.</remarks>
    internal sealed class HubSlip
    {
        private const double Close = 0.02;      // of the limit
        private const int MaxTrials = 24;
        private const double Exact = 1e-3;      // of the limit

        private readonly MaterialDrive _drive;
        private readonly double _limit;         // N
        private readonly double _shortest;      // m, by which a hub that may not rest gives way at first
        private double _allowed;                // m, displacement with no more than the limit
        private double _allowedForce;           // N
        private double _tooFar;                 // m
        private double _tooMuch;                // N
        private Trial _first;
        private Trial _thrust;                  // the last with too much of either sense
        private Trial _tension;
        private Trial _least;                   // force of all that have too much
        private bool _hasAllowed;
        private bool _isLast;
        private int _trials;
        private int _stepsBeyond;
        private double _maxBeyond;             // N

        /// <summary>Seeks the displacement of a hub.</summary>
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

        /// <summary>A step begins, as it is requested.</summary>
        public void Begin()
        {
            _trials = 0;
            _isLast = false;
            _hasAllowed = false;
            _thrust = default;
            _tension = default;
            _least = default;
            Displacement = null;
        }

        /// <summary>What the hub is to go in the next trial, m; null: what it is asked.</summary>
        public double? Displacement { get; private set; }

        /// <summary>Takes a trial.</summary>
        /// <param name="moved">What the hub went, m.</param>
        /// <param name="force">On its instrument after it, N, a thrust positive; NaN where the step has no
        /// solution.</param>
        /// <param name="isOver">Whether no more work may go into the step: it ends with the best of the trials.</param>
        /// <returns>Whether another one is needed.</returns>
        public bool NeedsAnother(double moved, double force, bool isOver)
        {
            bool isTooMuch = !(Math.Abs(force) <= _limit);
            if (!IsLimited || (!isTooMuch && (_trials == 0 || Math.Abs(force) >= (1.0 - Close) * _limit)))
            {
                return false;
            }
            if (isTooMuch && (!_least.IsMade || Math.Abs(force) < Math.Abs(_least.Force)) && !double.IsNaN(force))
            {
                _least = new Trial(moved, force);
            }
            if (_trials++ >= MaxTrials || isOver || _isLast)
            {
                // Where the force jumps past the limit, as far as it is no more.
                Displacement = _hasAllowed ? _allowed : _least.Moved;
                bool isRepeated = isTooMuch && (_hasAllowed || _least.IsMade) && !_isLast && Displacement != moved;
                _isLast = true;
                return isRepeated;
            }
            if (isTooMuch)
            {
                Take(new Trial(moved, force));
            }
            else
            {
                TakeAllowed(moved, force);
            }
            Displacement = _hasAllowed ? Between() : _thrust.IsMade && _tension.IsMade ? BetweenSenses()
                : Back(moved, force);
            return Displacement != moved;
        }

        /// <summary>A step has ended, with more than the limit where no trial had less.</summary>
        /// <param name="force">N.</param>
        public void EndStep(double force)
        {
            if (Math.Abs(force) > (1.0 + Exact) * _limit)
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
                : WarningTable.HubForce.With(name, _maxBeyond, _limit, _stepsBeyond);
        }

        /// <summary>Writes or restores what the steps had beyond the limit.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _stepsBeyond);
            snapshot.Serialize(ref _maxBeyond);
        }

        private void Take(in Trial trial)
        {
            _first = _trials == 1 ? trial : _first;
            _tooFar = trial.Moved;
            _tooMuch = trial.Force;
            if (trial.Force > 0.0)
            {
                _thrust = trial;
            }
            else if (trial.Force < 0.0)
            {
                _tension = trial;
            }
        }

        private void TakeAllowed(double moved, double force)
        {
            if (!_hasAllowed && _thrust.IsMade && _tension.IsMade && !double.IsNaN(_first.Force))
            {
                // What was asked lies on its side.
                Trial beyond = _first.Force > 0.0 ? _thrust : _tension;
                _tooFar = beyond.Moved;
                _tooMuch = beyond.Force;
            }
            _hasAllowed = true;
            _allowed = moved;
            _allowedForce = force;
        }

        private double BetweenSenses()
        {
            double fraction = _trials % 3 == 0 ? 0.5
                : Math.Min(0.95, Math.Max(0.05, _tension.Force / (_tension.Force - _thrust.Force)));
            return _tension.Moved + fraction * (_thrust.Moved - _tension.Moved);
        }

        // Rest first, then farther and farther back.
        private double Back(double moved, double force)
        {
            double sense = !double.IsNaN(force) ? Math.Sign(force)
                : Math.Sign(_drive.CommandedDisplacement == 0.0 ? -moved : moved);
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

        private readonly struct Trial
        {
            public readonly double Moved;   // m
            public readonly double Force;   // N; NaN where the step has no solution
            public readonly bool IsMade;

            public Trial(double moved, double force)
            {
                Moved = moved;
                Force = force;
                IsMade = true;
            }
        }
    }
}
