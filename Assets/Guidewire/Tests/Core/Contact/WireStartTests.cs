using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Wires that start in a lumen, or in none, or in one that is too narrow for them on their way.</summary>
    internal sealed class WireStartTests
    {
        private const double Length = 100.0;

        [Test]
        public void WireOutside_IsToldWhereItAndTheVesselAre()
        {
            SimulationParameters p = Wire(0.5);
            p.Scene.GuidewireOffset = 20.0;
            p.Scene.Walls = new ContactShape[] { new TubeShape(
                new[] { new Vector3d(50.0, 0.0, 0.0), new Vector3d(50.0, 0.0, 90.0) }, new[] { 4.0, 4.0 }, true,
                true) };
            Assert.That(WireStart.FindProblem(p), Does.Contain("starts outside")
                .And.Contain("the wire reaches from (0, 0, 20) to (0, 0, 120)")
                .And.Contain("the vessel from (46, -4, -4) to (54, 4, 94)"));
        }

        [TestCase(4.0, 3.0, 1.0, true, TestName = "Stenosis narrower than the wire, on its way")]
        [TestCase(2.9, 3.0, 1.0, false, TestName = "Stenosis wider than the wire")]
        [TestCase(4.0, 3.0, 0.1, false, TestName = "Stenosis narrower than the wire, farther than it is pushed")]
        public void Tube_OfAStenosis(double radius, double narrow, double perStep, bool isRefused)
        {
            // The wire lies from 0 to 100; 200 steps push it by 200 or by 20; the stenosis is at 200.
            SimulationParameters p = Wire(radius);
            p.Drive.DisplacementPerStep = perStep;
            p.Scene.Walls = new ContactShape[] { Tube(new[] { 6.0, 6.0, narrow, 6.0 }, 100.0) };
            string? problem = WireStart.FindProblem(p);
            Assert.That(problem == null, Is.Not.EqualTo(isRefused), problem);
            if (isRefused)
            {
                Assert.That(problem, Does.Contain("sphereRadius = 4 is larger than the lumen")
                    .And.Contain("3 units at (0, 0, 200)"));
            }
        }

        [TestCase(1.15, true)]
        [TestCase(0.95, false)]
        public void Mesh_OfAStenosis(double radius, bool isRefused)
        {
            // Radius 2 but for a dip to 1 at z = 150; the wire lies from 20 to 80, off the axis.
            TestMeshes tube = TestMeshes.Tube(
                48, 400, 200.0, z => 2.0 - Math.Exp(-(z - 150.0) * (z - 150.0) / 50.0));
            SimulationParameters p = Wire(radius);
            p.Scene.GuidewireLength = 60.0;
            p.Scene.GuidewireOffset = 20.0;
            p.Scene.Walls = new ContactShape[] { new MeshShape(
                tube.Build(Vector3d.Zero, 200.0 * Vector3d.UnitZ),
                new Placement(new Vector3d(0.5, 0.3, 0.0), Quaterniond.Identity, new Vector3d(1.0, 1.0, 1.0))) };
            string? problem = WireStart.FindProblem(p);
            Assert.That(problem == null, Is.Not.EqualTo(isRefused), problem);
            if (isRefused)
            {
                Scene scene = new Scene(p);
                var lumen = new LumenWidth(p.Scene.Walls[0], radius);
                Assert.That(lumen.IsTooNarrow(scene.Shape.X, 200.0), Is.True);
                Assert.That(lumen.Width, Is.EqualTo(1.0).Within(0.02));
                Assert.That(lumen.Centre.Z, Is.EqualTo(150.0).Within(1.0));
                Assert.That(problem, Does.Contain("sphereRadius = 1.15 is larger than the lumen"));
            }
        }

        [Test]
        public void Lumen_ThatEndsBeforeTheWire_IsNoNarrowing()
        {
            // A cone to a closed end: the wire stops in it, as at any end of a vessel.
            SimulationParameters p = Wire(3.0);
            Vector3d[] knots = { Vector3d.Zero, 100.0 * Vector3d.UnitZ, 200.0 * Vector3d.UnitZ };
            p.Scene.Walls = new ContactShape[] { new TubeShape(knots, new[] { 6.0, 6.0, 1.0 }, true, false) };
            Assert.That(WireStart.FindProblem(p), Is.Null);
            p.Scene.Walls = new ContactShape[] { new TubeShape(knots, new[] { 6.0, 6.0, 1.0 }, true, true) };
            Assert.That(WireStart.FindProblem(p), Does.Contain("larger than the lumen"));

            TestMeshes ball = TestMeshes.Ball(20, 0.2);
            p = Wire(2.0);
            p.Scene.GuidewireOffset = -50.0;
            p.Scene.Walls = new ContactShape[] { new MeshShape(
                ball.Build(), new Placement(Vector3d.Zero, Quaterniond.Identity, new Vector3d(20.0, 30.0, 60.0))) };
            Assert.That(WireStart.FindProblem(p), Is.Null);
        }

        [Test]
        public void Wire_ThickerThanTheLumenThatItLiesIn_IsRefused()
        {
            SimulationParameters p = Wire(5.0);
            p.Drive.DisplacementPerStep = 0.0;
            p.Scene.Walls = new ContactShape[] { Tube(new[] { 4.0, 4.0 }, 300.0) };
            Assert.That(WireStart.FindProblem(p), Does.Contain("sphereRadius = 5 is larger than the lumen")
                .And.Contain("4 units"));
            TestMeshes tube = TestMeshes.Tube(48, 300, 300.0, z => 4.0);
            p.Scene.GuidewireOffset = 50.0;
            p.Scene.Walls = new ContactShape[] { new MeshShape(tube.Build(Vector3d.Zero, 300.0 * Vector3d.UnitZ)) };
            Assert.That(WireStart.FindProblem(p), Does.Contain("sphereRadius = 5 is larger than the lumen"));
        }

        [TestCase(1.0, false)]
        [TestCase(1000.0, true)]
        [TestCase(0.001, true)]
        public void VesselOfAnotherUnit_IsToldBesideTheWire(double factor, bool isOdd)
        {
            SimulationParameters p = Wire(factor < 1.0 ? 0.001 : 1.0);
            p.Scene.Walls = new ContactShape[] { new TubeShape(
                new[] { Vector3d.Zero, 300.0 * factor * Vector3d.UnitZ }, new[] { 5.0 * factor, 5.0 * factor }, true,
                true) };
            string? line = WireStart.FindOddSizes(p, "vessel.json");
            Assert.That(line != null, Is.EqualTo(isOdd), line);
            if (isOdd)
            {
                Assert.That(line, Does.Contain("the wire 100 units long"));
                Assert.That(line, Does.Contain(factor > 1.0 ? "the vessel is 3.1E+05 units long" : "is 0.31 units"));
            }
        }

        [Test]
        public void VesselFarFromTheOrigin_IsNoOddOne_ForAWireInMetres()
        {
            SimulationParameters p = WallScenes.Wire(20, 0.18e-3);
            p.Scene.GuidewireOffset = 1000.0;
            p.Scene.Walls = new ContactShape[] { new TubeShape(
                new[] { 990.0 * Vector3d.UnitZ, 1600.0 * Vector3d.UnitZ }, new[] { 5.0, 5.0 }, true, true) };
            Assert.That(WireStart.FindOddSizes(p, "vessel.json"), Is.Null);
            p.Scene.Walls = new ContactShape[] { new TubeShape(
                new[] { 990.0 * Vector3d.UnitZ, 1600.0 * Vector3d.UnitZ }, new[] { 90.0, 90.0 }, true, true) };
            Assert.That(WireStart.FindOddSizes(p, "vessel.json"),
                Does.Contain("its wall 90 units from the wire's tip"));
        }

        private static SimulationParameters Wire(double radius)
        {
            var p = new SimulationParameters();
            p.Scene.GuidewireLength = Length;
            p.Scene.GuidewireOffset = 0.0;
            p.Scene.NumberRodElements = 10;
            p.Contact.SphereRadius = radius;
            p.Drive.Kind = Drive.Push;
            p.Drive.DisplacementPerStep = 1.0;
            p.Method.MaxSimulationSteps = 200;
            return p;
        }

        private static TubeShape Tube(double[] radii, double spacing)
        {
            var knots = new Vector3d[radii.Length];
            for (int i = 0; i < knots.Length; i++)
            {
                knots[i] = i * spacing * Vector3d.UnitZ;
            }
            return new TubeShape(knots, radii, true, true);
        }
    }
}
