using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Moves a shape to a minimum of a sum of energies, by Newton's method in O(n): an implicit stage, whose
    /// terms include inertia and walls, or a rest shape.</summary>
    /// <remarks>A stage is solved when no piece of the rod, from its start to any node, is unbalanced by more than a
    /// force S, nor the couples on its elements by S L in all. S is the prescribed fraction of the largest force in
    /// the rod, and at most tolerance EI/L^2: a force S at the tip of a cantilever moves it by S L^3/(3 EI) and turns
    /// it by S L^2/(2 EI). The balance then bounds the error of the shape too. A bound on the last step alone does not
    /// do: stretching costs EA, and a step of 1e-6 L along the rod is 1e-6 EA of force, more than the weight of the
    /// wire. What rounding of the positions leaves in the balance is added to S (<see cref="BalanceRounding"/>).
    /// Where the force left is more than half of the least before, a full step below the tolerance ends the stage: it
    /// has come to what rounding leaves.
    ///
    /// A factorisation is used again where its steps are expected to come below S. The first is expected to leave
    /// twice the fraction of the force that the Newton step left, each further one the fraction of the one before.
    ///
    /// A search shortens each step until the energy falls by a fraction of what the slope promises (Armijo). Between
    /// walls nodes move on straight lines and no farther than every gap allows, so no iterate is outside a wall. Where
    /// the second derivative is not positive definite, a wire under thrust away from the solution, its negative pivots
    /// change sign where there is friction and the direction is then short, or else a multiple of the metric is added.
    /// The former slows down only what is unstable: a wire whose forces balance in the plane of its bend converges in
    /// it as fast as ever, though it would go on out of the plane. After a full step near the solution the forces of
    /// its linear model set the stiffness of contacts (<see cref="ContactMultipliers"/>).
    ///
    /// Full steps without a search are cheaper, and suffice for a stage that is near its prediction. They end with a
    /// reason where the second derivative is not positive definite or a full step does not halve the force left.
    /// </remarks>
    internal sealed class Newton
    {
        private const double OfSpring = 10.0;            // EA/l: of the support between walls
        private const double FirstShift = 0.25;          // of EI/L^2, of a rest shape
        private const double MinShift = 1e-4;          // of EI/L^2
        private const double MaxReflected = 1e-2;       // size of a step by pivots of changed sign: radians, or of L
        private const double MaxLinear = 1e-2;          // size of a step whose linear model gives forces of walls
        private const double FreeParts = 5.0;            // L over what is free of a wire that touches walls
        private const double LargestTurn = 1.0;          // rad an iteration, of one element where forces act
        private const double LargestRelativeTurn = 0.7;  // rad an iteration, between neighbours
        private const double SufficientDecrease = 1e-4;
        private const double Rounding = 1e-13;           // of the energies' magnitudes
        private const double MinSize = 8.0 / (1L << 52);   // of a step that rounding of the shape does not hide
        private const double Epsilon = 1.0 / (1L << 52);    // of a coordinate: its last bit
        private const double MostRounding = 1e-10;       // of an element: what rounding of its ends may strain
        private const double Contraction = 0.5;          // of the force left, by a full step
        private const int MaxWithoutGeometricStiffness = 4;    // iterations of a stage
        private const int MaxCuts = 40;
        private const int MaxReusedWithWalls = 2;       // steps with one factorisation
        private const int MaxReusedWithout = 6;

        private const string NotContracting = "full steps of Newton's method do not converge";
        private const string NotFinite = "the Newton step is not a finite number; loads are too large for the stiffness"
            + " (youngsModulus, wireRadius)";

        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly EnergyTerm[] _terms;
        private readonly WallTerms? _walls;
        private readonly ContactMultipliers? _multipliers;
        private readonly bool _hasFriction;
        private readonly int _maxReused;
        private readonly RodTerms _rodTerms;
        private double _totalLength;
        private double _bendForce;                // EI/L^2 of the stiffest element, N
        private double _softestForce;             // softest stiffness/L^2, N
        private readonly double[] _values;        // of the terms in the shape evaluated last, J
        private double _shift;                    // N, kept from one iteration to the next

        /// <summary>Makes one for a rod under these terms.</summary>
        /// <param name="rodTerms">Those of the rod, its walls among them.</param>
        /// <param name="terms">Those whose sum is minimised.</param>
        public Newton(RodTerms rodTerms, EnergyTerm[] terms)
        {
            _rodTerms = rodTerms;
            _rod = rodTerms.Rod;
            _supports = rodTerms.Supports;
            _terms = terms;
            _walls = rodTerms.Walls();
            _multipliers = _walls?.Barrier.Multipliers;
            _hasFriction = _walls?.HasFriction == true;
            _maxReused = _walls != null ? MaxReusedWithWalls : MaxReusedWithout;
            _values = new double[terms.Length];
            BalanceRounding = new BalanceRounding(_rod, _supports, rodTerms.Mass,
                _walls != null ? OfSpring : 1.0);
            System = new BlockTridiagonal(_rod, _supports, rodTerms.VesselCount);
            Gradient = new RodVector[System.VectorCapacity];
            Direction = new RodVector[System.VectorCapacity];
            Trial = new RodShape(_rod.ElementCount, _supports.InnerCount, _rod.Capacity);
            SetScales();
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            BalanceRounding.Remesh();
            System.Remesh();
            Trial.ElementCount = _rod.ElementCount;
            _shift = _walls == null ? 0.0 : _shift;
            SetScales();
        }

        private void SetScales()
        {
            _totalLength = _rod.TotalLength;
            _bendForce = _rod.BendForce;
            _softestForce = _rodTerms.SoftestStiffness / (_totalLength * _totalLength);
        }

        /// <summary>Error that a stage's shape may have where forces are small, or the last step to a rest shape:
        /// radians, or displacement over L.</summary>
        public double Tolerance { get; set; } = 1e-6;

        /// <summary>Fraction of the largest force that a stage may leave unbalanced.</summary>
        public double Balance { get; set; } = 1e-7;

        /// <summary>Newton iterations of a stage.</summary>
        public int MaxIterations { get; set; } = 50;

        /// <summary>Multiple of the metric in every direction, N: where a shape may move without any change of energy
        /// rounding alone would make large steps. Up to the most of it the second derivative counts as positive
        /// definite.</summary>
        public (double Min, double Max) Regularisation { get; set; }

        /// <summary>Whether a full step below the tolerance ends the search, instead of the balance: near the load at
        /// which it buckles a shape may be far from rest though its forces nearly balance.</summary>
        public bool JudgesStep { get; set; }

        /// <summary>Newton iterations so far, those with a kept factorisation among them.</summary>
        public long Iterations { get; private set; }

        /// <summary>Counts the factorisations so far.</summary>
        public long Factorisations { get; private set; }

        /// <summary>Solutions with a kept factorisation so far.</summary>
        public long KeptSolutions { get; private set; }

        /// <summary>Stages without walls that needed a search so far.</summary>
        public long Searches { get; private set; }

        /// <summary>What rounding of positions leaves in the balance.</summary>
        public BalanceRounding BalanceRounding { get; }

        /// <summary>The second derivative, as it was factorised last.</summary>
        public BlockTridiagonal System { get; }

        /// <summary>The gradient in the shape evaluated last.</summary>
        public RodVector[] Gradient { get; }

        /// <summary>Newton's direction.</summary>
        public RodVector[] Direction { get; }

        /// <summary>The shape tried last.</summary>
        public RodShape Trial { get; }

        /// <summary>Moves the shape to the stage's.</summary>
        /// <param name="shape">In: the supports are in place and gaps are open. Out: the stage's.</param>
        /// <param name="stageLength">h, s; infinite at rest.</param>
        /// <param name="loads">Sum of the loads' magnitudes, N.</param>
        /// <param name="isSearched">Whether each step lowers the energy; else steps are full.</param>
        /// <param name="tolerances">How many times the tolerance may be left, 1 or more.</param>
        /// <returns>Null, or why it has not converged; the shape is then not to be used.</returns>
        public string? Minimise(RodShape shape, double stageLength, double loads, bool isSearched,
            double tolerances = 1.0)
        {
            double rounding = BalanceRounding.BeginStage(shape, stageLength);
            _shift = JudgesStep ? FirstShift * _bendForce : _shift;
            Searches += isSearched && _walls == null ? 1 : 0;
            _multipliers?.Forget();
            double left = double.PositiveInfinity;
            double least = double.PositiveInfinity;
            double last = double.PositiveInfinity;    // size of the last Newton step
            bool hasValues = false;                   // of the terms in this shape
            int reused = _maxReused;                 // steps with the last factorisation
            for (int k = 0; k < MaxIterations; k++)
            {
                bool isLower = true;
                if (!JudgesStep && (k > 0 || isSearched))
                {
                    double before = left;
                    double allowed = rounding + tolerances * Measure(shape, loads, out left);
                    isLower = left <= Contraction * least;
                    least = Math.Min(least, left);
                    if (left <= allowed && (k > 0 || !BalanceRounding.IsLarge))
                    {
                        return null;
                    }
                    if (!isSearched && reused == 0 && !isLower && last > Tolerance)
                    {
                        return NotContracting;
                    }
                    if (TryReuse(shape, left, before, allowed, ref reused))
                    {
                        hasValues = false;
                        continue;
                    }
                }
                if (isSearched)
                {
                    EnergySum.Anchor(_terms, shape);
                }
                Factorisations++;
                _walls?.Barrier.DropTurning(!(last < MaxLinear));
                bool isPlain = System.Factorise(_terms, shape, Gradient, Direction, Regularisation.Min,
                    onlyPositive: !_hasFriction) == 0 || TryRegularised(shape) || TryWithoutTurning(shape);
                if (isPlain)
                {
                    System.Back(Direction);
                }
                else
                {
                    FindOtherDirection(shape, k < MaxWithoutGeometricStiffness);
                }
                double size = Size(out double relative);
                if (!(size <= double.MaxValue))
                {
                    return NotFinite;
                }
                Iterations++;
                double scale = MaxStep(shape, size, relative);
                if (JudgesStep && scale == 1.0 && IsSmall(size, isPlain))
                {
                    Apply(shape, 1.0, shape);
                    return null;
                }
                bool decreaseBelowRounding = true;
                if (!isSearched)
                {
                    if (!isPlain)
                    {
                        return NotContracting;
                    }
                    Apply(shape, scale, shape);
                }
                else
                {
                    // Where steps do not lower the force left, estimates may hold them back.
                    if (isLower && isPlain && scale == 1.0 && size < MaxLinear)
                    {
                        _walls?.Barrier.Estimate(shape, Direction);
                    }
                    else
                    {
                        _multipliers?.Forget();
                    }
                    if (!Search(shape, !hasValues, ref scale, size, out decreaseBelowRounding))
                    {
                        return "no lower energy along the Newton step, " + Text(left) + " N out of balance";
                    }
                    if (scale < 1.0)
                    {
                        _multipliers?.Forget();
                    }
                    shape.CopyFrom(Trial);
                }
                if (decreaseBelowRounding && scale == 1.0 && !isLower && size <= Tolerance)
                {
                    return null;
                }
                hasValues = !decreaseBelowRounding;
                last = size;
                reused = isPlain && scale == 1.0 ? 0 : _maxReused;
            }
            string end = " after " + MaxIterations + " iterations (maxNewtonIterations)" + TooFar(shape);
            return left <= double.MaxValue ? "Newton's method leaves " + Text(left) + " N out of balance" + end
                : "Newton's method has not come to rest" + end;    // where steps are judged, no force is measured
        }

        /// <summary>Sets another shape, or the same, to a shape moved along the direction.</summary>
        public void Apply(RodShape shape, double scale, RodShape to)
        {
            if (_walls != null)
            {
                RodStep.ApplyStraight(shape, Direction, scale, to);
            }
            else
            {
                RodStep.Apply(_rod, _supports, shape, Direction, scale, to);
            }
        }

        /// <summary>Gives the size of the direction: radians, or displacement over L.</summary>
        /// <param name="relative">The largest turn of one element against the next, radians.</param>
        public double Size(out double relative) =>
            RodStep.Size(Direction, _rod.ElementCount, _totalLength, out relative, System.VectorCount);

        /// <summary>Writes or restores what the next stage depends on.</summary>
        public void Serialize(Snapshot snapshot) => snapshot.Serialize(ref _shift);

        /// <summary>Writes or restores the counts that a run reports, and between walls what serves a rod of other
        /// elements too.</summary>
        public void SerializeCounts(Snapshot snapshot)
        {
            Factorisations = snapshot.Serialize(Factorisations);
            KeptSolutions = snapshot.Serialize(KeptSolutions);
            Searches = snapshot.Serialize(Searches);
            if (_walls != null)
            {
                Serialize(snapshot);
                Iterations = snapshot.Serialize(Iterations);
            }
        }

        // The largest force on a piece of the rod from its start to any node, or the sum of the couples over L, N.
        // Returns S; the direction is minus the gradient.
        private double Measure(RodShape shape, double loads, out double left)
        {
            double largest = System.Gradient(_terms, shape, Gradient, Direction).LargestForce;
            if (BalanceRounding.IsLarge)
            {
                left = BalanceRounding.Unbalanced(Direction, System.VectorCount);
            }
            else
            {
                double force = RodVectors.LargestPartialForce(Direction, System.VectorCount, out double couples);
                left = Math.Max(force, couples / _totalLength);
            }
            // A wire that touches walls has a shorter free length.
            double parts = _walls != null && _walls.Touches ? FreeParts : 1.0;
            return Math.Min(Balance * Math.Max(largest, loads), parts * parts * Tolerance * _softestForce);
        }

        // Along a direction that costs no energy rounding alone makes steps: there the energy that they gain is asked.
        private bool IsSmall(double size, bool isPlain)
        {
            double gain = Math.Max(0.0, -Slope) / (_softestForce * _totalLength);
            return size <= Tolerance || (isPlain && gain <= Tolerance * Tolerance);
        }

        // A step with the last factorisation, where those that may follow are expected to come below what is allowed.
        private bool TryReuse(RodShape shape, double left, double before, double allowed, ref int reused)
        {
            double rate = reused == 0 ? 2.0 * left / before : left / before;
            if (reused >= _maxReused || !(left * Math.Pow(rate, _maxReused - reused) <= allowed))
            {
                return false;
            }
            System.Solve(Direction);
            double size = Size(out double relative);
            if (MaxStep(shape, size, relative) < 1.0)
            {
                reused = _maxReused;
                return false;
            }
            Iterations++;
            KeptSolutions++;
            reused++;
            Apply(shape, 1.0, shape);
            return true;
        }

        // Whether the second derivative with what it may have of the metric has no negative eigenvalue.
        private bool TryRegularised(RodShape shape)
        {
            bool isPositive = false;
            for (double more = 10.0 * Regularisation.Min; !isPositive && more < Regularisation.Max; more *= 10.0)
            {
                isPositive = TryFactorise(shape, more);
            }
            return isPositive;
        }

        // What turning sections of a vessel add need not be positive.
        private bool TryWithoutTurning(RodShape shape)
        {
            if (_walls?.Barrier.HasTurning != true)
            {
                return false;
            }
            _walls.Barrier.DropTurning(true);
            Factorisations++;
            return System.Factorise(_terms, shape, Gradient, Direction, Regularisation.Min,
                onlyPositive: !_hasFriction) == 0;
        }

        // Where the second derivative has negative eigenvalues: by those with their signs changed, or with others. At
        // first these leave the terms of forces that may vanish out; then only those of walls.
        private void FindOtherDirection(RodShape shape, bool dropsGeometricStiffness)
        {
            if ((_hasFriction || _walls?.Self?.Touches == true) && System.ReflectNegativePivots(Direction))
            {
                System.Back(Direction);
                if (Size(out _) < MaxReflected)
                {
                    return;
                }
            }
            DropGeometricStiffness(dropsGeometricStiffness, true);
            if (_walls == null || !TryFactorise(shape, 0.0))
            {
                _shift = Math.Max(0.25 * _shift, MinShift * _bendForce);
                while (!TryFactorise(shape, _shift) && _shift <= double.MaxValue)
                {
                    _shift *= 4.0;
                }
            }
            DropGeometricStiffness(dropsGeometricStiffness, false);
            System.Back(Direction);
        }

        // With a multiple of the metric added, N. Says whether all eigenvalues are positive, and ends at the first that
        // is not.
        private bool TryFactorise(RodShape shape, double shift)
        {
            Factorisations++;
            return System.Factorise(_terms, shape, Gradient, Direction, shift, onlyPositive: true) == 0;
        }

        private void DropGeometricStiffness(bool isAll, bool isOn)
        {
            if (isAll && _walls != null)
            {
                EnergySum.DropGeometricStiffness(_terms, isOn);
            }
            _walls?.DropGeometricStiffness(isOn);
        }

        // The largest step along the direction, at most 1; the turn of an instrument against the one whose tip it
        // leaves is found here.
        private double MaxStep(RodShape shape, double size, double relative)
        {
            double most = Math.Max(relative, CoaxialShape.TurnAtTips(_supports.Coaxial, shape, Direction));
            double scale = Math.Min(1.0, Math.Min(LargestTurn / size, LargestRelativeTurn / most));
            return scale * EnergySum.MaxStep(_terms, shape, Direction, scale);
        }

        // Halves the step until the energy falls enough; the accepted shape is left in the trial. Where the energy's
        // own rounding hides the decrease the step is Newton's, and small, and is taken without its energies.
        private bool Search(RodShape shape, bool isNew, ref double scale, double size, out bool decreaseBelowRounding)
        {
            double slope = Slope;
            double start = isNew ? EnergySum.Value(_terms, shape, _values, out double magnitude)
                : EnergySum.AnchoredValue(_terms, _values, out magnitude);
            double rounding = Rounding * magnitude;
            decreaseBelowRounding = (-slope < 1e3 * rounding && size < 1e-2) || size < MinSize;
            for (int cut = 0; cut < MaxCuts; cut++)
            {
                Apply(shape, scale, Trial);
                if (decreaseBelowRounding || EnergySum.Value(_terms, Trial, _values, out _)
                    <= start + SufficientDecrease * scale * slope + rounding)
                {
                    return true;
                }
                scale *= 0.5;
            }
            return false;
        }

        /// <summary>Of the energy along the direction, J.</summary>
        public double Slope => RodVectors.Dot(Gradient, Direction, System.VectorCount);

        // Whether coordinates are so large that their rounding strains elements.
        private static string TooFar(RodShape shape)
        {
            double farthest = 0.0;
            double shortest = double.PositiveInfinity;
            for (int j = 0; j < shape.ElementCount; j++)
            {
                farthest = Math.Max(farthest, shape.X[j + 1].Length);
                shortest = Math.Min(shortest, (shape.X[j + 1] - shape.X[j]).Length);
            }
            double rounding = Epsilon * farthest;
            return rounding < MostRounding * shortest ? "" : ": coordinates of " + Text(farthest)
                + " m are rounded to " + Text(rounding) + " m, too coarse for elements of " + Text(shortest)
                + " m; move the scene nearer to the origin";
        }

        private static string Text(double value) => value.ToString("G3", CultureInfo.InvariantCulture);
    }

    /// <summary>How many Newton iterations the steps of a run may take beyond those that solve them as asked: many at
    /// once, and a few a step in the long run.</summary>
    /// <remarks>Counted is what a step takes after its first halving or its first trial of another displacement of a
    /// hub; the others are not, however many intervals they have. A snap takes a thousand iterations once. A wire that
    /// coils up and jams under a steady push takes hundreds in every step: what is left then falls to nothing, and the
    /// run ends. Where half is left hubs look no further for the displacement that their limit allows, so that the
    /// step can still be solved with the best that was found. Iterations are counted, no times: a run ends at the same
    /// step on every machine.</remarks>
    internal sealed class WorkLimit
    {
        private const int AtOnce = 200;   // times the iterations that one solution may take
        private const int AStep = 4;      // the same

        private readonly int _maxIterations;
        private readonly int _times;
        private long _left;               // iterations
        private bool _isCounted;

        /// <summary>Begins with all of it.</summary>
        /// <param name="maxIterations">That one solution may take.</param>
        /// <param name="limitedHubs">Hubs with a limit. Each one after the first takes four times the work, because for
        /// each of its displacements those of the hubs inside it are found anew.</param>
        public WorkLimit(int maxIterations, int limitedHubs = 0)
        {
            _maxIterations = maxIterations;
            _times = 1 << 2 * Math.Max(0, limitedHubs - 1);
            _left = Max;
        }

        /// <summary>Whether nothing is left.</summary>
        public bool IsOver => _left < 0;

        /// <summary>Whether less than half of the most is left.</summary>
        public bool IsScarce => _left < Max / 2;

        /// <summary>Says in one phrase that all iterations are spent.</summary>
        public string Text => string.Format(CultureInfo.InvariantCulture,
            "steps that were halved took more Newton iterations than a run may ({0} times maxNewtonIterations at once, "
            + "{1} times a step), as where a wire coils up or jams", AtOnce * _times, AStep * _times);

        /// <summary>Begins a step.</summary>
        public void BeginStep()
        {
            _isCounted = false;
            _left = Math.Min(_left + (long)AStep * _times * _maxIterations, Max);
        }

        /// <summary>What the step takes from now on is counted.</summary>
        public void Count() => _isCounted = true;

        /// <summary>Takes iterations that were made.</summary>
        public void Spend(long iterations) => _left -= _isCounted ? iterations : 0;

        /// <summary>Writes or restores what is left.</summary>
        public void Serialize(Snapshot snapshot) => snapshot.Serialize(ref _left);

        private long Max => (long)AtOnce * _times * _maxIterations;
    }
}
