using System;

namespace Guidewire.Core
{
    /// <summary>Cubic splines of several columns over one argument: natural at their ends, or periodic.</summary>
    public sealed class CubicSpline
    {
        private readonly double[] _at;
        private readonly double[][] _rows;
        private readonly double[][] _second;    // derivatives at the rows
        private readonly double _period;        // 0: natural

        /// <summary>The spline through rows of c values each.</summary>
        /// <param name="at">Where the rows are, increasing.</param>
        /// <param name="rows">As many.</param>
        /// <param name="period">After which the first row comes again; 0: the spline is natural.</param>
        public CubicSpline(double[] at, double[][] rows, double period = 0.0)
        {
            (_at, _rows, _period) = (at, rows, period);
            int m = at.Length;
            _second = Array.ConvertAll(rows, row => new double[row.Length]);
            int count = period > 0.0 ? m : m - 2;    // of unknown second derivatives, from row 1 or 0 on
            if (m < 2 || count < 1)
            {
                return;
            }
            int first = period > 0.0 ? 0 : 1;
            var lower = new double[count];
            var upper = new double[count];
            var diagonal = new double[count];
            for (int i = 0; i < count; i++)
            {
                lower[i] = Step(i + first - 1);
                upper[i] = Step(i + first);
                diagonal[i] = 2.0 * (lower[i] + upper[i]);
            }
            for (int c = 0; c < rows[0].Length; c++)
            {
                var right = new double[count];
                for (int i = 0; i < count; i++)
                {
                    int k = i + first;
                    right[i] = 6.0 * ((Row(k + 1)[c] - Row(k)[c]) / upper[i] - (Row(k)[c] - Row(k - 1)[c]) / lower[i]);
                }
                // What couples the last equation to the first is iterated: each round divides the error by 7 or more
                // for each row between them.
                double[] u = Solve(lower, diagonal, upper, right, 0.0, 0.0);
                for (int round = 0; round < 60 && period > 0.0; round++)
                {
                    u = Solve(lower, diagonal, upper, right, u[count - 1], u[0]);
                }
                for (int i = 0; i < count; i++)
                {
                    _second[i + first][c] = u[i];
                }
            }
        }

        /// <summary>The second derivatives at the rows.</summary>
        internal double[][] SecondDerivatives => _second;

        /// <summary>Sets the values at a place; before the first and behind the last row of a natural spline those of
        /// the rows.</summary>
        public void Evaluate(double at, double[] values)
        {
            int m = _at.Length;
            if (m == 1)
            {
                Array.Copy(_rows[0], values, values.Length);
                return;
            }
            at = _period > 0.0 ? at - _period * Math.Floor((at - _at[0]) / _period)
                : Math.Min(Math.Max(at, _at[0]), _at[m - 1]);
            int k = Array.BinarySearch(_at, at);
            k = k >= 0 ? k : ~k - 1;
            k = Math.Min(k, _period > 0.0 ? m - 1 : m - 2);
            double h = Step(k);
            double b = (at - _at[k]) / h;
            double a = 1.0 - b;
            double[] one = Row(k);
            double[] two = Row(k + 1);
            double[] bend = _second[k];
            double[] next = _second[(k + 1) % m];
            double size = h * h / 6.0;
            for (int c = 0; c < values.Length; c++)
            {
                values[c] = a * one[c] + b * two[c]
                    + size * (a * (a * a - 1.0) * bend[c] + b * (b * b - 1.0) * next[c]);
            }
        }

        private double[] Row(int k) => _rows[(k + _rows.Length) % _rows.Length];

        // From row k to the next.
        private double Step(int k)
        {
            int m = _at.Length;
            k = (k + m) % m;
            return k + 1 < m ? _at[k + 1] - _at[k] : _at[0] + _period - _at[m - 1];
        }

        // Thomas's algorithm, with the unknowns before the first and behind the last given.
        private static double[] Solve(double[] lower, double[] diagonal, double[] upper, double[] right, double before,
            double behind)
        {
            int n = diagonal.Length;
            var u = (double[])right.Clone();
            u[0] -= lower[0] * before;
            u[n - 1] -= upper[n - 1] * behind;
            var pivot = new double[n];
            for (int i = 0; i < n; i++)
            {
                double factor = i > 0 ? lower[i] / pivot[i - 1] : 0.0;
                pivot[i] = diagonal[i] - (i > 0 ? factor * upper[i - 1] : 0.0);
                u[i] -= i > 0 ? factor * u[i - 1] : 0.0;
            }
            for (int i = n - 1; i >= 0; i--)
            {
                u[i] = (u[i] - (i < n - 1 ? upper[i] * u[i + 1] : 0.0)) / pivot[i];
            }
            return u;
        }
    }
}
