using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Sections of fibres against closed forms of a round section, whose plateaus and yield are strips of no
    /// width: E, radius a, stress s at which it leaves its line, eta = s/(E a kappa).</summary>
    public sealed class FibreSectionTests
    {
        private const double Radius = 0.178e-3;
        private const double Second = 0.25 * Math.PI * Radius * Radius * Radius * Radius;

        /// <summary>M = s a^3 g(eta), in any plane; across it there is none. The default rule and a fine one.</summary>
        [Category("Row")]
        [TestCase(4, 0.01)]
        [TestCase(9, 0.001)]
        public void Couple_OfAVirginSection_IsThatOfTheClosedForm(int rings, double limit)
        {
            FibreSection section = Nitinol(rings, double.PositiveInfinity);
            double worst = 0.0;
            for (double eta = 1.1; eta >= 0.1; eta -= 0.04)
            {
                double curvature = 500e6 / (60e9 * Radius * eta);
                double exact = eta >= 1.0 ? 60e9 * Second * curvature : 500e6 * Math.Pow(Radius, 3.0) * G(eta);
                for (double angle = 0.0; angle < 0.53; angle += 0.13)
                {
                    (double along, double across) = new History(section).Couple(curvature, angle);
                    worst = Math.Max(worst, Math.Abs(along / exact - 1.0));
                    Assert.That(Math.Abs(across), Is.LessThan(2.0 * limit * exact));
                }
            }
            Row.Holds("virgin couple of a section, " + rings + " rings: off s a³ g(η)", worst, 0.0, limit);
        }

        /// <summary>What steel keeps of a bend once its couple is gone: 1 - 4 eta g(eta)/pi.</summary>
        [Category("Row")]
        [TestCase(0.05)]
        [TestCase(0.2)]
        [TestCase(0.5)]
        [TestCase(0.8)]
        public void Steel_KeepsItsShareOfABend(double eta)
        {
            FibreSection section = Steel(MaterialLaw.DefaultRings);
            double curvature = 1.5e9 / (190e9 * Radius * eta);
            var history = new History(section);
            history.Bend(curvature, 0.0);
            double kept = history.Unload(curvature) / curvature;
            Row.Holds("curvature that steel keeps, of that it was bent to", kept, 1.0 - 4.0 * eta * G(eta) / Math.PI,
                0.01);
        }

        [TestCase(50.0)]
        [TestCase(250.0)]
        public void Nitinol_WithoutACoupleIsStraight(double curvature)
        {
            var history = new History(Nitinol(4, 0.05));
            history.Bend(curvature, 0.3);
            history.Bend(0.5 * curvature, -1.0);
            Assert.That(history.Unload(0.5 * curvature, -1.0) / curvature, Is.EqualTo(0.0).Within(1e-9));
        }

        /// <summary>The heat of a loop 0, k, 0, -k, 0. Nitinol: 4 d (Psi(s/E) - Psi(s/E + e_max)); steel: d (3 Psi(s/E)
        /// + Psi(2 s/E)); Psi(x) = integral of (k |y| - x)+ over the section. Limits: 1.5 times the rule's
        /// error.</summary>
        [Category("Row")]
        [TestCase("nitinol", 4, 100.0, 0.02)]
        [TestCase("nitinol", 4, 200.0, 0.02)]
        [TestCase("nitinol", 9, 200.0, 0.005)]
        [TestCase("steel", 4, 200.0, 0.042)]
        [TestCase("steel", 7, 200.0, 0.011)]
        public void Loop_LosesTheHeatOfTheClosedForm(string material, int rings, double k, double limit)
        {
            bool isSteel = material == "steel";
            double line = isSteel ? 1.5e9 / 190e9 : 500e6 / 60e9;
            double exact = isSteel ? 1.5e9 * (3.0 * Psi(k, line) + Psi(k, 2.0 * line))
                : 4.0 * 125e6 * (Psi(k, line) - Psi(k, line + 0.05));
            var history = new History(isSteel ? Steel(rings) : Nitinol(rings, 0.05));
            foreach (double end in new[] { k, 0.0, -k, 0.0 })
            {
                double from = history.Curvature;
                for (int i = 1; i <= 400; i++)
                {
                    history.Bend(from + (end - from) * i / 400.0, 0.0);
                }
            }
            Row.Holds("heat of a loop of " + material + ", " + rings + " rings, of the closed form",
                history.Heat / exact, 1.0, limit);
        }

        /// <summary>A wire that is rotated in a bend: heat per turn 8 pi d (k (a^3 - r^3)/3 - x (a^2 - r^2)/2), with x
        /// = s/E, r = x/k, less the same beyond e_max; and the couple across the bend is that over 2 pi k.</summary>
        [Category("Row")]
        [TestCase(100.0)]
        [TestCase(200.0)]
        public void Turn_OfABentSection_LosesTheHeatOfTheClosedForm(double k)
        {
            double Moving(double x)
            {
                double r = Math.Min(Radius, x / k);
                return 8.0 * Math.PI * 125e6 * (k * (Math.Pow(Radius, 3.0) - r * r * r) / 3.0
                    - x * (Radius * Radius - r * r) / 2.0);
            }
            double exact = Moving(500e6 / 60e9) - Moving(500e6 / 60e9 + 0.05);
            var history = new History(Nitinol(4, 0.05));
            for (int i = 1; i <= 200; i++)
            {
                history.Bend(k * i / 200.0, 0.0);
            }
            double across = 0.0;
            for (int turn = 0; turn < 2; turn++)
            {
                (history.Heat, across) = (0.0, 0.0);
                for (int i = 1; i <= 720; i++)
                {
                    double angle = 2.0 * Math.PI * i / 720.0;
                    across += history.Couple(k, angle).Across / 720.0;
                    history.Bend(k, angle);
                }
            }
            Row.Holds("heat of a turn in a bend, of the closed form", history.Heat / exact, 1.0, 0.02);
            Row.Holds("mean couple that turns a wire in a bend, of that of the heat",
                across * 2.0 * Math.PI * k / exact, 1.0, 0.02);
        }

        [Test]
        public void Correction_HasTheDerivativesOfItsEnergy([Values(0.0, 1.5e9)] double hardening)
        {
            var law = new MaterialLaw
            {
                IsSuperelastic = true, Upper = 500e6, Lower = 250e6, Strain = 0.03, Hardening = hardening, Rings = 3,
            };
            var section = new FibreSection(law, 60e9, Radius, 0.3 * Radius);
            var states = new double[section.StateCount];
            var random = new Random(3);
            for (int i = 0; i < states.Length; i++)
            {
                states[i] = 0.06 * (random.NextDouble() - 0.5);
            }
            double Energy(double x, double y)
            {
                var curve = default(FibreCurve);
                section.Add(x, y, states, 0, 1.0, ref curve);
                return curve.Energy;
            }
            var at = default(FibreCurve);
            section.Add(130.0, -70.0, states, 0, 1.0, ref at);
            double Slope(Func<double, double> f) => EnergySlopes.FineDifference(1e-4, f);
            double near = 1e-8 * (Math.Abs(at.Moment1) + Math.Abs(at.Moment2));
            Assert.That(at.Moment1, Is.EqualTo(Slope(s => Energy(130.0 + s, -70.0))).Within(near));
            Assert.That(at.Moment2, Is.EqualTo(Slope(s => Energy(130.0, -70.0 + s))).Within(near));
            double Moment1(double x, double y)
            {
                var curve = default(FibreCurve);
                section.Add(x, y, states, 0, 1.0, ref curve);
                return curve.Moment1;
            }
            double size = Math.Abs(at.Slope11) + Math.Abs(at.Slope22);
            Assert.That(at.Slope11, Is.EqualTo(Slope(s => Moment1(130.0 + s, -70.0))).Within(1e-7 * size));
            Assert.That(at.Slope12, Is.EqualTo(Slope(s => Moment1(130.0, -70.0 + s))).Within(1e-7 * size));

            var own = new double[states.Length];
            section.AddOwn(130.0, -70.0, states, 0, 1.0, own, 0);
            for (int i = 0; i < own.Length; i++)
            {
                Assert.That(Math.Abs(own[i]), Is.AtMost(0.03));
            }
        }

        private static double G(double eta) => (Math.Asin(eta) - eta * Math.Sqrt(1.0 - eta * eta)
            * (1.0 - 2.0 * eta * eta)) / (2.0 * eta) + 4.0 / 3.0 * Math.Pow(1.0 - eta * eta, 1.5);

        private static double Psi(double k, double x)
        {
            double eta = Math.Min(1.0, x / (Radius * k));
            double q = Math.Sqrt(1.0 - eta * eta);
            return 4.0 * k * Math.Pow(Radius, 3.0) * (q * q * q / 3.0 - 0.5 * eta * (Math.Acos(eta) - eta * q));
        }

        private static FibreSection Nitinol(int rings, double strain) => new FibreSection(new MaterialLaw
        {
            IsSuperelastic = true, Upper = 500e6, Lower = 250e6, Strain = strain, Hardening = 0.0, Rings = rings,
        }, 60e9, Radius, 0.0);

        private static FibreSection Steel(int rings) => new FibreSection(
            new MaterialLaw { Upper = 1.5e9, Hardening = 0.0, Rings = rings }, 190e9, Radius, 0.0);

        // A section that is bent step by step.
        private sealed class History
        {
            private readonly FibreSection _section;
            private double[] _states;

            public History(FibreSection section)
            {
                _section = section;
                _states = new double[section.StateCount];
            }

            public double Curvature { get; private set; }

            public double Heat { get; set; }

            // Along the bend and across it.
            public (double Along, double Across) Couple(double curvature, double angle)
            {
                double c = Math.Cos(angle);
                double s = Math.Sin(angle);
                FibreCurve curve = At(curvature * c, curvature * s);
                double young = _section.ElasticStrain > 0.008 ? 60e9 : 190e9;
                return (young * Second * curvature + c * curve.Moment1 + s * curve.Moment2,
                    c * curve.Moment2 - s * curve.Moment1);
            }

            public void Bend(double curvature, double angle)
            {
                double x = curvature * Math.Cos(angle);
                double y = curvature * Math.Sin(angle);
                double before = At(x, y).Energy;
                var next = new double[_states.Length];
                _section.AddOwn(x, y, _states, 0, 1.0, next, 0);
                _states = next;
                Heat += before - At(x, y).Energy;
                Curvature = curvature;
            }

            // Down to no couple; the curvature that is left.
            public double Unload(double from, double angle = 0.0)
            {
                double low = -from;
                double high = from;
                for (int k = 0; k < 200; k++)
                {
                    double middle = 0.5 * (low + high);
                    (low, high) = Couple(middle, angle).Along > 0.0 ? (low, middle) : (middle, high);
                }
                return high;
            }

            private FibreCurve At(double x, double y)
            {
                var curve = default(FibreCurve);
                _section.Add(x, y, _states, 0, 1.0, ref curve);
                return curve;
            }
        }
    }
}
