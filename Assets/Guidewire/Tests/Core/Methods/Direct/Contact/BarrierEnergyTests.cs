using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The energy of contact against differences of its own value, near walls of every kind.</summary>
    public sealed class BarrierEnergyTests
    {
        private const int N = 6;
        private const double Radius = 0.05;      // m, with one unit 1 m
        private const double Distance = 0.4;     // m

        [Test]
        public void Barrier_FallsToZeroWithItsSlope_AndHasItsDerivatives()
        {
            var barrier = new Barrier(0.3, 5.0);
            Assert.That(barrier.At(0.3, out double slope, out double curvature), Is.EqualTo(0.0));
            Assert.That(slope, Is.EqualTo(0.0));
            Assert.That(barrier.At(0.2999, out slope, out curvature), Is.GreaterThan(0.0));
            Assert.That(Math.Abs(slope), Is.LessThan(1e-5));
            Assert.That(barrier.At(0.0, out _, out _), Is.EqualTo(double.PositiveInfinity));
            Assert.That(barrier.At(-0.1, out _, out _), Is.EqualTo(double.PositiveInfinity));
            foreach (double gap in new[] { 0.01, 0.1, 0.25 })
            {
                const double step = 1e-6;
                double below = barrier.At(gap - step, out double slopeBelow, out _);
                double above = barrier.At(gap + step, out double slopeAbove, out _);
                barrier.At(gap, out slope, out curvature);
                Assert.That(slope, Is.EqualTo((above - below) / (2.0 * step)).Within(1e-6 * Math.Abs(slope)));
                Assert.That(curvature, Is.EqualTo((slopeAbove - slopeBelow) / (2.0 * step))
                    .Within(1e-6 * curvature));
            }
            barrier.At(0.15, out slope, out _);
            Assert.That(-slope, Is.EqualTo(5.0 * 0.3 * (Math.Log(2.0) + 0.5)).Within(1e-12), "half of the distance");
        }

        [Test]
        public void Gradient_IsTheDifferenceOfTheEnergy([ValueSource(typeof(TestShapes), nameof(TestShapes.Names))]
            string name)
        {
            ContactShape wall = TestShapes.Make(name);
            int tried = 0;
            for (int seed = 0; seed < 400 && tried < RandomGeometry.Cases(20, 2); seed++)
            {
                BarrierEnergy energy = Create(wall, seed, out RodShape shape);
                double value = energy.Value(shape);
                if (!(value > 0.0) || !(value < 1e3))
                {
                    continue;
                }
                tried++;
                var gradient = new RodVector[N + 2];
                var measured = default(GradientMeasures);
                energy.AddGradient(shape, gradient, 0, N + 1, ref measured);
                double largest = measured.LargestForce;
                for (int i = 0; i <= N; i++)
                {
                    var exact = new Vector3d(gradient[i].X1, gradient[i].X2, gradient[i].X3);
                    Vector3d difference = new Vector3d(
                        Difference(energy, shape, i, Vector3d.UnitX), Difference(energy, shape, i, Vector3d.UnitY),
                        Difference(energy, shape, i, Vector3d.UnitZ));
                    Assert.That(Vector3d.Distance(exact, difference), Is.LessThan(2e-5 * largest),
                        name + ", seed " + seed + ", node " + i);
                }
            }
            Assert.That(tried, Is.GreaterThanOrEqualTo(5), "too few wires touch the wall");
        }

        // Of wires whose surface is in a wall by less than half of their radius, as the chord of a node that has gone.
        [Test]
        public void GapThatIsOpened_IsAsWideAsAsked([ValueSource(typeof(TestShapes), nameof(TestShapes.Names))]
            string name)
        {
            const double Gap = 0.1 * Distance;
            int tried = 0;
            for (int seed = 0; seed < 2000 && tried < 5; seed++)
            {
                BarrierEnergy energy = Create(TestShapes.Make(name), seed, out RodShape shape);
                double least = energy.LeastGap(shape);
                if (!(least > -0.5 * Radius && least < Gap) || energy.NodeGap(0, 0) < 2.0 * Gap
                    || energy.EdgeGap(0, 0) < 2.0 * Gap)
                {
                    continue;
                }
                tried++;
                Vector3d first = shape.X[0];
                energy.Open(shape, Gap);
                Assert.That(energy.LeastGap(shape), Is.GreaterThanOrEqualTo(Gap), name + ", seed " + seed);
                Assert.That(energy.Value(shape), Is.LessThan(double.PositiveInfinity));
                Assert.That(shape.X[0], Is.EqualTo(first), "it is held");
            }
            Assert.That(tried, Is.GreaterThan(0), "no wire is near enough");
        }

        [TestCase("plane")]
        [TestCase("tube")]
        public void Blocks_OfAHollowWall_AreTheDifferencesOfTheGradient(string name)
        {
            ContactShape wall = TestShapes.Make(name);
            int tried = 0;
            for (int seed = 0; seed < 400 && tried < 10; seed++)
            {
                BarrierEnergy energy = Create(wall, seed, out RodShape shape);
                double value = energy.Value(shape);
                if (!(value > 0.0) || !(value < 1e3))
                {
                    continue;
                }
                tried++;
                var blocks = new RodBlock[N + 2];
                energy.AddBlocks(shape, blocks, new RodVector[N + 2], 0, N + 1);
                for (int i = 0; i <= N; i++)
                {
                    const double step = 1e-6;
                    Vector3d above = ForceAt(energy, shape, i, step);
                    Vector3d below = ForceAt(energy, shape, i, -step);
                    Vector3d column = (-0.5 / step) * (above - below);
                    Assert.That(Vector3d.Distance(column, new Vector3d(blocks[i].A11, blocks[i].A21, blocks[i].A31)),
                        Is.LessThan(1e-5 * (1.0 + column.Length)), name + ", seed " + seed + ", node " + i);
                }
            }
            Assert.That(tried, Is.GreaterThanOrEqualTo(5), "too few wires touch the wall");
        }

        [TestCase("wavy tube")]
        [TestCase("bumpy ball")]
        public void SecondDerivative_OfAnEdgesDistance_IsItsDifference(string name)
        {
            const double step = 1e-4;
            ContactShape wall = TestShapes.Make(name);
            var random = new RandomGeometry(77);
            int tried = 0;
            for (int i = 0; i < 3000 && tried < 50; i++)
            {
                Vector3d a = random.Point();
                Vector3d b = a + random.Point();
                Vector3d da = random.Direction();
                Vector3d db = random.Direction();
                if (EdgeContactsOf(wall, a, b).Count == 1 && EdgeContactsOf(wall, a, b)[0].SlideAlongA != Vector3d.Zero
                    && EdgeContactsOf(wall, a, b)[0].Weight > 0.05)
                {
                    EdgeContact edge = EdgeContactsOf(wall, a, b)[0];
                    StructList<EdgeContact> above = EdgeContactsOf(wall, a + step * da, b + step * db);
                    StructList<EdgeContact> below = EdgeContactsOf(wall, a - step * da, b - step * db);
                    if (above.Count != 1 || below.Count != 1)
                    {
                        continue;
                    }
                    double s = edge.Position;
                    Vector3d h = edge.Curvature.Times(b - a);
                    Vector3d move = (1.0 - s) * da + s * db;
                    double slide = Vector3d.Dot(edge.SlideAlongA, da) + Vector3d.Dot(edge.SlideAlongB, db);
                    double exact = Vector3d.Dot(move, edge.Curvature.Times(move))
                        + 2.0 * slide * (Vector3d.Dot(h, move) + Vector3d.Dot(edge.Normal, db - da))
                        + slide * slide * Vector3d.Dot(b - a, h);
                    double difference = (above[0].Distance - 2.0 * edge.Distance + below[0].Distance)
                        / (step * step);
                    Assert.That(exact, Is.EqualTo(difference).Within(0.02 * Math.Abs(exact) + 1e-3), "case " + i);
                    tried++;
                }
            }
            Assert.That(tried, Is.GreaterThanOrEqualTo(20), "too few ridges");
        }

        [Test]
        public void Features_ChangeNoAnswer([ValueSource(typeof(TestShapes), nameof(TestShapes.Names))] string name)
        {
            const double range = 0.3;
            ContactShape wall = TestShapes.Make(name);
            var random = new RandomGeometry(78);
            for (int i = 0; i < RandomGeometry.Cases(500, 4); i++)
            {
                Vector3d a = random.Point();
                Vector3d b = a + 0.5 * random.Point();
                double reach = random.Number(0.0, 0.5);
                var features = new StructList<WallFeature>(8);
                int hint = -1;
                wall.FindFeatures(a, b, range + reach, reach, ref hint, features);
                int own = features.Count;
                wall.FindFeatures(a, a, range + reach, reach, ref hint, features);
                var all = new FeatureRange(features, 0, own, reach);
                FeatureRange atA = wall.IsSurface
                    ? new FeatureRange(features, own, features.Count, reach) : all;
                a += reach * random.Direction();
                b += reach * random.Direction();
                if (!wall.Contains(a) || !wall.Contains(b))
                {
                    continue;
                }
                var places = new StructList<ContactPoint>(8);
                var exact = new StructList<ContactPoint>(8);
                wall.FindContactPoints(a, range, atA, places);
                wall.FindContactPoints(a, range, default, exact);
                Assert.That(places.Count, Is.EqualTo(exact.Count), "case " + i);
                double sum = 0.0;
                for (int k = 0; k < places.Count; k++)
                {
                    sum += places[k].Weight * places[k].Contact.Distance
                        - exact[k].Weight * exact[k].Contact.Distance;
                }
                Assert.That(sum, Is.EqualTo(0.0).Within(1e-12), "case " + i);
                var edges = new StructList<EdgeContact>(8);
                wall.FindEdgeContacts(a, b, range, all, edges);
                StructList<EdgeContact> found = EdgeContactsOf(wall, a, b);
                sum = 0.0;
                for (int k = 0; k < edges.Count; k++)
                {
                    sum += edges[k].Distance <= range && edges[k].Distance > 0.0 ? edges[k].Weight : 0.0;
                }
                for (int k = 0; k < found.Count; k++)
                {
                    sum -= found[k].Distance <= range && found[k].Distance > 0.0 ? found[k].Weight : 0.0;
                }
                Assert.That(sum, Is.EqualTo(0.0).Within(1e-12), "case " + i);
            }
        }

        private static StructList<EdgeContact> EdgeContactsOf(ContactShape wall, in Vector3d a, in Vector3d b)
        {
            var edges = new StructList<EdgeContact>(8);
            wall.FindEdgeContacts(a, b, 0.3, default, edges);
            return edges;
        }

        [Test]
        public void MaximumStep_LeavesEveryGapOpen([ValueSource(typeof(TestShapes), nameof(TestShapes.Names))]
            string name)
        {
            ContactShape wall = TestShapes.Make(name);
            int cut = 0;
            for (int seed = 0; seed < 400 && cut < RandomGeometry.Cases(400, 50); seed++)
            {
                BarrierEnergy energy = Create(wall, seed, out RodShape shape);
                if (double.IsPositiveInfinity(energy.Value(shape)) || GapOf(energy.Walls[0], shape) <= 0.0)
                {
                    continue;
                }
                var random = new RandomGeometry(1000 + seed);
                var direction = new RodVector[N + 2];
                for (int i = 0; i <= N; i++)
                {
                    Vector3d d = random.Number(0.0, 2.0) * random.Point();
                    direction[i] = new RodVector { X1 = d.X, X2 = d.Y, X3 = d.Z };
                }
                double fraction = energy.MaxStep(shape, direction, 1.0);
                cut += fraction < 1.0 ? 1 : 0;
                var moved = new RodShape(N);
                for (int k = 0; k <= 50; k++)
                {
                    RodStep.ApplyStraight(shape, direction, fraction * k / 50.0, moved);
                    Assert.That(GapOf(energy.Walls[0], moved), Is.GreaterThan(0.0), name + ", seed " + seed);
                }
            }
            Assert.That(cut, Is.GreaterThanOrEqualTo(5), "too few steps are cut");
        }

        /// <summary>The wire of 6 elements becomes one of 8, or of 4: its neighbours are known already.</summary>
        [Test]
        public void NeighboursOfElementsThatWere_ChangeNoAnswer(
            [ValueSource(typeof(TestShapes), nameof(TestShapes.Names))] string name, [Values(-2, 2)] int entered)
        {
            ContactShape wall = TestShapes.Make(name);
            int touching = 0;
            for (int seed = 0; seed < 4000 && touching < (Rods.InFull ? 8 : 5); seed++)
            {
                Create(wall, seed, out RodShape shape);
                var rod = new MaterialRod(N, N + 2);
                for (int j = 0; j < rod.Capacity; j++)
                {
                    rod.Length[j] = 0.2;
                    rod.SetRound(j, Radius, 1e6, 1e6, 1e3);
                }
                var one = new BarrierEnergy(rod, new[] { wall }, 1.0, new Barrier(Distance, 10.0));
                if (!(one.Value(shape) < 1e3))
                {
                    continue;
                }
                var random = new RandomGeometry(seed + 1000);
                var moved = new RodShape(N + entered);
                for (int i = moved.ElementCount; i >= 0; i--)
                {
                    int before = i - entered;
                    moved.X[i] = before >= 0 ? shape.X[before] + 0.03 * random.Point()
                        : 2.0 * moved.X[i + 1] - moved.X[i + 2];
                }
                if (IsBehind(wall, moved))
                {
                    continue;
                }
                BarrierEnergy other = EnergyOf(wall, N + entered);
                rod.ElementCount = N + entered;
                one.Remesh();
                one.FollowElements(entered);
                double value = other.Value(moved);
                Assert.That(one.Value(moved), Is.EqualTo(value).Within(1e-12 * value), name + ", seed " + seed);
                touching += value > 0.0 ? 1 : 0;
                for (int j = 0; j < moved.ElementCount && value < double.PositiveInfinity; j++)
                {
                    Assert.That(one.ClearanceOf(j), Is.LessThanOrEqualTo(DistanceOf(wall, moved, j) + 1e-9));
                }
            }
            Assert.That(touching, Is.GreaterThanOrEqualTo(5), "too few wires touch the wall");
        }

        /// <summary>A predicted shape may go through a wall: what is known from there hides no contact.</summary>
        [Test]
        public void ShapeThatCrossesTheWall_ChangesNoAnswer(
            [ValueSource(typeof(TestShapes), nameof(TestShapes.Names))] string name)
        {
            ContactShape wall = TestShapes.Make(name);
            int touching = 0;
            int wanted = RandomGeometry.Cases(2000, 100);
            for (int seed = 0; seed < 40 * wanted && touching < wanted; seed++)
            {
                BarrierEnergy fresh = Create(wall, seed, out RodShape shape);
                var random = new RandomGeometry(seed + 1000);
                MoveToGap(wall, shape, random.Number(0.0, Distance));
                double value = fresh.Value(shape);
                if (!(value > 0.0 && value < double.PositiveInfinity))
                {
                    continue;
                }
                Vector3d motion = random.Number(0.0, 2.0) * random.Direction();
                int first = 1 + random.Index(N);
                var predicted = new RodShape(N);
                for (int i = 0; i <= N; i++)
                {
                    predicted.X[i] = i < first ? shape.X[i] : shape.X[i] + motion;
                }
                BarrierEnergy used = EnergyOf(wall, N);
                touching += double.IsPositiveInfinity(used.Value(predicted)) ? 1 : 0;
                Assert.That(used.Value(shape), Is.EqualTo(value).Within(1e-12 * value), name + ", seed " + seed);
            }
            Assert.That(touching, Is.GreaterThanOrEqualTo(5), "too few predicted shapes cross the wall");
        }

        /// <summary>Of a wire along the middle of a flat side, on either side of it: the wall's two sides are the
        /// same.</summary>
        [Test]
        public void SurfaceIsAWallFromOutsideToo([Values(0.01, 0.1, 0.39)] double gap)
        {
            double apothem = 5.0 * Math.Cos(Math.PI / 4.0);
            ContactShape wall = new MeshShape(TestMeshes.Tube(4, 4, 20.0, z => 5.0).Build(
                Vector3d.Zero, new Vector3d(0.0, 0.0, 20.0)));
            var values = new double[2];
            var slopes = new double[2];
            for (int side = 0; side < 2; side++)
            {
                double sign = side == 0 ? -1.0 : 1.0;
                Vector3d outward = new Vector3d(Math.Sqrt(0.5), Math.Sqrt(0.5), 0.0);
                var shape = new RodShape(N);
                var direction = new RodVector[N + 2];
                for (int i = 0; i <= N; i++)
                {
                    shape.X[i] = (apothem + sign * (Radius + gap)) * outward + new Vector3d(0.0, 0.0, 7.3 + i);
                    direction[i] = new RodVector { X1 = -6.0 * sign * outward.X, X2 = -6.0 * sign * outward.Y };
                }
                BarrierEnergy energy = EnergyOf(wall, N);
                values[side] = energy.Value(shape);
                var gradient = new RodVector[N + 2];
                var measured = default(GradientMeasures);
                energy.AddGradient(shape, gradient, 0, N + 1, ref measured);
                slopes[side] = sign * (gradient[2].X1 * outward.X + gradient[2].X2 * outward.Y);
                double step = energy.MaxStep(shape, direction, 1.0);
                Assert.That(6.0 * step, Is.GreaterThan(0.0).And.LessThan(gap), "the step goes through the wall");
            }
            Assert.That(values[0], Is.GreaterThan(0.0));
            Assert.That(values[1], Is.EqualTo(values[0]).Within(1e-9 * values[0]));
            Assert.That(slopes[0], Is.LessThan(0.0), "pushes off the wall");
            Assert.That(slopes[1], Is.EqualTo(slopes[0]).Within(1e-9 * -slopes[0]));
        }

        // So that its least gap is this, where the wall is flat.
        private static void MoveToGap(ContactShape wall, RodShape shape, double gap)
        {
            SurfaceContact nearest = default;
            for (int j = 0; j < N; j++)
            {
                int hint = -1;
                wall.Nearest(shape.X[j], shape.X[j + 1], double.PositiveInfinity, ref hint, out SurfaceContact contact);
                nearest = j == 0 || contact.Distance < nearest.Distance ? contact : nearest;
            }
            for (int i = 0; i <= N; i++)
            {
                shape.X[i] -= (nearest.Distance - Radius - gap) * nearest.Normal;
            }
        }

        private static bool IsBehind(ContactShape wall, RodShape shape)
        {
            bool isBehind = false;
            for (int j = 0; j < shape.ElementCount; j++)
            {
                int hint = -1;
                isBehind |= wall.Nearest(shape.X[j], shape.X[j + 1], double.PositiveInfinity, ref hint,
                    out SurfaceContact contact) && contact.Distance < Radius;
            }
            return isBehind;
        }

        private static double DistanceOf(ContactShape wall, RodShape shape, int j)
        {
            int hint = -1;
            return wall.Nearest(shape.X[j], shape.X[j + 1], double.PositiveInfinity, ref hint,
                out SurfaceContact contact) ? Math.Abs(contact.Distance) : double.PositiveInfinity;
        }

        private static double GapOf(ContactShape wall, RodShape shape)
        {
            double gap = double.PositiveInfinity;
            for (int j = 0; j < N; j++)
            {
                int hint = -1;
                wall.Nearest(shape.X[j], shape.X[j + 1], double.PositiveInfinity, ref hint,
                    out SurfaceContact contact);
                gap = Math.Min(gap, contact.Distance - Radius);
            }
            return gap;
        }

        private static BarrierEnergy Create(ContactShape wall, int seed, out RodShape shape)
        {
            var random = new RandomGeometry(seed);
            shape = new RodShape(N);
            Vector3d x = random.Point();
            Vector3d step = 0.2 * random.Direction();
            for (int i = 0; i <= N; i++)
            {
                shape.X[i] = x;
                x += step + 0.05 * random.Point();
            }
            for (int j = 0; j < N; j++)
            {
                shape.Q[j] = Quaterniond.Identity;
            }
            return EnergyOf(wall, N);
        }

        private static BarrierEnergy EnergyOf(ContactShape wall, int elements)
        {
            MaterialRod rod = MaterialRod.Round(elements, 0.2 * elements, Radius, 1e6, 1e6, 1e3);
            return new BarrierEnergy(rod, new[] { wall }, 1.0, new Barrier(Distance, 10.0));
        }

        private static double Difference(BarrierEnergy energy, RodShape shape, int i, in Vector3d along)
        {
            const double step = 1e-7;
            Vector3d x = shape.X[i];
            shape.X[i] = x + step * along;
            double above = energy.Value(shape);
            shape.X[i] = x - step * along;
            double below = energy.Value(shape);
            shape.X[i] = x;
            return (above - below) / (2.0 * step);
        }

        private static Vector3d ForceAt(BarrierEnergy energy, RodShape shape, int i, double step)
        {
            Vector3d x = shape.X[i];
            shape.X[i] = x + step * Vector3d.UnitX;
            var gradient = new RodVector[N + 2];
            energy.AddGradient(shape, gradient);
            shape.X[i] = x;
            return -new Vector3d(gradient[i].X1, gradient[i].X2, gradient[i].X3);
        }
    }
}
