using System;

namespace Guidewire.Core
{
    /// <summary>Limits the displacement of a hub in a step so that its force does not exceed its
    /// hubForceLimit.</summary>
    /// <remarks>The displacement is found by repeated steps: F(u) is the hub's force after a step with its
    /// displacement u, and grows with it. Between one with too much force and one with no more than the limit the
    /// interval is halved, or cut where a straight line has the limit, until the force is within 2 % below it. A
    /// hub that may not even rest gives way, farther and farther; where that went from too much of one sense to too
    /// much of the other, the displacement without force lies between. An instrument is stiff along its axis: what
    /// it may be displaced between both limits is some micrometres. So a hub that slips begins with the
    /// displacement that was found last, beside that of what is around it. Where the force jumps from beyond the
    /// limit in one sense to beyond it in the other, it is the least of those that were found.</remarks>
    internal sealed class HubSlip
    {
        private const double Close = 0.02;      // of the limit
        private const int MaxTrials = 24;
        private const double Exact = 1e-3;      // of the limit
        private const double Near = 1.0 / 64.0; // of the shortest displacement: the first one from what was found last
        private const double Growth = 4.0;      // of it from one trial to the next
        private const double Same = 1e-6;       // of what is asked: it is as before

        private readonly double _limit;         // N
        private readonly double _shortest;      // m, by which a hub that may not rest gives way at first
        private double _asked;                  // m
        private double _away;                   // m, of the next trial from this one; 0: it began with what was asked
        private Trial _thrust;                  // the last with too much of either sense
        private Trial _tension;
        private Trial _allowed;                 // the last with no more than the limit
        private Trial _beyond;                  // on the side of what was asked, with too much
        private Trial _least;                   // force of all that have too much
        private bool _isLast;
        private int _trials;
        private Found _foundBefore;             // in the step before
        private Found _found;                   // last, in this step or before
        private int _stepsBeyond;
        private double _maxBeyond;              // N

        /// <summary>Seeks the displacement of a hub.</summary>
        /// <param name="limit">N; 0: it never slips.</param>
        /// <param name="shortest">m.</param>
        public HubSlip(double limit, double shortest)
        {
            _limit = limit > 0.0 ? limit : double.PositiveInfinity;
            _shortest = shortest;
        }

        /// <summary>Whether there is a limit.</summary>
        public bool IsLimited => _limit < double.PositiveInfinity;

        /// <summary>A step begins with what was found in the one before.</summary>
        public void BeginStep() => _found = _foundBefore;

        /// <summary>Trials begin: of a step, or of another displacement of what is around it.</summary>
        /// <param name="asked">What the hub is to go, m.</param>
        /// <param name="around">What the next hub around it goes, m; null: what it went last.</param>
        public void Begin(double asked, double? around)
        {
            _asked = asked;
            _trials = 0;
            _isLast = false;
            _thrust = default;
            _tension = default;
            _allowed = default;
            _beyond = default;
            _least = default;
            bool isLike = _found.Slipped && Math.Abs(asked - _found.Asked) <= Same * Math.Abs(asked);
            Displacement = isLike ? _found.Moved + ((around ?? _found.Around) - _found.Around) : (double?)null;
            _away = isLike ? Near * _shortest : 0.0;
        }

        /// <summary>What the hub is to go in the next trial, m; null: what it is asked.</summary>
        public double? Displacement { get; private set; }

        /// <summary>Takes a trial.</summary>
        /// <param name="moved">What the hub went, m.</param>
        /// <param name="around">What the next hub around it went, m; 0 if there is none.</param>
        /// <param name="force">On its instrument after it, N, a thrust positive; NaN where the step has no
        /// solution.</param>
        /// <param name="isOver">Whether no more work may go into the step: it ends with the best of the trials.</param>
        /// <returns>Whether another one is needed.</returns>
        public bool NeedsAnother(double moved, double around, double force, bool isOver)
        {
            bool isTooMuch = !(Math.Abs(force) <= _limit);
            if (!IsLimited || _isLast || (!isTooMuch && (Displacement == null
                || (Math.Abs(force) >= (1.0 - Close) * _limit && force * (_asked - moved) >= 0.0))))
            {
                return End(moved, around);
            }
            var trial = new Trial(moved, force);
            double sense = !double.IsNaN(force) ? Math.Sign(force) : Math.Sign(_asked == 0.0 ? -moved : moved);
            if (isTooMuch)
            {
                TakeTooMuch(trial, sense);
            }
            else
            {
                _beyond = _allowed.IsMade ? _beyond : _asked > moved ? _thrust : _tension;
                _allowed = trial;
            }
            if (_trials++ >= MaxTrials || isOver)
            {
                // Where the force jumps past the limit, as far as it is no more.
                _isLast = true;
                Trial best = _allowed.IsMade ? _allowed : _least;
                if (!best.IsMade || best.Moved == moved)
                {
                    return End(moved, around);
                }
                Displacement = best.Moved;
                return true;
            }
            double? next = _allowed.IsMade ? _beyond.IsMade ? Between() : Away(moved, Math.Sign(_asked - moved))
                : _thrust.IsMade && _tension.IsMade ? BetweenSenses()
                : _away > 0.0 ? Away(moved, -sense) : Back(moved, around, sense);
            Displacement = next;
            return next != moved || End(moved, around);
        }

        /// <summary>A step has ended, with more than the limit where no trial had less.</summary>
        /// <param name="force">N.</param>
        public void EndStep(double force)
        {
            _foundBefore = _found;
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

        /// <summary>Writes or restores what was found last, and what the steps had beyond the limit.</summary>
        public void Serialize(Snapshot snapshot)
        {
            SerializeStep(snapshot);
            snapshot.Serialize(ref _stepsBeyond);
            snapshot.Serialize(ref _maxBeyond);
        }

        /// <summary>Writes or restores what was found in the step before, for a <see cref="StepStart"/>.</summary>
        public void SerializeStep(Snapshot snapshot)
        {
            snapshot.Serialize(ref _foundBefore.Slipped);
            snapshot.Serialize(ref _foundBefore.Moved);
            snapshot.Serialize(ref _foundBefore.Around);
            snapshot.Serialize(ref _foundBefore.Asked);
        }

        private bool End(double moved, double around)
        {
            _found = new Found
            {
                Slipped = IsLimited && Displacement != null,
                Moved = moved,
                Around = around,
                Asked = _asked,
            };
            return false;
        }

        private void TakeTooMuch(in Trial trial, double sense)
        {
            if (!double.IsNaN(trial.Force) && (!_least.IsMade || Math.Abs(trial.Force) < Math.Abs(_least.Force)))
            {
                _least = trial;
            }
            _beyond = _allowed.IsMade ? trial : default;
            _thrust = sense > 0.0 ? trial : _thrust;
            _tension = sense < 0.0 ? trial : _tension;
        }

        // From what was found last, farther and farther, but not past what was asked.
        private double? Away(double moved, double sense)
        {
            double next = moved + sense * _away;
            _away *= Growth;
            return (_asked - moved) * sense > 0.0 && (_asked - next) * sense <= 0.0 ? (double?)null : next;
        }

        private double BetweenSenses()
        {
            double fraction = _trials % 3 == 0 || double.IsNaN(_tension.Force - _thrust.Force) ? 0.5
                : Math.Min(0.95, Math.Max(0.05, _tension.Force / (_tension.Force - _thrust.Force)));
            return _tension.Moved + fraction * (_thrust.Moved - _tension.Moved);
        }

        // Rest first, in the vessel and in what is around it, whichever is nearer; then farther and farther back.
        private double Back(double moved, double around, double sense)
        {
            double near = sense * Math.Max(0.0, sense * around);
            double far = sense * Math.Min(0.0, sense * around);
            return (moved - near) * sense > 0.0 ? near : (moved - far) * sense > 0.0 ? far
                : moved == far ? far - sense * _shortest : far + 2.0 * (moved - far);
        }

        private double Between()
        {
            double fraction = 0.5;
            if (!double.IsNaN(_beyond.Force) && _trials % 3 != 0)
            {
                double target = Math.Sign(_beyond.Force) * (1.0 - 0.5 * Close) * _limit;
                fraction = Math.Min(0.95, Math.Max(0.05, (target - _allowed.Force) / (_beyond.Force - _allowed.Force)));
            }
            return _allowed.Moved + fraction * (_beyond.Moved - _allowed.Moved);
        }

        private struct Found
        {
            public bool Slipped;
            public double Moved;    // m
            public double Around;   // m, what the next hub around it went
            public double Asked;    // m
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
