using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>How walls that give way are drawn.</summary>
    public sealed class WallIndentationTests
    {
        private const double Radius = 0.5;   // units, of half a metre
        private const double Metres = 0.5;
        private const double Sunk = 0.3;     // units
        private static readonly Vector3d[][] Wire =
            { new[] { Vector3d.Zero, 2.0 * Vector3d.UnitZ, 4.0 * Vector3d.UnitZ } };
        private static readonly Vector3d[][] Pressed =
            { new[] { -(Metres * Sunk) * Vector3d.UnitY, Vector3d.Zero } };

        [Test]
        public void Vertex_AtTheContact_GoesWithIt_AndFarOnesStay()
        {
            var rest = new[]
            {
                new Vector3d(0.0, -0.2, 1.0),     // where the wire presses
                new Vector3d(0.0, 0.5, 1.0),      // on its other side
                new Vector3d(0.0, -0.2, 4.0),     // beside the element that presses
                new Vector3d(0.0, -0.2, 5.0),
            };
            WallIndentation drawn = Of(rest);
            Assert.That(drawn.Move(Wire, Pressed), Is.True);
            Vector3d[] moved = drawn.Vertices;
            Assert.That((moved[0] - rest[0] + Sunk * Vector3d.UnitY).Length, Is.LessThan(1e-15));
            Assert.That(moved[1], Is.EqualTo(rest[1]));
            Assert.That(moved[2].Y, Is.LessThan(rest[2].Y).And.GreaterThan(rest[2].Y - 0.1 * Sunk));
            Assert.That(moved[3], Is.EqualTo(rest[3]));
            Assert.That(drawn.Move(Wire, Array.Empty<Vector3d[]>()), Is.True, "it returns");
            Assert.That(moved, Is.EqualTo(rest));
        }

        [Test]
        public void OfTwoInstruments_TheOneThatPressesFarther_Counts()
        {
            var rest = new[] { new Vector3d(0.0, -0.2, 1.0) };
            WallIndentation drawn = Of(rest);
            drawn.Move(new[] { Wire[0], Wire[0] }, new[] { new Vector3d[2], Pressed[0] });
            Assert.That(drawn.Vertices[0].Y, Is.EqualTo(-0.2 - Sunk).Within(1e-15));
            drawn.Move(new[] { Wire[0], Wire[0] }, new[] { new[] { 2.0 * Pressed[0][0], Vector3d.Zero }, Pressed[0] });
            Assert.That(drawn.Vertices[0].Y, Is.EqualTo(-0.2 - 2.0 * Sunk).Within(1e-15));
        }

        [Test]
        public void Displacement_FadesSmoothly_ToNothing()
        {
            double before = Sunk;
            for (int k = 0; k <= 100; k++)
            {
                var x = new Vector3d(0.0, -Radius, 2.0 + 0.03 * k);
                WallIndentation drawn = Of(new[] { x });
                drawn.Move(Wire, Pressed);
                double size = Vector3d.Distance(x, drawn.Vertices[0]);
                Assert.That(size, Is.AtMost(before + 1e-12).And.GreaterThan(before - 0.05 * Sunk), "place " + k);
                before = size;
            }
            Assert.That(before, Is.EqualTo(0.0));
        }

        [Test]
        public void WithoutDisplacements_AndWhereTheWallIsRigid_NothingMoves()
        {
            var rest = new[] { new Vector3d(0.0, -0.2, 1.0) };
            Assert.That(Of(rest).Move(Wire, new[] { new Vector3d[2] }), Is.False);
            Assert.That(Of(rest).Move(Wire, Array.Empty<Vector3d[]>()), Is.False);
            WallIndentation rigid = Of(rest, null);
            Assert.That(rigid.Move(Wire, Pressed), Is.False);
            Assert.That(rigid.Vertices, Is.EqualTo(rest));
        }

        private static WallIndentation Of(Vector3d[] vertices) => Of(vertices, new WallSoftness("wall", 1e5));

        private static WallIndentation Of(Vector3d[] vertices, WallSoftness? softness)
        {
            var parameters = new SimulationParameters();
            parameters.Scene.MetresPerUnit = Metres;
            parameters.Material.WireRadius = Metres * Radius;
            parameters.Scene.Catheters = new[] { new Catheter { Material = { WireRadius = Metres * Radius } } };
            var wall = new PlaneShape(Vector3d.Zero, Vector3d.UnitY) { Softness = softness };
            return new WallIndentation(parameters, wall, vertices);
        }
    }
}
