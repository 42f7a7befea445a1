using System;
using System.IO;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What a run says of whether its result is to be trusted, and what it logs where it is not.</summary>
    public sealed class ReliableRunTests : FolderTests
    {
        private const string Tube = "\"vessel\": {\"shape\": \"tube\", \"knots\": [[0, 0, -30], [0, 0, 65]],"
            + " \"radius\": 6}, \"guidewireLength\": 60, \"guidewireOffset\": 0, \"numberRodElements\": 6,"
            + " \"deltaThreshold\": 0";

        private (JObject Summary, JObject Log, RunResult Result) Run(string keys)
        {
            string file = Path.Combine(Folder, "wire.json");
            File.WriteAllText(file, "{" + keys + "}");
            ParameterHandler handler = ParameterHandler.Load(file, CommandLineHandler.ReadAssignments(
                Array.Empty<string>()));
            RunResult result = new SimulationRun(handler, Path.Combine(Folder, "out"), null).Execute(Existing.Replace);
            return (Read("summary.json"), Read("positions.json"), result);
        }

        private JObject Read(string name) => JObject.Parse(File.ReadAllText(Path.Combine(Folder, "out", name)));

        [Test]
        public void RunThatDidWhatItWasAskedFor_IsReliable()
        {
            var run = Run("\"displacement\": 0, \"deltaThreshold\": 0, \"maxSimulationSteps\": 5");
            Assert.That((bool)run.Summary["reliable"]!, Is.True);
            Assert.That(run.Result.IsReliable, Is.True);
        }

        [TestCase("\"stretchStiffness\": 0.001, \"displacement\": 30, \"maxSimulationSteps\": 3, \"deltaThreshold\": 0",
            TestName = "A wire of another length is not reliable")]
        [TestCase(Tube + ", \"solver\": \"xpbd\", \"proximalEnd\": \"clamped\", \"substeps\": 1, \"timeStep\": 0.01,"
            + " \"drive\": \"push\", \"insertionSpeed\": 0.1, \"constraintSolverSteps\": 1, \"maxSimulationSteps\": 5,"
            + " \"gravity\": [0, -9.81, 0]", TestName = "Steps that have not converged are not reliable")]
        [TestCase(Tube + ", \"solver\": \"direct\", \"proximalEnd\": \"clamped\", \"drive\": \"displace\","
            + " \"timeStep\": 0.01, \"displacementDirection\": [0, 1, 0], \"displacementPerStep\": 1,"
            + " \"hubForceLimit\": 0.1,"
            + " \"maxSimulationSteps\": 12", TestName = "A drive that falls short is not reliable")]
        public void FinishedWithADoubt(string keys)
        {
            var run = Run(keys);
            Assert.That((string)run.Summary["outcome"]!, Is.EqualTo("finished"), (string)run.Summary["reason"]!);
            Assert.That((bool)run.Summary["reliable"]!, Is.False, run.Summary.ToString());
            Assert.That(((JArray)run.Summary["warnings"]!).Count > 0
                || ((string)run.Summary["reason"]!).Contains(", but "), Is.True);
        }

        [Test]
        public void TipThatLeavesByTheEnd_HasALineWithPlaceAndTime(
            [Values("pbd", "xpbd", "direct")] string solver, [Values(1.0, -1.0)] double sense)
        {
            // The tip is 5 units from the far end and 90 from the near one; 1 unit a step of 0.01 s.
            int steps = sense > 0.0 ? 8 : 94;
            var run = Run(Tube + ", \"solver\": \"" + solver + "\", \"drive\": \"displace\", \"timeStep\": 0.01,"
                + (solver == "pbd" ? " \"sphereRadius\": 0.5," : " \"proximalEnd\": \"clamped\",")
                + " \"displacementDirection\": [0, 0, " + (sense > 0.0 ? "1" : "-1") + "], \"displacementPerStep\": 1,"
                + " \"maxSimulationSteps\": " + steps);
            Assert.That(run.Summary["warnings"]!.ToString(), Does.Contain("the tip left the vessel by an open rim at (")
                .And.Contain("t = 0." + (sense > 0.0 ? "0" : "9")));
            Assert.That((long)run.Summary["passages"]!, Is.Zero);
        }

        [Test]
        public void LastEntryOfALostRun_IsItsLastFiniteState()
        {
            var run = Run("\"stretchStiffness\": 1e200, \"bendStiffness\": 1e200, \"displacementDirection\": [0, 1, 0],"
                + " \"maxSimulationSteps\": 50");
            Assert.That((string)run.Summary["outcome"]!, Is.EqualTo("diverged"));
            Assert.That((string)run.Summary["reason"]!, Does.Contain("no finite"));
            Assert.That(run.Log["0"], Is.Not.Null);
            Assert.That(run.Log.ToString(), Does.Not.Contain("null").And.Not.Contain("NaN"));
            Assert.That(run.Log[(string)run.Summary["steps"]!], Is.Null, "the state that is not finite");
        }
    }
}
