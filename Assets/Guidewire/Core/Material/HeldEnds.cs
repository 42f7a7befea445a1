using System;

namespace Guidewire.Core
{
    /// <summary>Moves the held ends of a material rod and the clamps' frames to where the schedule prescribes them, and
    /// sums the work done on the wire.</summary>
    internal sealed class HeldEnds
    {
        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly bool _holdsFirst;
        private readonly bool _holdsLast;
        private double _proximalTurn;  // that the frames have made, radians
        private double _distalTurn;
        private Vector3d _firstPosition;  // of ends that are followed, m
        private Vector3d _lastPosition;
        private Quaterniond _firstFrame;  // the same
        private Quaterniond _lastFrame;
        private double _carried;       // J
        private readonly double[] _lead;       // of inner hubs that are followed, m
        private readonly double[] _hubTwist;   // radians
        private double _stretch;       // the largest EA, N
        private double _twist;         // the largest GJ, N m^2

        /// <summary>The ends of this rod, held by this schedule.</summary>
        public HeldEnds(RodTerms terms, RodSchedule schedule)
        {
            _terms = terms;
            _schedule = schedule;
            _holdsFirst = terms.Supports.Proximal != ProximalEnd.Free;
            _holdsLast = terms.Supports.Distal != DistalEnd.Free;
            _lead = new double[1 + terms.Supports.InnerCount];
            _hubTwist = new double[_lead.Length];
            Remesh();
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            (_stretch, _twist) = (0.0, 0.0);
            for (int j = 0; j < _terms.Rod.ElementCount; j++)
            {
                _stretch = Math.Max(_stretch, _terms.Rod.StretchStiffness[j]);
                _twist = Math.Max(_twist, _terms.Rod.TwistStiffness[j]);
            }
        }

        /// <summary>Whether the first node is where its support is.</summary>
        public bool HoldsFirst => _holdsFirst;

        /// <summary>Whether the last node is where its support is; not so where it slides.</summary>
        public bool HoldsLast => _terms.Supports.HoldsLastNode;

        /// <summary>Work done on the wire since the start, J: the mean of force and couple before and after a move,
        /// times the move, which is exact while the stress is proportional to it.</summary>
        public double Work { get; private set; }

        /// <summary>The most that <see cref="Work"/> has been, J; where steps are counted, with the allowance within
        /// one.</summary>
        public double MaxWork { get; private set; }

        /// <summary>Sets positions and frames of this time.</summary>
        public void Place(RodShape shape, double time)
        {
            if (_holdsFirst)
            {
                Shift(shape, 0, _schedule.Hub.PositionAt(time));
            }
            if (_holdsLast)
            {
                Shift(shape, shape.ElementCount, _schedule.Distal.PositionAt(time));
            }
            double proximalTurn = _schedule.Hub.TurnAt(time);
            double distalTurn = _schedule.Distal.TurnAt(time);
            if (proximalTurn != _proximalTurn || distalTurn != _distalTurn)
            {
                Turn(shape, proximalTurn, distalTurn);
            }
            MaxWork = Math.Max(MaxWork, Work + _carried);
        }

        /// <summary>The ends are followed from this shape on, in which the frames have made these turns,
        /// radians.</summary>
        public void Follow(RodShape shape, double proximalTurn, double distalTurn)
        {
            _firstPosition = shape.X[0];
            _lastPosition = shape.X[shape.ElementCount];
            _firstFrame = shape.ProximalFrame;
            _lastFrame = shape.DistalFrame;
            _proximalTurn = proximalTurn;
            _distalTurn = distalTurn;
            for (int i = 1; i < _lead.Length; i++)
            {
                _lead[i] = _terms.CoaxialBending!.Joints.LeadOf(i);
                _hubTwist[i] = _terms.CoaxialBending.HubTwist[i] - _terms.CoaxialBending.HubTwist[0];
            }
        }

        /// <summary>Takes note of the speeds of the ends: what brings a wire at rest to them may be over within a part
        /// of a step and leave no force by which <see cref="Place"/> could count it, so there is always an allowance
        /// for the energy of the whole wire at the largest.</summary>
        /// <param name="speed">m/s.</param>
        /// <param name="turning">rad/s.</param>
        public void Carry(double speed, double turning)
        {
            double all = speed + _terms.Rod.TotalLength * turning;
            _carried = Math.Max(_carried, 0.5 * _terms.Mass.Total * all * all);
            MaxWork = Math.Max(MaxWork, Work + _carried);
        }

        /// <summary>Counts what the ends may have put in at most in a step of dt in which a solver has placed them
        /// itself, by forces and couples at its end.</summary>
        /// <remarks>In a step longer than sound needs along the wire, a support that starts or stops leaves forces of
        /// either sign in it, up to EA times the move over L: so no step takes energy out again. What brings a wire at
        /// rest to the speed of its support may be over within a step and leave no force at all: so there is always an
        /// allowance for the energy of the whole wire at the largest speed that the ends have had. And one that
        /// shortens a straight wire may have met all of its axial stiffness before it buckled, or all of its torsion:
        /// there is an allowance for EA/(2 L) times the largest move squared, and GJ/(2 L) times the turn
        /// squared.</remarks>
        public void Count(RodShape shape, double proximalTurn, double distalTurn, double dt)
        {
            int last = shape.ElementCount;
            Vector3d firstMove = _holdsFirst ? shape.X[0] - _firstPosition : Vector3d.Zero;
            Vector3d lastMove = _holdsLast ? shape.X[last] - _lastPosition : Vector3d.Zero;
            double firstTurn = proximalTurn - _proximalTurn;
            double lastTurn = distalTurn - _distalTurn;
            Vector3d firstRotation = default;
            Vector3d lastRotation = default;
            if (_schedule.HasMotions)
            {
                firstRotation = Between(_firstFrame, shape.ProximalFrame);
                lastRotation = Between(_lastFrame, shape.DistalFrame);
            }
            CountInner(shape, out double innerMove, out double innerTurn);
            Follow(shape, proximalTurn, distalTurn);
            double move = firstMove.Length + lastMove.Length + innerMove;
            double turn = innerTurn + (_schedule.HasMotions ? firstRotation.Length + lastRotation.Length
                : Math.Abs(firstTurn) + Math.Abs(lastTurn));
            if (move == 0.0 && turn == 0.0)
            {
                return;
            }
            BendTwistTerm bending = _terms.Bending;
            Work += Math.Abs(Vector3d.Dot(_terms.EndGradient(shape, 0), firstMove))
                + Math.Abs(Vector3d.Dot(_terms.EndGradient(shape, last), lastMove));
            Work += _schedule.HasMotions
                ? Math.Abs(Vector3d.Dot(bending.ProximalCouple(shape), firstRotation))
                    + Math.Abs(Vector3d.Dot(bending.DistalCouple(shape), lastRotation))
                : Math.Abs(Vector3d.Dot(bending.ProximalCouple(shape), shape.ProximalFrame.Director3) * firstTurn)
                + Math.Abs(Vector3d.Dot(bending.DistalCouple(shape), shape.DistalFrame.Director3) * lastTurn);
            double length = _terms.Rod.TotalLength;
            double speed = (move + length * turn) / dt;
            _carried = Math.Max(_carried, 0.5 * (_terms.Mass.Total * speed * speed
                + (_stretch * move * move + _twist * turn * turn) / length));
            MaxWork = Math.Max(MaxWork, Work + _carried);
        }

        /// <summary>Writes or restores the turns that the frames have made; for a step also the work, and where the
        /// ends are.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _proximalTurn);
            snapshot.Serialize(ref _distalTurn);
            if (snapshot.IsStep)
            {
                SerializeWork(snapshot);
                snapshot.Serialize(ref _firstPosition);
                snapshot.Serialize(ref _lastPosition);
                snapshot.Serialize(ref _firstFrame);
                snapshot.Serialize(ref _lastFrame);
                snapshot.Serialize(_lead);
                snapshot.Serialize(_hubTwist);
            }
        }

        /// <summary>Writes or restores the work.</summary>
        public void SerializeWork(Snapshot snapshot)
        {
            Work = snapshot.Serialize(Work);
            MaxWork = snapshot.Serialize(MaxWork);
            snapshot.Serialize(ref _carried);
        }

        private void CountInner(RodShape shape, out double move, out double turn)
        {
            move = 0.0;
            turn = 0.0;
            for (int i = 1; i < _lead.Length; i++)
            {
                CoaxialBendTwist coaxial = _terms.CoaxialBending!;
                double along = Math.Abs(coaxial.Joints.LeadOf(i) - _lead[i]);
                double about = Math.Abs(coaxial.HubTwist[i] - coaxial.HubTwist[0] - _hubTwist[i]);
                Work += along > 0.0 ? Math.Abs(_terms.Release!.InnerForce(shape, _terms, i)) * along : 0.0;
                Work += about > 0.0 ? Math.Abs(coaxial.InnerTorque(shape, i)) * about : 0.0;
                move += along;
                turn += about;
            }
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
            _schedule.TurnFrames(shape, proximalTurn, distalTurn, 0.0);
            couple += _terms.Bending.ProximalCouple(shape);
            endCouple += _terms.Bending.DistalCouple(shape);
            Work += 0.5 * (Vector3d.Dot(couple, Between(proximal, shape.ProximalFrame))
                + Vector3d.Dot(endCouple, Between(distal, shape.DistalFrame)));
        }

        private static Vector3d Between(in Quaterniond before, in Quaterniond after) =>
            Quaterniond.Rotate(before, RotationVector.Log(before.Conjugate * after));
    }
}
