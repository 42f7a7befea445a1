using System;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Edges of hulls, and what segments meet of them.</summary>
    public sealed class HullEdgesTests
    {
        private const double Flatness = 1e-9;

        [Test]
        public void Box_HasTwelveEdges_OfAQuarterTurn()
        {
            ConvexObstacle box = ConvexObstacle.Box(
                new Vector3d(1.0, 2.0, 3.0), new Vector3d(0.5, 1.0, 2.0), RandomTurn(1));
            HullEdges.Edge[] edges = HullEdges.Find(box.Points, Flatness);
            Assert.That(edges, Has.Length.EqualTo(12));
            Assert.That(edges.Select(edge => edge.Angle), Is.All.EqualTo(0.5 * Math.PI).Within(1e-9));
            // Four of each length.
            double[] lengths = edges.Select(edge => Vector3d.Distance(box.Points[edge.Start], box.Points[edge.End]))
                .OrderBy(length => length).ToArray();
            for (int k = 0; k < 12; k++)
            {
                Assert.That(lengths[k], Is.EqualTo(new[] { 1.0, 2.0, 4.0 }[k / 4]).Within(1e-12));
            }
        }

        [Test]
        public void Plate_Line_AndPoint_HaveTheirOutlines()
        {
            var plate = new[]
            {
                Vector3d.Zero, Vector3d.UnitX, Vector3d.UnitY, Vector3d.UnitX + Vector3d.UnitY,
                0.5 * Vector3d.UnitX + 0.5 * Vector3d.UnitY,
            };
            HullEdges.Edge[] edges = HullEdges.Find(plate, Flatness);
            Assert.That(edges, Has.Length.EqualTo(4));
            Assert.That(edges.Select(edge => edge.Angle), Is.All.EqualTo(Math.PI).Within(1e-9));
            // Points between the ends of a line, and points twice, are no edges of their own.
            edges = HullEdges.Find(
                new[] { Vector3d.Zero, 2.0 * Vector3d.UnitZ, Vector3d.UnitZ, Vector3d.Zero }, Flatness);
            Assert.That(edges, Has.Length.EqualTo(2));
            edges = HullEdges.Find(new[] { Vector3d.UnitX }, Flatness);
            Assert.That(edges, Has.Length.EqualTo(1));
            Assert.That(edges[0].Start, Is.EqualTo(edges[0].End));
        }

        [Test]
        public void RandomHull_HasAsManyEdgesAsEulerSays_AndNothingOutside()
        {
            var random = new RandomGeometry(5);
            for (int count = 4; count <= 40; count += 6)
            {
                Vector3d[] points = Enumerable.Range(0, count).Select(_ => random.Point()).ToArray();
                HullEdges.Edge[] edges = HullEdges.Find(points, Flatness);
                int corners = edges.SelectMany(edge => new[] { edge.Start, edge.End }).Distinct().Count();
                // All faces of points in general position are triangles.
                Assert.That(edges, Has.Length.EqualTo(3 * corners - 6), count + " points");
                foreach (HullEdges.Edge edge in edges)
                {
                    Vector3d middle = 0.5 * (points[edge.Start] + points[edge.End]);
                    var hull = new ConvexObstacle(points, 0.0);
                    int hint = -1;
                    hull.Nearest(middle, middle, double.PositiveInfinity, ref hint, out SurfaceContact contact);
                    Assert.That(contact.Distance, Is.EqualTo(0.0).Within(1e-9), "an edge lies on the hull");
                }
            }
        }

        [Test]
        public void TiltingOverABoxesFace_AnElementHasNoKink()
        {
            // Parallel to a face and longer than it, both edges below are met; the sum of the weighted functions of
            // their distances is smooth where the nearest place jumps from one edge to the other.
            ConvexObstacle box = ConvexObstacle.Box(Vector3d.Zero, new Vector3d(1.0, 1.0, 1.0), Quaterniond.Identity);
            double step = 1e-3;
            double before = Slope(box, -step);
            double after = Slope(box, step);
            double atRest = Slope(box, 0.0);
            // By symmetry the slope is odd: any kink is a jump of it at 0.
            Assert.That(atRest, Is.EqualTo(0.0).Within(1e-9));
            Assert.That(after, Is.EqualTo(-before).Within(1e-7));
            Assert.That(Slope(box, 0.5 * step), Is.EqualTo(0.5 * after).Within(0.01 * Math.Abs(after)));
        }

        // Derivative with the tilt of the sum of W (0.2 - d)^3 over the ridges of a segment 0.1 above the face.
        private static double Slope(ConvexObstacle box, double tilt)
        {
            const double h = 1e-5;
            return (Sum(box, tilt + h) - Sum(box, tilt - h)) / (2.0 * h);
        }

        private static double Sum(ConvexObstacle box, double tilt)
        {
            var edgeContacts = new StructList<EdgeContact>(8);
            box.FindEdgeContacts(
                new Vector3d(-3.0, 1.1 - 3.0 * tilt, 0.1), new Vector3d(3.0, 1.1 + 3.0 * tilt, 0.2), 0.2,
                default, edgeContacts);
            double sum = 0.0;
            for (int k = 0; k < edgeContacts.Count; k++)
            {
                sum += edgeContacts[k].Weight * Math.Pow(0.2 - edgeContacts[k].Distance, 3.0);
            }
            Assert.That(edgeContacts.Count, Is.GreaterThanOrEqualTo(2), "both edges are met");
            return sum;
        }

        private static Quaterniond RandomTurn(int seed) => RotationVector.Exp(2.0 * new RandomGeometry(seed).Point());
    }
}
