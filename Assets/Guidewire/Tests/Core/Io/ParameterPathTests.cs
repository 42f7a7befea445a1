using System.IO;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Parts of what keys hold: how they are laid over a file, and what is said of those that cannot be.
    /// </summary>
    public sealed class ParameterPathTests : FolderTests
    {
        private const string Scene = "{\"solver\": \"direct\", \"guidewireLength\": 100, \"numberRodElements\": 10,"
            + " \"proximalEnd\": \"clamped\", \"wireSections\": [{\"from\": 60, \"to\": 80}, {\"from\": 80, \"to\":"
            + " 100, \"youngsModulus\": 6e9}], \"vessel\": {\"shape\": \"tube\", \"knots\": [[0, 0, -40], [0, 0, 200]],"
            + " \"radius\": 3}, \"obstacles\": [{\"shape\": \"sphere\", \"centre\": [0, 50, 50], \"radius\": 2}]}";

        private string SceneFile => Path.Combine(Folder, "scene.json");

        [SetUp]
        public void WriteScene() => File.WriteAllText(SceneFile, Scene);

        [TestCase("vessel.radius", "2.5", "vessel.radius")]
        [TestCase("vessel.frictionCoefficient", "0.2", "vessel.frictionCoefficient")]
        [TestCase("vessel.knots[1][2]", "210", "vessel.knots[1][2]")]
        [TestCase("obstacles[0].radius", "1.5", "obstacles[0].radius")]
        [TestCase("obstacles[-1]", "{\"shape\":\"sphere\",\"centre\":[0,60,0],\"radius\":1}", "obstacles[0]")]
        [TestCase("wireSections[-1].youngsModulus", "7000000000.0", "wireSections[1].youngsModulus")]
        [TestCase("wireSections[-2].wireRadius", "0.0002", "wireSections[0].wireRadius")]
        [TestCase("gravity[1]", "-9.81", "gravity[1]")]
        public void Part_StandsInTheEffectiveValues_AndNothingElseChanges(string path, string value, string place)
        {
            JObject before = Load().ToJson();
            JObject after = Load((path, value)).ToJson();
            JToken there = after.SelectToken(place)!;
            Assert.That(JToken.DeepEquals(there, JToken.Parse(value)), there.ToString());
            JToken? old = before.SelectToken(place);
            if (old == null)
            {
                there.Parent!.Remove();
            }
            else
            {
                there.Replace(old.DeepClone());
            }
            Assert.That(JToken.DeepEquals(after, before));
        }

        [Test]
        public void Part_CountsOverItsWhole_WhereverTheTwoStand()
        {
            const string wide = "{\"shape\":\"tube\",\"knots\":[[0,0,-40],[0,0,200]],\"radius\":9}";
            foreach ((string, string)[] given in new[]
            {
                new[] { ("vessel.radius", "4"), ("vessel", wide) },
                new[] { ("vessel", wide), ("vessel.radius", "4") },
            })
            {
                Assert.That((double)Load(given).ToJson()["vessel"]!["radius"]!, Is.EqualTo(4.0));
            }
        }

        [Test]
        public void FrictionOfAPart_ReachesTheWall()
        {
            RunParameters values = Load(("vessel.frictionCoefficient", "0.15")).Values;
            Assert.That(values.Simulation.Scene.Walls[0].FrictionCoefficient, Is.EqualTo(0.15));
        }

        [TestCase("vesel.radius", "3", "unknown key 'vesel.radius': did you mean 'vessel.radius'?")]
        [TestCase("vessel.colour", "3",
            "unknown key 'vessel.colour': allowed are shape, frictionCoefficient, motion, knots")]
        [TestCase("vessel.frictionCoefficient", "-1", "vessel.frictionCoefficient = -1 is not allowed: needs a number")]
        [TestCase("vessel.radius[0]", "3", "vessel.radius[0] does not exist: vessel.radius is one value without parts")]
        [TestCase("obstacles[3].radius", "3", "obstacles is a list of 1, obstacles[0]")]
        [TestCase("obstacles[-2].radius", "3", "obstacles is a list of 1, obstacles[0]")]
        [TestCase("sheath.exit", "[0,0,0]", "sheath is null")]
        [TestCase("timeStep.x", "3", "timeStep is one value without parts")]
        [TestCase("gravity[3]", "3", "gravity is a list of 3, gravity[0] to gravity[2]")]
        [TestCase("gravity[1]", "\"a\"", "gravity[1] = \"a\" is not allowed: needs three numbers")]
        [TestCase("wireSections[-1].youngsModulus", "-3", "wireSections[1].youngsModulus = -3 is not allowed: needs a")]
        [TestCase("wireSections[0].colour", "3", "unknown key 'wireSections[0].colour': allowed are from, to, ")]
        [TestCase("wireSections[0].from", "90", "wireSections[0].from = 90 is not allowed: needs")]
        [TestCase("vessel.", "3", "unknown key 'vessel.'")]
        [TestCase("vessel[", "3", "unknown key 'vessel['")]
        [TestCase("vessel]x", "3", "unknown key 'vessel]x'")]
        [TestCase("obstacles[1.5]", "3", "unknown key 'obstacles[1.5]'")]
        [TestCase("vessel..radius", "3", "unknown key 'vessel..radius'")]
        public void PartThatCannotBe_IsRefusedInALineThatNamesIt(string path, string value, string said) =>
            Assert.That(Refusal.Of(() => Load((path, value))), Does.StartWith("command line: ").And.Contains(said));

        [Test]
        public void WhatTheFileSays_IsTheFilesFault_BesideAPartOfTheCommandLine()
        {
            File.WriteAllText(SceneFile, Scene.Replace("\"radius\": 2}", "\"radius\": 2, \"colour\": 1}"));
            Assert.That(() => Load(("vessel.radius", "2.5")), Throws.TypeOf<ParameterException>().With.Message
                .StartsWith(SceneFile + ": unknown key 'obstacles[0].colour'"));
        }

        [Test]
        public void MethodThatDoesNotTakeAKey_RefusesAPartOfItFromTheCommandLine()
        {
            Assert.That(() => Load(("solver", "\"pbd\""), ("wireSections[0].density", "7000")),
                Throws.TypeOf<ParameterException>().With.Message.Contains(
                    "wireSections[0].density = 7000 is not allowed: needs solver xpbd, direct or explicit"));
        }

        [TestCase("-vessel.radius", "2.5")]
        [TestCase("--wireSections[-1].youngsModulus", "1e9")]
        [TestCase("-vessel.file", "arch.obj")]
        public void CommandLine_TakesPartsAsJsonAndElseAsTexts(string argument, string value)
        {
            CommandLine line = CommandLineHandler.Read(new[] { argument, value }, logFileIsOurs: true);
            Assert.That(line.Overrides[0].Key, Is.EqualTo(argument.TrimStart(new[] { '-' })));
            Assert.That(line.Overrides[0].Value.Type,
                Is.EqualTo(value.EndsWith("obj") ? JTokenType.String : JTokenType.Float));
        }

        private ParameterHandler Load(params (string Key, string Value)[] given) =>
            ParameterHandler.Load(SceneFile, GivenKeys.Of(given, JToken.Parse));
    }
}
