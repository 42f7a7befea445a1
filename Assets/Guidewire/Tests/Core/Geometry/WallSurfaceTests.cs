using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class WallSurfaceTests
    {
        private const double Reach = 40.0;    // units

        private static IEnumerable<TestCaseData> Shapes()
        {
            yield return Named("plane", new PlaneShape(new Vector3d(1.0, 2.0, 3.0), new Vector3d(0.2, -1.0, 0.5)), 0.0);
            var knots = new[] { new Vector3d(0, 0, 0), new Vector3d(0, 0, 20), new Vector3d(0, 8, 38) };
            yield return Named("tube", new TubeShape(knots, new[] { 5.0, 5.0, 4.0 }, true, true), 0.3);
            yield return Named("ball", ConvexObstacle.Sphere(new Vector3d(3.0, 1.0, 0.0), 6.0), 0.1);
            yield return Named("capsule", ConvexObstacle.Capsule(Vector3d.Zero, new Vector3d(0.0, 9.0, 0.0), 4.0), 0.1);
            yield return Named("cone", ConeShape.Cone(Vector3d.UnitX, new Vector3d(0.0, 9.0, 3.0), 4.0, 1.0), 0.1);
            yield return Named("cylinder", ConeShape.Cylinder(Vector3d.UnitX, new Vector3d(0.0, 2.0, 1.0), 4.0), 0.1);
            Vector3d[] corners =
            {
                new Vector3d(0, 0, 0), new Vector3d(8, 0, 0), new Vector3d(8, 8, 0), new Vector3d(0, 8, 0),
                new Vector3d(0, 0, 8), new Vector3d(8, 0, 8), new Vector3d(8, 8, 8), new Vector3d(0, 8, 8),
            };
            int[] inward =
            {
                0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 5, 1, 0, 4, 5, 3, 2, 6, 3, 6, 7, 0, 3, 7, 0, 7, 4, 1, 5, 6,
                1, 6, 2,
            };
            TriangleMesh box = TriangleMesh.Create(corners, inward, Array.Empty<Vector3d>());
            yield return Named("mesh", new MeshShape(box), 0.0);
            var mirrored = new Placement(Vector3d.UnitX, Quaterniond.Identity, new Vector3d(-1.0, 1.0, 2.0));
            yield return Named("mirrored mesh", new MeshShape(box, mirrored), 0.0);
        }

        private static TestCaseData Named(string name, ContactShape shape, double facets) =>
            new TestCaseData(shape, facets).SetName("Surface_LiesOnTheWallAndLooksAtTheWire(" + name + ")");

        /// <param name="shape">The wall.</param>
        /// <param name="facets">Units by which a flat facet misses a round wall; 0 for flat walls.</param>
        [TestCaseSource(nameof(Shapes))]
        public void Surface_LiesOnTheWallAndLooksAtTheWire(ContactShape shape, double facets)
        {
            WallSurface surface = WallSurface.Create(shape, Vector3d.Zero, Reach);
            Assert.That(surface.Triangles, Is.Not.Empty);
            for (int t = 0; t < surface.Triangles.Count; t += 3)
            {
                Vector3d a = surface.Vertices[surface.Triangles[t]];
                Vector3d b = surface.Vertices[surface.Triangles[t + 1]];
                Vector3d c = surface.Vertices[surface.Triangles[t + 2]];
                Vector3d normal = Vector3d.Cross(b - a, c - a);
                if (normal.Length < 1e-9)
                {
                    continue;    // poles and corners, where facets have no area
                }
                Vector3d middle = (a + b + c) / 3.0;
                Vector3d step = (facets + 0.01) * Vector3d.Normalize(normal);
                Assert.That(shape.Contains(middle + step), Is.True, "triangle " + t / 3 + " at " + middle);
                Assert.That(shape.Contains(middle - step), Is.False, "triangle " + t / 3 + " at " + middle);
            }
        }
    }
}
