using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>How narrow the lumen of a mesh is.</summary>
    internal sealed class MeshWidthTests
    {
        private const int Around = 32;
        private const int Rows = 100;
        private const double Length = 20.0;
        private const double Widest = 1.6;    // radii of a wire in which a throat limits its barriers
        private const int OneOf = 8;    // parts of the length that a rough tube has where campaigns do not run in full

        /// <summary>A throat of radius 0.3 in a tube of radius 1, seen by balls in the middle of triangles.</summary>
        [Test]
        public void Stenosis_IsAsNarrowAsItsThroat()
        {
            double narrowest = Width(Tube(z => 1.0 - 0.7 * Math.Exp(-(z - 10.0) * (z - 10.0))), 0.25);
            Assert.That(narrowest, Is.EqualTo(0.3).Within(0.02));
        }

        /// <summary>A wall remembers how narrow it is until it is placed anew.</summary>
        [Test]
        public void WallThatIsScaled_IsAsNarrowAsItIsThen()
        {
            TestMeshes tube = TestMeshes.Tube(16, 40, Length, RadiusOf("throat"));
            var wall = new MeshShape(tube.Build(Vector3d.Zero, Length * Vector3d.UnitZ), Placement.Identity);
            double radius = wall.NarrowestRadius(0.25, 0.4);
            Assert.That(radius, Is.EqualTo(0.3).Within(0.03));
            Assert.That(wall.NarrowestRadius(0.25, 0.4), Is.EqualTo(radius));
            Assert.That(wall.NarrowestRadius(0.25, 0.27), Is.EqualTo(double.PositiveInfinity));
            wall.Place(new Placement(Vector3d.Zero, Quaterniond.Identity, new Vector3d(2.0, 2.0, 2.0)));
            Assert.That(wall.NarrowestRadius(0.5, 0.8), Is.EqualTo(2.0 * radius).Within(1e-3 * radius));
            Assert.That(wall.NarrowestRadius(0.25, 0.4), Is.EqualTo(double.PositiveInfinity));
        }

        [Test]
        public void EvenTube_IsAsNarrowAsItsRadius() =>
            Assert.That(Width(Tube(_ => 1.0), 0.9), Is.EqualTo(Math.Cos(Math.PI / Around)).Within(0.02));

        /// <summary>Every corner off the wall by up to 2 %: folds of up to half a radian, in which small balls fit that
        /// touch two faces, and none of them is a bottleneck.</summary>
        [Test]
        public void RoughTube_IsNoNarrowerThanItsLumen()
        {
            int rows = RandomGeometry.Cases(Rows, OneOf);
            double length = Length * rows / Rows;
            TestMeshes rough = Rough(TestMeshes.Tube(Around, rows, length, _ => 1.0), 0.02, 5);
            foreach (double above in Rods.InFull ? new[] { 0.1, 0.3, 0.55 } : new[] { 0.3 })
            {
                Assert.That(Width(rough, above, length), Is.EqualTo(double.PositiveInfinity), "" + above);
            }
            Assert.That(Width(rough, 0.8, length), Is.InRange(0.85, 1.0));
        }

        /// <summary>The clearance of a wire of radius 0.25, whose half is what a barrier may reach, is that of the same
        /// surface however it is cut: by 4, by 16, at points and edges by chance with slivers of 1 in 200. Where
        /// campaigns do not run in full: as it is, and with slivers.</summary>
        [TestCase("throat", 0.3)]
        [TestCase("two throats, the first too narrow", 0.3)]
        [TestCase("taper", double.PositiveInfinity)]
        [TestCase("narrow inlet", 0.3)]
        [TestCase("steps that narrow", double.PositiveInfinity)]
        public void SameSurface_IsAsNarrow_HoweverItIsCut(string surface, double expected)
        {
            if (surface != "throat")
            {
                Rods.OnlyInFull("a throat, which is a bottleneck, and a rough tube, which has none");
            }
            TestMeshes tube = TestMeshes.Tube(16, 40, Length, RadiusOf(surface));
            var widths = new List<double> { Width(tube, 0.25), Width(Shattered(tube, 1), 0.25) };
            if (Rods.InFull)
            {
                widths.Add(Width(Shattered(tube.CutInFour(), 2), 0.25));
                widths.Add(Width(tube.CutInFour(), 0.25));
                widths.Add(Width(tube.CutInFour().CutInFour(), 0.25));
            }
            // Of a polygon of 16 sides the inscribed radius counts.
            double radius = expected * Math.Cos(Math.PI / 16);
            foreach (double width in widths)
            {
                Assert.That(width - 0.25, double.IsInfinity(expected) ? Is.GreaterThan(0.2)
                    : Is.EqualTo(radius - 0.25).Within(0.1 * (radius - 0.25)), string.Join(", ", widths));
            }
        }

        /// <summary>Half the clearance at the narrowest position, from a hundredth to 0.3 of a wire's radius, is that
        /// of the same surface however it is cut: of a vessel whose corners lie off a circle by up to 15 % by chance,
        /// whose folds have balls of every size.</summary>
        [Test]
        public void RoughVessel_HasOneClearance_HoweverItIsCut([Values(0.6, 0.8)] double radius)
        {
            Rods.OnlyInFull("surfaces that are cut otherwise, and the folds of a rough tube");
            for (int seed = 0; seed < 4; seed++)
            {
                TestMeshes vessel = Rough(TestMeshes.Tube(12, 12, 7.5, _ => 1.0), 0.15, seed);
                double expected = Distance(vessel, radius);
                Assert.That(Distance(vessel.CutInFour(), radius), Is.EqualTo(expected).Within(10).Percent, "" + seed);
                Assert.That(Distance(Shattered(vessel, seed), radius), Is.EqualTo(expected).Within(10).Percent,
                    "shattered " + seed);
            }
        }

        private static double Distance(TestMeshes vessel, double radius) =>
            Math.Min(0.3, Math.Max(0.01, 0.5 * (Width(vessel, radius, 7.5) - radius) / radius));

        // Every corner off the wall by up to a fraction, by chance.
        private static TestMeshes Rough(TestMeshes even, double fraction, int seed)
        {
            var random = new RandomGeometry(seed);
            var rough = new TestMeshes();
            foreach (Vector3d corner in even.Vertices)
            {
                double r = random.Number(1.0 - fraction, 1.0 + fraction);
                rough.Vertex(new Vector3d(r * corner.X, r * corner.Y, corner.Z));
            }
            int[] triangles = even.Triangles;
            for (int t = 0; t < triangles.Length; t += 3)
            {
                rough.Triangle(triangles[t], triangles[t + 1], triangles[t + 2]);
            }
            return rough;
        }

        private static Func<double, double> RadiusOf(string surface)
        {
            switch (surface)
            {
                case "throat":
                    return z => 1.0 - 0.7 * Bell(z - 10.0);
                case "two throats, the first too narrow":
                    return z => 1.0 - 0.8 * Bell(z - 5.0) - 0.7 * Bell(z - 14.0);
                case "taper":
                    return z => 1.0 - 0.04 * z;
                case "narrow inlet":
                    return z => 0.3 + 0.7 / (1.0 + Math.Exp(-2.0 * (z - 8.0)));
                default:
                    return z => 1.0 - 0.04 * z + 0.02 * Math.Sin(4.0 * z) * 0.5;
            }
        }

        private static double Bell(double z) => Math.Exp(-z * z);

        // Each triangle in three at a place by chance, some of them within 1/200 of a side.
        private static TestMeshes Shattered(TestMeshes mesh, int seed)
        {
            Vector3d[] x = mesh.Vertices;
            int[] old = mesh.Triangles;
            var random = new RandomGeometry(seed);
            var cut = new TestMeshes();
            Array.ForEach(x, vertex => cut.Vertex(vertex));
            for (int t = 0; t < old.Length; t += 3)
            {
                double a = random.Index(4) == 0 ? 0.005 : random.Number(0.1, 0.5);
                double b = random.Number(0.1, 0.4);
                cut.Vertex(a * x[old[t]] + b * x[old[t + 1]] + (1.0 - a - b) * x[old[t + 2]]);
                int middle = x.Length + t / 3;
                cut.Triangle(old[t], old[t + 1], middle);
                cut.Triangle(old[t + 1], old[t + 2], middle);
                cut.Triangle(old[t + 2], old[t], middle);
            }
            return cut;
        }

        private static TestMeshes Tube(Func<double, double> radius) => TestMeshes.Tube(Around, Rows, Length, radius);

        private static double Width(TestMeshes tube, double above, double length = Length)
        {
            var mesh = new MeshShape(tube.Build(Vector3d.Zero, length * Vector3d.UnitZ), Placement.Identity);
            return mesh.NarrowestRadius(above, Widest * above);
        }
    }
}
