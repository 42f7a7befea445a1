using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>GJK and EPA against closed forms and enumeration.</summary>
    internal sealed class ConvexObstacleTests
    {
        private const double Tolerance = 1e-9;

        [Test]
        public void Sphere_HasTheDistanceOfItsCentreLessItsRadius()
        {
            RandomGeometry.AssertErrors(11, Tolerance, random =>
            {
                Vector3d centre = random.Point();
                double radius = random.Number(0.01, 0.5);
                Vector3d[] s = random.Segment(Vector3d.UnitX);
                SurfaceContact contact = Nearest(ConvexObstacle.Sphere(centre, radius), s[0], s[1]);
                double t = ClosestPoints.PointSegment(centre, s[0], s[1]);
                double expected = Vector3d.Distance(centre, Vector3d.Lerp(s[0], s[1], t)) - radius;
                return Math.Max(Math.Abs(contact.Distance - expected), Inconsistency(contact, s));
            });
        }

        [Test]
        public void Capsule_HasTheDistanceOfItsCoreLessItsRadius()
        {
            RandomGeometry.AssertErrors(12, Tolerance, random =>
            {
                Vector3d[] core = random.Segment(Vector3d.UnitY);
                Vector3d[] s = random.Segment(core[1] - core[0]);
                double radius = random.Number(0.01, 0.5);
                SurfaceContact contact = Nearest(ConvexObstacle.Capsule(core[0], core[1], radius), s[0], s[1]);
                return Math.Max(Math.Abs(contact.Distance - BruteForce.Distance(s, core) + radius),
                    Inconsistency(contact, s));
            });
        }

        [Test]
        public void Box_AgreesWithEnumeration_ApartAndOverlapping()
        {
            var random = new RandomGeometry(13);
            double worst = 0.0;
            int overlapping = 0;
            int cases = RandomGeometry.Cases(100_000, 25);
            for (int i = 0; i < cases; i++)
            {
                Vector3d centre = random.Point();
                var half = new Vector3d(random.Number(0.05, 0.8), random.Number(0.05, 0.8), random.Number(0.05, 0.8));
                Quaterniond q = random.Orientation();
                var axes = new[] { q.Director1, q.Director2, q.Director3 };
                Vector3d[] s = random.Segment(axes[random.Index(3)]);
                var corners = new List<Vector3d>();
                for (int k = 0; k < 8; k++)
                {
                    corners.Add(centre + ((k & 1) == 0 ? half.X : -half.X) * axes[0]
                        + ((k & 2) == 0 ? half.Y : -half.Y) * axes[1] + ((k & 4) == 0 ? half.Z : -half.Z) * axes[2]);
                }
                double depth = BruteForce.Depth(s[0], s[1], corners.ToArray(), axes, axes);
                double expected = depth > 0.0 ? -depth : BoxDistance(s, corners);
                overlapping += depth > 0.0 ? 1 : 0;
                SurfaceContact contact = Nearest(ConvexObstacle.Box(centre, half, q), s[0], s[1]);
                worst = Math.Max(worst, Math.Abs(contact.Distance - expected));
                worst = Math.Max(worst, Inconsistency(contact, s));
            }
            Assert.That(overlapping, Is.GreaterThan(cases / 10));
            Assert.That(worst, Is.LessThan(Tolerance));
        }

        [Test]
        public void DeepestPoint_OfASegmentInABox_IsThatOfItsSixPlanes()
        {
            // Within a box a point's signed distance is the largest of those from six planes, each linear along the
            // segment: the least is at an end or where two of them are equal.
            var random = new RandomGeometry(17);
            double worst = 0.0;
            int shorter = 0;
            for (int i = 0; i < RandomGeometry.Cases(10_000); i++)
            {
                var half = new Vector3d(random.Number(0.1, 0.8), random.Number(0.1, 0.8), random.Number(0.1, 0.8));
                Vector3d[] s = random.Segment(Vector3d.UnitX);
                ConvexObstacle box = ConvexObstacle.Box(Vector3d.Zero, half, Quaterniond.Identity);
                double wayOut = Nearest(box, s[0], s[1]).Distance;
                if (!(wayOut < 0.0))
                {
                    continue;
                }
                double[] from = PlaneDistances(s[0], half);
                double[] to = PlaneDistances(s[1], half);
                double expected = Math.Min(Highest(from, to, 0.0), Highest(from, to, 1.0));
                for (int k = 0; k < 36; k++)
                {
                    double above = from[k / 6] - from[k % 6];
                    double fraction = above / (above - to[k / 6] + to[k % 6]);
                    expected = fraction > 0.0 && fraction < 1.0
                        ? Math.Min(expected, Highest(from, to, fraction)) : expected;
                }
                worst = Math.Max(worst, Math.Abs(box.MinAlong(s[0], s[1], wayOut) - expected));
                shorter += expected > wayOut + 1e-3 ? 1 : 0;
            }
            Assert.That(worst, Is.LessThan(Tolerance));
            Assert.That(shorter, Is.GreaterThan(10), "cases in which the way out of the whole segment is longer");
        }

        private static double[] PlaneDistances(in Vector3d p, in Vector3d half) =>
            new[] { p.X - half.X, -p.X - half.X, p.Y - half.Y, -p.Y - half.Y, p.Z - half.Z, -p.Z - half.Z };

        private static double Highest(double[] from, double[] to, double fraction)
        {
            double highest = double.NegativeInfinity;
            for (int k = 0; k < from.Length; k++)
            {
                highest = Math.Max(highest, from[k] + fraction * (to[k] - from[k]));
            }
            return highest;
        }

        [Test]
        public void Hull_AgreesWithEnumeration_OnRandomTetrahedra()
        {
            var random = new RandomGeometry(14);
            double worst = 0.0;
            int overlapping = 0;
            for (int i = 0; i < RandomGeometry.Cases(100_000); i++)
            {
                var p = new[] { random.Point(), random.Point(), random.Point(), random.Point() };
                Vector3d[] s = random.Segment(p[1] - p[0]);
                var edges = new List<Vector3d>();
                var normals = new List<Vector3d>();
                double apart = double.PositiveInfinity;
                for (int k = 0; k < 4; k++)
                {
                    var face = new[] { p[(k + 1) & 3], p[(k + 2) & 3], p[(k + 3) & 3] };
                    normals.Add(Vector3d.Cross(face[1] - face[0], face[2] - face[0]));
                    edges.Add(face[1] - face[0]);
                    edges.Add(face[2] - face[0]);
                    apart = Math.Min(apart, BruteForce.Distance(s, face));
                }
                double depth = BruteForce.Depth(s[0], s[1], p, edges, normals);
                overlapping += depth > 0.0 ? 1 : 0;
                SurfaceContact contact = Nearest(new ConvexObstacle(p, 0.0), s[0], s[1]);
                worst = Math.Max(worst, Math.Abs(contact.Distance - (depth > 0.0 ? -depth : apart)));
                worst = Math.Max(worst, Inconsistency(contact, s));
            }
            Assert.That(overlapping, Is.GreaterThan(300));
            Assert.That(worst, Is.LessThan(Tolerance));
        }

        [Test]
        public void Sphere_WithTheSegmentThroughItsCentre_IsAsDeepAsItsRadius()
        {
            SurfaceContact contact = Nearest(
                ConvexObstacle.Sphere(Vector3d.Zero, 0.3), -1.0 * Vector3d.UnitX, Vector3d.UnitX);
            Assert.That(contact.Distance, Is.EqualTo(-0.3).Within(Tolerance));
            Assert.That(contact.Normal.Length, Is.EqualTo(1.0).Within(Tolerance));
            Assert.That(contact.Normal.X, Is.EqualTo(0.0).Within(Tolerance));
        }

        [Test]
        public void Hull_ThatIsFlat_HasDistanceOnBothSidesAndDepthZeroInside()
        {
            var square = new ConvexObstacle(
                new[]
                {
                    new Vector3d(-1.0, -1.0, 0.0), new Vector3d(1.0, -1.0, 0.0), new Vector3d(1.0, 1.0, 0.0),
                    new Vector3d(-1.0, 1.0, 0.0),
                },
                0.0);
            Assert.That(
                Nearest(square, new Vector3d(0.2, 0.1, 0.5), new Vector3d(0.3, 0.1, 0.7)).Distance,
                Is.EqualTo(0.5).Within(Tolerance));
            Assert.That(
                Nearest(square, new Vector3d(0.2, 0.1, -0.5), new Vector3d(0.2, 0.1, -0.5)).Distance,
                Is.EqualTo(0.5).Within(Tolerance));
            SurfaceContact inside = Nearest(square, new Vector3d(0.2, 0.1, 0.0), new Vector3d(0.4, 0.3, 0.0));
            Assert.That(inside.Distance, Is.EqualTo(0.0).Within(Tolerance));
            Assert.That(Math.Abs(inside.Normal.Z), Is.EqualTo(1.0).Within(Tolerance));
        }

        [Test]
        public void Obstacle_RefusesNoPointsAndBadNumbers()
        {
            Assert.That(() => new ConvexObstacle(Array.Empty<Vector3d>(), 1.0), Throws.ArgumentException);
            Assert.That(() => ConvexObstacle.Sphere(Vector3d.Zero, -1.0), Throws.ArgumentException);
            Assert.That(() => ConvexObstacle.Sphere(Vector3d.Zero, double.NaN), Throws.ArgumentException);
            Assert.That(
                () => ConvexObstacle.Sphere(new Vector3d(double.NaN, 0.0, 0.0), 1.0), Throws.ArgumentException);
        }

        private static SurfaceContact Nearest(ConvexObstacle obstacle, Vector3d a, Vector3d b)
        {
            int hint = -1;
            obstacle.Nearest(a, b, double.PositiveInfinity, ref hint, out SurfaceContact contact);
            return contact;
        }

        // The point of the element is where the contact says: c + distance n, and n has length 1.
        private static double Inconsistency(in SurfaceContact contact, Vector3d[] s)
        {
            Vector3d p = Vector3d.Lerp(s[0], s[1], contact.Position);
            return Math.Max(
                (contact.Point + contact.Distance * contact.Normal - p).Length, Math.Abs(contact.Normal.Length - 1.0));
        }

        private static double BoxDistance(Vector3d[] s, List<Vector3d> c)
        {
            int[] quads = { 0, 1, 3, 2, 4, 5, 7, 6, 0, 1, 5, 4, 2, 3, 7, 6, 0, 2, 6, 4, 1, 3, 7, 5 };
            double best = double.PositiveInfinity;
            for (int k = 0; k < quads.Length; k += 4)
            {
                Vector3d p = c[quads[k]];
                Vector3d q = c[quads[k + 1]];
                Vector3d r = c[quads[k + 2]];
                Vector3d t = c[quads[k + 3]];
                best = Math.Min(best, BruteForce.Distance(s, new[] { p, q, r }));
                best = Math.Min(best, BruteForce.Distance(s, new[] { p, r, t }));
            }
            return best;
        }
    }
}
