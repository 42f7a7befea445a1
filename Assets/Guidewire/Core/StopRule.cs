using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Decides after each step whether a run is at its end, and which end it is.</summary>
    /// <remarks>Steady state: the prediction error has stayed below epsilon for a number of steps in a row, after it
    /// was once above (it oscillates, and is 0 before the disturbance arrives at the last sphere). Diverged: a number
    /// that is not finite; a sphere farther than 10 L from the start; or elements that are wrong in length and do not
    /// recover. The last finds gains beyond their limit, where all positions stay near. It compares the largest
    /// |length/l - 1| of two successive windows of 100 steps: both above 0.2 and not falling. A stable sweep with few
    /// iterations swings, so its windows do not fall one by one, but it never holds more strain than was put in: with S
    /// the root of the sum of |C|^2 over all stretch constraints at the start plus the drive's way over l, a wire whose
    /// sum of strains squared is within S^2 is compared over windows of 1,000 steps only.</remarks>
    internal sealed class StopRule
    {
        private const double LostDistance = 10.0;     // wire lengths
        private const double LostStrain = 0.2;        // |length/l - 1|

        private readonly double _threshold;
        private readonly int _hold;
        private readonly int _maxSteps;
        private Vector3d _origin;

        private bool _disturbed;
        private int _quietSteps;
        private readonly StrainWatch _shortWatch = new StrainWatch(100);
        private readonly StrainWatch _longWatch = new StrainWatch(1000);
        private double _strainPutIn;
        private double _largestSquareSum;
        private Vector3d _drivenTo;

        /// <param name="threshold">epsilon in units; 0 switches the steady state off.</param>
        /// <param name="hold">Steps in a row below it.</param>
        /// <param name="maxSteps">Steps after which the run is finished.</param>
        /// <param name="state">The wire as it starts, sphere 0 displaced.</param>
        public StopRule(double threshold, int hold, int maxSteps, RodState state)
        {
            _threshold = threshold;
            _hold = hold;
            _maxSteps = maxSteps;
            _origin = state.Positions[0];
            _drivenTo = _origin;
            double sum = 0.0;
            for (int j = 0; j < state.ElementCount; j++)
            {
                sum += StretchConstraint.Residual(state, j).LengthSquared;
            }
            _strainPutIn = Math.Sqrt(sum);
        }

        /// <summary>The first of the steps that make the steady state, or -1 before there is one.</summary>
        public int SteadyStateStep { get; private set; } = -1;

        /// <summary>One line that says why, once <see cref="Check"/> answers anything but Running.</summary>
        public string Reason { get; private set; } = "";

        /// <summary>The outcome after <paramref name="step"/> steps.</summary>
        public Outcome Check(RodState state, int step, double predictionError)
        {
            if (IsLost(state, step, out double strain))
            {
                return Outcome.Diverged;
            }
            if (IsSteady(step, predictionError, strain))
            {
                return Outcome.Converged;
            }
            if (step >= _maxSteps)
            {
                Reason = Text("all {0} steps are done", _maxSteps);
                return Outcome.Finished;
            }
            return Outcome.Running;
        }

        /// <summary>Writes into a snapshot, or takes over from one, what has been seen so far.</summary>
        public void Exchange(Snapshot snapshot)
        {
            snapshot.Exchange(ref _origin);
            snapshot.Exchange(ref _disturbed);
            snapshot.Exchange(ref _quietSteps);
            snapshot.Exchange(ref _strainPutIn);
            snapshot.Exchange(ref _largestSquareSum);
            snapshot.Exchange(ref _drivenTo);
            _shortWatch.Exchange(snapshot);
            _longWatch.Exchange(snapshot);
        }

        private bool IsSteady(int step, double predictionError, double strain)
        {
            if (_threshold <= 0.0)
            {
                return false;
            }
            // A wire that hardly moves because its gains are tiny is not at rest while its elements are wrong in
            // length.
            if (!(predictionError < _threshold) || strain > LostStrain)
            {
                _disturbed |= predictionError >= _threshold;
                _quietSteps = 0;
                return false;
            }
            if (!_disturbed || ++_quietSteps < _hold)
            {
                return false;
            }
            SteadyStateStep = step - _hold + 1;
            Reason = Text("the prediction error has stayed below {0} units since step {1}", _threshold,
                SteadyStateStep);
            return true;
        }

        private bool IsLost(RodState state, int step, out double worst)
        {
            double l = state.ElementLength;
            double limit = LostDistance * l * state.ElementCount;
            worst = 0.0;
            double squareSum = 0.0;
            Vector3d[] x = state.Positions;
            for (int i = 0; i < x.Length; i++)
            {
                // A NaN fails every comparison, so the question is asked for the good case.
                if (!((x[i] - _origin).LengthSquared <= limit * limit))
                {
                    Reason = x[i].IsFinite
                        ? Text("sphere {0} is farther than {1} wire lengths from the start at step {2}", i,
                            LostDistance, step)
                        : Text("sphere {0} has no finite position at step {1}", i, step);
                    return true;
                }
                if (!state.Velocities[i].IsFinite)
                {
                    Reason = Text("sphere {0} has no finite velocity at step {1}", i, step);
                    return true;
                }
                if (i > 0)
                {
                    double strain = Math.Abs(Vector3d.Distance(x[i], x[i - 1]) / state.ElementLengths[i - 1] - 1.0);
                    worst = Math.Max(worst, strain);
                    squareSum += strain * strain;
                }
            }
            if (state.InverseMasses[0] == 0.0)
            {
                _strainPutIn += Vector3d.Distance(x[0], _drivenTo) / state.ElementLengths[0];
                _drivenTo = x[0];
            }
            return StaysWrongInLength(worst, squareSum, step);
        }

        private bool StaysWrongInLength(double worst, double squareSum, int step)
        {
            _largestSquareSum = Math.Max(_largestSquareSum, squareSum);
            bool shortLost = _shortWatch.HasNotFallen(worst, LostStrain);
            bool longLost = _longWatch.HasNotFallen(worst, LostStrain);
            if (shortLost && _largestSquareSum <= _strainPutIn * _strainPutIn)
            {
                shortLost = false;
            }
            if (shortLost || longLost)
            {
                Reason = Text("elements are up to {0:0.#} % wrong in length and do not recover (step {1}): a gain"
                    + " beyond its limit, or a load that so few iterations do not carry",
                    100.0 * (shortLost ? _shortWatch : _longWatch).Largest, step);
                return true;
            }
            return false;
        }

        private static string Text(string format, params object[] values)
        {
            return string.Format(CultureInfo.InvariantCulture, format, values);
        }
    }
}
