using System;
using System.IO;
using System.Linq;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class ParameterHandlerTests : FolderTests
    {
        [Test]
        public void Defaults_AreThesisTable41()
        {
            SimulationParameters defaults = Load("{}").Values.Simulation;
            Assert.That(defaults.Method.ConstraintSolverSteps, Is.EqualTo(500));
            Assert.That(defaults.Scene.NumberRodElements, Is.EqualTo(30));
            Assert.That(defaults.Method.TimeStep, Is.EqualTo(0.01));
            Assert.That(defaults.Scene.GuidewireLength, Is.EqualTo(300.0));
            Assert.That(defaults.Pbd.TotalMass, Is.EqualTo(0.01));
            Assert.That(defaults.Drive.Displacement, Is.EqualTo(10.0));
            Assert.That(defaults.Contact.SphereRadius, Is.EqualTo(5.0));
            Assert.That(defaults.Pbd.StretchStiffness, Is.EqualTo(0.1));
            Assert.That(defaults.Pbd.BendStiffness, Is.EqualTo(0.1));
            Assert.That(defaults.Contact.CollisionStiffness, Is.EqualTo(1e-4));
        }

        [Test]
        public void FilesOfTheSeedsShape_LoadWithOneWarningWhereTheElementLengthDisagrees()
        {
            ParameterHandler handler = Load("{\"logFilePath\": \"results/seed/\", \"rodElementLength\": 10.0,"
                + "\"guidewireLength\": 1000.0, \"numberRodElements\": 30,"
                + " \"position\": {\"x\": 1.0, \"y\": 0.0, \"z\": 0.0},"
                + "\"VerletIntegration\": true, \"SteadyState\": true}");
            Assert.That(handler.Warnings, Has.Count.EqualTo(1));
            Assert.That(handler.Warnings[0], Does.Contain("rodElementLength = 10").And.Contain("33.33"));
            Assert.That(handler.Values.Position.X, Is.EqualTo(1.0));
            Assert.That(handler.Values.LogFilePath, Is.EqualTo("results/seed/"));
        }

        [Test]
        public void AFormerKey_GivesOneLineAndChangesNothing()
        {
            ParameterHandler with = Load("{\"solver\": \"direct\", \"frictionSpeed\": 0.01}");
            Assert.That(with.Warnings, Has.Count.EqualTo(1));
            Assert.That(with.Warnings[0], Does.Contain("frictionSpeed is no longer a key").And.Contain("elasticSlip"));
            Assert.That(with.Hash, Is.EqualTo(Load("{\"solver\": \"direct\"}").Hash));
            Assert.That(ParameterTable.Find("frictionSpeed"), Is.Null);
        }

        [TestCase(0.07, 0.01, 7)]    // 0.07/0.01 is above 7 by rounding
        [TestCase(0.071, 0.01, 8)]
        [TestCase(0.7, 0.1, 7)]
        public void Duration_IsTheLeastStepsThatReachIt_NotOneMoreByRounding(double duration, double step, int steps)
        {
            Assert.That(Load(FormattableString.Invariant($"{{\"duration\": {duration}, \"timeStep\": {step}}}"))
                .Values.Simulation.Method.MaxSimulationSteps, Is.EqualTo(steps));
        }

        [TestCase("{\"VerletIntegration\": false}", Integrator.Euler)]
        [TestCase("{\"VerletIntegration\": true, \"integrator\": \"verlet\"}", Integrator.Verlet)]
        public void OlderWords_SayTheSameAsTheNewer(string text, Integrator expected) =>
            Assert.That(Load(text).Values.Simulation.Method.Integrator, Is.EqualTo(expected));

        [TestCase("seed")]
        [TestCase("thesis")]
        public void ElementContact_TakesTheThesissRuleByItsOlderWordToo(string word)
        {
            ParameterHandler handler = Load("{\"elementContact\": \"" + word + "\"}");
            Assert.That(handler.Values.Simulation.Contact.ElementContact, Is.EqualTo(ElementContact.Thesis));
            Assert.That(handler.Warnings, Has.Count.EqualTo(word == "seed" ? 1 : 0));
        }

        [Test]
        public void SteadyStateFalse_MovesTheFirstSphereEachStepByTheDisplacement()
        {
            SimulationParameters simulation = Load("{\"SteadyState\": false, \"displacement\": 0.5}").Values.Simulation;
            Assert.That(simulation.Drive.Kind, Is.EqualTo(Drive.Displace));
            Assert.That(simulation.Drive.DisplacementPerStep, Is.EqualTo(0.5));
        }

        [TestCase("{\"VerletIntegration\": true, \"integrator\": \"euler\"}", "disagree")]
        [TestCase("{\"SteadyState\": true, \"drive\": \"push\"}", "disagree")]
        [TestCase("{\"timStep\": 0.01}", "did you mean 'timeStep'")]
        [TestCase("{\"duration\": -5}", "duration")]
        [TestCase("{\"duration\": 1e9, \"timeStep\": 0.1}", "at most 1000000000 steps")]
        [TestCase("{\"duration\": 5, \"maxSimulationSteps\": 7}", "no maxSimulationSteps beside it")]
        [TestCase("{\"start\": {}, \"startFile\": \"a.json\"}", "give one of the two")]
        [TestCase("{\"solver\": \"direct\", \"pointLoads\": [{\"at\": 301, \"force\": [0, 1, 0]}]}", "pointLoads")]
        [TestCase("{\"solver\": \"direct\", \"pointLoads\": [{\"at\": -1, \"force\": [0, 1, 0]}]}", "pointLoads[0].at")]
        [TestCase("{\"solver\": \"direct\", \"pointLoads\": [3]}", "pointLoads[0]")]
        [TestCase("{\"pointLoads\": [{\"at\": 1, \"force\": [0, 1, 0]}]}", "pointLoads")]
        [TestCase("{\"distalEnd\": \"held\"}", "distalEnd")]
        [TestCase("{\"solver\": \"direct\", \"distalEnd\": \"held\", \"distalRotation\": 1}", "distalRotation")]
        [TestCase("{\"obstacles\": [{\"shape\": \"cone\", \"from\": [0, 0, 0], \"to\": [0, 0, 1],"
            + " \"fromRadius\": 1, \"toRadius\": 2}]}", "differ by less than its length")]
        [TestCase("{\"obstacles\": [{\"shape\": \"cylinder\", \"point\": [0, 0, 0], \"axis\": [0, 0, 0],"
            + " \"radius\": 1}]}", "axis of length other than 0")]
        [TestCase("{\"endTime\": 5}", "unknown key 'endTime': a run lasts 'maxSimulationSteps' steps of 'timeStep'")]
        [TestCase("{\"selfCollision\": true}", "unknown key 'selfCollision': it is 'selfContact'")]
        [TestCase("{\"length\": 5}", "did you mean 'guidewireLength'?")]
        [TestCase("{\"radius\": 5}", "did you mean 'sphereRadius'?")]
        [TestCase("{\"radius\": 5, \"solver\": \"xpbd\"}", "did you mean 'wireRadius'?")]
        [TestCase("{\"stretchStifness\": 5}", "did you mean 'stretchStiffness'?")]
        [TestCase("{\"stretchStifness\": 5, \"solver\": \"direct\"}", "the command keys lists what is allowed")]
        [TestCase("{\"colour\": 5}", "the command keys lists what is allowed")]
        [TestCase("{\"drive\": \"force\", \"proximalEnd\": \"clamped\"}", "needs proximalEnd \"held\"")]
        [TestCase("{\"drive\": \"force\", \"solver\": \"direct\"}", "needs proximalEnd \"free\"")]
        [TestCase("{\"drive\": \"force\", \"solver\": \"xpbd\", \"proximalEnd\": \"clamped\"}",
            "drive = \"force\" is not allowed: needs proximalEnd \"free\"")]
        [TestCase("{\"timeStep\": 0}", "timeStep = 0 is not allowed: needs a number > 0 (s)")]
        [TestCase("{\"timeStep\": \"fast\"}", "timeStep = \"fast\" is not allowed")]
        [TestCase("{\"timeStep\": null}", "timeStep = null is not allowed")]
        [TestCase("{\"timeStep\": 1e999}", "timeStep")]
        [TestCase("{\"numberRodElements\": 0}", "a whole number from 1 to 1000000")]
        [TestCase("{\"numberRodElements\": 1000000000}", "a whole number from 1 to 1000000")]
        [TestCase("{\"numberRodElements\": 2.5}", "numberRodElements = 2.5 is not allowed")]
        [TestCase("{\"numberRodElements\": 123456789012345678901234567890}", "numberRodElements")]
        [TestCase("{\"drive\": \"shove\"}", "one of \"hold\", \"displace\", \"push\", \"force\"")]
        [TestCase("{\"displacementDirection\": [0, 0, 0]}", "not all 0")]
        [TestCase("{\"displacementDirection\": [0, 1]}", "three numbers")]
        [TestCase("{\"SteadyState\": 1}", "true or false")]
        [TestCase("{\"timeStep\": 0.1, \"timeStep\": 0.2}", "second time")]
        [TestCase("{\"timeStep\": 0.1,}", "comma before '}'")]
        [TestCase("{\"timeStep\": NaN}", "not JSON")]
        [TestCase("{\"timeStep\": 0.1} // s", "line 1, column 19 has a comment, and JSON has none")]
        [TestCase("{\n  # a step\n  \"timeStep\": 0.1}", "line 2, column 3 has a comment, and JSON has none")]
        [TestCase("{\"timeStep\": 0.1, /* s */ \"damping\": 0}", "has a comment, and JSON has none: a text under the "
            + "key \"note\"")]
        [TestCase("{\"timeStep\": 0,1}", "line 1, column 16 has a number with a comma: JSON has a decimal point")]
        [TestCase("{\"gravity\": [0,05, 0, 0]}", "has a number with a comma: JSON has a decimal point")]
        [TestCase("{\"timeStep\": 0.1; \"damping\": 0}", "JSON separates by commas")]
        [TestCase("{\"comment\": \"mine\"}", "unknown key 'comment': a text for readers goes under the key 'note'")]
        [TestCase("{\"note\": 3}", "unknown key 'note': a note needs to be one text")]
        [TestCase("{timeStep: 0.1}", "not JSON")]
        [TestCase("[1, 2]", "needs one JSON object")]
        [TestCase("", "not JSON")]
        public void WhatIsNotAllowed_IsOneLineThatNamesFileAndKey(string text, string expected) =>
            Assert.That(Refusal.Of(() => Load(text)), Does.Contain(expected).And.Contains("wire.json"));

        [Test]
        public void Override_CountsInsteadOfTheFilesOlderWord()
        {
            ParameterHandler handler = Load("{\"VerletIntegration\": true}", ("integrator", "euler"));
            Assert.That(handler.Values.Simulation.Method.Integrator, Is.EqualTo(Integrator.Euler));
        }

        [Test]
        public void EffectiveParameters_LoadAgainAsTheSameRun()
        {
            ParameterHandler first = Load(
                "{\"drive\": \"push\", \"displacementPerStep\": 0.1, \"timeStep\": 0.1234567890123}");
            ParameterHandler second = Load(first.ToJson().ToString());
            Assert.That(second.Hash, Is.EqualTo(first.Hash));
            Assert.That(second.Values.Simulation.Method.TimeStep, Is.EqualTo(0.1234567890123));
        }

        [Test]
        public void Hash_LeavesOutputPathsOut_AndNothingElse()
        {
            string plain = Load("{}").Hash;
            Assert.That(Load("{\"logFilePath\": \"elsewhere\"}").Hash, Is.EqualTo(plain));
            Assert.That(Load("{\"timeStep\": 0.02}").Hash, Is.Not.EqualTo(plain));
            Assert.That(Load("{\"logEvery\": 2}").Hash, Is.Not.EqualTo(plain), "a thinned log is another result");
        }

        [Test]
        public void GainsBeyondTheirLimits_AreWarnedOf()
        {
            Assert.That(Load("{\"stretchStiffness\": 2.0}").Warnings, Has.Count.EqualTo(1));
            Assert.That(Load("{\"bendStiffness\": 10.1}").Warnings, Has.Count.EqualTo(1));
            Assert.That(Load("{\"bendStiffness\": 10.0, \"stretchStiffness\": 1.99}").Warnings, Is.Empty);
        }

        [Test]
        public void StartFile_IsRead_AndRefusedWhereItDoesNotFit()
        {
            string start = Path.Combine(Folder, "start.json");
            File.WriteAllText(start,
                "{\"positions\": [[0,0,0],[0,0,5],[0,5,5]], \"orientations\": [[0,0,0,1],[0,0,0,2]]}");
            SimulationParameters simulation = Load("{\"numberRodElements\": 2}", ("startFile", start))
                .Values.Simulation;
            Assert.That(simulation.Scene.Start!.Positions[2], Is.EqualTo(new Vector3d(0.0, 5.0, 5.0)));
            ParameterException error = Assert.Throws<ParameterException>(
                () => Load("{\"numberRodElements\": 3}", ("startFile", start)))!;
            Assert.That(error.Message, Does.Contain("start.json").And.Contain("positions").Or.Contain("orientations"));
        }

        [Test]
        public void StartFile_CountsFromTheFolderOfItsParameterFile()
        {
            File.WriteAllText(Path.Combine(Folder, "beside.json"),
                "{\"positions\": [[0,0,0],[0,0,7]], \"orientations\": [[0,0,0,1]]}");
            ParameterHandler handler = Load("{\"numberRodElements\": 1, \"startFile\": \"beside.json\"}");
            Assert.That(handler.Values.Simulation.Scene.Start!.Positions[1].Z, Is.EqualTo(7.0));
            Assert.That((string?)handler.ToJson()["startFile"],
                Is.EqualTo(Path.GetFullPath(Path.Combine(Folder, "beside.json"))), "repeats the run from any folder");
            Assert.That(() => Load("{\"numberRodElements\": 1}", ("startFile", "beside.json")),
                Throws.TypeOf<ParameterException>(), "the command line's names count from the current folder");
        }

        [Test]
        public void LoadTables_AreReadBesideTheParameterFile_AndRefusedWhereTheyMakeNoSense()
        {
            const string Scene = "{\"solver\": \"direct\", \"loadTables\": {\"tipForce\": \"pull.csv\"}}";
            string file = Path.Combine(Folder, "pull.csv");
            File.WriteAllText(file, "time,factor\n# a ramp\n0,0\n0.5,2\n");
            ParameterHandler handler = Load(Scene);
            Assert.That(handler.Values.Simulation.Scene.TipForceTable!.At(0.25), Is.EqualTo(1.0));
            File.WriteAllText(file, "0,0\n0.5,3\n");
            Assert.That(Load(Scene).Hash, Is.Not.EqualTo(handler.Hash), "what the file holds counts");
            foreach (string wrong in new[]
                { "0,0\n0,1\n0,2\n", "1,0\n0,1\n", "time,factor\n", "time,value\n0,0\n", "0,0\n1;2\n", "0,0\n1,NaN\n" })
            {
                File.WriteAllText(file, wrong);
                Assert.That(() => Load(Scene), Throws.TypeOf<ParameterException>().With.Message.Contains("loadTables")
                    .And.Message.Contains("pull.csv"));
            }
            File.Delete(file);
            Assert.That(() => Load(Scene), Throws.TypeOf<ParameterException>().With.Message.Contains("pull.csv"));
            Assert.That(() => Load(Scene.Replace("tipForce", "tipMoment")),
                Throws.TypeOf<ParameterException>().With.Message.Contains("tipMoment"));
        }

        [TestCase("time,insertion,rotation\n0,0,0\n1,0.02\n", "line 3")]
        [TestCase("0,0,0\n1,,3\n", "line 2")]
        [TestCase("0,0,0\n1,NaN,3\n", "line 2")]
        [TestCase("time,insertion\n0,0\n", "line 1")]
        [TestCase("0,0,0\n1,0.1,0\n0.5,0.2,0\n", "increase")]
        [TestCase("time,insertion,rotation\n", "at least one row")]
        [TestCase("time,rotation\n0,0\n", "line 1 has no column 'insertion'")]
        [TestCase("time,insertion,angle\n0,0,0\n", "line 1 has a column 'angle': allowed are time, insertion, rot")]
        [TestCase("time,insertion,rotation_turns\n0,0,0\n", "in an unknown unit: allowed are deg, rad")]
        [TestCase("time,insertion_s,rotation\n0,0,0\n", "in an unknown unit: allowed are m, cm, mm")]
        [TestCase("time,insertion,insertion\n0,0,0\n", "the column 'insertion' twice")]
        [TestCase("time;insertion;rotation\n0;0;0\n", "no semicolons")]
        [TestCase("0;0;0\n1;0,5;0\n", "line 1 needs time (s), insertion (m), rotation (rad) with commas between")]
        [TestCase("0;0;0\n", "commas separate columns")]
        [TestCase("0\t0\t0\n", "commas separate columns")]
        [TestCase("0,0,0\n1,5,0,02,0,0\n", "line 2 needs time (s), insertion (m), rotation (rad) with commas between; "
            + "it has 6 numbers: numbers have a decimal point, not a comma")]
        [TestCase(null, "no such file")]
        public void DriveFile_IsRefusedInOneLine_WhereItIsBroken(string? content, string word)
        {
            const string Scene = "{\"solver\": \"direct\", \"drive\": \"displace\", \"proximalEnd\": \"clamped\","
                + " \"driveFile\": \"hub.csv\"}";
            if (content != null)
            {
                File.WriteAllText(Path.Combine(Folder, "hub.csv"), content);
            }
            Assert.That(() => Load(Scene), Throws.TypeOf<ParameterException>().With.Message.Contains("driveFile")
                .And.Message.Contains("hub.csv").And.Message.Contains(word).And.Message.Not.Contains("\n"));
        }

        [TestCase("time,insertion,rotation\n1,0.02,3\n")]
        [TestCase("\"time\",\"insertion\",\"rotation\"\r\n1,0.02,3\r\n")]
        [TestCase("rotation,time,insertion\n3,1,0.02\n")]
        [TestCase("Time_ms,Insertion_mm,Rotation_deg\n1000,20,171.88733853924697\n")]
        [TestCase("insertion (cm), rotation [rad], time (s)\n2, 3, 1\n")]
        public void HeaderOfADriveFile_SaysWhichColumnIsWhich_AndInWhichUnit(string content)
        {
            File.WriteAllText(Path.Combine(Folder, "hub.csv"), content);
            DriveTable table = Load("{\"solver\": \"direct\", \"drive\": \"displace\", \"proximalEnd\": \"clamped\","
                + " \"driveFile\": \"hub.csv\"}").Values.Simulation.Drive.Table!;
            Assert.That(table.End, Is.EqualTo(1.0));
            Assert.That(table.Insertion.At(1.0), Is.EqualTo(0.02).Within(1e-15));
            Assert.That(table.Rotation.At(1.0), Is.EqualTo(3.0).Within(1e-14));
        }

        [Test]
        public void Note_MayStandInAnyObject_AndChangesNothing()
        {
            const string Wire = "\"solver\": \"direct\", \"wireSections\": [{{{0}\"from\": 0, \"to\": 9}}],"
                + " \"vessel\": {{{0}\"shape\": \"plane\", \"point\": [0, 50, 0], \"normal\": [0, -1, 0]}}";
            ParameterHandler plain = Load("{" + string.Format(Wire, "") + "}");
            ParameterHandler noted = Load("{\"note\": \"why\", "
                + string.Format(Wire, "\"note\": \"here too\", ") + "}");
            Assert.That(noted.Hash, Is.EqualTo(plain.Hash));
            Assert.That(noted.ToJson().ToString(), Is.EqualTo(plain.ToJson().ToString()));
        }

        [Test]
        public void DriveFile_IsReadBesideTheParameterFile_AndWhatItHoldsMakesAnotherRun()
        {
            const string Scene = "{\"solver\": \"direct\", \"drive\": \"displace\", \"proximalEnd\": \"clamped\","
                + " \"driveFile\": \"hub.csv\"}";
            string file = Path.Combine(Folder, "hub.csv");
            File.WriteAllText(file, "# the hub\ntime,insertion,rotation\n# a turn\n0,0,0\n2,0.04,6\n");
            ParameterHandler handler = Load(Scene);
            Assert.That(handler.Values.Simulation.Drive.Table!.Insertion.At(0.5), Is.EqualTo(0.01));
            Assert.That(handler.Values.Simulation.Drive.Table.Rotation.At(3.0), Is.EqualTo(6.0));
            File.WriteAllText(file, "0,0,0\n2,0.04,7\n");
            Assert.That(Load(Scene).Hash, Is.Not.EqualTo(handler.Hash));
        }

        [Test]
        public void SectionShorterThanHalfAnElement_IsWarnedOf()
        {
            const string Wire =
                "{\"solver\": \"direct\", \"wireSections\": [{\"from\": 296.0, \"to\": 300.0%}]}";
            Assert.That(Load(Wire.Replace("%", "")).Warnings, 
                Has.Count.EqualTo(1).And.Some.Contains("wireSections[0]"));
            Assert.That(Load(Wire.Replace("%", ", \"numberRodElements\": 1")).Warnings, Is.Empty);
            Assert.That(Load(Wire.Replace("296", "294").Replace("%", "")).Warnings, Is.Empty);
        }

        [TestCase("299.9, \"to\": 310", "reaches beyond the wire's end at 300")]
        [TestCase("300, \"to\": 310", "from 300 to 310 lies beyond the wire's end")]
        [TestCase("100, \"to\": 100.000000001", "is shorter than rounding, 1e-9 of guidewireLength")]
        [TestCase("100, \"to\": 100.00000000001", "is shorter than rounding, 1e-9 of guidewireLength")]
        public void SectionsThatSayNothingOrLess_AreWarnedOf(string range, string said)
        {
            ParameterHandler handler = Load("{\"solver\": \"direct\", \"numberRodElements\": 30, \"wireSections\":"
                + " [{\"from\": " + range + ", \"density\": 7000}]}");
            Assert.That(handler.Warnings, Has.Some.Contains(said));
            Assert.That(handler.Warnings.Count(line => line.Contains("wireSections[0]")),
                Is.EqualTo(range.StartsWith("299") ? 2 : 1));    // it is also short
        }

        [TestCase("60, \"density\": 7000", "[1] both state density from 50 to 60: there the second applies")]
        [TestCase("60, \"density\": 6000", "")]
        [TestCase("50, \"density\": 7000", "")]
        [TestCase("60, \"wireRadius\": 3e-4", "")]
        public void SectionsThatOverlap_AreWarnedOfWhereTheyDisagree(string first, string said)
        {
            ParameterHandler handler = Load("{\"solver\": \"direct\", \"numberRodElements\": 30, \"wireSections\":"
                + " [{\"from\": 0, \"to\": " + first + "}, {\"from\": 50, \"to\": 90, \"density\": 6000}]}");
            Assert.That(handler.Warnings, said.Length == 0 ? Is.Empty : Has.Count.EqualTo(1).And.Some.Contains(said));
        }

        // E > 3 G: nu above 0.5.
        [TestCase("\"youngsModulus\": 200e9", "the wire has a Poisson's ratio E/(2 G) - 1 of 3.35")]
        [TestCase("\"youngsModulus\": 30e9, \"shearModulus\": 10e9", "")]
        [TestCase("\"youngsModulus\": 31e9, \"shearModulus\": 10e9", "of 0.55")]
        [TestCase("\"youngsModulus\": 1, \"shearModulus\": 10e9", "")]
        [TestCase("\"wireSections\": [{\"from\": 0, \"to\": 100, \"shearModulus\": 1e9}],"
            + " \"youngsModulus\": 60e9", "wireSections[0] has a Poisson's ratio E/(2 G) - 1 of 29")]
        [TestCase("\"bendingStiffness\": 1e-3, \"torsionalStiffness\": 1e-5", "")]
        public void ModuliThatNoIsotropicMaterialHas_AreWarnedOf(string moduli, string said)
        {
            ParameterHandler handler = Load("{\"solver\": \"direct\", " + moduli + "}");
            Assert.That(handler.Warnings, said.Length == 0 ? Is.Empty : Has.Count.EqualTo(1).And.Some.Contains(said));
        }

        [Test]
        public void Table_NamesEachKeyOnce_WithHelpAndADefaultThatIsAllowed()
        {
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                Assert.That(entry.Help, Is.Not.Empty, entry.Key);
                Assert.That(entry.Allowed, Is.Not.Empty, entry.Key);
                Assert.That(ParameterTable.Find(entry.Key), Is.SameAs(entry));
                foreach (Solver method in entry.Methods)
                {
                    string text = entry.Key == "solver" ? "{\"solver\": " + entry.Default(method) + "}"
                        : "{\"solver\": \"" + method.ToString().ToLowerInvariant() + "\", \"" + entry.Key + "\": "
                        + entry.Default(method) + "}";
                    Assert.That(Load(text).Ignored, Is.Empty, entry.Key);
                }
            }
        }

        private ParameterHandler Load(string text, params (string Key, string Value)[] overrides)
        {
            string file = Path.Combine(Folder, "wire.json");
            File.WriteAllText(file, text);
            return ParameterHandler.Load(file, GivenKeys.Of(overrides, value => new JValue(value)));
        }
    }
}
