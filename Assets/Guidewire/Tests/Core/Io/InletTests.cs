using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire at an end of a vessel: where it starts, where it goes, what the summary says of it.</summary>
    public sealed class InletTests : FolderTests
    {
        private const double Radius = 2.0;      // of the tube, mm
        private const double Length = 60.0;
        private const int Points = 31;          // of its centreline
        private static readonly Vector3d Slant = Vector3d.Normalize(new Vector3d(-0.5, 0.7, -0.3));

        [TestCase(1, 40, 2.0, TestName = "Wire_StartsOnTheInletsAxis_ARadiusOutOfItsSheath(first end)")]
        [TestCase(2, 40, 2.0, TestName = "Wire_StartsOnTheInletsAxis_ARadiusOutOfItsSheath(second end)")]
        [TestCase(1, 160, 2.0, TestName = "Wire_StartsOnTheInletsAxis_ARadiusOutOfItsSheath(short elements)")]
        [TestCase(1, 16, 5.0, TestName = "Wire_StartsOnTheInletsAxis_OneElementOutOfItsSheath(long elements)")]
        public void Wire_StartsOnTheInletsAxis_ARadiusOutOfItsSheath(int end, int elements, double outside)
        {
            string file = Scene(Slant, end, null);
            JObject parameters = JObject.Parse(File.ReadAllText(file));
            parameters["numberRodElements"] = elements;
            File.WriteAllText(file, parameters.ToString());
            ParameterHandler handler = Load(file);
            SceneParameters scene = handler.Values.Simulation.Scene;
            Vector3d into = end == 1 ? Slant : -Slant;
            Vector3d rim = end == 1 ? Vector3d.Zero : Length * Slant;
            Vector3d[] wire = Simulation.Create(handler.Values.Simulation).State.Positions;
            Assert.That(Vector3d.Distance(scene.Sheath!.Exit!.Value, rim + Radius * into), Is.LessThan(1e-9));
            Assert.That(Vector3d.Distance(wire[wire.Length - 1], rim + (Radius + outside) * into), Is.LessThan(1e-9));
            Assert.That(Vector3d.Distance(wire[0], rim + (Radius + outside - 80.0) * into), Is.LessThan(1e-9));
            Assert.That(Vector3d.Distance(handler.Values.Simulation.Drive.DisplacementDirection, into),
                Is.LessThan(1e-12));
        }

        [Test]
        public void Run_DoesNotDependOnTheVesselsDirection()
        {
            JObject along = Run(Scene(Vector3d.UnitZ, 1, 2), "z");
            JObject slanted = Run(Scene(Slant, 1, 2), "slant");
            Quaterniond turn = new StartAxis(Vector3d.Zero, Slant).Frame;
            Vector3d expected = Quaterniond.Rotate(turn, Tip(along));
            // The wall is turned by the same rotation, rounded; what a step's tolerance leaves is of that size too.
            Assert.That(Vector3d.Distance(Tip(slanted), expected), Is.LessThan(1e-4));
            Assert.That((double)slanted["centreline"]!["distance"]!,
                Is.EqualTo((double)along["centreline"]!["distance"]!).Within(1e-4));
            Assert.That((double)slanted["hub"]!["insertion"]!, Is.EqualTo(0.02).Within(1e-12));
        }

        [Test]
        public void Summary_SaysWhenTheTipCameWithinARadiusOfItsTarget()
        {
            JToken line = Run(Scene(Slant, 1, new JArray(12.0 * Slant.X, 12.0 * Slant.Y,
                12.0 * Slant.Z)), "run")["centreline"]!;
            // The tip starts at 4 mm and goes at 20 mm/s; at 10 mm, after 0.3 s, it is a radius before the target.
            Assert.That((bool)line["reached"]!);
            Assert.That((double)line["reachedAt"]!, Is.EqualTo(0.3).Within(0.06));
            Assert.That((double)line["distance"]!, Is.EqualTo(24.0).Within(0.3));
            Assert.That((double)line["targetDistance"]!, Is.EqualTo(12.0).Within(1e-9));
            Assert.That(line["path"]!.ToString(Newtonsoft.Json.Formatting.None), Is.EqualTo("[\"branch 1\"]"));
        }

        [Test]
        public void SessionAtItsStart_HasNoContrastAgent()
        {
            using SimulationSession session = SimulationSession.Open(Scene(Slant, 1, null), GivenKeys.None, true);
            session.Contrast!.Inject(null, 1.0, 5.0);
            session.Step(0.1, 0.0);
            Assert.That(session.Contrast.Flow.Injected, Is.EqualTo(5.0 * 0.05).Within(1e-9), "5 ml/s for a step");
            session.Reset();
            Assert.That((session.Contrast.Flow.Injected, session.Contrast.Flow.IsInjecting), Is.EqualTo((0.0, false)));
        }

        [Test]
        public void Summary_SaysHowFarTheTipCame_ThereAndBack()
        {
            string file = Scene(Slant, 1, null);
            JObject parameters = JObject.Parse(File.ReadAllText(file));
            parameters.Remove("insertionSpeed");
            parameters["driveFile"] = "drive.csv";
            File.WriteAllText(Path.Combine(Folder, "drive.csv"),
                "time,insertion,rotation\n0,0,0\n0.5,0.01,0\n1,0.004,0\n");
            File.WriteAllText(file, parameters.ToString());
            JToken line = Run(file, "run")["centreline"]!;
            Assert.That((double)line["farthest"]!, Is.EqualTo(14.0).Within(0.3), "4 mm before, and 10 mm");
            Assert.That((double)line["distance"]!, Is.EqualTo(8.0).Within(0.3));
        }

        [Test]
        public void Summary_SaysThatTheTargetWasNotReached()
        {
            JToken line = Run(Scene(Slant, 1, 2), "run")["centreline"]!;
            Assert.That((bool)line["reached"]!, Is.False);
            Assert.That(line["reachedAt"]!.Type, Is.EqualTo(JTokenType.Null));
            Assert.That((double)line["targetDistance"]!, Is.EqualTo(Length).Within(1e-9));
        }

        [Test]
        public void EffectiveParameters_RepeatTheRun()
        {
            ParameterHandler first = Load(Scene(Slant, 2, 1));
            string file = Path.Combine(Folder, "parameters.json");
            File.WriteAllText(file, first.ToJson().ToString());
            ParameterHandler again = ParameterHandler.Load(file, GivenKeys.None);
            Assert.That(again.Hash, Is.EqualTo(first.Hash));
            Assert.That(Simulation.Create(again.Values.Simulation).State.Positions,
                Is.EqualTo(Simulation.Create(first.Values.Simulation).State.Positions));
        }

        [Test]
        public void Distances_BeginAtTheInlet_WhereverTheTreesRootIs()
        {
            Anatomy fork = Fork();
            var path = new CentrelinePath(fork, fork.Ends[1]);
            Assert.That(path.Distances[20], Is.EqualTo(0.0));
            Assert.That(path.Distances[10], Is.EqualTo(10.0).Within(1e-12));
            Assert.That(path.Distances[0], Is.EqualTo(20.0).Within(1e-12));
            Assert.That(path.Distances[30], Is.EqualTo(20.0).Within(1e-12));
            Assert.That(path.BranchesTo(30), Is.EqualTo(new[] { "left", "stem", "right" }));
            // The branch goes along (0, -1, 1)/sqrt(2): only the part of a displacement along it counts.
            Assert.That(path.DistanceOf(fork.Points[30] - new Vector3d(0.0, 0.1, 0.0), 30),
                Is.EqualTo(20.0 + 0.1 * Math.Sqrt(0.5)).Within(1e-12));
        }

        [Test]
        public void Target_IsReachedAtARadiusBeforeAndBeyond_NotInTheOtherBranch()
        {
            Anatomy fork = Fork();
            var path = new CentrelinePath(fork, fork.Ends[0]);
            path.SetTarget(25, "right", 1.0);
            Assert.That(path.IsAtTarget(23), Is.False, "two radii before");
            Assert.That(path.IsAtTarget(24), Is.True, "a radius before");
            Assert.That(path.IsAtTarget(30), Is.True, "beyond");
            Assert.That(path.IsAtTarget(15), Is.False, "as far into the other branch");
            Assert.That(path.Within("right"), Is.EqualTo(22));
        }

        [Test]
        public void PointOfAWideVessel_IsNotTakenForOneOfANarrowVesselBeside()
        {
            var beside = new Anatomy
            {
                Points = new[] { Vector3d.Zero, new Vector3d(0.0, 0.0, 5.0), new Vector3d(12.0, 0.0, 0.0) },
                Radii = new[] { 10.0, 10.0, 1.0 },
                Parents = new[] { -1, 0, 0 },
                Branches = new[] { 0, 0, 1 },
                BranchNames = new[] { "wide", "narrow" },
            };
            var path = new CentrelinePath(beside, new VesselEnd(1, "in", Vector3d.Zero, 10.0, Vector3d.UnitZ, 0));
            Assert.That(path.Locate(new Vector3d(9.0, 0.0, 0.0)), Is.EqualTo(0));
            Assert.That(path.Locate(new Vector3d(11.5, 0.0, 0.0)), Is.EqualTo(2));
        }

        [TestCase("inlet", "\"femoral\"", "one of the vessel's ends, 1 \"rim 1\" at [0, 0, 0]")]
        [TestCase("inlet", "7", "one of the vessel's ends")]
        [TestCase("inlet", "0", "a number from 1")]
        [TestCase("inlet", "[100, 0, 0]", "a point within 6 units of one of the vessel's ends")]
        [TestCase("target", "\"branch 9\"", "a branch, one of branch 1")]
        [TestCase("target", "[0, 100, 0]", "a point of the lumen")]
        [TestCase("inlet", "null", "needs an inlet")]
        [TestCase("startShape", "\"ring\"", "startShape \"straight\"")]
        [TestCase("vessel.anatomy", "\"none.json\"", "none.json")]
        public void WrongEnd_IsOneLineThatNamesWhatThereIs(string key, string value, string expected)
        {
            string scene = Scene(Slant, 1, 2);
            Assert.That(Refusal.Of(() => ParameterHandler.Load(scene, GivenKeys.Of((key, JToken.Parse(value))))),
                Does.Contain(expected));
        }

        [TestCase("\"parents\": [-1,0,", "\"parents\": [-1,5,")]
        [TestCase("\"ends\": [", "\"rims\": [")]
        [TestCase("\"point\": 0", "\"point\": 900")]
        [TestCase("\"radius\": 2", "\"radius\": 0")]
        public void FileThatHoldsNoAnatomy_IsOneLine(string before, string after)
        {
            string scene = Scene(Slant, 1, 2);
            string file = Path.Combine(Folder, "anatomy.json");
            string text = File.ReadAllText(file);
            Assert.That(text, Does.Contain(before));
            File.WriteAllText(file, text.Replace(before, after));
            Assert.That(Refusal.Of(() => Load(scene)), Does.StartWith(file).And.Contains("no anatomy"));
        }

        private static ParameterHandler Load(string file) => ParameterHandler.Load(file, GivenKeys.None);

        private static Vector3d Tip(JObject summary)
        {
            double[] x = summary["hub"]!["tipPosition"]!.Select(item => (double)item).ToArray();
            return new Vector3d(x[0], x[1], x[2]);
        }

        // A stem of eleven points along z and two branches of ten at 45 degrees to it, in steps of 1; radius 1.
        private static Anatomy Fork()
        {
            var points = new List<Vector3d>();
            var parents = new List<int>();
            for (int k = 0; k <= 30; k++)
            {
                double side = k <= 10 ? 0.0 : Math.Sqrt(0.5) * (k <= 20 ? k - 10 : 20 - k);
                points.Add(new Vector3d(0.0, side, Math.Min(k, 10) + Math.Abs(side)));
                parents.Add(k == 21 ? 10 : k - 1);
            }
            return new Anatomy
            {
                Points = points.ToArray(),
                Radii = points.Select(_ => 1.0).ToArray(),
                Parents = parents.ToArray(),
                Branches = points.Select((_, k) => k <= 10 ? 0 : k <= 20 ? 1 : 2).ToArray(),
                BranchNames = new[] { "stem", "left", "right" },
                Ends = new[]
                {
                    new VesselEnd(1, "in", points[0], 1.0, Vector3d.UnitZ, 0),
                    new VesselEnd(2, "out", points[20], 1.0, Vector3d.Normalize(points[19] - points[20]), 20),
                },
            };
        }

        private JObject Run(string scene, string name)
        {
            string folder = Path.Combine(Folder, name);
            new SimulationRun(Load(scene), folder, null).Execute(Existing.Replace);
            return JObject.Parse(File.ReadAllText(Path.Combine(folder, RunSummary.FileName)));
        }

        [TestCase("'end': 'rim 2', 'wallStiffness': 5e3", 5e3)]
        [TestCase("'branch': 'Branch 1', 'wallStiffness': 2e6", 2e6)]
        public void Region_HasItsOwnStiffness(string region, double stiffness)
        {
            WallSoftness soft = Load(WithRegion(region)).Values.Simulation.Scene.Walls[0].Softness!;
            Assert.That((soft.Stiffness, soft.Regions!.StiffnessAt(30.0 * Slant)), Is.EqualTo((1e5, stiffness)));
        }

        [TestCase("'end': 'rim 9', 'wallStiffness': 5e3", "regions[0].end = \"rim 9\" is not allowed: needs one of")]
        [TestCase("'end': 'rim 2', 'branch': 'branch 1', 'wallStiffness': 5e3",
            "regions[0].branch = \"branch 1\" is not allowed: needs no end beside it")]
        [TestCase("'end': 'rim 2'", "regions[0].wallStiffness = (missing) is not allowed: needs a number > 0 (Pa), or")]
        [TestCase("'end': 'rim 2', 'wallStiffness': 5e3, 'modulus': 5e5",
            "regions[0].modulus = 500000.0 is not allowed: needs no wallStiffness beside it")]
        [TestCase("'end': 'rim 2', 'wallStiffness': 1e-3", "needs more than 39.76 Pa: the weight alone")]
        public void BadRegion_IsOneLine(string region, string line) =>
            Assert.That(Refusal.Of(() => Load(WithRegion(region))), Does.Contain(line));

        private string WithRegion(string region)
        {
            string file = Scene(Slant, 1, null);
            JObject parameters = JObject.Parse(File.ReadAllText(file));
            parameters["gravity"] = new JArray(0.0, -9.81, 0.0);
            parameters["vessel"]!["wallStiffness"] = 1e5;
            parameters["vessel"]!["regions"] = new JArray(JObject.Parse("{" + region + "}"));
            File.WriteAllText(file, parameters.ToString());
            return file;
        }

        // A tube of twenty sides, open at both ends, and a wire of 80 mm that is pushed 20 mm from one of them.
        private string Scene(Vector3d axis, int inlet, JToken? target)
        {
            Quaterniond turn = new StartAxis(Vector3d.Zero, axis).Frame;
            const int Sides = 20;
            var mesh = new System.Text.StringBuilder();
            for (int k = 0; k <= 1; k++)
            {
                for (int i = 0; i < Sides; i++)
                {
                    double angle = 2.0 * Math.PI * i / Sides;
                    Vector3d x = Quaterniond.Rotate(turn,
                        new Vector3d(Radius * Math.Cos(angle), Radius * Math.Sin(angle), k * Length));
                    mesh.AppendFormat(CultureInfo.InvariantCulture, "v {0:R} {1:R} {2:R}\n", x.X, x.Y, x.Z);
                }
            }
            for (int i = 0; i < Sides; i++)
            {
                int next = (i + 1) % Sides;
                mesh.Append($"f {i + 1} {next + 1} {Sides + next + 1}\nf {i + 1} {Sides + next + 1} {Sides + i + 1}\n");
            }
            File.WriteAllText(Path.Combine(Folder, "vessel.obj"), mesh.ToString());
            JArray Vector(Vector3d v) => new JArray(v.X, v.Y, v.Z);
            JObject End(int number, Vector3d centre, Vector3d into, int point) => new JObject
            {
                ["number"] = number, ["name"] = "rim " + number, ["centre"] = Vector(centre), ["radius"] = 2,
                ["direction"] = Vector(into), ["open"] = true, ["point"] = point,
            };
            int[] numbers = Enumerable.Range(0, Points).ToArray();
            var anatomy = new JObject
            {
                ["ends"] = new JArray(End(1, Vector3d.Zero, axis, 0), End(2, Length * axis, -axis, Points - 1)),
                ["centreline"] = new JObject
                {
                    ["points"] = new JArray(numbers.Select(k =>
                    {
                        Vector3d x = Length * k / (Points - 1) * axis;
                        return new JArray(x.X, x.Y, x.Z, Radius);
                    })),
                    ["parents"] = new JArray(numbers.Select(k => k - 1)),
                    ["branches"] = new JArray(numbers.Select(_ => 1)),
                    ["names"] = new JArray("branch 1"),
                },
            };
            string text = anatomy.ToString(Newtonsoft.Json.Formatting.None).Replace("\":", "\": ");
            File.WriteAllText(Path.Combine(Folder, "anatomy.json"), text);
            var scene = new JObject
            {
                ["solver"] = "direct", ["guidewireLength"] = 80.0, ["numberRodElements"] = 40, ["wireRadius"] = 0.00018,
                ["youngsModulus"] = 60e9, ["shearModulus"] = 23e9, ["density"] = 6450.0, ["massDamping"] = 20.0,
                ["restCurvature"] = new JArray(-20.0, 0.0, 0.0), ["proximalEnd"] = "clamped", ["drive"] = "displace",
                ["insertionSpeed"] = 0.02, ["sheath"] = new JObject(), ["inlet"] = inlet, ["target"] = target,
                ["vessel"] = new JObject
                {
                    ["shape"] = "mesh", ["file"] = "vessel.obj", ["anatomy"] = "anatomy.json",
                },
                ["contactDistance"] = 0.00005, ["timeStep"] = 0.05, ["deltaThreshold"] = 0.0,
                ["maxSimulationSteps"] = 20,
            };
            string file = Path.Combine(Folder, "scene.json");
            File.WriteAllText(file, scene.ToString());
            return file;
        }
    }
}
