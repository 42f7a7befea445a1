using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A run has gains or a material: what is refused, passed over and chosen by default.</summary>
    public sealed class MaterialKeyTests
    {
        [Test]
        public void MaterialRun_ChoosesItsOwnDefaults()
        {
            RunParameters values = Load(("solver", "direct"));
            Assert.That(values.Simulation.Method.Integrator, Is.EqualTo(Integrator.Esdirk3));
            Assert.That(values.Simulation.Drive.Displacement, Is.Zero);
        }

        [TestCase(1.0)]
        [TestCase(0.01)]
        public void LengthsThatAreNotGiven_AreTheSameInAnyUnit(double metresPerUnit)
        {
            SimulationParameters here = Load(("solver", "direct"), ("metresPerUnit", metresPerUnit)).Simulation;
            SimulationParameters millimetres = Load(("solver", "direct")).Simulation;
            double scale = metresPerUnit / 1e-3;
            Assert.That(millimetres.Method.DeltaThreshold, Is.GreaterThan(0.0));
            Assert.That(here.Method.DeltaThreshold * scale,
                Is.EqualTo(millimetres.Method.DeltaThreshold).Within(1e-12));
            Assert.That(here.Scene.GuidewireLength * scale,
                Is.EqualTo(millimetres.Scene.GuidewireLength).Within(1e-9));
            Assert.That(Load(("solver", "direct"), ("metresPerUnit", metresPerUnit), ("deltaThreshold", 0.5)).Simulation
                .Method.DeltaThreshold, Is.EqualTo(0.5));
        }

        [TestCase("stretchStiffness", 0.5)]
        [TestCase("bendStiffness", 0.5)]
        [TestCase("totalMass", 0.5)]
        public void GainKey_InAMaterialRun_IsRefused(string key, double value)
        {
            Assert.That(() => Load(("solver", "direct"), (key, value)),
                Throws.TypeOf<ParameterException>().With.Message.Contains(key));
        }

        [Test]
        public void MaterialKey_InARunWithGains_IsRefused()
        {
            Assert.That(() => Load(("youngsModulus", 1e9)),
                Throws.TypeOf<ParameterException>().With.Message.Contains("youngsModulus"));
        }

        [Test]
        public void EndsOfTheWire_AreTakenWithGainsToo()
        {
            SceneParameters ends = Load(("proximalEnd", "clamped"), ("distalEnd", "clamped"),
                ("distalRotation", 3.0), ("distalRampTime", 0.1)).Simulation.Scene;
            Assert.That(ends.ProximalEnd, Is.EqualTo(ProximalEnd.Clamped));
            Assert.That(ends.DistalEnd, Is.EqualTo(DistalEnd.Clamped));
            Assert.That(ends.DistalRotation, Is.EqualTo(3.0));
        }

        [TestCase("distalEnd", "sliding", "direct")]
        [TestCase("proximalEnd", "free", "force")]
        [TestCase("axialForce", 1.0, "solver direct")]
        public void EndsThatGainsDoNotKnow_AreRefused(string key, object value, string needed)
        {
            Assert.That(() => Load((key, JToken.FromObject(value))),
                Throws.TypeOf<ParameterException>().With.Message.Contains(key).And.Message.Contains(needed));
        }

        [TestCase("pbd")]
        [TestCase("xpbd")]
        public void EndTurnedAtOnceByMoreThanAJointCanTell_IsRefused(string solver)
        {
            Assert.That(() => Load(("solver", solver), ("distalEnd", "clamped"), ("distalRotation", 1.5)),
                Throws.TypeOf<ParameterException>().With.Message.Contains("distalRampTime"));
        }

        [Test]
        public void IntegratorOfTheOtherKind_IsRefused()
        {
            Assert.That(() => Load(("solver", "direct"), ("integrator", "verlet")),
                Throws.TypeOf<ParameterException>().With.Message.Contains("esdirk3"));
            Assert.That(() => Load(("integrator", "esdirk3")),
                Throws.TypeOf<ParameterException>().With.Message.Contains("verlet"));
        }

        [TestCase("sdirk2", "trbdf2")]
        [TestCase("sdirk3", "esdirk3")]
        [TestCase("sdirk4", "esdirk4")]
        public void OlderWordOfAnIntegrator_IsReadWithAWarning_AndWrittenAsTheNewOne(string older, string newer)
        {
            ParameterHandler old = ParameterHandler.Load(null,
                GivenKeys.Of(("solver", "direct"), ("integrator", older)));
            ParameterHandler today = ParameterHandler.Load(null,
                GivenKeys.Of(("solver", "direct"), ("integrator", newer)));
            Assert.That(old.Warnings, Has.Count.EqualTo(1));
            Assert.That(old.Warnings[0], Does.Contain(older).And.Contain(newer));
            Assert.That((string?)old.ToJson()["integrator"], Is.EqualTo(newer));
            Assert.That(old.Hash, Is.EqualTo(today.Hash));
            Assert.That(today.Warnings, Is.Empty);
        }

        [Test]
        public void OlderWord_IsNoChoiceOfToday()
        {
            Assert.That(ParameterTable.Find("integrator")!.Choices, Does.Not.Contain("sdirk3"));
            Assert.That(() => Load(("integrator", "sdirk3")),
                Throws.TypeOf<ParameterException>().With.Message.Contains("verlet"));
        }

        [Test]
        public void RestShapeOfALooseWire_IsRefused()
        {
            Assert.That(() => Load(("solver", "direct"), ("initialState", "equilibrium")),
                Throws.TypeOf<ParameterException>().With.Message.Contains("clamped"));
        }

        [Test]
        public void Sections_AreReadAndWrittenBack()
        {
            JToken sections = JToken.Parse("[{\"from\": 250.0, \"to\": 300.0, \"numberRodElements\": 5,"
                + " \"wireRadius\": 0.0002, \"restCurvature\": [10.0, 0.0, 0.0]}]");
            RunParameters values = Load(("solver", "direct"), ("wireSections", sections));
            WireSection section = values.Simulation.Material.Sections[0];
            Assert.That(section.WireRadius, Is.EqualTo(2e-4));
            Assert.That(section.RestCurvature, Is.EqualTo(new Vector3d(10.0, 0.0, 0.0)));
            Assert.That(section.Density, Is.Null);
            Assert.That(JToken.DeepEquals(ParameterTable.Find("wireSections")!.Write(values), sections), Is.True);
        }

        [Test]
        public void SectionByStiffness_IsReadAndWrittenBack()
        {
            JToken sections = JToken.Parse("[{\"from\": 250.0, \"to\": 300.0, \"innerRadius\": 0.0,"
                + " \"axialStiffness\": 1000.0, \"shearStiffness\": 400.0, \"bendingStiffness1\": 0.001,"
                + " \"bendingStiffness2\": 0.002, \"torsionalStiffness\": 0.0015, \"massPerLength\": 0.01,"
                + " \"rotaryInertia\": 1E-09}]");
            RunParameters values = Load(("solver", "direct"), ("wireSections", sections));
            Assert.That(values.Simulation.Material.Sections[0].BendingStiffness2, Is.EqualTo(0.002));
            Assert.That(JToken.DeepEquals(ParameterTable.Find("wireSections")!.Write(values), sections), Is.True);
        }

        [Test]
        public void ElasticSlip_IsAtMostTheWiresRadius()
        {
            Assert.That(() => Load(("solver", "direct"), ("wireRadius", 4e-4), ("elasticSlip", 4e-4)), Throws.Nothing);
            Assert.That(() => Load(("solver", "direct"), ("wireRadius", 4e-4), ("elasticSlip", 4.1e-4)),
                Throws.TypeOf<ParameterException>().With.Message.Contains("needs at most wireRadius"));
        }

        [Test]
        public void HollowAsWideAsTheWire_IsRefused()
        {
            Assert.That(() => Load(("solver", "direct"), ("innerRadius", 0.0005)),
                Throws.TypeOf<ParameterException>().With.Message.Contains("innerRadius"));
            Assert.That(() => Load(("solver", "direct"), ("wireSections",
                    JToken.Parse("[{\"from\": 0.0, \"to\": 9.0, \"innerRadius\": 0.0006}]"))),
                Throws.TypeOf<ParameterException>().With.Message.Contains("wireRadius"));
        }

        [TestCase("[{\"from\": 10.0, \"to\": 5.0}]")]
        [TestCase("[{\"to\": 5.0}]")]
        [TestCase("[{\"from\": 0.0, \"to\": 5.0, \"wireRadius\": -1.0}]")]
        [TestCase("[{\"from\": 0.0, \"to\": 5.0, \"colour\": 1.0}]")]
        [TestCase("[{\"from\": 0.0, \"to\": 5.0, \"numberRodElements\": 1.5}]")]
        [TestCase("[{\"from\": 0.0, \"to\": 5.0, \"numberRodElements\": 0}]")]
        [TestCase("[{\"from\": 290.0, \"to\": 310.0, \"numberRodElements\": 3}]")]
        [TestCase("[{\"from\": 0.0, \"to\": 5.0, \"numberRodElements\": 3},"
            + " {\"from\": 4.0, \"to\": 9.0, \"numberRodElements\": 3}]")]
        [TestCase("{}")]
        public void SectionsThatMakeNoSense_AreRefused(string text)
        {
            Assert.That(() => Load(("solver", "direct"), ("wireSections", JToken.Parse(text))),
                Throws.TypeOf<ParameterException>().With.Message.Contains("wireSections"));
        }

        private static RunParameters Load(params (string Key, JToken Value)[] given) =>
            ParameterHandler.Load(null, GivenKeys.Of(given)).Values;
    }
}
