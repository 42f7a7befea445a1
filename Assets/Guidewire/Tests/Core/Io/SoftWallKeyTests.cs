using System.Collections.Generic;
using System.IO;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The keys of soft walls, and what is refused.</summary>
    public sealed class SoftWallKeyTests : FolderTests
    {
        private const string Tube = "'vessel': {'shape': 'tube', 'knots': [[0, 0, -400], [0, 0, 2000]], 'radius': 12";

        [Test]
        public void Vessel_AndObstacles_HaveASoftnessEach_AndItCountsInTheHash()
        {
            ParameterHandler soft = Load(Tube + ", 'wallStiffness': 2e5, 'softLimit': 3e-4, 'tipLength': 2e-3},"
                + " 'obstacles': [{'shape': 'sphere', 'centre': [0, 5, 9], 'radius': 3, 'wallStiffness': 1e4,"
                + " 'relaxationTime': 0.2}]");
            WallSoftness vessel = soft.Values.Simulation.Scene.Walls[0].Softness!;
            Assert.That((vessel.Stiffness, vessel.Limit, vessel.TipLength), Is.EqualTo((2e5, 3e-4, 2e-3)));
            WallSoftness sphere = soft.Values.Simulation.Scene.Walls[1].Softness!;
            Assert.That((sphere.Stiffness, sphere.Limit, sphere.TipLength, sphere.RelaxationTime),
                Is.EqualTo((1e4, 0.0, WallSoftness.DefaultTipLength, 0.2)));
            ParameterHandler rigid = Load(Tube + "}");
            Assert.That(rigid.Values.Simulation.Scene.Walls[0].Softness, Is.Null);
            Assert.That(rigid.Hash, Is.Not.EqualTo(Load(Tube + ", 'wallStiffness': 2e5}").Hash));
        }

        [TestCase("'wallStiffness': 0", "vessel.wallStiffness = 0 is not allowed: needs a number > 0 (Pa)")]
        [TestCase("'wallStiffness': -1e5", "vessel.wallStiffness = -100000.0 is not allowed: needs a number > 0 (Pa)")]
        [TestCase("'wallStiffness': NaN", "has 'NaN' where a value is expected")]
        [TestCase("'wallStiffness': 'soft'", "vessel.wallStiffness = \"soft\" is not allowed")]
        [TestCase("'wallStiffness': 1e5, 'softLimit': -1e-4", "vessel.softLimit = -0.0001 is not allowed: needs a")]
        [TestCase("'wallStiffness': 1e5, 'tipLength': 0", "vessel.tipLength = 0 is not allowed: needs a number > 0")]
        [TestCase("'wallStiffness': 1e5, 'relaxationTime': -1",
            "vessel.relaxationTime = -1 is not allowed: needs a number >= 0 (s)")]
        [TestCase("'wallStiffness': 1e5, 'relaxationTime': 1e9",
            "vessel.relaxationTime = 1000000000.0 is not allowed: needs at most")]
        [TestCase("'wallStiffness': 1e5, 'relaxationTime': 'slow'", "vessel.relaxationTime = \"slow\" is not allowed")]
        [TestCase("'relaxationTime': 1", "vessel.relaxationTime = 1 is not allowed: needs a wallStiffness")]
        [TestCase("'softLimit': 1e-4",
            "vessel.softLimit = 0.0001 is not allowed: needs a wallStiffness or a modulus beside it")]
        [TestCase("'wallSoftness': 1e5", "unknown key 'vessel.wallSoftness'")]
        [TestCase("'wallStiffness': 10}, 'gravity': [0, -9.81, 0", "vessel.wallStiffness = 10 is not allowed: needs "
            + "more than 110.4 Pa: the weight alone")]
        public void BadValue_IsOneLine(string keys, string line)
        {
            string end = keys.EndsWith("[0, -9.81, 0") ? "]" : "}";
            Assert.That(Refusal.Of(() => Load(Tube + ", " + keys + end)), Does.Contain(line));
        }

        [TestCase("'modulus': 5e5, 'wallThickness': 1e-3", "vessel.lumenRadius = (missing) is not allowed: needs a")]
        [TestCase("'modulus': 5e5, 'wallThickness': 2e-3, 'lumenRadius': 3e-3, 'surroundingModulus': 1e4",
            "vessel.wallThickness = 0.002 is not allowed: needs half of the lumenRadius or less")]
        [TestCase("'modulus': 5e5, 'wallStiffness': 1e5", "vessel.modulus = 500000.0 is not allowed: needs no wall")]
        [TestCase("'modulus': -1, 'wallThickness': 1e-3, 'lumenRadius': 3e-3, 'surroundingModulus': 1e4",
            "vessel.modulus = -1 is not allowed: needs a number > 0 (Pa)")]
        public void BadTissue_IsOneLine(string keys, string line) =>
            Assert.That(Refusal.Of(() => Load(Tube + ", " + keys + "}")), Does.Contain(line));

        [Test]
        public void Stiffness_OfTissue_IsThatOfAThinRingInIt()
        {
            ParameterHandler soft = Load(Tube + ", 'modulus': 5e5, 'wallThickness': 1e-3, 'lumenRadius': 3e-3,"
                + " 'surroundingModulus': 1e4}");
            Assert.That(soft.Values.Simulation.Scene.Walls[0].Softness!.Stiffness,
                Is.EqualTo(VesselWall.Stiffness(5e5, 1e-3, 3e-3, 1e4)));
        }

        [TestCase("xpbd")]
        [TestCase("pbd")]
        public void OtherMethods_RefuseIt(string solver)
        {
            Assert.That(Refusal.Of(() => Load(Tube + ", 'wallStiffness': 1e5}", solver)), Does.Contain(
                "vessel.wallStiffness = 100000.0 is not allowed: needs solver direct"));
        }

        [Test]
        public void LimitOfTheRadius_IsForPlanesAndTubesAlone()
        {
            const string Sphere = "'obstacles': [{'shape': 'sphere', 'centre': [0, 60, 90], 'radius': 3,"
                + " 'wallStiffness': 1e5, 'softLimit': 5e-4}]";
            Assert.That(Refusal.Of(() => Load(Sphere)), Does.Contain("obstacles[0].softLimit = 0.0005 is not allowed: "
                + "needs a value below the wire's radius, 0.0005 m: only planes and tubes may give way farther"));
            Assert.That(Load(Tube + ", 'wallStiffness': 1e5, 'softLimit': 2e-3}").Values.Simulation.Scene.Walls.Length,
                Is.EqualTo(1));
        }

        private ParameterHandler Load(string keys, string solver = "direct")
        {
            string path = Path.Combine(Folder, "soft.json");
            File.WriteAllText(path, ("{'solver': '" + solver + "', " + keys + "}").Replace('\'', '"'));
            return ParameterHandler.Load(path, new Dictionary<string, JToken>());
        }
    }
}
