using System;

namespace Guidewire.Core
{
    /// <summary>Finds a rest shape: a minimum of the sum of energy terms, by Newton's method.</summary>
    /// <remarks>Each iteration factorises the true second derivative. Where it is not positive definite a multiple of
    /// the metric is added until it is, so that the direction descends; the step is cut until the energy falls by a
    /// part of what the slope promises. At a saddle (a straight rod under a thrust along its axis) the search leaves
    /// along the direction of most negative curvature. Converged means: the second derivative as it is has no negative
    /// eigenvalue but those of neutral motions, and the full step is below the tolerance. Whatever else happens ends
    /// with a reason. A shape that may turn without any change of energy (a buckled rod about its thrust) has an
    /// eigenvalue 0, which rounding makes one of either sign: during the iteration eigenvalues above -1e-4 EI/L^2 of
    /// the stiffest element are left in Newton's matrix, and at its end <see cref="EquilibriumStability"/> examines
    /// each that is negative; where one is not neutral the search leaves the saddle. Every direction is found with 1e-6
    /// EI/L^2 added, and with no more than 0.01 EI/L^2 of the softest element, which would hold that.</remarks>
    internal sealed class EquilibriumSolver
    {
        private const double SaddleStep = 1e-7;          // a shifted step this small means: no force left
        private const int MostCuts = 40;
        private const double Neutral = 1.01e-4;          // of EI/L^2
        private const double Regularisation = 1e-6;      // of EI/L^2, on every direction
        private const double MostRegularisation = 0.01;  // of the softest element's EI/L^2
        private const int MostHalvings = 40;
        private const int PowerIterations = 40;

        private const string Saddle = "no descent direction at a saddle of the energy; a small gravity or tipForce "
            + "across the wire provides one";

        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly EnergyTerm[] _terms;
        private readonly NewtonDescent _newton;
        private readonly BlockTridiagonal _system;
        private readonly RodVector[] _gradient;
        private readonly RodVector[] _direction;
        private readonly RodVector[] _work;
        private readonly double _totalLength;
        private readonly double _bendForce;  // EI/L^2 of the stiffest element, N
        private readonly double _softestForce;       // softest stiffness/L^2, N
        private readonly double _neutral;    // eigenvalues above its negative may be 0, N
        private EquilibriumStability? _stability;

        /// <summary>A solver for this rod, held so, under these terms.</summary>
        public EquilibriumSolver(MaterialRod rod, RodSupports supports, EnergyTerm[] terms)
        {
            _rod = rod;
            _supports = supports;
            _terms = terms;
            _newton = new NewtonDescent(rod, supports, terms, false, MostCuts);
            _system = _newton.System;
            _gradient = _newton.Gradient;
            _direction = _newton.Direction;
            _work = new RodVector[_system.VectorCount];
            _totalLength = rod.TotalLength;
            _bendForce = rod.BendForce;
            _softestForce = rod.SoftestStiffness / (_totalLength * _totalLength);
            _neutral = Neutral * _bendForce;
        }

        /// <summary>Moves <paramref name="shape"/> to a rest shape near it.</summary>
        /// <param name="tolerance">On the last Newton step, radians or displacement over L.</param>
        /// <param name="mostIterations">After which the search gives up.</param>
        /// <param name="findsEigenvalue">Whether the result states the smallest eigenvalue, which costs some
        /// solutions.</param>
        public EquilibriumResult Solve(RodShape shape, double tolerance, int mostIterations,
            bool findsEigenvalue = true)
        {
            EquilibriumResult result = default;
            result.Reason = string.Empty;
            double shift = 0.25 * _bendForce;
            while (result.Iterations < mostIterations)
            {
                result.Iterations++;
                EnergySum.Anchor(_terms, shape);
                bool convex = FindDirection(shape, ref shift, ref result);
                double size = _newton.Size(out double relative);
                result.LastStep = size;
                if (!IsFinite(size))
                {
                    result.Reason = "the Newton step is not a finite number; loads are too large for the stiffness"
                            + " (youngsModulus, wireRadius)";
                    return result;
                }
                if (!convex && size < SaddleStep)
                {
                    if (!LeaveSaddle(shape, shift))
                    {
                        result.Reason = Saddle;
                        return result;
                    }
                    continue;
                }
                // Along a direction that costs no energy rounding alone makes steps: there the energy they gain is
                // asked.
                double energyStep = Math.Sqrt(Math.Max(0.0, -RodVectors.Dot(_gradient, _direction))
                    / (_softestForce * _totalLength));
                double scale = _newton.MaxStep(shape, size, relative, out double fraction);
                bool done = convex && fraction == 1.0 && (size <= tolerance || energyStep <= tolerance);
                if (done)
                {
                    _newton.Apply(shape, 1.0);
                }
                else if (!_newton.Search(shape, true, ref scale, size, out _))
                {
                    result.Reason = "the line search found no lower energy (solverTolerance)";
                    return result;
                }
                shape.CopyFrom(_newton.Trial);
                if (done)
                {
                    if (!findsEigenvalue)
                    {
                        result.Converged = true;
                        result.Reason = string.Empty;
                        return result;
                    }
                    if (IsStable(shape))
                    {
                        return Finish(shape, result);
                    }
                    // A negative eigenvalue within rounding of 0 along which the energy falls neither way is 0: such as
                    // that of a localised helix that moves along the rod.
                    RodVector[]? undecided = _stability!.Undecided;
                    if (undecided != null)
                    {
                        Array.Copy(undecided, _direction, _direction.Length);
                        if (!DescendAlong(shape, 1.0) && !DescendAlong(shape, -1.0))
                        {
                            return Finish(shape, result);
                        }
                    }
                    else if (!LeaveSaddle(shape, _neutral))
                    {
                        result.Reason = Saddle;
                        return result;
                    }
                }
            }
            result.Reason = "not converged after " + mostIterations.ToString(
                System.Globalization.CultureInfo.InvariantCulture) + " Newton iterations (maxNewtonIterations)";
            return result;
        }

        /// <summary>Sets the direction; true if the second derivative has no eigenvalue that counts as
        /// negative.</summary>
        private bool FindDirection(RodShape shape, ref double shift, ref EquilibriumResult result)
        {
            double least = Math.Min(Regularisation * _bendForce, MostRegularisation * _softestForce);
            for (double small = least; small <= _neutral; small *= 10.0)
            {
                result.Factorisations++;
                if (_newton.Factorise(shape, small) == 0)
                {
                    _system.Back(_direction);
                    return true;
                }
            }
            shift = Math.Max(0.25 * shift, 2.0 * _neutral);
            result.Factorisations += _newton.FactoriseShifted(shape, ref shift);
            return false;
        }

        /// <summary>Steps along the direction of most negative curvature, found by inverse iteration with a shift just
        /// above the smallest eigenvalue's size.</summary>
        private bool LeaveSaddle(RodShape shape, double shift)
        {
            double low = 0.0;
            double high = shift;
            for (int k = 0; k < MostHalvings && high > 1.02 * low; k++)
            {
                double middle = 0.5 * (low + high);
                bool positive = _newton.Factorise(shape, middle) == 0;
                low = positive ? low : middle;
                high = positive ? middle : high;
            }
            _newton.Factorise(shape, high);
            InverseIteration(out _);
            Array.Copy(_work, _direction, _work.Length);
            return DescendAlong(shape, RodVectors.Dot(_gradient, _direction) > 0.0 ? -1.0 : 1.0);
        }

        /// <summary>Goes along the direction, or against it, to where the energy is lower; false where it falls
        /// nowhere.</summary>
        private bool DescendAlong(RodShape shape, double sign)
        {
            double size = _newton.Size(out _);
            double start = EnergySum.Value(_terms, shape, out double magnitude);
            double largest = 0.3 * EnergySum.MaxStep(_terms, shape, _direction, sign * 0.3 / size);
            for (double turn = largest; turn > 1e-6; turn *= 0.5)
            {
                _newton.Apply(shape, sign * turn / size);
                if (EnergySum.Value(_terms, _newton.Trial, out _) < start - 1e-14 * magnitude)
                {
                    shape.CopyFrom(_newton.Trial);
                    return true;
                }
            }
            return false;
        }

        /// <summary>Leaves in the work vector the eigenvector of the current matrix whose eigenvalue is
        /// smallest.</summary>
        private void InverseIteration(out double eigenvalue)
        {
            RodVectors.SetWithoutSymmetry(_work, _totalLength);
            _system.Project(_work);
            double norm = Math.Sqrt(_system.MetricDot(_work, _work));
            eigenvalue = 0.0;
            for (int k = 0; k < PowerIterations; k++)
            {
                _system.ApplyMetric(_work);
                _system.Solve(_work);
                double next = Math.Sqrt(_system.MetricDot(_work, _work));
                eigenvalue = norm / next;
                RodVectors.Scale(_work, 1.0 / next);
                norm = 1.0;
            }
        }

        private bool IsStable(RodShape shape)
        {
            EnergySum.Anchor(_terms, shape);
            _stability ??= new EquilibriumStability(_rod, _supports, _terms, _system, _neutral);
            return _stability.IsStable(shape);
        }

        private EquilibriumResult Finish(RodShape shape, EquilibriumResult result)
        {
            double shift = 0.0;
            result.Factorisations++;
            if (_newton.Factorise(shape, shift) > 0)
            {
                shift = _neutral;
                _newton.Factorise(shape, shift);
                result.Factorisations++;
            }
            InverseIteration(out result.SmallestEigenvalue);
            result.SmallestEigenvalue -= shift;
            result.Converged = true;
            result.Reason = string.Empty;
            return result;
        }

        private static bool IsFinite(double value)
        {
            return !double.IsNaN(value) && !double.IsInfinity(value);
        }
    }
}
