using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Runs of a wire in a catheter without stiffness and mass: they are those of the wire alone, on the
    /// catheter's elements.</summary>
    /// <remarks>Where the two have the same stations and the wire's clamp is that of half an element, as joints of
    /// coaxial instruments have it, nothing is left but what the catheter has. On others the wire in it has elements of
    /// the length l_c instead of its own l_w, and either has an error of second order: they differ by c (l_c^2 -
    /// l_w^2).</remarks>
    public sealed class SoftCatheterTests
    {
        private const double Length = 300.0;   // mm, of the wire; half of it in the catheter
        private const int Elements = 30;
        private const int Steps = 80;

        // Swinging under its own weight while both hubs go together, and turn.
        [TestCase(0.0, 0.0, MassRule.Consistent, false)]
        [TestCase(0.05, 3.0, MassRule.Consistent, false)]
        [TestCase(0.4, -20.0, MassRule.Consistent, false)]
        [TestCase(0.4, -20.0, MassRule.Consistent, true)]
        [TestCase(0.05, 0.0, MassRule.Lumped, true)]
        public void OnTheSameStations_ItIsTheWireAlone(double speed, double turns, MassRule mass, bool byStiffness)
        {
            List<Vector3d[]> alone = Run(speed, turns, mass, 0);
            List<Vector3d[]> soft = Run(speed, turns, mass, Elements / 2, byStiffness);
            Assert.That(Math.Abs(alone[Steps - 1][Elements].Y), Is.GreaterThan(0.05 * Length), "it sags");
            double worst = 0.0;
            for (int k = 0; k < Steps; k++)
            {
                worst = Math.Max(worst, Wires.Distance(alone[k], soft[k]) / Length);
            }
            TestContext.WriteLine("{0:G3} of L", worst);
            Assert.That(worst, Is.LessThan(1e-6));
        }

        // Curvatures, couples, strains and forces along the wire, of which the largest is 1; the catheter's are the
        // shared
        // axial force's 2e-5.
        [TestCase(0.05, 3.0, MassRule.Consistent, false)]
        [TestCase(0.4, -20.0, MassRule.Consistent, true)]
        public void OnTheSameStations_StrainsAndForcesAreThoseOfTheWireAlone(double speed, double turns, MassRule mass,
            bool byStiffness)
        {
            var stresses = new StressRecord[2];
            Run(speed, turns, mass, 0, byStiffness, run => stresses[0] = run.Stress()!);
            Run(speed, turns, mass, Elements / 2, byStiffness, run => stresses[1] = run.Stress()!);
            AssertClose(stresses, stress => stress.Curvature);
            AssertClose(stresses, stress => stress.Couple);
            AssertClose(stresses, stress => stress.Strain);
            AssertClose(stresses, stress => stress.Force);
            AssertClose(stresses, stress => new[] { new Vector3d(stress.KineticEnergy, stress.ElasticEnergy,
                stress.PotentialEnergy) });
        }

        private static void AssertClose(StressRecord[] stresses, Func<StressRecord, Vector3d[]> part)
        {
            Vector3d[] alone = part(stresses[0]);
            Vector3d[] soft = part(stresses[1]);
            double largest = 0.0;
            double worst = 0.0;
            for (int k = 0; k < alone.Length; k++)
            {
                largest = Math.Max(largest, alone[k].Length);
                worst = Math.Max(worst, (alone[k] - soft[k]).Length);
            }
            TestContext.WriteLine("{0:G3} of {1:G3}", worst, largest);
            Assert.That(worst, Is.LessThan(1e-4 * largest));
        }

        [Test]
        public void OnOtherStations_ItDiffersAsTheirSquares([Values(0.0, 0.4)] double speed)
        {
            double exact = Sag(speed, 0);
            double own = Square(Elements / 2);
            double perSquare = 0.0;
            foreach (int elements in new[] { 8, 10, 20, 30, 40 })
            {
                double difference = Sag(speed, elements) - exact;
                double found = difference / (Square(elements) - own);
                TestContext.WriteLine("{0} elements: {1:G3} of L, {2:G4}/mm^2", elements, difference, found);
                perSquare = perSquare == 0.0 ? found : perSquare;
                Assert.That(Math.Abs(difference), Is.GreaterThan(1e-5));
                Assert.That(found, Is.EqualTo(perSquare).Within(0.02 * Math.Abs(perSquare)), elements + " elements");
            }
        }

        // mm^2, of the catheter's elements, or of the wire's where as many are in it.
        private static double Square(int elements)
        {
            double l = 0.5 * Length / elements;
            return l * l;
        }

        // Of the tip, of L.
        private static double Sag(double speed, int catheterElements) =>
            -Run(speed, 0.0, MassRule.Consistent, catheterElements)[Steps - 1][Elements].Y / Length;

        private static List<Vector3d[]> Run(double speed, double turns, MassRule mass, int catheterElements,
            bool byStiffness = false, Action<Simulation>? look = null)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            Catheter catheter = parameters.Scene.Catheters[0];
            parameters.Scene.GuidewireLength = Length;
            parameters.Scene.NumberRodElements = Elements;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Material.Sections = Array.Empty<WireSection>();
            parameters.Material.ClampRule = ClampRule.HalfElement;
            parameters.Material.MassRule = mass;
            parameters.Method.TimeStep = 5e-3;
            parameters.Method.MaxSimulationSteps = Steps;
            parameters.Drive.InsertionSpeed = speed;
            parameters.Drive.RotationSpeed = turns;
            catheter.Start = 0.0;
            catheter.Length = 0.5 * Length;
            catheter.Elements = catheterElements;
            catheter.Drive = parameters.Drive;
            catheter.Material.YoungsModulus = byStiffness ? 60e9 : 10.0;
            catheter.Material.ShearModulus = byStiffness ? 23e9 : 4.0;
            catheter.Material.Density = byStiffness ? 1200.0 : 1e-6;
            catheter.Material.Sections = !byStiffness ? Array.Empty<WireSection>() : new[]
            {
                new WireSection { From = 0.0, To = catheter.Length, AxialStiffness = 1e-5, ShearStiffness = 1e-5,
                    BendingStiffness1 = 1e-12, BendingStiffness2 = 1e-12, TorsionalStiffness = 1e-12,
                    MassPerLength = 1e-12, RotaryInertia = 1e-18 },
            };
            parameters.Scene.Catheters = catheterElements == 0 ? Array.Empty<Catheter>() : new[] { catheter };
            Simulation run = Simulation.Create(parameters);
            var found = new List<Vector3d[]>();
            Wires.Finish(run, () =>
            {
                found.Add((Vector3d[])run.State.Positions.Clone());
            });
            look?.Invoke(run);
            return found;
        }
    }
}
