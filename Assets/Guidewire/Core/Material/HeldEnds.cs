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

    /// <summary>How a material rod is held and discretised: its two ends, and the rules for clamps, mass and
    /// bending.</summary>
    internal sealed class RodSupports
    {
        /// <summary>The proximal end; default clamped.</summary>
        public ProximalEnd Proximal { get; set; } = ProximalEnd.Clamped;

        /// <summary>Whether node 0 follows its support on a stiff spring (<see cref="SupportSpring"/>) instead of being
        /// there exactly.</summary>
        public bool HasSpring { get; set; }

        /// <summary>Where the sheath ends in which the rod's first nodes may be; null without one.</summary>
        public SheathEnd? SheathEnd => Coaxial?.Sheath;

        /// <summary>The instruments of a rod that is several coaxial ones, or one in a sheath; null for a wire
        /// alone.</summary>
        public CoaxialRod? Coaxial { get; set; }

        /// <summary>How many instruments are inside it.</summary>
        public int InnerCount => Coaxial == null ? 0 : Coaxial.Joints.InnerCount;

        /// <summary>The fraction of joint k that is outside a sheath: 0 where none of it is, above 0 to 1
        /// elsewhere.</summary>
        public double FractionOutside(int k) => Coaxial?.Joints.FractionOutside(k) ?? 1.0;

        /// <summary>Whether the joint at the proximal clamp stands for all of a wire in its sheath, and turns about it
        /// without limit.</summary>
        public bool Winds => Coaxial != null && InnerCount == 0;

        /// <summary>The distal end; default free.</summary>
        public DistalEnd Distal { get; set; } = DistalEnd.Free;

        /// <summary>The unit vector along which a sliding distal end may move.</summary>
        public Vector3d SlidingAxis { get; set; } = Vector3d.UnitZ;

        /// <summary>Weights at the clamps; default fourth order.</summary>
        public ClampRule Clamp { get; set; } = ClampRule.FourthOrder;

        /// <summary>The mass matrix; default consistent.</summary>
        public MassRule Mass { get; set; } = MassRule.Consistent;

        /// <summary>The law of a joint; default rotation vector.</summary>
        public BendLaw Bend { get; set; } = BendLaw.RotationVector;

        /// <summary>True where a frame holds the first element by a spring.</summary>
        public bool HasProximalJoint => Proximal == ProximalEnd.Clamped;

        /// <summary>True where a frame holds the last element by a spring.</summary>
        public bool HasDistalJoint => Distal == DistalEnd.Clamped || Distal == DistalEnd.Sliding;

        /// <summary>True where the last node is where its support is; not so where it slides.</summary>
        public bool HoldsLastNode => Distal == DistalEnd.Clamped || Distal == DistalEnd.Held;
    }

    /// <summary>The end of a sheath, and the nodes and elements in it.</summary>
    internal sealed class SheathEnd
    {
        /// <summary>Fraction of its bending compliance that a piece in a sheath retains.</summary>
        public const double RetainedBend = 1e-8;

        /// <summary>An end.</summary>
        /// <param name="exit">m.</param>
        /// <param name="axis">Where it leads, a unit vector.</param>
        public SheathEnd(in Vector3d exit, in Vector3d axis)
        {
            Exit = exit;
            Axis = axis;
        }

        /// <summary>Where the sheath ends, m.</summary>
        public Vector3d Exit { get; }

        /// <summary>The direction in which the sheath leads, a unit vector.</summary>
        public Vector3d Axis { get; }

        /// <summary>How many nodes of a shape, from the first on, are in the sheath.</summary>
        public int NodesInside(RodShape shape)
        {
            Vector3d[] x = shape.X;
            int inside = 0;
            while (inside <= shape.ElementCount && Outside(x[inside]) < 0.0)
            {
                inside++;
            }
            return inside;
        }

        /// <summary>Gives the distance of a node beyond the exit of the sheath, m; negative inside.</summary>
        public double Outside(in Vector3d node) => Vector3d.Dot(node - Exit, Axis);

        /// <summary>Gives the point of the sheath's axis beside a node, m.</summary>
        public Vector3d OnAxis(in Vector3d node) => Exit + Outside(node) * Axis;
    }

    /// <summary>Extrapolates the frame of a clamp that a start does not state from the elements next to it.</summary>
    /// <remarks>With k_i = theta_i/L_i, theta_i the rotation at joint i and L_i the length it stands for, the
    /// curvature at the clamp is 2 k_1 - k_2, and the clamp's own joint turns by L_0 times that. The L_i are those of
    /// the clamp's rule in a shape that a run found, which then is at rest; in one sampled from a smooth curve, its
    /// orientations those at the elements' middles, they are l/2, l, l. The elements beyond, whose orientations are
    /// those of the middles in both, tell which: from their curvature at 3 l and 4 l the frame at the end is known to
    /// second order. A shape of less than five elements counts as sampled. A straight end keeps its frame.</remarks>
    internal static class ClampExtrapolation
    {
        private const int Needed = 5;   // elements that tell which

        /// <summary>The frame at an end of a shape.</summary>
        /// <param name="shape">Its elements' orientations.</param>
        /// <param name="lengths">Of the elements, m.</param>
        /// <param name="jointLengths">The length that each of the n + 1 joints stands for, m.</param>
        /// <param name="isProximal">Which end.</param>
        public static Quaterniond Frame(RodShape shape, double[] lengths, double[] jointLengths, bool isProximal)
        {
            int n = shape.ElementCount;
            Quaterniond At(int j) => shape.Q[isProximal ? j : n - 1 - j];
            double Joint(int k) => jointLengths[isProximal ? k : n - k];
            double Length(int j) => lengths[isProximal ? j : n - 1 - j];
            double Between(int k) => 0.5 * (Length(k - 1) + Length(k));
            Vector3d Turn(int k) => Log(At(k - 1), At(k));
            if (n < 2 || (Turn(1) == Vector3d.Zero && (n < 3 || Turn(2) == Vector3d.Zero)))
            {
                return At(0);
            }

            Quaterniond Back(double own, double first, double second)
            {
                Vector3d atFirst = Turn(1) / first;
                Vector3d curvature = n < 3 ? atFirst : 2.0 * atFirst - Turn(2) / second;
                return At(0) * RotationVector.Exp(-own * curvature);
            }

            Quaterniond sampled = Back(0.5 * Length(0), Between(1), n < 3 ? 0.0 : Between(2));
            if (n < Needed)
            {
                return sampled;
            }
            Quaterniond found = Back(Joint(0), Joint(1), Joint(2));
            double start = Length(0) + Length(1) + 0.5 * Length(2);
            Vector3d third = Turn(3) / Between(3);
            Vector3d fourth = Turn(4) / Between(4);
            double behind = 0.5 * Length(2) + 0.5 * start;
            Quaterniond beyond = At(2) * RotationVector.Exp(
                -start * (third - behind / Length(3) * (fourth - third)));
            return Log(beyond, found).LengthSquared < Log(beyond, sampled).LengthSquared ? found : sampled;
        }

        // The rotation from one frame to another, of at most half a turn.
        private static Vector3d Log(in Quaterniond from, in Quaterniond to)
        {
            Quaterniond between = from.Conjugate * to;
            return RotationVector.Log(between.W < 0.0 ? -1.0 * between : between);
        }
    }
}
