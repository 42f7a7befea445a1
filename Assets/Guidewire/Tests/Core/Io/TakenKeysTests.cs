using System;
using System.Collections.Generic;
using System.IO;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Every key either counts or is said not to: for each method, each key of the table.</summary>
    public sealed class TakenKeysTests : FolderTests
    {
        private string Scene => Path.Combine(Folder, "scene.json");

        [Test]
        public void KeyThatTheMethodDoesNotTake_IsRefusedOnTheCommandLine([Values] Solver method)
        {
            int refused = 0;
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                if (entry.IsTakenBy(method))
                {
                    continue;
                }
                refused++;
                var given = new Dictionary<string, JToken>
                {
                    ["solver"] = Word(method), [entry.Key] = entry.Write(new RunParameters(entry.Methods[0])),
                };
                Assert.That(() => ParameterHandler.Load(null, given), Throws.TypeOf<ParameterException>()
                    .With.Message.StartsWith("command line: " + entry.Key).And.Message.Contains(Word(method)));
            }
            Assert.That(refused, Is.GreaterThan(5));
        }

        [Test]
        public void KeyThatTheMethodDoesNotTake_IsPassedOverInAFile_AndNamedInOneLine([Values] Solver method)
        {
            var file = new JObject { ["solver"] = Word(method) };
            var expected = new List<string>();
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                if (!entry.IsTakenBy(method))
                {
                    file[entry.Key] = entry.Write(new RunParameters(entry.Methods[0]));
                    expected.Add(entry.Key);
                }
            }
            ParameterHandler handler = Load(file);
            Assert.That(handler.Ignored, Is.EqualTo(expected));
            Assert.That(handler.Warnings, Has.Count.EqualTo(1));
            Assert.That(handler.Hash, Is.EqualTo(Load(new JObject { ["solver"] = Word(method) }).Hash),
                "what is passed over makes no other run");
        }

        [Test]
        public void ParametersOfARun_HoldWhatItsMethodTakes_AndRepeatIt([Values] Solver method)
        {
            ParameterHandler handler = Load(new JObject { ["solver"] = Word(method), ["timeStep"] = 0.003 });
            JObject written = handler.ToJson();
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                Assert.That(written.ContainsKey(entry.Key), Is.EqualTo(entry.IsTakenBy(method)), entry.Key);
            }
            ParameterHandler again = Load(written);
            Assert.That(again.Hash, Is.EqualTo(handler.Hash));
            Assert.That(again.Warnings, Is.Empty);
        }

        [TestCase("explicit", "vessel", "{\"shape\": \"plane\", \"normal\": [0, 1, 0]}")]
        [TestCase("explicit", "obstacles", "[{\"shape\": \"sphere\", \"centre\": [0, 9, 0], \"radius\": 1}]")]
        [TestCase("xpbd", "tipMoment", "[0.001, 0, 0]")]
        [TestCase("pbd", "tipMoment", "[0.001, 0, 0]")]
        public void WallOrCoupleThatTheMethodDoesNotHave_IsRefusedInAFileToo(string method, string key, string value)
        {
            var file = new JObject { ["solver"] = method, [key] = JToken.Parse(value) };
            Assert.That(() => Load(file), Throws.TypeOf<ParameterException>()
                .With.Message.Contains(key).And.Message.Contains("needs solver"));
        }

        [Test]
        public void NoWallAtAll_IsPassedOver()
        {
            var file = new JObject { ["solver"] = "explicit", ["vessel"] = null, ["tipMoment"] = new JArray(0, 0, 0) };
            Assert.That(Load(file).Ignored, Is.EqualTo(new[] { "vessel" }), "explicit takes a couple");
        }

        [Test]
        public void Core_RefusesWallsWhereTheMethodHasNone_WhoeverBuildsIt()
        {
            SimulationParameters parameters = SimulationParameters.DefaultsOf(Solver.Explicit);
            parameters.Scene.Walls = new ContactShape[] { new PlaneShape(new Vector3d(0, -9, 0), Vector3d.UnitY) };
            Assert.That(() => Simulation.Create(parameters),
                Throws.TypeOf<ArgumentException>().With.Message.StartsWith("vessel"));
        }

        [Test]
        public void DefaultsOfAMethod_AreThoseThatItsTextNames([Values] Solver method)
        {
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                if (entry.IsTakenBy(method) && entry.Key != "solver")
                {
                    Assert.That(entry.Defaults, Does.Contain(entry.Default(method)), entry.Key);
                }
            }
        }

        private ParameterHandler Load(JObject file)
        {
            File.WriteAllText(Scene, file.ToString());
            return ParameterHandler.Load(Scene, new Dictionary<string, JToken>());
        }

        private static string Word(Solver method) => method.ToString().ToLowerInvariant();
    }
}
