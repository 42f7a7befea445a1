using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The monitor on scenes that no solver has made: nodes of a wire in a tube of 24 flat sides are moved
    /// through its wall by hand. How many of its points are outside then follows from the sides' planes.</summary>
    public sealed class WallMonitorTests
    {
        private const int N = 15;
        private const double Spacing = 0.4;      // of the nodes, units
        private const double First = 5.0;        // z of node 0
        private const double Length = 20.0;      // of the tube
        private const int Sides = 24;
        private const int PointsPerElement = 10;
        private static readonly double Apothem = Math.Cos(Math.PI / Sides);
        private static readonly double[] Inner = { 1.0 };
        private static readonly double[] Both = { 1.0, 1.02 };
        private static readonly ContactShape[] Walls = { Tube(1.0), Tube(1.02) };

        [Test]
        public void NodeMovedOut_IsCounted_WhereverItMeetsTheWall([Values(0, 3, 8, N)] int node,
            [Values(0.0, 0.13, 0.2618, 2.0)] double side, [Values(1.1, 3.0, 60.0)] double aside)
        {
            // At angle 0 z = 5.0 and 8.2 lie in an edge along the tube, at 0.13 in the middle of a side.
            Vector3d[] to = Straight();
            to[node] += aside * Across(side);
            AssertCounted(Inner, Straight(), to);
            AssertCounted(Both, Straight(), to);
        }

        [Test]
        public void NodeThatLeavesThroughAVertex_IsCounted([Values(0.0, 1.0, -2.0)] double along)
        {
            // A corner of the mesh is at z = 8 and angle 0; node 8 starts at z = 8.2.
            Vector3d[] from = Straight();
            from[8] = new Vector3d(0.0, 0.0, 8.0 - along);
            Vector3d[] to = Straight();
            to[8] = new Vector3d(2.0, 0.0, 8.0 + along);
            AssertCounted(Inner, from, to);
        }

        [Test]
        public void SegmentMovedOut_IsCounted_AndTheWholeWireToo([Values(0.0, 0.07, 2.0)] double side,
            [Values(2, 7, N + 1)] int nodes, [Values(1.05, 40.0)] double aside)
        {
            Vector3d[] to = Straight();
            for (int i = 4; i < Math.Min(4 + nodes, N + 1); i++)
            {
                to[i] += aside * Across(side);
            }
            AssertCounted(Inner, Straight(), to);
        }

        [Test]
        public void CrossingByLessThanTheRadius_IsCounted([Values(0.05, 2.9)] double side,
            [Values(1e-2, 1e-4)] double depth)
        {
            // From just inside to just outside, less than the wire is thick, through one wall of two.
            double normal = Math.PI / Sides + Math.Floor(side / (2.0 * Math.PI / Sides)) * 2.0 * Math.PI / Sides;
            Vector3d[] from = Straight((Apothem - depth) * Across(normal));
            Vector3d[] to = Straight((Apothem + depth) * Across(normal));
            AssertCounted(Both, from, to);
            Assert.That(Count(Both, Straight(), from, to), Is.EqualTo(Count(Both, from, to)), "after another part");
        }

        [Test]
        public void WireThatStaysInside_IsNotCounted([Values(0.0, 0.9)] double aside)
        {
            Vector3d[] to = Straight(aside * Across(1.0));
            AssertCounted(Both, Straight(), to);
            Assert.That(Count(Both, Straight(), to), Is.Zero);
        }

        /// <summary>Past an edge along the tube, whose sides turn by 15 degrees there: 0.2 to either side of it the
        /// nodes are 0.03 cos 7.5 + 0.2 sin 7.5 = 0.056 from the wall, at a radius of 0.05.</summary>
        [TestCase(0.03, true)]
        [TestCase(-0.01, true)]
        [TestCase(0.06, false)]
        public void ElementAcrossAnEdgeFromOutside_HasAReason(double aside, bool touches)
        {
            var x = new Vector3d[N + 1];
            for (int i = 0; i <= N; i++)
            {
                x[i] = new Vector3d(1.0 + aside, Spacing * (i - 0.5 * N), 10.1);
            }
            string? reason = Monitor(Inner, x, x).FindTouchFromBeside(0.5);
            Assert.That(reason != null, Is.EqualTo(touches), reason);
            Assert.That(reason ?? "at t = 0.5 s, 10.1)", Does.StartWith("at t = 0.5 s").And.Contains(", 10.1)"));
            Assert.That(Monitor(Inner, Straight(), Straight()).FindTouchFromBeside(0.5), Is.Null);
        }

        private static void AssertCounted(double[] radii, Vector3d[] from, Vector3d[] to)
        {
            long expected = 0;
            foreach (double radius in radii)
            {
                for (int k = 0; k <= PointsPerElement * N; k++)
                {
                    expected += IsInside(Point(from, k), radius) && !IsInside(Point(to, k), radius) ? 1 : 0;
                }
            }
            Assert.That(Count(radii, from, to), Is.EqualTo(expected));
        }

        // As the method has it counted: the last part of the step is without motion.
        private static long Count(double[] radii, params Vector3d[][] shapes)
        {
            var record = new ContactRecord(N + 1);
            Monitor(radii, shapes).EndStep(Shape(shapes[shapes.Length - 1]), record);
            return record.Passages;
        }

        private static WallMonitor Monitor(double[] radii, params Vector3d[][] shapes)
        {
            MaterialRod rod = MaterialRod.Round(N, N * Spacing, 0.05, 1e6, 1e6, 1e3);
            var walls = new ContactShape[radii.Length];
            Array.Copy(Walls, walls, walls.Length);
            var barrier = new BarrierEnergy(rod, walls, 1.0, new Barrier(0.02, 10.0));
            var terms = new WallTerms(barrier, null, new SupportSpring(rod, HubLimit.None), false);
            var monitor = new WallMonitor(rod, terms, 1.0);
            monitor.BeginStep(Shape(shapes[0]));
            for (int k = 1; k <= shapes.Length; k++)
            {
                monitor.AddPart(Shape(shapes[Math.Min(k, shapes.Length - 1)]), 0.0);
            }
            return monitor;
        }

        private static MeshShape Tube(double radius)
        {
            return new MeshShape(TestMeshes.Tube(Sides, 10, Length, z => radius).Build(
                new[] { Vector3d.Zero, new Vector3d(0.0, 0.0, Length) }));
        }

        private static RodShape Shape(Vector3d[] x)
        {
            var shape = new RodShape(N);
            Array.Copy(x, shape.X, N + 1);
            Array.Fill(shape.Q, Quaterniond.Identity);
            return shape;
        }

        private static Vector3d[] Straight(Vector3d aside = default)
        {
            var x = new Vector3d[N + 1];
            for (int i = 0; i <= N; i++)
            {
                x[i] = aside + new Vector3d(0.0, 0.0, First + Spacing * i);
            }
            return x;
        }

        private static Vector3d Across(double angle) => new Vector3d(Math.Cos(angle), Math.Sin(angle), 0.0);

        private static Vector3d Point(Vector3d[] x, int k)
        {
            int j = Math.Min(k / PointsPerElement, N - 1);
            return Vector3d.Lerp(x[j], x[j + 1], (double)(k - PointsPerElement * j) / PointsPerElement);
        }

        private static bool IsInside(in Vector3d x, double radius)
        {
            bool isInside = true;
            for (int k = 0; k < Sides; k++)
            {
                Vector3d normal = Across((2 * k + 1) * Math.PI / Sides);
                isInside &= Vector3d.Dot(x, normal) < radius * Apothem;
            }
            return isInside;
        }
    }
}
