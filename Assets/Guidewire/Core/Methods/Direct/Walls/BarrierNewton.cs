using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Solves one implicit stage between walls: Newton's method on one energy, that of inertia, wire, loads
    /// and barriers, from a shape with open gaps to one in equilibrium.</summary>
    /// <remarks>A step goes no farther than every gap allows on the straight path of the nodes, and is shortened until
    /// the energy falls by a fraction of what the slope predicts (Armijo); so no iterate is outside a wall.
    /// Where the second derivative is not positive definite, a wire under thrust away from the solution,
    /// its negative pivots change sign where there is friction and the direction is then short, or else a
    /// multiple of the metric is added, kept from one iteration to the next. The former slows down only
    /// what is unstable: a wire whose forces balance in the plane of its bend converges in it as fast as
    /// ever, though it would go on out of the plane. After a full step near the solution the forces of its
    /// linear model set the stiffness of contacts (<see cref="ContactMultipliers"/>). A stage is solved when no
    /// piece of the rod, from its start to any node, is unbalanced by more than S, as in
    /// <see cref="StageSolver"/>; where the energy's own rounding hides the decrease the balance decides
    /// alone.</remarks>
    internal sealed class BarrierNewton
    {
        private const double OfSpring = 10.0;            // EA/l: of the support
        private const double LeastShift = 1e-4;          // of EI/L^2
        private const double MostReflected = 1e-2;       // size of a step by pivots of changed sign: radians, or of L
        private const double Far = 1e5;                  // times what may be unbalanced: not reached in one iteration
        private const double FarFromLoose = 10.0;        // the same where many times the tolerance may be left
        private const int MostStiffened = 4;             // iterations of a stage
        private const double MostLinear = 1e-2;          // size of a step whose linear model gives forces of walls
        private const double FreeParts = 5.0;            // L over what is free of a wire that touches walls
        private const int MostCuts = 30;
        private const int MaxReusedSteps = 2;                  // steps with one factorisation

        private readonly MaterialRod _rod;
        private readonly EnergyTerm[] _terms;
        private readonly BarrierEnergy _barrier;
        private readonly NewtonDescent _newton;
        private readonly RodVector[] _forces;
        private readonly double _totalLength;
        private readonly BalanceRounding _rounding;
        private readonly double _bendForce;           // EI/L^2 of the stiffest element, N
        private readonly double _softestForce;       // softest stiffness/L^2, N
        private readonly bool _hasFriction;
        private double _shift;

        /// <summary>For a rod under its terms and those of its motion.</summary>
        public BarrierNewton(RodTerms terms, EnergyTerm[] moving)
        {
            _rod = terms.Rod;
            _terms = terms.With(moving);
            _barrier = terms.Walls()!.Barrier;
            _hasFriction = terms.Walls()!.Friction != null;
            _newton = new NewtonDescent(_rod, terms.Supports, _terms, true, MostCuts);
            _forces = new RodVector[_newton.Gradient.Length];
            _totalLength = _rod.TotalLength;
            _rounding = new BalanceRounding(_rod, terms.Supports, terms.Mass.Total, OfSpring);
            _bendForce = _rod.BendForce;
            _softestForce = terms.SoftestStiffness / (_totalLength * _totalLength);
        }

        /// <summary>Error that a stage's shape may have where forces are small: radians, or displacement over
        /// L.</summary>
        public double Tolerance { get; set; } = 1e-6;

        /// <summary>Fraction of the largest force that a stage may leave unbalanced.</summary>
        public double Balance { get; set; } = 1e-7;

        /// <summary>Newton iterations of a stage.</summary>
        public int MostIterations { get; set; } = 50;

        /// <summary>Newton iterations so far.</summary>
        public long Iterations { get; private set; }

        /// <summary>Factorisations so far.</summary>
        public long Factorisations { get; private set; }

        /// <summary>Largest part of the motion that a step of this direction may take, 0 to 1.</summary>
        public double MaxStepOf(RodShape shape, RodVector[] direction)
        {
            return EnergySum.MaxStep(_terms, shape, direction, 1.0);
        }

        /// <summary>Moves the shape to the stage's.</summary>
        /// <param name="shape">In: its gaps are open. Out: the stage's.</param>
        /// <param name="stageLength">h, s.</param>
        /// <param name="loads">Sum of the loads' magnitudes, N.</param>
        /// <param name="isFar">Whether the shape is certainly not the solution yet.</param>
        /// <param name="tolerances">How many times the tolerance may be left, 1 or more.</param>
        /// <returns>Null, or why it has not converged; the shape is then not to be used.</returns>
        public string? Solve(RodShape shape, double stageLength, double loads, bool isFar, double tolerances)
        {
            double rounding = _rounding.BeginStage(shape, stageLength);
            _barrier.Multipliers.Forget();
            double left = double.PositiveInfinity;
            bool hasValues = false;    // of the terms in this shape
            int kept = MaxReusedSteps;       // steps with the last factorisation
            for (int k = 0; k < MostIterations; k++)
            {
                double before = left;
                if (!isFar)
                {
                    GradientMeasures measures = _newton.System.Gradient(_terms, shape, _newton.Gradient,
                        _newton.Direction);
                    left = Unbalanced();
                    double allowed = rounding + tolerances * Math.Min(
                        Balance * Math.Max(measures.LargestForce, loads), MostUnbalanced);
                    if (left <= allowed && (k > 0 || !_rounding.IsLarge))
                    {
                        return null;
                    }
                    if (KeptStep(shape, left, before, allowed, ref kept))
                    {
                        hasValues = false;
                        continue;
                    }
                }
                EnergySum.Anchor(_terms, shape);
                bool isPlain = FindDirection(shape, k < MostStiffened);
                left = isFar ? Unbalanced() : left;
                bool wasFar = isFar;
                isFar = left > Math.Max(Far, FarFromLoose * tolerances) * (MostUnbalanced + rounding)
                    && left <= double.MaxValue;
                if (!(left <= double.MaxValue))
                {
                    return "a force is not a finite number";
                }
                Iterations++;
                double size = _newton.Size(out double relative);
                double scale = _newton.MaxStep(shape, size, relative, out _);
                if (isPlain && scale == 1.0 && size < MostLinear)
                {
                    _barrier.Multipliers.Estimate(_newton.Direction);
                }
                else
                {
                    _barrier.Multipliers.Forget();
                }
                bool isLower = _newton.Search(shape, !hasValues, ref scale, size, out bool isHidden);
                if (scale < 1.0)
                {
                    _barrier.Multipliers.Forget();
                }
                if (!isLower)
                {
                    if (wasFar)
                    {
                        // It was not, and rounding hides that the energy is at its minimum.
                        isFar = false;
                        hasValues = false;
                        continue;
                    }
                    return "no lower energy along the Newton step, " + Text(left) + " N out of balance";
                }
                shape.CopyFrom(_newton.Trial);
                hasValues = !isHidden;
                kept = isPlain && scale == 1.0 ? 0 : MaxReusedSteps;
                // A full step that no longer lowers the residual force is at the limit of rounding.
                if (isHidden && scale == 1.0 && left >= 0.5 * before && size <= Tolerance)
                {
                    return null;
                }
            }
            return "Newton's method leaves " + Text(left) + " N out of balance after " + MostIterations
                + " iterations";
        }

        /// <summary>Writes or restores what the next stage depends on.</summary>
        public void SerializeShift(Snapshot snapshot)
        {
            snapshot.Serialize(ref _shift);
        }

        /// <summary>The same, and the counts.</summary>
        public void Serialize(Snapshot snapshot)
        {
            SerializeShift(snapshot);
            Iterations = snapshot.Serialize(Iterations);
            Factorisations = snapshot.Serialize(Factorisations);
        }

        // With the last factorisation: where its Newton step has left 'left' of 'before', such a step leaves about
        // 2 left/before of what there was, the second as much of that as the first did. It is taken where two of them
        // come below what is allowed; the force left, found in the next iteration, decides.
        private bool KeptStep(RodShape shape, double left, double before, double allowed, ref int kept)
        {
            double rate = kept == 0 ? 2.0 * left / before : left / before;
            if (kept >= MaxReusedSteps || !(left * Math.Pow(rate, MaxReusedSteps - kept) <= allowed))
            {
                return false;
            }
            _newton.System.Solve(_newton.Direction);
            double size = _newton.Size(out double relative);
            if (_newton.MaxStep(shape, size, relative, out _) < 1.0)
            {
                kept = MaxReusedSteps;
                return false;
            }
            Iterations++;
            kept++;
            _newton.Apply(shape, 1.0);
            shape.CopyFrom(_newton.Trial);
            return true;
        }

        // Scale of small forces, N: by the wire's free length, which is less where it touches walls.
        private double MostUnbalanced =>
            (_barrier.Touches ? FreeParts * FreeParts : 1.0) * Tolerance * _softestForce;

        // Far from balance without the terms of forces that may vanish; nearer only those of walls are left out. Says
        // whether what is factorised is the second derivative itself, without a negative eigenvalue.
        private bool FindDirection(RodShape shape, bool isStiffened)
        {
            Factorisations++;
            bool isPlain = _hasFriction ? _newton.Factorise(shape, 0.0) == 0 : _newton.TryFactorise(shape, 0.0);
            if (!isPlain && _hasFriction)
            {
                _newton.System.ReflectNegativePivots(_newton.Direction);
                _newton.System.Back(_newton.Direction);
                if (_newton.Size(out _) < MostReflected)
                {
                    return false;
                }
            }
            bool isPositive = isPlain;
            if (!isPositive)
            {
                Stiffen(isStiffened, true);
                Factorisations++;
                isPositive = _newton.TryFactorise(shape, 0.0);
                if (!isPositive)
                {
                    _shift = Math.Max(0.25 * _shift, LeastShift * _bendForce);
                    Factorisations += _newton.FactoriseShifted(shape, ref _shift);
                }
                Stiffen(isStiffened, false);
            }
            if (isPositive)
            {
                _newton.System.Back(_newton.Direction);
            }
            return isPlain;
        }

        private void Stiffen(bool isAll, bool isOn)
        {
            if (isAll)
            {
                EnergySum.Stiffen(_terms, isOn);
            }
            else
            {
                _barrier.Stiffen(isOn);
            }
        }

        // The largest force on a piece of the rod from its start to any node, or the sum of the couples over L, N.
        private double Unbalanced()
        {
            Array.Copy(_newton.Gradient, _forces, _forces.Length);
            _newton.System.Project(_forces);
            if (_rounding.IsLarge)
            {
                return _rounding.Unbalanced(_forces);
            }
            double force = RodVectors.LargestPartialForce(_forces, out double couples);
            return Math.Max(force, couples / _totalLength);
        }

        private static string Text(double value)
        {
            return value.ToString("G3", CultureInfo.InvariantCulture);
        }
    }
}
