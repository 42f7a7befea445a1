using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Every key of the table, changed while a run goes on, with every method.</summary>
    public sealed class LiveKeyTests : FolderTests
    {
        private const int Steps = 2;               // before, between and after the changes
        private static readonly int RandomChanges = Rods.InFull ? 40 : 8;
        private const int MinChanged = 35;       // keys of a scene; the others need more than one change, or refuse

        private const string Tube = "\"vessel\": {\"shape\": \"tube\", \"knots\": [[0, 0, -400], [0, 0, 400]],"
            + " \"radius\": 12, \"frictionCoefficient\": 0.2}";

        // Of the others a value is found by trying.
        private static readonly Dictionary<string, string> Structured = new Dictionary<string, string>
        {
            ["vessel"] = Tube.Substring(Tube.IndexOf('{')),
            ["obstacles"] = "[{\"shape\": \"sphere\", \"centre\": [0, 100, 0], \"radius\": 3}]",
            ["wireSections"] = "[{\"from\": 5, \"to\": 9, \"youngsModulus\": 1e9}]",
            ["loadTables"] = "{\"gravity\": \"FOLDER/table.csv\"}",
            ["innerRadius"] = "1e-4",
            ["driveFile"] = "\"FOLDER/drive.csv\"",
        };

        // The wire, or how it began, would be another one.
        private static readonly string[] OfTheStart = { "numberRodElements", "startFile", "sheath" };

        [SetUp]
        public void Make()
        {
            File.WriteAllText(Path.Combine(Folder, "table.csv"), "time,factor\n0,1\n10,2\n");
            File.WriteAllText(Path.Combine(Folder, "drive.csv"), "time,insertion,rotation\n0,0,0\n10,0.001,0.1\n");
        }

        private static IEnumerable<TestCaseData> Scenes()
        {
            const string Clamped = "\"proximalEnd\": \"clamped\", \"timeStep\": 1e-3, ";
            yield return Scene("pbd", "\"gravity\": [0, -9.81, 0]");
            yield return Scene("pbd", "\"integrator\": \"orientationVerlet\", \"distalEnd\": \"clamped\","
                + " \"distalRotation\": 0.3, \"distalRampTime\": 1");
            yield return Scene("pbd", "\"sphereRadius\": 1, \"drive\": \"push\", \"displacementPerStep\": 0.1, "
                + Tube);
            foreach (string solver in new[] { "xpbd", "explicit", "direct" })
            {
                string substeps = solver == "direct" ? "" : ", \"substeps\": 20";
                yield return Scene(solver, "\"gravity\": [0, -9.81, 0], \"timeStep\": 1e-5" + substeps);
                yield return Scene(solver, Clamped + "\"distalEnd\": \"clamped\", \"distalRotation\": 0.3,"
                    + " \"distalRampTime\": 0.01, \"massDamping\": 2" + substeps);
            }
            foreach (Integrator scheme in MethodTable.Of(Solver.Direct).Integrators)
            {
                yield return Scene("direct", Clamped + "\"gravity\": [0, -9.81, 0], \"massDamping\": 2,"
                    + " \"materialDamping\": 1e-4, \"integrator\": \"" + Kinds.Word(scheme.ToString())
                    + "\"");
            }
            foreach (string solver in new[] { "xpbd", "direct" })
            {
                yield return Scene(solver, Clamped + "\"gravity\": [0, -9.81, 0], \"drive\": \"displace\","
                    + " \"insertionSpeed\": 0.01, " + Tube);
                yield return Scene(solver, Clamped + "\"drive\": \"displace\", \"massDamping\": 1");
            }
            yield return Scene("direct", Clamped + "\"drive\": \"displace\", \"insertionSpeed\": 0.01,"
                + " \"maxSimulationSteps\": 1000, \"sheath\": {\"exit\": [0, 0, -95]}, " + Tube);
        }

        // A wire that is pressed against a wall in its sheath takes seconds a step.
        private static IEnumerable<TestCaseData> QuickScenes() =>
            Scenes().Where(scene => !((string)scene.Arguments[1]!).Contains("sheath"));

        private static TestCaseData Scene(string solver, string keys)
        {
            string steps = keys.Contains("maxSimulationSteps") ? "" : "\"maxSimulationSteps\": 1000000, ";
            string scene = "{\"solver\": \"" + solver + "\", \"numberRodElements\": 6, \"guidewireLength\": 60,"
                + " \"deltaThreshold\": 0, " + steps + keys + "}";
            return new TestCaseData(solver, scene);
        }

        private static Solver TakerOf(string solver) => (Solver)Enum.Parse(typeof(Solver), solver, true);

        private SimulationSession Open(string scene)
        {
            string file = Path.Combine(Folder, "scene.json");
            File.WriteAllText(file, scene);
            return SimulationSession.Open(file, Array.Empty<string>(), "", false);
        }

        [TestCaseSource(nameof(Scenes))]
        public void EveryKey_IsChangedAndChangedBack_WhileTheRunGoesOn(string solver, string scene)
        {
            using SimulationSession session = Open(scene);
            var changed = new HashSet<string>();
            Step(session);
            byte[] begun = session.Save();
            foreach (ParameterEntry entry in ParameterTable.Entries.Where(key => key.IsTakenBy(TakerOf(solver))))
            {
                JToken now = entry.FromText(session.Text(entry.Key))!;
                Assert.That(JToken.DeepEquals(now, session.EffectiveParameters[entry.Key]), Is.True, entry.Key);
                foreach (JToken other in Others(entry, now))
                {
                    if (JToken.DeepEquals(other, now) || !TrySet(session, entry.Key, other))
                    {
                        continue;
                    }
                    Assert.That(OfTheStart, Does.Not.Contain(entry.Key), entry.Key + " of a run that has begun");
                    changed.Add(entry.Key);
                    Step(session);
                    Assert.That(TrySet(session, entry.Key, now), Is.True, entry.Key + ", back");
                    Step(session);
                    session.Restore(begun);
                }
            }
            Assert.That(changed, Has.Count.GreaterThanOrEqualTo(MinChanged), string.Join(", ", changed));
        }

        [TestCaseSource(nameof(QuickScenes))]
        public void KeysChangedAtRandom_OneOnTopOfTheOther_LetTheRunGoOn(string solver, string scene)
        {
            ParameterEntry[] keys = ParameterTable.Entries.Where(key => key.IsTakenBy(TakerOf(solver))).ToArray();
            var random = new Random(solver.Length + scene.Length);
            using SimulationSession session = Open(scene);
            int changed = 0;
            for (int k = 0; k < RandomChanges; k++)
            {
                ParameterEntry entry = keys[random.Next(keys.Length)];
                JToken[] others = Others(entry, entry.FromText(session.Text(entry.Key))!).ToArray();
                changed += others.Length > 0 && TrySet(session, entry.Key, others[random.Next(others.Length)]) ? 1 : 0;
                Step(session);
            }
            Assert.That(changed, Is.GreaterThan(RandomChanges / 8));
        }

        // What is refused says so in one line; either way the wire stays where it is.
        private static bool TrySet(SimulationSession session, string key, JToken value)
        {
            var before = (Vector3d[])session.Simulation.State.Positions.Clone();
            try
            {
                session.Set(new[] { new KeyValuePair<string, JToken>(key, value) });
                return true;
            }
            catch (Exception refused) when (refused is ParameterException || refused is ArgumentException)
            {
                Assert.That(refused.Message, Does.Not.Contain("\n"));
                return false;
            }
            finally
            {
                Assert.That(session.Simulation.State.Positions, Is.EqualTo(before), key);
            }
        }

        private static void Step(SimulationSession session)
        {
            for (int k = 0; k < Steps; k++)
            {
                session.Step(0.0, 0.0);
            }
        }

        private IEnumerable<JToken> Others(ParameterEntry entry, JToken now)
        {
            if (entry.Choices.Count > 0)
            {
                return entry.Choices.Select(word => (JToken)word);
            }
            if (Structured.TryGetValue(entry.Key, out string? text))
            {
                JToken other = JToken.Parse(text.Replace("FOLDER", Folder.Replace("\\", "/")));
                return new[] { other, entry.Write(new RunParameters(Solver.Direct)) };
            }
            switch (now.Type)
            {
                case JTokenType.Boolean:
                    return new JToken[] { !(bool)now };
                case JTokenType.Integer:
                    return new JToken[] { (int)now > 4 ? (int)now - 1 : (int)now + 1 };
                case JTokenType.Float:
                    return new JToken[] { (double)now == 0.0 ? 1e-3 : 1.1 * (double)now, 0.0 };
                case JTokenType.Array:
                    return new JToken[] { new JArray(0.1, 0.2, 0.3) };
                default:
                    return Array.Empty<JToken>();
            }
        }
    }
}
