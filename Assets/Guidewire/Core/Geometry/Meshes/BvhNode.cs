using System.Runtime.CompilerServices;
using System;

namespace Guidewire.Core
{
    /// <summary>A box of the hierarchy, with the slab between two planes across the mean normal of its triangles: a
    /// patch of wall is nearly flat, so the slab is thinner than any box or ball around it.</summary>
    internal struct BvhNode
    {
        /// <summary>Middle of the box.</summary>
        public Vector3d Centre;

        /// <summary>Half the box's edges.</summary>
        public Vector3d Extent;

        /// <summary>Mean normal of the triangles, 0 where they have none.</summary>
        public Vector3d Normal;

        /// <summary>Least Normal.x over the triangles.</summary>
        public double Low;

        /// <summary>Largest Normal.x over the triangles.</summary>
        public double High;

        /// <summary>First triangle of a leaf; else the first of two children, which stand side by side.</summary>
        public int First;

        /// <summary>Triangles of a leaf; 0 for a node with children.</summary>
        public int Count;

        /// <summary>The node that this one is a child of; 0 for the first node itself.</summary>
        public int Parent;

        /// <summary>Makes the box hold <paramref name="count"/> points.</summary>
        public void Enclose(Vector3d[] points, int first, int count)
        {
            Vector3d low = points[first];
            Vector3d high = low;
            for (int k = first + 1; k < first + count; k++)
            {
                low = Min(low, points[k]);
                high = Max(high, points[k]);
            }
            Set(low, high);
        }

        /// <summary>Makes the box hold two others.</summary>
        public void Enclose(in BvhNode left, in BvhNode right)
        {
            Set(
                Min(left.Centre - left.Extent, right.Centre - right.Extent),
                Max(left.Centre + left.Extent, right.Centre + right.Extent));
        }

        /// <summary>Makes the box hold a moving segment and all within a distance of it.</summary>
        public void EncloseSwept(
            in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double distance)
        {
            var border = new Vector3d(distance, distance, distance);
            Set(Min(Min(a0, b0), Min(a1, b1)) - border, Max(Max(a0, b0), Max(a1, b1)) + border);
        }

        /// <summary>Makes the slab hold <paramref name="count"/> points.</summary>
        public void EncloseSlab(in Vector3d normal, Vector3d[] points, int first, int count)
        {
            Normal = Vector3d.Normalize(normal);
            Low = double.PositiveInfinity;
            High = double.NegativeInfinity;
            for (int k = first; k < first + count; k++)
            {
                double height = Vector3d.Dot(Normal, points[k]);
                Low = Math.Min(Low, height);
                High = Math.Max(High, height);
            }
            double border = 1e-15 * (Centre.Length + Extent.Length);
            Low -= border;
            High += border;
        }

        /// <summary>Makes the slab hold all of the box.</summary>
        public void EncloseSlabOfBox(in Vector3d normal)
        {
            Normal = Vector3d.Normalize(normal);
            double middle = Vector3d.Dot(Normal, Centre);
            double half = Math.Abs(Normal.X) * Extent.X + Math.Abs(Normal.Y) * Extent.Y
                + Math.Abs(Normal.Z) * Extent.Z + 1e-15 * (Centre.Length + Extent.Length);
            Low = middle - half;
            High = middle + half;
        }

        /// <summary>Is true where two boxes share a point.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool Overlaps(in BvhNode other)
        {
            return Math.Abs(Centre.X - other.Centre.X) <= Extent.X + other.Extent.X
                && Math.Abs(Centre.Y - other.Centre.Y) <= Extent.Y + other.Extent.Y
                && Math.Abs(Centre.Z - other.Centre.Z) <= Extent.Z + other.Extent.Z;
        }

        public static Vector3d Min(in Vector3d a, in Vector3d b) =>
            new Vector3d(Math.Min(a.X, b.X), Math.Min(a.Y, b.Y), Math.Min(a.Z, b.Z));

        public static Vector3d Max(in Vector3d a, in Vector3d b) =>
            new Vector3d(Math.Max(a.X, b.X), Math.Max(a.Y, b.Y), Math.Max(a.Z, b.Z));

        // Middle and half edge round; the border of some units in the last place makes up for it, or a triangle that
        // fills its box could be left out of a search.
        private void Set(in Vector3d low, in Vector3d high)
        {
            Centre = 0.5 * (low + high);
            Vector3d size = Max(Max(low, high), Max(-low, -high));
            Extent = 0.5 * (high - low) + 1e-15 * size;
        }
    }
}
