using System;

namespace Guidewire.Core
{
    /// <summary>How narrow the lumen of a mesh is: the smallest of the balls that touch the wall in the middle of a
    /// triangle, hold no other place of it, and were let grow.</summary>
    /// <remarks>By the shrinking ball (Ma, Bae and Choi 2012): from a ball that is too large, the nearest place q to
    /// its centre gives the one through p and q with the same normal, of radius |p - q|^2/(2 n . (q - p)), until no
    /// place is nearer than p. Where two faces meet in a fold that ball is small, in any lumen: so its centre then goes
    /// away from what is nearest as long as that gives it room at half of its speed at least, as it does out of a fold,
    /// and not along a lumen that grows wider slowly. Right to some 2 %.</remarks>
    internal static class MeshWidth
    {
        private const int MostTriangles = 20_000;
        private const int MostShrinks = 30;
        private const double Larger = 1.001;
        private const double LongestMove = 0.25;     // of the radius
        private const double ShortestMove = 0.01;
        private const double Shorter = 0.7;
        private const double LeastGrowth = 0.5;      // by way
        private const int MostMoves = 60;

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
                // A ball that is no smaller than the smallest so far is not shrunk to the end, nor let grow.
                double start = Math.Min(size, Larger * narrowest);
                double radius = Ball(mesh, t, start, out Vector3d centre);
                if (radius < Math.Min(start, narrowest))
                {
                    radius = Grown(mesh, centre, radius, narrowest);
                    narrowest = radius > above ? Math.Min(narrowest, radius) : narrowest;
                }
            }
            return narrowest;
        }

        private static double Ball(MeshGeometry mesh, int triangle, double start, out Vector3d centre)
        {
            Vector3d p = (1.0 / 3.0) * (mesh.Corners[3 * triangle] + mesh.Corners[3 * triangle + 1]
                + mesh.Corners[3 * triangle + 2]);
            Vector3d n = mesh.FaceNormals[triangle];
            double radius = start;
            int hint = triangle;
            centre = p + radius * n;
            for (int k = 0; k < MostShrinks; k++)
            {
                int nearest = mesh.Tree.Nearest(
                    centre, centre, radius, hint, out double squared, out _, out Vector3d q, out _);
                double towards = 2.0 * Vector3d.Dot(n, q - p);
                if (nearest < 0 || squared >= (1.0 - 1e-6) * radius * radius || !(towards > 0.0))
                {
                    return radius;
                }
                hint = nearest;
                radius = (q - p).LengthSquared / towards;
                centre = p + radius * n;
            }
            return radius;
        }

        // Up to a size from which on it does not matter.
        private static double Grown(MeshGeometry mesh, in Vector3d start, double radius, double enough)
        {
            Vector3d centre = start;
            double distance = Distance(mesh, centre, out Vector3d away);
            double move = LongestMove;
            for (int k = 0; k < MostMoves && move >= ShortestMove && distance < enough; k++)
            {
                double way = move * distance;
                Vector3d moved = centre + way * away;
                double grown = Distance(mesh, moved, out Vector3d next);
                if (grown >= distance + LeastGrowth * way)
                {
                    centre = moved;
                    distance = grown;
                    away = next;
                }
                else
                {
                    // Away from what is there, too.
                    away = Vector3d.Normalize(away + next);
                    move *= Shorter;
                }
            }
            return Math.Max(radius, distance);
        }

        private static double Distance(MeshGeometry mesh, in Vector3d x, out Vector3d away)
        {
            mesh.Tree.Nearest(x, x, double.PositiveInfinity, -1, out double squared, out _, out Vector3d q, out _);
            away = Vector3d.Normalize(x - q);
            return Math.Sqrt(squared);
        }
    }
}
