using System;

namespace Guidewire.Core
{
    /// <summary>Motion of an instrument inside another one about the axis they share: inertia of its spin, and drag of
    /// the fluid in the lumen.</summary>
    /// <remarks>The part of it in element j turns by w_3 + z' about d3, w the angular velocity of the outer one and z
    /// its angle from there. With its inertia I and the drag c of the fluid between both,
    ///   T = 1/2 I (w_3 + z')^2,   I (z'' + w_3') + c z' + a I (z' + w_3) = -dE/dz,
    /// and I (z'' + a z') adds to the couple about d3, in which <see cref="InertiaEnergy"/> has I w_3' and a I w_3
    /// already, for I is a part of the element's; a is the damping of turns in proportion to mass. Gyroscopic couples
    /// I z' w_1 and I z' w_2 are left out: they are to those of bending as the square of the radius to that of an
    /// element's length. As those of InertiaEnergy these couples enter by their work since the anchor. In a stage of
    /// length h, z' = (z - z^)/h and z'' = (z' - r^)/h, where ^ is what earlier stages contribute.</remarks>
    internal sealed class InnerSpin : EnergyTerm
    {
        private readonly CoaxialRod _rod;
        private readonly InertiaEnergy _inertia;
        private readonly double _damping;            // a, 1/s
        private readonly double[] _twistRates;       // z' of the motion, rad/s, n
        private readonly double[] _start;            // z when the step began, rad
        private readonly double[] _history;          // z^
        private readonly double[] _rateHistory;      // r^
        private readonly double[] _before;           // z a step before, for BDF2
        private readonly double[] _rateBefore;
        private readonly double[][] _rate;           // z' by stage
        private readonly double[][] _acceleration;   // z'' by stage, rad/s^2
        private readonly double[] _anchor;           // z
        private readonly Quaterniond[] _anchorFrame;
        private readonly double[] _anchorCouple;     // on z there, N m
        private readonly double[] _anchorTurn;       // about d3

        /// <summary>For a rod of two instruments.</summary>
        /// <param name="inertia">Of the rod; it is asked for its gradient, and anchored, before this term.</param>
        /// <param name="motion">Whose angles move.</param>
        /// <param name="stageCount">Of the scheme, an explicit one counted.</param>
        public InnerSpin(CoaxialRod rod, InertiaEnergy inertia, RodMotion motion, int stageCount)
        {
            int n = motion.Shape.ElementCount;
            _rod = rod;
            _inertia = inertia;
            _damping = rod.Rod.MassDamping;
            _twistRates = motion.TwistRates;
            _start = new double[n];
            _history = new double[n];
            _rateHistory = new double[n];
            _before = new double[n];
            _rateBefore = new double[n];
            _rate = Arrays(stageCount, n);
            _acceleration = Arrays(stageCount, n);
            _anchor = new double[n];
            _anchorFrame = new Quaterniond[n];
            _anchorCouple = new double[n];
            _anchorTurn = new double[n];
        }

        /// <summary>Kinetic energy, J, beyond what the rod's inertia has with the outer spins alone.</summary>
        public static double KineticEnergy(CoaxialRod rod, Vector3d[] spins, double[] twistRates)
        {
            double sum = 0.0;
            for (int j = 0; j < rod.Joints.ActiveCount; j++)
            {
                sum += rod.InnerSpin[j] * twistRates[j] * (spins[j].Z + 0.5 * twistRates[j]);
            }
            return sum;
        }

        /// <summary>A step begins in this shape.</summary>
        public override void BeginStep(RodShape shape, double dt)
        {
            Array.Copy(shape.Twist, _start, _start.Length);
        }

        /// <summary>A stage of a Runge-Kutta scheme begins.</summary>
        /// <param name="row">a_ik; its length is the stage's index plus 1.</param>
        /// <param name="dt">The step, s.</param>
        public void BeginStage(double[] row, double dt)
        {
            for (int j = 0; j < _history.Length; j++)
            {
                _history[j] = _start[j];
                _rateHistory[j] = _twistRates[j];
                for (int k = 0; k < row.Length - 1; k++)
                {
                    _history[j] += dt * row[k] * _rate[k][j];
                    _rateHistory[j] += dt * row[k] * _acceleration[k][j];
                }
            }
        }

        /// <summary>The one stage of a step by BDF2 begins.</summary>
        /// <param name="hasPast">Whether there is a step before it.</param>
        public void BeginStage(bool hasPast)
        {
            double past = hasPast ? 1.0 / 3.0 : 0.0;
            for (int j = 0; j < _history.Length; j++)
            {
                _history[j] = (1.0 + past) * _start[j] - past * _before[j];
                _rateHistory[j] = (1.0 + past) * _twistRates[j] - past * _rateBefore[j];
                _before[j] = _start[j];
                _rateBefore[j] = _twistRates[j];
            }
        }

        /// <summary>Takes the rates of a stage that is solved.</summary>
        public void EndStage(int stage, RodShape shape)
        {
            Array.Clear(_rate[stage], 0, _history.Length);
            Array.Clear(_acceleration[stage], 0, _history.Length);
            for (int j = 0; j < Count; j++)
            {
                Rates(shape, j, out _rate[stage][j], out _acceleration[stage][j]);
            }
        }

        /// <summary>The rates in the last stage are those at the step's end.</summary>
        public void Accept()
        {
            Array.Copy(_rate[_rate.Length - 1], _twistRates, _twistRates.Length);
        }

        /// <summary>The rates at a step's start are those of its explicit first stage.</summary>
        /// <param name="fromLast">Whether z'' is that of the last stage; else it is already set.</param>
        public void SetFirst(bool fromLast)
        {
            Array.Copy(_twistRates, _rate[0], _twistRates.Length);
            if (fromLast)
            {
                Array.Copy(_acceleration[_rate.Length - 1], _acceleration[0], _twistRates.Length);
            }
        }

        /// <summary>Sets z'' of an explicit first stage, and w_3' with it, from the forces there.</summary>
        /// <param name="gradient">Of all terms but inertia.</param>
        /// <param name="spins">w.</param>
        /// <param name="spinRate">Receives w_3'.</param>
        /// <returns>The largest z'', 1/s^2.</returns>
        public double SetFirst(RodVector[] gradient, Vector3d[] spins, Vector3d[] rotary, Vector3d[] spinRate)
        {
            double largest = 0.0;
            int twist = _history.Length + 2;
            Array.Clear(_acceleration[0], 0, _history.Length);
            for (int j = 0; j < Count; j++)
            {
                double onAngle = gradient[twist + j].T3 + _rod.LumenDrag[j] * _twistRates[j];
                double outer = rotary[j].Z - _rod.InnerSpin[j];
                double spin = spins[j].Z;
                double rate = (onAngle - gradient[j].T3) / outer - _damping * spin;
                spinRate[j] = new Vector3d(spinRate[j].X, spinRate[j].Y, rate);
                _acceleration[0][j] = -onAngle / _rod.InnerSpin[j] - _damping * (_twistRates[j] + spin) - rate;
                largest = Math.Max(largest, Math.Abs(_acceleration[0][j]));
            }
            return largest;
        }

        /// <summary>Forgets the stages before.</summary>
        public void Clear()
        {
            foreach (double[] acceleration in _acceleration)
            {
                Array.Clear(acceleration, 0, acceleration.Length);
            }
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int j = 0; j < Count; j++)
            {
                double change = shape.Twist[j] - _anchor[j];
                double turn = RotationVector.Log(_anchorFrame[j].Conjugate * shape.Q[j]).Z;
                Seconds(j, out double diagonal, out double mixed);
                sum += _anchorCouple[j] * change + _anchorTurn[j] * turn
                    + (0.5 * diagonal * change + mixed * turn) * change;
            }
            return sum;
        }

        /// <inheritdoc/>
        public override double AnchoredValue(double before)
        {
            return 0.0;
        }

        /// <inheritdoc/>
        public override void Anchor(RodShape shape)
        {
            for (int j = 0; j < Count; j++)
            {
                _anchor[j] = shape.Twist[j];
                _anchorFrame[j] = shape.Q[j];
                Couples(shape, j, out _anchorCouple[j], out _anchorTurn[j]);
            }
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int twist = _history.Length + 2;
            for (int j = from; j < Math.Min(to, Count); j++)
            {
                Couples(shape, j, out double onAngle, out double onTurn);
                gradient[twist + j].T3 += onAngle;
                gradient[j].T3 += onTurn;
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            var measured = default(GradientMeasures);
            AddGradient(shape, gradient, from, to, ref measured);
        }

        /// <inheritdoc/>
        public override void AddTwistRows(RodShape shape, TwistRow[] rows, int from, int to)
        {
            for (int j = from; j < Math.Min(to, Count); j++)
            {
                Seconds(j, out double diagonal, out double mixed);
                rows[j].Diagonal += diagonal;
                rows[j].Turn += mixed * Vector3d.UnitZ;
            }
        }

        /// <summary>Writes or takes over what stages leave to later ones.</summary>
        public override void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(_history);
            snapshot.Serialize(_rateHistory);
            snapshot.Serialize(_before);
            snapshot.Serialize(_rateBefore);
            foreach (double[] acceleration in _acceleration)
            {
                snapshot.Serialize(acceleration);
            }
        }

        private int Count => _rod.Joints.ActiveCount;

        private void Rates(RodShape shape, int j, out double rate, out double acceleration)
        {
            double perStage = 1.0 / _inertia.StageLength;
            rate = perStage * (shape.Twist[j] - _history[j]);
            acceleration = perStage * (rate - _rateHistory[j]);
        }

        private void Couples(RodShape shape, int j, out double onAngle, out double onTurn)
        {
            Rates(shape, j, out double rate, out double acceleration);
            _inertia.AxialSpin(shape.Q[j], j, out double spin, out double spinRate);
            double inertia = _rod.InnerSpin[j];
            onTurn = inertia * (acceleration + _damping * rate);
            onAngle = onTurn + inertia * (spinRate + _damping * spin) + _rod.LumenDrag[j] * rate;
        }

        // By z twice, and by z and the turn about d3.
        private void Seconds(int j, out double diagonal, out double mixed)
        {
            double perStage = 1.0 / _inertia.StageLength;
            mixed = _rod.InnerSpin[j] * perStage * (perStage + _damping);
            diagonal = mixed + perStage * _rod.LumenDrag[j];
        }

        private static double[][] Arrays(int count, int length)
        {
            var arrays = new double[count][];
            for (int s = 0; s < count; s++)
            {
                arrays[s] = new double[length];
            }
            return arrays;
        }
    }
}
