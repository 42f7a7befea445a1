using System;

namespace Guidewire.Core
{
    /// <summary>Equilibria under a couple that turns with the tip and has no potential: follows them from the shape
    /// without the couple to the full couple, by Newton's method on the residual.</summary>
    /// <remarks>The tangent is the symmetric second derivative plus [m]/2 on the last element, put in exactly by three
    /// more solutions (Woodbury). A step is accepted where the next Newton step, with the same tangent, is shorter
    /// (the natural monotonicity test of Newton methods). The determinant of the tangent must stay positive along the
    /// way: where it changes sign the rod would leave the branch, and the search ends with that reason.</remarks>
    internal sealed class FollowerSolver
    {
        private const double LargestTurn = 1.0;      // rad an iteration
        private const double SmallestFactor = 1e-4;  // of the couple, a step of the continuation
        private const int MostCorrections = 15;

        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly EnergyTerm[] _terms;
        private readonly TipMoment _moment;
        private readonly BlockTridiagonal _system;
        private readonly RodVector[] _gradient;
        private readonly RodVector[] _direction;
        private readonly RodVector[] _next;
        private readonly RodVector[][] _response = new RodVector[3][];
        private readonly RodShape _trial;
        private readonly RodShape _reached;
        private readonly double _length;

        // Rows of (1 + Z S)^-1 Z, with which a solution of the symmetric system becomes one of the full tangent.
        private Vector3d _row1;
        private Vector3d _row2;
        private Vector3d _row3;

        /// <summary>A solver for this rod; <paramref name="moment"/> is among the terms.</summary>
        public FollowerSolver(MaterialRod rod, RodSupports supports, EnergyTerm[] terms, TipMoment moment)
        {
            _rod = rod;
            _supports = supports;
            _terms = terms;
            _moment = moment;
            _system = new BlockTridiagonal(rod, supports);
            _gradient = new RodVector[_system.VectorCount];
            _direction = new RodVector[_system.VectorCount];
            _next = new RodVector[_system.VectorCount];
            for (int k = 0; k < 3; k++)
            {
                _response[k] = new RodVector[_system.VectorCount];
            }
            _trial = new RodShape(rod.ElementCount);
            _reached = new RodShape(rod.ElementCount);
            _length = rod.TotalLength;
        }

        /// <summary>Moves <paramref name="shape"/>, at rest without the couple, to rest under it.</summary>
        public EquilibriumResult Solve(RodShape shape, double tolerance, int mostIterations)
        {
            EquilibriumResult result = default;
            Vector3d full = _moment.Moment;
            double reached = 0.0;
            double stride = 0.25;
            _reached.CopyFrom(shape);
            while (reached < 1.0)
            {
                double target = Math.Min(1.0, reached + stride);
                _moment.Moment = target * full;
                if (Correct(shape, tolerance, ref result))
                {
                    reached = target;
                    _reached.CopyFrom(shape);
                    stride *= 2.0;
                }
                else
                {
                    shape.CopyFrom(_reached);
                    stride *= 0.5;
                }
                if (stride < SmallestFactor || result.Iterations > mostIterations)
                {
                    result.Reason = "no equilibrium connected with the unloaded rod beyond "
                        + reached.ToString("0.####", System.Globalization.CultureInfo.InvariantCulture)
                        + " of the tip moment";
                    _moment.Moment = full;
                    return result;
                }
            }
            _moment.Moment = full;
            result.Converged = true;
            result.Reason = string.Empty;
            return result;
        }

        private bool Correct(RodShape shape, double tolerance, ref EquilibriumResult result)
        {
            for (int k = 0; k < MostCorrections; k++)
            {
                result.Iterations++;
                result.Factorisations++;
                int negative = _system.Factorise(_terms, shape, _gradient, _direction, 0.0);
                _system.Back(_direction);
                double determinant = PrepareTangent();
                bool stable = negative % 2 == 0 ? determinant > 0.0 : determinant < 0.0;
                Complete(_direction);
                double size = RodStep.Size(_direction, _rod.ElementCount, _length, out _);
                result.LastStep = size;
                if (!(size < double.MaxValue))
                {
                    return false;
                }
                if (size <= tolerance)
                {
                    RodStep.Apply(_rod, _supports, shape, _direction, 1.0, _trial);
                    shape.CopyFrom(_trial);
                    return stable;
                }
                if (!Search(shape, size))
                {
                    return false;
                }
                shape.CopyFrom(_trial);
            }
            return false;
        }

        private bool Search(RodShape shape, double size)
        {
            for (double scale = Math.Min(1.0, LargestTurn / size); scale > 0.02; scale *= 0.5)
            {
                RodStep.Apply(_rod, _supports, shape, _direction, scale, _trial);
                _system.Gradient(_terms, _trial, _gradient, _next);
                _system.Solve(_next);
                Complete(_next);
                double next = RodStep.Size(_next, _rod.ElementCount, _length, out _);
                if (next <= (1.0 - 0.25 * scale) * size)
                {
                    return true;
                }
            }
            return false;
        }

        /// <summary>Solves for unit couples on the last element; returns det(1 + Z S).</summary>
        private double PrepareTangent()
        {
            int last = _rod.ElementCount - 1;
            for (int k = 0; k < 3; k++)
            {
                Array.Clear(_response[k], 0, _response[k].Length);
                _response[k][last].T1 = k == 0 ? 1.0 : 0.0;
                _response[k][last].T2 = k == 1 ? 1.0 : 0.0;
                _response[k][last].T3 = k == 2 ? 1.0 : 0.0;
                _system.Solve(_response[k]);
            }
            Vector3d half = 0.5 * _moment.Moment;
            Vector3d c1 = Vector3d.UnitX + Vector3d.Cross(half, Turn(_response[0][last]));
            Vector3d c2 = Vector3d.UnitY + Vector3d.Cross(half, Turn(_response[1][last]));
            Vector3d c3 = Vector3d.UnitZ + Vector3d.Cross(half, Turn(_response[2][last]));
            double determinant = Vector3d.Dot(c1, Vector3d.Cross(c2, c3));
            // Rows of the inverse of (c1 c2 c3), each times Z = [half] from the right: r^T [half] = (r x half)^T.
            _row1 = Vector3d.Cross(Vector3d.Cross(c2, c3), half) / determinant;
            _row2 = Vector3d.Cross(Vector3d.Cross(c3, c1), half) / determinant;
            _row3 = Vector3d.Cross(Vector3d.Cross(c1, c2), half) / determinant;
            return determinant;
        }

        /// <summary>Turns a solution of the symmetric system into one of the full tangent.</summary>
        private void Complete(RodVector[] y)
        {
            Vector3d tip = Turn(y[_rod.ElementCount - 1]);
            RodVectors.AddScaled(y, -Vector3d.Dot(_row1, tip), _response[0]);
            RodVectors.AddScaled(y, -Vector3d.Dot(_row2, tip), _response[1]);
            RodVectors.AddScaled(y, -Vector3d.Dot(_row3, tip), _response[2]);
        }

        private static Vector3d Turn(in RodVector v)
        {
            return new Vector3d(v.T1, v.T2, v.T3);
        }
    }
}
