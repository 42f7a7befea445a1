using System;

namespace Guidewire.Core
{
    /// <summary>Bending and twist of an instrument with another one inside it: the joints of
    /// <see cref="CoaxialJoints"/>, each with the energy of <see cref="CoaxialJoint"/>.</summary>
    /// <remarks>Unknown are the frames q_j of the outermost instrument and, where another is inside, its angle z_j. A
    /// joint between elements a and b has phi = log(conj(q_a) q_b), t = (1 - w) z_a + w z_b and delta = z_b - z_a; at
    /// the outer tip phi = log(conj(q_a R(z_a)) q_b) and t = z_a, for the inner frame goes on. At fixed t and delta a
    /// joint is one of <see cref="RotationVectorLaw"/> with the rest f(t); with h = d2E/(dphi dz) and dphi = T
    /// dtheta_b - T^T dtheta_a the angle meets the rotations by T^T h and -T h. At the tip dz also turns the frame a,
    /// as e3 dz does: with C, F, g of that frame, R the rotation by z, the angle meets theta_a by R (C e3 + 1/2 e3 x g
    /// - T h) and theta_b by F e3 + T^T h.</remarks>
    internal sealed class CoaxialBendTwist : BendTwistTerm
    {
        private const double Difference = 1e-4;   // of an element, between two energies whose difference is a force
        private const string NoWinding = "joint 0 of coaxial instruments has no winding";

        private readonly CoaxialRod _rod;
        private readonly CoaxialJoints _joints;
        private readonly TwistRow[] _row;
        private readonly RotationVectorLaw _law;
        private double _startLead;     // m
        private bool _isStiffened;
        private RodBlock _clampBlock;  // what falls on the hub's frame, which does not move
        private RodVector _clampVector;
        private TwistRow _clampRow;

        /// <summary>The energy of the joints of a rod, clamped at the hub and free at the tip.</summary>
        public CoaxialBendTwist(CoaxialRod rod)
        {
            _rod = rod;
            _joints = rod.Joints;
            _row = new TwistRow[_joints.ElementCount + 1];
            _law = default;
        }

        /// <summary>How far the inner hub is behind the outer one, m.</summary>
        public double Lead => _joints.Lead;

        /// <summary>Positions of the chain's nodes along it, m.</summary>
        public double[] Stations => _joints.Stations;

        /// <summary>How far the inner instrument has slid out of the outer one since the step's start, m.</summary>
        public double Slide => _startLead - _joints.Lead;

        /// <summary>Angle from the outer hub to the inner one, radians, without limit.</summary>
        public double HubTwist { get; set; }

        /// <summary>Force of the inner hub on its instrument along the axis, N: dE/dp, of this energy and that of the
        /// element at the outer tip. Negative where the instrument is driven out.</summary>
        public double InnerForce(RodShape shape, StretchEnergy stretch)
        {
            return Released(shape, stretch, Difference * _rod.Rod.Length[0], 0.0);
        }

        /// <summary>What the outer hub has of the force along the axis besides that on its node, N: with -dE/dD, D the
        /// length in the sheath, a bent instrument is driven out.</summary>
        public double SheathForce(RodShape shape, StretchEnergy stretch)
        {
            return _joints.Sheathed == 0.0 ? 0.0 : Released(shape, stretch, 0.0, Difference * _rod.Rod.Length[0]);
        }

        /// <summary>Where the two hubs are in time; null where they are set by hand.</summary>
        public CoaxialHubs? Hubs { get; set; }

        /// <summary>Torque of the inner hub on its instrument, N m: dE/dz of the hub.</summary>
        public double InnerTorque(RodShape shape)
        {
            Evaluate(shape, 0, out State s);
            return (1.0 - _joints[0].Weight) * s.Slope - s.InnerCouple;
        }

        /// <summary>Gives angles that are not unknown the values with which they would come in: those that twist
        /// nothing.</summary>
        public void SetIdleTwists(RodShape shape)
        {
            for (int j = Math.Max(_joints.ActiveCount, 1); j < shape.Twist.Length; j++)
            {
                shape.Twist[j] = j < _joints.OuterCount ? shape.Twist[j - 1] + _joints[j].InnerRestTwist
                    - _law.Measure(Relative(shape, j)).Z : 0.0;
            }
        }

        /// <inheritdoc/>
        public override void SetTime(double time)
        {
            if (Hubs != null)
            {
                double lead = Hubs.LeadAt(time);
                HubTwist = Hubs.TwistAt(time);
                double sheathed = Hubs.SheathedAt(time);
                if (lead != _joints.Lead || sheathed != _joints.Sheathed)
                {
                    _rod.SetHubs(lead, sheathed);
                }
            }
        }

        /// <summary>A step begins at a time, s.</summary>
        public void BeginSlide(double time)
        {
            _startLead = Hubs == null ? _joints.Lead : Hubs.LeadAt(time);
        }

        /// <inheritdoc/>
        public override void BeginStep(RodShape shape, double dt)
        {
            SetIdleTwists(shape);
        }

        /// <inheritdoc/>
        public override void Stiffen(bool isOn)
        {
            _isStiffened = isOn;
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = _joints.HeldInLead;
            for (int k = 0; k < _joints.ElementCount; k++)
            {
                Evaluate(shape, k, out State s);
                sum += _law.Value(s.Joint, s.Relative) + s.Held;
            }
            if (HasEnd)
            {
                sum += _joints.End.HeldAt(shape.Twist[_joints.ElementCount - 1], out _, out _);
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int n = _joints.ElementCount;
            int twist = n + 2;
            for (int k = FirstJoint(from); k < EndJoint(to); k++)
            {
                Evaluate(shape, k, out State s);
                if (_joints.IsTip(k))
                {
                    RodVector a = default;
                    _law.AddGradient(s.Joint, s.Relative, ref a, ref gradient[k]);
                    TurnedFrame.Add(ref gradient[k - 1], s.Before, a);
                    gradient[twist + k - 1].T3 += s.Slope + a.T3;
                    continue;
                }
                _law.AddGradient(s.Joint, s.Relative, ref k == 0 ? ref _clampVector : ref gradient[k - 1],
                    ref gradient[k]);
                AddTwist(gradient, k, s);
            }
            if (to >= n && from < n && HasEnd)
            {
                _joints.End.HeldAt(shape.Twist[n - 1], out double slope, out _);
                gradient[twist + n - 1].T3 += slope;
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            int n = _joints.ElementCount;
            if (from == 0)
            {
                Array.Clear(_row, 0, _row.Length);
            }
            for (int k = FirstJoint(from); k < EndJoint(to); k++)
            {
                Evaluate(shape, k, out State s);
                if (_joints.IsTip(k))
                {
                    AddTipBlocks(s, ref gradient[k - 1], ref gradient[k], ref blocks[k - 1], ref blocks[k],
                        ref _row[k - 1], ref gradient[n + 1 + k]);
                    continue;
                }
                _clampBlock = default;
                AddJoint(s, ref k == 0 ? ref _clampVector : ref gradient[k - 1], ref gradient[k],
                    ref k == 0 ? ref _clampBlock : ref blocks[k - 1], ref blocks[k]);
                AddTwist(gradient, k, s);
                if (k < _joints.ActiveCount || (k > 0 && k - 1 < _joints.ActiveCount))
                {
                    AddTwistRow(ref k == 0 ? ref _clampRow : ref _row[k - 1], ref _row[k], s, _joints[k]);
                }
            }
            if (to >= n && from < n && HasEnd)
            {
                _joints.End.HeldAt(shape.Twist[n - 1], out double slope, out double second);
                gradient[n + 2 + n - 1].T3 += slope;
                _row[n - 1].Diagonal += Kept(second);
            }
        }

        /// <inheritdoc/>
        public override void AddTwistRows(RodShape shape, TwistRow[] rows, int from, int to)
        {
            for (int j = from; j < to; j++)
            {
                rows[j].Add(_row[j]);
            }
        }

        /// <inheritdoc/>
        public override bool RelaxTurns(RodShape shape)
        {
            Quaterniond frame = shape.ProximalFrame;
            for (int k = 0; k < _joints.ElementCount; k++)
            {
                Evaluate(shape, k, out State s);
                Quaterniond before = _joints.IsTip(k) ? frame * Turned(s.Before) : frame;
                frame = Quaterniond.Normalize(before * _law.AtRest(s.Joint));
                shape.Q[k] = frame;
            }
            return true;
        }

        /// <inheritdoc/>
        public override void Measure(RodShape shape, Vector3d[] turns)
        {
            for (int k = 0; k < _joints.ElementCount; k++)
            {
                turns[k] = TurnOf(shape, k);
            }
            turns[_joints.ElementCount] = Vector3d.Zero;
        }

        /// <inheritdoc/>
        public override Vector3d TurnOf(RodShape shape, int k)
        {
            return k < _joints.ElementCount ? _law.Measure(Relative(shape, k)) : Vector3d.Zero;
        }

        /// <inheritdoc/>
        public override void SetJoint(int k, in Joint joint)
        {
            throw new NotSupportedException("joints of coaxial instruments follow from their hubs");
        }

        /// <inheritdoc/>
        public override Vector3d Couple(RodShape shape, int k)
        {
            if (k == _joints.ElementCount)
            {
                return Vector3d.Zero;
            }
            Evaluate(shape, k, out State s);
            RodVector before = default;
            RodVector after = default;
            _law.AddGradient(s.Joint, s.Relative, ref before, ref after);
            return Quaterniond.Rotate(shape.Q[k], new Vector3d(after.T1, after.T2, after.T3));
        }

        /// <inheritdoc/>
        public override void MeasureRates(RodShape shape, Vector3d[] spins, in Vector3d proximal, in Vector3d distal,
            Vector3d[] rates)
        {
            throw new NotSupportedException("coaxial instruments have no damping of their strains");
        }

        /// <inheritdoc/>
        public override void TurnProximal(double turn)
        {
            throw new NotSupportedException(NoWinding);
        }

        /// <inheritdoc/>
        public override double TurnCouple(RodShape shape)
        {
            throw new NotSupportedException(NoWinding);
        }

        /// <inheritdoc/>
        public override Vector3d ProximalCouple(RodShape shape)
        {
            Evaluate(shape, 0, out State s);
            RodVector onFrame = default;
            RodVector onElement = default;
            _law.AddGradient(s.Joint, s.Relative, ref onFrame, ref onElement);
            return Quaterniond.Rotate(shape.ProximalFrame, new Vector3d(onFrame.T1, onFrame.T2, onFrame.T3));
        }

        /// <inheritdoc/>
        public override Vector3d DistalCouple(RodShape shape)
        {
            return Vector3d.Zero;
        }

        // Of energy, by lead and length in the sheath that are less by these, m: a centred difference, N.
        private double Released(RodShape shape, StretchEnergy stretch, double lead, double sheathed)
        {
            SetIdleTwists(shape);
            (double from, double inside) = (_joints.Lead, _joints.Sheathed);
            _rod.SetHubs(from - lead, inside - sheathed);
            double less = Value(shape) + stretch.Value(shape);
            _rod.SetHubs(from + lead, inside + sheathed);
            double more = Value(shape) + stretch.Value(shape);
            _rod.SetHubs(from, inside);
            return 0.5 * (less - more) / (lead + sheathed);
        }

        private bool HasEnd => _joints.Beyond == 0 && _joints.ActiveCount == _joints.ElementCount;

        // Joint k stands between elements k - 1 and k: a range has those after its elements, the first that at the hub.
        private static int FirstJoint(int from)
        {
            return from == 0 ? 0 : from + 1;
        }

        private int EndJoint(int to)
        {
            return Math.Min(to + 1, _joints.ElementCount);
        }

        private Quaterniond Relative(RodShape shape, int k)
        {
            Quaterniond a = k == 0 ? shape.ProximalFrame : shape.Q[k - 1];
            if (_joints.IsTip(k))
            {
                a *= Turned(shape.Twist[k - 1]);
            }
            return a.Conjugate * shape.Q[k];
        }

        private static Quaterniond Turned(double angle)
        {
            return Quaterniond.FromAxisAngle(Vector3d.UnitZ, angle);
        }

        private void Evaluate(RodShape shape, int k, out State s)
        {
            ref readonly CoaxialJoint joint = ref _joints[k];
            s = default;
            s.Relative = Relative(shape, k);
            bool isTip = _joints.IsTip(k);
            s.Before = k == 0 ? HubTwist : shape.Twist[k - 1];
            double after = k < _joints.ActiveCount ? shape.Twist[k] : 0.0;
            double t = isTip ? s.Before : (1.0 - joint.Weight) * s.Before + joint.Weight * after;
            joint.RestAt(t, isTip ? -1.0 : 1.0, out Vector3d rest, out Vector3d slope);
            s.Held = joint.HeldAt(t, out s.Slope, out s.Second);
            s.Joint.Bend1 = 1.0 / joint.Compliance1;
            s.Joint.Bend2 = 1.0 / joint.Compliance2;
            s.Mixed = new Vector3d(-s.Joint.Bend1 * slope.X, -s.Joint.Bend2 * slope.Y, 0.0);
            Vector3d turn = _law.Measure(s.Relative);
            double first = s.Joint.Bend1 * (turn.X - rest.X);
            double second = s.Joint.Bend2 * (turn.Y - rest.Y);
            s.Slope -= first * slope.X + second * slope.Y;
            // f'' is minus the part of f that turns.
            s.Second += s.Joint.Bend1 * slope.X * slope.X + s.Joint.Bend2 * slope.Y * slope.Y
                + first * (rest.X - joint.FixedX) + second * (rest.Y - joint.FixedY);
            s.Joint.Twist = joint.Twist + joint.InnerTwist;
            double restTwist = joint.RestTwist;
            if (joint.InnerTwist > 0.0)
            {
                // Two springs about one axis: one about their mean, and what they hold against one another.
                double inner = joint.InnerRestTwist - (after - s.Before);
                double fraction = joint.InnerTwist / s.Joint.Twist;
                double apart = inner - restTwist;
                restTwist += fraction * apart;
                s.Held += 0.5 * joint.Twist * fraction * apart * apart;
                s.InnerCouple = joint.InnerTwist * (turn.Z - inner);
            }
            s.Joint.Rest = new Vector3d(rest.X, rest.Y, restTwist);
            s.Turn = turn;
        }

        // What a joint's energy says of the angles on both its sides.
        private void AddTwist(RodVector[] gradient, int k, in State s)
        {
            int at = _joints.ElementCount + 2 + k;
            double weight = _joints[k].Weight;
            if (k > 0)
            {
                gradient[at - 1].T3 += (1.0 - weight) * s.Slope - s.InnerCouple;
            }
            gradient[at].T3 += weight * s.Slope + s.InnerCouple;
        }

        private void AddTwistRow(ref TwistRow row, ref TwistRow next, in State s, in CoaxialJoint joint)
        {
            double w = joint.Weight;
            double second = Kept(s.Second);
            double stiffness = joint.InnerTwist;
            row.Diagonal += (1.0 - w) * (1.0 - w) * second + stiffness;
            next.Diagonal += w * w * second + stiffness;
            row.NextTwist += w * (1.0 - w) * second - stiffness;
            Vector3d before = (1.0 - w) * s.Mixed - stiffness * Vector3d.UnitZ;
            Vector3d after = w * s.Mixed + stiffness * Vector3d.UnitZ;
            row.Turn -= TurnedFrame.TimesT(s.Turn, before, 0.5);
            row.NextTurn += TurnedFrame.TimesT(s.Turn, before, -0.5);
            row.TurnOfNext -= TurnedFrame.TimesT(s.Turn, after, 0.5);
            next.Turn += TurnedFrame.TimesT(s.Turn, after, -0.5);
        }

        private void AddTipBlocks(in State s, ref RodVector a, ref RodVector b, ref RodBlock blockA,
            ref RodBlock blockB, ref TwistRow row, ref RodVector twist)
        {
            RodVector g = default;
            RodBlock own = default;
            AddJoint(s, ref g, ref b, ref own, ref blockB);
            TurnedFrame.Add(ref a, s.Before, g);
            twist.T3 += s.Slope + g.T3;
            Vector3d mixed = TurnedFrame.TimesT(s.Turn, s.Mixed, 0.5);
            double half = _isStiffened ? 0.0 : 0.5;
            Vector3d turn = new Vector3d(own.C31 - half * g.T2, own.C32 + half * g.T1, own.C33) - mixed;
            double c = Math.Cos(s.Before);
            double si = Math.Sin(s.Before);
            row.Turn += new Vector3d(c * turn.X - si * turn.Y, si * turn.X + c * turn.Y, turn.Z);
            row.NextTurn += new Vector3d(own.F13, own.F23, own.F33) + TurnedFrame.TimesT(s.Turn, s.Mixed, -0.5);
            row.Diagonal += Kept(s.Second) + own.C33 - 2.0 * mixed.Z;
            TurnedFrame.Add(ref blockA, own, c, si);
        }

        private void AddJoint(in State s, ref RodVector a, ref RodVector b, ref RodBlock blockA, ref RodBlock blockB)
        {
            if (!_isStiffened)
            {
                _law.AddBlocks(s.Joint, s.Relative, ref a, ref b, ref blockA, ref blockB);
                return;
            }
            Joint resting = s.Joint;
            resting.Rest = s.Turn;
            _law.AddBlocks(resting, s.Relative, ref a, ref b, ref blockA, ref blockB);
            _law.AddGradient(s.Joint, s.Relative, ref a, ref b);
        }

        private double Kept(double second)
        {
            return _isStiffened ? Math.Max(second, 0.0) : second;
        }

        // A joint in a shape.
        private struct State
        {
            public Quaterniond Relative;
            public Vector3d Turn;        // phi
            public Joint Joint;          // as it is at its angles
            public double Before;        // z_a
            public double Held;          // energy that does not go with phi, J
            public double Slope;         // dE/dt
            public double Second;        // d2E/dt2
            public double InnerCouple;   // dE/ddelta
            public Vector3d Mixed;       // d2E/(dphi dt)
        }
    }
}
