using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text;
using System.Threading;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    [Category("Target")]
    public sealed class SimulationRunTests : FolderTests
    {
        private string Results => Path.Combine(Folder, "run");

        [Test]
        public void Log_HoldsEveryStateRoundTripExact()
        {
            ParameterHandler handler = Load(("maxSimulationSteps", 7), ("constraintSolverSteps", 20),
                ("displacementDirection", new JArray(1.0, 2.0, 3.0)));
            new SimulationRun(handler, Results, null).Execute(Existing.Replace);
            JObject log = Read("positions.json");
            Simulation again = Simulation.Create(handler.Values.Simulation);
            Assert.That(log.Count, Is.EqualTo(8));
            for (int step = 0; step <= 7; step++)
            {
                JToken entry = log[step.ToString(CultureInfo.InvariantCulture)]!;
                Assert.That((double)entry["totalTime"]!, Is.EqualTo(step * 0.01).Within(1e-15));
                Assert.That((double)entry["delta"]!, Is.EqualTo(again.PredictionError));
                for (int i = 0; i <= 30; i++)
                {
                    JToken sphere = entry["sphere"]![i.ToString(CultureInfo.InvariantCulture)]!;
                    Assert.That((double)sphere["x"]!, Is.EqualTo(again.State.Positions[i].X));
                    Assert.That((double)sphere["z"]!, Is.EqualTo(again.State.Positions[i].Z));
                    Assert.That((double)sphere["vy"]!, Is.EqualTo(again.State.Velocities[i].Y));
                }
                again.Step();
            }
        }

        [Test]
        public void Log_IsWrittenWithPoints_WhateverTheCulture()
        {
            CultureInfo before = Thread.CurrentThread.CurrentCulture;
            var commas = (CultureInfo)CultureInfo.InvariantCulture.Clone();
            commas.NumberFormat.NumberDecimalSeparator = ",";
            Thread.CurrentThread.CurrentCulture = commas;
            try
            {
                new SimulationRun(Load(("maxSimulationSteps", 2)), Results, null).Execute(Existing.Replace);
            }
            finally
            {
                Thread.CurrentThread.CurrentCulture = before;
            }
            Assert.That((double)Read("positions.json")["1"]!["totalTime"]!, Is.EqualTo(0.01));
        }

        [Test]
        public void ThinnedLog_KeepsEveryKthStepAndTheLast()
        {
            new SimulationRun(Load(("maxSimulationSteps", 10), ("logEvery", 4), ("logSpheres", "last"),
                ("logOrientations", true)), Results, null).Execute(Existing.Replace);
            JObject log = Read("positions.json");
            Assert.That(((IDictionary<string, JToken?>)log).Keys, Is.EqualTo(new[] { "0", "4", "8", "10" }));
            Assert.That(((JObject)log["8"]!["sphere"]!).Properties().Single().Name, Is.EqualTo("30"));
            Assert.That(((JObject)log["8"]!["orientation"]!).Count, Is.EqualTo(30));
        }

        [Test]
        public void Summary_SaysWhatBecameOfTheRun()
        {
            RunResult result = new SimulationRun(Load(("maxSimulationSteps", 5)), Results, 2).Execute(Existing.Replace);
            JObject summary = Read("summary.json");
            Assert.That(result.Outcome, Is.EqualTo(Outcome.Finished));
            Assert.That((string?)summary["outcome"], Is.EqualTo("finished"));
            Assert.That((int)summary["steps"]!, Is.EqualTo(5));
            Assert.That((double)summary["inGameTime"]!, Is.EqualTo(0.05).Within(1e-15));
            Assert.That((bool)summary["timed"]!, Is.True);
            Assert.That((int)summary["repeat"]!, Is.EqualTo(2));
            Assert.That((double)summary["medianStepTime"]!, Is.GreaterThan(0.0));
            Assert.That((bool)summary["complete"]!, Is.True);
            Assert.That(Directory.GetFiles(Results, "*.partial"), Is.Empty);
        }

        [Test]
        public void StopRequest_EndsTheRunWithAWholeLog()
        {
            int asked = 0;
            var run = new SimulationRun(Load(("constraintSolverSteps", 1)), Results, null)
                { StopRequested = () => ++asked > 4 };
            Assert.That(run.Execute(Existing.Replace).Outcome, Is.EqualTo(Outcome.Interrupted));
            Assert.That(Read("positions.json").Count, Is.EqualTo(5), "entries 0 to 4");
            Assert.That((string?)Read("summary.json")["outcome"], Is.EqualTo("interrupted"));
        }

        [Test]
        public void EarlierResult_StandsIn_OnlyForTheSameParametersAndRepeat()
        {
            ParameterHandler handler = Load(("maxSimulationSteps", 3));
            new SimulationRun(handler, Results, null).Execute(Existing.Replace);
            Assert.That(IsReused(handler, null), Is.True);
            Assert.That(IsReused(handler, 0), Is.False, "timed and untimed");
            Assert.That(IsReused(handler, 1), Is.False, "another repeat");
            Assert.That(IsReused(Load(("maxSimulationSteps", 4)), 1), Is.False);
            File.Delete(Path.Combine(Results, "positions.json"));
            Assert.That(IsReused(handler, null), Is.False, "its log is gone");
        }

        // On a floor on which it slips, so that no two of its numbers are the same.
        [Test]
        public void NumbersOfTheSummary_AreThoseOfTheirNames()
        {
            Simulation simulation = RunOnAFloor(0.3);
            JObject summary = Read("summary.json");
            ContactRecord contacts = simulation.Contacts!;
            Assert.That((double)summary["largestContactForce"]!,
                Is.EqualTo(contacts.LargestForce).And.GreaterThan(0.0));
            Assert.That((double)summary["largestWallForce"]!,
                Is.EqualTo(contacts.LargestTotal).And.GreaterThan(contacts.LargestForce));
            Assert.That((double)summary["driveShortfall"]!, Is.EqualTo(contacts.DriveShortfall).And.GreaterThan(0.0));
            RunExtremes extremes = simulation.Report()!.Extremes!;
            Assert.That(extremes.AxialTorqueTime, Is.Not.EqualTo(extremes.AxialForceTime));
            Assert.That(CountEqual((JObject)summary["extremes"]!, extremes), Is.GreaterThan(15));
            Assert.That(CountEqual((JObject)summary["hub"]!, simulation.Hub()!), Is.GreaterThan(5));
        }

        [Test]
        public void Log_HasTheForceOfEveryNodeThatIsTouched([Values(0.0, 0.3)] double friction)
        {
            Vector3d[] forces = RunOnAFloor(friction).Contacts!.Forces;
            JToken logged = Read("positions.json")["12"]!["contact"]!["sphere"]!;
            Assert.That(logged.Count(), Is.EqualTo(forces.Count(force => force != Vector3d.Zero)).And.GreaterThan(1));
            foreach (JProperty one in logged)
            {
                Vector3d force = forces[int.Parse(one.Name, CultureInfo.InvariantCulture)];
                Assert.That(new Vector3d((double)one.Value["x"]!, (double)one.Value["y"]!, (double)one.Value["z"]!),
                    Is.EqualTo(force));
            }
        }

        private Simulation RunOnAFloor(double friction)
        {
            Simulation? simulation = null;
            new SimulationRun(Load(("solver", "direct"), ("guidewireLength", 100.0), ("numberRodElements", 20),
                ("guidewireOffset", 0.0), ("wireRadius", 0.0005), ("gravity", new JArray(0.0, -9.81, 0.0)),
                ("vessel", new JObject
                {
                    ["shape"] = "plane", ["point"] = new JArray(0.0, -0.52, 0.0),
                    ["normal"] = new JArray(0.0, 1.0, 0.0), ["frictionCoefficient"] = friction,
                }),
                ("proximalEnd", "clamped"), ("drive", "displace"), ("insertionSpeed", 0.02), ("rotationSpeed", -3.0),
                ("hubForceLimit", 1e-4), ("timeStep", 0.01), ("deltaThreshold", 0.0), ("logContacts", true),
                ("maxSimulationSteps", 12)), Results, null)
                { Progress = (run, elapsed) => simulation = run }.Execute(Existing.Replace);
            return simulation!;
        }

        // Numbers that a property of the name has, in an object of the summary.
        private static int CountEqual(JObject summary, object record)
        {
            int count = 0;
            foreach (JProperty one in summary.Properties())
            {
                string name = one.Name.Substring(0, 1).ToUpperInvariant() + one.Name.Substring(1);
                if (record.GetType().GetProperty(name)?.GetValue(record) is double number)
                {
                    Assert.That((double?)one.Value, double.IsNaN(number) ? Is.Null : Is.EqualTo(number), name);
                    count++;
                }
            }
            return count;
        }

        [Test]
        public void EachCatheter_HasItsOwnNumbers_AndArraysOfStepsAreWhole()
        {
            static JObject Catheter(double start, double outer, double inner, double speed) => new JObject
            {
                ["start"] = start, ["length"] = 60.0 - start, ["elements"] = 6, ["wireRadius"] = outer,
                ["lumenRadius"] = inner, ["insertionSpeed"] = speed,
            };
            Simulation? simulation = null;
            new SimulationRun(Load(("solver", "direct"), ("guidewireLength", 80.0), ("numberRodElements", 16),
                ("guidewireOffset", 0.0), ("wireRadius", 0.0003), ("proximalEnd", "clamped"), ("drive", "displace"),
                ("catheters", new JArray(Catheter(20.0, 0.0014, 0.001, 0.01), Catheter(10.0, 0.0008, 0.0005, 0.02))),
                ("insertionSpeed", 0.03), ("timeStep", 0.01), ("deltaThreshold", 0.0), ("logFormat", "npz"),
                ("massDamping", 20.0), ("maxSimulationSteps", 2)), Results, null)
                { Progress = (run, elapsed) => simulation = run }.Execute(Existing.Replace);
            for (int k = 0; k < 2; k++)
            {
                CoaxialRecord record = simulation!.Catheters()[k];
                Assert.That(record.Insertion, Is.EqualTo((k + 1) * 0.01 * 0.02).Within(1e-12));
                Assert.That(CountEqual((JObject)Read("summary.json")["catheters"]![k]!, record), Is.GreaterThan(3));
            }
            // Stored without compression: the array's numbers stand behind its name and its head of 128 bytes.
            Encoding bytes = Encoding.GetEncoding("ISO-8859-1");
            string log = bytes.GetString(File.ReadAllBytes(Path.Combine(Results, "positions.npz")));
            int at = log.IndexOf("step.npy", System.StringComparison.Ordinal) + "step.npy".Length + 128;
            Assert.That(log.Substring(at, 3 * sizeof(long)), Is.EqualTo(bytes.GetString(
                new[] { 0L, 1L, 2L }.SelectMany(System.BitConverter.GetBytes).ToArray())));
        }

        [Test]
        public void TwoRunsIntoOneFolder_AreRefused()
        {
            RunResult? inner = null;
            ParameterException? refused = null;
            var run = new SimulationRun(Load(("maxSimulationSteps", 2)), Results, null)
            {
                Progress = (simulation, elapsed) =>
                {
                    try
                    {
                        inner = new SimulationRun(Load(("maxSimulationSteps", 1)), Results, null)
                            .Execute(Existing.Replace);
                    }
                    catch (ParameterException error)
                    {
                        refused = error;
                    }
                },
            };
            run.Execute(Existing.Replace);
            Assert.That(inner, Is.Null);
            Assert.That(refused!.Message, Does.Contain("no other run is writing"));
        }

        [Test]
        public void StepTimes_FindTheMedianWithinHalfAPercent()
        {
            var times = new StepTimes();
            for (int k = 1; k <= 999; k++)
            {
                times.Add(0.01 * k);
            }
            Assert.That(times.Median(), Is.EqualTo(5.0).Within(0.5).Percent);
            Assert.That(times.Average, Is.EqualTo(5.0).Within(1e-9));
        }

        [Test]
        public void EarlierResult_IsKept_FromOtherParametersAndFromARunThatIsStopped()
        {
            ParameterHandler other = Load(("maxSimulationSteps", 9));
            new SimulationRun(Load(("maxSimulationSteps", 3)), Results, null).Execute(Existing.Keep);
            Assert.That(() => new SimulationRun(other, Results, null).Execute(Existing.Keep),
                Throws.TypeOf<ParameterException>().With.Message.Contains("maxSimulationSteps is 3 there and 9 here"));
            var stopped = new SimulationRun(other, Results, null) { StopRequested = () => true };
            RunResult result = stopped.Execute(Existing.Replace);
            Assert.That((result.Outcome, result.KeptPreviousRun), Is.EqualTo((Outcome.Interrupted, true)));
            Assert.That((int)Read("summary.json")["steps"]!, Is.EqualTo(3));
            Assert.That(new SimulationRun(other, Results, null).Execute(Existing.Replace).KeptPreviousRun, Is.False);
            Assert.That((int)Read("summary.json")["steps"]!, Is.EqualTo(9));
            Assert.That(Directory.GetFiles(Results), Has.Length.EqualTo(3));
        }

        [Test]
        public void RunThatFailed_DoesNotTakeTheEarlierOnesPlace()
        {
            new SimulationRun(Load(("maxSimulationSteps", 3)), Results, null).Execute(Existing.Keep);
            ParameterHandler hopeless = Load(("solver", "direct"), ("proximalEnd", "clamped"),
                ("initialState", "equilibrium"), ("maxNewtonIterations", 1), ("tipForce", new JArray(0.0, 100.0, 0.0)));
            RunResult result = new SimulationRun(hopeless, Results, null).Execute(Existing.Replace);
            Assert.That(result.Outcome, Is.EqualTo(Outcome.Failed));
            Assert.That((string?)Read("summary.json")["outcome"], Is.EqualTo("finished"));
        }

        [Test]
        public void Address_TellsRunsApart_ByParametersButNotByPaths()
        {
            string address = RunSummary.Address(Load(("maxSimulationSteps", 3)));
            Assert.That(address, Does.Match("^[0-9a-f]{32}$"));
            Assert.That(RunSummary.Address(Load(("maxSimulationSteps", 3), ("logFilePath", "x"))), Is.EqualTo(address));
            Assert.That(RunSummary.Address(Load(("maxSimulationSteps", 4))), Is.Not.EqualTo(address));
        }

        [Test]
        public void RunWithoutALog_HasTheSameResult_AndTakesAnEarlierLogAway()
        {
            ParameterHandler handler = Load(("maxSimulationSteps", 3));
            new SimulationRun(handler, Results, null).Execute(Existing.Replace);
            JObject logged = Read("summary.json");
            new SimulationRun(handler, Results, null) { KeepsLog = false }.Execute(Existing.Replace);
            JObject summary = Read("summary.json");
            Assert.That(Directory.GetFiles(Results), Has.Length.EqualTo(1), "the summary");
            Assert.That(summary["log"]!.Type, Is.EqualTo(JTokenType.Null));
            Assert.That(summary["predictionError"], Is.EqualTo(logged["predictionError"]));
            Assert.That(new SimulationRun(handler, Results, null).Execute(Existing.Keep).Reused, Is.True);
        }

        private bool IsReused(ParameterHandler handler, int? repeat)
        {
            try
            {
                return new SimulationRun(handler, Results, repeat).Execute(Existing.Keep).Reused;
            }
            catch (ParameterException)
            {
                return false;    // another run is there
            }
        }

        private JObject Read(string name) => JObject.Parse(File.ReadAllText(Path.Combine(Results, name)));

        private static ParameterHandler Load(params (string Key, JToken Value)[] overrides) =>
            ParameterHandler.Load(null, GivenKeys.Of(overrides));
    }
}
