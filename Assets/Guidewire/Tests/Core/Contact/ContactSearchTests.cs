using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What the search says of a wire among walls, against the walls' own distances.</summary>
    internal sealed class ContactSearchTests
    {
        private const int Elements = 8;
        private const double Length = 2.0;    // of an element, units
        private const double Radius = 0.2;
        private const double Reach = 0.3;

        private static readonly ContactShape[] Walls =
        {
            new PlaneShape(Vector3d.Zero, Vector3d.UnitY),
            ConvexObstacle.Sphere(new Vector3d(0.0, 1.0, 7.3), 0.4),
            ConvexObstacle.Capsule(new Vector3d(-3.0, 1.0, 11.0), new Vector3d(3.0, 1.0, 11.0), 0.3),
        };

        [Test]
        public void Contacts_NameTheirWall_AndWhatOfTheWireIsThere()
        {
            var random = new RandomGeometry(71);
            var search = new ContactSearch(Walls, Elements, Length, Radius, Reach, true);
            var seen = new int[Walls.Length];
            for (int i = 0; i < RandomGeometry.Cases(2_000); i++)
            {
                Vector3d[] x = Wire(random);
                search.Find(x, x);
                Assert.That(search.Impacts.Count, Is.Zero, "a wire that does not move, case " + i);
                for (int k = 0; k < search.Contacts.Count; k++)
                {
                    WireContact found = search.Contacts[k];
                    seen[found.Wall]++;
                    Vector3d at = found.IsElement
                        ? Vector3d.Lerp(x[found.Index], x[found.Index + 1], found.Nearest.Position) : x[found.Index];
                    Assert.That(found.Nearest.Distance, Is.EqualTo(Distance(found.Wall, at, at)).Within(1e-9));
                }
            }
            Assert.That(seen, Has.All.GreaterThan(0));
        }

        [Test]
        public void Clearance_OfAnElement_IsNoMoreThanItsDistanceAtTheStart_FromAnyWall()
        {
            var random = new RandomGeometry(72);
            var search = new ContactSearch(Walls, Elements, Length, Radius, Reach, true);
            for (int i = 0; i < RandomGeometry.Cases(2_000); i++)
            {
                Vector3d[] from = Wire(random);
                Vector3d[] to = Array.ConvertAll(from, x => x + 0.2 * random.Point());
                search.Find(from, to);
                for (int j = 0; j < Elements; j++)
                {
                    for (int w = 0; w < Walls.Length; w++)
                    {
                        Assert.That(search.ClearanceOf(w, j), Is.LessThan(Distance(w, from[j], from[j + 1]) + 1e-9));
                    }
                }
            }
        }

        [Test]
        public void SweptSearch_ListsWhatWouldPassAWall_AndNothingElse()
        {
            // Down through the plane: every sphere and every element; along it: none.
            var search = new ContactSearch(new[] { Walls[0] }, Elements, Length, Radius, Reach, true);
            var swept = new SweptSearch(search, Elements + 1);
            var from = new Vector3d[Elements + 1];
            for (int i = 0; i <= Elements; i++)
            {
                from[i] = new Vector3d(0.0, 0.5, Length * i);
            }
            Vector3d[] through = Array.ConvertAll(from, x => x - Vector3d.UnitY);
            search.Find(from, through);
            Assert.That(swept.Find(from, through), Is.True);
            Assert.That(swept.Impacts.Count, Is.EqualTo(2 * Elements + 1));
            Vector3d[] along = Array.ConvertAll(from, x => x + 5.0 * Vector3d.UnitX);
            search.Find(from, along);
            Assert.That(swept.Find(from, along), Is.False);
            Assert.That(swept.Impacts.Count, Is.Zero);
        }

        [TestCase(double.NaN, false)]
        [TestCase(double.PositiveInfinity, false)]
        [TestCase(double.NaN, true)]
        [TestCase(double.PositiveInfinity, true)]
        public void ShortenedMotion_OfAWireThatIsLost_Ends_AndIsFreeWhereItIsFinite(double lost, bool isAll)
        {
            Vector3d[] knots = { Vector3d.Zero, new(0.0, 0.0, 10.0), new(0.0, 3.0, 20.0) };
            var tube = new ContactShape[] { new TubeShape(knots, new[] { 1.0, 1.0, 1.0 }, true, true) };
            var search = new ContactSearch(tube, Elements, Length, Radius, Reach, true);
            var swept = new SweptSearch(search, Elements + 1);
            var from = new Vector3d[Elements + 1];
            var to = new Vector3d[Elements + 1];
            for (int i = 0; i <= Elements; i++)
            {
                from[i] = new Vector3d(0.0, 0.0, 0.5 * Length * i);
                to[i] = from[i] + 5.0 * Vector3d.UnitY;
                to[i] = isAll || i == 3 ? new Vector3d(0.0, lost, 0.0) : to[i];
            }
            search.Find(from, to);
            new ShortenedMotion(swept, Elements + 1).Shorten(from, to);
            for (int i = 0; i <= Elements; i++)
            {
                Assert.That(to[i].IsFinite, Is.EqualTo(!isAll && i != 3), "a lost sphere stays lost");
                Assert.That(!to[i].IsFinite || to[i].Y < 1.0, "sphere " + i);
            }
        }

        // Free of all walls, near some of them.
        private static Vector3d[] Wire(RandomGeometry random)
        {
            while (true)
            {
                var x = new Vector3d[Elements + 1];
                bool isFree = true;
                for (int i = 0; i <= Elements; i++)
                {
                    x[i] = new Vector3d(random.Number(-0.5, 0.5), random.Number(0.1, 2.5), Length * i);
                    for (int w = 0; w < Walls.Length && i > 0; w++)
                    {
                        isFree &= Distance(w, x[i - 1], x[i]) > 0.01;
                    }
                }
                if (isFree)
                {
                    return x;
                }
            }
        }

        private static double Distance(int wall, in Vector3d a, in Vector3d b)
        {
            int hint = -1;
            Walls[wall].Nearest(a, b, double.PositiveInfinity, ref hint, out SurfaceContact contact);
            return contact.Distance;
        }
    }
}
