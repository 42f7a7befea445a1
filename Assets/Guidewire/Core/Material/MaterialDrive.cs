namespace Guidewire.Core
{
    /// <summary>Prescribes the motion of node 0 of a material rod within the next step, as the scene's drive has
    /// it.</summary>
    internal sealed class MaterialDrive
    {
        private readonly RodSchedule _schedule;
        private readonly IDriveDirection? _direction;
        private readonly double _speed;  // m/s
        private readonly bool _followsSpring;

        /// <summary>The drive of this scene.</summary>
        /// <param name="followsSpring">Whether node 0 follows its place on a spring, which gives way a little.</param>
        public MaterialDrive(SimulationParameters parameters, Scene scene, bool followsSpring)
        {
            _followsSpring = followsSpring;
            _schedule = scene.Schedule;
            _direction = scene.Drive;
            _speed = scene.UnitLength * parameters.Drive.DisplacementPerStep / parameters.Method.TimeStep;
        }

        /// <summary>Sets where node 0 is and how fast it goes, from this time on.</summary>
        public void Prepare(RodShape shape, double time)
        {
            if (_direction == null)
            {
                return;
            }
            _schedule.ProximalPosition = _followsSpring ? _schedule.ProximalPositionAt(time) : shape.X[0];
            _schedule.ProximalTime = time;
            _schedule.ProximalVelocity = _speed * _direction.At(shape.X[0], shape.X[1]);
        }
    }
}
