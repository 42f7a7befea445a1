using System;

namespace Guidewire.Core
{
    /// <summary>Puts the held ends of a material rod and the clamps' frames where the schedule wants them, and counts
    /// the work that this does on the wire.</summary>
    internal sealed class HeldEnds
    {
        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly bool _holdsFirst;
        private readonly bool _holdsLast;
        private double _proximalTurn;  // that the frames have made, radians
        private double _distalTurn;

        /// <summary>The ends of this rod, held by this schedule.</summary>
        public HeldEnds(RodTerms terms, RodSchedule schedule)
        {
            _terms = terms;
            _schedule = schedule;
            _holdsFirst = terms.Supports.Proximal != ProximalEnd.Free;
            _holdsLast = terms.Supports.Distal != DistalEnd.Free;
        }

        /// <summary>Work done on the wire since the start, J: the mean of force and couple before and after a move,
        /// times the move, which is exact while the stress is proportional to it.</summary>
        public double Work { get; private set; }

        /// <summary>The most that <see cref="Work"/> has been, J.</summary>
        public double MostWork { get; private set; }

        /// <summary>Places and frames of this time.</summary>
        public void Place(RodShape shape, double time)
        {
            if (_holdsFirst)
            {
                Shift(shape, 0, _schedule.ProximalPositionAt(time));
            }
            if (_holdsLast)
            {
                Shift(shape, shape.ElementCount, _schedule.DistalPositionAt(time));
            }
            double proximalTurn = _schedule.ProximalTurnAt(time);
            double distalTurn = _schedule.DistalTurnAt(time);
            if (proximalTurn != _proximalTurn || distalTurn != _distalTurn)
            {
                Turn(shape, proximalTurn, distalTurn);
            }
            MostWork = Math.Max(MostWork, Work);
        }

        /// <summary>Writes or takes over the turns that the frames have made.</summary>
        public void ExchangeTurns(Snapshot snapshot)
        {
            snapshot.Exchange(ref _proximalTurn);
            snapshot.Exchange(ref _distalTurn);
        }

        /// <summary>Writes or takes over the work.</summary>
        public void ExchangeWork(Snapshot snapshot)
        {
            double work = Work;
            double most = MostWork;
            snapshot.Exchange(ref work);
            snapshot.Exchange(ref most);
            Work = work;
            MostWork = most;
        }

        private void Shift(RodShape shape, int node, in Vector3d to)
        {
            Vector3d move = to - shape.X[node];
            if (move == Vector3d.Zero)
            {
                return;
            }
            Vector3d force = _terms.EndGradient(shape, node);
            shape.X[node] = to;
            Work += 0.5 * Vector3d.Dot(force + _terms.EndGradient(shape, node), move);
        }

        private void Turn(RodShape shape, double proximalTurn, double distalTurn)
        {
            Quaterniond proximal = shape.ProximalFrame;
            Quaterniond distal = shape.DistalFrame;
            Vector3d couple = _terms.Bending.ProximalCouple(shape);
            Vector3d endCouple = _terms.Bending.DistalCouple(shape);
            _proximalTurn = proximalTurn;
            _distalTurn = distalTurn;
            _schedule.TurnFrames(shape, proximalTurn, distalTurn);
            couple += _terms.Bending.ProximalCouple(shape);
            endCouple += _terms.Bending.DistalCouple(shape);
            Work += 0.5 * (Vector3d.Dot(couple, Between(proximal, shape.ProximalFrame))
                + Vector3d.Dot(endCouple, Between(distal, shape.DistalFrame)));
        }

        private static Vector3d Between(in Quaterniond before, in Quaterniond after)
        {
            return Quaterniond.Rotate(before, RotationVector.Log(before.Conjugate * after));
        }
    }
}
