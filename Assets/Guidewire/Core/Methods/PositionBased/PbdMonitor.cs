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
}
