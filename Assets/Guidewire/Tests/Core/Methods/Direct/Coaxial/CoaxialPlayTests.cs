using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What one shared centreline leaves out: against two rods in a plane, each with a deflection of its own,
    /// that keep within the play of the lumen.</summary>
    /// <remarks>Let y_o and y_i be the deflections of the rods from the shared centreline. B_o y_o'' + B_i y_i'' = 0 is
    /// their balance where nothing else acts, so that the mean by stiffness is that centreline, and u = y_o - y_i has
    /// the energy 1/2 integral B_r (u'' - dk)^2, B_r = B_o B_i/(B_o + B_i), under |u| less than the play: a beam
    /// between two walls. It is clamped at the hub, u = u' = 0, and free at the tip.</remarks>
    public sealed class CoaxialPlayTests
    {
        private const int Intervals = 200;
        private const double Outer = 1.0;       // B_o, N m^2
        private const double Inner = 0.6;
        private const double Reduced = Outer * Inner / (Outer + Inner);

        [TestCase(1.0, 1e-3)]
        [TestCase(3.0, 1e-3)]
        [TestCase(1.0, 4e-4)]
        [TestCase(-2.0, 2e-3)]
        public void TwoRodsWithPlay_AreWithinWhatTheSummaryStates(double mismatch, double play)
        {
            CoaxialPair pair = Pair(mismatch, 1.0);
            var record = new CoaxialRecord(10, 1.0, 1e-3 + play, new LumenFriction(0.0, 1.0));
            record.TakePlay(pair.Coaxial.Joints, pair.Shape);
            // A sheath keeps both straight.
            var sheathed = new CoaxialRecord(10, 1.0, 1e-3 + play, new LumenFriction(0.0, 1.0));
            pair.Coaxial.SetHubs(new[] { 0.0, 0.0 }, 1.0 + 1e-9);
            sheathed.TakePlay(pair.Coaxial.Joints, pair.Shape);
            pair.Coaxial.SetHubs(new[] { 0.0, 0.0 }, 0.0);
            Assert.That(sheathed.PlayLength, Is.Zero);
            double energy = TwoRods(mismatch, play, 1.0, out double tip, out double slope);
            double shared = pair.Terms.Potential(pair.Shape);
            double perLength = 0.5 * Reduced * mismatch * mismatch;
            // No coupling over 0.66 a, and the steepest exit is at the play angle.
            double lost = (shared - energy) / perLength;
            Assert.That(lost / record.PlayLength, Is.EqualTo(0.66).Within(0.02));
            // Both ends of the overlap lie against the lumen with 2 B_r dk/a.
            double size = Math.Abs(mismatch);
            Assert.That(record.FrictionHeld, Is.EqualTo(2.0 * 2.0 * Reduced * size / Math.Sqrt(12.0 * play / size))
                .Within(1.0).Percent);
            double angle = Math.PI / 180.0 * record.PlayAngle;
            Assert.That(Math.Abs(slope) / angle, Is.EqualTo(1.0).Within(0.02));
            Assert.That(Math.Abs(tip), Is.EqualTo(play).Within(0.01 * play), "apart at the tip");
            // Tip of either rod from the shared one: its part of u.
            Assert.That(Inner / (Outer + Inner) * Math.Abs(tip), Is.LessThanOrEqualTo(play));
            // The force by which the inner one is driven out is that of the shared centreline: what is lost moves with
            // the tip.
            const double more = 0.05;
            double force = (TwoRods(mismatch, play, 1.0 + more, out _, out _)
                - TwoRods(mismatch, play, 1.0 - more, out _, out _)) / (2.0 * more);
            Assert.That(force, Is.EqualTo(Expulsion(mismatch)).Within(5e-3 * perLength));
        }

        // Of a pair whose tips are one above the other, at rest.
        private static CoaxialPair Pair(double mismatch, double length)
        {
            var pair = new CoaxialPair(new[] { new CoaxialPair.Piece(length, Outer, mismatch) }, 10,
                new[] { new CoaxialPair.Piece(length, Inner, 0.0) }, 10, 0.3, 0.0);
            pair.Solve(0.0);
            return pair;
        }

        // N, at an inner tip within the outer one.
        private static double Expulsion(double mismatch)
        {
            var pair = new CoaxialPair(new[] { new CoaxialPair.Piece(1.0, Outer, mismatch) }, 10,
                new[] { new CoaxialPair.Piece(1.1, Inner, 0.0) }, 11, 0.3, 0.4);
            pair.Solve(0.0);
            return pair.Force;
        }

        // Energy, J; u at the tip and its slope there. Walls are springs that the force of a lip pushes in by a
        // thousandth of the play: Newton's method on the nodes that touch.
        private static double TwoRods(double mismatch, double play, double length, out double tip, out double slope)
        {
            double h = length / Intervals;
            double wall = Reduced * Math.Abs(mismatch) / Math.Sqrt(12.0 * play / Math.Abs(mismatch)) / (1e-3 * play);
            var u = new double[Intervals];    // nodes 1 to n
            var bands = new double[Intervals, 3];
            var x = new double[Intervals];
            for (int iteration = 0; iteration < 300; iteration++)
            {
                Array.Clear(bands, 0, bands.Length);
                Array.Clear(x, 0, x.Length);
                double energy = Assemble(u, mismatch, play, h, wall, bands, x);
                DivideBanded(bands, x);
                double largest = 0.0;
                double slopeOfEnergy = 0.0;
                Array.ForEach(x, value => largest = Math.Max(largest, Math.Abs(value)));
                var gradient = new double[Intervals];
                Assemble(u, mismatch, play, h, wall, new double[Intervals, 3], gradient);
                for (int i = 0; i < Intervals; i++)
                {
                    slopeOfEnergy -= gradient[i] * x[i];
                }
                double scale = 1.0;
                var trial = new double[Intervals];
                do
                {
                    for (int i = 0; i < Intervals; i++)
                    {
                        trial[i] = u[i] + scale * x[i];
                    }
                    scale *= 0.5;
                }
                while (scale > 1e-9 && Assemble(trial, mismatch, play, h, wall, new double[Intervals, 3],
                    new double[Intervals]) > energy + 2e-4 * scale * slopeOfEnergy);
                u = trial;
                if (largest < 1e-9 * play)
                {
                    break;
                }
                Assert.That(iteration, Is.LessThan(299), "no solution");
            }
            tip = u[Intervals - 1];
            slope = (tip - u[Intervals - 2]) / h + 0.5 * h * mismatch;   // u'' = dk at the free end
            return Assemble(u, mismatch, play, h, 0.0, bands, x);
        }

        // Adds second derivatives (diagonal and two bands) and minus the gradient; returns the energy.
        private static double Assemble(double[] u, double mismatch, double play, double h, double wall,
            double[,] bands, double[] force)
        {
            double At(int node) => node == 0 ? 0.0 : u[Math.Abs(node) - 1];
            double energy = 0.0;
            double perSquare = 1.0 / (h * h);
            for (int i = 0; i < Intervals; i++)
            {
                double weight = Reduced * (i == 0 ? 0.5 * h : h);
                double change = perSquare * (At(i + 1) - 2.0 * At(i) + At(i - 1)) - mismatch;
                energy += 0.5 * weight * change * change;
                var parts = i == 0 ? new[] { (1, 2.0) } : new[] { (i - 1, 1.0), (i, -2.0), (i + 1, 1.0) };
                foreach ((int a, double ca) in parts)
                {
                    if (a == 0)
                    {
                        continue;
                    }
                    force[a - 1] -= weight * change * perSquare * ca;
                    foreach ((int b, double cb) in parts)
                    {
                        if (b >= a)
                        {
                            bands[a - 1, b - a] += weight * perSquare * perSquare * ca * cb;
                        }
                    }
                }
            }
            for (int i = 0; i < Intervals; i++)
            {
                double over = Math.Abs(u[i]) - play;
                if (over > 0.0)
                {
                    energy += 0.5 * wall * over * over;
                    force[i] -= wall * over * Math.Sign(u[i]);
                    bands[i, 0] += wall;
                }
            }
            return energy;
        }

        // x := A^-1 x, A symmetric with two bands beside its diagonal.
        private static void DivideBanded(double[,] a, double[] x)
        {
            for (int k = 0; k < Intervals; k++)
            {
                for (int i = 1; i <= 2 && k + i < Intervals; i++)
                {
                    double factor = a[k, i] / a[k, 0];
                    for (int j = i; j <= 2 && k + j < Intervals; j++)
                    {
                        a[k + i, j - i] -= factor * a[k, j];
                    }
                    x[k + i] -= factor * x[k];
                }
            }
            for (int k = Intervals - 1; k >= 0; k--)
            {
                for (int i = 1; i <= 2 && k + i < Intervals; i++)
                {
                    x[k] -= a[k, i] * x[k + i];
                }
                x[k] /= a[k, 0];
            }
        }
    }
}
