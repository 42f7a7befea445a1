using System;
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
}
