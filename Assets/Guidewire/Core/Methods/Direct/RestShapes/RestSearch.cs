using System;

namespace Guidewire.Core
{
    /// <summary>Finds a rest shape: a stable minimum of the sum of energy terms.</summary>
    /// <remarks>Newton's method finds a shape without unbalanced forces. It is at rest where the second derivative has
    /// no negative eigenvalue but those of neutral motions. At a saddle (a straight rod under a thrust along its axis)
    /// the search leaves along the direction of most negative curvature and goes on. A shape that may turn without any
    /// change of energy (a buckled rod about its thrust) has an eigenvalue 0, which rounding makes one of either sign:
    /// <see cref="EquilibriumStability"/> examines each above -1e-4 EI/L^2 of the stiffest element. Every direction is
    /// found with 1e-6 EI/L^2 added, and with no more than 0.01 EI/L^2 of the softest element, which would hold
    /// that.</remarks>
    internal sealed class RestSearch
    {
        private const double Neutral = 1.01e-4;          // of EI/L^2: eigenvalues above its negative may be 0
        private const double Regularisation = 1e-6;      // of EI/L^2, on every direction
        private const double MaxRegularisation = 0.01;  // of the softest element's EI/L^2
        private const int MaxSaddles = 100;

        private const string Saddle = "no descent direction at a saddle of the energy; a small gravity or tipForce "
            + "across the wire provides one";

        private readonly EnergyTerm[] _terms;
        private readonly Newton _newton;
        private readonly EquilibriumStability _stability;

        /// <summary>Makes a search under these terms.</summary>
        /// <param name="rodTerms">Those of the rod.</param>
        /// <param name="terms">Those whose sum is minimised.</param>
        public RestSearch(RodTerms rodTerms, EnergyTerm[] terms)
        {
            MaterialRod rod = rodTerms.Rod;
            _terms = terms;
            double length = rod.TotalLength;
            double neutral = Neutral * rod.BendForce;
            _newton = new Newton(rodTerms, terms)
            {
                JudgesStep = true,
                Regularisation = (Math.Min(Regularisation * rod.BendForce,
                    MaxRegularisation * rod.SoftestStiffness / (length * length)), neutral),
            };
            _stability = new EquilibriumStability(rod, rodTerms.Supports, terms, _newton.System, neutral);
        }

        /// <summary>Moves <paramref name="shape"/> to a rest shape near it.</summary>
        /// <param name="tolerance">Error that it may have: radians, or displacement over L.</param>
        /// <param name="maxIterations">Newton iterations, after which the search gives up.</param>
        public EquilibriumResult Solve(RodShape shape, double tolerance, int maxIterations)
        {
            EquilibriumResult result = default;
            _newton.Tolerance = tolerance;
            string? failure = null;
            for (int k = 0; failure == null && !result.Converged; k++)
            {
                _newton.MaxIterations = maxIterations - (int)_newton.Iterations;
                failure = k == MaxSaddles ? Saddle
                    : _newton.Minimise(shape, double.PositiveInfinity, 0.0, isSearched: true);
                result.Converged = failure == null && IsAtRest(shape, ref failure);
            }
            if (result.Converged)
            {
                _stability.LowestMode(shape, out result.SmallestEigenvalue);
            }
            result.Reason = failure ?? string.Empty;
            result.Iterations = (int)_newton.Iterations;
            result.Factorisations = (int)_newton.Factorisations;
            return result;
        }

        // Where it is not, the shape is moved to where the energy is lower; at a saddle without such a direction the
        // search has failed.
        private bool IsAtRest(RodShape shape, ref string? failure)
        {
            EnergySum.Anchor(_terms, shape);
            if (_stability.IsStable(shape))
            {
                return true;
            }
            // A negative eigenvalue within rounding of 0 along which the energy falls neither way is 0: such as that of
            // a localised helix that moves along the rod.
            RodVector[]? undecided = _stability.Undecided;
            if (undecided != null)
            {
                Array.Copy(undecided, _newton.Direction, undecided.Length);
                return !DescendAlong(shape, 1.0) && !DescendAlong(shape, -1.0);
            }
            Array.Copy(_stability.LowestMode(shape, out _), _newton.Direction, _newton.System.VectorCount);
            double sign = _newton.Slope > 0.0 ? -1.0 : 1.0;
            failure = DescendAlong(shape, sign) ? null : Saddle;
            return false;
        }

        // Goes along the direction, or against it, to where the energy is lower; false where it falls nowhere.
        private bool DescendAlong(RodShape shape, double sign)
        {
            double size = _newton.Size(out _);
            double start = EnergySum.Value(_terms, shape, out double magnitude);
            double largest = 0.3 * EnergySum.MaxStep(_terms, shape, _newton.Direction, sign * 0.3 / size);
            for (double turn = largest; turn > 1e-6; turn *= 0.5)
            {
                _newton.Apply(shape, sign * turn / size, _newton.Trial);
                if (EnergySum.Value(_terms, _newton.Trial, out _) < start - 1e-14 * magnitude)
                {
                    shape.CopyFrom(_newton.Trial);
                    return true;
                }
            }
            return false;
        }
    }
}
