using System;

namespace Guidewire.Core
{
    /// <summary>The motion of one hub, the support and clamp of node 0: position, velocity and turn, as its drive
    /// prescribes them. The wire in a sheath follows its hub on a spring: the frame of its first joint is then
    /// held.</summary>
    internal sealed class HubMotion
    {
        private Vector3d _position;        // at _positionTime, m
        private Vector3d _velocity;        // m/s
        private double _positionTime;      // s
        private Quaterniond _frame;        // of the clamp at time 0
        private double _twistRate;         // about its d3, rad/s
        private double _turnOrigin;        // turn at _turnOriginTime, radians
        private double _turnOriginTime;    // s
        private double _driveEnd = double.NegativeInfinity;  // s
        private readonly EndMotion? _motion;     // instead of a drive's
        private double? _heldTurn;           // of the frame to which the first element is clamped, radians

        /// <summary>A hub at rest that turns at a constant rate.</summary>
        /// <param name="position">Of node 0, m.</param>
        /// <param name="frame">Of the clamp at time 0.</param>
        /// <param name="twistRate">About its own d3, rad/s.</param>
        /// <param name="motion">In six degrees of freedom, or null.</param>
        public HubMotion(in Vector3d position, in Quaterniond frame, double twistRate, EndMotion? motion = null)
        {
            _motion = motion;
            _position = position;
            _frame = frame;
            _twistRate = twistRate;
        }

        /// <summary>The frame to which the first element is clamped is held at a turn from now on, radians.</summary>
        public void HoldFrame(double turn) => _heldTurn = turn;

        /// <summary>The run begins with this frame.</summary>
        public void Begin(in Quaterniond frame) => _frame = frame;

        /// <summary>The run begins with the hub displaced by so much, m, and turned, radians.</summary>
        public void BeginAt(in Vector3d displacement, double turn)
        {
            Shift(displacement);
            _turnOrigin = turn;
        }

        /// <summary>Velocity of node 0 by its drive, m/s.</summary>
        public Vector3d Velocity => _velocity;

        /// <summary>The motion in six degrees of freedom, or null.</summary>
        public EndMotion? Motion => _motion;

        /// <summary>Gives the velocity of node 0 at this time, of two at a jump that after it, m/s.</summary>
        public Vector3d VelocityAt(double time) => _motion == null ? _velocity : _motion.VelocityAt(time);

        /// <summary>Turning of the hub about its own d3, rad/s.</summary>
        public double TwistRate => _twistRate;

        /// <summary>The clamp's frame at time 0.</summary>
        public Quaterniond Frame => _frame;

        /// <summary>Turning of the frame to which the first element is clamped, rad/s.</summary>
        public double FrameTwistRate => _heldTurn.HasValue ? 0.0 : _twistRate;

        /// <summary>Gives the position of node 0 at this time, m.</summary>
        public Vector3d PositionAt(double time)
        {
            Vector3d position = _position + (time - _positionTime) * _velocity;
            return _motion == null ? position : position + _motion.DisplacementAt(time);
        }

        /// <summary>Gives the turn of the hub at this time, radians.</summary>
        public double TurnAt(double time) => _turnOrigin + _twistRate * (time - _turnOriginTime);

        /// <summary>Turn of the frame to which the first element is clamped at this time, radians.</summary>
        public double FrameTurnAt(double time) => _heldTurn ?? TurnAt(time);

        /// <summary>How far the hub is ahead of that frame at this time, radians.</summary>
        public double AheadAt(double time) => _heldTurn.HasValue ? TurnAt(time) - _heldTurn.Value : 0.0;

        /// <summary>Gives the clamp's frame turned by an angle, radians.</summary>
        public Quaterniond FrameTurned(double turn) => _frame * Quaterniond.FromAxisAngle(Vector3d.UnitZ, turn);

        /// <summary>A user or a table moves the hub, up to this time, s: it turns at no rate of its own.</summary>
        public void BeginDrive(double end)
        {
            _twistRate = 0.0;
            _driveEnd = end;
        }

        /// <summary>From this time on, s, node 0 moves from a position, m, at this velocity, m/s.</summary>
        public void MoveOn(double time, in Vector3d position, in Vector3d velocity)
        {
            _position = position;
            _positionTime = time;
            _velocity = velocity;
        }

        /// <summary>From this time on, s, the hub turns at this rate, rad/s.</summary>
        public void TurnOn(double time, double rate)
        {
            _turnOrigin = TurnAt(time);
            _turnOriginTime = time;
            _twistRate = rate;
        }

        /// <summary>The hub is displaced at once, m.</summary>
        public void Shift(in Vector3d displacement) => _position += displacement;

        /// <summary>Whether it is at rest from this time on.</summary>
        public bool IsOver(double time)
        {
            return time >= _driveEnd && (_motion == null || double.IsInfinity(_motion.NextRow(time)))
                && _velocity == Vector3d.Zero && _twistRate == 0.0;
        }

        /// <summary>Writes into a snapshot, or restores from one, where the hub is at this time. In a run its rate
        /// stays its own: a twist at another rate goes on from the present turn, and node 0 stays where a drive has
        /// brought it until a drive takes it on.</summary>
        public void Serialize(Snapshot snapshot, double time)
        {
            double own = _twistRate;
            snapshot.Serialize(ref _position);
            snapshot.Serialize(ref _velocity);
            snapshot.Serialize(ref _positionTime);
            snapshot.Serialize(ref _twistRate);
            snapshot.Serialize(ref _turnOrigin);
            snapshot.Serialize(ref _turnOriginTime);
            if (snapshot.IsStep)
            {
                return;
            }
            snapshot.Serialize(ref _frame);
            if (snapshot.IsWritten)
            {
                return;
            }
            if (_velocity != Vector3d.Zero)
            {
                MoveOn(time, PositionAt(time), Vector3d.Zero);
            }
            if (_twistRate != own)
            {
                TurnOn(time, own);
            }
        }
    }

    /// <summary>The direction in which a drive moves sphere 0, independent of the method, which determines the
    /// displacement in its own units of length.</summary>
    internal interface IDriveDirection
    {
        /// <summary>Gives the drive's direction, a unit vector.</summary>
        /// <param name="first">Where sphere 0 is.</param>
        /// <param name="second">Where sphere 1 is.</param>
        Vector3d At(in Vector3d first, in Vector3d second);
    }

    /// <summary>Drives along the first element, d = (x_1 - x_0)/|x_1 - x_0| (thesis eq. 3.6).</summary>
    internal sealed class AlongFirstElement : IDriveDirection
    {
        /// <inheritdoc/>
        public Vector3d At(in Vector3d first, in Vector3d second) => Vector3d.Normalize(second - first);
    }

    /// <summary>Drives along a fixed axis (Kreibich's control, thesis 3.1.5). In a bend it can pull the wire sideways
    /// through the vessel.</summary>
    internal sealed class FixedAxis : IDriveDirection
    {
        private readonly Vector3d _axis;

        /// <param name="axis">Any length but 0.</param>
        public FixedAxis(in Vector3d axis)
        {
            _axis = Vector3d.Normalize(axis);
        }

        /// <inheritdoc/>
        public Vector3d At(in Vector3d first, in Vector3d second) => _axis;
    }

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
