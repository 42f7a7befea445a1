namespace Guidewire.Core
{
    /// <summary>Holds the last sphere and the frame of the last element, beside another drive's motion of sphere 0:
    /// where they are at the start, displaced along the frame's d3 and turned about it as prescribed in time.</summary>
    /// <remarks>They must be of inverse mass and orientation weight 0, or the sweeps take them along.</remarks>
    internal sealed class DistalClampDrive : IDriveMotion
    {
        private readonly IDriveMotion? _motion;
        private readonly RodSchedule _schedule;
        private readonly double _timeStep;
        private int _step;

        /// <param name="motion">What moves sphere 0, or null.</param>
        /// <param name="state">The wire at its start.</param>
        /// <param name="parameters">dt, and the clamp's displacement in units, turn and ramp.</param>
        public DistalClampDrive(IDriveMotion? motion, RodState state, SimulationParameters parameters)
        {
            int last = state.ElementCount - 1;
            _motion = motion;
            _timeStep = parameters.Method.TimeStep;
            _schedule = new RodSchedule
            {
                DistalPosition = state.Positions[last + 1],
                DistalFrame = state.Orientations[last],
                DistalDisplacement = parameters.Scene.DistalDisplacement,
                DistalRotation = parameters.Scene.DistalRotation,
                DistalRampTime = parameters.Scene.DistalRampTime,
            };
        }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            _motion?.Move(state);
            _step++;
            double time = _step * _timeStep;
            state.PredictedPositions[state.ElementCount] = _schedule.DistalPositionAt(time);
            state.PredictedOrientations[state.ElementCount - 1] = _schedule.DistalFrameAt(time);
        }
    }
}
