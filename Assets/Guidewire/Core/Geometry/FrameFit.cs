using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>The motion of a centreline that fits meshes of one topology, which are the vessel at one phase after
    /// another.</summary>
    /// <remarks>Vertices X near a point c of the centreline, weighed by exp(-|X - c|^2/(2 h^2)), are displaced by
    /// d + B v + b (t.v)^2, with v = X - c and the tangent t: least squares give d, B and b. h is the distance of the
    /// nearest vertex, or the points' spacing if that is longer. d is the displacement of the point. With F = 1 + B and
    /// S the shortest turn from t to F t, S^T F turns the section about t, by its angle across t, and scales it.
    /// </remarks>
    public static class FrameFit
    {
        private const int Terms = 5;
        private const double Negligible = 36.0;    // exponent of a weight beside the largest
        private const double Smallest = 1e-12;     // determinant of the normal equations, in lengths of h
        private const int MostVertices = 2000;     // that a misfit is found at, evenly spread
        private const double Farther = 1.1;        // than these, and it is looked at, too

        /// <summary>Gives the rows of <see cref="MotionCycle.Table"/> by frame.</summary>
        /// <param name="branches">Points of the centreline at rest, units.</param>
        /// <param name="spacing">Of them, units.</param>
        /// <param name="frames">Vertices at each phase, units; the first ones are those at rest.</param>
        /// <exception cref="ArgumentException">Near a point are too few vertices.</exception>
        public static double[][] Rows(IReadOnlyList<Vector3d[]> branches, double spacing, Vector3d[][] frames)
        {
            var rows = Array.ConvertAll(frames, _ => new List<double>());
            foreach (Vector3d[] branch in branches)
            {
                for (int k = 0; k < branch.Length; k++)
                {
                    AddRows(branch[k], Vector3d.Normalize(branch[Math.Min(k + 1, branch.Length - 1)]
                        - branch[Math.Max(k - 1, 0)]), spacing, frames, rows);
                }
            }
            return Array.ConvertAll(rows, row => row.ToArray());
        }

        /// <summary>How far vertices are from where a cycle takes those at rest, units: the root of the mean square,
        /// and the largest. Of a large mesh a part is looked at, and every vertex that goes farther than those.
        /// </summary>
        public static (double Mean, double Largest) Misfit(MotionCycle cycle, IReadOnlyList<Vector3d[]> branches,
            double spacing, Vector3d[][] frames)
        {
            var field = new WallField(new WallMotion(new[] { cycle.At(1.0, 0.0) }, branches, spacing, 0.0));
            int step = 1 + frames[0].Length / MostVertices;
            double sum = 0.0;
            double largest = 0.0;
            int count = 0;
            for (int p = 0; p < frames.Length; p++)
            {
                field.SetTime((double)p / frames.Length);
                double farthest = 0.0;
                for (int i = 0; i < frames[p].Length; i += step, count++)
                {
                    double miss = Vector3d.Distance(field.Moved(frames[0][i]), frames[p][i]);
                    sum += miss * miss;
                    largest = Math.Max(largest, miss);
                    farthest = Math.Max(farthest, Vector3d.Distance(frames[0][i], frames[p][i]));
                }
                for (int i = 0; i < frames[p].Length; i++)
                {
                    if (Vector3d.Distance(frames[0][i], frames[p][i]) > Farther * farthest)
                    {
                        largest = Math.Max(largest, Vector3d.Distance(field.Moved(frames[0][i]), frames[p][i]));
                    }
                }
            }
            return (Math.Sqrt(sum / count), largest);
        }

        private static void AddRows(in Vector3d c, in Vector3d t, double spacing, Vector3d[][] frames,
            List<double>[] rows)
        {
            double least = double.PositiveInfinity;
            foreach (Vector3d vertex in frames[0])
            {
                least = Math.Min(least, (vertex - c).LengthSquared);
            }
            double h = Math.Max(spacing, Math.Sqrt(least));
            var normal = new double[Terms, Terms];
            var right = Array.ConvertAll(frames, _ => new Vector3d[Terms]);
            var term = new double[Terms];
            for (int i = 0; i < frames[0].Length; i++)
            {
                Vector3d v = frames[0][i] - c;
                double over = 0.5 * (v.LengthSquared - least) / (h * h);
                if (!(over < Negligible))
                {
                    continue;
                }
                v = (1.0 / h) * v;
                double s = Vector3d.Dot(t, v);
                (term[0], term[1], term[2], term[3], term[4]) = (1.0, v.X, v.Y, v.Z, s * s);
                double weight = Math.Exp(-over);
                for (int m = 0; m < Terms; m++)
                {
                    for (int l = 0; l < Terms; l++)
                    {
                        normal[m, l] += weight * term[m] * term[l];
                    }
                    for (int p = 1; p < frames.Length; p++)
                    {
                        right[p][m] += (weight * term[m]) * (frames[p][i] - frames[0][i]);
                    }
                }
            }
            double[,] inverse = SquareMatrix.Inverse(normal, out double logOfDeterminant);
            if (!(logOfDeterminant > Math.Log(Smallest)))
            {
                throw new ArgumentException("has too few vertices near " + c + ", a point of the centreline");
            }
            for (int p = 0; p < frames.Length; p++)
            {
                AddRow(t, h, inverse, right[p], rows[p]);
            }
        }

        private static void AddRow(in Vector3d t, double h, double[,] inverse, Vector3d[] right, List<double> row)
        {
            var found = new Vector3d[Terms - 1];
            for (int m = 0; m < found.Length; m++)
            {
                for (int l = 0; l < Terms; l++)
                {
                    found[m] += ((m > 0 ? 1.0 / h : 1.0) * inverse[m, l]) * right[l];
                }
            }
            Matrix3 f = Matrix3.Identity + new Matrix3(found[1], found[2], found[3]);
            Vector3d along = f * t;
            Quaterniond turn = Quaterniond.Shortest(t, along);
            Vector3d one = Vector3d.Normalize(Vector3d.Cross(t, Math.Abs(t.X) < 0.5 ? Vector3d.UnitX : Vector3d.UnitY));
            Vector3d two = Vector3d.Cross(t, one);
            Vector3d first = Quaterniond.Rotate(turn.Conjugate, f * one);
            Vector3d second = Quaterniond.Rotate(turn.Conjugate, f * two);
            double sine = Vector3d.Dot(two, first) - Vector3d.Dot(one, second);
            double cosine = Vector3d.Dot(one, first) + Vector3d.Dot(two, second);
            Vector3d twist = Math.Atan2(sine, cosine) * Vector3d.Normalize(along);
            row.AddRange(new[]
            {
                found[0].X, found[0].Y, found[0].Z, twist.X, twist.Y, twist.Z,
                0.5 * Math.Sqrt(sine * sine + cosine * cosine) - 1.0,
            });
        }
    }
}
