using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Sweeps in the lanes of a vector register give what the scalar sweeps give, bit for bit.</summary>
    [Category("Target")]
    public sealed class PipelinedIterationsTests
    {
        private const int AllWires = 200;
        private const int DailyWires = 50;
        private const int DefaultWires = 6;
        private const int AllSteps = 100;
        private const int DefaultSteps = 20;
        private const double TimeStep = 0.01;    // s

        [TestCase(4)]
        [TestCase(8)]
        public void RandomWires_MoveAsTheyDoOneSweepAfterTheOther(int lanes)
        {
            int wires = Rods.InFull ? DailyWires : DefaultWires;
            int first = Rods.InFull ? RandomGeometry.FirstOfTheDay(wires, AllWires) : 0;
            int steps = Rods.InFull ? AllSteps : DefaultSteps;
            for (int seed = first; seed < first + wires; seed++)
            {
                RodState expected = RandomWire(seed, out ScalarIterations scalar, out int iterations);
                RodState state = RandomWire(seed, out ScalarIterations twin, out _);
                PositionBasedStep reference = StepWith(scalar, scalar, iterations);
                PositionBasedStep step = StepWith(twin, InLanes(twin, lanes), iterations);
                for (int k = 0; k < steps; k++)
                {
                    reference.Advance(expected);
                    step.Advance(state);
                    AssertSameBits(state, expected, "wire " + seed + ", step " + k);
                }
            }
        }

        [Test]
        public void EveryShortWireAndFewSweeps_GiveTheSameBits([Values(4, 8)] int lanes)
        {
            // All ways in which wires are shorter than the lanes' distance and lanes have no sweep left to do.
            for (int n = 1; n <= 3 * lanes + 2; n++)
            {
                for (int m = 0; m <= 2 * lanes + 1; m++)
                {
                    RodState expected = Bent(n, n + 100 * m, out ScalarIterations scalar);
                    RodState state = Bent(n, n + 100 * m, out ScalarIterations twin);
                    scalar.Iterate(expected.PredictedPositions, expected.PredictedOrientations, m, null);
                    InLanes(twin, lanes).Iterate(state.PredictedPositions, state.PredictedOrientations, m, null);
                    AssertSameBits(state, expected, "n = " + n + ", m = " + m);
                }
            }
        }

        [TestCase(4)]
        [TestCase(8)]
        public void Step_AllocatesNothing(int lanes)
        {
            RodState state = Bent(30, 1, out ScalarIterations scalar);
            PositionBasedStep step = StepWith(scalar, InLanes(scalar, lanes), 21);
            step.Advance(state);
            long left = Garbage.LeftBy(() =>
            {
                for (int k = 0; k < 100; k++)
                {
                    step.Advance(state);
                }
            });
            Assert.That(left, Is.Zero);
        }

        [TestCase(1, 1)]
        [TestCase(2, 500)]
        [TestCase(1000, 1)]
        public void LittleWork_IsNotWorthLanes(int n, int iterations)
        {
            Bent(n, 1, out ScalarIterations scalar);
            Assert.That(IterationChoice.Fastest(scalar, iterations), Is.SameAs(scalar));
        }

        [TestCase(30, 500)]
        [TestCase(300, 500)]
        [TestCase(30, 10)]
        public void MuchWork_IsDoneInLanes_WhereThereAreAny(int n, int iterations)
        {
            Bent(n, 1, out ScalarIterations scalar);
            InLanes(scalar, 4);
            Assert.That(IterationChoice.Fastest(scalar, iterations), Is.Not.SameAs(scalar));
        }

        [Test]
        public void BilateralOrder_HasNoLanes()
        {
            var state = new RodState(30, 300.0, 1.0, 0.0);
            var scalar = new ScalarIterations(
                new StretchConstraint(state, 0.1), new BendTwistConstraint(state, 0.1), SweepOrder.Bilateral);
            Assert.That(IterationChoice.WithLanes(scalar, 4), Is.Null);
            Assert.That(IterationChoice.Fastest(scalar, 500), Is.SameAs(scalar));
        }

        private static IIterations InLanes(ScalarIterations scalar, int lanes)
        {
            IIterations? sweeps = IterationChoice.WithLanes(scalar, lanes);
            if (sweeps == null)
            {
                Assert.Ignore("no registers of " + lanes + " lanes here");
            }
            return sweeps!;
        }

        private static PositionBasedStep StepWith(ScalarIterations scalar, IIterations sweeps, int iterations)
        {
            return new PositionBasedStep(TimeStep, new VerletPrediction(0.01, new Vector3d(0.0, -2.0, 0.3)),
                new OrientationEulerPrediction(), null, new GaussSeidelSolver(iterations, scalar, sweeps, null), null);
        }

        private static RodState Bent(int n, int seed, out ScalarIterations scalar)
        {
            var random = new System.Random(seed);
            var state = new RodState(n, 10.0 * n, 0.1, 0.0);
            Wires.Load(state, Wires.Random(n, 10.0 * n, seed));
            Bend(state, random);
            scalar = new ScalarIterations(
                new StretchConstraint(state, 0.7), new BendTwistConstraint(state, 0.4), SweepOrder.Naive);
            return state;
        }

        private static void Bend(RodState state, System.Random random)
        {
            for (int j = 0; j + 1 < state.ElementCount; j++)
            {
                state.RestDarbouxVectors[j] = 0.05 * Wires.Any(random);
            }
        }

        // n and m from 1 to 1,000, by their logarithms in four of five wires; every second wire bent and in motion, the
        // others straight and at rest, with zeros of either sign; held ends and inner parts; gains up to the limit in
        // half of the wires, in the others up to twice as much or infinite; infinite places and rest vectors.
        private static RodState RandomWire(int seed, out ScalarIterations scalar, out int iterations)
        {
            var random = new System.Random(seed);
            bool large = seed % 5 == 4 && Rods.InFull;
            int n = large ? random.Next(1, 1001) : (int)Math.Pow(1000.0, random.NextDouble());
            iterations = large ? random.Next(1, 1001) : (int)Math.Pow(1000.0, random.NextDouble());
            double length = n * (0.5 + 20.0 * random.NextDouble());
            var state = new RodState(n, length, Math.Pow(10.0, 6.0 * random.NextDouble() - 3.0), -5.0);
            if (seed % 2 == 0)
            {
                Wires.Load(state, Wires.Random(n, length, seed));
            }
            else
            {
                state.Place(n, new Vector3d(-0.0, random.Next(2), state.Positions[n].Z));
            }
            if (random.Next(2) == 0)
            {
                Bend(state, random);
            }
            for (int k = random.Next(4); k > 0; k--)
            {
                state.InverseMasses[random.Next(2) == 0 ? 0 : random.Next(n + 1)] = 0.0;
                state.OrientationWeights[random.Next(2) == 0 ? 0 : random.Next(n)] = 0.0;
            }
            double limit = seed % 4 < 2 ? 1.0 : 4.0;
            double stretch = limit * random.NextDouble();
            double bend = limit * random.NextDouble() * state.ElementLength;
            switch (seed % 10)
            {
                case 3:
                    stretch = double.PositiveInfinity;
                    break;
                case 6:
                    state.Place(random.Next(n + 1), new Vector3d(double.NegativeInfinity, 0.0, -0.0));
                    break;
                case 9 when n > 1:
                    state.RestDarbouxVectors[random.Next(n - 1)] = new Vector3d(0.0, double.PositiveInfinity, 0.0);
                    break;
            }
            scalar = new ScalarIterations(
                new StretchConstraint(state, stretch), new BendTwistConstraint(state, bend), SweepOrder.Naive);
            return state;
        }

        private static void AssertSameBits(RodState state, RodState expected, string where)
        {
            for (int i = 0; i <= expected.ElementCount; i++)
            {
                Vector3d a = state.Positions[i];
                Vector3d b = expected.Positions[i];
                Vector3d c = state.PredictedPositions[i];
                Vector3d d = expected.PredictedPositions[i];
                bool same = Same(a.X, b.X) && Same(a.Y, b.Y) && Same(a.Z, b.Z)
                    && Same(c.X, d.X) && Same(c.Y, d.Y) && Same(c.Z, d.Z);
                Assert.That(same, where + ", sphere " + i);
            }
            for (int j = 0; j < expected.ElementCount; j++)
            {
                Quaterniond a = state.Orientations[j];
                Quaterniond b = expected.Orientations[j];
                Quaterniond c = state.PredictedOrientations[j];
                Quaterniond d = expected.PredictedOrientations[j];
                bool same = Same(a.X, b.X) && Same(a.Y, b.Y) && Same(a.Z, b.Z) && Same(a.W, b.W)
                    && Same(c.X, d.X) && Same(c.Y, d.Y) && Same(c.Z, d.Z) && Same(c.W, d.W);
                Assert.That(same, where + ", frame " + j);
            }
        }

        private static bool Same(double a, double b)
        {
            return double.IsNaN(a) ? double.IsNaN(b)
                : BitConverter.DoubleToInt64Bits(a) == BitConverter.DoubleToInt64Bits(b);
        }
    }
}
