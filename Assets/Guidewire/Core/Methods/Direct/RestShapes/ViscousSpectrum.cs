using System;

namespace Guidewire.Core
{
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
