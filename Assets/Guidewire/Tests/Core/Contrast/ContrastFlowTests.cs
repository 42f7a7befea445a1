using System;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Contrast agent: how fast a bolus goes and spreads, what branches take, what is left of
    /// amounts.</summary>
    public sealed class ContrastFlowTests
    {
        private const double Radius = 2.0;     // mm
        private const double Velocity = 200.0; // mm/s

        [Test]
        public void Bolus_GoesAtTheMeanVelocity_AndSpreadsByItsDispersion([Values(0.0, 1.0, 2.5)] double dispersion,
            [Values(0.0, 0.6)] double pulse)
        {
            var flow = new ContrastFlow(Straight(500), new BloodFlow
            {
                Dispersion = dispersion,
                PulseAmplitude = pulse,
                PulseRate = 2.0,
            });
            flow.Inject(0, 0.2, 4.0);
            Advance(flow, 0.25);
            (double mean, double variance) = Moments(flow);
            const double Time = 1.0;    // two beats
            Advance(flow, Time);
            (double laterMean, double laterVariance) = Moments(flow);
            Assert.That(flow.WashedOut, Is.LessThan(1e-3 * flow.Injected));
            Assert.That(laterMean - mean, Is.EqualTo(Velocity * Time).Within(0.005 * Velocity * Time));
            // Einstein: the variance grows by 2 D t, D = dispersion * radius * velocity. The scheme itself adds little.
            double closed = 2.0 * dispersion * Radius * Velocity * Time;
            Assert.That(laterVariance - variance, Is.EqualTo(closed).Within(0.02 * closed + 12.0));
        }

        [Test]
        public void Bolus_HasTheShapeOfAGauss()
        {
            var flow = new ContrastFlow(Straight(500), new BloodFlow());
            flow.Inject(0, 0.02, 4.0);
            Advance(flow, 1.2);
            (double mean, double variance) = Moments(flow);
            double peak = flow.Held * 1e3 / (Math.PI * Radius * Radius * Math.Sqrt(2.0 * Math.PI * variance));
            for (int k = 0; k < flow.Count; k++)
            {
                double apart = flow.Middles[k].Z - mean;
                Assert.That(flow.Parts[k], Is.EqualTo(peak * Math.Exp(-0.5 * apart * apart / variance))
                    .Within(0.03 * peak));
            }
        }

        [TestCase(2.0, 1.0, null, 8.0)]
        [TestCase(1.5, 1.5, null, 1.0)]
        [TestCase(1.5, 1.5, 3.0, 1.0 / 3.0)]
        public void Branches_TakeTheirShare_ByTheirRadiiCubed_OrAsGiven(double one, double other, double? given,
            double ratio)
        {
            double stem = Math.Pow(one * one * one + other * other * other, 1.0 / 3.0);
            var flow = new ContrastFlow(Forked(stem, one, other), new BloodFlow
            {
                Given = point => given == null || point < 50 ? null : point == 51 ? 1.0 : given,
            });
            flow.Inject(0, 0.5, 5.0);
            double most = 0.0;
            for (double time = 0.0; time < 1.0; time += 0.01)
            {
                flow.Advance(0.01);
                most = Math.Max(most, flow.WashedOut);
            }
            double[] held = new double[3];
            for (int k = 0; k < flow.Count; k++)
            {
                int branch = flow.Middles[k].Y > 0.1 ? 1 : flow.Middles[k].Y < -0.1 ? 2 : 0;
                held[branch] += flow.Parts[k] * flow.Radii[k] * flow.Radii[k];
            }
            Assert.That(most, Is.LessThan(1e-6));
            Assert.That(held[0], Is.LessThan(1e-3 * held[1]), "all has left the stem");
            Assert.That(held[1] / held[2], Is.EqualTo(ratio).Within(0.01 * ratio));
        }

        [Test]
        public void Amounts_AddUp_WhateverIsInjectedWhere([Range(1, 6)] int seed)
        {
            if (seed != 2)
            {
                Rods.OnlyInFull("one of these trees");
            }
            var dice = new Random(seed);
            VesselTree tree = Random(dice, 300);
            var flow = new ContrastFlow(tree, new BloodFlow
            {
                Dispersion = 3.0 * dice.NextDouble(),
                PulseAmplitude = dice.NextDouble(),
                PulseRate = 1.3,
            });
            double asked = 0.0;
            for (int k = 0; k < 200; k++)
            {
                if (k % 40 == 0)
                {
                    double amount = 0.01 + dice.NextDouble();
                    flow.Inject(dice.Next(flow.Count), amount, 40.0 * amount);    // ends before the next one
                    asked += amount;
                }
                flow.Advance(1.0 / 60.0 * dice.NextDouble());
                Assert.That(PartsOf(flow), Is.All.InRange(-1e-15, 1.0 + 1e-12));
                Assert.That(flow.Held + flow.WashedOut, Is.EqualTo(flow.Injected).Within(1e-9 * flow.Injected));
            }
            Assert.That(flow.Injected, Is.EqualTo(asked).Within(1e-9 * asked));
            for (int k = 0; k < 10_000 && flow.IsActive; k++)
            {
                flow.Advance(1.0);
            }
            Assert.That(flow.WashedOut, Is.EqualTo(asked).Within(1e-9 * asked));
        }

        [Test]
        public void OneLongAdvance_IsThatOfManyShortOnes([Values(0.0, 0.8)] double pulse)
        {
            ContrastFlow[] flows =
            {
                new ContrastFlow(Straight(200), Beating()), new ContrastFlow(Straight(200), Beating()),
            };
            foreach (ContrastFlow flow in flows)
            {
                flow.Inject(0, 1.0, 4.0);
            }
            flows[0].Advance(1.1);
            for (int k = 0; k < 110; k++)
            {
                flows[1].Advance(0.01);
            }
            Assert.That(flows[0].Held, Is.EqualTo(flows[1].Held).Within(0.002), "of 1 ml");
            Assert.That(PartsOf(flows[0]), Is.EqualTo(PartsOf(flows[1])).AsCollection.Within(0.005));
            flows[0].Advance(10.0);
            Assert.That(flows[0].IsActive, Is.False);
            Assert.That(flows[0].WashedOut, Is.EqualTo(1.0).Within(1e-9));

            BloodFlow Beating() => new BloodFlow { PulseAmplitude = pulse, PulseRate = 1.3 };
        }

        [Test]
        public void Amounts_AddUp_WhereOneBranchHasAlmostNoFlowAndInjectionsAreExtreme()
        {
            var flow = new ContrastFlow(Forked(2.0, 1.5, 1.0), new BloodFlow
            {
                Given = point => point == 51 ? 1e-12 : point == 451 ? 1.0 : (double?)null,
            });
            int aside = flow.CellOf(new Vector3d(0.0, 20.0, 50.0));
            foreach ((int cell, double amount, double rate) in new[] { (0, 1e-12, 1e-3), (0, 0.0, 1.0),
                (aside, 3.0, 100.0), (0, 1e6, 10.0), (flow.Count - 1, 1e-300, 1e300) })
            {
                flow.Inject(cell, amount, rate);
                flow.Advance(0.05);
                Assert.That(PartsOf(flow), Is.All.InRange(-1e-15, 1.0 + 1e-12));
                Assert.That(flow.Held + flow.WashedOut, Is.EqualTo(flow.Injected).Within(1e-9 * flow.Injected));
            }
        }

        [Test]
        public void ATip_ThatInjectsFasterThanBloodFlows_FillsTheLumenAndNoMore()
        {
            var flow = new ContrastFlow(Straight(100), new BloodFlow { Inlet = 0.5, Dispersion = 0.0 });
            int cell = flow.CellOf(new Vector3d(0.0, 0.0, 40.0));
            flow.Inject(cell, 20.0, 4.5);
            Advance(flow, 3.0);
            Assert.That(flow.Parts[cell], Is.EqualTo(0.9).Within(1e-6), "4.5 of 5 ml/s");
            Assert.That(flow.Parts[flow.Count - 1], Is.EqualTo(0.9).Within(1e-6));
            Assert.That(flow.Parts[cell - 2], Is.Zero, "nothing goes against the blood");
        }

        [Test]
        public void Steps_LeaveNoGarbage_AndAThousandCellsAreAFrame()
        {
            var flow = new ContrastFlow(Straight(5000), new BloodFlow());
            Assert.That(flow.Count, Is.EqualTo(1000));
            flow.Inject(0, 5.0, 5.0);
            flow.Advance(0.01);
            Assert.That(Garbage.LeftBy(() => flow.Advance(1.0 / 60.0)), Is.Zero);
        }

        [Test]
        public void Values_ThatAreNotAllowed_AreRefused()
        {
            Assert.Throws<ArgumentException>(() => new ContrastFlow(Straight(10), new BloodFlow { Inlet = 0.0 }));
            Assert.Throws<ArgumentException>(() =>
                new ContrastFlow(Straight(10), new BloodFlow { Dispersion = double.NaN }));
            Assert.Throws<ArgumentException>(() => new ContrastFlow(Straight(10), new BloodFlow { Given = _ => 0.0 }));
            var flow = new ContrastFlow(Straight(10), new BloodFlow());
            Assert.Throws<ArgumentException>(() => flow.Inject(flow.Count, 1.0, 1.0));
            Assert.Throws<ArgumentException>(() => flow.Inject(0, 1.0, 0.0));
            foreach (double wrong in new[] { -1.0, double.NaN, double.PositiveInfinity })
            {
                Assert.Throws<ArgumentException>(() => flow.Inject(0, wrong, 1.0));
                Assert.Throws<ArgumentException>(() => flow.Inject(0, 1.0, wrong));
                Assert.Throws<ArgumentException>(() => flow.Advance(wrong));
            }
            Assert.That(flow.IsActive, Is.False, "nothing has changed");
            Assert.Throws<ArgumentException>(() =>
                new VesselTree(new Vector3d[2], new[] { 1.0, 0.0 }, new[] { -1, 0 }));
        }

        private static void Advance(ContrastFlow flow, double seconds)
        {
            for (int k = 0; k < 100; k++)
            {
                flow.Advance(0.01 * seconds);
            }
        }

        private static double[] PartsOf(ContrastFlow flow) =>
            Enumerable.Range(0, flow.Count).Select(cell => flow.Parts[cell]).ToArray();

        private static (double Mean, double Variance) Moments(ContrastFlow flow)
        {
            double[] z = flow.Middles.Select(middle => middle.Z).ToArray();
            double[] c = PartsOf(flow);
            double all = c.Sum();
            double mean = c.Zip(z, (part, at) => part * at).Sum() / all;
            return (mean, c.Zip(z, (part, at) => part * (at - mean) * (at - mean)).Sum() / all);
        }

        private static VesselTree Straight(int millimetres)
        {
            return new VesselTree(Enumerable.Range(0, millimetres + 1).Select(k => new Vector3d(0.0, 0.0, k)).ToArray(),
                Enumerable.Repeat(Radius, millimetres + 1).ToArray(), Enumerable.Range(-1, millimetres + 1).ToArray());
        }

        private static VesselTree Forked(double stem, double one, double other)
        {
            // 51 points of the stem, then 400 of each branch, so thin that nothing leaves.
            Vector3d[] points = Enumerable.Range(0, 51).Select(k => new Vector3d(0.0, 0.0, k))
                .Concat(Enumerable.Range(1, 400).Select(k => new Vector3d(0.0, k, 50.0)))
                .Concat(Enumerable.Range(1, 400).Select(k => new Vector3d(0.0, -k, 50.0))).ToArray();
            double[] radii = Enumerable.Repeat(stem, 50).Append(Math.Max(one, other))
                .Concat(Enumerable.Repeat(one, 400)).Concat(Enumerable.Repeat(other, 400)).ToArray();
            int[] before = Enumerable.Range(-1, 451).Append(50).Concat(Enumerable.Range(451, 399)).ToArray();
            return new VesselTree(points, radii, before);
        }

        private static VesselTree Random(Random dice, int count)
        {
            var points = new Vector3d[count];
            var radii = new double[count];
            var before = new int[count];
            before[0] = -1;
            radii[0] = 3.0;
            for (int k = 1; k < count; k++)
            {
                before[k] = dice.NextDouble() < 0.9 ? k - 1 : dice.Next(k);
                radii[k] = Math.Max(0.3, radii[before[k]] * (0.9 + 0.15 * dice.NextDouble()));
                points[k] = points[before[k]] + new Vector3d(dice.NextDouble(), dice.NextDouble(), dice.NextDouble());
            }
            return new VesselTree(points, radii, before);
        }
    }
}
