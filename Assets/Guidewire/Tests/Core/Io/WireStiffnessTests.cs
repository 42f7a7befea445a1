using System;
using System.IO;
using Guidewire.Io;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>EI, GJ, EA and mass per length of the whole wire beside moduli and density.</summary>
    public sealed class WireStiffnessTests : FolderTests
    {
        // A tube: A = pi (r^2 - a^2), I = pi (r^4 - a^4)/4.
        private const double Radius = 3e-4;
        private const double Inner = 1e-4;
        private const double Area = Math.PI * (Radius * Radius - Inner * Inner);
        private const double Second =
            0.25 * Math.PI * (Radius * Radius * Radius * Radius - Inner * Inner * Inner * Inner);

        private static readonly string Wire = "{\"solver\": \"direct\", \"wireRadius\": 3e-4, \"innerRadius\": 1e-4";

        private string Scene => Path.Combine(Folder, "scene.json");

        [TestCase(2e-5)]
        [TestCase(3e-4)]
        public void StiffnessAndMass_AreThoseOfTheWire(double given)
        {
            MaterialParameters wire = Load(", \"bendingStiffness\": " + NumberText.Write(given)
                + ", \"torsionalStiffness\": 1.5e-5, \"massPerLength\": 4e-3, \"axialStiffness\": 700}")
                .Values.Simulation.Material;
            CrossSection here = CrossSection.At(wire, 1.0);
            Assert.That(here.BendStiffness1, Is.EqualTo(given).Within(1e-14 * given));
            Assert.That(here.BendStiffness2, Is.EqualTo(given).Within(1e-14 * given));
            Assert.That(here.TwistStiffness, Is.EqualTo(1.5e-5).Within(1e-19));
            Assert.That(here.LineDensity, Is.EqualTo(4e-3).Within(1e-17));
            Assert.That(here.StretchStiffness, Is.EqualTo(700.0));
        }

        [Test]
        public void BendingStiffnessAlone_SaysTheModulus()
        {
            MaterialParameters wire = Load(", \"bendingStiffness\": 1e-4}").Values.Simulation.Material;
            Assert.That(wire.YoungsModulus, Is.EqualTo(1e-4 / Second).Within(1e-12 * wire.YoungsModulus));
            Assert.That(CrossSection.At(wire, 1.0).StretchStiffness,
                Is.EqualTo(1e-4 / Second * Area).Within(1e-9 * wire.YoungsModulus * Area));
        }

        [Test]
        public void AxialStiffnessAlone_LeavesBendingToTheModulus()
        {
            MaterialParameters wire =
                Load(", \"youngsModulus\": 60e9}", ("axialStiffness", 500.0)).Values.Simulation.Material;
            CrossSection here = CrossSection.At(wire, 1.0);
            Assert.That(here.StretchStiffness, Is.EqualTo(500.0));
            Assert.That(here.BendStiffness1, Is.EqualTo(60e9 * Second).Within(1e-12 * 60e9 * Second));
        }

        [Test]
        public void SectionOfAnotherModulus_HasItsOwnStiffness_AndOthersHaveThatOfTheWire()
        {
            MaterialParameters wire = Load(", \"bendingStiffness\": 1e-4, \"axialStiffness\": 500, \"wireSections\": ["
                + "{\"from\": 200, \"to\": 250, \"youngsModulus\": 1e9}, {\"from\": 250, \"to\": 280,"
                + " \"restCurvature\": [1, 0, 0]}]}").Values.Simulation.Material;
            Assert.That(CrossSection.At(wire, 225.0).BendStiffness1, Is.EqualTo(1e9 * Second).Within(1e-12));
            Assert.That(CrossSection.At(wire, 265.0).BendStiffness1, Is.EqualTo(1e-4).Within(1e-16));
            Assert.That(CrossSection.At(wire, 265.0).StretchStiffness, Is.EqualTo(500.0));
        }

        [Test]
        public void AxialStiffnessBesideTheModulus_IsIndependent()
        {
            MaterialParameters wire = Load(", \"youngsModulus\": 60e9, \"axialStiffness\": 1e7}")
                .Values.Simulation.Material;
            Assert.That(CrossSection.At(wire, 100.0).StretchStiffness, Is.EqualTo(1e7));
            Assert.That(CrossSection.At(wire, 100.0).BendStiffness1, Is.EqualTo(60e9 * Second).Within(1e-12));
        }

        [TestCase("bendingStiffness", 1e-4, "youngsModulus", 60e9)]
        [TestCase("torsionalStiffness", 1e-4, "shearModulus", 23e9)]
        [TestCase("massPerLength", 1e-2, "density", 6450.0)]
        public void BothWordsOfOneFile_ThatDisagree_AreRefused_AndTheCommandLineReplacesTheFiles(
            string stiffness, double value, string modulus, double other)
        {
            string two = ", \"" + stiffness + "\": " + NumberText.Write(value) + ", \"" + modulus + "\": "
                + NumberText.Write(other) + "}";
            Assert.That(Refusal.Of(() => Load(two)),
                Does.StartWith(Scene + ": " + stiffness).And.Contains(modulus).And.Contains("disagree"));
            Assert.That(() => Load(", \"" + modulus + "\": " + NumberText.Write(other) + "}", (stiffness, value)),
                Throws.Nothing);
            double kept = (double)Load(", \"" + stiffness + "\": " + NumberText.Write(value) + "}", (modulus, other))
                .ToJson()[modulus]!;
            Assert.That(kept, Is.EqualTo(other));
        }

        [Test]
        public void BothWords_ThatAgreeButForRounding_AreTaken()
        {
            double stiffness = 60e9 * Second;
            Assert.That(() => Load(", \"youngsModulus\": 60e9, \"bendingStiffness\": "
                + NumberText.Write(1.0009 * stiffness) + "}"), Throws.Nothing);
            Assert.That(() => Load(", \"youngsModulus\": 60e9, \"bendingStiffness\": "
                + NumberText.Write(1.0011 * stiffness) + "}"), Throws.TypeOf<ParameterException>());
        }

        [TestCase(", \"bendingStiffness\": 1.3e-4}")]
        [TestCase(", \"axialStiffness\": 123.4}")]
        [TestCase(", \"axialStiffness\": 123.4, \"bendingStiffness\": 7e-5, \"torsionalStiffness\": 3e-5}")]
        [TestCase(", \"massPerLength\": 3.3e-3}")]
        public void EffectiveValues_AreAFileOfTheSameBits(string rest)
        {
            ParameterHandler first = Load(rest);
            File.WriteAllText(Scene, first.ToJson().ToString());
            ParameterHandler again = ParameterHandler.Load(Scene, GivenKeys.None);
            Assert.That(again.Hash, Is.EqualTo(first.Hash));
            CrossSection a = CrossSection.At(first.Values.Simulation.Material, 1.0);
            CrossSection b = CrossSection.At(again.Values.Simulation.Material, 1.0);
            Assert.That((b.BendStiffness1, b.StretchStiffness, b.TwistStiffness, b.LineDensity, b.RotaryInertia1),
                Is.EqualTo((a.BendStiffness1, a.StretchStiffness, a.TwistStiffness, a.LineDensity, a.RotaryInertia1)));
        }

        private ParameterHandler Load(string rest, params (string Key, double Value)[] given)
        {
            File.WriteAllText(Scene, Wire + rest);
            return ParameterHandler.Load(Scene, GivenKeys.Of(given, value => value));
        }
    }
}
