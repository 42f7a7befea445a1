using System;

namespace Guidewire.Core
{
    /// <summary>Finds the equilibrium of a rod under a follower couple or force by viscous relaxation, M u' =
    /// -(unbalanced forces).</summary>
    /// <remarks>Under dead forces the creeping rod would go downhill in its energy and end in a minimum. A couple in
    /// space and a force that turns have no potential, but the motion makes sense all the same, and a shape is a rest
    /// shape where it ends and to which it comes back when disturbed. Each step is one of implicit Euler, linearised,
    /// over the time 1/d: the step of (K + d M), cut to a stated turn. Large d creeps, d = 0 is Newton's method; d
    /// follows how far the steps go.
    /// A rod that never rests, but turns round and round, ends with that reason; and so does one that Newton's steps
    /// brought to an equilibrium which a disturbance would leave (<see cref="ViscousSpectrum"/>).</remarks>
    internal sealed class ViscousRelaxation
    {
        private const double FirstDrag = 10.0;  // of EI/L^2
        private const double LargestTurn = 0.5; // rad a step, of an element and between neighbours
        private const double LongStep = 0.3;    // rad; beyond it the drag grows
        private const double ShortStep = 0.1;   // below it, it falls
        private const double NearRest = 0.01;   // below it, it falls fast

        private const string Flutter = "; a follower load drives a slender wire for ever, a couple above about "
            + "3.6 EI/L, a thrust above about 20 EI/L^2";

        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly EnergyTerm[] _terms;
        private readonly FollowerTangent _tangent;
        private readonly string _keys;
        private readonly RodVector[] _step;
        private readonly RodShape _trial;

        /// <summary>A solver for this rod; <paramref name="followers"/> are among the terms.</summary>
        public ViscousRelaxation(MaterialRod rod, RodSupports supports, EnergyTerm[] terms, TipFollowers followers)
        {
            _rod = rod;
            _supports = supports;
            _terms = terms;
            _tangent = new FollowerTangent(rod, supports, terms, followers);
            _keys = followers.Keys;
            _step = new RodVector[_tangent.System.VectorCapacity];
            _trial = new RodShape(rod.ElementCount, supports.InnerCount, rod.Capacity);
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh() => _tangent.Remesh();

        /// <summary>Moves <paramref name="shape"/> to the rest shape that it creeps to, and checks whether it is
        /// stable.</summary>
        /// <param name="tolerance">On the last Newton step, radians or displacement over L.</param>
        /// <param name="maxIterations">Steps, after which the search gives up.</param>
        public EquilibriumResult Solve(RodShape shape, double tolerance, int maxIterations)
        {
            EquilibriumResult result = Settle(shape, tolerance, maxIterations);
            if (!result.Converged)
            {
                result.Reason += Flutter;
                return result;
            }
            result.SmallestEigenvalue = new ViscousSpectrum(_tangent, _rod).SmallestRealPart(shape);
            result.Converged = result.SmallestEigenvalue > 0.0;
            result.Reason = result.Converged ? string.Empty
                : "the equilibrium under " + _keys + " is not stable: a disturbance grows even in a wire with drag"
                + Flutter;
            return result;
        }

        /// <summary>Moves <paramref name="shape"/> to where it comes to rest, stable or not.</summary>
        /// <param name="tolerance">On the last Newton step, radians or displacement over L.</param>
        /// <param name="maxIterations">Steps, after which the search gives up.</param>
        public EquilibriumResult Settle(RodShape shape, double tolerance, int maxIterations)
        {
            EquilibriumResult result = default;
            result.Reason = string.Empty;
            double drag = FirstDrag * _rod.BendForce;
            while (result.Iterations < maxIterations)
            {
                result.Iterations++;
                FindStep(shape, ref drag, ref result);
                double size = RodStep.Size(_step, _rod.ElementCount, _rod.TotalLength, out double relative,
                    _tangent.System.VectorCount);
                if (!(size < double.MaxValue))
                {
                    result.Reason = "the step is not a finite number under " + _keys;
                    return result;
                }
                double scale = Math.Min(1.0, LargestTurn / Math.Max(size, relative));
                double fraction = EnergySum.MaxStep(_terms, shape, _step, scale);
                scale *= fraction;
                RodStep.Apply(_rod, _supports, shape, _step, scale, _trial);
                shape.CopyFrom(_trial);
                if (size <= tolerance && fraction == 1.0)
                {
                    result.Converged = true;
                    return result;
                }
                drag *= size > LongStep ? 1.5 : size > ShortStep ? 1.0 : size > NearRest ? 0.7 : 0.2;
            }
            result.Reason = "a wire with drag does not come to rest under " + _keys + " in "
                + maxIterations.ToString(System.Globalization.CultureInfo.InvariantCulture) + " steps";
            return result;
        }

        /// <summary>A step against the drag, which is raised until it dampens every direction.</summary>
        private void FindStep(RodShape shape, ref double drag, ref EquilibriumResult result)
        {
            result.Factorisations++;
            while (_tangent.Factorise(shape, _step, drag) > 0 && drag < double.MaxValue)
            {
                drag = Math.Max(2.0 * drag, 0.1 * _rod.BendForce);
                result.Factorisations++;
            }
        }
    }

    /// <summary>Decay rate of the slowest disturbance of a rod with drag: the smallest real part among the eigenvalues
    /// lambda of K v = lambda M v, where K, under a couple that turns with the tip, is not symmetric.</summary>
    /// <remarks>With a shift s that makes K + s M positive definite all eigenvalues lie right of -s, and the largest of
    /// theta = 1/(lambda + s), those of (K + s M)^-1 M, belong to the ones nearest to it. Arnoldi's method finds them
    /// in a space of a few vectors, in which H = V^T M (K + s M)^-1 M V has them as its own, and H^-1 - s those of K.
    /// A line is brought to the first of them by bisection.</remarks>
    internal sealed class ViscousSpectrum
    {
        private const int MaxVectors = 24;
        private const int Halvings = 20;
        private const double Negligible = 1e-12;

        private readonly FollowerTangent _tangent;
        private readonly double _bendForce;  // EI/L^2, N
        private readonly double _totalLength;
        private readonly RodVector[][] _basis = new RodVector[MaxVectors + 1][];

        /// <summary>Makes the spectrum of this rod's tangent.</summary>
        public ViscousSpectrum(FollowerTangent tangent, MaterialRod rod)
        {
            _tangent = tangent;
            _bendForce = rod.BendForce;
            _totalLength = rod.TotalLength;
            for (int k = 0; k <= MaxVectors; k++)
            {
                _basis[k] = new RodVector[tangent.System.VectorCount];
            }
        }

        /// <summary>Is true if every disturbance of a shape in equilibrium dies out.</summary>
        public bool IsStable(RodShape shape)
        {
            double[,] spectrum = Find(shape, out double shift);
            return IsFinite(spectrum) && SquareMatrix.EigenvaluesLeftOf(spectrum, shift) == 0;
        }

        /// <summary>The smallest real part at a shape in equilibrium, N; not a number where it cannot be found. Only
        /// above 0 is the shape stable.</summary>
        public double SmallestRealPart(RodShape shape)
        {
            double[,] spectrum = Find(shape, out double shift);
            if (!IsFinite(spectrum))
            {
                return double.NaN;
            }
            double low = 0.0;  // of lambda + s
            double high = shift;
            while (SquareMatrix.EigenvaluesLeftOf(spectrum, high) == 0)
            {
                low = high;
                high *= 2.0;
            }
            for (int k = 0; k < Halvings; k++)
            {
                double middle = 0.5 * (low + high);
                bool any = SquareMatrix.EigenvaluesLeftOf(spectrum, middle) > 0;
                low = any ? low : middle;
                high = any ? middle : high;
            }
            return 0.5 * (low + high) - shift;
        }

        /// <summary>Gives a small matrix with the eigenvalues lambda + s.</summary>
        private double[,] Find(RodShape shape, out double shift)
        {
            shift = _bendForce;
            while (_tangent.Factorise(shape, _basis[0], shift) > 0)
            {
                shift *= 2.0;
            }
            return SquareMatrix.Inverse(Project(), out _);
        }

        private static bool IsFinite(double[,] matrix)
        {
            double sum = 0.0;
            foreach (double entry in matrix)
            {
                sum += Math.Abs(entry);
            }
            return sum < double.PositiveInfinity;
        }

        /// <summary>Makes H by Arnoldi's method.</summary>
        private double[,] Project()
        {
            BlockTridiagonal system = _tangent.System;
            RodVectors.SetWithoutSymmetry(_basis[0], _totalLength);
            system.Project(_basis[0]);
            RodVectors.Scale(_basis[0], 1.0 / Math.Sqrt(system.MetricDot(_basis[0], _basis[0])));
            var h = new double[MaxVectors, MaxVectors];
            int count = 0;
            bool closed = false;  // the space holds all that its vectors lead to
            while (!closed && count < MaxVectors)
            {
                RodVector[] next = _basis[count + 1];
                Array.Copy(_basis[count], next, next.Length);
                system.ApplyMetric(next);
                _tangent.Solve(next);
                double before = Math.Sqrt(system.MetricDot(next, next));
                // Twice, because once leaves the rounding of what was taken off.
                for (int pass = 0; pass < 2; pass++)
                {
                    for (int i = 0; i <= count; i++)
                    {
                        double part = system.MetricDot(_basis[i], next);
                        h[i, count] += part;
                        RodVectors.AddScaled(next, -part, _basis[i]);
                    }
                }
                double rest = Math.Sqrt(system.MetricDot(next, next));
                closed = rest <= Negligible * before;
                count++;
                if (!closed && count < MaxVectors)
                {
                    h[count, count - 1] = rest;
                    RodVectors.Scale(next, 1.0 / rest);
                }
            }
            var corner = new double[count, count];
            for (int i = 0; i < count; i++)
            {
                Array.Copy(h, i * MaxVectors, corner, i * count, count);
            }
            return corner;
        }
    }
}
