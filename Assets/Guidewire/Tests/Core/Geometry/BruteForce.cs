using System;
using System.Collections.Generic;

namespace Guidewire.Core.Tests
{
    /// <summary>Distances by enumeration, written apart from the code they check: the smallest distance over all pairs
    /// of features, each pair's by least squares on the plane or line through its corners.</summary>
    internal static class BruteForce
    {
        /// <summary>Distance of two simplices of one to three corners.</summary>
        public static double Distance(Vector3d[] p, Vector3d[] q)
        {
            double best = double.PositiveInfinity;
            foreach (Vector3d[] f in Features(p))
            {
                foreach (Vector3d[] g in Features(q))
                {
                    best = Math.Min(best, FreeDistance(f, g));
                }
            }
            return best;
        }

        /// <summary>Smallest distance of a segment to many triangles, three corners each.</summary>
        public static double Distance(Vector3d[] segment, Vector3d[] corners, out int nearest)
        {
            double best = double.PositiveInfinity;
            nearest = -1;
            for (int t = 0; 3 * t < corners.Length; t++)
            {
                double distance = Distance(
                    segment, new[] { corners[3 * t], corners[3 * t + 1], corners[3 * t + 2] });
                if (distance < best)
                {
                    best = distance;
                    nearest = t;
                }
            }
            return best;
        }

        /// <summary>Depth by which a segment overlaps a hull with these corners, edges and face normals: the smallest
        /// overlap over all axes on which two convex bodies can be distinguished; negative when they are
        /// apart.</summary>
        public static double Depth(
            Vector3d a, Vector3d b, Vector3d[] corners, IEnumerable<Vector3d> edges, IEnumerable<Vector3d> normals)
        {
            var axes = new List<Vector3d>(normals);
            foreach (Vector3d edge in edges)
            {
                axes.Add(Vector3d.Cross(edge, b - a));
            }
            double depth = double.PositiveInfinity;
            foreach (Vector3d axis in axes)
            {
                if (axis.Length < 1e-9)
                {
                    continue;
                }
                Vector3d n = Vector3d.Normalize(axis);
                double low = double.PositiveInfinity;
                double high = double.NegativeInfinity;
                foreach (Vector3d corner in corners)
                {
                    low = Math.Min(low, Vector3d.Dot(corner, n));
                    high = Math.Max(high, Vector3d.Dot(corner, n));
                }
                double first = Vector3d.Dot(a, n);
                double second = Vector3d.Dot(b, n);
                depth = Math.Min(depth, high - Math.Min(first, second));
                depth = Math.Min(depth, Math.Max(first, second) - low);
            }
            return depth;
        }

        private static IEnumerable<Vector3d[]> Features(Vector3d[] simplex)
        {
            for (int mask = 1; mask < 1 << simplex.Length; mask++)
            {
                var feature = new List<Vector3d>();
                for (int k = 0; k < simplex.Length; k++)
                {
                    if ((mask >> k & 1) == 1)
                    {
                        feature.Add(simplex[k]);
                    }
                }
                yield return feature.ToArray();
            }
        }

        // The free minimum over both features' parameters, or infinity when it lies outside one of them. Whatever the
        // conditioning, the value is the distance of two real points.
        private static double FreeDistance(Vector3d[] f, Vector3d[] g)
        {
            var columns = new List<Vector3d>();
            for (int k = 1; k < f.Length; k++)
            {
                columns.Add(f[k] - f[0]);
            }
            for (int k = 1; k < g.Length; k++)
            {
                columns.Add(g[0] - g[k]);
            }
            double[]? x = LeastSquares(columns, g[0] - f[0]);
            if (x == null)
            {
                return double.PositiveInfinity;
            }
            Vector3d difference = f[0] - g[0];
            double sumF = 0.0;
            double sumG = 0.0;
            for (int k = 0; k < x.Length; k++)
            {
                difference += x[k] * columns[k];
                sumF += k < f.Length - 1 ? x[k] : 0.0;
                sumG += k < f.Length - 1 ? 0.0 : x[k];
                if (x[k] < 0.0)
                {
                    return double.PositiveInfinity;
                }
            }
            return sumF <= 1.0 && sumG <= 1.0 ? difference.Length : double.PositiveInfinity;
        }

        // Modified Gram-Schmidt; null when the columns depend on one another: then a smaller feature holds a minimum
        // too.
        private static double[]? LeastSquares(List<Vector3d> columns, Vector3d right)
        {
            int n = columns.Count;
            if (n > 3)
            {
                return null;
            }
            var basis = new Vector3d[n];
            var upper = new double[n, n];
            var x = new double[n];
            for (int k = 0; k < n; k++)
            {
                Vector3d v = columns[k];
                for (int i = 0; i < k; i++)
                {
                    upper[i, k] = Vector3d.Dot(basis[i], v);
                    v -= upper[i, k] * basis[i];
                }
                upper[k, k] = v.Length;
                if (!(upper[k, k] > 1e-14 * columns[k].Length))
                {
                    return null;
                }
                basis[k] = v / upper[k, k];
                x[k] = Vector3d.Dot(basis[k], right);
                right -= x[k] * basis[k];
            }
            for (int k = n - 1; k >= 0; k--)
            {
                for (int i = k + 1; i < n; i++)
                {
                    x[k] -= upper[k, i] * x[i];
                }
                x[k] /= upper[k, k];
            }
            return x;
        }
    }
}
