using System;
using System.Collections.Generic;
using Guidewire.Core;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What holds for the places that every shape lists: the nearest is among them, normal and curvature are
    /// the first and second derivative of the distance, and sums over them have no jumps.</summary>
    [TestFixture]
    internal sealed class WallPlaceTests
    {
        private const double Tolerance = 1e-9;

        [TestCaseSource(typeof(TestShapes), nameof(TestShapes.Names))]
        public void Places_HoldTheNearest_AndNothingBeyondTheRange(string name)
        {
            ContactShape shape = TestShapes.Make(name);
            var random = new RandomGeometry(51);
            var places = new StructList<WallPlace>(1);
            int found = 0;
            for (int i = 0; i < RandomGeometry.Cases(10_000); i++)
            {
                Vector3d[] s = random.Segment(Vector3d.UnitX);
                double range = random.Number(0.0, 1.0);
                int hint = -1;
                bool isNear = shape.Nearest(s[0], s[1], range, ref hint, out SurfaceContact nearest);
                places.Clear();
                shape.FindPlaces(s[0], s[1], range, places);
                Assert.That(places.Count > 0, Is.EqualTo(isNear), "case " + i);
                double least = double.PositiveInfinity;
                double signed = 0.0;
                for (int k = 0; k < places.Count; k++)
                {
                    SurfaceContact contact = places[k].Contact;
                    Vector3d x = Vector3d.Lerp(s[0], s[1], contact.Position);
                    Assert.That(contact.Distance, Is.LessThanOrEqualTo(range * (1.0 + 1e-12)), "case " + i);
                    Assert.That(contact.Position, Is.InRange(0.0, 1.0), "case " + i);
                    Assert.That(
                        (contact.Point + contact.Distance * contact.Normal - x).Length, Is.LessThan(Tolerance),
                        "case " + i);
                    Assert.That(contact.Normal.Length, Is.EqualTo(1.0).Within(Tolerance), "case " + i);
                    Assert.That(places[k].Weight, Is.Not.Zero, "case " + i);

                    // A mesh looks for what is nearest on either side; all others know how deep a segment is.
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
            var places = new StructList<WallPlace>(1);
            var ahead = new StructList<WallPlace>(1);
            var behind = new StructList<WallPlace>(1);
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
                    WallPlace place = places[k];
                    bool isRound = place.Curvature != 0.0 || place.CrossCurvature != 0.0;
                    bool isInside = shape is ConvexObstacle && place.Contact.Distance < 0.0;
                    if (Math.Abs(place.Contact.Distance) < Near || isInside
                        || (isRound && Radius(place) < Near))
                    {
                        continue;
                    }
                    all++;
                    if (!Same(ahead, place, out WallPlace next) || !Same(behind, place, out WallPlace last))
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
        public void Sum_OfAFunctionOfTheDistances_HasNoJumps_WhenTheSegmentMoves(string name)
        {
            // f = (1 - d/range)^2 falls by at most 2/range a unit. A step of the motion moves the segment by less than
            // Step, so each triangle, edge and corner changes the sum by less than 2 Step/range.
            const double Range = 0.4;
            const double Step = 2e-4;
            const int Steps = 500;
            ContactShape shape = TestShapes.Make(name);
            var random = new RandomGeometry(53);
            var places = new StructList<WallPlace>(1);
            double worst = 0.0;
            double largest = 0.0;
            for (int i = 0; i < RandomGeometry.Cases(500); i++)
            {
                Vector3d a = random.Point();
                Vector3d b = a + random.Number(0.0, 1.0) * random.Point();
                Vector3d va = Step * random.Direction();
                Vector3d vb = Step * random.Direction();
                double last = double.NaN;
                for (int k = 0; k < Steps; k++)
                {
                    Vector3d p = a + k * va;
                    Vector3d q = b + k * vb;
                    int hint = -1;
                    if (shape.Nearest(p, q, double.PositiveInfinity, ref hint, out SurfaceContact contact)
                        && contact.Distance < 1e-2)
                    {
                        last = double.NaN;
                        continue;
                    }
                    places.Clear();
                    shape.FindPlaces(p, q, Range, places);
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
            var places = new StructList<WallPlace>(1);
            Action find = () =>
            {
                for (int i = 0; i < 100; i++)
                {
                    Vector3d a = new Vector3d(Math.Sin(i), Math.Sin(2.0 * i), Math.Sin(3.0 * i));
                    places.Clear();
                    shape.FindPlaces(a, 0.5 * a, 0.5, places);
                }
            };
            find();
            Assert.That(Garbage.LeftBy(find), Is.Zero);
        }

        [Test]
        public void Plane_ListsTheNearestPlace_AndTheMiddleOfAParallelSegment()
        {
            var plane = new PlaneShape(Vector3d.Zero, Vector3d.UnitY);
            AssertOnly(plane, new Vector3d(0.0, 0.2, 0.0), new Vector3d(0.0, 0.1, 1.0), 1.0, 0.1);
            AssertOnly(plane, new Vector3d(0.0, 0.2, 0.0), new Vector3d(0.0, 0.2, 1.0), 0.5, 0.2);
        }

        [Test]
        public void StraightTube_ListsBothEndsOfAChord_LessItsMiddle_AndOnePlaceOfAParallel()
        {
            // Radius 0.8: ends at 0.7 from the axis, the middle of the chord on a plane at 0.5.
            ContactShape tube = TestShapes.Make("tube");
            double half = Math.Sqrt(0.7 * 0.7 - 0.5 * 0.5);
            var places = new StructList<WallPlace>(1);
            tube.FindPlaces(new Vector3d(0.5, -half, 0.0), new Vector3d(0.5, half, 0.3), 1.0, places);
            Assert.That(places.Count, Is.EqualTo(3));
            double[] positions = { 0.0, 0.5, 1.0 };
            double[] distances = { 0.1, 0.3, 0.1 };
            double[] weights = { 1.0, -1.0, 1.0 };
            for (int k = 0; k < 3; k++)
            {
                Assert.That(places[k].Contact.Position, Is.EqualTo(positions[k]).Within(Tolerance));
                Assert.That(places[k].Contact.Distance, Is.EqualTo(distances[k]).Within(Tolerance));
                Assert.That(places[k].Weight, Is.EqualTo(weights[k]));
            }
            AssertOnly(tube, new Vector3d(0.0, 0.6, -0.5), new Vector3d(0.0, 0.6, 0.5), 0.5, 0.2);
        }

        [TestCase("tube")]
        [TestCase("wavy tube")]
        public void Tube_ListsTheLeastAndLargestDistancesAlongTheSegment(string name)
        {
            // Against samples: a crease may lie between two of them, at most Length/Samples below; extrema that stand
            // out by less than Prominence are left out of both lists, cases with one near that limit are not judged.
            const int Samples = 2000;
            const double Error = 1e-3;
            const double Prominence = 5e-3;
            var tube = (TubeShape)TestShapes.Make(name);
            var random = new RandomGeometry(54);
            var places = new StructList<WallPlace>(1);
            var counts = new int[8];
            int cases = RandomGeometry.Cases(2_000);
            int tested = 0;
            for (int i = 0; i < cases; i++)
            {
                Vector3d a = random.Point();
                Vector3d b = a + random.Number(0.1, 1.0) * random.Point();
                places.Clear();
                tube.FindPlaces(a, b, double.PositiveInfinity, places);
                var listed = new List<double>();
                for (int k = 0; k < places.Count; k++)
                {
                    Assert.That(places[k].Weight, Is.EqualTo(k % 2 == 0 ? 1 : -1), "case " + i);
                    listed.Add(places[k].Contact.Distance);
                }
                var sampled = new List<double>();
                for (int k = 0; k <= Samples; k++)
                {
                    double before = k == 0 ? double.PositiveInfinity : At(tube, a, b, (k - 1.0) / Samples);
                    double here = At(tube, a, b, (double)k / Samples);
                    double after = k == Samples ? double.PositiveInfinity : At(tube, a, b, (k + 1.0) / Samples);
                    if (here < before == here < after)
                    {
                        sampled.Add(here);
                    }
                }
                if (!Prune(listed, Prominence, Error) || !Prune(sampled, Prominence, Error))
                {
                    continue;
                }
                tested++;
                counts[listed.Count]++;
                Assert.That(listed, Is.EqualTo(sampled).Within(Error), "case " + i);
            }
            TestContext.WriteLine("cases with 1, 3, 5 extrema: " + counts[1] + ", " + counts[3] + ", " + counts[5]);
            Assert.That(tested, Is.GreaterThan(0.9 * cases));
            Assert.That(counts[3], Is.GreaterThan(tested / 20));
        }

        // Takes out neighbours that differ by less than the prominence, smallest difference first; false where one is
        // too near to that to tell.
        private static bool Prune(List<double> extrema, double prominence, double error)
        {
            while (extrema.Count > 1)
            {
                int least = 0;
                for (int k = 1; k + 1 < extrema.Count; k++)
                {
                    least = Math.Abs(extrema[k + 1] - extrema[k]) < Math.Abs(extrema[least + 1] - extrema[least])
                        ? k : least;
                }
                double difference = Math.Abs(extrema[least + 1] - extrema[least]);
                if (difference > prominence)
                {
                    return difference > prominence + error;
                }
                if (difference > prominence - error)
                {
                    return false;
                }
                extrema.RemoveRange(least, 2);
            }
            return true;
        }

        private static double At(TubeShape tube, in Vector3d a, in Vector3d b, double s)
        {
            return tube.Distance(Vector3d.Lerp(a, b, s), out _);
        }

        private static void AssertOnly(ContactShape shape, Vector3d a, Vector3d b, double position, double distance)
        {
            var places = new StructList<WallPlace>(1);
            shape.FindPlaces(a, b, 1.0, places);
            Assert.That(places.Count, Is.EqualTo(1));
            Assert.That(places[0].Weight, Is.EqualTo(1));
            Assert.That(places[0].Contact.Position, Is.EqualTo(position).Within(Tolerance));
            Assert.That(places[0].Contact.Distance, Is.EqualTo(distance).Within(Tolerance));
        }

        private static void Find(ContactShape shape, in Vector3d x, StructList<WallPlace> places)
        {
            places.Clear();
            shape.FindPlaces(x, x, 0.5, places);
        }

        // Distance of the point from the centre of its stronger curvature.
        private static double Radius(in WallPlace place)
        {
            return 1.0 / Math.Max(Math.Abs(place.Curvature), Math.Abs(place.CrossCurvature));
        }

        // The same place a little farther on: curved alike, at a point that has hardly moved. Where the nearest place
        // has just gone over to another face or edge there is none.
        private static bool Same(StructList<WallPlace> places, in WallPlace place, out WallPlace same)
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
