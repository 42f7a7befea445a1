using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What predicts a stage of four elements at once has the bits that plain numbers give one by one. Angles:
    /// all elements in lanes, some, none.</summary>
    public sealed class PredictionLaneTests
    {
        private const int N = 37;   // not a multiple of four
        private const double Fraction = 0.7;

        private static readonly double[] Angles = { 0.05, 0.2, 0.9 };

        [TestCaseSource(nameof(Angles))]
        public void Turns_HaveTheBitsOfPlainNumbers(double angle)
        {
            RodShape shape = Rods.Random(Rods.Wire(N), angle, 0.1, 3);
            RodShape spun = Turned(shape, angle);
            RodShape predicted = Rods.Random(Rods.Wire(N), angle, 0.1, 5);
            predicted.X[20] = predicted.X[21] + (shape.X[20] - shape.X[21]) * -1.0;
            RodShape plain = Rods.Copy(predicted);
            int taken = 0;
            for (int j = 0; j + 4 <= N; j += 4)
            {
                bool isTaken = PredictionLanes.Turn(shape, spun.Q, predicted, j);
                taken += isTaken ? 1 : 0;
                for (int k = j; k < j + 4; k++)
                {
                    WallPrediction.Turn(shape, spun.Q, plain, k);
                    Assert.That(!isTaken || predicted.Q[k] == plain.Q[k], "element " + k);
                }
            }
            Assert.That(taken > 0, Is.EqualTo(HasLanes && angle < 0.5));
        }

        [Test]
        public void NodesAtLengths_HaveTheBitsOfPlainNumbers()
        {
            Vector3d[] curve = Rods.Random(Rods.Wire(N), 0.9, 0.1, 3).X;
            curve[7] = curve[6];   // no direction
            double[] length = Stations();
            var random = new Random(2);
            double[] slide = Array.ConvertAll(length, _ => random.NextDouble());
            var x = new Vector3d[N + 1];
            var plain = new Vector3d[N + 1];
            x[0] = plain[0] = new Vector3d(0.1, 0.2, -0.3);
            for (int i = 1; i <= N; i++)
            {
                double own = length[i] + Fraction * (slide[i] - slide[i - 1]);
                plain[i] = plain[i - 1] + own * Vector3d.Normalize(curve[i] - curve[i - 1]);
            }
            for (int i = 1; i + 4 <= N && HasLanes; i += 4)
            {
                Assert.That(PredictionLanes.PlaceAtLengths(curve, x, length, slide, Fraction, i), Is.True);
                for (int k = i; k < i + 4; k++)
                {
                    Assert.That(x[k], Is.EqualTo(plain[k]), "node " + k);
                }
            }
        }

        [TestCaseSource(nameof(Angles))]
        public void Direction_HasTheBitsOfPlainNumbers(double angle)
        {
            RodShape shape = Rods.Random(Rods.Wire(N), angle, 0.1, 3);
            RodShape to = Turned(Rods.Random(Rods.Wire(N), angle, 0.1, 3), angle);
            to.X[5] = new Vector3d(0.1, -0.2, 0.3);
            var direction = new RodVector[N + 2];
            int taken = 0;
            for (int j = 0; j + 4 <= N; j += 4)
            {
                if (PredictionLanes.SetDirection(shape, to, direction, j))
                {
                    taken++;
                    for (int k = j; k < j + 4; k++)
                    {
                        RodVector d = direction[k];
                        Vector3d turn = RotationVector.Log(shape.Q[k].Conjugate * to.Q[k]);
                        Assert.That(new Vector3d(d.X1, d.X2, d.X3), Is.EqualTo(to.X[k] - shape.X[k]));
                        Assert.That(new Vector3d(d.T1, d.T2, d.T3), Is.EqualTo(turn));
                    }
                }
            }
            Assert.That(taken > 0, Is.EqualTo(HasLanes && angle < 0.5));
        }

        [TestCaseSource(nameof(Angles))]
        public void RatesAndOrientationsOfAStage_HaveTheBitsOfPlainNumbers(double angle)
        {
            const double H = 0.8;
            RodShape start = Rods.Random(Rods.Wire(N), angle, 0.1, 3);
            RodShape shape = Turned(start, angle);
            var random = new Random(7);
            var inertia = new InertiaEnergy(new RodMass(Rods.Wire(N), MassRule.Consistent)) { StageLength = H };
            inertia.BeginStep(start, 1.0);
            var first = new Vector3d[N];
            var second = new Vector3d[N];
            for (int j = 0; j < N; j++)
            {
                inertia.TurnHistory[j] = (0.1 * angle) * Wires.Any(random);
                inertia.SpinHistory[j] = (0.1 * angle) * Wires.Any(random);
                first[j] = (0.1 * angle) * Wires.Any(random);
                second[j] = (0.1 * angle) * Wires.Any(random);
            }
            var predicted = new Quaterniond[N];
            double largest = inertia.Predict(first, second, Fraction, predicted);
            var turnRate = new Vector3d[N];
            var spinRate = new Vector3d[N];
            inertia.SetRates(shape, turnRate, spinRate);
            double plainLargest = 0.0;
            for (int j = 0; j < N; j++)
            {
                Vector3d rate = first[j] + Fraction * (second[j] - first[j]);
                Vector3d turn = inertia.TurnHistory[j] + H * (inertia.SpinHistory[j] + H * rate);
                Assert.That(predicted[j], Is.EqualTo(start.Q[j] * RotationVector.Exp(turn)));
                plainLargest = Math.Max(plainLargest, turn.Length);
                turn = RotationVector.Log(start.Q[j].Conjugate * shape.Q[j]);
                Vector3d change = turn - inertia.TurnHistory[j];
                Assert.That(turnRate[j], Is.EqualTo((1.0 / H) * change));
                Vector3d w = (1.0 / H) * RotationVector.TangentMap(turn, change);
                Assert.That(spinRate[j], Is.EqualTo((1.0 / H) * (w - inertia.SpinHistory[j])));
            }
            Assert.That(largest, Is.EqualTo(plainLargest));
        }

        // Of the library beside these tests: that for Unity has no such type.
        private static bool HasLanes => typeof(RodShape).Assembly.GetType("Guidewire.Core.Rows4")
            ?.GetProperty("IsSupported")!.GetValue(null) is true;

        // About each element's own axes, by up to a fraction of the angle: of the largest, too far for lanes.
        private static RodShape Turned(RodShape shape, double angle)
        {
            var random = new Random(6);
            RodShape turned = Rods.Copy(shape);
            for (int j = 0; j < N; j++)
            {
                turned.Q[j] = Quaterniond.Normalize(
                    shape.Q[j] * RotationVector.Exp((angle < 0.5 ? 0.3 * angle : angle) * Wires.Any(random)));
            }
            return turned;
        }

        private static double[] Stations()
        {
            var random = new Random(1);
            var at = new double[N + 1];
            for (int i = 1; i <= N; i++)
            {
                at[i] = at[i - 1] + 0.5 + random.NextDouble();
            }
            return at;
        }
    }
}
