using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The rod's stiffness between clamp and tip against beam theory: orders of convergence of the clamp's
    /// rules. </summary>
    [Category("Row")]
    public sealed class ClampTests
    {
        // Deflections of 1e-6 L: the geometry's own nonlinearity, (1e-6)^2, is out of sight; positions round at 1e-16
        // L.
        private const double Small = 1e-6;
        private const double Rounding = 2e-9;

        [TestCase(1)]
        [TestCase(5)]
        [TestCase(30)]
        public void WholeElementAtTheClamp_HasTheChainsCompliance(int n)
        {
            // A chain of n hinges, the first at the clamp: n (n + 1)(2n + 1)/(2 n^3) times F L^3/(3 EI), exactly;
            // shear adds F L/GA.
            double bending = n * (n + 1.0) * (2.0 * n + 1.0) / (2.0 * n * n * n);
            Row.Holds("tip load, whole-element joint: compliance of such a chain, 3 EI/L³",
                TipCompliance(n, ClampRule.WholeElement), bending, Rounding);
        }

        [TestCase(ClampRule.FourthOrder, 10)]
        [TestCase(ClampRule.FourthOrder, 31)]
        public void FourthOrderClamp_IsExactUnderATipLoad(ClampRule rule, int n)
        {
            Row.Holds("tip load, Gregory's weights: compliance, 3 EI/L³", TipCompliance(n, rule), 1.0, Rounding);
        }

        [Test]
        public void HalfElementClamp_IsOfOrderTwo()
        {
            double order = Order(TipCompliance(10, ClampRule.HalfElement) - 1.0,
                TipCompliance(20, ClampRule.HalfElement) - 1.0);
            Row.Holds("tip load, half-element joint: order of the compliance", order, 2.0, 0.1);
        }

        [TestCase(ClampRule.HalfElement, 2.0)]
        [TestCase(ClampRule.FourthOrder, 4.0)]
        public void SagUnderOwnWeight_HasTheRulesOrder(ClampRule rule, double expected)
        {
            Row.Holds("own weight, " + rule + ": order of the compliance",
                Order(SagError(10, rule), SagError(20, rule)), expected, 0.1);
        }

        [Test]
        public void Frequencies_AreOfFourthOrder()
        {
            double[] coarse = Modes.Cantilever(10, MassRule.Consistent, ClampRule.FourthOrder).Frequencies(3);
            double[] middle = Modes.Cantilever(20, MassRule.Consistent, ClampRule.FourthOrder).Frequencies(3);
            double[] fine = Modes.Cantilever(40, MassRule.Consistent, ClampRule.FourthOrder).Frequencies(3);
            for (int k = 0; k < 3; k++)
            {
                // Successive differences: shear and rotary inertia, which shift the limit by 1e-5, do not matter.
                Assert.That(Order(coarse[k] - middle[k], middle[k] - fine[k]), Is.GreaterThan(3.7), "mode " + (k + 1));
                Assert.That(fine[k], Is.EqualTo(BeamFrequency(k)).Within(2e-4 * BeamFrequency(k)), "mode " + (k + 1));
            }
        }

        [Test]
        public void LumpedMassAndHalfElement_AreOfSecondOrder()
        {
            double exact = BeamFrequency(0);
            double coarse = Modes.Cantilever(10, MassRule.Lumped, ClampRule.HalfElement).Frequencies(1)[0];
            double fine = Modes.Cantilever(20, MassRule.Lumped, ClampRule.HalfElement).Frequencies(1)[0];
            Assert.That(Order(coarse / exact - 1.0, fine / exact - 1.0), Is.EqualTo(2.0).Within(0.1));
            // 0.84 % too low at n = 10 (linear theory of the chain).
            Assert.That(coarse / exact - 1.0, Is.EqualTo(-0.0084).Within(0.0002));
        }

        /// <summary>Euler-Bernoulli, clamped and free: (beta L)^2 sqrt(EI/rhoA)/(2 pi L^2), beta L the roots of cos
        /// cosh = -1. </summary>
        private static double BeamFrequency(int mode)
        {
            double[] roots = { 1.8751040687119611, 4.6940911329741745, 7.8547574382376126 };
            return roots[mode] * roots[mode] / (2.0 * Math.PI * Rods.Length * Rods.Length)
                * Math.Sqrt(Rods.BendStiffness / (Rods.Density * Rods.Area));
        }

        /// <summary>Tip deflection by bending over F L^3/(3 EI); the shear's part F L/GA is taken off.</summary>
        private static double TipCompliance(int n, ClampRule rule)
        {
            MaterialRod rod = Rods.Wire(n);
            double force = Small * 3.0 * Rods.BendForce;
            RodShape shape = Rods.AtRest(rod, new RodSupports { Clamp = rule }, Vector3d.Zero,
                new Vector3d(0.0, force, 0.0), Vector3d.Zero);
            double bending = shape.X[n].Y - force * Rods.Length / (Rods.Shear * Rods.Area);
            return bending / (Small * Rods.Length);
        }

        private static double SagError(int n, ClampRule rule)
        {
            double lineWeight = Small * 8.0 * Rods.BendForce / Rods.Length;
            double gravity = lineWeight / (Rods.Density * Rods.Area);
            RodShape shape = Rods.AtRest(Rods.Wire(n), new RodSupports { Clamp = rule },
                new Vector3d(0.0, gravity, 0.0), Vector3d.Zero, Vector3d.Zero);
            double shear = lineWeight * Rods.Length * Rods.Length / (2.0 * Rods.Shear * Rods.Area);
            return (shape.X[n].Y - shear) / (Small * Rods.Length) - 1.0;
        }

        private static double Order(double coarse, double fine)
        {
            return Math.Log(Math.Abs(coarse / fine)) / Math.Log(2.0);
        }
    }
}
