using System;
using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
#endif

namespace Guidewire.Core
{
    /// <summary>Four planes of each triangle of a mesh, tested at once: its own, and those through its edges across it.
    /// Triangles that are surely farther from a point than a distance, or from all of its straight path, are left out
    /// by them before closest points are searched for.</summary>
    /// <remarks>A point with height h over the triangle and e over one of its edges, in its plane and negative outside,
    /// is no nearer to it than sqrt(h^2 + min(0, e)^2). Needles, whose normals have few digits, are never left
    /// out.</remarks>
    internal sealed class TrianglePlanes
    {
        private const int Lanes = 4;
        private const int Stride = 4 * Lanes;        // normals by component, offsets
        private const double RoundedUp = 1.0 + 1e-9;
        private const double OfCoordinates = 1e-14;
        private const double OfEdges = 1e-11;        // that of a normal next to a needle's
        private readonly double[] _planes;           // by triangle
        private readonly double _rounding;           // of a height at most, units

        /// <summary>Makes the planes of triangles with three corners each, units.</summary>
        public TrianglePlanes(Vector3d[] corners)
        {
            _planes = new double[Stride * (corners.Length / 3)];
            double largest = 0.0;
            double longest = 0.0;
            for (int t = 0; t < corners.Length / 3; t++)
            {
                Vector3d n = Vector3d.Cross(corners[3 * t + 1] - corners[3 * t], corners[3 * t + 2] - corners[3 * t]);
                bool isNeedle = ClosestPoints.IsNeedle(
                    n.LengthSquared, corners[3 * t + 1] - corners[3 * t], corners[3 * t + 2] - corners[3 * t]);
                n = isNeedle ? Vector3d.Zero : Vector3d.Normalize(n);
                Put(t, 0, n, corners[3 * t]);
                for (int k = 0; k < 3; k++)
                {
                    Vector3d from = corners[3 * t + k];
                    Vector3d along = corners[3 * t + (k + 1) % 3] - from;
                    Put(t, k + 1, isNeedle ? Vector3d.Zero : Vector3d.Normalize(Vector3d.Cross(n, along)), from);
                    largest = Math.Max(largest, from.LengthSquared);
                    longest = Math.Max(longest, along.LengthSquared);
                }
            }
            _rounding = OfCoordinates * Math.Sqrt(largest) + OfEdges * Math.Sqrt(longest);
        }

        /// <summary>False where a triangle is surely farther from a point than a distance, units.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool MayBeWithin(in Vector3d x, double distance, int triangle)
        {
            double limit = RoundedUp * distance + _rounding;
            return SquaredBound(x, triangle) <= limit * limit;
        }

        /// <summary>Lower bound of a triangle's distance from a point, units; negative where none is known.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public double MinDistance(in Vector3d x, int triangle) =>
            (Math.Sqrt(SquaredBound(x, triangle)) - _rounding) / RoundedUp;

        /// <summary>False where a point that moves in a straight line stays beyond one of a triangle's planes by more
        /// than a distance, units.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public bool MayMeet(in Vector3d from, in Vector3d to, double distance, int triangle)
        {
            double limit = RoundedUp * distance + _rounding;
#if NET8_0_OR_GREATER
            Vector256<double> start = Heights(from, triangle);
            Vector256<double> end = Heights(to, triangle);
            return !Vector256.LessThanAny(Vector256.Max(start, end), Vector256.Create(-limit))
                && !(Math.Min(start[0], end[0]) > limit);
#else
            for (int k = 0; k < Lanes; k++)
            {
                double start = Height(from, triangle, k);
                double end = Height(to, triangle, k);
                if (Math.Max(start, end) < -limit || (k == 0 && Math.Min(start, end) > limit))
                {
                    return false;
                }
            }
            return true;
#endif
        }

        // Square of a lower bound of the distance, but for rounding.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private double SquaredBound(in Vector3d x, int triangle)
        {
#if NET8_0_OR_GREATER
            Vector256<double> heights = Heights(x, triangle);
            double height = heights[0];
            double outside = Math.Min(Math.Min(0.0, heights[1]), Math.Min(heights[2], heights[3]));
#else
            double height = Height(x, triangle, 0);
            double outside = Math.Min(Math.Min(0.0, Height(x, triangle, 1)),
                Math.Min(Height(x, triangle, 2), Height(x, triangle, 3)));
#endif
            return height * height + outside * outside;
        }

#if NET8_0_OR_GREATER
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private Vector256<double> Heights(in Vector3d x, int triangle)
        {
            ref double first = ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_planes), Stride * triangle);
            return Vector256.LoadUnsafe(ref first) * x.X + Vector256.LoadUnsafe(ref Unsafe.Add(ref first, Lanes)) * x.Y
                + Vector256.LoadUnsafe(ref Unsafe.Add(ref first, 2 * Lanes)) * x.Z
                - Vector256.LoadUnsafe(ref Unsafe.Add(ref first, 3 * Lanes));
        }
#else
        private double Height(in Vector3d x, int triangle, int plane)
        {
            int at = Stride * triangle + plane;
            return _planes[at] * x.X + _planes[at + Lanes] * x.Y + _planes[at + 2 * Lanes] * x.Z
                - _planes[at + 3 * Lanes];
        }
#endif

        private void Put(int triangle, int plane, in Vector3d normal, in Vector3d point)
        {
            int at = Stride * triangle + plane;
            _planes[at] = normal.X;
            _planes[at + Lanes] = normal.Y;
            _planes[at + 2 * Lanes] = normal.Z;
            _planes[at + 3 * Lanes] = Vector3d.Dot(normal, point);
        }
    }
}
