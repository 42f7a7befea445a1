using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What holds for every shape: the normal is the gradient of the distance, the inside is where the
    /// distance is positive, and a swept segment meets no wall before its time of impact.</summary>
    internal sealed class ContactShapeTests
    {
        // Central differences with step h: rounding 1e-16/h, curvature h^2/distance^2; both below 1e-6 at h = 1e-6
        // for distances above 1e-3.
        private const double Step = 1e-6;
        private const double GradientTolerance = 1e-6;
        private const double NearestToAWall = 1e-3;

        [TestCaseSource(typeof(TestShapes), nameof(TestShapes.Names))]
        public void Normal_IsTheGradientOfTheDistance(string name)
        {
            ContactShape shape = TestShapes.Make(name);
            var random = new RandomGeometry(31);
            int cases = RandomGeometry.Cases(20_000);
            int tested = 0;
            for (int i = 0; i < cases; i++)
            {
                Vector3d x = 1.5 * random.Point();
                SurfaceContact contact = At(shape, x);
                Vector3d gradient = new Vector3d(
                    Slope(shape, x, Vector3d.UnitX), Slope(shape, x, Vector3d.UnitY), Slope(shape, x, Vector3d.UnitZ));

                // Where two places are equally near the distance has a crease and its differences are shorter than 1.
                if (Math.Abs(contact.Distance) < NearestToAWall || Math.Abs(gradient.Length - 1.0) > 1e-4)
                {
                    continue;
                }
                tested++;
                Assert.That((gradient - contact.Normal).Length, Is.LessThan(GradientTolerance), "at " + x);
            }
            Assert.That(tested, Is.GreaterThan(9 * cases / 10));
        }

        [TestCase("cube")]
        [TestCase("bumpy ball")]
        public void Inside_AgreesWithTheWindingNumber(string name)
        {
            TestMeshes mesh = name == "cube" ? TestMeshes.Cube() : TestMeshes.Ball(9, 0.4);
            ContactShape shape = TestShapes.Make(name);
            var random = new RandomGeometry(32);
            for (int i = 0; i < RandomGeometry.Cases(20_000); i++)
            {
                Vector3d x = 1.3 * random.Point();
                bool inside = Math.Abs(mesh.WindingNumber(x)) > 0.5;
                Assert.That(shape.Contains(x), Is.EqualTo(inside), "at " + x);
                Assert.That(At(shape, x).Distance > 0.0, Is.EqualTo(inside), "at " + x);
            }
        }

        [Test]
        public void Inside_IsRight_BesideEdgesAndCorners()
        {
            // Points displaced from corners and edges of a dented ball, where a plain face normal gives the wrong side.
            TestMeshes mesh = TestMeshes.Ball(9, 0.4);
            ContactShape shape = TestShapes.Make("bumpy ball");
            var random = new RandomGeometry(33);
            Vector3d[] corners = mesh.Corners;
            for (int i = 0; i < RandomGeometry.Cases(20_000); i++)
            {
                int t = 3 * random.Index(corners.Length / 3);
                Vector3d on = random.Index(2) == 0 ? corners[t]
                    : Vector3d.Lerp(corners[t], corners[t + 1], random.Number(0.0, 1.0));
                Vector3d x = on + 1e-3 * random.Direction();
                Assert.That(shape.Contains(x), Is.EqualTo(Math.Abs(mesh.WindingNumber(x)) > 0.5), "at " + x);
            }
        }

        [TestCaseSource(typeof(TestShapes), nameof(TestShapes.Names))]
        public void Nearest_OfASegment_IsTheSmallestDistanceOfItsPoints(string name)
        {
            ContactShape shape = TestShapes.Make(name);
            var random = new RandomGeometry(34);
            for (int i = 0; i < RandomGeometry.Cases(3_000); i++)
            {
                if (!FreeSegment(shape, random, out Vector3d a, out Vector3d b))
                {
                    continue;
                }
                int hint = -1;
                shape.Nearest(a, b, double.PositiveInfinity, ref hint, out SurfaceContact contact);
                Vector3d touching = Vector3d.Lerp(a, b, contact.Position);
                Assert.That(contact.Distance, Is.EqualTo(At(shape, touching).Distance).Within(1e-9), "case " + i);
                Assert.That(
                    (contact.Point + contact.Distance * contact.Normal - touching).Length, Is.LessThan(1e-9),
                    "case " + i);
                for (int k = 0; k <= 50; k++)
                {
                    double sample = At(shape, Vector3d.Lerp(a, b, k / 50.0)).Distance;
                    Assert.That(contact.Distance, Is.LessThanOrEqualTo(sample + 1e-9), "case " + i + " at " + k);
                }
            }
        }

        [TestCaseSource(typeof(TestShapes), nameof(TestShapes.Names))]
        public void Sweep_KeepsItsDistanceUntilTheImpact_AndSeesEveryPassage(string name)
        {
            const double Clearance = 1e-3;
            ContactShape shape = TestShapes.Make(name);
            var random = new RandomGeometry(35);
            int impacts = 0;
            int passes = 0;
            for (int i = 0; i < RandomGeometry.Cases(20_000); i++)
            {
                if (!FreeSegment(shape, random, out Vector3d a0, out Vector3d b0))
                {
                    continue;
                }
                Vector3d a1 = a0 + random.Number(0.0, 2.0) * random.Point();
                Vector3d b1 = b0 + random.Number(0.0, 2.0) * random.Point();
                double impact = shape.TimeOfImpact(a0, b0, a1, b1, Clearance, out SurfaceContact contact);
                double until = Math.Min(1.0, impact);
                double kept = ContactShape.FinalClearance(Smallest(shape, a0, b0), Clearance) - 1e-9;
                double onTheWay = Math.Min(kept, 0.5 * Clearance - 1e-9);
                double atTheEnd = Smallest(shape, Vector3d.Lerp(a0, a1, until), Vector3d.Lerp(b0, b1, until));
                Assert.That(atTheEnd, Is.GreaterThanOrEqualTo(kept), "case " + i + " at its end");
                bool met = false;
                for (int k = 0; k <= 40; k++)
                {
                    double time = k / 40.0;
                    double distance = Smallest(shape, Vector3d.Lerp(a0, a1, time), Vector3d.Lerp(b0, b1, time));
                    if (time <= until)
                    {
                        Assert.That(distance, Is.GreaterThanOrEqualTo(onTheWay), "case " + i + " at " + time);
                    }
                    met |= distance <= 0.0;
                }
                Assert.That(met && impact > 1.0, Is.False, "case " + i + " met a wall that the sweep did not see");
                if (impact <= 1.0)
                {
                    impacts++;
                    Assert.That(contact.Distance, Is.LessThan(Clearance + 0.05), "case " + i);
                }
                passes += impact > 1.0 ? 1 : 0;
            }
            Assert.That(impacts, Is.GreaterThan(0));
            Assert.That(passes, Is.GreaterThan(0));
        }

        [Test]
        public void Mesh_TheTimeOfImpactUpToALimit_IsThatOfTheWholeMotion_WhereItIsLess()
        {
            var random = new RandomGeometry(61);
            var shape = new MeshShape(TestMeshes.Ball(24, 0.2).Build());
            int hits = 0;
            for (int i = 0; i < RandomGeometry.Cases(4_000); i++)
            {
                Vector3d a0 = 0.4 * random.Point();
                Vector3d b0 = i % 2 == 0 ? a0 : a0 + 0.2 * random.Point();
                Vector3d motion = 1.5 * random.Point();
                Vector3d turn = i % 2 == 0 ? Vector3d.Zero : 0.3 * random.Point();
                double limit = random.Number(0.0, 1.0);
                double Impact(double upTo)
                {
                    return shape.ConservativeTimeOfImpact(
                        a0, b0, a0 + motion, b0 + motion + turn, 0.02, 1e-9, -1, default, upTo);
                }
                double whole = Impact(1.0);
                hits += whole < limit ? 1 : 0;
                Assert.That(Impact(limit), Is.EqualTo(Math.Min(limit, whole)).Within(1e-8), "case " + i);
            }
            Assert.That(hits, Is.GreaterThan(RandomGeometry.Cases(400)));
        }

        [Test]
        public void Tube_ASmallGapAtACrease_AllowsAMotionOfAboutItsSize()
        {
            // A sharp bend where the tube narrows and widens, and a segment whose interior is nearest to it, down to
            // 1e-8 of the tube's radius; the true fraction by distances at many times.
            const double Radius = 0.2;
            var random = new RandomGeometry(41);
            int tried = 0;
            for (int i = 0; i < RandomGeometry.Cases(5_000); i++)
            {
                double bend = random.Number(0.3, 2.2);
                var shape = new TubeShape(new[] { new Vector3d(0.0, 0.0, -6.0), Vector3d.Zero,
                        6.0 * new Vector3d(Math.Sin(bend), 0.0, Math.Cos(bend)) },
                    new[] { random.Number(0.6, 1.4), 1.0, random.Number(0.6, 1.4) }, true, true);
                double gap = Math.Pow(10.0, random.Number(-8.0, -2.0));
                double clearance = Radius + 0.3 * gap;
                if (!SegmentAtCrease(shape, bend, random, Radius + gap, out Vector3d a0, out Vector3d b0))
                {
                    continue;
                }
                tried++;
                double motion = gap * Math.Pow(10.0, random.Number(-1.0, 1.5));
                Vector3d a1 = a0 + motion * random.Point();
                Vector3d b1 = b0 + motion * random.Point();
                double fraction = Math.Min(1.0, shape.ConservativeTimeOfImpact(
                    a0, b0, a1, b1, clearance, 0.0, -1, default, 1.0));
                double free = 0.0;
                for (int k = 1; k <= 200 && Smallest(shape, Vector3d.Lerp(a0, a1, free), Vector3d.Lerp(b0, b1, free))
                    >= clearance; k++)
                {
                    free = k / 200.0;
                }
                Assert.That(Smallest(shape, Vector3d.Lerp(a0, a1, fraction), Vector3d.Lerp(b0, b1, fraction)),
                    Is.GreaterThanOrEqualTo(clearance - 1e-14), "case " + i);
                Assert.That(fraction, Is.GreaterThanOrEqualTo(Math.Min(0.01, 0.5 * free)),
                    "case " + i + ", gap " + gap);
            }
            Assert.That(tried, Is.GreaterThan(RandomGeometry.Cases(1_000)));
        }

        // A segment across the tube's bend at the origin, in either direction, this far from the wall in between.
        private static bool SegmentAtCrease(ContactShape shape, double bend, RandomGeometry random, double distance,
            out Vector3d a, out Vector3d b)
        {
            double sign = random.Index(2) == 0 ? 1.0 : -1.0;
            Vector3d along = sign * new Vector3d(Math.Sin(0.5 * bend), 0.0, Math.Cos(0.5 * bend));
            Vector3d at = 0.5 * new Vector3d(Math.Cos(0.5 * bend), 0.0, -Math.Sin(0.5 * bend)) + 0.3 * random.Point();
            a = at - random.Number(0.3, 2.0) * (along + 0.5 * random.Point());
            b = at + random.Number(0.3, 2.0) * (along + 0.5 * random.Point());
            int hint = -1;
            for (int k = 0; k < 60; k++)
            {
                shape.Nearest(a, b, double.PositiveInfinity, ref hint, out SurfaceContact contact);
                Vector3d shift = (contact.Distance - distance) * contact.Normal;
                if (shift.Length < 1e-13)
                {
                    return contact.Position > 0.01 && contact.Position < 0.99;
                }
                a -= shift;
                b -= shift;
            }
            return false;
        }

        [Test]
        public void Tube_OfManyPieces_IsAsDeepAsItsDeepestPiece()
        {
            // The pieces' terms one by one: h from the axis, z along it, and the best centre by the slope k.
            var knots = new Vector3d[40];
            var radii = new double[knots.Length];
            var random = new RandomGeometry(37);
            for (int i = 0; i < knots.Length; i++)
            {
                double turn = 0.4 * i;
                knots[i] = new Vector3d(3.0 * Math.Cos(turn), 3.0 * Math.Sin(turn), 0.35 * i);
                radii[i] = random.Number(0.4, 0.6);
            }
            var tube = new TubeShape(knots, radii, false, false);
            for (int c = 0; c < RandomGeometry.Cases(2_000); c++)
            {
                Vector3d x = knots[random.Index(knots.Length)] + 1.5 * random.Point();
                double deepest = double.NegativeInfinity;
                for (int i = 0; i + 1 < knots.Length; i++)
                {
                    double length = Vector3d.Distance(knots[i], knots[i + 1]);
                    Vector3d axis = (knots[i + 1] - knots[i]) / length;
                    double z = Vector3d.Dot(x - knots[i], axis);
                    double h = Vector3d.Cross(axis, x - knots[i]).Length;
                    double k = (radii[i + 1] - radii[i]) / length;
                    double y = Math.Min(length, Math.Max(0.0, z + k * h / Math.Sqrt(1.0 - k * k)));
                    deepest = Math.Max(deepest, radii[i] + k * y - Math.Sqrt(h * h + (z - y) * (z - y)));
                }
                Assert.That(At(tube, x).Distance, Is.EqualTo(deepest).Within(1e-12), "at " + x);
            }
        }

        [Test]
        public void Sweep_AlongAFlatWall_IsFreeHoweverFar()
        {
            ContactShape cube = TestShapes.Make("cube");
            double impact = cube.TimeOfImpact(
                new Vector3d(-0.9, 0.1, -0.999), new Vector3d(-0.8, 0.1, -0.999), new Vector3d(0.8, -0.3, -0.999),
                new Vector3d(0.9, -0.3, -0.999), 1e-2, out _);
            Assert.That(impact, Is.EqualTo(ContactShape.NoImpact));
        }

        [Test]
        public void Sweep_FindsTheMomentOfImpact()
        {
            // From z = 0 towards the wall at z = -1 with speed 4: contact at 1/4, less the clearance.
            ContactShape cube = TestShapes.Make("cube");
            double impact = cube.TimeOfImpact(
                new Vector3d(0.1, 0.2, 0.0), new Vector3d(0.4, 0.2, 0.0), new Vector3d(0.1, 0.2, -4.0),
                new Vector3d(0.4, 0.2, -4.0), 1e-3, out SurfaceContact contact);
            Assert.That(impact, Is.EqualTo(0.25 * (1.0 - 1e-3)).Within(1e-9));
            Assert.That((contact.Normal - Vector3d.UnitZ).Length, Is.LessThan(1e-9));
        }

        [Test]
        public void Mesh_PlacedScaledAndMirrored_KeepsItsNormalsInward()
        {
            var shape = new MeshShape(TestMeshes.Cube().Build());
            foreach (double sign in new[] { 1.0, -1.0 })
            {
                Quaterniond turn = Placement.FromEulerDegrees(new Vector3d(30.0, 20.0, 10.0));
                shape.Place(new Placement(new Vector3d(5.0, 6.0, 7.0), turn, new Vector3d(2.0, 3.0 * sign, 4.0)));
                Vector3d x = new Vector3d(5.0, 6.0, 7.0) + 2.5 * turn.Director2;
                SurfaceContact contact = At(shape, x);
                Assert.That(contact.Distance, Is.EqualTo(0.5).Within(1e-12));
                Assert.That((contact.Normal + turn.Director2).Length, Is.LessThan(1e-12));
                Assert.That(shape.Contains(x), Is.True);
                Assert.That(shape.Contains(x + turn.Director2), Is.False);
            }
        }

        [Test]
        public void EulerAngles_TurnAboutZThenXThenY()
        {
            // Unity: Quaternion.Euler(90, 0, 0) takes +y to +z; (0, 90, 0) takes +z to +x; (0, 0, 90) takes +x to +y.
            AssertTurn(new Vector3d(90.0, 0.0, 0.0), Vector3d.UnitY, Vector3d.UnitZ);
            AssertTurn(new Vector3d(0.0, 90.0, 0.0), Vector3d.UnitZ, Vector3d.UnitX);
            AssertTurn(new Vector3d(0.0, 0.0, 90.0), Vector3d.UnitX, Vector3d.UnitY);
            AssertTurn(new Vector3d(90.0, 0.0, 90.0), Vector3d.UnitX, Vector3d.UnitZ);
            AssertTurn(new Vector3d(0.0, 90.0, 90.0), Vector3d.UnitX, Vector3d.UnitY);
        }

        private static void AssertTurn(in Vector3d degrees, in Vector3d from, in Vector3d to)
        {
            Vector3d turned = Quaterniond.Rotate(Placement.FromEulerDegrees(degrees), from);
            Assert.That((turned - to).Length, Is.LessThan(1e-12), "Euler angles " + degrees);
        }

        private static SurfaceContact At(ContactShape shape, in Vector3d x)
        {
            int hint = -1;
            shape.Nearest(x, x, double.PositiveInfinity, ref hint, out SurfaceContact contact);
            return contact;
        }

        private static double Smallest(ContactShape shape, in Vector3d a, in Vector3d b)
        {
            int hint = -1;
            shape.Nearest(a, b, double.PositiveInfinity, ref hint, out SurfaceContact contact);
            return contact.Distance;
        }

        private static double Slope(ContactShape shape, in Vector3d x, in Vector3d axis) =>
            (At(shape, x + Step * axis).Distance - At(shape, x - Step * axis).Distance) / (2.0 * Step);

        private static bool FreeSegment(ContactShape shape, RandomGeometry random, out Vector3d a, out Vector3d b)
        {
            a = random.Point();
            b = a + random.Number(0.0, 1.0) * random.Point();
            bool free = Smallest(shape, a, b) > 1e-3;
            for (int k = 0; k <= 20 && free; k++)
            {
                free = At(shape, Vector3d.Lerp(a, b, k / 20.0)).Distance > 1e-3;
            }
            return free;
        }
    }
}
