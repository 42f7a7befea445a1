using System;

namespace Guidewire.Core
{
    /// <summary>Moves sphere 0 within a step, after the prediction and before the constraints.</summary>
    internal interface IDriveMotion
    {
        /// <summary>Writes the predicted position of sphere 0.</summary>
        void Move(RodState state);
    }

    /// <summary>Moves sphere 0 in every step by a given displacement in the direction of the scene's drive.</summary>
    internal sealed class ProximalDrive : IDriveMotion
    {
        private readonly IDriveDirection _direction;
        private readonly double _perStep;

        /// <param name="direction">The direction.</param>
        /// <param name="perStep">Units a step; negative values move backwards.</param>
        public ProximalDrive(IDriveDirection direction, double perStep)
        {
            _direction = direction;
            _perStep = perStep;
        }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            Vector3d[] x = state.Positions;
            state.PredictedPositions[0] = x[0] + _perStep * _direction.At(x[0], x[1]);
        }
    }

    /// <summary>Turns element 0 about its own axis every step, in addition to another drive's motion of sphere 0, as
    /// physicians rotate a wire (thesis, outlook): q_0 -> q_0 (cos a/2 + e3 sin a/2). The bend-twist constraint carries
    /// it to the
    /// tip.</summary>
    /// <remarks>The drive holds the frame of element 0: its orientation has weight 0 and turns as asked, and no
    /// further.</remarks>
    internal sealed class TwistDrive : IDriveMotion
    {
        private readonly IDriveMotion? _motion;
        private readonly Quaterniond _turn;

        /// <param name="motion">What moves sphere 0, or null.</param>
        /// <param name="perStep">a in radians a step.</param>
        public TwistDrive(IDriveMotion? motion, double perStep)
        {
            _motion = motion;
            _turn = Quaterniond.FromAxisAngle(Vector3d.UnitZ, perStep);
        }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            _motion?.Move(state);
            state.PredictedOrientations[0] = Quaterniond.Normalize(state.Orientations[0] * _turn);
        }
    }

    /// <summary>Moves sphere 0 along the first element and turns that element about its axis, as the user
    /// steers.</summary>
    /// <remarks>The user holds the frame of element 0, also while steering asks for nothing: its orientation has weight
    /// 0. A pbd wire has no force at which the hand would slip: it slips where an element is strained as far as <see
    /// cref="Steering.SlipStrain"/> says, in the direction that strains it further.</remarks>
    internal sealed class SteeredDrive : IDriveMotion
    {
        private readonly Steering _steering;
        private readonly AlongFirstElement _direction = new AlongFirstElement();

        /// <param name="steering">What the user asks.</param>
        public SteeredDrive(Steering steering)
        {
            _steering = steering;
        }

        /// <summary>Takes what the hand slipped; null: nothing does.</summary>
        public ContactRecord? Record { get; set; }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            Vector3d[] x = state.Positions;
            double push = Slips(state) ? 0.0 : _steering.Push;
            Record?.AddDrive(Math.Abs(_steering.Push - push), Math.Abs(_steering.Push - push));
            state.PredictedPositions[0] = x[0] + push * _direction.At(x[0], x[1]);
            Quaterniond turn = Quaterniond.FromAxisAngle(Vector3d.UnitZ, _steering.Turn);
            state.PredictedOrientations[0] = Quaterniond.Normalize(state.Orientations[0] * turn);
        }

        private bool Slips(RodState state)
        {
            Vector3d[] x = state.Positions;
            for (int i = 1; i < x.Length; i++)
            {
                double strain = Vector3d.Distance(x[i], x[i - 1]) / state.ElementLength - 1.0;
                if (-Math.Sign(_steering.Push) * strain > _steering.SlipStrain)
                {
                    return true;
                }
            }
            return false;
        }
    }

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
