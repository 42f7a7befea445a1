namespace Guidewire.Core
{
    /// <summary>Counts steps and gives the time, t = t_0 + (k - k_0) dt, where k_0 is the step at which dt was last
    /// changed.</summary>
    internal sealed class StepClock
    {
        private readonly double _timeStep;
        private int _step;
        private int _originStep;
        private double _originTime;

        /// <param name="timeStep">dt, s.</param>
        public StepClock(double timeStep)
        {
            _timeStep = timeStep;
        }

        /// <summary>Counts the steps so far.</summary>
        public int StepCount => _step;

        /// <summary>t after them, s.</summary>
        public double Time => _originTime + (_step - _originStep) * _timeStep;

        /// <summary>Counts one step more.</summary>
        public void Advance() => _step++;

        /// <summary>Writes the clock into a snapshot, or goes on from one; with another dt from that moment
        /// on.</summary>
        public void Serialize(Snapshot snapshot)
        {
            double timeStep = _timeStep;
            snapshot.Serialize(ref timeStep);
            snapshot.Serialize(ref _step);
            snapshot.Serialize(ref _originStep);
            snapshot.Serialize(ref _originTime);
            if (timeStep != _timeStep)
            {
                _originTime += (_step - _originStep) * timeStep;
                _originStep = _step;
            }
        }
    }
}
