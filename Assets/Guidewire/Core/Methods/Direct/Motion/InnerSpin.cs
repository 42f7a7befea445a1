using System;

namespace Guidewire.Core
{
    /// <summary>Motion of an instrument inside another one about the axis they share: inertia of its spin, and drag of
    /// the fluid in the lumen.</summary>
    /// <remarks>The part of it in element j turns by w_3 + z' about d3, w the angular velocity of the outer one and z
    /// its angle from there; where an innermost one is in it too, its drag goes with its own z' less this one's, and
    /// acts back. With its inertia I and the drag c of the fluid between both,
    ///   T = 1/2 I (w_3 + z')^2,   I (z'' + w_3') + c z' + a I (z' + w_3) = -dE/dz,
    /// and I (z'' + a z') adds to the couple about d3, in which <see cref="InertiaEnergy"/> has I w_3' and a I w_3
    /// already, for I is a part of the element's; a is the damping of turns in proportion to mass. Gyroscopic couples
    /// I z' w_1 and I z' w_2 are left out: they are to those of bending as the square of the radius to that of an
    /// element's length. As those of InertiaEnergy these couples enter by their work since the anchor. In a stage of
    /// length h, z' = (z - z^)/h and z'' = (z' - r^)/h, where ^ is what earlier stages contribute.</remarks>
    internal sealed class InnerSpin : EnergyTerm
    {
        private readonly CoaxialRod _rod = null!;    // of none nothing is asked
        private readonly int _count;                 // of instruments inside
        private readonly InertiaEnergy _inertia;
        private readonly double _damping;            // a, 1/s
        private readonly RodShape _shape;            // of the motion
        private readonly double[] _twistRates;       // z' of the motion, rad/s, n for each instrument inside
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

        /// <summary>For a rod of several instruments, or of one: then there is nothing to do.</summary>
        /// <param name="rod">Null: one alone.</param>
        /// <param name="inertia">Of the rod; its gradient is evaluated, and it is anchored, before this term.</param>
        /// <param name="motion">Whose angles move.</param>
        /// <param name="stageCount">Of the scheme, an explicit one counted.</param>
        public InnerSpin(CoaxialRod? rod, InertiaEnergy inertia, RodMotion motion, int stageCount)
        {
            int n = motion.TwistRates.Length;    // room
            if (rod != null)
            {
                _rod = rod;
                _count = rod.Joints.InnerCount;
                _damping = rod.Rod.MassDamping;
            }
            _inertia = inertia;
            _shape = motion.Shape;
            _twistRates = motion.TwistRates;
            _start = new double[n];
            _history = new double[n];
            _rateHistory = new double[n];
            _before = new double[n];
            _rateBefore = new double[n];
            _rate = Arrays(stageCount, n);
            _acceleration = Arrays(stageCount, n);
            _anchor = new double[n];
            _anchorFrame = new Quaterniond[motion.Shape.Q.Length];
            _anchorCouple = new double[n];
            _anchorTurn = new double[n];
        }

        /// <summary>Kinetic energy, J, beyond what the rod's inertia has with the outer spins alone.</summary>
        public static double KineticEnergy(CoaxialRod rod, Vector3d[] spins, double[] twistRates)
        {
            double sum = 0.0;
            for (int i = 1; i < rod.Joints.Count; i++)
            {
                int first = (i - 1) * rod.Joints.ElementCount;
                for (int j = 0; j < rod.Joints.ActiveCountOf(i); j++)
                {
                    double rate = twistRates[first + j];
                    sum += rod.InnerSpin[first + j] * rate * (spins[j].Z + 0.5 * rate);
                }
            }
            return sum;
        }

        private int Angles => _shape.TwistCount;

        /// <inheritdoc/>
        public override void Remesh()
        {
            Array.Clear(_history, 0, _history.Length);
            Array.Clear(_rateHistory, 0, _history.Length);
            Array.Clear(_before, 0, _history.Length);
            Array.Clear(_rateBefore, 0, _history.Length);
            Clear();
        }

        /// <summary>A step begins in this shape.</summary>
        public override void BeginStep(RodShape shape, double dt) => Array.Copy(shape.Twist, _start, Angles);

        /// <summary>A stage of a Runge-Kutta scheme begins.</summary>
        /// <param name="row">a_ik; its length is the stage's index plus 1.</param>
        /// <param name="dt">The step, s.</param>
        public void BeginStage(double[] row, double dt)
        {
            for (int j = 0; j < Angles; j++)
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
            for (int j = 0; j < Angles; j++)
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
            Array.Clear(_rate[stage], 0, Angles);
            Array.Clear(_acceleration[stage], 0, Angles);
            for (int i = 1; i <= _count; i++)
            {
                for (int j = 0; j < CountOf(i); j++)
                {
                    int at = At(i, j);
                    Rates(shape, at, out _rate[stage][at], out _acceleration[stage][at]);
                }
            }
        }

        /// <summary>The rates in the last stage are those at the step's end.</summary>
        public void Accept() => Array.Copy(_rate[_rate.Length - 1], _twistRates, Angles);

        /// <summary>The rates at a step's start are those of its explicit first stage.</summary>
        /// <param name="fromLast">Whether z'' is that of the last stage; else it is already set.</param>
        public void SetFirst(bool fromLast)
        {
            Array.Copy(_twistRates, _rate[0], Angles);
            if (fromLast)
            {
                Array.Copy(_acceleration[_rate.Length - 1], _acceleration[0], Angles);
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
            int twist = _shape.ElementCount + 2;
            Array.Clear(_acceleration[0], 0, Angles);
            for (int j = 0; j < ActiveCount; j++)
            {
                double outer = rotary[j].Z;
                double couple = -gradient[j].T3;
                double spin = spins[j].Z;
                for (int i = 1; i <= _count; i++)
                {
                    if (j < CountOf(i))
                    {
                        double onAngle = OnAngle(gradient[twist + j], i, j);
                        outer -= _rod.InnerSpin[At(i, j)];
                        couple += onAngle;
                        _acceleration[0][At(i, j)] = -onAngle / _rod.InnerSpin[At(i, j)]
                            - _damping * (_twistRates[At(i, j)] + spin);
                    }
                }
                double rate = couple / outer - _damping * spin;
                spinRate[j] = new Vector3d(spinRate[j].X, spinRate[j].Y, rate);
                for (int i = 1; i <= _count; i++)
                {
                    if (j < CountOf(i))
                    {
                        _acceleration[0][At(i, j)] -= rate;
                        largest = Math.Max(largest, Math.Abs(_acceleration[0][At(i, j)]));
                    }
                }
            }
            return largest;
        }

        private double OnAngle(in RodVector gradient, int instrument, int j)
        {
            double couple = instrument == 1 ? gradient.T3 : gradient.T2;
            int at = At(instrument, j);
            double drag = Between(j);
            couple += _rod.LumenDrag[at] * _twistRates[at];
            return drag == 0.0 ? couple : instrument == 2 ? couple - drag * _twistRates[j]
                : couple + drag * (_twistRates[j] - _twistRates[At(2, j)]);
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
            for (int i = 1; i <= _count; i++)
            {
                for (int j = 0; j < CountOf(i); j++)
                {
                    int at = At(i, j);
                    double change = shape.Twist[at] - _anchor[at];
                    double turn = RotationVector.Log(_anchorFrame[j].Conjugate * shape.Q[j]).Z;
                    Seconds(i, j, out double diagonal, out double mixed);
                    sum += _anchorCouple[at] * change + _anchorTurn[at] * turn
                        + (0.5 * diagonal * change + mixed * turn) * change;
                    if (i == 2 && Between(j) > 0.0)
                    {
                        sum -= Between(j) / _inertia.StageLength * change * (shape.Twist[j] - _anchor[j]);
                    }
                }
            }
            return sum;
        }

        /// <inheritdoc/>
        public override double AnchoredValue(double before) => 0.0;

        /// <inheritdoc/>
        public override void Anchor(RodShape shape)
        {
            for (int j = 0; j < ActiveCount; j++)
            {
                _anchorFrame[j] = shape.Q[j];
            }
            for (int i = 1; i <= _count; i++)
            {
                for (int j = 0; j < CountOf(i); j++)
                {
                    int at = At(i, j);
                    _anchor[at] = shape.Twist[at];
                    Couples(shape, i, j, out _anchorCouple[at], out _anchorTurn[at]);
                }
            }
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int twist = shape.ElementCount + 2;
            for (int i = 1; i <= _count; i++)
            {
                for (int j = from; j < Math.Min(to, CountOf(i)); j++)
                {
                    Couples(shape, i, j, out double onAngle, out double onTurn);
                    ref RodVector angle = ref gradient[twist + j];
                    angle.T3 += i == 1 ? onAngle : 0.0;
                    angle.T2 += i == 2 ? onAngle : 0.0;
                    gradient[j].T3 += onTurn;
                }
            }
        }

        /// <inheritdoc/>
        public override void AddTwistRows(RodShape shape, TwistRow[] rows, int from, int to)
        {
            for (int i = 1; i <= _count; i++)
            {
                int first = (i - 1) * (shape.ElementCount + 1);
                for (int j = from; j < Math.Min(to, CountOf(i)); j++)
                {
                    Seconds(i, j, out double diagonal, out double mixed);
                    rows[first + j].Diagonal += diagonal;
                    rows[first + j].Turn += mixed * Vector3d.UnitZ;
                    rows[j].Other -= i == 2 ? Between(j) / _inertia.StageLength : 0.0;
                }
            }
        }

        /// <summary>Writes or restores what stages leave to later ones.</summary>
        public override void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(_history, Angles);
            snapshot.Serialize(_rateHistory, Angles);
            snapshot.Serialize(_before, Angles);
            snapshot.Serialize(_rateBefore, Angles);
            foreach (double[] acceleration in _acceleration)
            {
                snapshot.Serialize(acceleration, Angles);
            }
        }

        private int ActiveCount => _count == 0 ? 0 : _rod.Joints.ActiveCount;

        private int CountOf(int instrument) => _rod.Joints.ActiveCountOf(instrument);

        private int At(int instrument, int element) => (instrument - 1) * _rod.Joints.ElementCount + element;

        // Drag of the innermost instrument in one that has an angle of its own there.
        private double Between(int element)
        {
            return _count > 1 && element < CountOf(1) && element < CountOf(2)
                ? _rod.LumenDrag[At(2, element)] : 0.0;
        }

        private void Rates(RodShape shape, int at, out double rate, out double acceleration)
        {
            double perStage = 1.0 / _inertia.StageLength;
            rate = perStage * (shape.Twist[at] - _history[at]);
            acceleration = perStage * (rate - _rateHistory[at]);
        }

        private void Couples(RodShape shape, int instrument, int j, out double onAngle, out double onTurn)
        {
            int at = At(instrument, j);
            Rates(shape, at, out double rate, out double acceleration);
            _inertia.AxialSpin(shape.Q[j], j, out double spin, out double spinRate);
            double inertia = _rod.InnerSpin[at];
            onTurn = inertia * (acceleration + _damping * rate);
            onAngle = onTurn + inertia * (spinRate + _damping * spin) + _rod.LumenDrag[at] * rate;
            double drag = Between(j);
            if (drag > 0.0)
            {
                Rates(shape, At(3 - instrument, j), out double other, out _);
                onAngle += instrument == 2 ? -drag * other : drag * (rate - other);
            }
        }

        // By z twice, and by z and the turn about d3.
        private void Seconds(int instrument, int j, out double diagonal, out double mixed)
        {
            int at = At(instrument, j);
            double perStage = 1.0 / _inertia.StageLength;
            mixed = _rod.InnerSpin[at] * perStage * (perStage + _damping);
            diagonal = mixed + perStage * (_rod.LumenDrag[at] + (instrument == 1 ? Between(j) : 0.0));
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

    /// <summary>Estimates the loss of angular momentum of a free wire by a scheme, from its rotation in each
    /// step.</summary>
    /// <remarks>A step that turns a straight wire by theta about a lateral axis takes, relative to what there is,
    ///   1 % theta/(20 pi) (theta/theta_1)^k,
    /// so 1 % in ten turns in steps of theta_1. Implicit Euler: a mass m on a stiff bar has x1 x (v1 - v0) = 0, with
    /// v = (x1 - x0)/h: 2 sin(theta_1) = sin(theta_0 + theta_1), so theta^2 a step. The others' figures are measured
    /// (docs/verification.md): esdirk4 gains above 0.15 rad a step. A spin about the wire's own axis loses nothing, and
    /// bending back and forth has no mean; so theta is by the mean of the elements' lateral angular
    /// velocities.</remarks>
    internal sealed class SpinLoss
    {
        private const double Turns = 20.0 * Math.PI;   // rad
        private const double LossInTurns = 0.01;

        private readonly double _angle;   // theta_1, rad
        private readonly double _power;   // k
        private double _sum;              // of what steps took, relative

        /// <summary>Adds up the loss of this scheme.</summary>
        public SpinLoss(Integrator integrator)
        {
            (_angle, _power) = integrator switch
            {
                Integrator.ImplicitEuler => (LossInTurns / Turns, 1.0),
                Integrator.Bdf2 => (0.057, 3.0),
                Integrator.Trbdf2 => (0.155, 2.2),
                Integrator.Esdirk3 => (0.21, 3.1),
                Integrator.Esdirk4 => (0.37, 4.5),
                _ => (double.PositiveInfinity, 1.0),
            };
        }

        /// <summary>The farthest that the wire turned in a step, rad.</summary>
        public double LargestTurn { get; private set; }

        /// <summary>What is expected to be lost so far, or with esdirk4 gained, of the angular momentum.</summary>
        public double Expected => 1.0 - Math.Exp(-_sum);

        /// <summary>Takes the end of a step, or of several of one length.</summary>
        /// <param name="spins">Angular velocities along the elements' axes, rad/s.</param>
        /// <param name="dt">Of all of them, s.</param>
        public void AddSteps(MaterialRod rod, RodShape shape, Vector3d[] spins, double dt, long steps)
        {
            Vector3d sum = Vector3d.Zero;
            for (int j = 0; j < spins.Length; j++)
            {
                sum += rod.Length[j] * Quaterniond.Rotate(shape.Q[j], new Vector3d(spins[j].X, spins[j].Y, 0.0));
            }
            double turn = dt / steps * sum.Length / rod.TotalLength;
            LargestTurn = Math.Max(LargestTurn, turn);
            _sum += steps * LossInTurns * turn / Turns * Math.Pow(turn / _angle, _power);
        }

        /// <summary>Writes or restores the sums.</summary>
        public void Serialize(Snapshot snapshot)
        {
            LargestTurn = snapshot.Serialize(LargestTurn);
            snapshot.Serialize(ref _sum);
        }
    }
}
