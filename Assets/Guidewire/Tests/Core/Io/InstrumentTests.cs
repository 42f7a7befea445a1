using System;
using System.Collections.Generic;
using System.IO;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What an instrument's name stands for in a parameter file, and how a wrong file is refused.</summary>
    public sealed class InstrumentTests : FolderTests
    {
        // A 2 mm catheter with a bore of 1 mm: I = pi (2^4 - 1^4)/64 mm^4; EI tapers over 8 cm to a quarter.
        private const string Own = @"{
            'title': 'Own', 'kind': 'catheter',
            'diameter': {'value': '6 F', 'basis': 'measured', 'source': 'here'},
            'innerDiameter': {'value': '1 mm', 'basis': 'measured', 'source': 'here'},
            'length': {'value': '100 cm', 'basis': 'measured', 'source': 'here'},
            'flexuralModulus': {'value': '800 MPa', 'basis': 'measured', 'source': 'here'},
            'torsionalRatio': {'value': '0.5', 'basis': 'assumed', 'source': 'here'},
            'density': {'value': '1.2 g/cm3', 'basis': 'assumed', 'source': 'here'},
            'friction': {'value': '0.07', 'basis': 'assumed', 'source': 'here', 'coating': 'PTFE'},
            'distalSections': [
                {'length': {'value': '80 mm', 'basis': 'assumed', 'source': 'here'}, 'profile': 'linear',
                 'bendingStiffness': {'value': '147.262155637 N mm2', 'basis': 'assumed', 'source': 'here'}},
                {'length': {'value': '0.02 m', 'basis': 'assumed', 'source': 'here'}, 'profile': 'uniform',
                 'bendingStiffness': {'value': '1e-4 N m2', 'basis': 'assumed', 'source': 'here'}}],
            'tip': {'shape': 'angled 45 deg', 'basis': 'assumed', 'source': 'here',
                    'bends': [{'angle': '45 deg', 'radius': '5 mm', 'straight': '3 mm'}]}}";

        private static readonly double Stiffness = 800e6 * Math.PI * (16.0 - 1.0) / 64.0 * 1e-12;   // N m^2

        private string Scene => Path.Combine(Folder, "scene.json");

        [SetUp]
        public void WriteInstrument()
        {
            Directory.CreateDirectory(Path.Combine(Folder, "instruments"));
            Write("own", Own);
        }

        [Test]
        public void Instrument_StandsForTheKeysOfItsWire()
        {
            ParameterHandler handler = Load("'instrument': 'own'");
            SimulationParameters simulation = handler.Values.Simulation;
            CrossSection shaft = CrossSection.At(simulation.Material, 0.1);
            double area = Math.PI * (4.0 - 1.0) / 4.0 * 1e-6;
            Assert.That(simulation.Scene.GuidewireLength, Is.EqualTo(1000.0).Within(1e-9));
            Assert.That(simulation.Material.WireRadius, Is.EqualTo(1e-3).Within(1e-15));
            Assert.That(simulation.Material.InnerRadius, Is.EqualTo(5e-4).Within(1e-15));
            Assert.That(shaft.BendStiffness1, Is.EqualTo(Stiffness).Within(1e-12 * Stiffness));
            Assert.That(shaft.TwistStiffness, Is.EqualTo(0.5 * Stiffness).Within(1e-12 * Stiffness));
            Assert.That(shaft.LineDensity, Is.EqualTo(1200.0 * area).Within(1e-12));
            Assert.That(shaft.StretchStiffness, Is.EqualTo(800e6 * area).Within(1e-9 * 800e6 * area));
            Assert.That((string?)handler.ToJson()["instrument"], Is.EqualTo("own"));
            // Of a homogeneous section of the same EI: EA = 4 EI/(r^2 + a^2).
            Assert.That(CrossSection.At(simulation.Material, 999.0).StretchStiffness,
                Is.EqualTo(4.0 * 1e-4 / 1.25e-6).Within(1e-9));
        }

        // A solid core of one material: EI goes with the fourth power of its diameter. The last section has its own.
        [Test]
        public void Core_TapersWithTheFourthRootOfEI_UpToASectionsOwn()
        {
            const string Quantity = "{'value': '0.8 mm', 'basis': 'assumed', 'source': 'here'},";
            Write("own", Own.Replace("'torsionalRatio'", "'coreDiameter': " + Quantity + " 'torsionalRatio'")
                .Replace("{'length': {'value': '0.02 m'", "{'coreDiameter': " + Quantity.Replace("0.8", "0.1")
                    + " 'length': {'value': '0.02 m'"));
            MaterialParameters material = Load("'instrument': 'own'").Values.Simulation.Material;
            Assert.That(CrossSection.At(material, 10.0).CoreRadius, Is.EqualTo(0.4e-3).Within(1e-12));
            CrossSection taper = CrossSection.At(material, 950.0);
            Assert.That(taper.CoreRadius,
                Is.EqualTo(0.4e-3 * Math.Pow(taper.BendStiffness1 / Stiffness, 0.25)).Within(1e-12));
            Assert.That(CrossSection.At(material, 995.0).CoreRadius, Is.EqualTo(0.05e-3).Within(1e-12));
            Assert.That(CrossSection.At(Load("'instrument': 'own', 'wireRadius': 5.1e-4").Values.Simulation.Material,
                10.0).CoreRadius, Is.EqualTo(0.4e-3).Within(1e-12));
            Write("own", Own.Replace("'torsionalRatio'",
                "'coreDiameter': " + Quantity.Replace("0.8", "2.1") + " 'torsionalRatio'"));
            Assert.That(() => Load("'instrument': 'own'"), Throws.InstanceOf<ParameterException>()
                .With.Message.Contains("coreDiameter").And.Message.Contains("at most the diameter"));
        }

        // 2 g over 10 mm, clamped and free: EI = 4 P l^2/pi^2; a core: E pi d^4/64; three points: F s^3/(48 u).
        [TestCase("'coreDiameter': {'value': '0.5 mm', %}, 'coreModulus': {'value': '60 GPa', %}",
            60e9 * Math.PI * 0.0625e-12 / 64.0)]
        [TestCase("'supportForce': {'value': '1.2 N', 'span': '50 mm', 'deflection': '5 mm', %}",
            1.2 * 125e-6 / (48.0 * 5e-3))]
        public void DataSheet_GivesTheStiffnessOfShaftAndTip(string shaft, double stiffness)
        {
            const string Origin = "'basis': 'measured', 'source': 'sheet'";
            double tip = 4.0 * 2.0 * 9.80665e-3 * 1e-4 / (Math.PI * Math.PI);
            JObject content = JObject.Parse(Own);
            content.Remove("flexuralModulus");
            content.Remove("radiopaque");
            content["tip"] = JObject.Parse("{'shape': 'straight', " + Origin + "}");
            var taper = (JObject)content["distalSections"]![0]!;
            taper.Remove("bendingStiffness");
            content["distalSections"] = new JArray(taper);
            content.Merge(JObject.Parse("{" + shaft.Replace("%", Origin) + ", 'tipLoad': {'value': '2 g', " + Origin
                + "}, 'tipLength': {'value': '30 mm', " + Origin + "}}"));
            Write("own", content.ToString());
            MaterialParameters material = Load("'instrument': 'own'").Values.Simulation.Material;
            Assert.That(CrossSection.At(material, 10.0).BendStiffness1, Is.EqualTo(stiffness)
                .Within(1e-12 * stiffness));
            Assert.That(CrossSection.At(material, 970.001).BendStiffness1, Is.EqualTo(tip).Within(1e-12 * tip));
            Assert.That(CrossSection.At(material, 889.9).BendStiffness1, Is.EqualTo(stiffness)
                .Within(1e-12 * stiffness));
            double before = CrossSection.At(material, 968.0).BendStiffness1;
            Assert.That(before, Is.GreaterThan(tip).And.LessThan(tip + 0.06 * (stiffness - tip)));
            content.Remove("tipLength");
            Write("own", content.ToString());
            Assert.That(() => Load("'instrument': 'own'"),
                Throws.TypeOf<ParameterException>().With.Message.Contains("tipLength = (missing)"));
        }

        [TestCase("'coreModulus': {'value': '60 GPa', 'basis': 'measured', 'source': 'here'}",
            "coreModulus = {\"value\":\"60 GPa\"")]
        [TestCase("'tipLength': {'value': '3 cm', 'basis': 'measured', 'source': 'here'}", "tipLoad = (missing)")]
        [TestCase("'tipLoad': {'value': '2', 'basis': 'measured', 'source': 'here'}", "this has no unit")]
        [TestCase("'tipLoad': {'value': '1e9 g', 'basis': 'measured', 'source': 'here'}", "no stiffer than the shaft")]
        public void WrongDataSheet_IsRefused(string member, string expected)
        {
            Write("own", Own.Replace("'torsionalRatio'", member + ", 'torsionalRatio'"));
            Assert.That(() => Load("'instrument': 'own'"),
                Throws.TypeOf<ParameterException>().With.Message.Contains(expected));
        }

        // A ring of 0.1 mm in a wall from 0.5 to 1 mm; 9.307/mm of solid platinum.
        [Test]
        public void Marker_IsASectionThatOnlyPicturesSee()
        {
            const string Marker = "'radiopaque': [{'fromTip': '2 mm', 'length': '1 mm', 'platinum': '0.1 mm',"
                + " 'basis': 'assumed', 'source': 'here'}], ";
            SimulationParameters without = Load("'instrument': 'own'").Values.Simulation;
            Write("own", Own.Replace("'tip'", Marker + "'tip'"));
            ParameterHandler handler = Load("'instrument': 'own'");
            MaterialParameters material = handler.Values.Simulation.Material;
            WireSection section = material.Sections[0];
            Assert.That((section.From, section.To), Is.EqualTo((997.0, 998.0)).Within(1e-9));
            Assert.That(section.Attenuation, Is.EqualTo(9.307 * (1.0 - 0.81) / 0.75).Within(1e-3));
            Assert.That(section.IsMarker && handler.Warnings.Count == 0, Is.True);
            Assert.That(new WireProfile(material, 1000.0).Borders,
                Is.EqualTo(new WireProfile(without.Material, 1000.0).Borders));
            var seen = new RunPictures(handler.Values.Simulation);
            double length = 0.0;
            foreach (OpaqueBand band in seen.Instruments[0].Bands)
            {
                length += (band.To - band.From) * ElementLayout.LastLength(handler.Values.Simulation);
            }
            Assert.That(length, Is.EqualTo(1.0).Within(1e-9), "elements of the straight end are alike");
        }

        [TestCase("'platinum': '0.6 mm'",
            "radiopaque[0].platinum = \"0.6 mm\" is not allowed: needs at most the thickness")]
        [TestCase("'platinum': '1 kg'", "radiopaque[0].platinum")]
        [TestCase("'colour': '1 mm'", "unknown member 'radiopaque[0].colour'")]
        public void WrongMarker_IsRefused(string member, string expected)
        {
            Write("own", Own.Replace("'tip'", "'radiopaque': [{'fromTip': '0 mm', 'length': '1 mm', " + member
                + ", 'basis': 'assumed', 'source': 'here'}], 'tip'"));
            Assert.That(() => Load("'instrument': 'own'"),
                Throws.TypeOf<ParameterException>().With.Message.Contains(expected));
        }

        // Linear from EI to b = EI/4: the integral of 1/EI over its length is l ln(4)/(EI - b).
        [Test]
        public void Taper_HasTheComplianceOfItsLinearStiffness()
        {
            double compliance = 0.0;
            double length = 0.0;
            double least = double.PositiveInfinity;
            foreach (WireSection section in Sections("'instrument': 'own'"))
            {
                if (section.BendingStiffness1 > 1.0001e-4)
                {
                    double piece = 1e-3 * (section.To - section.From);
                    compliance += piece / section.BendingStiffness1!.Value;
                    length += piece;
                    least = Math.Min(least, section.BendingStiffness1.Value);
                    Assert.That(section.TorsionalStiffness, Is.EqualTo(0.5 * section.BendingStiffness1).Within(1e-15));
                }
            }
            double expected = 0.08 * Math.Log(4.0) / (0.75 * Stiffness);
            Assert.That(length, Is.EqualTo(0.08).Within(1e-12));
            Assert.That(compliance, Is.EqualTo(expected).Within(1e-9 * expected));
            Assert.That(least, Is.GreaterThan(0.25 * Stiffness));
        }

        [TestCase("", 1000.0)]
        [TestCase(", 'guidewireLength': 400", 400.0)]
        [TestCase(", 'guidewireLength': 0.05, 'metresPerUnit': 1", 0.05)]
        public void Tip_StandsAtTheEndOfAWireOfAnyLength(string more, double units)
        {
            ParameterHandler handler = Load("'instrument': 'own'" + more);
            double unit = handler.Values.Simulation.Scene.MetresPerUnit;
            double turn = 0.0;
            double straight = double.PositiveInfinity;
            foreach (WireSection section in handler.Values.Simulation.Material.Sections)
            {
                double curvature = section.RestCurvature?.X ?? 0.0;
                turn -= curvature * unit * (section.To - section.From);
                straight = curvature != 0.0 ? unit * (units - section.To) : straight;
                Assert.That(curvature, Is.EqualTo(0.0).Or.EqualTo(-200.0).Within(1e-9));
            }
            Assert.That(turn, Is.EqualTo(Math.PI / 4.0).Within(1e-9));
            Assert.That(straight, Is.EqualTo(3e-3).Within(1e-9));
        }

        [TestCase("'bendingStiffness': 2e-3", "bendingStiffness", 2e-3)]
        [TestCase("'youngsModulus': 5e9", "youngsModulus", 5e9)]
        [TestCase("'shearModulus': 1e9", "shearModulus", 1e9)]
        [TestCase("'massPerLength': 0.01", "massPerLength", 0.01)]
        [TestCase("'wireRadius': 0.0007", "wireRadius", 7e-4)]
        [TestCase("'numberRodElements': 50", "numberRodElements", 50.0)]
        public void KeyOfTheFile_OverridesTheInstrument(string key, string name, double expected)
        {
            JObject written = Load("'instrument': 'own', " + key).ToJson();
            Assert.That((double)written[name]!, Is.EqualTo(expected).Within(1e-12 * expected));
            Assert.That(written["wireSections"]!.HasValues, Is.True, "the rest stays the instrument's");
        }

        [Test]
        public void InstrumentOfTheCommandLine_ReplacesTheWireOfTheFile_NotItsLength()
        {
            File.WriteAllText(Scene, Quoted("{'solver': 'direct', 'guidewireLength': 321, 'numberRodElements': 40,"
                + " 'youngsModulus': 1e9, 'axialStiffness': 5, 'massPerLength': 1, 'wireRadius': 2e-4,"
                + " 'restCurvature': [9, 0, 0]}"));
            ParameterHandler handler = ParameterHandler.Load(Scene, new Dictionary<string, JToken>
            {
                ["instrument"] = "own", ["torsionalStiffness"] = 0.25 * Stiffness,
            });
            SimulationParameters simulation = handler.Values.Simulation;
            CrossSection shaft = CrossSection.At(simulation.Material, 0.1);
            Assert.That(simulation.Scene.GuidewireLength, Is.EqualTo(321.0));
            Assert.That(simulation.Scene.NumberRodElements, Is.EqualTo(40));
            Assert.That(simulation.Material.WireRadius, Is.EqualTo(1e-3).Within(1e-15));
            Assert.That(simulation.Material.RestCurvature, Is.EqualTo(Vector3d.Zero));
            Assert.That(simulation.Material.AxialStiffness, Is.Null);
            Assert.That(shaft.BendStiffness1, Is.EqualTo(Stiffness).Within(1e-12 * Stiffness));
            Assert.That(shaft.TwistStiffness, Is.EqualTo(0.25 * Stiffness).Within(1e-12 * Stiffness));
            Assert.That(shaft.LineDensity, Is.LessThan(0.01));
        }

        [Test]
        public void Friction_IsTheInstruments_WhereAWallStatesNone()
        {
            JObject written = Load("'instrument': 'own', 'numberRodElements': 20, 'vessel': {'shape': 'tube',"
                + " 'knots': [[0, 0, -400], [0, 0, 2000]], 'radius': 12}, 'obstacles': [{'shape': 'sphere',"
                + " 'centre': [0, 90, 0], 'radius': 3, 'frictionCoefficient': 0}, {'shape': 'sphere',"
                + " 'centre': [0, 90, 9], 'radius': 3}]").ToJson();
            Assert.That((double)written["vessel"]!["frictionCoefficient"]!, Is.EqualTo(0.07));
            Assert.That((double)written["obstacles"]![0]!["frictionCoefficient"]!, Is.EqualTo(0.0));
            Assert.That((double)written["obstacles"]![1]!["frictionCoefficient"]!, Is.EqualTo(0.07));
        }

        [Test]
        public void EffectiveParameters_RepeatTheRun_WithoutTheInstrumentsFile()
        {
            ParameterHandler first = Load("'instrument': 'own', 'shearModulus': 3e8");
            JObject written = first.ToJson();
            File.Delete(Path.Combine(Folder, "instruments", "own.json"));
            File.WriteAllText(Scene, written.ToString());
            ParameterHandler again = ParameterHandler.Load(Scene, new Dictionary<string, JToken>());
            Assert.That(again.Hash, Is.EqualTo(first.Hash));
            Assert.That((string?)again.ToJson()["instrument"], Is.EqualTo("own"));
        }

        [Test]
        public void FolderBesideTheParameterFile_IsSearchedFirst()
        {
            Assert.That(Load("'instrument': 'lunderquist-extra-stiff-0.035'").Values.Simulation.Material.WireRadius,
                Is.EqualTo(0.5 * 0.035 * 0.0254).Within(1e-15), "the program's");
            Write("lunderquist-extra-stiff-0.035", Own);
            Assert.That(Load("'instrument': 'lunderquist-extra-stiff-0.035'").Values.Simulation.Material.WireRadius,
                Is.EqualTo(1e-3).Within(1e-15));
        }

        [TestCase("'instrument': 'owm'", "did you mean \"own\"?")]
        [TestCase("'instrument': 'owm'", "Searched: ")]
        [TestCase("'instrument': 'amplatz-superstiff-0.035'", "did you mean \"amplatz-super-stiff-0.035\"?")]
        [TestCase("'instrument': '../instruments/own'", "is not known")]
        [TestCase("'instrument': 7", "a text in double quotes")]
        public void UnknownName_IsRefusedWithTheNearest(string keys, string expected)
        {
            Assert.That(() => Load(keys), Throws.TypeOf<ParameterException>().With.Message.StartsWith(Scene + ": ")
                .And.Message.Contains("instrument").And.Message.Contains(expected));
        }

        [TestCase("'6 F', 'basis': 'measured', 'source': 'here'", "'6 F', 'basis': 'measured'", "diameter.source")]
        [TestCase("'6 F', 'basis': 'measured', 'source': 'here'", "'6 F', 'basis': 'measured', 'source': ' '",
            "diameter.source")]
        [TestCase("'basis': 'measured', 'source': 'here'", "'basis': 'known', 'source': 'here'", "diameter.basis")]
        [TestCase("'6 F'", "'6 Fr'", "diameter.value", "in a known unit, not 'Fr'")]
        [TestCase("'6 F'", "'6 MPa'", "diameter.value", "MPa is the unit of a modulus")]
        [TestCase("'6 F'", "'6'", "diameter.value", "this has no unit")]
        [TestCase("'6 F'", "'6F'", "diameter.value", "a number, a space and a unit")]
        [TestCase("'6 F'", "'-6 F'", "diameter.value", "above 0")]
        [TestCase("'6 F'", "'NaN F'", "diameter.value")]
        [TestCase("'6 F'", "6", "diameter.value")]
        [TestCase("'value': '1 mm'", "'value': '0.079 in'", "innerDiameter", "less than the diameter")]
        [TestCase("'100 cm'", "'9 cm'", "length", "100 mm of the distalSections")]
        [TestCase("'100 cm'", "'1000 m'", "length", "100 m at most")]
        [TestCase("'800 MPa'", "'800 N m2'", "flexuralModulus.value", "a modulus")]
        [TestCase("'kind': 'catheter'", "'kind': 'guidewire'", "innerDiameter")]
        [TestCase("'kind': 'catheter'", "'kind': 'stent'", "kind")]
        [TestCase("'title': 'Own', ", "", "title")]
        [TestCase("'density'", "'densities'", "densities")]
        [TestCase("'147.262155637 N mm2'", "'0 N mm2'", "distalSections[0].bendingStiffness.value")]
        [TestCase("'profile': 'linear'", "'profile': 'cubic'", "distalSections[0].profile")]
        [TestCase("'angled 45 deg'", "'angled 30 deg'", "tip.shape")]
        [TestCase("'angled 45 deg'", "'straight'", "tip.shape")]
        [TestCase("'angled 45 deg'", "'J 3 mm'", "tip.shape")]
        [TestCase("'radius': '5 mm'", "'radius': '0.5 mm'", "tip.bends[0].radius")]
        [TestCase("'radius': '5 mm'", "'radius': '5 m'", "tip.bends")]
        [TestCase("'tip'", "'flexuralModulus'", "second time")]
        public void WrongFile_IsRefusedInOneLineThatNamesTheMember(string part, string wrong, params string[] words)
        {
            Assert.That(Own, Does.Contain(part));
            int at = Own.IndexOf(part, StringComparison.Ordinal);
            Write("own", Own.Substring(0, at) + wrong + Own.Substring(at + part.Length));
            string file = Path.Combine(Folder, "instruments", "own.json");
            string message = Refusal.Of(() => Load("'instrument': 'own'"));
            Assert.That(message, Does.StartWith(file + ": "));
            foreach (string word in words)
            {
                Assert.That(message, Does.Contain(word));
            }
        }

        private IReadOnlyList<WireSection> Sections(string keys) => Load(keys).Values.Simulation.Material.Sections;

        private ParameterHandler Load(string keys)
        {
            File.WriteAllText(Scene, Quoted("{'solver': 'direct', " + keys + "}"));
            return ParameterHandler.Load(Scene, new Dictionary<string, JToken>());
        }

        private void Write(string name, string text) =>
            File.WriteAllText(Path.Combine(Folder, "instruments", name + ".json"), Quoted(text));

        private static string Quoted(string text) => text.Replace('\'', '"');
    }
}
