using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A line of knots with its corners rounded.</summary>
    public class RoundedCentrelineTests
    {
        private const double Degree = Math.PI / 180.0;

        [TestCase(6, 40.0)]
        [TestCase(24, 40.0)]
        [TestCase(90, 7.0)]
        public void Round_MakesOneArc_OfKnotsOnACircle(int pieces, double radius)
        {
            double turn = 0.5 * Math.PI / pieces;
            Vector3d[] knots = Arc(pieces, radius);
            double[] radii = Array.ConvertAll(knots, _ => 2.0);
            RoundedCentreline.Round(ref knots, ref radii);
            double arc = radius * Math.Cos(0.5 * turn);  // touches every piece in its middle
            double length = 2.0 * radius * Math.Sin(0.5 * turn);
            for (int k = 1; k + 1 < knots.Length; k++)
            {
                Assert.That((knots[k] - new Vector3d(0.0, radius, 0.0)).Length, Is.EqualTo(arc).Within(1e-9 * radius));
                Assert.That(TurnAt(knots, k), Is.LessThan(0.5 * Degree * (1.0 + 1e-9)));
                Assert.That(Vector3d.Distance(knots[k], knots[k - 1]), Is.LessThan(0.51 * length));
                Assert.That(radii[k], Is.EqualTo(2.0).Within(1e-15));
            }
        }

        [Test]
        public void Round_KeepsEndsAndStraightLines_AndReachesEveryRadius()
        {
            var given = new[] { Vector3d.Zero, new Vector3d(0.0, 0.0, 50.0), new Vector3d(0.0, 0.0, 90.0),
                new Vector3d(0.0, 30.0, 90.0), new Vector3d(-80.0, 30.0, 90.0) };
            var widths = new[] { 3.0, 1.0, 4.0, 2.0, 5.0 };
            Vector3d[] knots = given;
            double[] radii = widths;
            RoundedCentreline.Round(ref knots, ref radii);
            Assert.That(knots[0], Is.EqualTo(given[0]));
            Assert.That(knots[1], Is.EqualTo(given[1]), "a knot where the line goes straight on");
            Assert.That(knots[knots.Length - 1], Is.EqualTo(given[4]));
            foreach (double width in widths)
            {
                Assert.That(radii, Has.Some.EqualTo(width).Within(1e-12));
            }
            for (int k = 1; k + 1 < knots.Length; k++)
            {
                Assert.That(TurnAt(knots, k), Is.LessThan(0.5 * Degree * (1.0 + 1e-9)));
            }

            // Both corners turn by 90 degrees, with arcs of half the shorter piece: t = 15, r = t.
            double length = 0.0;
            for (int k = 1; k < knots.Length; k++)
            {
                length += Vector3d.Distance(knots[k - 1], knots[k]);
            }
            Assert.That(length, Is.EqualTo(75.0 + 65.0 + 2.0 * 15.0 * 0.5 * Math.PI).Within(1e-3));
        }

        [Test]
        public void Round_LeavesALineThatGoesBack()
        {
            var given = new[] { Vector3d.Zero, new Vector3d(0.0, 0.0, 50.0), new Vector3d(0.0, 1e-3, 20.0) };
            Vector3d[] knots = given;
            double[] radii = { 3.0, 1.0, 4.0 };
            RoundedCentreline.Round(ref knots, ref radii);
            Assert.That(knots, Is.EqualTo(given));
            Assert.That(radii, Is.EqualTo(new[] { 3.0, 1.0, 4.0 }));
        }

        private static Vector3d[] Arc(int pieces, double radius)
        {
            var knots = new Vector3d[pieces + 1];
            for (int k = 0; k <= pieces; k++)
            {
                double at = 0.5 * Math.PI * k / pieces;
                knots[k] = radius * new Vector3d(0.0, 1.0 - Math.Cos(at), Math.Sin(at));
            }
            return knots;
        }

        private static double TurnAt(Vector3d[] knots, int k)
        {
            Vector3d before = knots[k] - knots[k - 1];
            Vector3d after = knots[k + 1] - knots[k];
            return Math.Atan2(Vector3d.Cross(before, after).Length, Vector3d.Dot(before, after));
        }
    }
}
