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
        private const int MaxRefined = 6;       // of them next to a jump, beyond which the force is allowed
        private const double Near = 1.0 / 64.0; // of the shortest displacement: the first one from what was found last
        private const double Growth = 4.0;      // of it from one trial to the next
        private const double Same = 1e-6;       // of what is asked: it is as before

        private readonly HubLimit _limit;
        private readonly double _shortest;      // m, by which a hub that may not rest gives way at first
        private readonly double _most;          // m, that it slips in a step
        private double _asked;                  // m
        private double _away;                   // m, of the next trial from this one; 0: it began with what was asked
        private Trial _thrust;                  // the last with too much of either sense
        private Trial _tension;
        private Trial _allowed;                 // the last with no more than the limit
        private Trial _beyond;                  // on the side of what was asked, with too much
        private Trial _least;                   // force of all that have too much
        private bool _isLast;
        private int _trials;
        private int _refined;
        private Found _foundBefore;             // in the step before
        private Found _found;                   // last, in this step or before

        /// <summary>Seeks the displacement of a hub.</summary>
        /// <param name="shortest">m.</param>
        /// <param name="most">That it goes in a step where it slips, m, as far as that is not asked.</param>
        public HubSlip(in HubLimit limit, double shortest, double most = double.PositiveInfinity)
        {
            _limit = limit;
            Record = new SlipRecord(limit);
            _most = most;
            _shortest = Math.Min(shortest, most);
        }

        /// <summary>The forces at which it slips.</summary>
        public HubLimit Limit => _limit;

        /// <summary>Whether there is a limit.</summary>
        public bool IsLimited => _limit.IsLimited;

        /// <summary>What it does at its limit.</summary>
        public SlipRecord Record { get; }

        /// <summary>A step begins with what was found in the one before.</summary>
        public void BeginStep() => _found = _foundBefore;

        /// <summary>Trials begin: of a step, or of another displacement of what is around it.</summary>
        /// <param name="asked">What the hub is to go, m.</param>
        /// <param name="around">What the next hub around it goes, m; null: what it went last.</param>
        public void Begin(double asked, double? around)
        {
            _asked = asked;
            _trials = 0;
            _refined = 0;
            _isLast = false;
            _thrust = default;
            _tension = default;
            _allowed = default;
            _beyond = default;
            _least = default;
            bool isLike = _found.Slipped && Math.Abs(asked - _found.Asked) <= Same * Math.Abs(asked);
            Displacement = isLike ? Within(_found.Moved + ((around ?? _found.Around) - _found.Around)) : (double?)null;
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
            bool isTooMuch = _limit.Excess(force) != 0.0;
            if (_isLast && isTooMuch && _allowed.IsMade && _trials < MaxTrials && !isOver)
            {
                // Hubs inside have found other displacements than before.
                (_isLast, _allowed, _refined) = (false, default, 0);
            }
            if (!IsLimited || _isLast || (!isTooMuch && (Displacement == null
                || (Math.Abs(force) >= (1.0 - Close) * _limit.Of(force) && force * (_asked - moved) >= 0.0))))
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
            // Wider apart the two may have a steep force between them, such as that of friction that turns.
            _refined += _allowed.IsMade && _beyond.IsMade && Math.Abs(_beyond.Moved - _allowed.Moved) <= _shortest
                && _allowed.Force * (_asked - _allowed.Moved) < 0.0 ? 1 : 0;
            if (_trials++ >= MaxTrials || _refined > MaxRefined || isOver)
            {
                return EndAtBest(moved, around);
            }
            double? next = _allowed.IsMade ? _beyond.IsMade ? Between() : Away(moved, Math.Sign(_asked - moved))
                : _thrust.IsMade && _tension.IsMade ? BetweenSenses()
                : _away > 0.0 ? Away(moved, -sense) : Back(moved, around, sense);
            Displacement = next is double far ? Within(far) : next;
            if (Displacement == moved && isTooMuch)
            {
                // It slips as fast as it may.
                return EndAtBest(moved, around);
            }
            return Displacement != moved || End(moved, around);
        }

        /// <summary>A step has ended, with more than the limit where no trial had less.</summary>
        /// <param name="force">N.</param>
        /// <param name="time">s.</param>
        public void EndStep(double force, double time)
        {
            _foundBefore = _found;
            Record.Record(IsLimited && _found.Slipped && _found.Moved != _found.Asked, force, time);
        }

        /// <summary>Writes or restores what was found in the step before, and in a run what the steps had beyond the
        /// limit.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _foundBefore.Slipped);
            snapshot.Serialize(ref _foundBefore.Moved);
            snapshot.Serialize(ref _foundBefore.Around);
            snapshot.Serialize(ref _foundBefore.Asked);
            if (!snapshot.IsStep)
            {
                Record.Serialize(snapshot);
            }
        }

        // Where the force jumps past the limit, or a slip has a speed, as far as it is no more, or the least.
        private bool EndAtBest(double moved, double around)
        {
            _isLast = true;
            Trial best = _allowed.IsMade ? _allowed : _least;
            if (!best.IsMade || best.Moved == moved)
            {
                return End(moved, around);
            }
            Displacement = best.Moved;
            return true;
        }

        private double Within(double displacement) =>
            Math.Min(Math.Max(displacement, Math.Min(_asked, -_most)), Math.Max(_asked, _most));

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
                double target = Math.Sign(_beyond.Force) * (1.0 - 0.5 * Close) * _limit.Of(_beyond.Force);
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

    /// <summary>The hubs of coaxial instruments, of which some have a hubForceLimit: a step is taken again, with other
    /// displacements of those, until none has more than its force.</summary>
    /// <remarks>In each trial of one hub those of the instruments inside it are found anew.</remarks>
    internal sealed class SlippingHubs
    {
        private readonly DirectStep _step;
        private readonly MaterialDrive[] _drives;
        private readonly HubSlip[] _slips;
        private readonly StepStart _start;
        private readonly bool _areLimited;

        /// <summary>Makes the search for the slips of a step's hubs.</summary>
        /// <param name="start">Restores its start.</param>
        public SlippingHubs(DirectStep step, StepStart start)
        {
            _step = step;
            _drives = step.Drives;
            _slips = step.Slips;
            _start = start;
            _areLimited = Array.Exists(_slips, slip => slip.IsLimited);
        }

        /// <summary>A step begins, whose start has been saved.</summary>
        public void BeginStep()
        {
            foreach (HubSlip slip in _slips)
            {
                slip.BeginStep();
            }
            BeginFrom(0);
        }

        /// <summary>Whether the step is to be taken again, from its start, with other displacements.</summary>
        /// <param name="isDone">Whether it has a solution with those that it had.</param>
        public bool NeedAnother(bool isDone)
        {
            WorkLimit work = _step.Dynamics.Work;
            for (int i = _drives.Length - 1; i >= 0 && _areLimited; i--)
            {
                double force = isDone && _slips[i].IsLimited ? Borne(i) : double.NaN;
                double around = i > 0 ? _drives[i - 1].Moved : 0.0;
                if (_slips[i].NeedsAnother(_drives[i].Moved, around, force, work.IsScarce))
                {
                    _start.Restore();
                    work.Count();
                    _drives[i].OverrideDisplacement(_slips[i].Displacement);
                    BeginFrom(i + 1);
                    return true;
                }
            }
            for (int i = 0; i < _drives.Length && _areLimited; i++)
            {
                _drives[i].OverrideDisplacement(null);
                _slips[i].EndStep(isDone && _slips[i].IsLimited ? _step.ForceOf(i) : 0.0, _step.Dynamics.Time);
            }
            return false;
        }

        // A hub that carries others along bears their forces too: what it has too much of it, they have too much.
        private double Borne(int hub)
        {
            double force = _step.ForceOf(hub);
            double sum = force;
            HubLimit own = _slips[hub].Limit;
            int sense = _drives[hub].Carried;
            for (int i = hub; sense != 0 && _drives[i].Carried == sense;)
            {
                i += sense;
                sum += _step.ForceOf(i);
                double excess = _slips[i].Limit.Excess(sum);
                force = sense * excess > 0.0
                    ? sense * Math.Max(sense * force, own.Of(sense) + Math.Abs(excess)) : force;
            }
            return force;
        }

        private void BeginFrom(int hub)
        {
            for (int i = hub; i < _drives.Length && _areLimited; i++)
            {
                _slips[i].Begin(_drives[i].AskedAt(_step.Dynamics.Time), i > 0 ? _slips[i - 1].Displacement : 0.0);
                _drives[i].OverrideDisplacement(_slips[i].Displacement);
            }
        }
    }
}
