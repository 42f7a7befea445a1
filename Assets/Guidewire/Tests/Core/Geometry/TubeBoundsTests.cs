using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What a tube leaves out because a bound says that it is too far is too far.</summary>
    internal sealed class TubeBoundsTests
    {
        private const int Knots = 9;

        /// <summary>The same creases with a range as without one, of which those beyond it are dropped.</summary>
        [TestCase(0.0)]
        [TestCase(0.3)]
        public void EdgeContacts_WithinARange_AreThoseOfAllThatAreInIt(double widening)
        {
            var random = new RandomGeometry(31);
            var all = new StructList<EdgeContact>(8);
            var near = new StructList<EdgeContact>(8);
            int found = 0;
            int left = 0;
            for (int i = 0; i < RandomGeometry.Cases(20_000); i++)
            {
                TubeShape tube = Tube(random, widening);
                Segment(random, tube, out Vector3d a, out Vector3d b);
                double range = random.Number(0.0, 1.0);
                all.Clear();
                near.Clear();
                tube.FindEdgeContacts(a, b, double.PositiveInfinity, default, all);
                tube.FindEdgeContacts(a, b, range, default, near);
                int at = 0;
                for (int k = 0; k < all.Count; k++)
                {
                    if (all[k].Distance > range)
                    {
                        left++;
                        continue;
                    }
                    Assert.That(at, Is.LessThan(near.Count), "case " + i);
                    Assert.That(near[at].Distance, Is.EqualTo(all[k].Distance), "case " + i);
                    at++;
                    found++;
                }
                Assert.That(near.Count, Is.EqualTo(at), "case " + i);
            }
            Assert.That(Math.Min(found, left), Is.GreaterThan(100));
        }

        /// <summary>A wire that has turned back in the tube meets its creases as one that runs along it.</summary>
        [Test]
        public void EdgeContacts_OfASegmentThatRunsBack_AreThoseOfOneThatRunsAlongTheTube()
        {
            var random = new RandomGeometry(33);
            var along = new StructList<EdgeContact>(8);
            var back = new StructList<EdgeContact>(8);
            int found = 0;
            for (int i = 0; i < RandomGeometry.Cases(20_000); i++)
            {
                TubeShape tube = Tube(random, 0.3);
                Segment(random, tube, out Vector3d a, out Vector3d b);
                along.Clear();
                back.Clear();
                tube.FindEdgeContacts(a, b, 1.0, default, along);
                tube.FindEdgeContacts(b, a, 1.0, default, back);
                Assert.That(back.Count, Is.EqualTo(along.Count), "case " + i);
                for (int k = 0; k < along.Count; k++)
                {
                    Assert.That(back[k].Position, Is.EqualTo(1.0 - along[k].Position).Within(1e-12), "case " + i);
                    Assert.That(back[k].Distance, Is.EqualTo(along[k].Distance).Within(1e-12), "case " + i);
                    Assert.That(back[k].Weight, Is.EqualTo(along[k].Weight).Within(1e-9), "case " + i);
                    Vector3d fading = back[k].WeightAlongA - along[k].WeightAlongB;
                    Vector3d sliding = back[k].SlideAlongA + along[k].SlideAlongB;
                    Assert.That(Math.Max(fading.Length, sliding.Length), Is.LessThan(1e-9), "case " + i);
                    found++;
                }
            }
            Assert.That(found, Is.GreaterThan(100));
        }

        /// <summary>In a tube of hairpins, whose legs overlap, and in a sac, whose pieces hold creases of others, a
        /// segment is as near to the wall as its ends and edge contacts are.</summary>
        [TestCase(false)]
        [TestCase(true)]
        public void EdgeContacts_WherePiecesOverlap_HoldTheNearestPoint(bool isSac)
        {
            var random = new RandomGeometry(34);
            var edges = new StructList<EdgeContact>(8);
            var features = new StructList<WallFeature>(64);
            int inside = 0;
            for (int i = 0; i < RandomGeometry.Cases(20_000); i++)
            {
                TubeShape tube = isSac ? Sac(random) : Hairpins(random);
                Vector3d[] knots = tube.Knots;
                int k = isSac ? 2 : 1 + random.Index(knots.Length - 2);
                Vector3d a = knots[k] + (isSac ? 0.5 : 0.8) * random.Point();
                Vector3d b = a + 1.5 * random.Point();
                double least = tube.MinDistance(a, b);
                if (!(least > 0.0))
                {
                    continue;
                }
                double range = least + 0.1;
                features.Clear();
                edges.Clear();
                int hint = -1;
                double found = tube.FindFeatures(a, b, range, range, ref hint, features);
                tube.FindEdgeContacts(a, b, range, new FeatureRange(features, 0, features.Count, 0.0), edges);
                double seen = Math.Min(tube.MinDistance(a, a), tube.MinDistance(b, b));
                inside += seen > least + 1e-6 ? 1 : 0;
                for (int c = 0; c < edges.Count; c++)
                {
                    seen = Math.Min(seen, edges[c].Distance);
                }
                Assert.That(seen, Is.EqualTo(least).Within(1e-9), "case " + i);
                Assert.That(found, Is.EqualTo(least).Within(1e-9), "case " + i);
            }
            Assert.That(inside, Is.GreaterThan(RandomGeometry.Cases(200)));
        }

        // A ball of radius 1, in so many pieces, behind a neck.
        private static TubeShape Sac(RandomGeometry random)
        {
            int pieces = 3 + random.Index(9);
            double neck = random.Number(0.15, 0.65);
            double begin = random.Number(0.65, 0.745) * Math.PI;
            double turn = random.Number(0.3, 0.38) * Math.PI / pieces;
            var knots = new Vector3d[pieces + 3];
            var radii = new double[pieces + 3];
            double first = Math.Sin(begin);
            double rise = Math.Abs(first - neck) / random.Number(0.5, 0.97);
            for (int i = 0; i < knots.Length; i++)
            {
                double angle = begin - turn * (i - 2);
                knots[i] = new Vector3d(0.0, 0.0, i == 0 ? -2.0 - rise
                    : i == 1 ? -rise : Math.Cos(angle) - Math.Cos(begin));
                radii[i] = i < 2 ? neck : Math.Sin(angle);
            }
            return new TubeShape(knots, radii, true, false);
        }

        private static TubeShape Hairpins(RandomGeometry random)
        {
            var knots = new Vector3d[Knots];
            var radii = new double[Knots];
            Vector3d direction = Vector3d.UnitZ;
            for (int k = 0; k < Knots; k++)
            {
                radii[k] = random.Number(0.8, 1.2);
                knots[k] = k == 0 ? Vector3d.Zero : knots[k - 1] + random.Number(1.0, 4.0) * direction;
                direction = Vector3d.Normalize(direction + random.Number(0.3, 2.0) * random.Direction());
            }
            return new TubeShape(knots, radii, true, true);
        }

        /// <summary>No sample along a segment is nearer to the wall than the nearest point, and none is within a range
        /// that nothing was found in.</summary>
        [TestCase(0.0)]
        [TestCase(0.3)]
        public void Nearest_WithARange_MissesNoPointInIt(double widening)
        {
            const double Resolution = 1e-8;    // of distances that count as equal, of a tube of this size with far ends
            const int Samples = 64;
            var random = new RandomGeometry(32);
            int found = 0;
            int cases = RandomGeometry.Cases(20_000);
            for (int i = 0; i < cases; i++)
            {
                TubeShape tube = Tube(random, widening);
                Segment(random, tube, out Vector3d a, out Vector3d b);
                double range = random.Number(0.0, 1.0);
                int hint = -1;
                bool isNear = tube.Nearest(a, b, range, ref hint, out SurfaceContact contact);
                double least = isNear ? contact.Distance : range;
                for (int k = 0; k <= Samples; k++)
                {
                    Vector3d x = Vector3d.Lerp(a, b, (double)k / Samples);
                    Assert.That(tube.MinDistance(x, x), Is.GreaterThanOrEqualTo(least - Resolution), "case " + i);
                }
                found += isNear ? 1 : 0;
            }
            Assert.That(Math.Min(found, cases - found), Is.GreaterThan(100));
        }

        private static TubeShape Tube(RandomGeometry random, double widening)
        {
            var knots = new Vector3d[Knots];
            var radii = new double[Knots];
            Vector3d along = random.Direction();
            for (int k = 0; k < Knots; k++)
            {
                radii[k] = 1.0 + random.Number(0.0, widening);
                along = Vector3d.Normalize(along + random.Number(0.0, 0.4) * random.Direction());
                knots[k] = k == 0 ? Vector3d.Zero : knots[k - 1] + random.Number(0.7, 1.5) * along;
            }
            return new TubeShape(knots, radii, true, true);
        }

        // Along the tube over one to three knots, within its wall for the most part.
        private static void Segment(RandomGeometry random, TubeShape tube, out Vector3d a, out Vector3d b)
        {
            int from = 1 + random.Index(Knots - 4);
            int to = from + 1 + random.Index(3);
            a = tube.Knots[from] + random.Number(0.0, 0.9) * random.Direction();
            b = tube.Knots[to] + random.Number(0.0, 0.9) * random.Direction();
        }
    }
}
