using System;

namespace Guidewire.Core
{
    /// <summary>Smallest width of the lumen of a mesh, found by walks along it (<see
    /// cref="LumenWalk"/>) that start from balls touching the wall.</summary>
    /// <remarks>The balls are those of the shrinking ball (Ma, Bae and Choi 2012): starting with one that is too large,
    /// the wall point q nearest to its centre gives the ball through p and q with the same normal, of radius |p -
    /// q|^2/(2 n . (q - p)), until no point is nearer than p. The points p are spread evenly over the wall's area, and
    /// no walk starts from balls no smaller than the narrowest so far: so the same surface has the same width however
    /// it is triangulated.</remarks>
    internal static class MeshWidth
    {
        private const int MaxSamples = 600_000;
        private const int MinSamples = 2_000;
        private const double SamplesOverRadius = 2.0;    // in a square of the least radius
        private const double SmallestSphere = 0.7;            // of that radius: smaller balls lie in folds of the wall
        private const int MaxShrinks = 30;
        private const double Converged = 2e-3;    // of a ball's radius squared
        private const double MinRadius = 1e-6;    // of the mesh's size, for a radius

        /// <summary>The smallest radius between two, units; infinite where there is none.</summary>
        public static double Narrowest(ContactShape wall, MeshGeometry mesh, double above, double below)
        {
            double area = 0.0;
            double size = 0.0;
            for (int t = 0; t < mesh.FaceNormals.Length; t++)
            {
                area += Area(mesh, t);
                size = Math.Max(size, Vector3d.Distance(mesh.Corners[3 * t], mesh.Corners[0]));
            }
            double least = Math.Max(above, MinRadius * size);
            double samples = SamplesOverRadius * area / (least * least);
            double cell = area / Math.Min(Math.Max(samples, MinSamples), MaxSamples);
            var walk = new LumenWalk(wall, least);
            double narrowest = below;
            double covered = 0.5 * cell;
            for (int t = 0; t < mesh.FaceNormals.Length; t++)
            {
                covered += Area(mesh, t);
                if (covered < cell)
                {
                    continue;
                }
                int rows = (int)Math.Ceiling(Math.Sqrt(Math.Floor(covered / cell)));
                covered %= cell;
                for (int k = 0; k < rows * rows; k++)
                {
                    double start = Math.Min(size, narrowest);
                    double radius = Ball(mesh, t, PlaceOn(mesh, t, k, rows), start, out Vector3d centre);
                    if (radius < start && radius > SmallestSphere * least)
                    {
                        narrowest = Math.Min(narrowest, walk.From(centre, start));
                    }
                }
            }
            return narrowest < below ? narrowest : double.PositiveInfinity;
        }

        private static double Area(MeshGeometry mesh, int triangle)
        {
            Vector3d a = mesh.Corners[3 * triangle];
            return 0.5 * Vector3d.Cross(mesh.Corners[3 * triangle + 1] - a, mesh.Corners[3 * triangle + 2] - a).Length;
        }

        // The middle of the k-th of rows^2 equal parts of a triangle: in row i 2 i + 1 of them, alternately upright and
        // inverted.
        private static Vector3d PlaceOn(MeshGeometry mesh, int triangle, int k, int rows)
        {
            int i = (int)Math.Sqrt(k + 0.5);
            int j = k - i * i;
            bool isUpright = j % 2 == 0;
            double u = (i - j / 2 + (isUpright ? 1.0 : -1.0) / 3.0) / rows;
            double v = (j / 2 + (isUpright ? 1.0 : 2.0) / 3.0) / rows;
            Vector3d a = mesh.Corners[3 * triangle];
            return a + u * (mesh.Corners[3 * triangle + 1] - a)
                + v * (mesh.Corners[3 * triangle + 2] - a);
        }

        private static double Ball(MeshGeometry mesh, int triangle, in Vector3d p, double start, out Vector3d centre)
        {
            Vector3d n = mesh.FaceNormals[triangle];
            double radius = start;
            int hint = triangle;
            centre = p + radius * n;
            for (int k = 0; k < MaxShrinks; k++)
            {
                int nearest = mesh.Tree.Nearest(
                    centre, centre, radius, hint, out double squared, out _, out Vector3d q, out _);
                double towards = 2.0 * Vector3d.Dot(n, q - p);
                if (nearest < 0 || squared >= (1.0 - Converged) * radius * radius || !(towards > 0.0))
                {
                    return radius;
                }
                hint = nearest;
                radius = (q - p).LengthSquared / towards;
                centre = p + radius * n;
            }
            return radius;
        }
    }
}
