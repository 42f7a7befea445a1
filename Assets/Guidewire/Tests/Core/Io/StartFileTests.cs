using System;
using System.Globalization;
using System.IO;
using System.Linq;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Runs that start from a file.</summary>
    public sealed class StartFileTests : FolderTests
    {
        private const int N = 6;
        private const double L = 60.0;   // units

        // A straight wire along what the turn makes of z; its frames are off it by an angle about x, degrees.
        private static JObject Straight(in Quaterniond turn, double off = 0.0)
        {
            Quaterniond q = turn * Quaterniond.FromAxisAngle(Vector3d.UnitX, off * Math.PI / 180.0);
            Vector3d along = turn.Director3;
            return new JObject
            {
                ["positions"] = new JArray(Enumerable.Range(0, N + 1).Select(i => new JArray(
                    L / N * i * along.X, L / N * i * along.Y, L / N * i * along.Z))),
                ["orientations"] = new JArray(Enumerable.Range(0, N).Select(_ => Numbers(q))),
            };
        }

        private static JArray Numbers(in Quaterniond q) => new JArray(q.X, q.Y, q.Z, q.W);

        private ParameterHandler Load(JObject start, string keys)
        {
            File.WriteAllText(Path.Combine(Folder, "start.json"), start.ToString());
            File.WriteAllText(Path.Combine(Folder, "wire.json"), "{\"numberRodElements\": 6, \"guidewireLength\": 60,"
                + " \"deltaThreshold\": 0, \"startFile\": \"start.json\", " + keys + "}");
            return ParameterHandler.Load(Path.Combine(Folder, "wire.json"), CommandLineHandler.ReadAssignments(
                Array.Empty<string>()));
        }

        [Test]
        public void StraightWire_StaysWhereItStarts_WhateverWayItsClampsLook(
            [Values("direct", "xpbd", "explicit", "pbd")] string solver,
            [Values("free", "clamped", "sliding")] string distalEnd,
            [Values(0.3, 1.5707963267948966, 2.9)] double angle)
        {
            if (distalEnd == "sliding" && solver != "direct")
            {
                Assert.Ignore("only direct lets an end slide");
            }
            Quaterniond turn = Quaterniond.FromAxisAngle(Vector3d.Normalize(new Vector3d(1.0, 2.0, -0.5)), angle);
            SimulationParameters parameters = Load(Straight(turn), "\"solver\": \"" + solver + "\","
                + " \"displacement\": 0, \"proximalEnd\": \"clamped\", \"distalEnd\": \"" + distalEnd + "\","
                + " \"timeStep\": " + (solver == "explicit" ? "1e-7" : "1e-4")).Values.Simulation;
            Simulation simulation = Simulation.Create(parameters);
            var start = (Vector3d[])simulation.State.Positions.Clone();
            for (int k = 0; k < 10; k++)
            {
                simulation.Step();
                simulation = k == 4 ? simulation.Continue(parameters) : simulation;
            }
            Assert.That(Wires.Distance(simulation.State.Positions, start), Is.LessThan(1e-9 * L), simulation.Reason);
        }

        [Test]
        public void SlidingEnd_GoesAlongItsFrame_AlsoAfterTheRunIsContinued()
        {
            // Fed along its own axis, which is none of the world's, the tip slides on that axis and nowhere else.
            Quaterniond turn = Quaterniond.FromAxisAngle(Vector3d.UnitX, 1.0);
            string keys = "\"solver\": \"direct\", \"proximalEnd\": \"clamped\", \"distalEnd\": \"sliding\","
                + " \"timeStep\": 1e-4, \"drive\": \"push\", \"displacementPerStep\": 0.01";
            SimulationParameters parameters = Load(Straight(turn), keys).Values.Simulation;
            Simulation simulation = Simulation.Create(parameters);
            for (int k = 0; k < 20; k++)
            {
                simulation.Step();
                simulation = k % 2 == 0 ? simulation.Continue(parameters)
                    : Simulation.Restore(parameters, simulation.Save());
            }
            Vector3d tip = simulation.State.Positions[N];
            double way = Vector3d.Dot(tip, turn.Director3) - L;
            Assert.That(way, Is.GreaterThan(0.01), "it was fed");
            Assert.That((tip - (L + way) * turn.Director3).Length, Is.LessThan(1e-9 * L));
        }

        [Test]
        public void WireThatMoves_StartsWithTheVelocitiesOfTheFile()
        {
            JObject start = Straight(Quaterniond.Identity);
            start["velocities"] = new JArray(Enumerable.Range(0, N + 1).Select(i => new JArray(0.1 * i, 0.0, 1.0)));
            start["angularVelocities"] = new JArray(Enumerable.Range(0, N).Select(i => new JArray(0.0, 0.2, 3.0 * i)));
            RodState state = Simulation.Create(Load(start, "\"solver\": \"direct\", \"proximalEnd\": \"free\"")
                .Values.Simulation).State;
            for (int i = 0; i < N; i++)
            {
                Assert.That(state.Velocities[i], Is.EqualTo(new Vector3d(0.1 * i, 0.0, 1.0)));
                Assert.That(state.AngularVelocities[i], Is.EqualTo(new Vector3d(0.0, 0.2, 3.0 * i)));
            }
        }

        [Test]
        public void FramesOfTheFile_HoldTheClampsInPlaceOfTheElements([Values("proximal", "distal")] string end)
        {
            const double Angle = 0.1;
            JObject start = Straight(Quaterniond.Identity);
            start[end + "Frame"] = Numbers(Quaterniond.FromAxisAngle(Vector3d.UnitY, Angle));
            SimulationParameters parameters = Load(start, "\"solver\": \"direct\", \"proximalEnd\": \"clamped\","
                + " \"distalEnd\": \"clamped\", \"clampRule\": \"halfElement\"").Values.Simulation;
            Simulation simulation = Simulation.Create(parameters);
            // The joint of half an element is bent by the angle: EI a/(l/2).
            double bend = CrossSection.At(parameters.Material, 0.0).BendStiffness1;
            double couple = bend * Angle / (0.5 * L / N * parameters.Scene.MetresPerUnit);
            SolverReport report = simulation.Report()!;
            double proximal = end == "proximal" ? couple : 0.0;
            Assert.That(report.ProximalMoment!.Value.Y, Is.EqualTo(proximal).Within(1e-9 * couple));
            Assert.That(report.DistalMoment!.Value.Y, Is.EqualTo(couple - proximal).Within(1e-9 * couple));
        }

        [Test]
        public void OrientationsOffTheirElements_AreRefusedWithAMaterial_AndWarnedOfWithGains(
            [Values(44.0, 46.0, 90.0, 180.0)] double off)
        {
            JObject start = Straight(Quaterniond.FromAxisAngle(Vector3d.UnitY, 0.7), off);
            ParameterHandler gains = Load(start, "\"displacement\": 0");
            Assert.That(gains.Warnings.Count(line => line.Contains("degrees off")), Is.EqualTo(off > 45.0 ? 1 : 0));
            if (off <= 45.0)
            {
                Load(start, "\"solver\": \"direct\"");
                return;
            }
            Exception? refused = Assert.Throws<ParameterException>(() => Load(start, "\"solver\": \"direct\""));
            Assert.That(refused?.Message, Does.Contain("start.json: orientations[0] is "
                + off.ToString("0", CultureInfo.InvariantCulture) + " degrees off").And.Not.Contains("\n"));
        }

        [Test]
        public void ElementWithoutLength_IsRefused()
        {
            JObject start = Straight(Quaterniond.Identity);
            start["positions"]![3] = start["positions"]![2]!.DeepClone();
            Assert.That(() => Load(start, "\"solver\": \"direct\""), Throws.TypeOf<ParameterException>()
                .With.Message.Contains("positions[2] and positions[3] coincide"));
        }

        [Test]
        public void MissingFile_IsNamedBesideTheParameterFile()
        {
            string file = Path.Combine(Folder, "wire.json");
            File.WriteAllText(file, "{\"startFile\": \"runs/none.json\"}");
            Exception? refused = Assert.Throws<ParameterException>(() => ParameterHandler.Load(file,
                CommandLineHandler.ReadAssignments(Array.Empty<string>())));
            Assert.That(refused?.Message, Does.Contain(Path.GetFullPath(Path.Combine(Folder, "runs", "none.json"))));
        }
    }
}
