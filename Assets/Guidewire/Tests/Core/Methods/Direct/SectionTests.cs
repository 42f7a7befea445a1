using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Sections of a wire: borders between elements and within them, elements of their own, against closed
    /// forms of the beam.</summary>
    public sealed class SectionTests
    {
        private const double L = 1e3 * Rods.Length;  // units of 1 mm
        private const double Softer = 50.0;

        [Test]
        public void Elements_FollowTheSectionsNumbers_AndTheRestByLength()
        {
            SimulationParameters parameters = Clamped(7);
            parameters.Material.Sections = new[]
            {
                new WireSection { From = 290.0, To = 300.0, NumberRodElements = 4 },
                new WireSection { From = 60.0, To = 100.0, NumberRodElements = 2 },
                new WireSection { From = 0.0, To = 300.0, Density = 5000.0 },
            };
            // The rest, 0 .. 60 and 100 .. 290, is 250 long; 7 elements by length are 1.68 and 5.32.
            double[] lengths = ElementLayout.Lengths(parameters, 1.0, out double[] stations);
            double[] expected = { 30.0, 30.0, 20.0, 20.0, 38.0, 38.0, 38.0, 38.0, 38.0, 2.5, 2.5, 2.5, 2.5 };
            Assert.That(lengths, Is.EqualTo(expected).Within(1e-12));
            Assert.That(stations[stations.Length - 1], Is.EqualTo(300.0).Within(1e-10));
            Assert.That(ElementLayout.Count(parameters), Is.EqualTo(13));
            Assert.That(Simulation.Create(parameters).State.ElementLengths, Is.EqualTo(lengths));
        }

        [TestCase(7)]
        [TestCase(3)]
        public void EvenWire_CutIntoSectionsOfTheSameElements_IsTheSameWire(int cut)
        {
            SimulationParameters plain = Clamped(10);
            plain.Scene.TipForce = new Vector3d(0.0, 0.3 * Rods.BendForce, 0.1 * Rods.BendForce);
            SimulationParameters divided = Clamped(10 - cut);
            divided.Scene.TipForce = plain.Scene.TipForce;
            divided.Material.Sections = new[]
            {
                new WireSection { From = 0.0, To = 30.0 * cut, NumberRodElements = cut },
            };
            Assert.That(Vector3d.Distance(Tip(divided), Tip(plain)), Is.LessThan(1e-9 * L));
        }

        /// <summary>Fifty times softer from 0.6 L on, where no element ends for the n that are tried.</summary>
        [Test]
        public void BorderWithinAnElement_LeavesAnErrorOfSecondOrder()
        {
            foreach (int n in new[] { 31, 62, 124, 248 })
            {
                SimulationParameters parameters = Clamped(n);
                parameters.Material.Sections = new[] { Soft() };
                double error = Math.Abs(SoftTipError(parameters));
                TestContext.WriteLine("n = {0}: {1:E2} of the deflection, times n^2 {2:G3}", n, error, error * n * n);
                // The moment is taken at the joint. What that misses on a joint's two sides, F l^2/(6 EI) of angle
                // each (s (1 - s/l) over an element), cancels but at the border, where it has a lever b = 0.4 L and
                // up to l: l^2 (b + l)/(2 b^3) of the deflection F b^3/(3 EI).
                double l = 1.0 / n;
                Assert.That(error, Is.LessThan(l * l * (0.4 + l) / (2.0 * 0.4 * 0.4 * 0.4)));
            }
        }

        /// <summary>Ten times longer elements in the stiff part than in the soft one.</summary>
        [Test]
        public void BorderBetweenElementsOfDifferentLength_LeavesAnErrorOfSecondOrder()
        {
            var errors = new double[3];
            for (int k = 0; k < errors.Length; k++)
            {
                SimulationParameters parameters = Clamped(5 << k);
                WireSection soft = Soft();
                soft.NumberRodElements = 33 << k;
                parameters.Material.Sections = new[] { soft };
                errors[k] = Math.Abs(SoftTipError(parameters));
                TestContext.WriteLine("{0} and {1} elements: {2:E2}", 5 << k, 33 << k, errors[k]);
            }
            Assert.That(errors[0], Is.LessThan(1e-3));
            for (int k = 1; k < errors.Length; k++)
            {
                Assert.That(Math.Log(errors[k - 1] / errors[k]) / Math.Log(2.0), Is.GreaterThan(1.9));
            }
        }

        /// <summary>A tip of 3 mm bent by 0.3 rad on elements of 10 mm: the wire's end goes (1 - cos 0.3)/kappa to the
        /// side.</summary>
        [Test]
        public void BentTip_ShorterThanHalfAnElement_StillMovesTheTip()
        {
            const double Curvature = 100.0;
            const double Angle = 0.3;
            SimulationParameters parameters = Clamped(30);
            parameters.Material.Sections = new[]
            {
                new WireSection { From = L - 3.0, To = L, RestCurvature = new Vector3d(Curvature, 0.0, 0.0) },
            };
            double side = 1e3 * (1.0 - Math.Cos(Angle)) / Curvature;
            // The element turns by the tip's mean direction to first order: the next term is Angle^2/12 of it.
            Assert.That(-Tip(parameters).Y, Is.EqualTo(side).Within(side * Angle * Angle / 10.0));
        }

        /// <summary>A J of 3 mm radius over half a turn in elements of 0.5 mm on a shaft of 10 mm elements.</summary>
        [Test]
        public void TightTip_WithElementsOfItsOwn_IsItsArc()
        {
            const double Radius = 3.0;
            double arc = Math.PI * Radius;
            SimulationParameters parameters = Clamped(29);
            parameters.Material.Sections = new[]
            {
                new WireSection
                {
                    From = L - arc,
                    To = L,
                    NumberRodElements = 19,
                    RestCurvature = new Vector3d(1e3 / Radius, 0.0, 0.0),
                },
            };
            Vector3d tip = Tip(parameters);
            // A polygon around the arc: its vertices lie off the circle by (l/R)^2/24 of R, l the element's length.
            double l = arc / 19;
            double within = 2.0 * Radius * (l / Radius) * (l / Radius) / 12.0;
            Assert.That(-tip.Y, Is.EqualTo(2.0 * Radius).Within(within));
            Assert.That(tip.Z, Is.EqualTo(L - arc).Within(within));
        }

        [Test]
        public void Elements_OfTheLongestWireThatANumberHolds_AreAllAlike()
        {
            const double Longest = 1.7e308;
            var parameters = new SimulationParameters();
            parameters.Scene.GuidewireLength = Longest;
            parameters.Scene.NumberRodElements = 30;
            double[] lengths = ElementLayout.Lengths(parameters, 1.0, out _);
            Assert.That(lengths, Has.Length.EqualTo(30).And.All.EqualTo(Longest / 30));
        }

        /// <summary>A tube with stiffness and mass of its closed form, and the same numbers given directly.</summary>
        [Test]
        public void WireByStiffness_IsTheWireOfThatMaterialAndRadius()
        {
            const double Inner = 0.3e-3;
            double area = Math.PI * (Rods.Radius * Rods.Radius - Inner * Inner);
            double second = 0.25 * Math.PI * (Math.Pow(Rods.Radius, 4) - Math.Pow(Inner, 4));
            SimulationParameters tube = Clamped(10);
            tube.Material.InnerRadius = Inner;
            var given = new WireSection
            {
                From = 0.0,
                To = L,
                AxialStiffness = Rods.Young * area,
                ShearStiffness = tube.Material.ShearFactor * Rods.Shear * area,
                BendingStiffness1 = Rods.Young * second,
                BendingStiffness2 = Rods.Young * second,
                TorsionalStiffness = 2.0 * Rods.Shear * second,
                MassPerLength = Rods.Density * area,
            };
            SimulationParameters direct = Clamped(10);
            direct.Material.Sections = new[] { given };
            MaterialRod made = new MaterialScene(tube, new Scene(tube)).Rod;
            MaterialRod rod = new MaterialScene(direct, new Scene(direct)).Rod;
            Assert.That(rod.StretchStiffness[5], Is.EqualTo(made.StretchStiffness[5]).Within(1e-12).Percent);
            Assert.That(rod.ShearStiffness[5], Is.EqualTo(made.ShearStiffness[5]).Within(1e-12).Percent);
            Assert.That(rod.BendStiffness1[5], Is.EqualTo(made.BendStiffness1[5]).Within(1e-12).Percent);
            Assert.That(rod.BendStiffness2[5], Is.EqualTo(made.BendStiffness2[5]).Within(1e-12).Percent);
            Assert.That(rod.TwistStiffness[5], Is.EqualTo(made.TwistStiffness[5]).Within(1e-12).Percent);
            Assert.That(rod.LineDensity[5], Is.EqualTo(made.LineDensity[5]).Within(1e-12).Percent);
            Assert.That(rod.RotaryInertia1[5], Is.EqualTo(made.RotaryInertia1[5]).Within(1e-12).Percent);
            Assert.That(rod.RotaryInertia2[5], Is.EqualTo(made.RotaryInertia2[5]).Within(1e-12).Percent);
            Assert.That(made.RotaryInertia1[5], Is.EqualTo(Rods.Density * second).Within(1e-12).Percent);
        }

        /// <summary>A section over the end of a wire whose stiffness is given: a material of its own puts the given
        /// numbers out of force there.</summary>
        [Test]
        public void MaterialOverGivenStiffness_CountsAgain()
        {
            SimulationParameters parameters = Clamped(10);
            parameters.Material.Sections = new[]
            {
                new WireSection { From = 0.0, To = L, BendingStiffness1 = 1.0, BendingStiffness2 = 2.0 },
                new WireSection { From = 0.5 * L, To = L, WireRadius = Rods.Radius },
            };
            MaterialRod rod = new MaterialScene(parameters, new Scene(parameters)).Rod;
            Assert.That(rod.BendStiffness2[4], Is.EqualTo(2.0));
            Assert.That(rod.BendStiffness2[5], Is.EqualTo(Rods.BendStiffness).Within(1e-12).Percent);
        }

        private static WireSection Soft()
        {
            return new WireSection
            {
                From = 0.6 * L, To = L, YoungsModulus = Rods.Young / Softer, ShearModulus = Rods.Shear / Softer,
            };
        }

        /// <summary>Deflection of the soft-ended wire under a small force across its tip, over that of the beam with
        /// shear, less 1: F ((L^3 - b^3)/(3 EI) + b^3/(3 EI')) + F ((L - b)/GA + b/GA'), b = 0.4 L.</summary>
        private static double SoftTipError(SimulationParameters parameters)
        {
            double force = 1e-5 * Rods.BendForce / Softer;
            parameters.Scene.TipForce = new Vector3d(0.0, force, 0.0);
            double b = 0.4 * Rods.Length;
            double bent = (Math.Pow(Rods.Length, 3) - b * b * b + Softer * b * b * b) / (3.0 * Rods.BendStiffness);
            double sheared = (Rods.Length - b + Softer * b)
                / (parameters.Material.ShearFactor * Rods.Shear * Rods.Area);
            return 1e-3 * Tip(parameters).Y / (force * (bent + sheared)) - 1.0;
        }

        private static Vector3d Tip(SimulationParameters parameters)
        {
            Simulation simulation = Simulation.Create(parameters);
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Converged), simulation.Reason);
            return simulation.State.Positions[simulation.State.ElementCount];
        }

        private static SimulationParameters Clamped(int n)
        {
            SimulationParameters parameters = Rods.Clamped(n, Solver.Direct, 1e-3, 0);
            parameters.Method.Integrator = Integrator.Esdirk3;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            return parameters;
        }
    }
}
