using System;
using Guidewire.Core;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>How narrow the lumen of a mesh is.</summary>
    [TestFixture]
    internal sealed class MeshWidthTests
    {
        private const int Around = 32;
        private const int Rows = 100;
        private const double Length = 20.0;

        /// <summary>A throat of radius 0.3 in a tube of radius 1, seen by balls in the middle of triangles.</summary>
        [Test]
        public void Stenosis_IsAsNarrowAsItsThroat()
        {
            double narrowest = Width(Tube(z => 1.0 - 0.7 * Math.Exp(-(z - 10.0) * (z - 10.0))), 0.1);
            Assert.That(narrowest, Is.EqualTo(0.3).Within(0.02));
        }

        [Test]
        public void EvenTube_IsAsNarrowAsItsRadius()
        {
            Assert.That(Width(Tube(_ => 1.0), 0.1), Is.EqualTo(Math.Cos(Math.PI / Around)).Within(0.02));
        }

        /// <summary>Every corner off the wall by up to 2 %: folds of up to half a radian, in which small balls fit that
        /// touch two faces, and none of them is a bottleneck.</summary>
        [Test]
        public void RoughTube_IsNoNarrowerThanItsLumen()
        {
            TestMeshes even = Tube(_ => 1.0);
            var random = new RandomGeometry(5);
            var rough = new TestMeshes();
            foreach (Vector3d corner in even.Vertices)
            {
                double r = random.Number(0.98, 1.02);
                rough.Vertex(new Vector3d(r * corner.X, r * corner.Y, corner.Z));
            }
            int[] triangles = even.Triangles;
            for (int t = 0; t < triangles.Length; t += 3)
            {
                rough.Triangle(triangles[t], triangles[t + 1], triangles[t + 2]);
            }
            Assert.That(Width(rough, 0.05), Is.InRange(0.85, 1.0));
        }

        private static TestMeshes Tube(Func<double, double> radius)
        {
            return TestMeshes.Tube(Around, Rows, Length, radius);
        }

        private static double Width(TestMeshes tube, double above)
        {
            var mesh = new MeshShape(tube.Build(Vector3d.Zero, Length * Vector3d.UnitZ), Placement.Identity);
            return mesh.NarrowestRadius(above);
        }
    }
}
