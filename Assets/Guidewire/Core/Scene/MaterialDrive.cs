namespace Guidewire.Core
{
    /// <summary>Prescribes the motion of node 0 of a material rod within the next step: none, along a fixed axis, or
    /// along the first element (thesis eq. 3.6).</summary>
    internal sealed class MaterialDrive
    {
        private readonly RodSchedule _schedule;
        private readonly Drive _drive;
        private readonly Vector3d _direction;
        private readonly double _speed;  // m/s

        /// <summary>The drive of these parameters.</summary>
        public MaterialDrive(SimulationParameters parameters, RodSchedule schedule)
        {
            _schedule = schedule;
            _drive = parameters.Drive.Kind;
            _direction = Vector3d.Normalize(parameters.Drive.DisplacementDirection);
            _speed = parameters.Scene.MetresPerUnit * parameters.Drive.DisplacementPerStep / parameters.Method.TimeStep;
        }

        /// <summary>Sets where node 0 is and how fast it goes, from this time on.</summary>
        public void Prepare(RodShape shape, double time)
        {
            if (_drive != Drive.Displace && _drive != Drive.Push)
            {
                return;
            }
            _schedule.ProximalPosition = shape.X[0];
            _schedule.ProximalTime = time;
            _schedule.ProximalVelocity = _speed * (_drive == Drive.Push
                ? Vector3d.Normalize(shape.X[1] - shape.X[0]) : _direction);
        }
    }
}
