namespace Guidewire.Core
{
    /// <summary>Detects a joint of a pbd wire that has rotated beyond half a turn: it then unwinds in the other
    /// direction, and
    /// the wire has lost a turn.</summary>
    /// <remarks>What a joint is given back goes as the sine of its angle: the most at a quarter of a turn, nothing at
    /// half of one. Orientations follow the double cover of the rotations, so that Re(q_j* q_{j+1}) = cos(angle/2)
    /// changes its sign there and stays so until another turn is lost.</remarks>
    internal sealed class TurnMonitor
    {
        private readonly bool[] _wasBeyond;    // per joint, of the wire as it started
        private int _joint = -1;
        private int _step;

        /// <param name="state">The wire as it starts.</param>
        public TurnMonitor(RodState state)
        {
            _wasBeyond = new bool[state.ElementCount - 1];
            for (int j = 0; j < _wasBeyond.Length; j++)
            {
                _wasBeyond[j] = IsBeyond(state, j);
            }
        }

        /// <summary>The first joint that lost a turn, and when; or null.</summary>
        public RunWarning? Warning => _joint < 0 ? (RunWarning?)null : WarningTable.LostTurn.With(_joint, _step);

        /// <summary>Takes the wire after a step.</summary>
        /// <param name="state">The wire.</param>
        /// <param name="step">Number of the step, from 1.</param>
        public void Update(RodState state, int step)
        {
            for (int j = 0; _joint < 0 && j < _wasBeyond.Length; j++)
            {
                if (IsBeyond(state, j) != _wasBeyond[j])
                {
                    _joint = j;
                    _step = step;
                }
            }
        }

        /// <summary>Writes into a snapshot, or restores from one, what has been seen so far.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _joint);
            snapshot.Serialize(ref _step);
        }

        private static bool IsBeyond(RodState state, int joint)
        {
            Quaterniond a = state.Orientations[joint];
            Quaterniond b = state.Orientations[joint + 1];
            return a.X * b.X + a.Y * b.Y + a.Z * b.Z + a.W * b.W < 0.0;
        }
    }
}
