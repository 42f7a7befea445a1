using System.Collections.Generic;
using System.Linq;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The key catheters: what it reads, and its one line for each bad input.</summary>
    public sealed class CatheterReaderTests
    {
        private const string Good = "{\"start\": 100, \"length\": 150, \"elements\": 15, \"wireRadius\": 0.00083,"
            + " \"lumenRadius\": 0.0006, \"bendingStiffness\": 7e-4, \"torsionalStiffness\": 5e-4,"
            + " \"rotationSpeed\": 2}";

        private const string Outer = "{\"start\": 110, \"length\": 80, \"elements\": 10, \"wireRadius\": 0.0014,"
            + " \"lumenRadius\": 0.001, \"bendingStiffness\": 1e-3, \"torsionalStiffness\": 8e-4}";

        [Test]
        public void Catheter_IsReadWithTheKeysOfAWire()
        {
            Catheter catheter = Load(Good).Values.Simulation.Scene.Catheters[0];
            Assert.That(catheter.Length, Is.EqualTo(150.0));
            Assert.That(catheter.Elements, Is.EqualTo(15));
            Assert.That(catheter.Start, Is.EqualTo(100.0));
            Assert.That(catheter.Material.InnerRadius, Is.EqualTo(0.6e-3));
            Assert.That(catheter.Material.YoungsModulus * catheter.Material.SecondMomentOfArea,
                Is.EqualTo(7e-4).Within(1e-12));
            Assert.That(catheter.Drive.RotationSpeed, Is.EqualTo(2.0));
            Assert.That(catheter.FrictionCoefficient, Is.NaN);
            ParameterHandler slippery = Load(Good.Replace("{", "{\"frictionCoefficient\": 0.04, "));
            Assert.That(slippery.Values.Simulation.Scene.Catheters[0].FrictionCoefficient, Is.EqualTo(0.04));
            Assert.That(slippery.Hash, Is.Not.EqualTo(Load(Good).Hash));
        }

        [TestCase("\"lumenRadius\": 0.0006", "\"lumenRadius\": 0.0004",
            "catheters[0].lumenRadius = 0.0004 is not allowed: needs more"
            + " than 0.00045 m, the wire's own largest radius")]
        [TestCase("\"lumenRadius\": 0.0006", "\"lumenRadius\": 0.0009", "lumenRadius")]
        [TestCase("\"lumenRadius\": 0.0006,", "", "catheters[0] needs lumenRadius")]
        [TestCase("\"length\": 150", "\"length\": -1", "catheters[0].length = -1 is not allowed: needs a number > 0")]
        [TestCase("\"length\": 150,", "", "catheters[0] needs length")]
        [TestCase("\"start\": 100", "\"start\": -1", "catheters[0].start = -1 is not allowed")]
        [TestCase("\"start\": 100", "\"start\": 100, \"frictionCoefficient\": -0.1",
            "catheters[0].frictionCoefficient = -0.1 is not allowed: needs a number >= 0")]
        [TestCase("\"start\": 100", "\"start\": 295",
            "catheters[0].start = 295 is not allowed: needs at most 290 units")]
        [TestCase("\"start\": 100", "\"begin\": 100", "unknown key 'catheters[0].begin'")]
        [TestCase("\"start\": 100", "\"start\": 100, \"lumenFriction\": 10",
            "catheters[0].lumenFriction = 10 is not allowed: needs a coefficient of friction from 0 to 2")]
        [TestCase("\"rotationSpeed\": 2", "\"wireSections\": [{\"from\": 60, \"to\": 80, \"innerRadius\": 1e-4}]",
            "needs an innerRadius of more than")]
        [TestCase("\"rotationSpeed\": 2", "\"pointLoads\": [{\"at\": 151, \"force\": [0, 0, 1]}]",
            "catheters[0].pointLoads")]
        [TestCase("\"rotationSpeed\": 2", "\"hubForceLimit\": 1",
            "catheters[0].hubForceLimit = 1 is not allowed: needs a vessel or obstacles")]
        [TestCase("\"rotationSpeed\": 2", "\"instrument\": \"nonesuch\"", "nonesuch")]
        [TestCase("\"rotationSpeed\": 2", "\"driveFile\": \"nowhere.csv\"", "nowhere.csv: no such file")]
        [TestCase("\"rotationSpeed\": 2", "\"wireSections\": [{\"from\": 0, \"to\": 9, \"bendingStiffness1\": 1e-3}]",
            "catheters[0].wireSections = [{\"from\":0,\"to\":9,\"bendingStiffness1\":0.001}] is not allowed: needs"
            + " sections of equal bending")]
        [TestCase("\"wireRadius\": 0.00083,", "", "catheters[0] needs wireRadius, or an instrument")]
        [TestCase("\"length\": 150", "\"length\": \"long\"", "catheters[0].length = \"long\" is not allowed")]
        [TestCase("\"wireRadius\": 0.00083, \"lumenRadius\": 0.0006", "\"instrument\": \"microcatheter-2.4f\"",
            "catheters[0].lumenRadius needs more than 0.00045 m, the wire's own largest radius")]
        [TestCase("\"wireRadius\": 0.00083, \"lumenRadius\": 0.0006", "\"instrument\": \"workhorse-0.014\"",
            "catheters[0].instrument = \"workhorse-0.014\" is not allowed: needs a catheter")]
        [TestCase("0.00083, \"lumenRadius\": 0.0006", "0.0005, \"instrument\": \"catheter-angled-5f\"",
            "catheter-angled-5f.json: catheters[0].lumenRadius = 0.00055 is not allowed: needs less than wireRadius")]
        public void BadInput_IsOneLine(string part, string other, string expected) =>
            Assert.That(Refusal.Of(() => Load(Good.Replace(part, other))), Does.Contain(expected));

        [TestCase("solver", "\"xpbd\"", "solver direct")]
        [TestCase("sheath", "{}", "sheath")]
        [TestCase("sheath", "{\"lumenFriction\": 0.1}", "sheath.lumenFriction = 0.1 is not allowed: needs no value: "
            + "along a straight sheath nothing presses on its wall")]
        [TestCase("proximalEnd", "\"held\"", "clamped")]
        [TestCase("materialDamping", "0.001", "materialDamping 0")]
        [TestCase("clampRule", "\"wholeElement\"", "no clampRule")]
        [TestCase("tipMoment", "[0, 0, 1]", "no tipMoment")]
        [TestCase("distalEnd", "\"clamped\"", "distalEnd")]
        [TestCase("displacementDirection", "[0, 1, 0]", "displacementDirection")]
        public void KeyThatDoesNotGoWithACatheter_IsRefused(string key, string value, string expected) =>
            Assert.That(Refusal.Of(() => Load(Good, (key, value))), Does.Contain(expected));

        [Test]
        public void HubThatWouldPassOneThatIsHeld_IsRefused_AndOneThatIsDrivenGoesAlong()
        {
            string back = Good.Replace("\"rotationSpeed\": 2", "\"insertionSpeed\": -0.2");
            Assert.That(Refusal.Of(() => Load(back, ("drive", "\"hold\""))), Does.Contain("catheters[0].start = 100 is "
                + "not allowed: needs at least 200 units, or other drives: at t = 0.5"));
            Assert.That(() => Load(back), Throws.Nothing);
        }

        [Test]
        public void ThreeCatheters_AreRefused()
        {
            Assert.That(Refusal.Of(() => Load(Outer + ", " + Good + ", " + Good)),
                Does.Contain("no more than two catheters"));
        }

        [TestCase("sheath", "{\"exit\": [0, 0, 150]}")]
        [TestCase("hubForceLimit", "1.0")]
        public void KeyThatGoesWithTwoCatheters_IsRead(string key, string value)
        {
            const string tube = "{\"shape\": \"tube\", \"radius\": 10, \"knots\": [[0, 0, -10], [0, 0, 500]],"
                + " \"openStart\": true, \"openEnd\": true}";
            string slippery = Outer.Replace("{", "{\"lumenFriction\": 0.1, ");
            SimulationParameters read = Load(slippery + ", " + Good, (key, value), ("vessel", tube)).Values.Simulation;
            Assert.That(read.Scene.Catheters.Count, Is.EqualTo(2));
            Assert.That(read.Scene.Catheters[0].LumenFriction, Is.EqualTo(0.1));
            Assert.That(key == "sheath" ? read.Scene.Sheath != null : read.Drive.HubForceLimit == 1.0);
        }

        [TestCase("\"elements\": 10", "\"hubForceLimit\": 0.1", "needs a vessel or obstacles")]
        [TestCase("\"start\": 110", "\"start\": 10", "catheters[1].start = 100 is not allowed: needs at most 10 units")]
        [TestCase("\"start\": 110", "\"start\": 245", "start = 100 is not allowed: needs at least 103 units")]
        [TestCase("0.001,", "0.0008,", "needs more than 0.00083 m, the inner catheter's own largest radius")]
        public void OuterCatheterThatDoesNotFit_IsRefused(string part, string other, string expected) =>
            Assert.That(Refusal.Of(() => Load(Outer.Replace(part, other) + ", " + Good)), Does.Contain(expected));

        [Test]
        public void SessionOfThree_HoldsEachHub()
        {
            using SimulationSession session = SimulationSession.Open(null, Given(Outer + ", " + Good), true);
            session.Step(1.0, 0.1);
            session.Step(0.5, 0.2, 1);
            session.Step(0.25, 0.3, 2);
            CoaxialRecord outer = session.Simulation.Coaxial()!;
            Assert.That(session.Simulation.Hub()!.Insertion, Is.EqualTo(1e-3).Within(1e-15));
            Assert.That(outer.Insertion, Is.EqualTo(0.5e-3).Within(1e-15));
            Assert.That(outer.Inside!.Insertion, Is.EqualTo(0.25e-3).Within(1e-15));
            Assert.That(outer.Inside.Turn, Is.EqualTo(0.3).Within(1e-12));
        }

        [Test]
        public void SessionOfThree_MovesAllHubsInOneStep_OrTheFirstOnes()
        {
            using SimulationSession session = SimulationSession.Open(null, Given(Outer + ", " + Good), true);
            double[] all = { 1.0, 0.1, 0.5, 0.2, 0.25, 0.3 };
            double[] one = { 0.5, 0.2 };
            session.Step(all);
            session.Step(one);
            CoaxialRecord outer = session.Simulation.Coaxial()!;
            Assert.That(session.Simulation.StepCount, Is.EqualTo(2));
            Assert.That(session.Simulation.Hub()!.Insertion, Is.EqualTo(1.5e-3).Within(1e-15));
            Assert.That(session.Simulation.Hub()!.Turn, Is.EqualTo(0.3).Within(1e-12));
            Assert.That(outer.Insertion, Is.EqualTo(0.5e-3).Within(1e-15));
            Assert.That(outer.Turn, Is.EqualTo(0.2).Within(1e-12));
            Assert.That(outer.Inside!.Insertion, Is.EqualTo(0.25e-3).Within(1e-15));
            Assert.That(outer.Inside.Turn, Is.EqualTo(0.3).Within(1e-12));
            Assert.That(() => session.Step(new double[8]), Throws.TypeOf<ParameterException>());
        }

        [Test]
        public void Session_HoldsOneHubAtATime()
        {
            using SimulationSession session = SimulationSession.Open(null, Given(Good), true);
            session.Step(1.0, 0.1);
            session.Step(0.5, 0.2, 1);
            Assert.That(session.Simulation.Hub()!.Insertion, Is.EqualTo(1e-3).Within(1e-15));
            Assert.That(session.Simulation.Hub()!.Turn, Is.EqualTo(0.1).Within(1e-12));
            Assert.That(session.Simulation.Coaxial()!.Insertion, Is.EqualTo(0.5e-3).Within(1e-15));
            Assert.That(session.Simulation.Coaxial()!.Turn, Is.EqualTo(0.2).Within(1e-12));
        }

        private static ParameterHandler Load(string catheters, params (string Key, string Value)[] others) =>
            ParameterHandler.Load(null, Given(catheters, others));

        private static List<KeyValuePair<string, JToken>> Given(string catheters,
            params (string Key, string Value)[] others)
        {
            var keys = new Dictionary<string, string>
            {
                ["solver"] = "\"direct\"",
                ["guidewireLength"] = "300",
                ["guidewireOffset"] = "0",
                ["wireRadius"] = "0.00045",
                ["proximalEnd"] = "\"clamped\"",
                ["drive"] = "\"displace\"",
                ["maxSimulationSteps"] = "100",
                ["timeStep"] = "0.01",
                ["catheters"] = "[" + catheters + "]",
            };
            foreach ((string key, string value) in others)
            {
                keys[key] = value;
            }
            return GivenKeys.Of(keys.Select(pair => (pair.Key, pair.Value)), JToken.Parse);
        }
    }
}
