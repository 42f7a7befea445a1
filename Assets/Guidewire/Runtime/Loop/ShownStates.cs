using System;
using System.Threading;
using Guidewire.Core;
using Guidewire.Io;

namespace Guidewire.Runtime
{
    /// <summary>What the host has of a run: its two newest states, and what is shown between them.</summary>
    internal sealed class ShownStates
    {
        private WireState _older;
        private WireState _newer;
        private double _time;    // shown, s

        /// <summary>Makes the states of a run that stands at its start.</summary>
        public ShownStates(SimulationSession session)
        {
            _older = new WireState(session);
            _newer = new WireState(session);
            Shown = new WireState(session);
            foreach (WireState state in new[] { _older, _newer, Shown })
            {
                state.CopyFrom(session, false, false);
            }
            _time = _newer.Time;
        }

        /// <summary>The state after the newest step.</summary>
        public WireState Newest => _newer;

        /// <summary>The state that views draw.</summary>
        public WireState Shown { get; }

        /// <summary>Takes the newest state.</summary>
        /// <returns>False where there is none since the last.</returns>
        public bool TakeNewest(StateExchange exchange)
        {
            if (!exchange.TakeNewest(ref _older))
            {
                return false;
            }
            (_older, _newer) = (_newer, _older);
            return true;
        }

        /// <summary>Moves what is shown on in time, never beyond the newest state.</summary>
        /// <param name="seconds">In-game time; infinite: to the newest state.</param>
        public void Show(double seconds)
        {
            _time = Math.Min(_newer.Time, Math.Max(_time, _older.Time) + seconds);
            double length = _newer.Time - _older.Time;
            bool isBetween = length > 0.0 && _time >= _older.Time;
            Shown.Interpolate(_older, _newer, isBetween ? (_time - _older.Time) / length : 1.0);
        }
    }

    /// <summary>Hands states from the thread that steps to the one that shows: neither ever waits. Each has a state of
    /// its own, a third lies between them.</summary>
    internal sealed class StateExchange
    {
        private WireState _between;

        /// <summary>Makes the exchange with the state that lies between them at first.</summary>
        public StateExchange(WireState between)
        {
            _between = between;
        }

        /// <summary>Leaves a state for the other thread, in place of one that it may not have taken.</summary>
        /// <param name="mine">Written; then another one to write into.</param>
        public void Publish(ref WireState mine)
        {
            mine.IsNew = true;
            mine = Interlocked.Exchange(ref _between, mine);
        }

        /// <summary>Takes the newest state.</summary>
        /// <param name="mine">The oldest that is no longer needed; then the newest.</param>
        /// <returns>False where there is none since the last.</returns>
        public bool TakeNewest(ref WireState mine)
        {
            if (!Volatile.Read(ref _between).IsNew)
            {
                return false;
            }
            mine.IsNew = false;
            mine = Interlocked.Exchange(ref _between, mine);
            return true;
        }
    }
}
