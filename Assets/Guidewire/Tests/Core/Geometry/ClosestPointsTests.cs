using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Closest points against enumeration over features, and the degenerate cases one by one.</summary>
    internal sealed class ClosestPointsTests
    {
        // Figures have size 1; the promise is 1e-9 of the size.
        private const double Tolerance = 1e-9;

        private static readonly Vector3d Origin = Vector3d.Zero;
        private static readonly Vector3d X = Vector3d.UnitX;
        private static readonly Vector3d Y = Vector3d.UnitY;
        private static readonly Vector3d Z = Vector3d.UnitZ;

        [Test]
        public void SegmentTriangle_AgreesWithEnumeration_OnRandomPairs()
        {
            RandomGeometry.AssertErrors(1, Tolerance, random =>
            {
                Vector3d[] t = random.Triangle();
                Vector3d[] s = random.Segment(t[random.Index(2) + 1] - t[0]);
                double distance = SegmentTriangle(s[0], s[1], t, out double position, out Vector3d c, out int feature);
                double direct = Vector3d.Distance(Vector3d.Lerp(s[0], s[1], position), c);
                return Math.Max(Math.Abs(distance - BruteForce.Distance(s, t)),
                    Math.Max(Math.Abs(distance - direct), BruteForce.Distance(new[] { c }, FeatureOf(t, feature))));
            });
        }

        [Test]
        public void PointTriangle_AgreesWithEnumeration_OnRandomPairs()
        {
            RandomGeometry.AssertErrors(2, Tolerance, random =>
            {
                Vector3d[] t = random.Triangle();
                Vector3d p = random.Index(3) == 0
                    ? Vector3d.Lerp(t[0], Vector3d.Lerp(t[1], t[2], random.Number(0, 1)), random.Number(-0.5, 1.5))
                    : random.Point();
                double distance = Math.Sqrt(
                    ClosestPoints.PointTriangle(p, t[0], t[1], t[2], out Vector3d c, out int feature));
                return Math.Max(Math.Abs(distance - BruteForce.Distance(new[] { p }, t)),
                    Math.Max(Math.Abs(distance - Vector3d.Distance(p, c)),
                        BruteForce.Distance(new[] { c }, FeatureOf(t, feature))));
            });
        }

        [Test]
        public void SegmentSegment_AgreesWithEnumeration_OnRandomPairs()
        {
            RandomGeometry.AssertErrors(3, Tolerance, random =>
            {
                Vector3d[] q = random.Segment(X);
                Vector3d[] p = random.Segment(q[1] - q[0]);
                double squared = ClosestPoints.SegmentSegment(p[0], p[1], q[0], q[1], out double s, out double t);
                double direct = Vector3d.Distance(Vector3d.Lerp(p[0], p[1], s), Vector3d.Lerp(q[0], q[1], t));
                return Math.Max(Math.Abs(direct - BruteForce.Distance(p, q)), Math.Abs(direct - Math.Sqrt(squared)));
            });
        }

        [Test]
        public void SegmentTriangle_ParallelToAnEdge_HasTheEdgesDistance()
        {
            var t = new[] { Origin, 2.0 * X, Y };
            double distance = SegmentTriangle(
                new Vector3d(0.5, -0.3, 0.4), new Vector3d(1.5, -0.3, 0.4), t, out _, out Vector3d c, out int feature);
            Assert.That(distance, Is.EqualTo(0.5).Within(Tolerance));
            Assert.That(feature, Is.EqualTo(ClosestPoints.Edge));
            Assert.That(c.Y, Is.EqualTo(0.0).Within(Tolerance));
        }

        [Test]
        public void SegmentTriangle_ParallelToTheFace_HasThePlanesDistance()
        {
            var t = new[] { Origin, X, Y };
            double distance = SegmentTriangle(
                new Vector3d(0.1, 0.1, 0.25), new Vector3d(0.3, 0.2, 0.25), t, out _, out _, out int feature);
            Assert.That(distance, Is.EqualTo(0.25).Within(Tolerance));
            Assert.That(feature, Is.EqualTo(ClosestPoints.Face));
        }

        [Test]
        public void SegmentTriangle_InTheTrianglesPlane_AndInsideIt_Touches()
        {
            var t = new[] { Origin, X, Y };
            double distance = SegmentTriangle(
                new Vector3d(0.1, 0.1, 0.0), new Vector3d(0.3, 0.2, 0.0), t, out _, out _, out _);
            Assert.That(distance, Is.EqualTo(0.0).Within(Tolerance));
        }

        [Test]
        public void SegmentTriangle_TouchingAtAVertex_Touches()
        {
            var t = new[] { Origin, X, Y };
            double distance = SegmentTriangle(X, X + Z, t, out double s, out Vector3d c, out _);
            Assert.That(distance, Is.EqualTo(0.0).Within(Tolerance));
            Assert.That(s, Is.EqualTo(0.0).Within(Tolerance));
            Assert.That(Vector3d.Distance(c, X), Is.LessThan(Tolerance));
        }

        [Test]
        public void SegmentTriangle_BeyondAVertex_HasTheVertexForFeature()
        {
            var t = new[] { Origin, X, Y };
            double distance = SegmentTriangle(
                new Vector3d(2.0, -0.5, 0.0), new Vector3d(2.0, 0.5, 0.0), t, out double s, out _, out int feature);
            Assert.That(distance, Is.EqualTo(1.0).Within(Tolerance));
            Assert.That(s, Is.EqualTo(0.5).Within(Tolerance));
            Assert.That(feature, Is.EqualTo(ClosestPoints.Corner + 1));
        }

        [Test]
        public void SegmentTriangle_Crossing_TouchesWhereItCrosses()
        {
            var t = new[] { Origin, X, Y };
            double distance = SegmentTriangle(
                new Vector3d(0.2, 0.3, 3.0), new Vector3d(0.2, 0.3, -1.0), t, out double s, out Vector3d c, out _);
            Assert.That(distance, Is.EqualTo(0.0));
            Assert.That(s, Is.EqualTo(0.75).Within(Tolerance));
            Assert.That(Vector3d.Distance(c, new Vector3d(0.2, 0.3, 0.0)), Is.LessThan(Tolerance));
        }

        [Test]
        public void SegmentTriangle_Needle_HasTheDistanceOfItsLongEdge()
        {
            foreach (double height in new[] { 1e-3, 1e-6, 1e-9, 1e-12, 1e-15 })
            {
                var t = new[] { Origin, X, new Vector3d(0.5, height, 0.0) };
                double distance = SegmentTriangle(
                    new Vector3d(0.2, -0.4, 0.3), new Vector3d(0.7, -0.4, 0.3), t, out _, out _, out _);
                Assert.That(distance, Is.EqualTo(0.5).Within(Tolerance), "height " + height);
            }
        }

        [Test]
        public void SegmentTriangle_ZeroArea_IsASegmentOrAPoint()
        {
            var line = new[] { Origin, X, 0.25 * X };
            double toLine = SegmentTriangle(0.5 * X + Z, 0.5 * X + 2.0 * Z, line, out _, out _, out _);
            Assert.That(toLine, Is.EqualTo(1.0).Within(Tolerance));
            var point = new[] { X, X, X };
            double toPoint = SegmentTriangle(Origin, Y, point, out double s, out _, out _);
            Assert.That(toPoint, Is.EqualTo(1.0).Within(Tolerance));
            Assert.That(s, Is.EqualTo(0.0).Within(Tolerance));
        }

        [Test]
        public void SegmentSegment_CrossingAtATinyAngle_Touches()
        {
            foreach (double angle in new[] { 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 0.0 })
            {
                var tilt = new Vector3d(1.0, angle, 0.0);
                double squared = ClosestPoints.SegmentSegment(
                    -0.3 * tilt, 0.7 * tilt, -0.6 * X, 0.4 * X, out _, out _);
                Assert.That(Math.Sqrt(squared), Is.EqualTo(0.0).Within(Tolerance), "angle " + angle);
            }
        }

        private static double SegmentTriangle(
            Vector3d a, Vector3d b, Vector3d[] t, out double s, out Vector3d point, out int feature)
        {
            return Math.Sqrt(ClosestPoints.SegmentTriangle(
                a, b, t[0], t[1], t[2], double.PositiveInfinity, out s, out point, out feature));
        }

        private static Vector3d[] FeatureOf(Vector3d[] t, int feature)
        {
            if (feature == ClosestPoints.Face)
            {
                return t;
            }
            int k = feature >= ClosestPoints.Corner ? feature - ClosestPoints.Corner : feature - ClosestPoints.Edge;
            return feature >= ClosestPoints.Corner ? new[] { t[k] } : new[] { t[k], t[(k + 1) % 3] };
        }
    }
}
