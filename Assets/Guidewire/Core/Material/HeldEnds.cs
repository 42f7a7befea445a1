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
        private EndState _first;       // when last followed
        private EndState _last;
        private double _carried;       // J

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

        /// <summary>The most that <see cref="Work"/> has been, J, with what it takes to bring the whole wire to the
        /// speed of the ends that are followed.</summary>
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

        /// <summary>The ends are followed from this shape on, in which the frames have made these turns,
        /// radians.</summary>
        public void Follow(RodShape shape, double proximalTurn, double distalTurn)
        {
            _first = Look(shape, 0, shape.ProximalFrame, _terms.Bending.ProximalCouple(shape), proximalTurn);
            _last = Look(shape, shape.ElementCount, shape.DistalFrame, _terms.Bending.DistalCouple(shape), distalTurn);
        }

        /// <summary>Counts what the ends may have put in at most in a step in which a solver has placed them itself, by
        /// forces and couples at its start and its end.</summary>
        /// <remarks>In a step longer than sound needs along the wire, a support that starts or stops leaves forces of
        /// either sign in it, up to EA times the move over L: so no step takes energy out again. What brings a wire at
        /// rest to the speed of its support may be over within a step and leave no force at all: so there is always
        /// room for the energy of the whole wire at that speed.</remarks>
        public void Count(RodShape shape, double proximalTurn, double distalTurn)
        {
            EndState first = _first;
            EndState last = _last;
            Follow(shape, proximalTurn, distalTurn);
            Work += (_holdsFirst ? EndState.MostWork(first, _first) : 0.0)
                + (_holdsLast ? EndState.MostWork(last, _last) : 0.0);
            double speed = _schedule.LargestSpeed(_terms.Rod.TotalLength);
            _carried = Math.Max(_carried, 0.5 * _terms.Mass.Total * speed * speed);
            MostWork = Math.Max(MostWork, Work + _carried);
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
            snapshot.Exchange(ref _carried);
        }

        private EndState Look(RodShape shape, int node, in Quaterniond frame, in Vector3d couple, double turn)
        {
            return new EndState
            {
                Force = _terms.EndGradient(shape, node),
                Place = shape.X[node],
                Couple = Vector3d.Dot(couple, frame.Director3),
                Turn = turn,
            };
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

        // Force on an end, N; its place, m; couple about its own d3, N m; turn about it, radians.
        private struct EndState
        {
            public Vector3d Force;
            public Vector3d Place;
            public double Couple;
            public double Turn;

            public static double MostWork(in EndState from, in EndState to)
            {
                return 0.5 * (Math.Abs(Vector3d.Dot(from.Force + to.Force, to.Place - from.Place))
                    + Math.Abs((from.Couple + to.Couple) * (to.Turn - from.Turn)));
            }
        }

        private static Vector3d Between(in Quaterniond before, in Quaterniond after)
        {
            return Quaterniond.Rotate(before, RotationVector.Log(before.Conjugate * after));
        }
    }
}
