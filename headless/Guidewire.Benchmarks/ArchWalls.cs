namespace Guidewire.Benchmarks
{
    /// <summary>The vessel of <see cref="ArchPush"/>: a straight sheath, half a circle of radius 30 mm, and straight
    /// back, of radius 3 mm. Lengths in mm.</summary>
    internal static class ArchWalls
    {
        private const double BendRadius = 30.0;
        private const double LumenRadius = 3.0;
        private const double Sheath = 320.0;
        private const double Back = 200.0;
        private const int BendPieces = 40;
        private const int Rings = 625;      // with their sides 50,000 triangles
        private const int Sides = 40;

        /// <summary>As a tube in closed form.</summary>
        public static TubeShape Tube()
        {
            var knots = new Vector3d[BendPieces + 3];
            var radii = new double[knots.Length];
            Array.Fill(radii, LumenRadius);
            knots[0] = Centre(0.0, out _);
            for (int k = 0; k <= BendPieces; k++)
            {
                knots[k + 1] = Centre(Sheath + Math.PI * BendRadius * k / BendPieces, out _);
            }
            knots[BendPieces + 2] = Centre(Sheath + Math.PI * BendRadius + Back, out _);
            return new TubeShape(knots, radii, true, true);
        }

        /// <summary>As a mesh of some 50,000 triangles, open at both ends.</summary>
        public static MeshShape Mesh()
        {
            var vertices = new Vector3d[Rings * Sides];
            var triangles = new int[6 * (Rings - 1) * Sides];
            double length = Sheath + Math.PI * BendRadius + Back;
            int place = 0;
            for (int i = 0; i < Rings; i++)
            {
                Vector3d centre = Centre(length * i / (Rings - 1), out Vector3d across);
                for (int k = 0; k < Sides; k++)
                {
                    double angle = 2.0 * Math.PI * k / Sides;
                    vertices[i * Sides + k] = centre
                        + LumenRadius * (Math.Cos(angle) * across + Math.Sin(angle) * Vector3d.UnitX);
                    if (i > 0)
                    {
                        int next = (k + 1) % Sides;
                        int[] corners =
                        {
                            (i - 1) * Sides + k, i * Sides + next, (i - 1) * Sides + next,
                            (i - 1) * Sides + k, i * Sides + k, i * Sides + next,
                        };
                        corners.CopyTo(triangles, place);
                        place += corners.Length;
                    }
                }
            }
            return new MeshShape(TriangleMesh.Create(vertices, triangles,
                new[] { Centre(0.0, out _), Centre(length, out _) }));
        }

        // The centreline at an arc length, and the direction away from the bend's middle.
        private static Vector3d Centre(double at, out Vector3d across)
        {
            double angle = Math.Min(Math.PI, Math.Max(0.0, (at - Sheath) / BendRadius));
            double before = Math.Min(0.0, at - Sheath);
            double after = Math.Max(0.0, at - Sheath - Math.PI * BendRadius);
            across = new Vector3d(0.0, -Math.Cos(angle), Math.Sin(angle));
            return new Vector3d(0.0, BendRadius, before - after) + BendRadius * across;
        }
    }
}
