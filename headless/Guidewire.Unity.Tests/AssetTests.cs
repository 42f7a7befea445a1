using System;
using Guidewire.Editor;

namespace Guidewire.Unity.Tests
{
    /// <summary>Instruments and meshes as assets from anywhere in a project, in place of files.</summary>
    public sealed class AssetTests
    {
        [SetUp]
        public void Enter() => Engine.Reset(Stage.Root);

        [TearDown]
        public void Leave() => Engine.Unload();

        private static TextAsset Asset(string name, string file) =>
            new TextAsset(File.ReadAllText(Path.Combine(Stage.Root, file))) { name = name };

        private static SimulationLoop Open(string[] overrides, params TextAsset[] files)
        {
            SimulationLoop loop = new GameObject("Wire").AddComponent<SimulationLoop>();
            loop.Stepping = SteppingMode.Frames;
            loop.Files = files;
            loop.Choose("params/catheter.json", overrides, "", isSteered: true);
            loop.Load();
            return loop;
        }

        [Test]
        public void InstrumentsOfTheList_AreThoseOfAFolder_ByTheirNames()
        {
            SimulationLoop held = Open(new[] { "instrument=Mine", "catheters[0].instrument=My guide" },
                Asset("Mine", "instruments/radifocus-stiff-angled-0.035.json"),
                Asset("My guide", "instruments/catheter-guide-6f.json"));
            Assert.That(held.Problem, Is.Empty);
            SimulationLoop read = Open(new[] { "instrument=radifocus-stiff-angled-0.035",
                "catheters[0].instrument=catheter-guide-6f" });
            Assert.That(read.Problem, Is.Empty);
            foreach (SimulationLoop loop in new[] { held, read })
            {
                loop.Push = 1f;
                loop.Step();
                loop.Step();
            }
            Assert.That(held.State!.Rod.Positions, Is.EqualTo(read.State!.Rod.Positions), "the same bits");
            Assert.That(held.Session!.NameOf(0), Is.EqualTo("Mine"));
            Assert.That(held.Session.ChoicesOf(0), Has.Member("Mine").And.Member("My guide")
                .And.Member("bentson-0.035"));
            Assert.That(held.Session.ChoicesOf(1), Has.Member("My guide").And.No.Member("Mine"));
        }

        [Test]
        public void AnAsset_CountsBeforeAFileOfItsName()
        {
            SimulationLoop loop = Open(Array.Empty<string>(),
                Asset("bentson-0.035", "instruments/radifocus-stiff-angled-0.035.json"));
            double own = loop.Parameters!.Material.YoungsModulus;
            Assert.That(own, Is.Not.EqualTo(Open(Array.Empty<string>()).Parameters!.Material.YoungsModulus));
        }

        [TestCase("instrument=Mine", "Mine.json: needs one JSON object")]
        [TestCase("catheters[0].instrument=Mine", "Mine.json: ")]
        [TestCase("instrument=Mime", "did you mean \"Mine\"?")]
        public void WhatIsWrong_IsOneLine_WithTheNameOfTheAsset(string given, string words)
        {
            string problem = Open(new[] { given }, new TextAsset("[1]") { name = "Mine" }).Problem;
            Assert.That(problem, Does.Contain(words).And.Not.Contain("\n").And.Not.Contain("internal error"));
        }

        [Test]
        public void AnEmptyEntry_AndOneNameTwice_AreRefused()
        {
            Assert.That(Open(Array.Empty<string>(), new TextAsset[1]).Problem, Does.Contain("names no asset"));
            TextAsset asset = Asset("Mine", "instruments/bentson-0.035.json");
            Assert.That(Open(Array.Empty<string>(), asset, asset).Problem, Does.Contain("have the name Mine"));
        }

        // As .obj Unity would make a model of it, of which no text is left: it lies there as .obj.txt.
        [TestCase("arch.obj", "")]
        [TestCase("Arch.obj", "no such file")]
        public void AMesh_IsFoundByTheNameOfItsFile(string name, string words)
        {
            SimulationLoop loop = Open(Array.Empty<string>(), Asset(name, "params/meshes/arch.obj"));
            loop.Choose(Asset("wire", "params/insertion-accurate.json"));
            loop.Choose("", new[] { "logHub=false" }, "", isSteered: true);
            loop.Load();
            Assert.That(loop.Problem, words.Length == 0 ? Is.Empty : Does.Contain(words));
        }

        [Test]
        public void TheInspectorAsksAnew_WhereTheTextOfAnAssetIsAnother()
        {
            SimulationLoop loop = Open(Array.Empty<string>(), new TextAsset("{}") { name = "Mine" });
            string before = loop.OpeningKey;
            loop.Files = new[] { new TextAsset("{ }") { name = "Mine" } };
            Assert.That(loop.OpeningKey, Is.Not.EqualTo(before));
        }

        [Test]
        public void TheMenusInstrument_IsTaken()
        {
            EditorTests.Call(EditorTests.Menu, "CreateInstrument");
            string text = UnityEditor.ProjectWindowUtil.Last!.Value.Content;
            SimulationLoop loop = Open(new[] { "instrument=Instrument" }, new TextAsset(text) { name = "Instrument" });
            Assert.That(loop.Problem, Is.Empty);
            Assert.That(loop.Session!.TitleOf(0), Is.EqualTo("Instrument"));
        }
    }
}
