using System;

namespace Guidewire.Core
{
    /// <summary>Bending and twist of an instrument with one or two others inside it: the joints of
    /// <see cref="CoaxialJoints"/>, each with the energy of <see cref="CoaxialJoint"/>.</summary>
    /// <remarks>Unknown are the frames q_j of the outermost instrument and, where another is inside, its angle z_j. A
    /// joint between elements a and b has phi = log(conj(q_a) q_b), and of each instrument inside t = (1 - w) z_a + w
    /// z_b and delta = z_b - z_a; at the tip of the outermost one phi = log(conj(q_a R(z_c)) q_b), z_c the angle of the
    /// instrument that goes on, and all other angles before it are counted from that one. At fixed t and delta a joint
    /// is one of <see cref="RotationVectorLaw"/> with the rest f(t); the derivatives by angles are those of
    /// <see cref="CoaxialTwistRows"/>.</remarks>
    internal sealed class CoaxialBendTwist : BendTwistTerm
    {
        private readonly CoaxialRod _rod;
        private readonly CoaxialJoints _joints;
        private readonly CoaxialTwistRows _rows;
        private readonly RotationVectorLaw _law;
        private readonly bool _hasSecond;      // three instruments
        private readonly double[] _startLead;  // m
        private readonly double[] _lead;
        private readonly JointWinding _winding = new JointWinding();   // in a sheath
        private double _rewound;               // change of the energy by the last change of w, J
        private RodBlock _clampBlock;          // what falls on the hub's frame, which does not move
        private RodVector _clampVector;

        /// <summary>Makes the energy of the joints of a rod, clamped at the hub and free at the tip.</summary>
        public CoaxialBendTwist(CoaxialRod rod)
        {
            _rod = rod;
            _joints = rod.Joints;
            _rows = new CoaxialTwistRows(_joints);
            _law = default;
            _hasSecond = _joints.InnerCount > 1;
            _startLead = new double[_joints.Count];
            _lead = new double[_joints.Count];
            HubTwist = new double[_joints.Count];
        }

        /// <summary>The joints.</summary>
        public CoaxialJoints Joints => _joints;

        /// <summary>How far an inner instrument has slid out of the outermost one since the step's start, m.</summary>
        public double SlideOf(int instrument) => _startLead[instrument] - _joints.LeadOf(instrument);

        /// <summary>Angle from the frame before joint 0 to each hub, radians, without limit; 0 of the first one, but in
        /// a sheath, where that frame is held.</summary>
        public double[] HubTwist { get; }

        /// <summary>Gives the torque of an inner hub on its instrument, N m: dE/dz of the hub.</summary>
        public double InnerTorque(RodShape shape, int instrument = 1)
        {
            Evaluate(shape, 0, out CoaxialJointState s);
            return instrument == 1 ? (1.0 - _joints[0].First.Weight) * s.First.Slope - s.First.Couple
                : (1.0 - _joints[0].Second.Weight) * s.Second.Slope - s.Second.Couple;
        }

        /// <summary>Gives angles that are not unknown the values with which they would come in: those that twist
        /// nothing.</summary>
        public void SetIdleTwists(RodShape shape)
        {
            for (int i = 1; i < _joints.Count; i++)
            {
                int first = (i - 1) * shape.ElementCount;
                for (int j = _joints.ActiveCountOf(i); j < shape.ElementCount; j++)
                {
                    int frame = _joints.CarrierOf(j);
                    double rest = i == 2 || frame == 2 ? _joints[j].Second.RestTwist : _joints[j].First.RestTwist;
                    double before = j == 0 ? HubTwist[i] : AngleAt(shape, j - 1, i, frame);
                    shape.Twist[first + j] = frame < i ? before + rest - TurnOf(shape, j).Z : 0.0;
                }
            }
        }

        /// <summary>Gives the angle of an instrument from the frame of another one on an element, radians.</summary>
        /// <param name="element">-1: at the hubs.</param>
        public double AngleAt(RodShape shape, int element, int instrument, int frame)
        {
            if (element < 0)
            {
                return HubTwist[instrument] - HubTwist[frame];
            }
            return CoaxialShape.Angle(shape, shape.Twist, _joints, element, instrument, frame);
        }

        /// <inheritdoc/>
        public override void SetTime(double time)
        {
            CoaxialHubs? hubs = _rod.Hubs;
            if (hubs != null)
            {
                double sheathed = hubs.SheathedAt(time);
                bool isOther = sheathed != _joints.Sheathed;
                HubTwist[0] = hubs.Outer.AheadAt(time);
                for (int i = 1; i < _lead.Length; i++)
                {
                    _lead[i] = hubs.LeadAt(i, time);
                    HubTwist[i] = HubTwist[0] + hubs.TwistAt(i, time);
                    isOther |= _lead[i] != _joints.LeadOf(i);
                }
                if (isOther)
                {
                    _rod.SetHubs(_lead, sheathed);
                }
            }
        }

        /// <inheritdoc/>
        public override void BeginSlide(double time)
        {
            for (int i = 1; i < _startLead.Length; i++)
            {
                _startLead[i] = _rod.Hubs?.LeadAt(i, time) ?? _joints.LeadOf(i);
            }
        }

        /// <inheritdoc/>
        public override void BeginStep(RodShape shape, double dt) => SetIdleTwists(shape);

        /// <inheritdoc/>
        public override void Remesh() => _winding.Set(0.0);

        /// <summary>Joint 0 in a sheath is measured from where it is in this shape once it is far from its
        /// winding.</summary>
        public override void Anchor(RodShape shape)
        {
            _rewound = 0.0;
            double turn = _rod.Sheath == null ? 0.0 : _law.Measure(Relative(shape, 0)).Z;
            if (JointWinding.IsFar(turn))
            {
                double before = ValueAt(shape, 0);
                _winding.Set(_winding.Turn + turn);
                _rewound = ValueAt(shape, 0) - before;
            }
        }

        /// <inheritdoc/>
        public override double AnchoredValue(double before) => before + _rewound;

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            if (_rod.Sheath != null)
            {
                _winding.Serialize(snapshot);
            }
        }

        /// <inheritdoc/>
        public override void DropGeometricStiffness(bool isOn) => _rows.DropsGeometricStiffness = isOn;

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = _joints.HeldInLead;
            for (int k = 0; k < _joints.ElementCount; k++)
            {
                sum += ValueAt(shape, k);
            }
            if (_joints.HasLast)
            {
                sum += LastAt(shape, _joints.Last, out _, out _, out _);
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int n = _joints.ElementCount;
            for (int k = FirstJoint(from); k < EndJoint(to); k++)
            {
                Evaluate(shape, k, out CoaxialJointState s);
                if (_joints.IsTip(k))
                {
                    RodVector a = default;
                    AddCouple(s, ref a, ref gradient[k]);
                    TurnedFrame.Add(ref gradient[k - 1], s.FrameBefore, a);
                    _rows.AddTipGradient(gradient, k, s, a.T3);
                    continue;
                }
                AddCouple(s, ref k == 0 ? ref _clampVector : ref gradient[k - 1], ref gradient[k]);
                _rows.AddGradient(gradient, k, s);
            }
            if (to >= n && from < n && _joints.HasLast)
            {
                AddLast(shape, gradient);
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            int n = _joints.ElementCount;
            if (from == 0)
            {
                Array.Clear(_rows.Rows, 0, _joints.InnerCount * _rows.Count);
            }
            for (int k = FirstJoint(from); k < EndJoint(to); k++)
            {
                Evaluate(shape, k, out CoaxialJointState s);
                if (_joints.IsTip(k))
                {
                    RodVector a = default;
                    RodBlock own = default;
                    AddJoint(s, ref a, ref gradient[k], ref own, ref blocks[k]);
                    TurnedFrame.Add(ref gradient[k - 1], s.FrameBefore, a);
                    _rows.AddTipGradient(gradient, k, s, a.T3);
                    _rows.AddTip(k, s, own, a);
                    TurnedFrame.Add(ref blocks[k - 1], own, Math.Cos(s.FrameBefore), Math.Sin(s.FrameBefore));
                    continue;
                }
                _clampBlock = default;
                AddJoint(s, ref k == 0 ? ref _clampVector : ref gradient[k - 1], ref gradient[k],
                    ref k == 0 ? ref _clampBlock : ref blocks[k - 1], ref blocks[k]);
                _rows.AddGradient(gradient, k, s);
                if (k < _joints.ActiveCount || (k > 0 && k - 1 < _joints.ActiveCount))
                {
                    _rows.Add(k, s);
                }
            }
            if (to >= n && from < n && _joints.HasLast)
            {
                _rows.AddLast(AddLast(shape, gradient));
            }
        }

        /// <inheritdoc/>
        public override void AddTwistRows(RodShape shape, TwistRow[] rows, int from, int to)
        {
            int second = _hasSecond ? _rows.Count : 0;
            for (int j = from; j < to; j++)
            {
                rows[j].Add(_rows.Rows[j]);
                if (_hasSecond)
                {
                    rows[second + j].Add(_rows.Rows[second + j]);
                }
            }
        }

        /// <inheritdoc/>
        public override bool RelaxTurns(RodShape shape)
        {
            Quaterniond frame = _winding.Wound(shape.ProximalFrame);
            for (int k = 0; k < _joints.ElementCount; k++)
            {
                Evaluate(shape, k, out CoaxialJointState s);
                Quaterniond before = _joints.IsTip(k) ? frame * Turned(s.FrameBefore) : frame;
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
            Vector3d turn = k < _joints.ElementCount ? _law.Measure(Relative(shape, k)) : Vector3d.Zero;
            return k == 0 ? turn + _winding.Turn * Vector3d.UnitZ : turn;
        }

        /// <inheritdoc/>
        public override void Couples(RodShape shape, Vector3d[] couples)
        {
            for (int k = 0; k < _joints.ElementCount; k++)
            {
                Evaluate(shape, k, out CoaxialJointState s);
                RodVector before = default;
                RodVector after = default;
                AddCouple(s, ref before, ref after);
                couples[k] = Quaterniond.Rotate(shape.Q[k], after.T);
            }
            couples[_joints.ElementCount] = Vector3d.Zero;
        }

        /// <inheritdoc/>
        public override void MeasureRates(RodShape shape, Vector3d[] spins, in Vector3d proximal, in Vector3d distal,
            Vector3d[] rates) =>
            throw new NotSupportedException("coaxial instruments have no damping of their strains");

        /// <inheritdoc/>
        public override double TurnCouple(RodShape shape, int instrument = 0)
        {
            return instrument > 0 ? InnerTorque(shape, instrument)
                : _joints[0].Twist * (HubTwist[0] + _joints[0].RestTwist - TurnOf(shape, 0).Z);
        }

        /// <inheritdoc/>
        public override Vector3d ProximalCouple(RodShape shape)
        {
            Evaluate(shape, 0, out CoaxialJointState s);
            RodVector onFrame = default;
            RodVector onElement = default;
            AddCouple(s, ref onFrame, ref onElement);
            return Quaterniond.Rotate(_winding.Wound(shape.ProximalFrame), onFrame.T);
        }

        /// <inheritdoc/>
        public override Vector3d DistalCouple(RodShape shape) => Vector3d.Zero;

        /// <inheritdoc/>
        public override void Evaluate(RodShape shape, int k, out CoaxialJointState s)
        {
            s = default;
            int frame = _joints.CarrierOf(k);
            if (k > 0 && frame == 0 && !_hasSecond)
            {
                s.Relative = shape.Q[k - 1].Conjugate * shape.Q[k];
                s.First.Before = shape.Twist[k - 1];
                s.First.After = k < _joints.ActiveCount ? shape.Twist[k] : 0.0;
                s.Set(_joints[k], _law, false);
                Fibres?.AddTo(k, ref s);
                return;
            }
            s.Relative = Relative(shape, k);
            int before = k == 0 ? 0 : _joints.CarrierOf(k - 1);
            s.FrameBefore = frame == before ? 0.0 : AngleAt(shape, k - 1, frame, before);
            SetAngles(shape, k, before, frame, frame == 0 ? 1 : 0, ref s.First, s.FrameBefore);
            if (_hasSecond)
            {
                SetAngles(shape, k, before, frame, frame == 2 ? 1 : 2, ref s.Second, s.FrameBefore);
            }
            if (k > 0)
            {
                s.Set(_joints[k], _law, _hasSecond);
                Fibres?.AddTo(k, ref s);
                return;
            }
            CoaxialJoint first = _joints[0];
            first.RestTwist += HubTwist[0] - _winding.Turn;
            s.Set(first, _law, _hasSecond);
            Fibres?.AddTo(k, ref s);
        }

        /// <summary>What the last half element holds, J, and its derivatives by both angles.</summary>
        /// <param name="joint">Of it, or derivatives of its sums.</param>
        public double LastAt(RodShape shape, in CoaxialJoint joint, out AngleHessian hessian, out double first,
            out double second)
        {
            int last = _joints.ElementCount - 1;
            int frame = _joints.CarrierOf(last);
            return joint.HeldAt(frame == 0 ? shape.Twist[last] : 0.0,
                _hasSecond ? shape.Twist[shape.ElementCount + last] : 0.0, out hessian, out first, out second);
        }

        // Joint k stands between elements k - 1 and k: a range has those after its elements, the first that at the hub.
        private static int FirstJoint(int from) => from == 0 ? 0 : from + 1;

        private int EndJoint(int to) => Math.Min(to + 1, _joints.ElementCount);

        private Quaterniond Relative(RodShape shape, int k)
        {
            Quaterniond a = k == 0 ? _winding.Wound(shape.ProximalFrame) : shape.Q[k - 1];
            if (_joints.IsTip(k))
            {
                a *= Turned(AngleAt(shape, k - 1, _joints.CarrierOf(k), _joints.CarrierOf(k - 1)));
            }
            return a.Conjugate * shape.Q[k];
        }

        private double ValueAt(RodShape shape, int k)
        {
            Evaluate(shape, k, out CoaxialJointState s);
            return _law.Value(s.Joint, s.Relative) + s.Held;
        }

        private static Quaterniond Turned(double angle) => Quaterniond.FromAxisAngle(Vector3d.UnitZ, angle);

        private void SetAngles(RodShape shape, int k, int carrier, int frame, int instrument,
            ref CoaxialPartState part, double frameBefore)
        {
            part.Before = k == 0 ? HubTwist[instrument] - _winding.Turn
                : (instrument > carrier ? shape.Twist[(instrument - 1) * shape.ElementCount + k - 1] : 0.0)
                    - frameBefore;
            part.After = instrument > frame && k < _joints.ActiveCountOf(instrument)
                ? shape.Twist[(instrument - 1) * shape.ElementCount + k] : 0.0;
        }

        private void AddCouple(in CoaxialJointState s, ref RodVector a, ref RodVector b)
        {
            _law.AddGradient(s.Joint, s.Relative, ref a, ref b);
            if (Fibres != null)
            {
                RotationVectorLaw.AddGradient(s.Fibres.Turn, s.Fibres.Moment, ref a, ref b);
            }
        }

        private AngleHessian AddLast(RodShape shape, RodVector[] gradient)
        {
            int n = _joints.ElementCount;
            LastAt(shape, _joints.Last, out AngleHessian hessian, out double first, out double second);
            gradient[n + 2 + n - 1].T3 += first;
            gradient[n + 2 + n - 1].T2 += second;
            return hessian;
        }

        private void AddJoint(in CoaxialJointState s, ref RodVector a, ref RodVector b, ref RodBlock blockA,
            ref RodBlock blockB)
        {
            if (Fibres != null)
            {
                s.Fibres.AddBlocks(_rows.DropsGeometricStiffness, ref a, ref b, ref blockA, ref blockB);
            }
            if (!_rows.DropsGeometricStiffness)
            {
                _law.AddBlocks(s.Joint, s.Relative, ref a, ref b, ref blockA, ref blockB);
                return;
            }
            Joint resting = s.Joint;
            resting.Rest = s.Turn;
            _law.AddBlocks(resting, s.Relative, ref a, ref b, ref blockA, ref blockB);
            _law.AddGradient(s.Joint, s.Relative, ref a, ref b);
        }
    }
}
