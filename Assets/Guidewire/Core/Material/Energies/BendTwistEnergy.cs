using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Bending and twist: one joint between successive elements, one at each clamped end against the clamp's
    /// frame (thesis, bend-twist constraint, as an energy; the law between angle and couple is the type
    /// argument).</summary>
    /// <remarks>Where joint 0 is the twist of a long wire in its sheath it winds up (<see cref="JointWinding"/>). A tip
    /// that snaps round goes on in one smooth energy.</remarks>
    internal sealed class BendTwistEnergy<TLaw> : BendTwistTerm
        where TLaw : struct, IJointLaw
    {
        private readonly Joint[] _joint;  // 0: proximal clamp; k: between elements k-1 and k; n: distal clamp
        private readonly bool _hasProximal;
        private readonly bool _hasDistal;
        private readonly bool _winds;
        private readonly TLaw _law;
        private double _proximalRest;   // turn of joint 0 at rest about d3, radians
        private double _proximalTurn;   // and what its frame is behind
        private readonly JointWinding _winding = new JointWinding();
        private double _rewound;        // change of the energy by the last change of w, J: of its small bending
        private bool _dropsGeometricStiffness;
        private RodBlock _clampBlock;     // what falls on a clamp's frame, which does not move
        private RodVector _clampVector;
        private RodVector[]? _onAfter;        // couple of each joint on the element after it, N m
        private RodVector[]? _onBefore;       // the same on that before it, which nobody reads

        /// <summary>The energy of these n+1 joints; the first and the last count only where that end is
        /// clamped.</summary>
        /// <param name="winds">Whether joint 0 turns about d3 without limit.</param>
        public BendTwistEnergy(Joint[] joints, bool hasProximal, bool hasDistal, bool winds = false)
        {
            _winds = winds;
            _joint = joints;
            _hasProximal = hasProximal;
            _hasDistal = hasDistal;
            _law = default;
            _proximalRest = joints[0].Rest.Z;
        }

        /// <inheritdoc/>
        public override void Remesh()
        {
            _proximalRest = _joint[0].Rest.Z;
            _proximalTurn = 0.0;
            _winding.Set(0.0);
        }

        /// <summary>Joint 0 is without torque where it is turned by this more than at rest, radians: what is beyond
        /// its frame has turned so far.</summary>
        public void TurnProximal(double turn)
        {
            _proximalTurn = turn;
            Vector3d rest = _joint[0].Rest;
            _joint[0].Rest = new Vector3d(rest.X, rest.Y, _proximalRest + turn);
        }

        /// <inheritdoc/>
        public override double TurnCouple(RodShape shape, int instrument = 0) =>
            _joint[0].Twist * (_joint[0].Rest.Z - TurnOf(shape, 0).Z);

        /// <summary>Joint 0, if it winds, is measured from where it is in this shape once it is far from its winding:
        /// no iteration turns it by as much as is left until pi.</summary>
        public override void Anchor(RodShape shape)
        {
            _rewound = 0.0;
            if (!_winds)
            {
                return;
            }
            double turn = _law.Measure(FirstRelative(shape)).Z;
            if (JointWinding.IsFar(turn))
            {
                double before = _law.Value(First, FirstRelative(shape));
                _winding.Set(_winding.Turn + turn);
                _rewound = _law.Value(First, FirstRelative(shape)) - before;
            }
        }

        /// <inheritdoc/>
        public override double AnchoredValue(double before) => before + _rewound;

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            if (_winds)
            {
                _winding.Serialize(snapshot);
            }
        }

        /// <summary>Joint k is this one from now on.</summary>
        public void SetJoint(int k, in Joint joint)
        {
            _joint[k] = joint;
            if (k == 0)
            {
                _proximalRest = joint.Rest.Z;
                TurnProximal(_proximalTurn);
            }
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            int n = shape.ElementCount;
            double sum = 0.0;
            if (_hasProximal)
            {
                sum += _law.Value(First, FirstRelative(shape));
            }
            int j = 0;
            while (j < n - 1)
            {
                int stop = Math.Min(j + 4, n - 1);
                if (stop == j + 4 && HasLanes && RotationVectorLanes.AddValue(_joint, shape, j, ref sum))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    sum += _law.Value(_joint[j + 1], Relative(shape, j));
                }
            }
            if (_hasDistal)
            {
                sum += _law.Value(_joint[n], shape.Q[n - 1].Conjugate * shape.DistalFrame);
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int n = shape.ElementCount;
            if (from == 0 && _hasProximal)
            {
                _law.AddGradient(First, FirstRelative(shape), ref _clampVector,
                    ref gradient[0]);
            }
            AddGradient(shape, gradient, gradient, from, to < n - 1 ? to : n - 1);
            if (to >= n && from < n && _hasDistal)
            {
                _law.AddGradient(_joint[n], shape.Q[n - 1].Conjugate * shape.DistalFrame, ref gradient[n - 1],
                    ref _clampVector);
            }
        }

        // The joints between elements: each adds to the element before it in one list, to that after it in the other.
        private void AddGradient(RodShape shape, RodVector[] before, RodVector[] after, int from, int end)
        {
            int j = from;
            while (j < end)
            {
                int stop = Math.Min(j + 4, end);
                if (stop == j + 4 && HasLanes && RotationVectorLanes.AddGradient(_joint, shape, before, after, j))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    _law.AddGradient(_joint[j + 1], Relative(shape, j), ref before[j], ref after[j + 1]);
                }
            }
        }

        /// <summary>Leaves the part of the second derivatives out that goes with the couples.</summary>
        public override void DropGeometricStiffness(bool isOn) => _dropsGeometricStiffness = isOn;

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            int n = shape.ElementCount;
            if (from == 0 && _hasProximal)
            {
                _clampBlock = default;
                AddJoint(First, FirstRelative(shape), ref _clampVector, ref gradient[0],
                    ref _clampBlock, ref blocks[0]);
            }
            int end = to < n - 1 ? to : n - 1;
            int j = from;
            while (j < end)
            {
                int stop = Math.Min(j + 4, end);
                if (stop == j + 4 && HasLanes
                    && RotationVectorLanes.AddBlocks(_joint, shape, blocks, gradient, j, _dropsGeometricStiffness))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    AddJoint(_joint[j + 1], Relative(shape, j), ref gradient[j], ref gradient[j + 1], ref blocks[j],
                        ref blocks[j + 1]);
                }
            }
            if (to >= n && from < n && _hasDistal)
            {
                _clampBlock = default;
                AddJoint(_joint[n], shape.Q[n - 1].Conjugate * shape.DistalFrame, ref gradient[n - 1], ref _clampVector,
                    ref blocks[n - 1], ref _clampBlock);
            }
        }

        // A joint that is at rest where it is has no couple.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private void AddJoint(in Joint joint, in Quaterniond relative, ref RodVector a, ref RodVector b,
            ref RodBlock blockA, ref RodBlock blockB)
        {
            if (!_dropsGeometricStiffness)
            {
                _law.AddBlocks(joint, relative, ref a, ref b, ref blockA, ref blockB);
                return;
            }
            Joint resting = joint;
            resting.Rest = _law.Measure(relative);
            _law.AddBlocks(resting, relative, ref a, ref b, ref blockA, ref blockB);
            _law.AddGradient(joint, relative, ref a, ref b);
        }

        /// <inheritdoc/>
        public override void Measure(RodShape shape, Vector3d[] turns)
        {
            int n = shape.ElementCount;
            turns[0] = TurnOf(shape, 0);
            turns[n] = TurnOf(shape, n);
            int j = 0;
            while (j < n - 1)
            {
                int stop = Math.Min(j + 4, n - 1);
                if (stop == j + 4 && HasLanes && RotationVectorLanes.Measure(shape, turns, j))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    turns[j + 1] = _law.Measure(Relative(shape, j));
                }
            }
        }

        /// <inheritdoc/>
        public override Vector3d TurnOf(RodShape shape, int k)
        {
            int n = shape.ElementCount;
            if ((k == 0 && !_hasProximal) || (k == n && !_hasDistal))
            {
                return Vector3d.Zero;
            }
            return k == 0 ? _law.Measure(FirstRelative(shape)) + _winding.Turn * Vector3d.UnitZ
                : _law.Measure(shape.Q[k - 1].Conjugate * (k == n ? shape.DistalFrame : shape.Q[k]));
        }

        /// <inheritdoc/>
        public override void Evaluate(RodShape shape, int k, out CoaxialJointState s)
        {
            s = default;
            s.Joint = _joint[k];
            s.Turn = TurnOf(shape, k);
        }

        /// <inheritdoc/>
        public override bool RelaxTurns(RodShape shape)
        {
            bool isTurned = false;
            Quaterniond frame = _hasProximal ? shape.ProximalFrame * _law.AtRest(_joint[0]) : shape.Q[0];
            shape.Q[0] = frame;
            for (int k = 0; k < shape.ElementCount; k++)
            {
                isTurned |= _joint[k].Rest != Vector3d.Zero;
                if (k > 0)
                {
                    frame = Quaterniond.Normalize(frame * _law.AtRest(_joint[k]));
                    shape.Q[k] = frame;
                }
            }
            return isTurned;
        }

        /// <inheritdoc/>
        public override void Couples(RodShape shape, Vector3d[] couples)
        {
            int n = shape.ElementCount;
            _onBefore ??= new RodVector[_joint.Length];
            _onAfter ??= new RodVector[_joint.Length];
            Array.Clear(_onAfter, 0, n + 1);
            if (_hasProximal)
            {
                _law.AddGradient(First, FirstRelative(shape), ref _clampVector, ref _onAfter[0]);
            }
            AddGradient(shape, _onBefore, _onAfter, 0, n - 1);
            if (_hasDistal)
            {
                _law.AddGradient(_joint[n], shape.Q[n - 1].Conjugate * shape.DistalFrame, ref _clampVector,
                    ref _onAfter[n]);
            }
            for (int k = 0; k <= n && Fibres != null; k++)
            {
                RodVector onBefore = default;
                Fibres.AddCouple(shape, k, ref onBefore, ref _onAfter[k]);
            }
            for (int k = 0; k <= n; k++)
            {
                bool isMissing = (k == 0 && !_hasProximal) || (k == n && !_hasDistal);
                couples[k] = isMissing ? Vector3d.Zero : Quaterniond.Rotate(k == n ? shape.DistalFrame : shape.Q[k],
                    _onAfter[k].T);
            }
        }

        /// <inheritdoc/>
        public override void MeasureRates(RodShape shape, Vector3d[] spins, in Vector3d proximal, in Vector3d distal,
            Vector3d[] rates)
        {
            int n = shape.ElementCount;
            rates[0] = _hasProximal ? _law.Rate(FirstRelative(shape), proximal, spins[0])
                : Vector3d.Zero;
            for (int k = 1; k < n; k++)
            {
                rates[k] = _law.Rate(Relative(shape, k - 1), spins[k - 1], spins[k]);
            }
            rates[n] = _hasDistal ? _law.Rate(shape.Q[n - 1].Conjugate * shape.DistalFrame, spins[n - 1], distal)
                : Vector3d.Zero;
        }

        /// <inheritdoc/>
        public override Vector3d ProximalCouple(RodShape shape)
        {
            RodVector onFrame = default;
            RodVector onElement = default;
            if (_hasProximal)
            {
                _law.AddGradient(First, FirstRelative(shape), ref onFrame, ref onElement);
                Fibres?.AddCouple(shape, 0, ref onFrame, ref onElement);
            }
            return Quaterniond.Rotate(_winding.Wound(shape.ProximalFrame), onFrame.T);
        }

        /// <inheritdoc/>
        public override Vector3d DistalCouple(RodShape shape)
        {
            RodVector onFrame = default;
            RodVector onElement = default;
            int n = shape.ElementCount;
            if (_hasDistal)
            {
                _law.AddGradient(_joint[n], shape.Q[n - 1].Conjugate * shape.DistalFrame, ref onElement, ref onFrame);
                Fibres?.AddCouple(shape, n, ref onElement, ref onFrame);
            }
            return Quaterniond.Rotate(shape.DistalFrame, onFrame.T);
        }

        // Joint 0 at rest, and its turn, both less the winding.
        private Joint First
        {
            get
            {
                Joint joint = _joint[0];
                joint.Rest -= _winding.Turn * Vector3d.UnitZ;
                return joint;
            }
        }

        private Quaterniond FirstRelative(RodShape shape) => _winding.Wound(shape.ProximalFrame).Conjugate * shape.Q[0];

        private static bool HasLanes => typeof(TLaw) == typeof(RotationVectorLaw);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Quaterniond Relative(RodShape shape, int j) => shape.Q[j].Conjugate * shape.Q[j + 1];
    }
}
