using System;

namespace Guidewire.Core
{
    /// <summary>How narrow the lumen of a mesh is: the smallest of the balls that touch the wall in the middle of a
    /// triangle and hold no other place of it.</summary>
    /// <remarks>By the shrinking ball (Ma, Bae and Choi 2012): from a ball that is too large, the nearest place q to
    /// its centre gives the one through p and q with the same normal, of radius |p - q|^2/(2 n . (q - p)), until no
    /// place is nearer than p.</remarks>
    internal static class MeshWidth
    {
        private const int MostTriangles = 20_000;
        private const int MostShrinks = 30;
        private const double Larger = 1.001;

        /// <summary>The smallest radius above the one given, units; infinite where there is none.</summary>
        public static double Narrowest(MeshGeometry mesh, double above)
        {
            int count = mesh.FaceNormals.Length;
            int stride = 1 + count / MostTriangles;
            double size = 0.0;
            foreach (Vector3d corner in mesh.Corners)
            {
                size = Math.Max(size, Vector3d.Distance(corner, mesh.Corners[0]));
            }
            double narrowest = double.PositiveInfinity;
            for (int t = 0; t < count; t += stride)
            {
                // A ball that is no smaller than the smallest so far is not shrunk to the end.
                double start = Math.Min(size, Larger * narrowest);
                double radius = Ball(mesh, t, start);
                if (radius > above && radius < start)
                {
                    narrowest = Math.Min(narrowest, radius);
                }
            }
            return narrowest;
        }

        private static double Ball(MeshGeometry mesh, int triangle, double start)
        {
            Vector3d p = (1.0 / 3.0) * (mesh.Corners[3 * triangle] + mesh.Corners[3 * triangle + 1]
                + mesh.Corners[3 * triangle + 2]);
            Vector3d n = mesh.FaceNormals[triangle];
            double radius = start;
            int hint = triangle;
            for (int k = 0; k < MostShrinks; k++)
            {
                Vector3d centre = p + radius * n;
                int nearest = mesh.Tree.Nearest(
                    centre, centre, radius, hint, out double squared, out _, out Vector3d q, out _);
                if (nearest < 0 || squared >= (1.0 - 1e-6) * radius * radius)
                {
                    return radius;
                }
                hint = nearest;
                double towards = 2.0 * Vector3d.Dot(n, q - p);
                if (!(towards > 0.0))
                {
                    return radius;
                }
                radius = (q - p).LengthSquared / towards;
            }
            return radius;
        }
    }
}
