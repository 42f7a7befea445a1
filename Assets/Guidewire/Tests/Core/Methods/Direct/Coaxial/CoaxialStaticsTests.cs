using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Rest shapes of two coaxial instruments against the closed forms of concentric tubes: theta'' = c sin
    /// theta for two tubes of even curvature, with c = k1 k2 B1 B2/(B1 + B2) (1/C1 + 1/C2), theta = theta_hub at the
    /// hub and theta' = 0 at the tip (Rucker, Jones and Webster 2010).</summary>
    public sealed class CoaxialStaticsTests
    {
        private const string Unstable = "two tubes at a twist of pi: sqrt(c) L where it is unstable, straight before ";

        // Of two tubes of stiffness 1 and b with nu, curvature k both, length 1.
        private static double Coupling(double b, double nu, double k) =>
            k * k * b / (1.0 + b) * (1.0 + nu) * (1.0 + 1.0 / b);

        private static CoaxialPair Pair(int n, double b, double nu, double k, double lead = 0.0)
        {
            var inner = lead > 0.0 ? new[] { new CoaxialPair.Piece(lead, b, 0.0), new CoaxialPair.Piece(1.0, b, k) }
                : new[] { new CoaxialPair.Piece(1.0, b, k) };
            return new CoaxialPair(new[] { new CoaxialPair.Piece(1.0, 1.0, k) }, n, inner, n, nu, lead);
        }

        [TestCase(0.0)]
        [TestCase(0.8)]
        [TestCase(2.5)]
        [Category("Row")]
        public void Curvature_IsTheMeanByStiffness_WhereTwistIsStiff(double turn)
        {
            // GJ/EI = 1e4: the angle is that of the hub all along, to 1/2 c L^2 ~ 1e-4.
            CoaxialPair pair = Pair(10, 0.5, -0.9999, 1.2);
            pair.Solve(turn);
            Vector3d second = 1.2 * new Vector3d(Math.Cos(turn), Math.Sin(turn), 0.0);
            Vector3d mean = (1.0 / 1.5) * (1.2 * Vector3d.UnitX + 0.5 * second);
            for (int k = 1; k < 10; k++)
            {
                Vector3d found = 10.0 * pair.Bending.TurnOf(pair.Shape, k);
                Row.Holds("two tubes, GJ/EI = 1e4, turned: off the mean by stiffness, of one tube's curvature",
                    (found - mean).Length / 1.2, 0.0, 5e-4);
            }
        }

        [TestCase(10, 4e-3)]
        [TestCase(20, 1e-3)]
        [Category("Row")]
        public void HubTorque_IsThatOfTheDifferentialEquation(int n, double tolerance)
        {
            foreach (double turn in new[] { 0.3, 1.0, 2.0, 3.0 })
            {
                CoaxialPair pair = Pair(n, 0.6, 0.3, 1.0);
                pair.Solve(turn);
                // theta' at the hub; the torque is that over (1/C1 + 1/C2).
                double expected = -HubSlope(Coupling(0.6, 0.3, 1.0), turn) / (1.3 * (1.0 + 1.0 / 0.6));
                Row.Holds("two tubes turned by " + turn + " rad, n = " + n + ": torque of the hub, of theta'' = c sin "
                    + "theta", pair.Torque / expected, 1.0, tolerance);
            }
        }

        [Test]
        [Category("Row")]
        public void Stability_EndsAtHalfPi_InSecondOrder()
        {
            // The straight twist theta = pi is stable up to L sqrt(c) = pi/2.
            double middle = CoaxialPair.AssertSecondOrder(n => Threshold(n, 0.0) / (0.5 * Math.PI) - 1.0);
            Row.Holds(Unstable + "0 L, n = 10: of pi/2", 1.0 + middle, 1.0, 2.5e-3);
        }

        [TestCase(0.5)]
        [TestCase(2.0)]
        [Category("Row")]
        public void Stability_EndsEarlier_WithAStraightLengthBefore(double lead)
        {
            // sqrt(c) L_t tan(sqrt(c) L) = 1 with L_t of both; here the inner one alone has a straight length.
            double found = Threshold(10, lead);
            double effective = lead * InnerPart(0.6);
            double exact = Bisection.Limit(1e-3, 0.5 * Math.PI - 1e-9, root => root * effective * Math.Tan(root) < 1.0);
            Row.Holds(Unstable + lead + " L, n = 10: of the closed form", found / exact, 1.0, 2.5e-3);
        }

        [Test]
        [Category("Row")]
        public void SmallestEigenvalue_GoesToZero_WhereStabilityEnds()
        {
            // A line in c through two shapes at the twist of pi below pi/2.
            double[] c = { 0.97, 0.985 };
            double[] value = Array.ConvertAll(c, of =>
            {
                double root = 0.5 * Math.PI * Math.Sqrt(of);
                CoaxialPair pair = Pair(10, 0.6, 0.3, root / Math.Sqrt(Coupling(0.6, 0.3, 1.0)));
                Assert.That(pair.IsStable(Math.PI));
                pair.Solve(Math.PI);
                return pair.SmallestEigenvalue;
            });
            Assert.That(value[1], Is.GreaterThan(0.0));
            double zero = c[1] + value[1] * (c[1] - c[0]) / (value[0] - value[1]);
            Row.Holds("two tubes at a twist of pi: sqrt(c) L at which the smallest eigenvalue is zero, n = 10: of pi/2",
                Math.Sqrt(zero), 1.0, 2.5e-3);
        }

        // Of the relative twist, that of the inner one where both have the same torque: (1/C_i)/(1/C_o + 1/C_i).
        private static double InnerPart(double b) => 1.0 / b / (1.0 + 1.0 / b);

        // sqrt(c) at which the twist of pi becomes unstable.
        private static double Threshold(int n, double lead)
        {
            double perCurvature = Math.Sqrt(Coupling(0.6, 0.3, 1.0));
            return Bisection.Limit(0.2, 2.0,
                root => Pair(n, 0.6, 0.3, root / perCurvature, lead).IsStable(Math.PI), 30);
        }

        // Angles at which the branch from 0 ends, as the differential equation has them.
        [TestCase(1.0, 0.3, 1.5, 0.0, 183.545)]
        [TestCase(1.0, 0.3, 2.0, 0.0, 214.955)]
        [TestCase(0.5, 0.35, 1.2, 1.0, 246.905)]
        [Category("Row")]
        public void Snap_ComesAtTheAngleOfTheDifferentialEquation(double b, double nu, double k, double lead,
            double expected)
        {
            lead /= InnerPart(b);
            foreach (int n in Rods.InFull ? new[] { 10, 20 } : new[] { 10 })
            {
                Row.Holds("two tubes, B2/B1 = " + b + ", k L = " + k + ", n = " + n + ": hub angle of the snap, of "
                    + "theta'' = c sin theta", SnapAngle(n, b, nu, k, lead) / expected, 1.0, n == 10 ? 2e-3 : 5e-4);
            }
        }

        [Test]
        [Category("Row")]
        public void ThreeTurnsForthAndBack_SnapEveryTurn()
        {
            // Snaps at 215 + 360 k forth and at 865 - 360 k back: 1080 - 215 and so on.
            CoaxialPair pair = Pair(10, 1.0, 0.3, 2.0);
            var snaps = new System.Collections.Generic.List<double>();
            var iterations = new System.Collections.Generic.List<int>();
            double last = 0.0;
            const double step = 2.5;
            for (int k = 0; k <= 2 * 432; k++)
            {
                double degrees = step * (k <= 432 ? k : 864 - k);
                pair.Solve(degrees * Math.PI / 180.0);
                iterations.Add(pair.Iterations);
                double tip = pair.Shape.Twist[9];
                if (Math.Abs(tip - last) > 1.0)
                {
                    snaps.Add(degrees);
                }
                last = tip;
            }
            double[] expected = { 215.0, 575.0, 935.0, 865.0, 505.0, 145.0 };
            Assert.That(snaps, Has.Count.EqualTo(6));
            for (int k = 0; k < 6; k++)
            {
                double beyond = (snaps[k] - expected[k]) * (k < 3 ? 1.0 : -1.0);
                Row.Holds("three turns forth and back: from the step's middle to the snap, degrees",
                    beyond - 0.5 * step, 0.0, 0.5 * step + 0.5);
            }
            iterations.Sort();
            TestContext.WriteLine("iterations: median {0}, most {1}", iterations[432], iterations[864]);
            Assert.That(last, Is.EqualTo(0.0).Within(1e-8), "back where it was");
            Assert.That(iterations[432], Is.LessThan(6));
        }

        // The last hub angle, in degrees, on the branch that comes from 0.
        private static double SnapAngle(int n, double b, double nu, double k, double lead)
        {
            CoaxialPair pair = Pair(n, b, nu, k, lead);
            double step = 10.0;
            double at = 0.0;
            pair.Solve(0.0);
            var kept = new RodShape(n, 1);
            while (step > 1e-3)
            {
                kept.CopyFrom(pair.Shape);
                double last = pair.Shape.Twist[n - 1];
                pair.Solve((at + step) * Math.PI / 180.0);
                // On the branch the tip lags behind the hub and is short of pi.
                if (pair.Shape.Twist[n - 1] < Math.PI && pair.Shape.Twist[n - 1] - last < 1.0)
                {
                    at += step;
                }
                else
                {
                    pair.Shape.CopyFrom(kept);
                    step *= 0.5;
                }
            }
            return at;
        }

        // theta'(0) of theta'' = c sin theta with theta(0) = turn, theta'(1) = 0: by shooting from the tip.
        private static double HubSlope(double c, double turn)
        {
            double slope = 0.0;
            Bisection.Limit(0.0, turn, tip =>
            {
                double theta = tip;
                slope = 0.0;
                const int steps = 2000;
                double h = -1.0 / steps;
                for (int i = 0; i < steps; i++)
                {
                    double a = c * Math.Sin(theta);
                    double v = slope + 0.5 * h * a;
                    theta += h * v;
                    slope = v + 0.5 * h * c * Math.Sin(theta);
                }
                return theta < turn;
            });
            return slope;
        }
    }
}
