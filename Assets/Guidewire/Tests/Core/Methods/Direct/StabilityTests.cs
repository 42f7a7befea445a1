using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Loads at which the rod leaves a shape: where the smallest eigenvalue of its energy passes 0, found by
    /// bisection on the number of negative pivots.</summary>
    [Category("Row")]
    public sealed class StabilityTests
    {
        [Test]
        public void EulerColumn_BucklesAtItsLoad()
        {
            const int N = 30;
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports();
            double critical = Bisect(0.5, 2.0, load =>
            {
                // Straight and shortened: every element carries the thrust.
                double thrust = load * Math.PI * Math.PI / 4.0 * Rods.BendForce;
                RodShape shape = Rods.Straight(rod);
                double shorter = 1.0 - thrust / (Rods.Young * Rods.Area);
                for (int i = 0; i <= N; i++)
                {
                    shape.X[i] = shorter * shape.X[i];
                }
                return Negative(rod, supports, shape);
            });
            Row.Holds("column, clamped below, free above, n = 30: critical load, of Euler's", critical, 1.0, 0.01);
        }

        [Test]
        public void ThrustBeyondEuler_EndsBent()
        {
            // A thrust along the axis exactly: the straight rod is in equilibrium, and a saddle. 1.1 P_c bends the
            // elastica to a tip angle alpha with K(sin(alpha/2))^2 = 1.1 (pi/2)^2.
            const int N = 40;
            RodShape shape = Rods.AtRest(Rods.Wire(N), new RodSupports(), Vector3d.Zero,
                new Vector3d(0.0, 0.0, -1.1 * Math.PI * Math.PI / 4.0 * Rods.BendForce), Vector3d.Zero);
            double angle = Math.Acos(shape.Q[N - 1].Director3.Z);
            double modulus = Math.Sin(0.5 * angle);
            Assert.That(CompleteElliptic(modulus), Is.EqualTo(Math.Sqrt(1.1) * 0.5 * Math.PI).Within(0.002));
        }

        // Greenhill: clamped at both ends, twisted straight, T L^2/EI = 0, 1, 10: critical M L/EI.
        [TestCase(0.0, 8.987)]
        [TestCase(1.0, 9.134)]
        [TestCase(10.0, 10.429)]
        public void TwistedRod_BucklesAtGreenhillsMoment(double tension, double expected)
        {
            const int N = 60;
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports { Distal = DistalEnd.Clamped };
            double critical = Bisect(5.0, 15.0, moment =>
            {
                RodShape shape = Rods.Straight(rod);
                double longer = 1.0 + tension * Rods.BendForce / (Rods.Young * Rods.Area);
                for (int i = 0; i <= N; i++)
                {
                    shape.X[i] = longer * shape.X[i];
                }
                Twist(rod, supports, shape, moment * Rods.BendStiffness / Rods.Length);
                return Negative(rod, supports, shape);
            });
            Assert.That(critical, Is.EqualTo(expected).Within(0.03 * expected));
            Row.Holds("twisted rod between clamps, T L²/EI = " + tension + ", n = 60: critical couple, of Greenhill's",
                critical / GreenhillMoment(tension), 1.0, 0.01);
        }

        [TestCase(0.5)]
        [TestCase(1.0)]
        [TestCase(2.0)]
        public void TwistedRing_BucklesAtMichellsTwist(double ratio)
        {
            // Phi_c = 2 pi sqrt(3) EI/GJ. Clamped in one frame only, which takes the ring's rigid motion away.
            const int N = 96;
            MaterialRod rod = Rods.Wire(N);
            for (int j = 0; j < N; j++)
            {
                rod.TwistStiffness[j] = rod.BendStiffness1[j] / ratio;
            }
            var supports = new RodSupports { Distal = DistalEnd.Clamped, Clamp = ClampRule.HalfElement };
            double expected = 2.0 * Math.PI * Math.Sqrt(3.0) * ratio;
            // At the limit itself the bare steps find no balance.
            double critical = Bisect(0.97, 1.025, part => RingNegative(rod, supports, part * expected), 5);
            Row.Holds("closed ring, EI/GJ = " + ratio + ", n = 96: critical twist, of Michell's and Zajac's",
                critical, 1.0, 0.03);
        }

        /// <summary>A strip, clamped, with a force across its narrow side's axis at the tip: Prandtl's 4.0126
        /// sqrt(EI GJ)/L^2 with EI of the soft axis, for a stiff axis that is much stiffer.</summary>
        [TestCase(true)]
        [TestCase(false)]
        public void Strip_BucklesSidewaysAtPrandtlsForce(bool softAboutD2)
        {
            const int N = 60;
            const double Ratio = 1e4;
            MaterialRod rod = Rods.Wire(N);
            double[] stiff = softAboutD2 ? rod.BendStiffness1 : rod.BendStiffness2;
            for (int j = 0; j < N; j++)
            {
                stiff[j] *= Ratio;
                rod.ShearStiffness[j] *= Ratio;
                rod.StretchStiffness[j] *= Ratio;
            }
            var supports = new RodSupports();
            Vector3d across = softAboutD2 ? Vector3d.UnitY : Vector3d.UnitX;
            double unit = Math.Sqrt(Rods.BendStiffness * Rods.TwistStiffness) / (Rods.Length * Rods.Length);
            double critical = Bisect(3.0, 5.0, load =>
            {
                RodShape shape = Rods.Straight(rod);
                var terms = new RodTerms(rod, supports);
                terms.Loads.Set(Vector3d.Zero, (load * unit) * across);
                Balance(terms, shape);
                return Negative(terms, shape);
            });
            TestContext.WriteLine("P L^2/sqrt(EI GJ) = {0:F4}", critical);
            Assert.That(critical, Is.EqualTo(4.0126).Within(0.01 * 4.0126));
        }

        private static int RingNegative(MaterialRod rod, RodSupports supports, double twist)
        {
            int n = rod.ElementCount;
            RodShape shape = Rods.Straight(rod);
            StartShapes.Ring(shape, Vector3d.Zero, rod.Length);
            for (int j = 0; j < n; j++)
            {
                shape.Q[j] = shape.Q[j] * Quaterniond.FromAxisAngle(Vector3d.UnitZ, twist * (j + 0.5) / n);
            }
            shape.DistalFrame = Quaterniond.FromAxisAngle(Vector3d.UnitZ, twist);
            var terms = new RodTerms(rod, supports);
            Balance(terms, shape);
            return Negative(terms, shape);
        }

        /// <summary>The smallest value at which the second derivative is not positive definite.</summary>
        private static double Bisect(double low, double high, Func<double, int> negative, int halvings = 40)
        {
            Assert.That(negative(low), Is.Zero, "stable at the lower end");
            Assert.That(negative(high), Is.GreaterThan(0), "unstable at the upper end");
            return Bisection.Limit(low, high, load => negative(load) == 0, halvings);
        }

        private static int Negative(MaterialRod rod, RodSupports supports, RodShape shape) =>
            Negative(new RodTerms(rod, supports), shape);

        private static int Negative(RodTerms terms, RodShape shape)
        {
            var system = new BlockTridiagonal(terms.Rod, terms.Supports);
            // A shift of 1e-4 EI/L^2: the ring may turn about the clamp's tangent without energy, an eigenvalue 0.
            return system.Factorise(terms.All, shape, new RodVector[system.VectorCount],
                new RodVector[system.VectorCount], 1e-4 * Rods.BendForce);
        }

        /// <summary>Bare Newton steps to the equilibrium nearby, stable or not: twist and bend together need a shear
        /// force across the ring's plane, GJ tau kappa, which the even polygon has not yet.</summary>
        private static void Balance(RodTerms terms, RodShape shape)
        {
            MaterialRod rod = terms.Rod;
            var system = new BlockTridiagonal(rod, terms.Supports);
            var direction = new RodVector[system.VectorCount];
            RodShape moved = Rods.Copy(shape);
            double size = 1.0;
            for (int i = 0; i < 15; i++)
            {
                system.Factorise(terms.All, shape, new RodVector[system.VectorCount], direction, 1e-4 * Rods.BendForce);
                system.Back(direction);
                size = RodStep.Size(direction, rod.ElementCount, Rods.Length, out _);
                RodStep.Apply(rod, terms.Supports, shape, direction, 1.0, moved);
                shape.CopyFrom(moved);
            }
            Assert.That(size, Is.LessThan(1e-6), "an equilibrium, stable or not");
        }

        /// <summary>Twists a straight rod so that every joint carries the couple.</summary>
        private static void Twist(MaterialRod rod, RodSupports supports, RodShape shape, double couple)
        {
            Joint[] joints = rod.Joints(supports);
            double angle = 0.0;
            for (int j = 0; j < rod.ElementCount; j++)
            {
                angle += couple / joints[j].Twist;
                shape.Q[j] = Quaterniond.FromAxisAngle(Vector3d.UnitZ, angle);
            }
            angle += couple / joints[rod.ElementCount].Twist;
            shape.DistalFrame = Quaterniond.FromAxisAngle(Vector3d.UnitZ, angle);
        }

        /// <summary>Deflection u = y + i z obeys u'''' - i m u''' - t u'' = 0 (unit length and EI), so u = A + B s + C
        /// e^(ias) + D e^(ibs) with a, b = m/2 +- d, d^2 = m^2/4 - t. Clamped ends leave, but for a phase,
        /// 2 d (cos(d) - cos(m/2)) = t sin(d); the smallest m beyond d = 0 that solves it.</summary>
        private static double GreenhillMoment(double tension)
        {
            const double Step = 1e-3;
            double t = Math.Max(tension, 1e-5);
            double from = 2.0 * Math.Sqrt(t) + 3.0;
            double before = GreenhillFunction(from, t);
            for (double m = from + Step; m < 20.0; m += Step)
            {
                double value = GreenhillFunction(m, t);
                if (value * before < 0.0)
                {
                    return m - Step * value / (value - before);
                }
                before = value;
            }
            return double.NaN;
        }

        private static double GreenhillFunction(double m, double t)
        {
            double d = Math.Sqrt(0.25 * m * m - t);
            return (2.0 * d * (Math.Cos(d) - Math.Cos(0.5 * m)) - t * Math.Sin(d)) / t;
        }

        private static double CompleteElliptic(double modulus)
        {
            double a = 1.0;
            double b = Math.Sqrt(1.0 - modulus * modulus);
            for (int i = 0; i < 40; i++)
            {
                double next = 0.5 * (a + b);
                b = Math.Sqrt(a * b);
                a = next;
            }
            return 0.5 * Math.PI / a;
        }
    }
}
