using System;

namespace Guidewire.Core
{
    /// <summary>The prescribed motion of a held distal end: a displacement along its frame's d3 and a rotation about
    /// it, both growing evenly over a ramp.</summary>
    internal sealed class DistalMotion
    {
        private readonly double _displacement;  // in the end, m
        private readonly double _rotation;      // in the end, radians; more than one turn counts
        private readonly double _rampTime;      // s; 0: at once
        private readonly EndMotion? _motion;    // besides, in six degrees of freedom
        private Vector3d _position;             // before its displacement, m
        private Quaterniond _frame;             // before it turns

        /// <summary>The motion of a scene's distal end.</summary>
        /// <param name="unitLength">Length of one unit, m.</param>
        /// <param name="position">Of the last node before its displacement, m.</param>
        /// <param name="frame">Of the clamp before it turns.</param>
        public DistalMotion(SceneParameters scene, double unitLength, in Vector3d position, in Quaterniond frame)
        {
            _displacement = unitLength * scene.DistalDisplacement;
            _rotation = scene.DistalRotation;
            _rampTime = scene.DistalRampTime;
            _motion = scene.DistalMotion;
            _position = position;
            _frame = frame;
        }

        /// <summary>The motion in six degrees of freedom, or null.</summary>
        public EndMotion? Motion => _motion;

        /// <summary>The frame before it turns.</summary>
        public Quaterniond Frame => _frame;

        /// <summary>Time over which displacement and rotation grow, s; 0: at once.</summary>
        public double RampTime => _rampTime;

        /// <summary>The run begins with this frame.</summary>
        public void Begin(in Quaterniond frame) => _frame = frame;

        /// <summary>Gives the position of the last node at this time, m.</summary>
        public Vector3d PositionAt(double time)
        {
            Vector3d position = _position + (Ramp(time) * _displacement) * _frame.Director3;
            return _motion == null ? position : position + _motion.DisplacementAt(time);
        }

        /// <summary>Gives the velocity of the last node's support at this time, m/s.</summary>
        public Vector3d VelocityAt(double time)
        {
            return _motion != null ? _motion.VelocityAt(time)
                : time < _rampTime ? (_displacement / _rampTime) * _frame.Director3 : Vector3d.Zero;
        }

        /// <summary>Gives the turn of the frame at this time, radians.</summary>
        public double TurnAt(double time) => Ramp(time) * _rotation;

        /// <summary>Gives the turning of the frame about its own d3 at this time, rad/s.</summary>
        public double TwistRateAt(double time) => time < _rampTime ? _rotation / _rampTime : 0.0;

        /// <summary>Gives the frame at this time.</summary>
        public Quaterniond FrameAt(double time) => FrameTurned(TurnAt(time));

        /// <summary>Gives the frame turned by an angle, radians.</summary>
        public Quaterniond FrameTurned(double turn) => _frame * Quaterniond.FromAxisAngle(Vector3d.UnitZ, turn);

        /// <summary>When it comes to rest, s, if that is after this time; else infinite.</summary>
        public double NextJump(double time)
        {
            double row = _motion == null ? double.PositiveInfinity : _motion.NextRow(time);
            return Moves && _rampTime > time ? Math.Min(row, _rampTime) : row;
        }

        /// <summary>Whether it is at rest from this time on.</summary>
        public bool IsOver(double time)
        {
            return !(time < _rampTime && Moves)
                && (_motion == null || double.IsInfinity(_motion.NextRow(time)));
        }

        /// <summary>Writes or restores where it began.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _position);
            snapshot.Serialize(ref _frame);
        }

        private bool Moves => _displacement != 0.0 || _rotation != 0.0;

        private double Ramp(double time) => _rampTime > 0.0 ? Math.Min(1.0, Math.Max(0.0, time / _rampTime)) : 1.0;
    }
}
