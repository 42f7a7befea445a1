using System;

namespace Guidewire.Core
{
    /// <summary>Detects when the tip of a wire leaves a vessel by an open rim or end, beyond which no wall is near:
    /// inside before a step, outside after it, and no passage in it. A tip that is drawn back into a sheath or a
    /// catheter has not left.</summary>
    internal sealed class RimMonitor
    {
        private readonly ContactShape[] _walls;
        private readonly Func<ContactShape, WallField?, bool> _isCovered;    // by what is not outside
        private readonly Func<int, WallField?> _fieldOf;
        private readonly bool[] _isInside;    // the tip, by wall
        private long _passages;
        private bool _hasLeft;
        private Vector3d _position;              // of the tip where it first was outside, units
        private double _time;                 // s

        /// <summary>A monitor of these walls; <see cref="Begin"/> says where the tip is.</summary>
        /// <param name="isCovered">Whether the tip is in a sheath, or in a catheter with its tip within a wall.</param>
        /// <param name="fieldOf">Where a wall is that moves; null where it stands still.</param>
        public RimMonitor(ContactShape[] walls, Func<ContactShape, WallField?, bool> isCovered,
            Func<int, WallField?> fieldOf)
        {
            (_isCovered, _fieldOf) = (isCovered, fieldOf);
            _walls = walls;
            _isInside = new bool[walls.Length];
        }

        /// <summary>Where and when the tip left first, or null.</summary>
        public RunWarning? Warning => _hasLeft
            ? WarningTable.OpenRim.With(_position.X, _position.Y, _position.Z, _time) : (RunWarning?)null;

        /// <summary>The wire is in this state.</summary>
        public void Begin(RodState state)
        {
            Vector3d tip = state.Positions[state.ElementCount];
            for (int w = 0; w < _walls.Length; w++)
            {
                _isInside[w] = IsWithin(w, tip);
            }
        }

        /// <summary>Takes the state at the end of a step.</summary>
        /// <param name="time">s.</param>
        public void Update(RodState state, ContactRecord? contacts, double time)
        {
            Vector3d tip = state.Positions[state.ElementCount];
            long passages = contacts?.Passages ?? 0;
            for (int w = 0; w < _walls.Length && !_hasLeft; w++)
            {
                bool wasInside = _isInside[w];
                _isInside[w] = IsWithin(w, tip)
                    || wasInside && _isCovered(_walls[w], _fieldOf(w));
                if (wasInside && !_isInside[w] && passages == _passages && tip.IsFinite)
                {
                    _hasLeft = true;
                    _position = tip;
                    _time = time;
                }
            }
            _passages = passages;
        }

        private bool IsWithin(int w, in Vector3d tip) =>
            _walls[w].IsWithin(_fieldOf(w)?.AtRest(tip) ?? tip);

        /// <summary>Writes or restores what was seen.</summary>
        /// <param name="state">Where the wire is.</param>
        public void Serialize(Snapshot snapshot, RodState state)
        {
            snapshot.Serialize(ref _passages);
            snapshot.Serialize(ref _hasLeft);
            snapshot.Serialize(ref _position);
            snapshot.Serialize(ref _time);
            Begin(state);
        }
    }
}
