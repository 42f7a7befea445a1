using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>A vessel's wall: one oriented surface of triangles whose normals point into the lumen, closed but for
    /// open rims that were named. Lengths in units.</summary>
    public sealed class TriangleMesh
    {
        private readonly MeshTopology _topology;

        private TriangleMesh(MeshTopology topology)
        {
            _topology = topology;
        }

        /// <summary>The vertices in units.</summary>
        public IReadOnlyList<Vector3d> Vertices => _topology.Vertices;

        /// <summary>Three indices of vertices a triangle; seen from the lumen they run counter-clockwise.</summary>
        public IReadOnlyList<int> Triangles => _topology.Triangles;

        /// <summary>What was found and repaired.</summary>
        public MeshReport Report => _topology.Report;

        /// <summary>Chains of vertices around the open rims.</summary>
        internal IReadOnlyList<int[]> Rims => _topology.Rims;

        /// <summary>The wall made of a file's triangles.</summary>
        /// <param name="vertices">Points in units, finite.</param>
        /// <param name="triangles">Three indices a triangle.</param>
        /// <param name="rimPoints">A point near the middle of each rim that may be open; every open rim must be the
        /// nearest one of exactly one of them.</param>
        /// <exception cref="MeshException">The triangles are not such a surface and cannot be made one
        /// unambiguously.</exception>
        public static TriangleMesh Create(Vector3d[] vertices, int[] triangles, Vector3d[] rimPoints)
        {
            MeshTopology topology = MeshTopology.Create(vertices, triangles);
            CheckRims(topology, rimPoints);
            topology.Report.OpenRims = topology.Rims.Count;
            double volume = SignedVolume(topology);
            if (!(Math.Abs(volume) > 0.0))
            {
                throw new MeshException("the surface encloses no volume, so it has no inside");
            }

            // Outward normals give a positive volume; a lumen's point inward.
            if (volume > 0.0)
            {
                topology.TurnAll();
                topology.Report.TurnedInward = true;
            }
            topology.Report.Volume = Math.Abs(volume);
            return new TriangleMesh(topology);
        }

        /// <summary>Middle of a rim: the mean of its vertices.</summary>
        internal static Vector3d RimCentre(Vector3d[] vertices, int[] rim)
        {
            Vector3d sum = Vector3d.Zero;
            foreach (int vertex in rim)
            {
                sum += vertices[vertex];
            }
            return sum / rim.Length;
        }

        private static void CheckRims(MeshTopology topology, Vector3d[] rimPoints)
        {
            List<int[]> rims = topology.Rims;
            var taken = new bool[rims.Count];
            foreach (Vector3d point in rimPoints)
            {
                int nearest = -1;
                double best = double.PositiveInfinity;
                for (int i = 0; i < rims.Count; i++)
                {
                    double distance = Vector3d.Distance(point, RimCentre(topology.Vertices, rims[i]));
                    nearest = distance < best ? i : nearest;
                    best = Math.Min(best, distance);
                }
                if (nearest < 0 || taken[nearest])
                {
                    throw new MeshException(string.Format(
                        CultureInfo.InvariantCulture, "{0} open rims are named, but the mesh has {1}",
                        rimPoints.Length, rims.Count));
                }
                taken[nearest] = true;
            }
            int unnamed = Array.FindIndex(taken, isTaken => !isTaken);
            if (unnamed >= 0)
            {
                Vector3d centre = RimCentre(topology.Vertices, rims[unnamed]);
                throw new MeshException(string.Format(
                    CultureInfo.InvariantCulture,
                    "the mesh is not watertight: it has {0} open rims and {1} are named; one of the others is around "
                    + "({2:G6}, {3:G6}, {4:G6})",
                    rims.Count, rimPoints.Length, centre.X, centre.Y, centre.Z));
            }
        }

        private static double SignedVolume(MeshTopology topology)
        {
            Vector3d[] v = topology.Vertices;
            int[] triangles = topology.Triangles;

            // Measured from a vertex, which keeps the digits of a mesh that lies far from the origin.
            Vector3d origin = v[0];
            double sum = 0.0;
            for (int t = 0; t < triangles.Length; t += 3)
            {
                sum += Determinant(
                    v[triangles[t]] - origin, v[triangles[t + 1]] - origin, v[triangles[t + 2]] - origin);
            }
            foreach (int[] rim in topology.Rims)
            {
                Vector3d centre = RimCentre(v, rim) - origin;
                for (int i = 0; i < rim.Length; i++)
                {
                    sum += Determinant(v[rim[(i + 1) % rim.Length]] - origin, v[rim[i]] - origin, centre);
                }
            }
            return sum / 6.0;
        }

        private static double Determinant(in Vector3d a, in Vector3d b, in Vector3d c) =>
            Vector3d.Dot(a, Vector3d.Cross(b, c));
    }

    /// <summary>A mesh that cannot be a vessel. The message is one line and names what is wrong, by count.</summary>
    public sealed class MeshException : Exception
    {
        /// <summary>Makes the exception with this line.</summary>
        public MeshException(string message)
            : base(message)
        {
        }
    }
}
