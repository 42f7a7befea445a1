using System;

namespace Guidewire.Core
{
    /// <summary>A dense symmetric matrix that need not be definite: P A P^T = L D L^T with pivots of one or two rows
    /// (Bunch and Kaufman 1977, Math. Comp. 31), by which it is solved and its eigenvalues' signs are
    /// counted.</summary>
    internal sealed class IndefiniteMatrix
    {
        private static readonly double MaxGrowth = (1.0 + Math.Sqrt(17.0)) / 8.0;

        private double[][] _a = Array.Empty<double[]>();   // the lower triangle, by rows
        private int[] _pivot = Array.Empty<int>();         // the row exchanged; -1 - row of a pivot of two rows
        private double[] _one = Array.Empty<double>();     // of the columns that are eliminated
        private double[] _two = Array.Empty<double>();
        private int _size;

        /// <summary>Its entry of row i and column j, j at most i.</summary>
        public ref double this[int i, int j] => ref _a[i][j];

        /// <summary>Makes it so large; its entries are to be set.</summary>
        public void Resize(int size)
        {
            _size = size;
            if (size <= _a.Length)
            {
                return;
            }
            int most = Math.Max(size, 2 * _a.Length);
            _a = new double[most][];
            for (int i = 0; i < most; i++)
            {
                _a[i] = new double[i + 1];
            }
            _pivot = new int[most];
            _one = new double[most];
            _two = new double[most];
        }

        /// <summary>Factorises in place.</summary>
        /// <returns>The number of its eigenvalues that are not negative.</returns>
        public int Factorise()
        {
            int positive = 0;
            for (int k = 0; k < _size;)
            {
                int other = ChoosePivot(k, out bool isPair);
                int exchanged = isPair ? k + 1 : k;
                Exchange(k, exchanged, other);
                _pivot[k] = isPair ? -1 - other : other;
                if (isPair)
                {
                    _pivot[k + 1] = _pivot[k];
                    positive++;    // its determinant is negative
                    EliminatePair(k);
                    k += 2;
                }
                else
                {
                    positive += _a[k][k] < 0.0 ? 0 : 1;
                    Eliminate(k);
                    k++;
                }
            }
            return positive;
        }

        /// <summary>b := A^-1 b.</summary>
        public void Solve(double[] b)
        {
            for (int k = 0; k < _size;)
            {
                bool isPair = _pivot[k] < 0;
                int exchanged = isPair ? k + 1 : k;
                int other = isPair ? -1 - _pivot[k] : _pivot[k];
                (b[exchanged], b[other]) = (b[other], b[exchanged]);
                int next = exchanged + 1;
                for (int i = next; i < _size; i++)
                {
                    b[i] -= _a[i][k] * b[k] + (isPair ? _a[i][k + 1] * b[k + 1] : 0.0);
                }
                if (isPair)
                {
                    SolvePair(k, b[k], b[k + 1], out b[k], out b[k + 1]);
                }
                else
                {
                    b[k] /= _a[k][k];
                }
                k = next;
            }
            for (int k = _size - 1; k >= 0;)
            {
                bool isPair = _pivot[k] < 0;
                int first = isPair ? k - 1 : k;
                for (int i = k + 1; i < _size; i++)
                {
                    b[k] -= _a[i][k] * b[i];
                    b[first] -= isPair ? _a[i][first] * b[i] : 0.0;
                }
                int other = isPair ? -1 - _pivot[k] : _pivot[k];
                (b[k], b[other]) = (b[other], b[k]);
                k = first - 1;
            }
        }

        // The row to exchange with row k, or with k + 1 where the pivot has two rows.
        private int ChoosePivot(int k, out bool isPair)
        {
            isPair = false;
            double own = Math.Abs(_a[k][k]);
            int row = k;
            double largest = 0.0;
            for (int i = k + 1; i < _size; i++)
            {
                double size = Math.Abs(_a[i][k]);
                (row, largest) = size > largest ? (i, size) : (row, largest);
            }
            if (own >= MaxGrowth * largest)
            {
                return k;
            }
            double inRow = 0.0;
            for (int j = k; j < _size; j++)
            {
                double size = j == row ? 0.0 : Math.Abs(j < row ? _a[row][j] : _a[j][row]);
                inRow = Math.Max(inRow, size);
            }
            if (own * inRow >= MaxGrowth * largest * largest)
            {
                return k;
            }
            isPair = Math.Abs(_a[row][row]) < MaxGrowth * inRow;
            return row;
        }

        // Rows and columns p and q of what is left from k on.
        private void Exchange(int k, int p, int q)
        {
            if (p == q)
            {
                return;
            }
            (_a[p][p], _a[q][q]) = (_a[q][q], _a[p][p]);
            for (int i = q + 1; i < _size; i++)
            {
                (_a[i][p], _a[i][q]) = (_a[i][q], _a[i][p]);
            }
            for (int i = p + 1; i < q; i++)
            {
                (_a[i][p], _a[q][i]) = (_a[q][i], _a[i][p]);
            }
            if (p > k)
            {
                (_a[p][k], _a[q][k]) = (_a[q][k], _a[p][k]);
            }
        }

        private void Eliminate(int k)
        {
            double inverse = 1.0 / _a[k][k];
            for (int i = k + 1; i < _size; i++)
            {
                double[] row = _a[i];
                _one[i] = row[k];
                double factor = inverse * row[k];
                row[k] = factor;
                if (factor != 0.0)
                {
                    for (int j = k + 1; j <= i; j++)
                    {
                        row[j] -= factor * _one[j];
                    }
                }
            }
        }

        private void EliminatePair(int k)
        {
            for (int i = k + 2; i < _size; i++)
            {
                double[] row = _a[i];
                (_one[i], _two[i]) = (row[k], row[k + 1]);
                SolvePair(k, row[k], row[k + 1], out double first, out double second);
                (row[k], row[k + 1]) = (first, second);
                for (int j = k + 2; j <= i; j++)
                {
                    row[j] -= first * _one[j] + second * _two[j];
                }
            }
        }

        // With the pivot of rows k and k + 1, scaled by its entry off the diagonal, which is the largest.
        private void SolvePair(int k, double a, double b, out double x, out double y)
        {
            double off = _a[k + 1][k];
            double p = _a[k][k] / off;
            double q = _a[k + 1][k + 1] / off;
            double scale = 1.0 / (off * (p * q - 1.0));
            x = scale * (q * a - b);
            y = scale * (p * b - a);
        }
    }
}
