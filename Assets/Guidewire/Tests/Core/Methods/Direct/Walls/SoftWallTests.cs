using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The energy of soft walls, and walls that are moved outward.</summary>
    public sealed class SoftWallTests
    {
        private const int N = 6;
        private const double Radius = 0.3;    // m, with one unit 1 m
        private const double Stiffness = 40.0;

        [Test]
        public void Law_IsASpringWithABarrierBeforeItsLimit([Values(0.001, 0.3, 0.9)] double share)
        {
            const double limit = 0.2;
            const double k = 7.0;
            var law = new Barrier(limit, 0.3 * k, k);
            double u = share * limit;
            double x = 1.0 - share;
            double value = law.At(limit - u, out double slope, out double curvature);
            Assert.That(value, Is.EqualTo(0.5 * k * u * u - 0.3 * k * u * u * Math.Log(x)).Within(1e-12 * value));
            Assert.That(-slope, Is.EqualTo(k * u + 0.3 * k * (u * u / (limit - u) - 2.0 * u * Math.Log(x)))
                .Within(1e-12 * -slope));
            const double step = 1e-7;
            law.At(limit - u - step, out double before, out _);
            law.At(limit - u + step, out double after, out _);
            Assert.That(curvature, Is.EqualTo((after - before) / (2.0 * step)).Within(1e-6 * curvature));
            Assert.That(law.At(0.0, out _, out _), Is.EqualTo(double.PositiveInfinity));
        }

        [Test]
        public void RangeOfAnElement_ReachesAsFarAsBothOfItsNodes()
        {
            // Thicker from piece to piece, to the tip and to the hub.
            MaterialRod rod = MaterialRod.Round(4, 0.04, 0.5e-3, 1e9, 4e8, 1e3);
            double[] radius = { 0.9e-3, 0.4e-3, 0.6e-3, 0.8e-3 };
            for (int j = 0; j < 4; j++)
            {
                rod.SetRound(j, radius[j], 1e9, 4e8, 1e3);
            }
            const double Units = 1e3;
            WallLaw law = WallLaw.Of(rod, WallScenes.Floor(0.0), Units, new Barrier(1e-5, 10.0))[0];
            var range = new double[4];
            law.AddRanges(Units, range);
            for (int j = 0; j < 4; j++)
            {
                double thickest = Math.Max(radius[Math.Max(j - 1, 0)], Math.Max(radius[j], radius[Math.Min(j + 1, 3)]));
                Assert.That(range[j], Is.EqualTo(Units * (thickest + 1e-5)).Within(1e-9), "element " + j);
            }
        }

        [Test]
        public void Chord_OfASoftWall_EndsAtTheForceAskedFor([Values(0.01, 0.4, 0.99)] double gap,
            [Values(1e-6, 0.3, 2.0, 1e4)] double ratio)
        {
            var law = new Barrier(1.0, 0.3, 1.0);
            law.At(gap, out double slope, out double curvature);
            double low = 0.0;
            double high = 1.0;
            for (int k = 0; k < 200; k++)
            {
                double middle = 0.5 * (low + high);
                law.At(middle, out double force, out _);
                (low, high) = force < ratio * slope ? (middle, high) : (low, middle);
            }
            double chord = slope * (ratio - 1.0) / (low - gap);
            Assert.That(law.ChordStiffness(gap, ratio) * curvature, Is.EqualTo(chord).Within(4e-3 * chord));
        }

        [Test]
        public void Gradient_IsTheDifferenceOfTheEnergy([ValueSource(typeof(TestShapes), nameof(TestShapes.Names))]
            string name, [Values(0.0, 0.5)] double limit)
        {
            int tried = 0;
            for (int seed = 0; seed < 400 && tried < RandomGeometry.Cases(12, 2); seed++)
            {
                BarrierEnergy energy = Create(TestShapes.Make(name), limit, seed, out RodShape shape);
                double value = energy.Value(shape);
                if (!(value > 0.0) || !(value < 1e3))
                {
                    continue;
                }
                tried++;
                var gradient = new RodVector[N + 2];
                var measured = default(GradientMeasures);
                energy.AddGradient(shape, gradient, 0, N + 1, ref measured);
                for (int i = 0; i <= N; i++)
                {
                    var exact = new Vector3d(gradient[i].X1, gradient[i].X2, gradient[i].X3);
                    Vector3d difference = Difference(energy, shape, i);
                    Assert.That(Vector3d.Distance(exact, difference), Is.LessThan(2e-5 * measured.LargestForce),
                        name + ", seed " + seed + ", node " + i);
                }
            }
            Assert.That(tried, Is.GreaterThanOrEqualTo(2), "too few wires touch the wall");
        }

        [Test]
        public void NodeOnAPlane_HasTheStiffnessOfItsLength_AndTheTipThatOfItsContact()
        {
            var plane = new PlaneShape(Vector3d.Zero, Vector3d.UnitY) { Softness = new WallSoftness("vessel",
                Stiffness, 100.0, 0.7) };
            MaterialRod rod = MaterialRod.Round(N, 1.2, Radius, 1e6, 1e6, 1e3);
            var energy = new BarrierEnergy(rod, new ContactShape[] { plane }, 1.0, new Barrier(0.1, 10.0));
            const double sunk = 1e-4;
            RodShape shape = Lying(sunk);
            double[] length = { 0.1, 0.2, 0.2, 0.2, 0.2, 0.2, 0.7 };
            StructList<WallContact> contacts = energy.ContactsOf(shape);
            Assert.That(contacts.Count, Is.EqualTo(N + 1));
            for (int i = 0; i <= N; i++)
            {
                Assert.That(contacts[i].Displacement, Is.EqualTo(sunk).Within(1e-12));
                double force = Stiffness * length[i] * sunk;
                Assert.That(contacts[i].Force, Is.EqualTo(force).Within(2e-6 * force));
            }
        }

        [Test]
        public void Regions_GiveEachNodeTheStiffnessOfItsSphere()
        {
            var regions = new WallRegions(new[] { Vector3d.Zero, new Vector3d(0.0, 0.0, 0.9) }, new[] { 0.3, 0.6 },
                new[] { Stiffness, 5.0 * Stiffness });
            var plane = new PlaneShape(Vector3d.Zero, Vector3d.UnitY)
            {
                Softness = new WallSoftness("vessel", Stiffness, 100.0, 0.1) { Regions = regions },
            };
            MaterialRod rod = MaterialRod.Round(N, 1.2, Radius, 1e6, 1e6, 1e3);
            var energy = new BarrierEnergy(rod, new ContactShape[] { plane }, 1.0, new Barrier(0.1, 10.0));
            RodShape shape = Lying(1e-4);
            energy.BeginStep(shape, 1.0);
            StructList<WallContact> contacts = energy.ContactsOf(shape);
            for (int i = 1; i < N; i++)
            {
                // The powers are equal at z = 0.3.
                double expected = Stiffness * 0.2 * 1e-4 * (0.2 * i < 0.3 ? 1.0 : 5.0);
                Assert.That(contacts[i].Force, Is.EqualTo(expected).Within(2e-6 * expected), "node " + i);
            }
        }

        [Test]
        public void WallMovedOut_IsFartherByAsMuch([Values("plane", "tube", "wavy tube")] string name)
        {
            ContactShape wall = TestShapes.Make(name);
            ContactShape moved = wall.MovedOut(0.35)!;
            Assert.That(wall.MovedOut(0.35), Is.SameAs(moved));
            var random = new RandomGeometry(5);
            for (int k = 0; k < 200; k++)
            {
                Vector3d x = random.Point();
                int hint = -1;
                wall.Nearest(x, x, double.PositiveInfinity, ref hint, out SurfaceContact near);
                hint = -1;
                moved.Nearest(x, x, double.PositiveInfinity, ref hint, out SurfaceContact far);
                Assert.That(far.Distance, Is.EqualTo(near.Distance + 0.35).Within(1e-12));
            }
        }

        [Test]
        public void OtherWalls_DoNotMoveOut([Values("cube", "sphere", "cone")] string name) =>
            Assert.That(TestShapes.Make(name).MovedOut(0.1), Is.Null);

        private static RodShape Lying(double sunk)
        {
            var shape = new RodShape(N);
            for (int i = 0; i <= N; i++)
            {
                shape.X[i] = new Vector3d(0.0, Radius - sunk, 0.2 * i);
            }
            Array.Fill(shape.Q, Quaterniond.Identity);
            return shape;
        }

        private static BarrierEnergy Create(ContactShape wall, double limit, int seed, out RodShape shape)
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
            Array.Fill(shape.Q, Quaterniond.Identity);
            wall.Softness = new WallSoftness("vessel", Stiffness, limit, 0.1);
            MaterialRod rod = MaterialRod.Round(N, 0.2 * N, Radius, 1e6, 1e6, 1e3);
            return new BarrierEnergy(rod, new[] { wall }, 1.0, new Barrier(0.1, 10.0));
        }

        /// <summary>Gradient of an energy by a node's position, by central differences.</summary>
        internal static Vector3d Difference(BarrierEnergy energy, RodShape shape, int i)
        {
            return new Vector3d(Difference(energy, shape, i, Vector3d.UnitX),
                Difference(energy, shape, i, Vector3d.UnitY), Difference(energy, shape, i, Vector3d.UnitZ));
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
    }
}
