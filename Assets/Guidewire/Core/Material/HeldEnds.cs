using System;

namespace Guidewire.Core
{
    /// <summary>Puts the held ends of a material rod and the clamps' frames where the schedule wants them, and counts
    /// the work that this does on the wire.</summary>
    internal sealed class HeldEnds
    {
        private readonly MaterialScene _scene;
        private readonly RodStatics _statics;
        private readonly bool _holdsFirst;
        private readonly bool _holdsLast;
        private double _proximalTurn = double.NaN;
        private double _distalTurn = double.NaN;

        /// <summary>The ends of this scene.</summary>
        public HeldEnds(MaterialScene scene, RodStatics statics)
        {
            _scene = scene;
            _statics = statics;
            _holdsFirst = scene.Supports.Proximal != ProximalEnd.Free;
            _holdsLast = scene.Supports.Distal != DistalEnd.Free;
        }

        /// <summary>Work done on the wire since the start, J: the mean of force and couple before and after a move,
        /// times the move, which is exact while the stress is proportional to it.</summary>
        public double Work { get; private set; }

        /// <summary>The most that <see cref="Work"/> has been, J.</summary>
        public double MostWork { get; private set; }

        /// <summary>Places and frames of this time.</summary>
        public void Place(RodShape shape, double time)
        {
            RodSchedule schedule = _scene.Schedule;
            if (_holdsFirst)
            {
                Shift(shape, 0, 0, -0.5, schedule.ProximalPositionAt(time));
            }
            if (_holdsLast)
            {
                int last = shape.ElementCount;
                Shift(shape, last, last - 1, 0.5, schedule.DistalPositionAt(time));
            }
            double proximalTurn = schedule.ProximalTurnAt(time);
            double distalTurn = schedule.DistalTurnAt(time);
            if (proximalTurn != _proximalTurn || distalTurn != _distalTurn)
            {
                Turn(shape, proximalTurn, distalTurn);
            }
            MostWork = Math.Max(MostWork, Work);
        }

        private void Shift(RodShape shape, int node, int element, double halfSign, in Vector3d to)
        {
            Vector3d move = to - shape.X[node];
            if (move == Vector3d.Zero)
            {
                return;
            }
            Vector3d force = Force(shape, element);
            shape.X[node] = to;
            Work += halfSign * Vector3d.Dot(force + Force(shape, element), move);
        }

        private void Turn(RodShape shape, double proximalTurn, double distalTurn)
        {
            Quaterniond proximal = shape.ProximalFrame;
            Quaterniond distal = shape.DistalFrame;
            Vector3d couple = _statics.Bending.ProximalCouple(shape);
            Vector3d endCouple = _statics.Bending.DistalCouple(shape);
            _proximalTurn = proximalTurn;
            _distalTurn = distalTurn;
            _scene.Schedule.TurnFrames(shape, proximalTurn, distalTurn);
            couple += _statics.Bending.ProximalCouple(shape);
            endCouple += _statics.Bending.DistalCouple(shape);
            Work += 0.5 * (Vector3d.Dot(couple, Between(proximal, shape.ProximalFrame))
                + Vector3d.Dot(endCouple, Between(distal, shape.DistalFrame)));
        }

        // What the element pulls its second node back with, in the world.
        private Vector3d Force(RodShape shape, int element)
        {
            return Quaterniond.Rotate(shape.Q[element], _statics.Stretch.Stress(shape, element, out _));
        }

        private static Vector3d Between(in Quaterniond before, in Quaterniond after)
        {
            return Quaterniond.Rotate(before, RotationVector.Log(before.Conjugate * after));
        }
    }
}
