using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire in catheters as a composite beam, and as bars that slide along each other.</summary>
    public sealed class CompositeSectionTests
    {
        private const double Unit = 1e-3;       // m
        private const double Length = 0.3;      // of a catheter, m
        private const double Close = 1e-3;
        private const double Rounding = 1e-7;   // of a force that is a difference of energies, N

        private static readonly double[] Young = { 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12 };

        [Test]
        public void Sag_IsThatOfAllSectionsTogether([ValueSource(nameof(Young))] double young,
            [Values(1, 2)] int catheters)
        {
            SimulationParameters parameters = Scene(young, catheters, 300.0);
            parameters.Scene.Gravity = new Vector3d(0.0, -0.05, 0.0);
            Simulation run = Rest(parameters);
            double bend = 0.0;
            double shear = 0.0;
            double weight = 0.0;
            foreach (CrossSection one in Sections(parameters))
            {
                bend += one.BendStiffness1;
                shear += one.ShearStiffness;
                weight += 0.05 * one.LineDensity;
            }
            double sag = weight * Math.Pow(Length, 4) / (8.0 * bend) + weight * Length * Length / (2.0 * shear);
            Assert.That(-Unit * run.State.Positions[60].Y, Is.EqualTo(sag).Within(Close * sag));
            Assert.That(-Unit * run.Coaxial()!.Positions[60].Y, Is.EqualTo(sag).Within(Close * sag));
            // Energy of motion, of the instruments, and of the weight: of what is linear the last is twice the second.
            Vector3d energy = run.Energies()!.Value;
            Assert.That(energy.X, Is.Zero);
            Assert.That(energy.Y, Is.EqualTo(-0.5 * energy.Z).Within(Close * energy.Y));
        }

        // Wire inside, flush or beyond; the pull is on one of them, so is the stretch, and so is its hub's force.
        [Test]
        public void PullAlongTheAxis_StretchesTheOneThatBearsIt([ValueSource(nameof(Young))] double young,
            [Values(250.0, 300.0, 400.0)] double wireLength, [Values(0, 1, 2)] int pulled,
            [Values(1, 2)] int catheters)
        {
            if (pulled > catheters)
            {
                return;
            }
            SimulationParameters parameters = Scene(young, catheters, wireLength);
            CrossSection[] sections = Sections(parameters);
            double stiffness = sections[pulled == 0 ? catheters : pulled - 1].StretchStiffness;
            var force = new Vector3d(0.0, 0.0, 1e-4 * stiffness);
            if (pulled == 0)
            {
                parameters.Scene.TipForce = force;
            }
            else
            {
                parameters.Scene.Catheters[pulled - 1].TipForce = force;
            }
            Simulation run = Rest(parameters);
            CoaxialRecord outer = run.Coaxial()!;
            double[] hubs = { run.Hub()!.Force, outer.Force, outer.Inside?.Force ?? 0.0 };
            double[] tips = { End(run.State.Positions) - wireLength, End(outer.Positions) - 300.0,
                outer.Inside == null ? 0.0 : End(outer.Inside.Positions) - 300.0 };
            double length = pulled == 0 ? wireLength : 300.0;
            for (int k = 0; k <= catheters; k++)
            {
                double stretch = k == pulled ? 1e-4 * length : 0.0;
                Assert.That(tips[k], Is.EqualTo(stretch).Within(Close * 1e-4 * length), "stretch of " + k);
                double pull = k == pulled ? -force.Z : 0.0;
                Assert.That(hubs[k], Is.EqualTo(pull).Within(Close * force.Z + Rounding), "hub " + k);
            }
        }

        // Each hangs on its own hub.
        [Test]
        public void WeightAlongTheAxis_IsBorneByEachHub([Values(1, 2)] int catheters,
            [Values(250.0, 400.0)] double wireLength)
        {
            SimulationParameters parameters = Scene(1e8, catheters, wireLength);
            parameters.Scene.Gravity = new Vector3d(0.0, 0.0, 9.81);
            foreach (Catheter catheter in parameters.Scene.Catheters)
            {
                catheter.Material.Density = 1200.0;
            }
            Simulation run = Rest(parameters);
            CrossSection[] sections = Sections(parameters);
            CoaxialRecord outer = run.Coaxial()!;
            double[] hubs = { outer.Force, outer.Inside?.Force ?? run.Hub()!.Force, run.Hub()!.Force };
            double[] tips = { End(outer.Positions) - 300.0, End(outer.Inside?.Positions ?? run.State.Positions),
                End(run.State.Positions) - wireLength };
            tips[1] -= outer.Inside == null ? wireLength : 300.0;
            for (int k = 0; k <= catheters; k++)
            {
                double length = k == catheters ? Unit * wireLength : Length;
                double weight = 9.81 * sections[k].LineDensity * length;
                Assert.That(hubs[k], Is.EqualTo(-weight).Within(Close * weight), "hub " + k);
                double stretch = weight * length / (2.0 * sections[k].StretchStiffness) / Unit;
                Assert.That(tips[k], Is.EqualTo(stretch).Within(Close * stretch), "stretch of " + k);
            }
        }

        // At a length from its own hub, which is behind the catheter's.
        [TestCase(0, 40.0, 140.0, 80.0)]
        [TestCase(0, 20.0, 90.0, 90.0)]
        [TestCase(0, 0.0, 60.0, 33.3)]
        [TestCase(1, 20.0, 90.0, 85.0)]
        [TestCase(1, 20.0, 90.0, 41.0)]
        public void LoadActsOnTheMaterialOfItsInstrument(int loaded, double start, double wireLength, double at)
        {
            SimulationParameters parameters = Scene(1e9, 1, wireLength);
            parameters.Scene.GuidewireOffset = -start;
            Catheter catheter = parameters.Scene.Catheters[0];
            catheter.Start = start;
            catheter.Length = 100.0;
            catheter.Elements = 100;
            parameters.Scene.NumberRodElements = (int)wireLength;
            PointLoad[] load = { new PointLoad(at, new Vector3d(0.0, 1e-3, 0.0)) };
            parameters.Scene.PointLoads = loaded == 0 ? load : Array.Empty<PointLoad>();
            catheter.PointLoads = loaded == 1 ? load : Array.Empty<PointLoad>();
            Simulation run = Rest(parameters);
            CrossSection[] sections = Sections(parameters);
            double a = Unit * (at - (loaded == 0 ? start : 0.0));
            double inside = Math.Min(0.1, Unit * (wireLength - start));
            double found = Unit * run.Coaxial()!.Positions[100].Y;
            double expected = Deflection(sections, inside, a);
            Assert.That(found, Is.EqualTo(expected).Within(Close * expected));
        }

        // Of the catheter's tip at 0.1 m: sum of M (tip's lever) ds/B + Q ds/GA.
        private static double Deflection(CrossSection[] sections, double inside, double a)
        {
            double sum = 0.0;
            const int count = 200000;
            for (int k = 0; k < count; k++)
            {
                double s = (k + 0.5) * a / count;
                bool isBoth = s < inside;
                double bend = sections[0].BendStiffness1 + (isBoth ? sections[1].BendStiffness1 : 0.0);
                double shear = sections[0].ShearStiffness + (isBoth ? sections[1].ShearStiffness : 0.0);
                sum += a / count * 1e-3 * ((a - s) * (0.1 - s) / bend + 1.0 / shear);
            }
            return sum;
        }

        private static double End(Vector3d[] positions) => positions[positions.Length - 1].Z;

        // The outermost first.
        private static CrossSection[] Sections(SimulationParameters parameters)
        {
            int count = parameters.Scene.Catheters.Count;
            var sections = new CrossSection[count + 1];
            for (int i = 0; i < count; i++)
            {
                sections[i] = CrossSection.At(parameters.Scene.Catheters[i].Material, 0.0);
            }
            sections[count] = CrossSection.At(parameters.Material, 0.0);
            return sections;
        }

        private static Simulation Rest(SimulationParameters parameters)
        {
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            return run;
        }

        private static SimulationParameters Scene(double young, int catheters, double wireLength)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.GuidewireLength = wireLength;
            parameters.Scene.NumberRodElements = (int)Math.Round(wireLength / 5.0);
            parameters.Material.Sections = Array.Empty<WireSection>();
            parameters.Material.WireRadius = 0.5e-3;
            parameters.Material.YoungsModulus = 60e9;
            parameters.Material.ShearModulus = 23e9;
            parameters.Material.Density = 6450.0;
            parameters.Material.ClampRule = ClampRule.HalfElement;
            parameters.Method.MaxSimulationSteps = 0;
            var list = new Catheter[catheters];
            for (int i = 0; i < catheters; i++)
            {
                list[i] = new Catheter { Length = 300.0, Elements = 60 };
                bool isOuter = i == 0 && catheters == 2;
                CoaxialScenes.SetTube(list[i], isOuter ? 1.2e-3 : 0.8e-3, isOuter ? 0.9e-3 : 0.6e-3,
                    isOuter ? 30.0 * young : young, isOuter ? 12.0 * young : 0.4 * young);
                list[i].Material.Density = 1e-9 * young;
            }
            parameters.Scene.Catheters = list;
            return parameters;
        }
    }
}
