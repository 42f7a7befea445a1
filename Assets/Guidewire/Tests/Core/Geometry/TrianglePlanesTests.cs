using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What the four planes of a triangle leave out, against exact distances; needles are among the triangles,
    /// and half of them lie a thousand times their size from the origin.</summary>
    internal sealed class TrianglePlanesTests
    {
        private const double Far = 1000.0;

        [Test]
        public void MayBeWithin_LeavesOutNoTriangle_ThatIsWithinTheDistance()
        {
            AssertLeavesOutNone(41, (random, t, offset) =>
            {
                Vector3d x = random.Point() + offset;
                double distance = Math.Sqrt(ClosestPoints.PointTriangle(x, t[0], t[1], t[2], out _, out _));
                return (distance, asked => new TrianglePlanes(t).MayBeWithin(x, asked, 0));
            });
        }

        [TestCase(1.0)]
        [TestCase(1e-3)]    // a vessel in metres, given in units of a metre
        [TestCase(1e3)]
        public void MinDistance_IsALowerBound_ThatIsTheDistanceOverFacesAndEdges(double scale)
        {
            var random = new RandomGeometry(43);
            int cases = RandomGeometry.Cases(35_000);
            int tight = 0;
            for (int i = 0; i < cases; i++)
            {
                Vector3d[] unit = Placed(random, random.Triangle(), out Vector3d offset);
                Vector3d[] t = Array.ConvertAll(unit, corner => scale * corner);
                Vector3d x = random.Index(8) == 0 ? Vector3d.Lerp(t[0], t[1], random.Number(0.0, 1.0))
                    : scale * (random.Point() + offset);
                double distance = Math.Sqrt(ClosestPoints.PointTriangle(x, t[0], t[1], t[2], out _, out int feature));
                double least = new TrianglePlanes(t).MinDistance(x, 0);
                Assert.That(least, Is.LessThanOrEqualTo(distance), "case " + i);
                if (feature < ClosestPoints.Corner)
                {
                    tight += least > distance - 1e-8 * scale ? 1 : 0;
                }
            }
            Assert.That(tight, Is.GreaterThan(cases / 4));
        }

        [Test]
        public void MayMeet_LeavesOutNoTriangle_ThatThePathComesWithinTheDistanceOf()
        {
            AssertLeavesOutNone(42, (random, t, offset) =>
            {
                Vector3d from = random.Point() + offset;
                Vector3d to = from + random.Number(0.0, 1.0) * random.Point();
                double distance = Math.Sqrt(ClosestPoints.SegmentTriangle(
                    from, to, t[0], t[1], t[2], double.PositiveInfinity, out _, out _, out _));
                return (distance, asked => new TrianglePlanes(t).MayMeet(from, to, asked, 0));
            });
        }

        [Test]
        public void PointsOverAFace_AreLeftOutFromTheirHeightOn()
        {
            var t = new[] { Vector3d.Zero, 2.0 * Vector3d.UnitX, 2.0 * Vector3d.UnitY };
            var planes = new TrianglePlanes(t);
            var over = new Vector3d(0.5, 0.5, 1.0);
            var beside = new Vector3d(-0.6, 0.5, 0.8);    // at a distance of 1 from an edge
            Assert.That(planes.MayBeWithin(over, 1.0, 0), Is.True);
            Assert.That(planes.MayBeWithin(over, 0.999, 0), Is.False);
            Assert.That(planes.MayBeWithin(beside, 1.0, 0), Is.True);
            Assert.That(planes.MayBeWithin(beside, 0.999, 0), Is.False);
            Assert.That(planes.MayMeet(over, over - 0.5 * Vector3d.UnitZ, 0.499, 0), Is.False);
            Assert.That(planes.MayMeet(over, over - 2.0 * Vector3d.UnitZ, 0.499, 0), Is.True);
        }

        // Of a triangle and where it is placed: the exact distance, and whether one asked for may be within reach.
        private static void AssertLeavesOutNone(int seed,
            Func<RandomGeometry, Vector3d[], Vector3d, (double Distance, Func<double, bool> MayBe)> draw)
        {
            var random = new RandomGeometry(seed);
            int kept = 0;
            int leftOut = 0;
            for (int i = 0; i < RandomGeometry.Cases(100_000); i++)
            {
                Vector3d[] t = Placed(random, random.Triangle(), out Vector3d offset);
                (double distance, Func<double, bool> mayBe) = draw(random, t, offset);
                double asked = random.Index(2) == 0 ? distance : random.Number(0.0, 1.0);
                bool isKept = mayBe(asked);
                Assert.That(isKept || distance > asked, Is.True, "case " + i + ": " + distance + " of " + asked);
                kept += isKept ? 1 : 0;
                leftOut += isKept ? 0 : 1;
            }
            Assert.That(leftOut, Is.GreaterThan(kept / 10));
        }

        private static Vector3d[] Placed(RandomGeometry random, Vector3d[] triangle, out Vector3d offset)
        {
            Vector3d move = random.Index(2) == 0 ? Vector3d.Zero : Far * random.Point();
            offset = move;
            return Array.ConvertAll(triangle, corner => corner + move);
        }
    }
}
