using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What holds for the places that every shape lists: the nearest is among them, normal and curvature are
    /// the first and second derivative of the distance, and sums over them have no jumps.</summary>
    internal sealed class ContactPointTests
    {
        private const double Tolerance = 1e-9;

        [TestCaseSource(typeof(TestShapes), nameof(TestShapes.Names))]
        public void Places_HoldTheNearest_AndNothingBeyondTheRange(string name)
        {
            ContactShape shape = TestShapes.Make(name);
            var random = new RandomGeometry(51);
            var places = new StructList<ContactPoint>(1);
            int found = 0;
            for (int i = 0; i < RandomGeometry.Cases(10_000); i++)
            {
                Vector3d x = random.Point();
                double range = random.Number(0.0, 1.0);
                int hint = -1;
                bool isNear = shape.Nearest(x, x, range, ref hint, out SurfaceContact nearest);
                places.Clear();
                shape.FindContactPoints(x, range, default, places);
                Assert.That(places.Count > 0, Is.EqualTo(isNear), "case " + i);
                double least = double.PositiveInfinity;
                double signed = 0.0;
                for (int k = 0; k < places.Count; k++)
                {
                    SurfaceContact contact = places[k].Contact;
                    Assert.That(contact.Distance, Is.LessThanOrEqualTo(range * (1.0 + 1e-12)), "case " + i);
                    Assert.That(contact.Position, Is.InRange(0.0, 1.0), "case " + i);
                    Assert.That(
                        (contact.Point + contact.Distance * contact.Normal - x).Length, Is.LessThan(Tolerance),
                        "case " + i);
                    Assert.That(contact.Normal.Length, Is.EqualTo(1.0).Within(Tolerance), "case " + i);
                    Assert.That(places[k].Weight, Is.Not.Zero, "case " + i);

                    // A mesh looks for what is nearest on either side; all others know how deep a point is.
                    double measure = shape is MeshShape ? Math.Abs(contact.Distance) : contact.Distance;
                    signed = measure < least ? contact.Distance : signed;
                    least = Math.Min(least, measure);
                }
                found += isNear ? 1 : 0;
                if (isNear)
                {
                    Assert.That(signed, Is.EqualTo(nearest.Distance).Within(Tolerance), "case " + i);
                }
            }
            Assert.That(found, Is.GreaterThan(100));
        }

        [TestCaseSource(typeof(TestShapes), nameof(TestShapes.Names))]
        public void NormalAndCurvature_AreTheDerivativesOfTheDistanceOfAPoint(string name)
        {
            // Central differences with step h of a function of size 1 and curvature 1/d: rounding 1e-16/h = 1e-11, the
            // next term h^2/d^3, 1e-6 where d is 0.01.
            const double H = 1e-6;
            const double Near = 1e-2;
            ContactShape shape = TestShapes.Make(name);
            var random = new RandomGeometry(52);
            var places = new StructList<ContactPoint>(1);
            var ahead = new StructList<ContactPoint>(1);
            var behind = new StructList<ContactPoint>(1);
            int tested = 0;
            int all = 0;
            int cases = RandomGeometry.Cases(3_000);
            for (int i = 0; i < cases; i++)
            {
                Vector3d x = random.Point();
                Vector3d e = random.Direction();
                Find(shape, x, places);
                Find(shape, x + H * e, ahead);
                Find(shape, x - H * e, behind);
                for (int k = 0; k < places.Count; k++)
                {
                    ContactPoint place = places[k];
                    bool isRound = place.Curvature != 0.0 || place.CrossCurvature != 0.0;
                    bool isInside = shape is ConvexObstacle && place.Contact.Distance < 0.0;
                    if (Math.Abs(place.Contact.Distance) < Near || isInside
                        || (isRound && Radius(place) < Near))
                    {
                        continue;
                    }
                    all++;
                    if (!Same(ahead, place, out ContactPoint next) || !Same(behind, place, out ContactPoint last))
                    {
                        continue;
                    }
                    tested++;
                    double slope = (next.Contact.Distance - last.Contact.Distance) / (2.0 * H);
                    Vector3d turn = (next.Contact.Normal - last.Contact.Normal) / (2.0 * H);
                    Vector3d t1 = place.Direction;
                    Vector3d t2 = Vector3d.Cross(place.Contact.Normal, t1);
                    Vector3d expected = place.Curvature * Vector3d.Dot(t1, e) * t1
                        + place.CrossCurvature * Vector3d.Dot(t2, e) * t2;
                    Assert.That(slope, Is.EqualTo(Vector3d.Dot(place.Contact.Normal, e)).Within(1e-6), "case " + i);
                    Assert.That((turn - expected).Length, Is.LessThan(1e-5 / Near), "case " + i + " at " + x);
                    Assert.That(t1.Length, Is.EqualTo(1.0).Within(Tolerance));
                    Assert.That(Vector3d.Dot(t1, place.Contact.Normal), Is.EqualTo(0.0).Within(Tolerance));
                }
            }
            Assert.That(tested, Is.GreaterThan(0.99 * all));
            Assert.That(tested, Is.GreaterThan(cases / 4));
        }

        [TestCaseSource(typeof(TestShapes), nameof(TestShapes.Names))]
        public void Sum_OfAFunctionOfTheDistances_HasNoJumps_WhenThePointMoves(string name)
        {
            // f = (1 - d/range)^2 falls by at most 2/range a unit. A step of the motion moves the point by
            // Step, so each triangle, edge and corner changes the sum by less than 2 Step/range.
            const double Range = 0.4;
            const double Step = 2e-4;
            const int Steps = 500;
            ContactShape shape = TestShapes.Make(name);
            var random = new RandomGeometry(53);
            var places = new StructList<ContactPoint>(1);
            double worst = 0.0;
            double largest = 0.0;
            for (int i = 0; i < RandomGeometry.Cases(500); i++)
            {
                Vector3d a = random.Point();
                Vector3d step = Step * random.Direction();
                double last = double.NaN;
                for (int k = 0; k < Steps; k++)
                {
                    Vector3d x = a + k * step;
                    int hint = -1;
                    if (shape.Nearest(x, x, double.PositiveInfinity, ref hint, out SurfaceContact contact)
                        && contact.Distance < 1e-2)
                    {
                        last = double.NaN;
                        continue;
                    }
                    places.Clear();
                    shape.FindContactPoints(x, Range, default, places);
                    double sum = 0.0;
                    for (int j = 0; j < places.Count; j++)
                    {
                        double f = 1.0 - places[j].Contact.Distance / Range;
                        sum += places[j].Weight * f * f;
                    }
                    worst = double.IsNaN(last) ? worst : Math.Max(worst, Math.Abs(sum - last));
                    largest = Math.Max(largest, sum);
                    last = sum;
                }
            }
            const int Features = 5;    // that may take part in one change
            TestContext.WriteLine("largest change " + worst + ", largest sum " + largest);
            Assert.That(worst, Is.LessThan(Features * 2.0 * Step / Range));
            Assert.That(largest, Is.GreaterThan(100.0 * worst), "places were in range");
        }

        [TestCaseSource(typeof(TestShapes), nameof(TestShapes.Names))]
        public void Places_AreFoundWithoutAllocation(string name)
        {
            ContactShape shape = TestShapes.Make(name);
            var places = new StructList<ContactPoint>(1);
            Action find = () =>
            {
                for (int i = 0; i < 100; i++)
                {
                    Vector3d a = new Vector3d(Math.Sin(i), Math.Sin(2.0 * i), Math.Sin(3.0 * i));
                    places.Clear();
                    shape.FindContactPoints(a, 0.5, default, places);
                }
            };
            find();
            Assert.That(Garbage.LeftBy(find), Is.Zero);
        }

        private static void Find(ContactShape shape, in Vector3d x, StructList<ContactPoint> places)
        {
            places.Clear();
            shape.FindContactPoints(x, 0.5, default, places);
        }

        // Distance of the point from the centre of its stronger curvature.
        private static double Radius(in ContactPoint place) =>
            1.0 / Math.Max(Math.Abs(place.Curvature), Math.Abs(place.CrossCurvature));

        // The same place a little farther on: curved alike, at a point that has hardly moved. Where the nearest place
        // has just gone over to another face or edge there is none.
        private static bool Same(StructList<ContactPoint> places, in ContactPoint place, out ContactPoint same)
        {
            for (int k = 0; k < places.Count; k++)
            {
                same = places[k];
                if (same.Weight == place.Weight
                    && Math.Abs(same.Curvature - place.Curvature) < 0.1
                    && Math.Abs(same.CrossCurvature - place.CrossCurvature) < 0.1
                    && Vector3d.Distance(same.Contact.Point, place.Contact.Point) < 1e-4)
                {
                    return true;
                }
            }
            same = default;
            return false;
        }
    }
}
