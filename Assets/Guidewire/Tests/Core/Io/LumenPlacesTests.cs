using System.Linq;
using Guidewire.Io;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire in the lumen, out of an end, and back beside another one; ways round a loop.</summary>
    internal sealed class LumenPlacesTests
    {
        // A straight tube of radius 2 from z = 0 to 40, open at both ends; a second end beside the first one's outlet.
        private static LumenPlaces Tube(out CentrelinePath path, int target)
        {
            var vessel = new TubeShape(new[] { Vector3d.Zero, new Vector3d(0.0, 0.0, 40.0) }, new[] { 2.0, 2.0 }, true,
                true);
            var anatomy = new Anatomy
            {
                Points = Enumerable.Range(0, 41).Select(k => new Vector3d(0.0, 0.0, k))
                    .Concat(Enumerable.Range(0, 5).Select(k => new Vector3d(2.0 * (k + 1), 0.0, 30.0))).ToArray(),
                Radii = Enumerable.Repeat(2.0, 46).ToArray(),
                Parents = Enumerable.Range(-1, 41).Concat(new[] { 30, 41, 42, 43, 44 }).ToArray(),
                Branches = Enumerable.Range(0, 46).Select(k => k <= 40 ? 0 : 1).ToArray(),
                BranchNames = new[] { "main", "side" },
                Ends = new[]
                {
                    new VesselEnd(1, "in", Vector3d.Zero, 2.0, Vector3d.UnitZ, 0),
                    new VesselEnd(2, "out", new Vector3d(0.0, 0.0, 40.0), 2.0, -Vector3d.UnitZ, 40),
                    new VesselEnd(3, "side", new Vector3d(10.0, 0.0, 30.0), 2.0, -Vector3d.UnitX, 45),
                },
            };
            path = new CentrelinePath(anatomy, anatomy.Ends[0]);
            path.SetTarget(target, "target", 2.0);
            return new LumenPlaces(path, anatomy.Ends, vessel);
        }

        private static Vector3d[] Wire(double tip) =>
            Enumerable.Range(-20, 21).Select(k => new Vector3d(0.1, 0.0, tip + 2.0 * k)).ToArray();

        [Test]
        public void TipInTheLumen_IsWhereItIs()
        {
            LumenPlace place = Tube(out _, 40).Of(Wire(30.5));
            Assert.That(place.IsInside, Is.True);
            Assert.That(place.Point, Is.EqualTo(Wire(30.5).Last()));
            Assert.That(place.Distance, Is.EqualTo(30.5).Within(1e-12));
            Assert.That(place.Left, Is.EqualTo(9.5).Within(1e-12));
            Assert.That(place.IsAtTarget, Is.False);
        }

        [Test]
        public void TipThatLeftByTheOutlet_StaysThere_WhereverItGoes()
        {
            Vector3d[] wire = Wire(39.0).Concat(new[] { new Vector3d(0.1, 0.0, 42.0), new Vector3d(5.0, 0.0, 44.0),
                new Vector3d(10.0, 0.0, 38.0), new Vector3d(10.0, 0.0, 30.0) }).ToArray();
            LumenPlace place = Tube(out CentrelinePath path, 45).Of(wire);
            Assert.That(place.IsInside, Is.False);
            Assert.That(place.Point, Is.EqualTo(new Vector3d(0.1, 0.0, 39.0)));
            Assert.That(place.IsAtTarget, Is.False, "though the tip is at the side branch's end");
            Assert.That(place.Left, Is.EqualTo(9.0 + 10.0).Within(1e-12));
            Assert.That(Tube(out _, 40).Of(wire).IsAtTarget, Is.True, "it went through the outlet");
        }

        [Test]
        public void TipThatLeftAndCameBackIntoTheLumen_IsNotInside()
        {
            Vector3d[] wire = Wire(39.0).Concat(new[] { new Vector3d(0.1, 0.0, 41.0), new Vector3d(1.0, 0.0, 41.5),
                new Vector3d(1.0, 0.0, 39.5) }).ToArray();
            LumenPlace place = Tube(out _, 40).Of(wire);
            Assert.That(place.IsInside, Is.False);
            Assert.That(place.Point.Z, Is.EqualTo(39.0));
        }

        [Test]
        public void WireBehindTheInlet_IsAtTheInlet()
        {
            LumenPlace place = Tube(out _, 40).Of(Wire(-3.0));
            Assert.That(place.IsInside, Is.False);
            Assert.That(place.Near, Is.EqualTo(0));
            Assert.That(place.Left, Is.EqualTo(40.0).Within(1e-12));
        }

        [Test]
        public void RoundALoop_TheShorterWayCounts()
        {
            // Twelve points of a circle in a row; the first and the last are linked.
            var ring = new Anatomy
            {
                Points = Enumerable.Range(0, 12).Select(k => new Vector3d(System.Math.Cos(k * System.Math.PI / 6.0),
                    System.Math.Sin(k * System.Math.PI / 6.0), 0.0)).ToArray(),
                Radii = Enumerable.Repeat(0.1, 12).ToArray(),
                Parents = Enumerable.Range(-1, 12).ToArray(),
                Branches = new int[12],
                BranchNames = new[] { "ring" },
                Links = new[] { (11, 0) },
            };
            var path = new CentrelinePath(ring, new VesselEnd(1, "in", ring.Points[0], 0.1, Vector3d.UnitY, 0));
            double step = 2.0 * System.Math.Sin(System.Math.PI / 12.0);
            Assert.That(path.Distances[11], Is.EqualTo(step).Within(1e-12));
            Assert.That(path.Distances[8], Is.EqualTo(4.0 * step).Within(1e-12));
            Assert.That(path.Distances[5], Is.EqualTo(5.0 * step).Within(1e-12));
        }
    }
}
