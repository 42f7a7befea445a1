using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The stiffness of contacts by estimates of their forces, against gaps found by bisection.</summary>
    public sealed class ContactMultipliersTests
    {
        private const int N = 3;
        private const double Radius = 0.05;      // m, with one unit 1 m
        private static readonly Barrier Law = new Barrier(0.4, 10.0);

        [Test]
        public void Chord_IsTheMeanStiffness_OnTheWayToAForce(
            [Values(1e-4, 0.02, 0.3, 0.9, 0.9999, 1.0 - 1e-12)] double relativeGap,
            [Values(1e-9, 1e-3, 0.3, 0.9, 1.2, 5.0, 1e3, 1e9)] double ratio)
        {
            double gap = relativeGap * Law.Distance;
            double force = ForceAt(gap, out double stiffness);
            double end = GapAt(ratio * force);
            double expected = (ForceAt(end, out _) - force) / (gap - end) / stiffness;
            Assert.That(Law.ChordStiffness(gap, ratio), Is.EqualTo(expected).Within(2e-3 * expected));
        }

        [Test]
        public void Chord_ToNoForce_EndsWhereTheBarrierDoes([Values(0.02, 0.9)] double relativeGap,
            [Values(0.0, -3.0, double.NaN)] double ratio)
        {
            double gap = relativeGap * Law.Distance;
            double force = ForceAt(gap, out double stiffness);
            Assert.That(Law.ChordStiffness(gap, ratio),
                Is.EqualTo(force / (Law.Distance - gap) / stiffness).Within(1e-12));
        }

        [Test]
        public void Chord_ToTheForceThatIs_IsTheSecondDerivative([Values(1e-3, 0.5, 0.99)] double relativeGap)
        {
            Assert.That(Law.ChordStiffness(relativeGap * Law.Distance, 1.0), Is.EqualTo(1.0));
            Assert.That(Law.ChordStiffness(relativeGap * Law.Distance, 1.01), Is.EqualTo(1.0).Within(2e-2));
        }

        /// <summary>A node 0.2 m from a plane moves by some way; the linear model expects a force; from where it came
        /// to, the stiffness leads to that force.</summary>
        [Test]
        public void Stiffness_LeadsToTheForceThatTheLinearModelEndedWith([Values(-0.12, -0.02, 0.02, 0.05)] double way)
        {
            BarrierEnergy energy = AbovePlane(out RodShape shape);
            double gap = 0.2;
            double force = ForceAt(gap, out double stiffness);
            double asked = force - stiffness * way;
            energy.Value(shape);
            energy.Multipliers.Estimate(Move(1, way));
            shape.X[1] += way * Vector3d.UnitY;
            double forceThere = ForceAt(gap + way, out _);
            double end = GapAt(asked);
            RodBlock block = BlocksOf(energy, shape)[1];
            double expected = (forceThere - asked) / (end - gap - way);
            Assert.That(block.A22, Is.EqualTo(expected).Within(2e-3 * expected));
            Assert.That(block.A11, Is.EqualTo(0.0));
            Assert.That(gap + way + (forceThere - asked) / block.A22, Is.EqualTo(end).Within(1e-3 * gap),
                "a step by this stiffness ends at the force asked for");
        }

        [Test]
        public void Gradient_IsTheSame_AndSoAreSecondDerivatives_OnceEstimatesAreForgotten(
            [ValueSource(typeof(TestShapes), nameof(TestShapes.Names))] string name)
        {
            ContactShape wall = TestShapes.Make(name);
            int changed = 0;
            for (int seed = 0; seed < 200; seed++)
            {
                BarrierEnergy energy = Create(wall, seed, out RodShape shape);
                BarrierEnergy plain = Create(wall, seed, out _);
                if (!(energy.Value(shape) < 1e3))
                {
                    continue;
                }
                var random = new RandomGeometry(seed);
                var direction = new RodVector[N + 2];
                for (int i = 0; i <= N; i++)
                {
                    Vector3d move = 0.03 * random.Point();
                    direction[i] = new RodVector { X1 = move.X, X2 = move.Y, X3 = move.Z };
                }
                energy.Multipliers.Estimate(direction);
                RodStep.ApplyStraight(shape, direction, 1.0, shape);
                if (!(plain.Value(shape) < 1e3))
                {
                    continue;
                }
                var gradient = new RodVector[N + 2];
                var exact = new RodVector[N + 2];
                RodBlock[] blocks = BlocksOf(energy, shape);
                RodBlock[] second = BlocksOf(plain, shape);
                energy.AddGradient(shape, gradient);
                plain.AddGradient(shape, exact);
                Assert.That(gradient, Is.EqualTo(exact));
                changed += Array.Exists(blocks, block => Array.IndexOf(second, block) < 0) ? 1 : 0;
                energy.Multipliers.Forget();
                Assert.That(BlocksOf(energy, shape), Is.EqualTo(second), name + ", seed " + seed);
            }
            Assert.That(changed, Is.GreaterThanOrEqualTo(5), "too few wires touch the wall before and after");
        }

        private static double ForceAt(double gap, out double stiffness)
        {
            Law.At(gap, out double slope, out stiffness);
            return -slope;
        }

        // By bisection.
        private static double GapAt(double force)
        {
            double low = 0.0;
            double high = Law.Distance;
            for (int k = 0; k < 2000 && low < high; k++)
            {
                double middle = low > 0.0 ? 0.5 * (low + high) : 1e-3 * high;
                if (middle == low || middle == high)
                {
                    break;
                }
                bool isNear = ForceAt(middle, out _) > force;
                low = isNear ? middle : low;
                high = isNear ? high : middle;
            }
            return high;
        }

        private static RodBlock[] BlocksOf(BarrierEnergy energy, RodShape shape)
        {
            var blocks = new RodBlock[N + 2];
            energy.AddBlocks(shape, blocks, new RodVector[N + 2], 0, N + 1);
            return blocks;
        }

        private static RodVector[] Move(int i, double way)
        {
            var direction = new RodVector[N + 2];
            direction[i].X2 = way;
            return direction;
        }

        // Node 1 alone is near the plane y = 0.
        private static BarrierEnergy AbovePlane(out RodShape shape)
        {
            shape = new RodShape(N);
            for (int i = 0; i <= N; i++)
            {
                shape.X[i] = new Vector3d(0.2 * i, i == 1 ? Radius + 0.2 : 2.0, 0.0);
            }
            return EnergyOf(new PlaneShape(Vector3d.Zero, Vector3d.UnitY), shape);
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
            return EnergyOf(wall, shape);
        }

        private static BarrierEnergy EnergyOf(ContactShape wall, RodShape shape)
        {
            for (int j = 0; j < N; j++)
            {
                shape.Q[j] = Quaterniond.Identity;
            }
            MaterialRod rod = MaterialRod.Round(N, 0.6, Radius, 1e6, 1e6, 1e3);
            return new BarrierEnergy(rod, new[] { wall }, 1.0, Law);
        }
    }
}
