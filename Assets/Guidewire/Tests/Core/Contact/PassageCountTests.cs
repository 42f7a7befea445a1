using System;
using System.Collections.Generic;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Which of the points that are outside after a step passed the wall, and which left by an open rim, at a
    /// tube of radius 1 from z = 0 on; the wire goes in from z below 0.</summary>
    internal sealed class PassageCountTests
    {
        private const int Elements = 15;
        private const double Spacing = 0.4;    // of the nodes, units
        private static readonly Vector3d[] Rims = { Vector3d.Zero, new Vector3d(0.0, 0.0, 20.0) };
        private static readonly ContactShape Tube = new MeshShape(TestMeshes.Tube(24, 10, 20.0).Build(Rims));

        [Test]
        public void EndDrawnOutAndAside_OverTheLip_IsNoPassage([Values(0.1, 0.35, 0.9)] double depth,
            [Values(0.0, 0.4, 2.5)] double side, [Values(2.0, 6.0)] double aside, [Values(0.01, 0.05)] double before)
        {
            Vector3d[] from = Straight(depth);
            Vector3d[] to = Moved(from, new Vector3d(aside * Math.Cos(side), aside * Math.Sin(side), -depth - before));
            Assert.That(Meets(from[Elements], to[Elements]), Is.True, "the path of the tip cuts the lip");
            Assert.That(Count(from, to), Is.Zero);
        }

        [Test]
        public void TipThatTunnelsThroughTheWallBesideTheInlet_IsAPassage([Values(0.1, 0.35, 0.9)] double depth,
            [Values(0.0, 0.4, 2.5)] double side, [Values(1.3, 6.0)] double aside, [Values(0.01, 0.05)] double after)
        {
            // No point is inside any more, and the wire crosses the wall nowhere: the path alone shows it.
            Vector3d[] from = Straight(depth);
            Vector3d[] to = Moved(from, new Vector3d(aside * Math.Cos(side), aside * Math.Sin(side), after - depth));
            Assert.That(Count(from, to), Is.GreaterThan(0));
        }

        [Test]
        public void WireThatSlipsRoundTheLip_AndLiesBesideTheTube_IsNoPassage_WhileItsTipIsInside()
        {
            Vector3d[] from = Straight(4.0);
            Vector3d[] to = RoundTheLip();
            Assert.That(Tube.Contains(from[6]) && !Tube.Contains(to[6]) && to[6].Z > 0.0, Is.True, "beside the tube");
            Assert.That(Count(from, to), Is.Zero);
        }

        [Test]
        public void WireThatLiesAcrossTheWall_HasPassedIt_ThoughItsTipIsInside()
        {
            // The same place of the node beside the tube, but the wire goes there through the wall.
            Vector3d[] from = Straight(4.0);
            Vector3d[] to = (Vector3d[])from.Clone();
            to[6] = RoundTheLip()[6];
            Assert.That(Count(from, to), Is.GreaterThan(0));
        }

        // Along the axis, the tip, the last node, at z = depth.
        private static Vector3d[] Straight(double depth)
        {
            var x = new Vector3d[Elements + 1];
            for (int i = 0; i <= Elements; i++)
            {
                x[i] = new Vector3d(0.0, 0.0, depth - Spacing * (Elements - i));
            }
            return x;
        }

        // From the tip inside out of the rim, round the lip, and beside the tube.
        private static Vector3d[] RoundTheLip()
        {
            var line = new[]
            {
                (0.0, 1.0), (0.0, 0.6), (0.0, 0.2), (0.0, -0.2), (0.4, -0.3), (0.8, -0.4), (1.2, -0.4), (1.6, -0.3),
                (1.8, 0.05), (1.9, 0.45), (2.0, 0.85), (2.1, 1.25), (2.2, 1.65), (2.3, 2.05), (2.4, 2.45), (2.5, 2.85),
            };
            var x = new Vector3d[Elements + 1];
            for (int i = 0; i <= Elements; i++)
            {
                (double aside, double z) = line[Elements - i];
                x[i] = new Vector3d(aside, 0.0, z);
            }
            return x;
        }

        private static Vector3d[] Moved(Vector3d[] from, Vector3d by) => Array.ConvertAll(from, x => x + by);

        private static bool Meets(in Vector3d a, in Vector3d b)
        {
            int hint = -1;
            return Tube.Nearest(a, b, 1e-9, ref hint, out _);
        }

        // The same whichever end of the wire is its first, and after a step that was given up, in which it went aside
        // through the wall.
        private static long Count(Vector3d[] from, Vector3d[] to)
        {
            var count = new PassageCount(new Touching(), Elements);
            count.BeginStep();
            count.AddPart(from, Moved(from, 9.0 * Vector3d.UnitX));
            long total = Count(count, from, to);
            Assert.That(Count(count, Reversed(from), Reversed(to)), Is.EqualTo(total), "from the other end");
            return total;
        }

        private static long Count(PassageCount count, Vector3d[] from, Vector3d[] to)
        {
            long before = count.Total;
            count.BeginStep();
            count.AddPart(from, to);
            count.EndStep(from, to);
            return count.Total - before;
        }

        private static Vector3d[] Reversed(Vector3d[] x) => ((IEnumerable<Vector3d>)x).Reverse().ToArray();

        // Every element is asked.
        private sealed class Touching : IWallClearance
        {
            public ContactShape[] Walls { get; } = { Tube };

            public double Radius => 0.01;

            public double ClearanceOf(int w, int j) => 0.0;
        }
    }
}
