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

        /// <summary>Places and frames of this time.</summary>
        public void Place(RodShape shape, double time)
        {
            RodSchedule schedule = _scene.Schedule;
            int last = shape.ElementCount;
            Vector3d first = _holdsFirst ? schedule.ProximalPositionAt(time) : shape.X[0];
            Vector3d end = _holdsLast ? schedule.DistalPositionAt(time) : shape.X[last];
            Quaterniond proximal = shape.ProximalFrame;
            Quaterniond distal = shape.DistalFrame;
            Vector3d firstMove = first - shape.X[0];
            Vector3d endMove = end - shape.X[last];
            bool shifts = firstMove != Vector3d.Zero || endMove != Vector3d.Zero;
            Vector3d firstForce = shifts ? Force(shape, 0) : Vector3d.Zero;
            Vector3d endForce = shifts ? Force(shape, last - 1) : Vector3d.Zero;
            Vector3d couple = _statics.Bending.ProximalCouple(shape);
            Vector3d endCouple = _statics.Bending.DistalCouple(shape);

            schedule.TurnFrames(shape, schedule.ProximalTurnAt(time), schedule.DistalTurnAt(time));
            shape.X[0] = first;
            shape.X[last] = end;

            if (shifts)
            {
                Work += 0.5 * (Vector3d.Dot(endForce + Force(shape, last - 1), endMove)
                    - Vector3d.Dot(firstForce + Force(shape, 0), firstMove));
            }
            couple += _statics.Bending.ProximalCouple(shape);
            endCouple += _statics.Bending.DistalCouple(shape);
            Work += 0.5 * (Vector3d.Dot(couple, Turn(proximal, shape.ProximalFrame))
                + Vector3d.Dot(endCouple, Turn(distal, shape.DistalFrame)));
        }

        // What the element pulls its second node back with, in the world.
        private Vector3d Force(RodShape shape, int element)
        {
            return Quaterniond.Rotate(shape.Q[element], _statics.Stretch.Stress(shape, element, out _));
        }

        private static Vector3d Turn(in Quaterniond before, in Quaterniond after)
        {
            return Quaterniond.Rotate(before, RotationVector.Log(before.Conjugate * after));
        }
    }
}
