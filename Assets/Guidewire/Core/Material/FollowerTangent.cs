using System;

namespace Guidewire.Core
{
    /// <summary>Tangent stiffness K of a rod under a follower couple and a follower force, plus a drag: K + d M,
    /// factorised and solved in O(n).</summary>
    /// <remarks>K is the symmetric second derivative S of the terms plus the part that no energy carries. That part
    /// acts between the turn theta of the last element and the position x of the last node only: [m]/2 on (theta,
    /// theta), N = R [f]/2 on (x, theta) and -N^T on (theta, x). It is put in exactly by Woodbury's formula: with G the
    /// tip's answers to unit couples and forces of the symmetric system and Z the part, (1 + G Z)^-1 G in place of G,
    /// at three more solutions for a couple and six for a force. M is the metric: l on turns, l/L^2 on
    /// shifts.</remarks>
    internal sealed class FollowerTangent
    {
        private const int MaxSize = 6;

        private readonly EnergyTerm[] _terms;
        private readonly TipFollowers _followers;
        private readonly BlockTridiagonal _system;
        private readonly RodVector[][] _response = new RodVector[MaxSize][];
        private readonly RodVector[] _gradient;
        private readonly MaterialRod _rod;
        private int _tip;                                             // the last element
        private readonly double[] _part = new double[MaxSize * MaxSize];    // Z, by rows
        private readonly double[] _matrix = new double[MaxSize * MaxSize];  // 1 + Z G, then its triangles
        private readonly int[] _pivot = new int[MaxSize];
        private readonly double[] _load = new double[MaxSize];
        private int _size;                                            // 3 or 6

        /// <summary>The tangent of this rod; <paramref name="followers"/> are among the terms.</summary>
        public FollowerTangent(MaterialRod rod, RodSupports supports, EnergyTerm[] terms, TipFollowers followers)
        {
            _terms = terms;
            _followers = followers;
            _system = new BlockTridiagonal(rod, supports);
            _rod = rod;
            _gradient = new RodVector[_system.VectorCapacity];
            for (int k = 0; k < MaxSize; k++)
            {
                _response[k] = new RodVector[_system.VectorCapacity];
            }
            Remesh();
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            _system.Remesh();
            _tip = _rod.ElementCount - 1;
        }

        /// <summary>Metric, supports and length of vectors.</summary>
        public BlockTridiagonal System => _system;

        /// <summary>Factorises at a shape; sets <paramref name="step"/> to -(K + d M)^-1 times the residual.</summary>
        /// <param name="drag">d, N; 0 for Newton's step.</param>
        /// <returns>The number of eigenvalues of S + d M that are not positive. Where it is not 0 the step may lead
        /// anywhere.</returns>
        public int Factorise(RodShape shape, RodVector[] step, double drag)
        {
            EnergySum.Anchor(_terms, shape);
            int negative = _system.Factorise(_terms, shape, _gradient, step, drag);
            _system.Back(step);
            Prepare(shape);
            Complete(step);
            return negative;
        }

        /// <summary>Computes y := (K + d M)^-1 y with the current factorisation.</summary>
        public void Solve(RodVector[] y)
        {
            _system.Solve(y);
            Complete(y);
        }

        private void Prepare(RodShape shape)
        {
            _size = _followers.Force.Force == Vector3d.Zero ? 3 : MaxSize;
            for (int k = 0; k < _size; k++)
            {
                Array.Clear(_response[k], 0, _response[k].Length);
                ref RodVector v = ref k < 3 ? ref _response[k][_tip] : ref _response[k][_tip + 1];
                v.T1 = k == 0 ? 1.0 : 0.0;
                v.T2 = k == 1 ? 1.0 : 0.0;
                v.T3 = k == 2 ? 1.0 : 0.0;
                v.X1 = k == 3 ? 1.0 : 0.0;
                v.X2 = k == 4 ? 1.0 : 0.0;
                v.X3 = k == 5 ? 1.0 : 0.0;
                _system.Project(_response[k]);
                _system.Solve(_response[k]);
            }
            SetPart(shape);
            for (int row = 0; row < _size; row++)
            {
                for (int column = 0; column < _size; column++)
                {
                    double sum = row == column ? 1.0 : 0.0;
                    for (int k = 0; k < _size; k++)
                    {
                        sum += _part[row * MaxSize + k] * OfTip(_response[column], k);
                    }
                    _matrix[row * MaxSize + column] = sum;
                }
            }
            Eliminate();
        }

        private void SetPart(RodShape shape)
        {
            Array.Clear(_part, 0, _part.Length);
            Vector3d half = 0.5 * _followers.Moment.Moment;
            SetColumn(0, 0, Vector3d.Cross(half, Vector3d.UnitX));
            SetColumn(0, 1, Vector3d.Cross(half, Vector3d.UnitY));
            SetColumn(0, 2, Vector3d.Cross(half, Vector3d.UnitZ));
            if (_size == MaxSize)
            {
                _followers.Force.HalfTangent(shape, out Vector3d first, out Vector3d second, out Vector3d third);
                SetColumn(3, 0, first);
                SetColumn(3, 1, second);
                SetColumn(3, 2, third);
                for (int row = 0; row < 3; row++)
                {
                    for (int column = 3; column < MaxSize; column++)
                    {
                        _part[row * MaxSize + column] = -_part[column * MaxSize + row];
                    }
                }
            }
        }

        private void SetColumn(int row, int column, in Vector3d value)
        {
            _part[row * MaxSize + column] = value.X;
            _part[(row + 1) * MaxSize + column] = value.Y;
            _part[(row + 2) * MaxSize + column] = value.Z;
        }

        /// <summary>Turns a solution y of the symmetric system into one of the full tangent: y less the answers to
        /// (1 + Z G)^-1 Z y.</summary>
        private void Complete(RodVector[] y)
        {
            for (int row = 0; row < _size; row++)
            {
                _load[row] = 0.0;
                for (int k = 0; k < _size; k++)
                {
                    _load[row] += _part[row * MaxSize + k] * OfTip(y, k);
                }
            }
            Substitute();
            for (int k = 0; k < _size; k++)
            {
                RodVectors.AddScaled(y, -_load[k], _response[k]);
            }
        }

        private double OfTip(RodVector[] y, int k)
        {
            RodVector turn = y[_tip];
            RodVector position = y[_tip + 1];
            return k == 0 ? turn.T1 : k == 1 ? turn.T2 : k == 2 ? turn.T3 : k == 3 ? position.X1
                : k == 4 ? position.X2 : position.X3;
        }

        // Gaussian elimination with exchange of rows, in place.
        private void Eliminate()
        {
            for (int k = 0; k < _size; k++)
            {
                int pivot = k;
                for (int row = k + 1; row < _size; row++)
                {
                    pivot = Math.Abs(_matrix[row * MaxSize + k]) > Math.Abs(_matrix[pivot * MaxSize + k]) ? row : pivot;
                }
                _pivot[k] = pivot;
                for (int column = 0; column < _size; column++)
                {
                    (_matrix[k * MaxSize + column], _matrix[pivot * MaxSize + column]) =
                        (_matrix[pivot * MaxSize + column], _matrix[k * MaxSize + column]);
                }
                for (int row = k + 1; row < _size; row++)
                {
                    double fraction = _matrix[row * MaxSize + k] / _matrix[k * MaxSize + k];
                    _matrix[row * MaxSize + k] = fraction;
                    for (int column = k + 1; column < _size; column++)
                    {
                        _matrix[row * MaxSize + column] -= fraction * _matrix[k * MaxSize + column];
                    }
                }
            }
        }

        private void Substitute()
        {
            for (int k = 0; k < _size; k++)
            {
                (_load[k], _load[_pivot[k]]) = (_load[_pivot[k]], _load[k]);
            }
            for (int k = 0; k < _size; k++)
            {
                for (int column = 0; column < k; column++)
                {
                    _load[k] -= _matrix[k * MaxSize + column] * _load[column];
                }
            }
            for (int k = _size - 1; k >= 0; k--)
            {
                for (int column = k + 1; column < _size; column++)
                {
                    _load[k] -= _matrix[k * MaxSize + column] * _load[column];
                }
                _load[k] /= _matrix[k * MaxSize + k];
            }
        }
    }
}
