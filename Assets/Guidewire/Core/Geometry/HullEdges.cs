using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>The edges of the convex hull of some points.</summary>
    internal static class HullEdges
    {
        private const double MinAngle = 1e-6;   // radians, by which the hull turns at an edge

        /// <summary>An edge between two of the points; of a hull that is one point, from it to itself.</summary>
        public readonly struct Edge
        {
            /// <summary>Makes the edge from one point to another.</summary>
            public Edge(int start, int end, double angle)
            {
                Start = start;
                End = end;
                Angle = angle;
            }

            /// <summary>Number of a point.</summary>
            public int Start { get; }

            /// <summary>Number of a point.</summary>
            public int End { get; }

            /// <summary>The angle by which the hull's surface turns there, radians, 0 to pi.</summary>
            public double Angle { get; }
        }

        /// <summary>Finds every edge once.</summary>
        /// <remarks>Seen along the line through two points, the hull is a flat one; the line is an edge where it is a
        /// corner of that, so that all other points lie in a sector of less than half a turn.</remarks>
        /// <param name="points">One or more.</param>
        /// <param name="flatness">Distance below which points are one, or on one line, units.</param>
        public static Edge[] Find(Vector3d[] points, double flatness)
        {
            var edges = new List<Edge>();
            for (int i = 0; i < points.Length; i++)
            {
                for (int j = i + 1; j < points.Length; j++)
                {
                    Vector3d along = points[j] - points[i];
                    if (along.Length > flatness && Sector(points, i, j, flatness) is double sector
                        && Math.PI - sector > MinAngle)
                    {
                        edges.Add(new Edge(i, j, Math.PI - sector));
                    }
                }
            }
            if (edges.Count == 0)
            {
                edges.Add(new Edge(0, 0, Math.PI));
            }
            return edges.ToArray();
        }

        // The angle of the sector, seen from the line through two points, that holds all others, if it is less than
        // half a turn; none if another point lies between the two or is one of them under a lower number.
        private static double? Sector(Vector3d[] points, int i, int j, double flatness)
        {
            Vector3d along = Vector3d.Normalize(points[j] - points[i]);
            double length = Vector3d.Distance(points[i], points[j]);
            Vector3d first = Vector3d.Zero;
            Vector3d last = Vector3d.Zero;
            for (int k = 0; k < points.Length; k++)
            {
                Vector3d offset = points[k] - points[i];
                double at = Vector3d.Dot(offset, along);
                Vector3d ray = offset - at * along;
                if (k == i || k == j)
                {
                    continue;
                }
                if (ray.Length <= flatness)
                {
                    bool isBetween = at > flatness && at < length - flatness;
                    bool isStart = Math.Abs(at) <= flatness && k < i;
                    bool isEnd = Math.Abs(at - length) <= flatness && k < j;
                    if (isBetween || isStart || isEnd)
                    {
                        return null;
                    }
                    continue;
                }
                ray = Vector3d.Normalize(ray);
                if (first == Vector3d.Zero)
                {
                    first = ray;
                    last = ray;
                    continue;
                }
                bool isAfterFirst = Turn(first, ray, along) >= 0.0;
                bool isBeforeLast = Turn(ray, last, along) >= 0.0;
                if (isAfterFirst && isBeforeLast)
                {
                    // Inside, or more than a quarter of the circle behind both.
                    if (Vector3d.Dot(ray, first + last) < 0.0)
                    {
                        return null;
                    }
                    continue;
                }
                if (!isAfterFirst && !isBeforeLast)
                {
                    return null;
                }
                first = isAfterFirst ? first : ray;
                last = isAfterFirst ? ray : last;
            }
            return Math.Atan2(Turn(first, last, along), Vector3d.Dot(first, last));
        }

        private static double Turn(in Vector3d from, in Vector3d to, in Vector3d axis) =>
            Vector3d.Dot(Vector3d.Cross(from, to), axis);
    }
}
