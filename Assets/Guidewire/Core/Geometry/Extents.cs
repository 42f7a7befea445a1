using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>The box along the axes around some points or a wall, units.</summary>
    internal readonly struct Extents
    {
        /// <summary>The least coordinates.</summary>
        public readonly Vector3d Low;

        /// <summary>The largest coordinates.</summary>
        public readonly Vector3d High;

        /// <summary>Makes the box between two corners.</summary>
        public Extents(in Vector3d low, in Vector3d high)
        {
            Low = low;
            High = high;
        }

        /// <summary>The box's longest side.</summary>
        public double LargestSide => Math.Max(High.X - Low.X, Math.Max(High.Y - Low.Y, High.Z - Low.Z));

        /// <summary>The box around points, at least one.</summary>
        public static Extents Of(IReadOnlyList<Vector3d> points)
        {
            Vector3d low = points[0];
            Vector3d high = points[0];
            foreach (Vector3d p in points)
            {
                low = new Vector3d(Math.Min(low.X, p.X), Math.Min(low.Y, p.Y), Math.Min(low.Z, p.Z));
                high = new Vector3d(Math.Max(high.X, p.X), Math.Max(high.Y, p.Y), Math.Max(high.Z, p.Z));
            }
            return new Extents(low, high);
        }

        /// <summary>The box around a wall, for a tube without the continuation beyond its open ends; null for a plane,
        /// which is infinite.</summary>
        public static Extents? Of(ContactShape wall)
        {
            switch (wall)
            {
                case MeshShape mesh:
                    return Of(mesh.Wall.Corners);
                case TubeShape tube:
                    return OfSpheres(tube.Knots, tube.Radii, tube.FirstKnot, tube.LastKnot);
                case ConvexObstacle obstacle:
                    Extents box = Of(obstacle.Points);
                    Vector3d around = obstacle.Radius * new Vector3d(1.0, 1.0, 1.0);
                    return new Extents(box.Low - around, box.High + around);
                default:
                    return null;
            }
        }

        /// <summary>Gives both corners, to four digits.</summary>
        public override string ToString()
        {
            return string.Format(
                CultureInfo.InvariantCulture, "from ({0:G4}, {1:G4}, {2:G4}) to ({3:G4}, {4:G4}, {5:G4})",
                Low.X, Low.Y, Low.Z, High.X, High.Y, High.Z);
        }

        private static Extents OfSpheres(Vector3d[] centres, double[] radii, int first, int last)
        {
            var corners = new List<Vector3d>();
            for (int i = first; i <= last; i++)
            {
                Vector3d around = radii[i] * new Vector3d(1.0, 1.0, 1.0);
                corners.Add(centres[i] - around);
                corners.Add(centres[i] + around);
            }
            return Of(corners);
        }
    }
}
