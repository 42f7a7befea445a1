using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>How walls that give way are drawn.</summary>
    public sealed class WallIndentationTests
    {
        private const double Radius = 0.5;
        private const double Sunk = 0.3;
        private static readonly Vector3d[] Wire = { Vector3d.Zero, 2.0 * Vector3d.UnitZ, 4.0 * Vector3d.UnitZ };
        private static readonly Vector3d[] Indentations = { -Sunk * Vector3d.UnitY, Vector3d.Zero };

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
            var moved = new Vector3d[rest.Length];
            Assert.That(WallIndentation.Move(rest, Wire, Indentations, Radius, moved), Is.True);
            Assert.That(moved[0], Is.EqualTo(rest[0] - Sunk * Vector3d.UnitY));
            Assert.That(moved[1], Is.EqualTo(rest[1]));
            Assert.That(moved[2].Y, Is.LessThan(rest[2].Y).And.GreaterThan(rest[2].Y - 0.1 * Sunk));
            Assert.That(moved[3], Is.EqualTo(rest[3]));
        }

        [Test]
        public void Displacement_FadesSmoothly_ToNothing()
        {
            var moved = new Vector3d[1];
            double before = Sunk;
            for (int k = 0; k <= 100; k++)
            {
                var x = new Vector3d(0.0, -Radius, 2.0 + 0.03 * k);
                WallIndentation.Move(new[] { x }, Wire, Indentations, Radius, moved);
                double size = Vector3d.Distance(x, moved[0]);
                Assert.That(size, Is.AtMost(before + 1e-12).And.GreaterThan(before - 0.05 * Sunk), "place " + k);
                before = size;
            }
            Assert.That(before, Is.EqualTo(0.0));
        }

        [Test]
        public void WithoutIndentations_NothingMoves()
        {
            var rest = new[] { new Vector3d(0.0, -0.2, 1.0) };
            var moved = new Vector3d[1];
            Assert.That(WallIndentation.Move(rest, Wire, new Vector3d[2], Radius, moved), Is.False);
            Assert.That(moved, Is.EqualTo(rest));
            Assert.That(WallIndentation.Move(rest, Wire, Array.Empty<Vector3d>(), Radius, moved), Is.False);
        }
    }
}
