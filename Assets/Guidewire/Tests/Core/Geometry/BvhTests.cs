using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The hierarchy misses nothing: compared with a loop over all triangles.</summary>
    internal sealed class BvhTests
    {
        private const double Tolerance = 1e-9;

        [Test]
        public void Nearest_AgreesWithTheLoopOverAllTriangles() =>
            Compare(TestMeshes.Ball(12, 0.2).Corners, new RandomGeometry(21), RandomGeometry.Cases(2_500));

        [Test]
        public void Nearest_AgreesWithTheLoop_OnLooseTrianglesAndNeedles()
        {
            var random = new RandomGeometry(22);
            var corners = new Vector3d[3 * 300];
            for (int t = 0; t < 300; t++)
            {
                Vector3d[] triangle = random.Triangle();
                Array.Copy(triangle, 0, corners, 3 * t, 3);
            }
            Compare(corners, random, RandomGeometry.Cases(5_000, 16));
        }

        [Test]
        public void Nearest_StaysRight_AfterRefits()
        {
            Vector3d[] corners = TestMeshes.Ball(8, 0.2).Corners;
            var random = new RandomGeometry(23);
            var tree = new Bvh(corners);
            for (int i = 0; i < 5; i++)
            {
                var placement = new Placement(
                    0.3 * random.Point(), random.Orientation(),
                    new Vector3d(random.Number(0.5, 1.5), random.Number(0.5, 1.5), -random.Number(0.5, 1.5)));
                Vector3d[] moved = Array.ConvertAll(corners, corner => placement.Apply(corner));
                tree.Refit(moved);
                Compare(tree, moved, random, RandomGeometry.Cases(1_000, 50));
            }
        }

        [Test]
        public void Nearest_WithARange_FindsExactlyWhatIsWithinIt()
        {
            Vector3d[] corners = TestMeshes.Ball(10, 0.0).Corners;
            var tree = new Bvh(corners);
            var random = new RandomGeometry(24);
            for (int i = 0; i < RandomGeometry.Cases(2_500, 50); i++)
            {
                Vector3d[] s = random.Segment(Vector3d.UnitX);
                double distance = BruteForce.Distance(s, corners, out _);
                bool within = tree.Nearest(s[0], s[1], distance + Tolerance, -1, out _, out _, out _, out _) >= 0;
                bool beyond = tree.Nearest(
                    s[0], s[1], Math.Max(0.0, distance - Tolerance), -1, out _, out _, out _, out _) >= 0;
                Assert.That(within, Is.True, "case " + i);
                Assert.That(beyond && distance > Tolerance, Is.False, "case " + i);
            }
        }

        [Test]
        public void Nearest_DoesNotDependOnTheHint()
        {
            Vector3d[] corners = TestMeshes.Ball(12, 0.2).Corners;
            var tree = new Bvh(corners);
            var random = new RandomGeometry(25);
            for (int i = 0; i < RandomGeometry.Cases(10_000, 40); i++)
            {
                Vector3d[] s = random.Segment(Vector3d.UnitX);
                tree.Nearest(s[0], s[1], 10.0, -1, out double plain, out _, out _, out _);
                tree.Nearest(s[0], s[1], 10.0, random.Index(corners.Length / 3), out double hinted, out _, out _,
                    out _);
                Assert.That(hinted, Is.EqualTo(plain), "case " + i);
            }
        }

        [Test]
        public void Within_FindsAllTrianglesInRange_AndFewOthers()
        {
            Vector3d[] corners = TestMeshes.Ball(12, 0.2).Corners;
            var tree = new Bvh(corners);
            var random = new RandomGeometry(26);
            tree.Refit(Array.ConvertAll(corners, corner => 2.0 * corner));
            tree.Refit(corners);
            var found = new StructList<int>(16);
            int wanted = 0;
            int all = 0;
            for (int i = 0; i < RandomGeometry.Cases(2_000, 80); i++)
            {
                Vector3d[] s = random.Segment(Vector3d.UnitX);
                double range = random.Number(0.0, 0.3);
                found.Clear();
                tree.Within(s[0], s[1], range, found);
                wanted += AssertHolds(found, corners, t => BruteForce.Distance(s, t) <= range - Tolerance, "case " + i);
                all += found.Count;
            }
            Assert.That(wanted, Is.GreaterThan(all / 3));
        }

        [Test]
        public void Within_FindsAllThatAMovingSegmentMeets_AndFewOthers()
        {
            const int Moments = 10;
            Vector3d[] corners = TestMeshes.Ball(12, 0.2).Corners;
            var tree = new Bvh(corners);
            var random = new RandomGeometry(27);
            var found = new StructList<int>(16);
            int wanted = 0;
            int all = 0;
            for (int i = 0; i < RandomGeometry.Cases(300, 60); i++)
            {
                Vector3d[] s = random.Segment(Vector3d.UnitX);
                Vector3d[] to = { s[0] + 0.2 * random.Point(), s[1] + 0.2 * random.Point() };
                double distance = random.Number(0.0, 0.1);
                found.Clear();
                var swept = new SweptSegment(s[0], s[1], to[0], to[1], distance);
                tree.Within(swept, found);
                bool Meets(Vector3d[] t)
                {
                    bool meets = false;
                    for (int k = 0; k <= Moments && !meets; k++)
                    {
                        double time = (double)k / Moments;
                        Vector3d[] now = { Vector3d.Lerp(s[0], to[0], time), Vector3d.Lerp(s[1], to[1], time) };
                        meets = BruteForce.Distance(now, t) <= distance - Tolerance;
                    }
                    return meets;
                }
                int met = AssertHolds(found, corners, Meets, "case " + i);
                wanted += met;
                all += found.Count;
            }
            Assert.That(wanted, Is.GreaterThan(all / 6));
        }

        // Scales of vessels in metres and micrometres, and far from the origin; a range that is just the distance.
        [TestCase(1.0, 0.0)]
        [TestCase(1e-3, 0.0)]
        [TestCase(1e3, 3.0)]
        [TestCase(1.0, 1e3)]
        [TestCase(1.0, 1e6)]
        public void Within_LeavesOutNothing_AtAnyScaleAndPlace(double scale, double offset)
        {
            const int Count = 300;
            var random = new RandomGeometry(28);
            Vector3d move = offset * random.Direction();
            var corners = new Vector3d[3 * Count];
            for (int t = 0; t < Count; t++)
            {
                Vector3d[] triangle = Array.ConvertAll(random.Triangle(), corner => 0.1 * corner);
                Vector3d at = random.Point() + move;
                bool isEdge = random.Index(3) == 0;
                bool isPoint = random.Index(10) == 0;
                corners[3 * t] = scale * (at + triangle[0]);
                corners[3 * t + 1] = isPoint ? corners[3 * t] : scale * (at + triangle[1]);
                corners[3 * t + 2] = isEdge || isPoint ? corners[3 * t + 1] : scale * (at + triangle[2]);
            }
            var tree = new Bvh(corners);
            var found = new StructList<int>(Count);
            double rounding = 1e-14 * scale * (1.0 + offset);
            int cases = RandomGeometry.Cases(20_000);
            int few = 0;
            for (int i = 0; i < cases; i++)
            {
                int t = 3 * random.Index(Count);
                Vector3d[] s = random.Segment(corners[t + 1] - corners[t]);
                Vector3d step = random.Index(4) == 0 ? Vector3d.Zero : random.Number(0.0, 0.3) * random.Point();
                double turn = random.Number(0.0, 0.2);
                Vector3d a = scale * (0.2 * s[0] + move);
                Vector3d b = scale * (0.2 * s[1] + move);
                Vector3d toA = a + scale * step;
                Vector3d toB = b + scale * (step + turn * random.Point());
                double time = 0.5 * random.Index(3);
                double start = Distance(a, b, corners, t);
                double distance = Distance(Vector3d.Lerp(a, toA, time), Vector3d.Lerp(b, toB, time), corners, t);
                found.Clear();
                tree.Within(a, b, start + rounding, found);
                Assert.That(Holds(found, t / 3), Is.True, "case " + i + " at " + start);
                found.Clear();
                tree.Within(new SweptSegment(a, b, toA, toB, distance + rounding), found);
                Assert.That(Holds(found, t / 3), Is.True, "moving case " + i + " at " + distance);
                found.Clear();
                tree.Within(a, a, 0.01 * scale, found);
                few += found.Count;
            }
            Assert.That(few, Is.LessThan(cases * Count / 20));
        }

        // A plate is one plane to every node of the tree: what is at the range above a triangle's middle, thousands of
        // times nearer than the plate is long, is found only if the rounding of boxes and slabs to single precision is
        // made up for. Plates across an axis are met by their boxes, tilted ones by their slabs; a triangle without
        // area far from a plate keeps it off the origin, where coordinates would be exact.
        [TestCase(false)]
        [TestCase(true)]
        public void Within_FindsWhatIsJustInRange_WhateverIsRoundedAway(bool isTilted)
        {
            const int Side = 6;
            const double Rounding = 1e-15;
            var random = new RandomGeometry(29);
            var found = new StructList<int>(2 * Side * Side);
            for (int plate = 0; plate < 20; plate++)
            {
                Quaterniond turn = isTilted ? random.Orientation() : Quaterniond.Identity;
                Vector3d Place(double x, double y, double z) => Quaterniond.Rotate(turn, new Vector3d(x, y, z));
                double height = random.Number(0.1, 1.0);
                var corners = new Vector3d[6 * Side * Side + 3];
                Array.Fill(corners, Place(0.0, 0.0, -random.Number(1.0, 9.0)), 6 * Side * Side, 3);
                for (int k = 0; k < Side * Side; k++)
                {
                    double x = k / Side - 0.7 * Side;
                    double y = k % Side - 0.3 * Side;
                    corners[6 * k] = corners[6 * k + 3] = Place(x, y, height);
                    corners[6 * k + 1] = Place(x + 1.0, y, height);
                    corners[6 * k + 2] = corners[6 * k + 4] = Place(x + 1.0, y + 1.0, height);
                    corners[6 * k + 5] = Place(x, y + 1.0, height);
                }
                var tree = new Bvh(corners);
                for (int t = 0; t < 6 * Side * Side; t += 3)
                {
                    Vector3d middle = (corners[t] + corners[t + 1] + corners[t + 2]) / 3.0;
                    double above = random.Number(-1e-3, 1e-3);
                    Vector3d x = middle + Place(0.0, 0.0, above);
                    double range = Math.Abs(above) + Rounding * Side;
                    found.Clear();
                    tree.Within(x, x, range, found);
                    Assert.That(Holds(found, t / 3), Is.True, "plate " + plate + " at " + above);
                    Vector3d step = Place(0.01, 0.02, 0.0);
                    found.Clear();
                    tree.Within(new SweptSegment(x, x, x + step, x + step, range), found);
                    Assert.That(Holds(found, t / 3), Is.True, "moving, plate " + plate);
                }
            }
        }

        private static bool Holds(StructList<int> found, int triangle)
        {
            bool holds = false;
            for (int k = 0; k < found.Count; k++)
            {
                holds |= found[k] == triangle;
            }
            return holds;
        }

        private static double Distance(in Vector3d a, in Vector3d b, Vector3d[] corners, int t)
        {
            return Math.Sqrt(ClosestPoints.SegmentTriangle(
                a, b, corners[t], corners[t + 1], corners[t + 2], double.PositiveInfinity, out _, out _, out _));
        }

        [Test]
        public void Tree_OfManyEqualTriangles_IsBuiltAndSearched()
        {
            var corners = new Vector3d[3 * 1000];
            for (int t = 0; t < 1000; t++)
            {
                corners[3 * t + 1] = Vector3d.UnitX;
                corners[3 * t + 2] = Vector3d.UnitY;
            }
            var tree = new Bvh(corners);
            tree.Nearest(Vector3d.UnitZ, Vector3d.UnitZ, 10.0, -1, out double squared, out _, out _, out _);
            Assert.That(squared, Is.EqualTo(1.0).Within(Tolerance));
        }

        // That a list has every triangle that counts; how many do.
        private static int AssertHolds(StructList<int> found, Vector3d[] corners, Func<Vector3d[], bool> counts,
            string what)
        {
            var isFound = new bool[corners.Length / 3];
            for (int k = 0; k < found.Count; k++)
            {
                Assert.That(isFound[found[k]], Is.False, what + ": twice");
                isFound[found[k]] = true;
            }
            int wanted = 0;
            for (int t = 0; t < isFound.Length; t++)
            {
                if (counts(new[] { corners[3 * t], corners[3 * t + 1], corners[3 * t + 2] }))
                {
                    Assert.That(isFound[t], what + ", triangle " + t);
                    wanted++;
                }
            }
            return wanted;
        }

        private static void Compare(Vector3d[] corners, RandomGeometry random, int all) =>
            Compare(new Bvh(corners), corners, random, RandomGeometry.Cases(all));

        private static void Compare(Bvh tree, Vector3d[] corners, RandomGeometry random, int cases)
        {
            double worst = 0.0;
            for (int i = 0; i < cases; i++)
            {
                int t = 3 * random.Index(corners.Length / 3);
                Vector3d[] s = random.Segment(corners[t + 1] - corners[t]);
                int found = tree.Nearest(
                    s[0], s[1], double.PositiveInfinity, -1, out double squared, out double position,
                    out Vector3d point, out _);
                double direct = BruteForce.Distance(
                    s, new[] { corners[3 * found], corners[3 * found + 1], corners[3 * found + 2] });
                worst = Math.Max(worst, Math.Abs(Math.Sqrt(squared) - BruteForce.Distance(s, corners, out _)));
                worst = Math.Max(worst, Math.Abs(Math.Sqrt(squared) - direct));
                worst = Math.Max(worst, Math.Abs(
                    Math.Sqrt(squared) - Vector3d.Distance(point, Vector3d.Lerp(s[0], s[1], position))));
            }
            Assert.That(worst, Is.LessThan(Tolerance));
        }
    }
}
