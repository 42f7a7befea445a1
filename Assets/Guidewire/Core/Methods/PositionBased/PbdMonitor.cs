using System;
using static System.FormattableString;

namespace Guidewire.Core
{
    /// <summary>Decides after each step of a pbd wire whether it has diverged or is in a steady state.</summary>
    /// <remarks>Steady state: the prediction error has stayed below epsilon for a number of steps in a row, after it
    /// was once above (it oscillates, and is 0 before the disturbance arrives at the last sphere). Lost: a sphere
    /// farther than 10 L from the start, or elements that are wrong in length and do not recover. The last finds pbd
    /// stiffness beyond their limit, where all positions stay near. It compares the largest |length/l - 1| of two
    /// successive windows of 100 steps: both above 0.2 and not falling. A stable solve with few iterations oscillates,
    /// so its windows do not fall one by one, but it never holds more strain than was put in: with S the root of the
    /// sum of |C|^2 over all stretch constraints at the start plus the drive's displacement over l, a wire whose sum of
    /// strains squared is within S^2 is compared over windows of 1,000 steps only. None of this holds for a material,
    /// where a strain may be what the load asks for: see <see cref="EnergyMonitor"/> and <see
    /// cref="RestMonitor"/>.</remarks>
    internal sealed class PbdMonitor
    {
        private const double DivergedDistance = 10.0;     // wire lengths
        private const double DivergedStrain = 0.2;        // |length/l - 1|

        private readonly double _threshold;
        private Vector3d _origin;
        private int _step;
        private bool _disturbed;
        private int _quietSteps;
        private readonly TurnMonitor _turns;
        private readonly StrainMonitor _shortMonitor = new StrainMonitor(100);
        private readonly StrainMonitor _longMonitor = new StrainMonitor(1000);
        private double _strainPutIn;
        private double _largestSquareSum;
        private Vector3d _drivenTo;

        /// <param name="threshold">epsilon in units; 0 switches the steady state off.</param>
        /// <param name="hold">Steps in a row below it.</param>
        /// <param name="state">The wire as it starts, sphere 0 displaced.</param>
        public PbdMonitor(double threshold, int hold, RodState state)
        {
            _threshold = threshold;
            Hold = hold;
            _origin = state.Positions[0];
            _drivenTo = _origin;
            _turns = new TurnMonitor(state);
            double sum = 0.0;
            for (int j = 0; j < state.ElementCount; j++)
            {
                sum += StretchConstraint.Residual(state, j).LengthSquared;
            }
            _strainPutIn = Math.Sqrt(sum);
        }

        /// <summary>Steps in a row that make a steady state.</summary>
        public int Hold { get; }

        /// <summary>How the wire was lost, in one line, or null.</summary>
        public string? Loss { get; private set; }

        /// <summary>What made the steady state, in one line, or null.</summary>
        public string? SteadyState { get; private set; }

        /// <summary>Which turn the wire has lost, or null.</summary>
        public RunWarning? LostTurn => _turns.Warning;

        /// <summary>Takes the wire after one more step.</summary>
        public void Update(RodState state, double predictionError)
        {
            _step++;
            _turns.Update(state, _step);
            Loss = FindLoss(state, out double strain);
            if (Loss == null)
            {
                SteadyState = FindSteadyState(predictionError, strain);
            }
        }

        /// <summary>Writes into a snapshot, or restores from one, what has been seen so far.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _origin);
            snapshot.Serialize(ref _step);
            snapshot.Serialize(ref _disturbed);
            snapshot.Serialize(ref _quietSteps);
            snapshot.Serialize(ref _strainPutIn);
            snapshot.Serialize(ref _largestSquareSum);
            snapshot.Serialize(ref _drivenTo);
            _shortMonitor.Serialize(snapshot);
            _longMonitor.Serialize(snapshot);
            _turns.Serialize(snapshot);
        }

        private string? FindSteadyState(double predictionError, double strain)
        {
            if (_threshold <= 0.0)
            {
                return null;
            }
            // A wire that hardly moves because its pbd stiffness is tiny is not at rest while its elements are wrong in
            // length.
            if (!(predictionError < _threshold) || strain > DivergedStrain)
            {
                _disturbed |= predictionError >= _threshold;
                _quietSteps = 0;
                return null;
            }
            if (!_disturbed || ++_quietSteps < Hold)
            {
                return null;
            }
            return Invariant($"the prediction error has stayed below {_threshold} units since step {_step - Hold + 1}");
        }

        private string? FindLoss(RodState state, out double worst)
        {
            double l = state.ElementLength;
            double limit = DivergedDistance * l * state.ElementCount;
            worst = 0.0;
            double squareSum = 0.0;
            Vector3d[] x = state.Positions;
            for (int i = 0; i < x.Length; i++)
            {
                if ((x[i] - _origin).LengthSquared > limit * limit)
                {
                    return Invariant($"sphere {i} is farther than {DivergedDistance} wire lengths from the start at ")
                        + Invariant($"step {_step}");
                }
                if (i > 0)
                {
                    double strain = Math.Abs(Vector3d.Distance(x[i], x[i - 1]) / l - 1.0);
                    worst = Math.Max(worst, strain);
                    squareSum += strain * strain;
                }
            }
            if (state.InverseMasses[0] == 0.0)
            {
                _strainPutIn += Vector3d.Distance(x[0], _drivenTo) / l;
                _drivenTo = x[0];
            }
            return FindStrainThatStays(worst, squareSum);
        }

        private string? FindStrainThatStays(double worst, double squareSum)
        {
            _largestSquareSum = Math.Max(_largestSquareSum, squareSum);
            bool shortLost = _shortMonitor.HasNotFallen(worst, DivergedStrain);
            bool longLost = _longMonitor.HasNotFallen(worst, DivergedStrain);
            if (shortLost && _largestSquareSum <= _strainPutIn * _strainPutIn)
            {
                shortLost = false;
            }
            if (shortLost || longLost)
            {
                double off = 100.0 * (shortLost ? _shortMonitor : _longMonitor).Largest;
                return Invariant($"elements are up to {off:0.#} % wrong in length and do not recover (step {_step})")
                    + ": a pbd stiffness beyond its limit, or too few iterations for the load";
            }
            return null;
        }
    }

    /// <summary>Compares the largest strain of one window of steps with that of the window before.</summary>
    internal sealed class StrainMonitor
    {
        private readonly int _length;
        private int _step;
        private double _largest;
        private double _previousLargest = double.PositiveInfinity;

        /// <param name="length">Steps in a window.</param>
        public StrainMonitor(int length)
        {
            _length = length;
        }

        /// <summary>The largest strain of the window that ended last, dimensionless.</summary>
        public double Largest { get; private set; }

        /// <summary>Writes into a snapshot, or restores from one, the windows so far.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Largest = snapshot.Serialize(Largest);
            snapshot.Serialize(ref _step);
            snapshot.Serialize(ref _largest);
            snapshot.Serialize(ref _previousLargest);
        }

        /// <summary>Takes one step's largest strain; true at the end of a window that, like the one before, went above
        /// the limit, and in which the largest strain has not fallen.</summary>
        /// <param name="strain">|length/l - 1| of the worst element.</param>
        /// <param name="limit">What counts as wrong in length.</param>
        public bool HasNotFallen(double strain, double limit)
        {
            _largest = Math.Max(_largest, strain);
            if (++_step < _length)
            {
                return false;
            }
            Largest = _largest;
            bool notFallen = _largest > limit && _previousLargest > limit && _largest >= _previousLargest;
            _previousLargest = _largest;
            _largest = 0.0;
            _step = 0;
            return notFallen;
        }
    }

    /// <summary>Detects a joint of a pbd wire that has rotated beyond half a turn: it then unwinds in the other
    /// direction, and
    /// the wire has lost a turn.</summary>
    /// <remarks>What a joint is given back goes as the sine of its angle: the most at a quarter of a turn, nothing at
    /// half of one. Orientations follow the double cover of the rotations, so that Re(q_j* q_{j+1}) = cos(angle/2)
    /// changes its sign there and stays so until another turn is lost.</remarks>
    internal sealed class TurnMonitor
    {
        private readonly bool[] _wasBeyond;    // per joint, of the wire as it started
        private int _joint = -1;
        private int _step;

        /// <param name="state">The wire as it starts.</param>
        public TurnMonitor(RodState state)
        {
            _wasBeyond = new bool[state.ElementCount - 1];
            for (int j = 0; j < _wasBeyond.Length; j++)
            {
                _wasBeyond[j] = IsBeyond(state, j);
            }
        }

        /// <summary>The first joint that lost a turn, and when; or null.</summary>
        public RunWarning? Warning => _joint < 0 ? (RunWarning?)null : WarningTable.LostTurn.With(_joint, _step);

        /// <summary>Takes the wire after a step.</summary>
        /// <param name="state">The wire.</param>
        /// <param name="step">Number of the step, from 1.</param>
        public void Update(RodState state, int step)
        {
            for (int j = 0; _joint < 0 && j < _wasBeyond.Length; j++)
            {
                if (IsBeyond(state, j) != _wasBeyond[j])
                {
                    _joint = j;
                    _step = step;
                }
            }
        }

        /// <summary>Writes into a snapshot, or restores from one, what has been seen so far.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _joint);
            snapshot.Serialize(ref _step);
        }

        private static bool IsBeyond(RodState state, int joint)
        {
            Quaterniond a = state.Orientations[joint];
            Quaterniond b = state.Orientations[joint + 1];
            return a.X * b.X + a.Y * b.Y + a.Z * b.Z + a.W * b.W < 0.0;
        }
    }
}
