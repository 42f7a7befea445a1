using System;

namespace Guidewire.Core
{
    /// <summary>What couples pieces of a rod that are not neighbours: columns c u u^T on a matrix A whose factorisation
    /// stays as it is. With U of the columns, C of their numbers c, and S = C^-1 + U^T A^-1 U,
    /// (A + U C U^T)^-1 = A^-1 - A^-1 U S^-1 U^T A^-1 (Woodbury 1950).</summary>
    /// <remarks>S is small and dense, and not definite where any c is negative or A is not. Both ways to eliminate
    /// [A, U; U^T, -C^-1] have the same inertia (Haynsworth 1968): A + U C U^T has as many negative eigenvalues as A,
    /// and those of S that are positive, less the c that are positive. So A itself may be indefinite where contact
    /// holds
    /// the rod. A column costs a forward and a backward elimination, from its first node on.
    ///
    /// Unknowns besides those of the rod border it, as [A, B; B^T, D]: the displacements of a vessel. They are columns
    /// of U too, with -D in the place of C^-1, a right-hand side and a solution of their own. Where the whole is
    /// positive S is negative in them.</remarks>
    internal sealed class LowRank
    {
        private const double LeastLeft = 1e-3;     // of a part of the matrix
        private const int Lanes = 4;    // columns that are eliminated at once

        private readonly StructList<Column> _columns = new StructList<Column>(16);
        private readonly IndefiniteMatrix _s = new IndefiniteMatrix();
        private readonly RodVector[] _work;
        private readonly StructList<Coupling>[] _border;    // B by three columns
        private readonly double[] _own;                      // D, by rows
        private RodVector4[][] _z = Array.Empty<RodVector4[]>();    // A^-1 U, four columns each, by node
        private double[] _right = Array.Empty<double>();

        /// <summary>For a rod whose vectors have at most so many entries.</summary>
        /// <param name="borderCount">Unknowns besides those of the rod, three for each of a vessel's splines.</param>
        public LowRank(int vectorCapacity, int borderCount = 0)
        {
            _work = new RodVector[vectorCapacity];
            _border = new StructList<Coupling>[borderCount / 3];
            for (int j = 0; j < _border.Length; j++)
            {
                _border[j] = new StructList<Coupling>(16);
            }
            _own = new double[borderCount * borderCount];
        }

        /// <summary>How many columns of the rod there are.</summary>
        public int Count => _columns.Count;

        /// <summary>Whether there is nothing besides the rod's own matrix.</summary>
        public bool IsEmpty => _columns.Count == 0 && _border.Length == 0;

        /// <summary>Removes all columns and what borders the matrix.</summary>
        public void Clear()
        {
            _columns.Clear();
            foreach (StructList<Coupling> border in _border)
            {
                border.Clear();
            }
            Array.Clear(_own, 0, _own.Length);
        }

        /// <summary>Adds a coupling of a node, and of the element after it, with spline j of the border.</summary>
        /// <param name="second">Second derivative by the node's position (row) and the spline (column).</param>
        /// <param name="turn">The same by the element's turn.</param>
        public void AddCoupling(int node, int j, in Matrix3 second, in Matrix3 turn = default)
        {
            StructList<Coupling> border = _border[j];
            for (int k = border.Count - 1; k >= Math.Max(0, border.Count - 2); k--)
            {
                if (border[k].Node == node)
                {
                    border[k].Second += second;
                    border[k].Turn += turn;
                    return;
                }
            }
            border.Add(new Coupling { Node = node, Second = second, Turn = turn });
        }

        /// <summary>The second derivative by two unknowns of the border, of which the lower triangle counts.</summary>
        public ref double Border(int row, int column) => ref _own[3 * _border.Length * row + column];

        /// <summary>Adds c u u^T with u on the nodes and orientations of two elements.</summary>
        /// <param name="element">The lower one.</param>
        /// <param name="other">The higher one, not its neighbour.</param>
        /// <param name="a">Of the lower element's first node and its orientation.</param>
        /// <param name="aEnd">Of its second node.</param>
        /// <param name="b">The same of the higher one.</param>
        /// <param name="bEnd">The same.</param>
        /// <param name="c">Not 0.</param>
        public void Add(int element, int other, in RodVector a, in RodVector aEnd, in RodVector b, in RodVector bEnd,
            double c)
        {
            var column = new Column { Element = element, Other = other, IsNegative = c < 0.0 };
            double scale = Math.Sqrt(Math.Abs(c));
            column.A.AddScaled(scale, a);
            column.AEnd.AddScaled(scale, aEnd);
            column.B.AddScaled(scale, b);
            column.BEnd.AddScaled(scale, bEnd);
            _columns.Add(column);
        }

        /// <summary>Gives each column as a vector of the whole rod, with its c.</summary>
        public void ForEach(Action<RodVector[], double> take)
        {
            for (int k = 0; k < _columns.Count; k++)
            {
                Array.Clear(_work, 0, _work.Length);
                _columns[k].AddTo(_work, 1.0);
                take(_work, _columns[k].IsNegative ? -1.0 : 1.0);
            }
        }

        /// <summary>Factorises S for a matrix that is factorised.</summary>
        /// <returns>By how many eigenvalues more the sum with its border is not positive than the matrix.</returns>
        public int Factorise(BlockTridiagonal system)
        {
            int lowest = system.BlockCount;
            for (int k = 0; k < _columns.Count; k++)
            {
                ref Column column = ref _columns[k];
                system.Hold(column.Element, ref column.A, ref column.AEnd);
                system.Hold(column.Other, ref column.B, ref column.BEnd);
                lowest = Math.Min(lowest, column.Element);
            }
            foreach (StructList<Coupling> border in _border)
            {
                for (int k = 0; k < border.Count; k++)
                {
                    border[k].Hold(system);
                    lowest = Math.Min(lowest, border[k].Node);
                }
            }
            int groups = (Total + Lanes - 1) / Lanes;
            Reserve(groups);
            for (int g = 0; g < groups; g++)
            {
                SolveGroup(system, g, lowest);
            }
            AssembleSum(groups);
            return _s.Factorise() - CountPositive();
        }

        /// <summary>The same of a positive matrix, with which the sum becomes positive too. With the positive columns
        /// in
        /// the matrix B, the negative ones take parts m of it away along the eigenvectors v of U^T B^-1 U: 1 - m
        /// becomes
        /// |1 - m| there.</summary>
        /// <returns>Whether the sum is positive: a border is left as it is.</returns>
        public bool Reflect(BlockTridiagonal system)
        {
            if (Factorise(system) <= 0)
            {
                return true;
            }
            if (_border.Length > 0)
            {
                return false;
            }
            AssembleSum((_columns.Count + Lanes - 1) / Lanes);
            int[] positive = Indices(false);
            int[] negative = Indices(true);
            int n = negative.Length;
            var plus = new IndefiniteMatrix();
            plus.Resize(positive.Length);
            for (int i = 0; i < positive.Length; i++)
            {
                for (int j = 0; j <= i; j++)
                {
                    plus[i, j] = _s[positive[i], positive[j]];
                }
            }
            plus.Factorise();
            var taken = new double[n, n];
            var right = new double[positive.Length];
            for (int b = 0; b < n; b++)
            {
                for (int i = 0; i < positive.Length; i++)
                {
                    right[i] = Sum(positive[i], negative[b]);
                }
                plus.Solve(right);
                for (int a = 0; a < n; a++)
                {
                    taken[a, b] = Sum(negative[a], negative[b]) + (a == b ? 1.0 : 0.0);
                    for (int i = 0; i < positive.Length; i++)
                    {
                        taken[a, b] -= Sum(positive[i], negative[a]) * right[i];
                    }
                }
            }
            double[] part = SymmetricEigenvalues.Find(taken, out double[,] vectors);
            for (int k = 0; k < n; k++)
            {
                if (part[k] < 1.0)
                {
                    continue;
                }
                // c^-1 of the part that is left, less what it was.
                double left = 1.0 - Math.Max(part[k] - 1.0, LeastLeft);
                double more = part[k] / (Math.Abs(left) > LeastLeft ? left : LeastLeft) - 1.0;
                for (int a = 0; a < n; a++)
                {
                    for (int b = 0; b <= a; b++)
                    {
                        _s[negative[a], negative[b]] -= more * vectors[a, k] * vectors[b, k];
                    }
                }
            }
            _s.Factorise();
            return true;
        }

        /// <summary>Turns y = A^-1 b into (A + U C U^T)^-1 b.</summary>
        public void Correct(BlockTridiagonal system, RodVector[] y)
        {
            for (int k = 0; k < _columns.Count; k++)
            {
                ref Column column = ref _columns[k];
                _right[k] = RodVector.Dot(column.A, y[column.Element])
                    + RodVector.Dot(column.AEnd, y[column.Element + 1])
                    + RodVector.Dot(column.B, y[column.Other]) + RodVector.Dot(column.BEnd, y[column.Other + 1]);
            }
            for (int j = 0; j < _border.Length; j++)
            {
                Vector3d sum = -y[system.VesselStart + j].X;
                for (int k = 0; k < _border[j].Count; k++)
                {
                    ref Coupling coupling = ref _border[j][k];
                    sum += coupling.Second.TransposeTimes(y[coupling.Node].X)
                        + coupling.Turn.TransposeTimes(y[coupling.Node].T);
                }
                int at = _columns.Count + 3 * j;
                (_right[at], _right[at + 1], _right[at + 2]) = (sum.X, sum.Y, sum.Z);
            }
            _s.Solve(_right);
            Array.Clear(_work, 0, system.VectorCount);
            for (int k = 0; k < _columns.Count; k++)
            {
                _columns[k].AddTo(_work, _right[k]);
            }
            for (int j = 0; j < _border.Length; j++)
            {
                int at = _columns.Count + 3 * j;
                var own = new Vector3d(_right[at], _right[at + 1], _right[at + 2]);
                for (int k = 0; k < _border[j].Count; k++)
                {
                    ref Coupling coupling = ref _border[j][k];
                    _work[coupling.Node].AddX(coupling.Second * own);
                    _work[coupling.Node].AddT(coupling.Turn * own);
                }
                y[system.VesselStart + j] = default;
                y[system.VesselStart + j].AddX(own);
            }
            system.SolveWithout(_work);
            for (int i = 0; i < system.VesselStart; i++)
            {
                y[i].AddScaled(-1.0, _work[i]);
            }
        }

        private int Total => _columns.Count + 3 * _border.Length;

        private int CountPositive()
        {
            int count = 0;
            for (int k = 0; k < _columns.Count; k++)
            {
                count += _columns[k].IsNegative ? 0 : 1;
            }
            return count;
        }

        private void Reserve(int groups)
        {
            if (groups > _z.Length)
            {
                int had = _z.Length;
                Array.Resize(ref _z, Math.Max(groups, 2 * had));
                for (int g = had; g < _z.Length; g++)
                {
                    _z[g] = new RodVector4[_work.Length];
                }
                Array.Resize(ref _right, Lanes * _z.Length);
            }
        }

        private void SolveGroup(BlockTridiagonal system, int g, int lowest)
        {
            RodVector4[] z = _z[g];
            int first = Lanes * g;
            int count = Math.Min(Lanes, Total - first);
            if (!system.HasTwistAngles)
            {
                Array.Clear(z, lowest, system.BlockCount + 1 - lowest);
                int from = int.MaxValue;
                for (int lane = 0; lane < count; lane++)
                {
                    from = Math.Min(from, AddColumn(first + lane, z, lane));
                }
                if (from < int.MaxValue)
                {
                    system.SolveWithout(z, from, lowest);
                }
                return;
            }
            Array.Clear(z, 0, z.Length);
            for (int lane = 0; lane < count; lane++)
            {
                Array.Clear(_work, 0, system.VectorCount);
                AddColumn(first + lane);
                system.SolveWithout(_work);
                for (int i = 0; i < system.BlockCount; i++)
                {
                    z[i].Add(InLane(_work[i], lane));
                }
            }
        }

        // Column k, in a lane; its first node.
        private int AddColumn(int k, RodVector4[] z, int lane)
        {
            if (k < _columns.Count)
            {
                _columns[k].AddTo(z, lane);
                return _columns[k].Element;
            }
            int from = int.MaxValue;
            StructList<Coupling> border = BorderOf(k, out int component);
            for (int l = 0; l < border.Count; l++)
            {
                z[border[l].Node].Add(InLane(border[l].ColumnOf(component), lane));
                from = Math.Min(from, border[l].Node);
            }
            return from;
        }

        private void AddColumn(int k)
        {
            if (k < _columns.Count)
            {
                _columns[k].AddTo(_work, 1.0);
                return;
            }
            StructList<Coupling> border = BorderOf(k, out int component);
            for (int l = 0; l < border.Count; l++)
            {
                _work[border[l].Node].AddScaled(1.0, border[l].ColumnOf(component));
            }
        }

        private StructList<Coupling> BorderOf(int k, out int component)
        {
            component = (k - _columns.Count) % 3;
            return _border[(k - _columns.Count) / 3];
        }

        private double Sum(int i, int j) => i > j ? _s[i, j] : _s[j, i];

        private int[] Indices(bool isNegative)
        {
            var indices = new int[isNegative ? _columns.Count - CountPositive() : CountPositive()];
            int count = 0;
            for (int k = 0; k < _columns.Count; k++)
            {
                if (_columns[k].IsNegative == isNegative)
                {
                    indices[count++] = k;
                }
            }
            return indices;
        }

        // S.
        private void AssembleSum(int groups)
        {
            _s.Resize(Total);
            AssembleBorder();
            for (int k = 0; k < _columns.Count; k++)
            {
                ref Column column = ref _columns[k];
                for (int g = 0; g <= k / Lanes; g++)
                {
                    RodVector4[] z = _z[g];
                    Double4 sum = RodVector4.Dot(column.A, z[column.Element])
                        + RodVector4.Dot(column.AEnd, z[column.Element + 1])
                        + RodVector4.Dot(column.B, z[column.Other]) + RodVector4.Dot(column.BEnd, z[column.Other + 1]);
                    for (int j = Lanes * g; j <= Math.Min(k, Lanes * g + Lanes - 1); j++)
                    {
                        _s[k, j] = sum[j - Lanes * g];
                    }
                }
                _s[k, k] += column.IsNegative ? -1.0 : 1.0;
            }
        }

        private void AssembleBorder()
        {
            for (int j = 0; j < _border.Length; j++)
            {
                int row = _columns.Count + 3 * j;
                for (int g = 0; g <= (row + 2) / Lanes; g++)
                {
                    Double4 x = default;
                    Double4 y = default;
                    Double4 z = default;
                    for (int k = 0; k < _border[j].Count; k++)
                    {
                        ref Coupling coupling = ref _border[j][k];
                        RodVector4 solved = _z[g][coupling.Node];
                        x += RodVector4.Dot(coupling.ColumnOf(0), solved);
                        y += RodVector4.Dot(coupling.ColumnOf(1), solved);
                        z += RodVector4.Dot(coupling.ColumnOf(2), solved);
                    }
                    for (int l = Lanes * g; l < Lanes * g + Lanes; l++)
                    {
                        Set(row, l, x[l - Lanes * g]);
                        Set(row + 1, l, y[l - Lanes * g]);
                        Set(row + 2, l, z[l - Lanes * g]);
                    }
                }
            }
        }

        private void Set(int row, int column, double value)
        {
            if (column <= row)
            {
                int own = column - _columns.Count;
                _s[row, column] = own < 0 ? value : value - Border(row - _columns.Count, own);
            }
        }

        private static RodVector4 InLane(in RodVector v, int lane) => new RodVector4(lane == 0 ? v : default,
            lane == 1 ? v : default, lane == 2 ? v : default, lane == 3 ? v : default);

        private struct Coupling
        {
            public int Node;
            public Matrix3 Second;
            public Matrix3 Turn;

            public readonly RodVector ColumnOf(int c) => c == 0 ? new RodVector(Second.C1, Turn.C1)
                : c == 1 ? new RodVector(Second.C2, Turn.C2) : new RodVector(Second.C3, Turn.C3);

            public void Hold(BlockTridiagonal system)
            {
                if (Node == 0 || Node == system.BlockCount - 1)
                {
                    Second = new Matrix3(Held(system, Second.C1), Held(system, Second.C2), Held(system, Second.C3));
                }
            }

            private readonly Vector3d Held(BlockTridiagonal system, in Vector3d column)
            {
                var node = default(RodVector);
                node.AddX(column);
                var other = default(RodVector);
                if (Node == 0)
                {
                    system.Hold(0, ref node, ref other);
                }
                else
                {
                    system.Hold(Node - 1, ref other, ref node);
                }
                return node.X;
            }
        }

        // Scaled so that c is 1 or -1.
        private struct Column
        {
            public int Element;
            public int Other;
            public RodVector A;
            public RodVector AEnd;
            public RodVector B;
            public RodVector BEnd;
            public bool IsNegative;

            public readonly void AddTo(RodVector[] v, double scale)
            {
                v[Element].AddScaled(scale, A);
                v[Element + 1].AddScaled(scale, AEnd);
                v[Other].AddScaled(scale, B);
                v[Other + 1].AddScaled(scale, BEnd);
            }

            public readonly void AddTo(RodVector4[] v, int lane)
            {
                v[Element].Add(InLane(A, lane));
                v[Element + 1].Add(InLane(AEnd, lane));
                v[Other].Add(InLane(B, lane));
                v[Other + 1].Add(InLane(BEnd, lane));
            }
        }
    }
}
