namespace Guidewire.Core
{
    /// <summary>Holds the last sphere and the frame of the last element, in addition to another drive's motion of
    /// sphere 0: at their start, displaced along the frame's d3 and turned about it as prescribed in time.</summary>
    /// <remarks>They must be of inverse mass and orientation weight 0, or the iterations move them.</remarks>
    internal sealed class DistalClampDrive : IDriveMotion
    {
        private readonly IDriveMotion? _motion;
        private readonly RodSchedule _schedule;
        private readonly StepClock _clock;

        /// <param name="motion">What moves sphere 0, or null.</param>
        /// <param name="schedule">The clamp's position, frame and motion in time.</param>
        /// <param name="timeStep">dt, s.</param>
        public DistalClampDrive(IDriveMotion? motion, RodSchedule schedule, double timeStep)
        {
            _motion = motion;
            _schedule = schedule;
            _clock = new StepClock(timeStep);
        }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            _motion?.Move(state);
            _clock.Advance();
            double time = _clock.Time;
            state.PredictedPositions[state.ElementCount] = _schedule.Distal.PositionAt(time);
            state.PredictedOrientations[state.ElementCount - 1] = _schedule.Distal.FrameAt(time);
        }

        /// <summary>Writes into a snapshot, or restores from one, where the clamp's motion stands.</summary>
        public void Serialize(Snapshot snapshot)
        {
            _clock.Serialize(snapshot);
            _schedule.Serialize(snapshot, _clock.Time);
        }
    }
}
