using System;

namespace Guidewire.Core
{
    /// <summary>Whether a rod stays in an equilibrium: whether the second derivative K of its energy has no negative
    /// eigenvalue but those of neutral motions, of which K knows only that they are 0 to rounding.</summary>
    /// <remarks>A neutral motion changes no energy: a rigid motion that supports and loads allow (a free rod, a rod on
    /// a ball joint about the vertical), round sections that turn about themselves, or both at once (a buckled rod
    /// about its thrust). Rounding makes of its eigenvalue 0 one of either sign, of a size that goes with the stiffest
    /// element: sizes alone do not tell it from that of a soft element that buckles. So each eigenvector with a
    /// negative eigenvalue is compared with the motions that deform nothing or turn sections only: of a rod at a clamp
    /// the rotation about the clamp's axis while all elements turn back about their own d3; of others the rotations
    /// about node 0, the turn of all elements about their own d3 and, where nothing holds the rod, translations. The
    /// eigenvector is neutral if it is a sum of those to within 1 % in the metric, and if the energy is the same after
    /// a finite motion of that kind. The latter tells the turn of a pendulum about the vertical from its
    /// fall.</remarks>
    internal sealed class EquilibriumStability
    {
        private const int MotionCount = 7;
        private const double LargestResidual = 0.01;    // of the eigenvector, in the metric
        private const double SmallestPart = 1e-6;       // of a motion that is not the sum of others, in the metric
        private const double FiniteTurn = 0.5;          // rad, or shift over L
        private const double SameEnergy = 1e-9;         // of the sum of the terms' magnitudes
        private const double NoEnergy = 1e-12;          // of EI/L
        private const double LargestUnbalanced = 0.1;   // force on a node, of EI/L^2
        private const int PowerIterations = 40;
        private const int MaxHalvings = 40;

        private readonly RodSupports _supports;
        private readonly EnergyTerm[] _terms;
        private readonly BlockTridiagonal _system;
        private readonly RodVector[] _gradient;
        private readonly RodVector[] _work;
        private readonly RodVector[][] _modes = new RodVector[MotionCount][];
        private readonly RodVector[][] _motions = new RodVector[MotionCount][];
        private readonly Motion[] _kinds = new Motion[MotionCount];
        private readonly RodShape _moved;
        private readonly double _length;
        private readonly double _neutral;  // N
        private readonly double _bendForce; // N
        private readonly double _noEnergy; // J

        /// <summary>Makes one for a rod under these terms.</summary>
        /// <param name="system">Its system; it holds another factorisation after each question.</param>
        /// <param name="neutral">The size of an eigenvalue below which it may be 0, N.</param>
        public EquilibriumStability(MaterialRod rod, RodSupports supports, EnergyTerm[] terms,
            BlockTridiagonal system, double neutral)
        {
            _supports = supports;
            _terms = terms;
            _system = system;
            _neutral = neutral;
            _length = rod.TotalLength;
            _bendForce = rod.BendForce;
            _noEnergy = NoEnergy * _bendForce * _length;
            _gradient = new RodVector[system.VectorCount];
            _work = new RodVector[system.VectorCount];
            for (int k = 0; k < MotionCount; k++)
            {
                _modes[k] = new RodVector[system.VectorCount];
                _motions[k] = new RodVector[system.VectorCount];
            }
            _moved = new RodShape(rod.ElementCount, supports.InnerCount);
        }

        /// <summary>The eigenvector with a negative eigenvalue that is no neutral motion, where the last answer was no;
        /// null where there were too many, or one that is clearly negative.</summary>
        public RodVector[]? Undecided { get; private set; }

        /// <summary>Whether no eigenvalue of K is negative in this shape but those of neutral motions.</summary>
        public bool IsStable(RodShape shape)
        {
            Undecided = null;
            int negative = Factorise(shape, 0.0);
            if (negative == 0)
            {
                return true;
            }
            if (negative > MotionCount || Factorise(shape, _neutral) > 0)
            {
                return false;
            }
            double shift = LowestShift(shape);
            SetMotions(shape);
            for (int k = 0; k < negative; k++)
            {
                double eigenvalue = FindMode(k) - shift;
                if (eigenvalue < 0.0 && !IsNeutral(shape, _modes[k]))
                {
                    Undecided = _modes[k];
                    return false;
                }
            }
            return true;
        }

        /// <summary>Gives the eigenvector of the smallest eigenvalue; of no use after the next question.</summary>
        /// <param name="eigenvalue">N.</param>
        public RodVector[] LowestMode(RodShape shape, out double eigenvalue)
        {
            double shift = Factorise(shape, 0.0) == 0 ? 0.0 : LowestShift(shape);
            eigenvalue = FindMode(0) - shift;
            return _modes[0];
        }

        /// <summary>Whether the rod is near an equilibrium with an eigenvalue so negative that rounding cannot have
        /// made
        /// it of a 0. In a violent motion, far from any, its sign says nothing.</summary>
        public bool IsNearSaddle(RodShape shape)
        {
            if (Factorise(shape, _neutral) == 0)
            {
                return false;
            }
            Array.Copy(_gradient, _work, _work.Length);
            _system.Project(_work);
            return RodVectors.Largest(_work, _length) <= LargestUnbalanced * _bendForce;
        }

        /// <summary>How far the rod is from the unstable equilibrium near it, and goes on in a time, along the mode of
        /// the smallest eigenvalue, m: the largest shift, or turn times L.</summary>
        /// <param name="motion">Velocities.</param>
        /// <param name="time">s.</param>
        public double AwayFromSaddle(RodShape shape, RodVector[] motion, double time)
        {
            RodVector[] mode = LowestMode(shape, out double eigenvalue);
            double away = RodVectors.Dot(_gradient, mode, mode.Length) / eigenvalue;
            Array.Copy(motion, _work, _work.Length);
            _system.ApplyMetric(_work);
            double speed = RodVectors.Dot(mode, _work);
            return _length * RodStep.Size(mode, shape.ElementCount, _length, out _, mode.Length)
                * (Math.Abs(away) + time * Math.Abs(speed));
        }

        private int Factorise(RodShape shape, double shift) =>
            _system.Factorise(_terms, shape, _gradient, _work, shift);

        // Just above the size of the most negative eigenvalue; its factorisation is kept.
        private double LowestShift(RodShape shape)
        {
            double low = 0.0;
            double high = _neutral;
            while (Factorise(shape, high) > 0 && high <= double.MaxValue)
            {
                low = high;
                high *= 4.0;
            }
            for (int k = 0; k < MaxHalvings && high > 1.02 * low; k++)
            {
                double middle = 0.5 * (low + high);
                bool isPositive = Factorise(shape, middle) == 0;
                low = isPositive ? low : middle;
                high = isPositive ? middle : high;
            }
            Factorise(shape, high);
            return high;
        }

        // By inverse iteration, across the modes before it; the eigenvalue of the current matrix.
        private double FindMode(int k)
        {
            RodVector[] mode = _modes[k];
            RodVectors.SetWithoutSymmetry(mode, _length);
            _system.Project(mode);
            double eigenvalue = 0.0;
            for (int i = 0; i < PowerIterations; i++)
            {
                for (int j = 0; j < k; j++)
                {
                    RodVectors.AddScaled(mode, -_system.MetricDot(mode, _modes[j]), _modes[j]);
                }
                RodVectors.Scale(mode, 1.0 / Math.Sqrt(_system.MetricDot(mode, mode)));
                Array.Copy(mode, _work, mode.Length);
                _system.ApplyMetric(mode);
                _system.Solve(mode);
                eigenvalue = 1.0 / _system.MetricDot(mode, _work);
            }
            RodVectors.Scale(mode, 1.0 / Math.Sqrt(_system.MetricDot(mode, mode)));
            return eigenvalue;
        }

        // An orthonormal base of the motions that may be neutral.
        private void SetMotions(RodShape shape)
        {
            int count = ListMotions(shape);
            for (int k = 0; k < MotionCount; k++)
            {
                _kinds[k] = k < count ? _kinds[k] : default;
                SetRates(shape, _kinds[k], _motions[k]);
                double size = _system.MetricDot(_motions[k], _motions[k]);
                for (int j = 0; j < 2 * k; j++)
                {
                    // Twice: once leaves rounding of what is almost the sum of others.
                    Add(k, -_system.MetricDot(_motions[k], _motions[j % k]), j % k);
                }
                double left = _system.MetricDot(_motions[k], _motions[k]);
                Add(k, left > SmallestPart * SmallestPart * size ? 1.0 / Math.Sqrt(left) - 1.0 : -1.0, k);
            }
        }

        private int ListMotions(RodShape shape)
        {
            int count = 0;
            bool isLoose = _supports.Proximal == ProximalEnd.Free;
            if (_supports.HasProximalJoint || _supports.HasDistalJoint)
            {
                bool isFirst = _supports.HasProximalJoint;
                Vector3d axis = (isFirst ? shape.ProximalFrame : shape.DistalFrame).Director3;
                Vector3d arm = isFirst ? Vector3d.Zero : shape.X[0] - shape.X[shape.ElementCount];
                _kinds[count++] = new Motion { Shift = Vector3d.Cross(axis, arm), Turn = axis, Own = -1.0 };
                if (isLoose && _supports.Distal == DistalEnd.Sliding)
                {
                    _kinds[count++] = new Motion { Shift = _length * _supports.SlidingAxis };
                }
                return count;
            }
            if (_supports.HoldsLastNode && !isLoose)
            {
                Vector3d axis = Vector3d.Normalize(shape.X[shape.ElementCount] - shape.X[0]);
                _kinds[count++] = new Motion { Turn = axis };
                _kinds[count++] = new Motion { Own = 1.0 };
                return count;
            }
            for (int k = 0; k < 3; k++)
            {
                Vector3d axis = k == 0 ? Vector3d.UnitX : k == 1 ? Vector3d.UnitY : Vector3d.UnitZ;
                _kinds[count++] = new Motion { Turn = axis };
                if (isLoose)
                {
                    _kinds[count++] = new Motion { Shift = _length * axis };
                }
            }
            _kinds[count++] = new Motion { Own = 1.0 };
            return count;
        }

        // Base vector k += factor times base vector j.
        private void Add(int k, double factor, int j)
        {
            RodVectors.AddScaled(_motions[k], factor, _motions[j]);
            _kinds[k].Add(factor, _kinds[j]);
        }

        private static void SetRates(RodShape shape, in Motion motion, RodVector[] rates)
        {
            int n = shape.ElementCount;
            Array.Clear(rates, 0, rates.Length);
            for (int i = 0; i <= n; i++)
            {
                Vector3d x = motion.Shift + Vector3d.Cross(motion.Turn, shape.X[i] - shape.X[0]);
                Vector3d t = i == n ? Vector3d.Zero
                    : Quaterniond.Rotate(shape.Q[i].Conjugate, motion.Turn) + motion.Own * Vector3d.UnitZ;
                rates[i] = new RodVector(x, t);
            }
        }

        private bool IsNeutral(RodShape shape, RodVector[] mode)
        {
            Motion motion = default;
            double left = 1.0;
            for (int k = 0; k < MotionCount; k++)
            {
                double part = _system.MetricDot(mode, _motions[k]);
                left -= part * part;
                motion.Add(part, _kinds[k]);
            }
            if (left > LargestResidual * LargestResidual)
            {
                return false;
            }
            // What is not of the motions is as large as the error of their parts, on which energy depends in second
            // order.
            double scale = FiniteTurn / RodStep.Size(mode, shape.ElementCount, _length, out _);
            double start = EnergySum.Value(_terms, shape, out double magnitude);
            double same = (SameEnergy + Math.Max(left, 0.0)) * magnitude + _noEnergy;
            return Math.Abs(EnergyAfter(shape, scale, motion) - start) <= same
                && Math.Abs(EnergyAfter(shape, -scale, motion) - start) <= same;
        }

        // The energy after a finite motion.
        private double EnergyAfter(RodShape shape, double scale, in Motion rates)
        {
            Motion motion = default;
            motion.Add(scale, rates);
            Quaterniond rotation = RotationVector.Exp(motion.Turn);
            Quaterniond own = RotationVector.Exp(motion.Own * Vector3d.UnitZ);
            Vector3d start = shape.X[0] + Moved(motion.Shift, motion.Turn);
            _moved.CopyFrom(shape);
            for (int i = 0; i <= shape.ElementCount; i++)
            {
                _moved.X[i] = start + Quaterniond.Rotate(rotation, shape.X[i] - shape.X[0]);
                if (i < shape.ElementCount)
                {
                    _moved.Q[i] = Quaterniond.Normalize(rotation * shape.Q[i] * own);
                }
            }
            return EnergySum.Value(_terms, _moved, out _);
        }

        // The integral of exp(s turn) shift over s from 0 to 1: how far a screw takes the point that it begins at.
        private static Vector3d Moved(in Vector3d shift, in Vector3d turn)
        {
            double squared = turn.LengthSquared;
            double angle = Math.Sqrt(squared);
            bool isSmall = angle < 1e-4;
            double across = isSmall ? 0.5 : (1.0 - Math.Cos(angle)) / squared;
            double along = isSmall ? 1.0 / 6.0 : (angle - Math.Sin(angle)) / (squared * angle);
            Vector3d once = Vector3d.Cross(turn, shift);
            return shift + across * once + along * Vector3d.Cross(turn, once);
        }

        // Rates: velocity of node 0, rotation about it, turn of every element about its own d3.
        private struct Motion
        {
            public Vector3d Shift;
            public Vector3d Turn;
            public double Own;

            public void Add(double factor, in Motion other)
            {
                // Also where the other is this one.
                Motion added = other;
                Shift += factor * added.Shift;
                Turn += factor * added.Turn;
                Own += factor * added.Own;
            }
        }
    }
}
