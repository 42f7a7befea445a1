using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What a mesh must be to be a vessel: reported, repaired or refused.</summary>
    internal sealed class TriangleMeshTests
    {
        [Test]
        public void Mesh_IsTurnedSoThatItsNormalsPointIntoTheLumen()
        {
            TestMeshes outward = TestMeshes.Cube();
            TriangleMesh mesh = outward.Build();
            Assert.That(mesh.Report.TurnedInward, Is.EqualTo(outward.WindingNumber(Vector3d.Zero) > 0.0));
            Assert.That(mesh.Report.Volume, Is.EqualTo(8.0).Within(1e-12));
            for (int t = 0; t < mesh.Triangles.Count; t += 3)
            {
                Vector3d a = mesh.Vertices[mesh.Triangles[t]];
                Vector3d n = Vector3d.Cross(
                    mesh.Vertices[mesh.Triangles[t + 1]] - a, mesh.Vertices[mesh.Triangles[t + 2]] - a);
                Assert.That(Vector3d.Dot(n, a), Is.LessThan(0.0), "triangle " + t / 3);
            }
        }

        [Test]
        public void Mesh_OfLooseTriangles_IsWelded()
        {
            Vector3d[] corners = TestMeshes.Cube().Corners;
            var triangles = new int[corners.Length];
            for (int i = 0; i < triangles.Length; i++)
            {
                triangles[i] = i;
            }
            TriangleMesh mesh = TriangleMesh.Create(corners, triangles, Array.Empty<Vector3d>());
            Assert.That(mesh.Report.Vertices, Is.EqualTo(8));
            Assert.That(mesh.Report.WeldedVertices, Is.EqualTo(28));
        }

        [Test]
        public void TJunctions_AreNamedWithTheirPlace()
        {
            // Two sides of a plate, of which one has a corner at (1, 0, 0) within an edge of the other.
            Vector3d[] vertices =
            {
                new Vector3d(0.0, 0.0, 0.0), new Vector3d(2.0, 0.0, 0.0), new Vector3d(1.0, 1.0, 0.0),
                new Vector3d(1.0, 0.0, 0.0), new Vector3d(1.0, -1.0, 0.0),
            };
            int[] triangles = { 0, 1, 2, 0, 4, 3, 3, 4, 1 };
            Assert.That(() => TriangleMesh.Create(vertices, triangles, new[] { new Vector3d(1.0, 0.2, 0.0) }),
                Throws.TypeOf<MeshException>().With.Message.Contains("1 T-junction, at (1, 0, 0): a corner lies"));
        }

        [Test]
        public void Mesh_OfLooseTriangles_IsWeldedWhereCornersDifferByRounding()
        {
            // The tolerance is 1e-8 of the longest side, 2 units; 1e-6 of it is a slit that stays one.
            var random = new Random(1);
            Vector3d[] corners = TestMeshes.Cube().Corners;
            Assert.That(Loose(corners, 2e-9, random).Report.Vertices, Is.EqualTo(8));
            Assert.That(() => Loose(corners, 2e-6, random),
                Throws.TypeOf<MeshException>().With.Message.Contains("separate surfaces"));
        }

        [Test]
        public void Mesh_WithCoordinatesBeyondAnyVessel_IsRefusedByVertexAndPlace()
        {
            TestMeshes far = TestMeshes.Cube();
            far.Vertex(new Vector3d(1e300, 0.0, 0.0));
            Refused("far", far, "vertex 9 of 9 is at (1E+300, 0, 0): coordinates go up to 1e9 units");
        }

        [Test]
        public void Mesh_ThatGoesThroughItself_IsFoundWithThePlace()
        {
            Assert.That(new MeshShape(TestMeshes.Cube().Build()).CountSelfIntersections(out _), Is.EqualTo(0));
            Assert.That(new MeshShape(TestMeshes.Ball(12, 0.3).Build()).CountSelfIntersections(out _), Is.EqualTo(0));

            // Corner (-1, -1, -1) is pulled out through the face z = 1; only its edges can pierce that face.
            Vector3d[] vertices = TestMeshes.Cube().Vertices;
            vertices[0] = new Vector3d(0.4, 0.3, 3.0);
            var spiked = new MeshShape(
                TriangleMesh.Create(vertices, TestMeshes.Cube().Triangles, Array.Empty<Vector3d>()));
            Assert.That(spiked.CountSelfIntersections(out Vector3d place), Is.GreaterThan(0));
            Assert.That(place.Z, Is.EqualTo(1.0).Within(1e-12));
            Assert.That(Math.Max(Math.Abs(place.X), Math.Abs(place.Y)), Is.LessThan(1.0));
        }

        private static TriangleMesh Loose(Vector3d[] corners, double shift, Random random)
        {
            var triangles = new int[corners.Length];
            var moved = new Vector3d[corners.Length];
            for (int i = 0; i < triangles.Length; i++)
            {
                triangles[i] = i;
                moved[i] = corners[i] + (shift * (random.NextDouble() - 0.5)) * new Vector3d(1.0, -1.0, 1.0);
            }
            return TriangleMesh.Create(moved, triangles, Array.Empty<Vector3d>());
        }

        [Test]
        public void Mesh_WithSomeTrianglesTurned_IsTurnedBackAndCounted()
        {
            TestMeshes broken = TestMeshes.Cube();
            broken.Turn(3);
            broken.Turn(7);
            MeshReport report = broken.Build().Report;
            Assert.That(report.TurnedTriangles, Is.EqualTo(2));
            Assert.That(report.Volume, Is.EqualTo(8.0).Within(1e-12));
        }

        [Test]
        public void Mesh_WithCollapsedAndRepeatedTriangles_LosesThemAndCountsThem()
        {
            TestMeshes broken = TestMeshes.Cube();
            broken.Triangle(2, 2, 5);
            broken.Triangle(0, 1, 3);
            MeshReport report = broken.Build().Report;
            Assert.That(report.CollapsedTriangles, Is.EqualTo(1));
            Assert.That(report.RepeatedTriangles, Is.EqualTo(1));
            Assert.That(report.Triangles, Is.EqualTo(12));
        }

        [Test]
        public void Mesh_WithAFlatTriangleThatClosesIt_KeepsItAndCountsIt()
        {
            // The first triangle's edge 0-1 gets a vertex in its middle on one side only; a triangle without area
            // between the three closes the slit.
            TestMeshes split = TestMeshes.Cube();
            split.Remove(0);
            int middle = split.Vertex(new Vector3d(0.0, -1.0, -1.0));
            split.Triangle(0, middle, 3);
            split.Triangle(middle, 1, 3);
            split.Triangle(0, 1, middle);
            MeshReport report = split.Build().Report;
            Assert.That(report.FlatTriangles, Is.EqualTo(1));
            Assert.That(report.Volume, Is.EqualTo(8.0).Within(1e-12));
        }

        [Test]
        public void Mesh_WithNamedRims_IsAcceptedAndClosedForItsInside()
        {
            TestMeshes tube = TestMeshes.Tube(24, 10, 5.0);
            var shape = new MeshShape(tube.Build(Vector3d.Zero, new Vector3d(0.0, 0.0, 5.0)));
            Assert.That(shape.Report.OpenRims, Is.EqualTo(2));
            Assert.That(shape.Contains(new Vector3d(0.0, 0.0, 2.5)), Is.True);
            Assert.That(shape.Contains(new Vector3d(0.9, 0.0, 0.01)), Is.True);
            Assert.That(shape.Contains(new Vector3d(1.1, 0.0, 2.5)), Is.False);
            Assert.That(shape.Contains(new Vector3d(0.0, 0.0, -0.01)), Is.False);
            Assert.That(shape.Contains(new Vector3d(0.0, 0.0, 9.0)), Is.False);
        }

        [Test]
        public void Mesh_IsRefused_WithOneLineThatSaysWhy()
        {
            Refused("0 triangles", new TestMeshes(), "no triangles");
            TestMeshes open = TestMeshes.Cube();
            open.Remove(4);
            Refused("hole", open, "not watertight: it has 1 open rims and 0 are named");
            Refused("rim too many", TestMeshes.Cube(), "1 open rims are named, but the mesh has 0", Vector3d.Zero);
            TestMeshes single = new TestMeshes();
            single.Triangle(
                single.Vertex(Vector3d.Zero), single.Vertex(Vector3d.UnitX), single.Vertex(Vector3d.UnitY));
            Refused("one triangle", single, "not watertight");
            TestMeshes crowded = TestMeshes.Cube();
            crowded.Triangle(0, 1, crowded.Vertex(new Vector3d(0.0, -3.0, -3.0)));
            Refused("fin", crowded, "1 edges belong to more than two triangles");
            TestMeshes infinite = TestMeshes.Cube();
            infinite.Vertex(new Vector3d(double.NaN, 0.0, 0.0));
            Refused("not a number", infinite, "1 vertices have a coordinate that is not finite");
            TestMeshes wild = TestMeshes.Cube();
            wild.Triangle(0, 1, 99);
            Refused("wild", wild, "1 corners name a vertex that does not exist (there are 8)");
            Refused("one side", MoebiusStrip(), "not orientable");
        }

        [Test]
        public void Mesh_OfTwoSurfaces_IsRefused()
        {
            TestMeshes cube = TestMeshes.Cube();
            var vertices = new List<Vector3d>(cube.Vertices);
            var triangles = new List<int>(cube.Triangles);
            foreach (Vector3d vertex in cube.Vertices)
            {
                vertices.Add(vertex + new Vector3d(5.0, 0.0, 0.0));
            }
            foreach (int corner in cube.Triangles)
            {
                triangles.Add(corner + 8);
            }
            Assert.That(
                () => TriangleMesh.Create(vertices.ToArray(), triangles.ToArray(), Array.Empty<Vector3d>()),
                Throws.TypeOf<MeshException>().With.Message.Contains("2 separate surfaces"));
        }

        private static void Refused(string what, TestMeshes mesh, string message, params Vector3d[] rims)
        {
            Assert.That(
                () => mesh.Build(rims), Throws.TypeOf<MeshException>().With.Message.Contains(message), what);
        }

        private static TestMeshes MoebiusStrip()
        {
            var mesh = new TestMeshes();
            const int Count = 12;
            for (int i = 0; i < Count; i++)
            {
                double phi = 2.0 * Math.PI * i / Count;
                for (int side = -1; side <= 1; side += 2)
                {
                    double r = 3.0 + side * Math.Cos(0.5 * phi);
                    mesh.Vertex(new Vector3d(r * Math.Cos(phi), r * Math.Sin(phi), side * Math.Sin(0.5 * phi)));
                }
            }
            for (int i = 0; i < Count; i++)
            {
                int a = 2 * i;
                int b = 2 * i + 1;
                bool last = i == Count - 1;
                int c = last ? 1 : a + 2;
                int d = last ? 0 : b + 2;
                mesh.Triangle(a, b, c);
                mesh.Triangle(b, d, c);
            }
            return mesh;
        }
    }
}
