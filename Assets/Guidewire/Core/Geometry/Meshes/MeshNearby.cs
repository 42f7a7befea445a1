using System;

namespace Guidewire.Core
{
    /// <summary>The triangles of a mesh near a segment, found once in the hierarchy and then asked by the balls around
    /// them.</summary>
    internal sealed class MeshNearby
    {
        private readonly MeshGeometry _mesh;
        private readonly Vector3d[] _centre;
        private readonly double[] _radius;

        /// <summary>For this mesh where it stands.</summary>
        public MeshNearby(MeshGeometry mesh)
        {
            _mesh = mesh;
            _centre = new Vector3d[mesh.Corners.Length / 3];
            _radius = new double[_centre.Length];
            for (int i = 0; i < _centre.Length; i++)
            {
                Vector3d centre = (1.0 / 3.0) * (mesh.Corners[3 * i] + mesh.Corners[3 * i + 1]
                    + mesh.Corners[3 * i + 2]);
                _centre[i] = centre;
                for (int k = 3 * i; k < 3 * i + 3; k++)
                {
                    _radius[i] = Math.Max(_radius[i], Vector3d.Distance(centre, mesh.Corners[k]));
                }
            }
        }

        /// <summary>Adds the triangles that may be within a range of segment a b.</summary>
        /// <returns>A distance than which none of them is nearer; infinite where there is none.</returns>
        public double Find(in Vector3d a, in Vector3d b, double range, StructList<int> triangles)
        {
            int from = triangles.Count;
            _mesh.Tree.Within(a, b, range, triangles);
            double nearest = double.PositiveInfinity;
            for (int k = from; k < triangles.Count; k++)
            {
                nearest = Math.Min(nearest, LeastDistance(a, b, triangles[k]));
            }
            return Math.Max(0.0, nearest);
        }

        /// <summary>Adds those of a range of triangles that may be within a distance of segment a b.</summary>
        public void Choose(in Vector3d a, in Vector3d b, double distance, FeatureRange among,
            StructList<int> triangles)
        {
            for (int k = among.From; k < among.To; k++)
            {
                if (LeastDistance(a, b, among[k]) <= distance)
                {
                    triangles.Add(among[k]);
                }
            }
        }

        /// <summary>Fraction of the motion of segment a b during which it stays at least <paramref name="keep"/> from
        /// every triangle of a range, as <see cref="Bvh.Sweep"/> has it.</summary>
        public double Sweep(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double keep,
            double resolution, FeatureRange among)
        {
            double impact = ContactShape.NoImpact;
            double motion = Math.Max(Vector3d.Distance(a0, a1), Vector3d.Distance(b0, b1));
            double reach = (keep + motion) * (1.0 + 1e-9);
            for (int k = among.From; k < among.To; k++)
            {
                int i = among[k];
                if (LeastDistance(a0, b0, i) <= reach)
                {
                    Bvh.SweepTriangle(_mesh.Corners[3 * i], _mesh.Corners[3 * i + 1], _mesh.Corners[3 * i + 2],
                        a0, b0, a1, b1, keep, resolution, motion, ref impact);
                }
            }
            return impact;
        }

        private double LeastDistance(in Vector3d a, in Vector3d b, int triangle)
        {
            Vector3d u = b - a;
            Vector3d offset = _centre[triangle] - a;
            double squared = u.LengthSquared;
            double s = squared > 0.0 ? Math.Min(1.0, Math.Max(0.0, Vector3d.Dot(offset, u) / squared)) : 0.0;
            return (offset - s * u).Length - _radius[triangle];
        }
    }
}
