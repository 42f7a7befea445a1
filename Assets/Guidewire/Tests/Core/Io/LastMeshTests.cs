using System;
using System.IO;
using Guidewire.Io;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The mesh that is kept from one run to the next: only where nothing of it has changed.</summary>
    internal sealed class LastMeshTests : FolderTests
    {
        private static readonly Vector3d[] NoRims = Array.Empty<Vector3d>();
        private static readonly Placement Moved = new Placement(
            new Vector3d(1.0, 0.0, 0.0), Quaterniond.Identity, new Vector3d(1.0, 1.0, 1.0));

        [Test]
        public void SameWall_IsKept_AndAnyOtherIsReadAnew()
        {
            string cube = Write("cube.obj", 1.0);
            string other = Write("other.obj", 1.0);
            var last = new LastMesh();
            MeshShape wall = last.Read(cube, 1.0, NoRims, Placement.Identity);
            AssertIsKept(last, cube, 1.0, Placement.Identity, wall, true);
            AssertIsKept(last, other, 1.0, Placement.Identity, wall, false);
            AssertIsKept(last, cube, 1.0, Placement.Identity, wall, false);
            MeshShape twice = last.Read(cube, 2.0, NoRims, Placement.Identity);
            Assert.That(twice.Report.Volume, Is.EqualTo(8.0 * wall.Report.Volume).Within(1e-9));
            AssertIsKept(last, cube, 2.0, Moved, twice, false);
            AssertIsKept(last, cube, 2.0, Moved, last.Read(cube, 2.0, NoRims, Moved), true);
        }

        [Test]
        public void WallsOfTwoRuns_HaveTrianglesInCommon_ButNeitherFrictionNorWhatQueriesLeave()
        {
            string cube = Write("cube.obj", 1.0);
            var last = new LastMesh();
            MeshShape before = last.Read(cube, 1.0, NoRims, Placement.Identity);
            before.FrictionCoefficient = 0.3;
            FeatureCache? queries = before.FeatureCacheFor(0.1);
            MeshShape after = last.Read(cube, 1.0, NoRims, Placement.Identity);
            Assert.That(after.Wall, Is.SameAs(before.Wall));
            Assert.That(after.FeatureCacheFor(0.1), Is.Not.SameAs(queries));
            after.FrictionCoefficient = 0.1;
            Assert.That(before.FrictionCoefficient, Is.EqualTo(0.3));
            Assert.That(before.FeatureCacheFor(0.1), Is.SameAs(queries));
        }

        [Test]
        public void WallsThatAreNotMoved_AreKeptBesideEachOther_AndOfTheMovedTheLast()
        {
            string cube = Write("cube.obj", 1.0);
            string other = Write("other.obj", 2.0);
            var last = new LastMesh(new KeptMeshes(6));
            MeshGeometry first = last.Read(cube, 1.0, NoRims, Placement.Identity).Wall;
            last.Read(other, 1.0, NoRims, Placement.Identity);
            MeshGeometry moved = last.Read(cube, 1.0, NoRims, Moved).Wall;
            Assert.That(last.Read(cube, 1.0, NoRims, Placement.Identity).Wall, Is.SameAs(first));
            Assert.That(last.Read(cube, 1.0, NoRims, Moved).Wall, Is.Not.SameAs(moved));
            Assert.That(last.Sha256, Has.Length.EqualTo(64));
        }

        [Test]
        public void WallElsewhere_AnswersAsOneThatIsMadeThere()
        {
            string cube = Write("cube.obj", 1.0);
            var placement = new Placement(new Vector3d(1.0, -2.0, 0.5),
                Placement.FromEulerDegrees(new Vector3d(20.0, 50.0, -70.0)), new Vector3d(1.3, 1.3, 1.3));
            MeshShape wall = new LastMesh(new KeptMeshes(2)).Read(cube, 1.0, NoRims, placement);
            var made = new MeshShape(MeshFile.Read(cube, 1.0, NoRims), placement);
            var random = new Random(3);
            Vector3d Point() => new Vector3d(4.0 * random.NextDouble() - 1.0, 4.0 * random.NextDouble() - 4.0,
                4.0 * random.NextDouble() - 1.5);
            for (int k = 0; k < 300; k++)
            {
                Vector3d a = Point();
                Vector3d b = a + 0.3 * (Point() - Point());
                int hint = -1;
                int other = -1;
                Assert.That(wall.Nearest(a, b, 9.0, ref hint, out SurfaceContact contact),
                    Is.EqualTo(made.Nearest(a, b, 9.0, ref other, out SurfaceContact expected)));
                Assert.That(contact.Distance, Is.EqualTo(expected.Distance).Within(1e-14));
                Assert.That(wall.Contains(a), Is.EqualTo(made.Contains(a)));
            }
        }

        [Test]
        public void Warp_MovesVertices_AsItsWavesSay()
        {
            string cube = Write("cube.obj", 1.0);
            var last = new LastMesh();
            Vector3d[] rest = last.Read(cube, 1.0, NoRims, Placement.Identity).Wall.Corners;
            double[] coefficients = { 0.5, -1.0, 0.0, 0.0, 1.0, 0.25, -0.75, 0.0, 1.0 };
            MeshShape warped = last.Read(cube, 1.0, NoRims, Placement.Identity, null, new SmoothWarp(coefficients));
            Extents box = Extents.Of(rest);
            double k = 2.0 * Math.PI / (box.High - box.Low).Length;
            Vector3d middle = 0.5 * (box.Low + box.High);
            for (int i = 0; i < rest.Length; i++)
            {
                Vector3d p = rest[i] - middle;
                double x = rest[i].X + 0.08 / k * (0.5 * Math.Sin(k * p.X) - Math.Sin(k * p.Y));
                double z = rest[i].Z + 0.08 / k * (-0.75 * Math.Sin(k * p.X) + Math.Sin(k * p.Z));
                Assert.That(warped.Wall.Corners[i].X, Is.EqualTo(x).Within(1e-14));
                Assert.That(warped.Wall.Corners[i].Z, Is.EqualTo(z).Within(1e-14));
            }
            Assert.That(last.Read(cube, 1.0, NoRims, Placement.Identity, null, new SmoothWarp(coefficients)).Wall,
                Is.SameAs(warped.Wall));
            Assert.That(last.Read(cube, 1.0, NoRims, Placement.Identity).Wall, Is.Not.SameAs(warped.Wall));
        }

        [Test]
        public void FileThatWasWrittenAnew_IsReadAnew_AlsoWithItsOldTime()
        {
            string file = Write("cube.obj", 1.0);
            DateTime time = File.GetLastWriteTimeUtc(file);
            var last = new LastMesh();
            double volume = last.Read(file, 1.0, NoRims, Placement.Identity).Report.Volume;
            Write("cube.obj", 3.0);
            File.SetLastWriteTimeUtc(file, time);
            Assert.That(last.Read(file, 1.0, NoRims, Placement.Identity).Report.Volume,
                Is.EqualTo(27.0 * volume).Within(1e-9));
        }

        [Test]
        public void FileThatCannotBeRead_IsRefused_AndTheNextOneIsRead()
        {
            string file = Write("cube.obj", 1.0);
            var last = new LastMesh();
            last.Read(file, 1.0, NoRims, Placement.Identity);
            string good = File.ReadAllText(file);
            File.WriteAllText(file, "v 0 0 0\n");
            Assert.That(() => last.Read(file, 1.0, NoRims, Placement.Identity),
                Throws.TypeOf<ParameterException>().With.Message.Contains("has no triangles"));
            File.WriteAllText(file, good);
            Assert.That(last.Read(file, 1.0, NoRims, Placement.Identity).Report.Triangles, Is.EqualTo(12));
        }

        // Only the last one is.
        private static void AssertIsKept(LastMesh last, string file, double scale, in Placement placement,
            MeshShape wall, bool isKept)
        {
            MeshGeometry found = last.Read(file, scale, NoRims, placement).Wall;
            Assert.That(found, isKept ? Is.SameAs(wall.Wall) : Is.Not.SameAs(wall.Wall));
        }

        private string Write(string name, double size)
        {
            using var text = new StringWriter();
            TestMeshes cube = TestMeshes.Cube();
            foreach (Vector3d vertex in cube.Vertices)
            {
                text.WriteLine(FormattableString.Invariant(
                    $"v {size * vertex.X} {size * vertex.Y} {size * vertex.Z}"));
            }
            for (int k = 0; k < cube.Triangles.Length; k += 3)
            {
                text.WriteLine($"f {cube.Triangles[k] + 1} {cube.Triangles[k + 1] + 1} {cube.Triangles[k + 2] + 1}");
            }
            string file = Path.Combine(Folder, name);
            File.WriteAllText(file, text.ToString());
            return file;
        }
    }
}
