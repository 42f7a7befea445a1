using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    [Category("Target")]
    public sealed class SimulationSessionTests : FolderTests
    {
        private string _file = "";

        [SetUp]
        public void Make()
        {
            _file = Path.Combine(Folder, "wire.json");
            File.WriteAllText(_file, "{\"constraintSolverSteps\": 20, \"deltaThreshold\": 0}");
        }

        private SimulationSession Open(string log, bool isSteered, params string[] overrides) =>
            SimulationSession.Open(_file, overrides, log, isSteered);

        private static JObject Summary(string folder) =>
            JObject.Parse(File.ReadAllText(Path.Combine(folder, "summary.json")));

        [Test]
        public void Set_ChangesOneValueAndKeepsTheOthers()
        {
            using SimulationSession session = Open("", false, "bendStiffness=0.3");
            session.Step(0.0, 0.0);
            session.Set("stretchStiffness", "0.2");
            Assert.That(session.Parameters.Pbd.StretchStiffness, Is.EqualTo(0.2));
            Assert.That(session.Parameters.Pbd.BendStiffness, Is.EqualTo(0.3), "the override");
            Assert.That(session.Parameters.Method.ConstraintSolverSteps, Is.EqualTo(20), "the file");
            session.Set("damping", "0.1");
            Assert.That(session.Parameters.Pbd.StretchStiffness, Is.EqualTo(0.2), "the earlier change");
            Assert.That(session.Simulation.StepCount, Is.EqualTo(1));
        }

        [Test]
        public void RestoredAndResetSession_TakesTheSameStepsUnderTheSameHand()
        {
            SimulationSession session = SimulationSession.Open(_file, GivenKeys.None, null);
            Assert.That(session.IsSteered, Is.True);
            Vector3d[][] tips = new Vector3d[3][];
            byte[] saved = session.Save();
            for (int k = 0; k < 3; k++)
            {
                for (int step = 0; step < 20; step++)
                {
                    session.Step(0.3, 0.05);
                }
                tips[k] = (Vector3d[])session.Simulation.State.Positions.Clone();
                if (k == 0)
                {
                    session.Reset();
                }
                else
                {
                    session.Restore(saved);
                }
            }
            Assert.That(tips[1], Is.EqualTo(tips[0]));
            Assert.That(tips[2], Is.EqualTo(tips[0]));
        }

        [Test]
        public void Restore_Refuses_OtherParameters_AndWhatIsNotWhole_AndChangesNothing()
        {
            SimulationSession session = SimulationSession.Open(_file, GivenKeys.None, true);
            using SimulationSession other = Open("", true, "bendStiffness=0.3");
            using SimulationSession driven = Open("", false);
            byte[] saved = session.Save();
            byte[] broken = session.Save();
            broken[broken.Length - 1] ^= 1;
            Simulation before = session.Simulation;
            foreach (byte[] wrong in new[] { other.Save(), driven.Save(), broken, Array.Empty<byte>(), new byte[5000] })
            {
                Assert.Throws<ParameterException>(() => session.Restore(wrong));
                Assert.That(session.Simulation, Is.SameAs(before));
            }
            session.Restore(saved);
        }

        [Test]
        public void SessionOfAMaterial_IsDriven_UnlessAHandIsAskedFor_AndStatesReactions()
        {
            List<KeyValuePair<string, JToken>> material = GivenKeys.Of(("solver", "direct"), ("proximalEnd", "clamped"),
                ("gravity", new JArray(0.0, -9.81, 0.0)));
            SimulationSession session = SimulationSession.Open(null, material, null);
            session.Step(0.0, 0.0);
            Assert.That(session.IsSteered, Is.False);
            Assert.That(session.Simulation.Contacts!.Reaction.Y, Is.GreaterThan(0.0));
            SimulationSession steered = SimulationSession.Open(null, material, true);
            steered.Step(0.25, 0.5);
            Assert.That(steered.IsSteered, Is.True);
            Assert.That(steered.Simulation.Hub()!.Turn, Is.EqualTo(0.5).Within(1e-12));
            Assert.That(steered.Simulation.Hub()!.Insertion, Is.EqualTo(0.25e-3).Within(1e-12), "a unit is 1 mm");
            material[1] = new KeyValuePair<string, JToken>("proximalEnd", "held");
            Assert.That(() => SimulationSession.Open(null, material, true), Throws.TypeOf<ParameterException>()
                .With.Message.Contains("proximalEnd needs"));
            material[0] = new KeyValuePair<string, JToken>("solver", "explicit");
            Assert.That(() => SimulationSession.Open(null, material, true), Throws.TypeOf<ParameterException>()
                .With.Message.Contains("explicit is not steered interactively"));
        }

        [Test]
        public void LongerCatheter_HasItsTipWhereTheOthersWas_AndIsThereAfterAReset()
        {
            WriteCatheter(20);
            using SimulationSession session = Open("", true);
            double[] all = { 0.2, 0.0, -0.5, 0.01 };
            double[] one = { 0.2, 0.0 };
            session.Step(all);
            session.Step(one);
            CoaxialRecord before = session.Simulation.Coaxial()!;
            Assert.That((before.Insertion, before.Turn), Is.EqualTo((-5e-4, 0.01)), "a hub that is left out rests");
            for (int k = 0; k < 15; k++)
            {
                session.Step(-0.5, 0.0, 1);
            }
            before = session.Simulation.Coaxial()!;
            Vector3d tip = before.Positions[before.Positions.Length - 1];
            session.Exchange(1, new[] { "catheters[0].length=90", "catheters[0].elements=45" });
            Assert.That(session.Parameters.Scene.Catheters[0].Start, Is.EqualTo(14.0));
            CoaxialRecord after = session.Simulation.Coaxial()!;
            Assert.That(Vector3d.Distance(after.Positions[after.Positions.Length - 1], tip), Is.LessThan(1e-6));
            session.Reset();
            Vector3d[] start = session.Simulation.Coaxial()!.Positions;
            Assert.That(start, Has.Length.EqualTo(46));
            Assert.That(Vector3d.Distance(start[45], start[44]), Is.EqualTo(2.0).Within(1e-6));
        }

        [Test]
        public void TableOfAHubThatWasCarriedAlong_LeavesThatOut_AndGivesTheSameBits()
        {
            WriteCatheter(2);
            using SimulationSession steered = Open("", true);
            steered.RecordSteering();
            for (int k = 0; k < 12; k++)
            {
                steered.Step(new[] { k < 10 ? 0.5 : 0.0, 0.0, k < 10 ? 0.0 : -0.25, 0.0 });
            }
            Assert.That(steered.Simulation.Coaxial()!.Insertion, Is.EqualTo(2.5e-3).Within(1e-6), "there and back");
            var keys = new List<string>();
            for (int hub = 0; hub < 2; hub++)
            {
                string table = Path.Combine(Folder, "hub" + hub + ".csv");
                File.WriteAllText(table, steered.DriveTable(hub));
                keys.Add((hub == 0 ? "" : "catheters[0].") + "driveFile=" + table);
            }
            string table1 = steered.DriveTable(1);
            Assert.That(table1.Substring(table1.LastIndexOf('\n', table1.Length - 2)),
                Does.Match("^\n[^,]*,-0[.]0005"));
            using SimulationSession driven = Open("", false, keys.ToArray());
            for (int k = 0; k < 12; k++)
            {
                driven.Step(0.0, 0.0);
            }
            Assert.That(driven.Simulation.State.Positions, Is.EqualTo(steered.Simulation.State.Positions));
        }

        // Through a sheath.
        private void WriteCatheter(int start)
        {
            File.WriteAllText(_file, ("{'solver': 'direct', 'guidewireLength': 120, 'numberRodElements': 30,"
                + " 'vessel': {'shape': 'tube', 'knots': [[0, 0, -10], [0, 0, 200]], 'radius': 4},"
                + " 'sheath': {'exit': [0, 0, 0]}, 'guidewireOffset': -100, 'wireRadius': 0.0003, 'massDamping': 20,"
                + " 'proximalEnd': 'clamped', 'drive': 'displace', 'timeStep': 0.02, 'deltaThreshold': 0,"
                + " 'catheters': [{'start': " + start + ", 'length': 84, 'elements': 28, 'wireRadius': 0.0008,"
                + " 'lumenRadius': 0.0005}]}").Replace('\'', '"'));
        }

        [Test]
        public void Set_ThatIsRefused_ChangesNothing()
        {
            using SimulationSession session = Open("", false);
            Simulation before = session.Simulation;
            Assert.Throws<ParameterException>(() => session.Set("timeStep", "0"));
            Assert.That(session.Simulation, Is.SameAs(before));
            Assert.That(session.Parameters.Method.TimeStep, Is.EqualTo(0.01));
        }

        [Test]
        public void Switch_GoesRoundTheChoicesThatFit()
        {
            using SimulationSession session = Open("", false);
            Assert.That(session.Switch("sweepOrder"), Is.True);
            Assert.That(session.Text("sweepOrder"), Is.EqualTo("bilateral"));
            Assert.That(session.Switch("sweepOrder"), Is.True);
            Assert.That(session.Text("sweepOrder"), Is.EqualTo("naive"));
        }

        [Test]
        public void Switch_ChangesNothing_WhereNoChoiceFits()
        {
            using SimulationSession session = Open("", true);
            Assert.That(session.Switch("solver"), Is.False);
            Assert.That(session.Parameters.Method.Solver, Is.EqualTo(Solver.Pbd));
        }

        [Test]
        public void Log_OfASteeredRun_StandsForNoParameters()
        {
            string log = Path.Combine(Folder, "log");
            using (SimulationSession session = Open(log, true))
            {
                session.Step(0.5, 0.0);
            }
            JObject summary = Summary(log);
            Assert.That((string?)summary["outcome"], Is.EqualTo("interrupted"));
            Assert.That(summary["parameterHash"]!.Type, Is.EqualTo(JTokenType.Null));
            Assert.That((string?)summary["notes"]![0], Is.EqualTo("steered by hand from step 0 on"));
        }

        [Test]
        public void Log_OfARunThatNobodyTouched_StandsForItsParameters()
        {
            string log = Path.Combine(Folder, "log");
            using (SimulationSession session = Open(log, false, "maxSimulationSteps=3"))
            {
                for (int k = 0; k < 5; k++)
                {
                    session.Step(1.0, 1.0);
                }
            }
            JObject summary = Summary(log);
            Assert.That((string?)summary["outcome"], Is.EqualTo("finished"));
            Assert.That((int)summary["steps"]!, Is.EqualTo(3));
            Assert.That(((string?)summary["parameterHash"])!.Length, Is.EqualTo(64));
            Assert.That(summary["notes"], Is.Empty);
        }

        [Test]
        public void DriveTable_MovesTheHubWithTheSameBits_AlsoAfterAReset()
        {
            string[] keys = { "solver=direct", "drive=displace", "proximalEnd=clamped", "timeStep=0.003",
                "maxSimulationSteps=1000" };
            using SimulationSession steered = Open("", true, keys);
            steered.RecordSteering();
            steered.Step(1.0, 0.1);
            steered.Reset();
            var random = new Random(4);
            for (int k = 0; k < 40; k++)
            {
                steered.Step(2.0 * random.NextDouble() - 0.5, 0.2 * random.NextDouble());
            }
            string table = Path.Combine(Folder, "table.csv");
            File.WriteAllText(table, steered.DriveTable(0));
            using SimulationSession driven = Open("", false, keys.Append("driveFile=" + table).ToArray());
            for (int k = 0; k < 40; k++)
            {
                driven.Step(0.0, 0.0);
            }
            Assert.That(driven.Simulation.State.Positions, Is.EqualTo(steered.Simulation.State.Positions));
            Assert.That(driven.Simulation.State.Orientations, Is.EqualTo(steered.Simulation.State.Orientations));
            Assert.Throws<ParameterException>(() => steered.DriveTable(1));
        }

        private static readonly string[] InTube =
        {
            "solver=direct", "integrator=implicitEuler", "drive=displace", "proximalEnd=clamped", "timeStep=0.02",
            "guidewireLength=60", "numberRodElements=12", "guidewireOffset=-50", "massDamping=20",
            "vessel={\"shape\": \"tube\", \"knots\": [[0, 0, -100], [0, 0, 100]], \"radius\": 3}",
        };

        private SimulationSession Recorded(double push, int steps, params string[] more)
        {
            SimulationSession steered = Open("", true, InTube.Concat(more).ToArray());
            steered.RecordSteering();
            for (int k = 0; k < steps; k++)
            {
                steered.Step(push, 0.0);
            }
            return steered;
        }

        [Test]
        public void DriveTable_OfAWireThatWasPushedToTheEndOfItsSheath_IsTaken()
        {
            string[] more = { "sheath={\"exit\": [0, 0, 0]}", "contactDistance=5e-5" };
            using SimulationSession steered = Recorded(4.0, 15, more);
            Assert.That(steered.Simulation.Hub()!.Insertion, Is.EqualTo(0.05).Within(1e-9), "of 0.06 m asked");
            string table = Path.Combine(Folder, "table.csv");
            File.WriteAllText(table, steered.DriveTable(0));
            using SimulationSession driven = Open("", false,
                InTube.Concat(more).Append("driveFile=" + table).ToArray());
            for (int k = 0; k < 15; k++)
            {
                driven.Step(0.0, 0.0);
            }
            Assert.That(driven.Simulation.State.Positions, Is.EqualTo(steered.Simulation.State.Positions));
        }

        // A table's speed chooses the contactDistance; two hubs that press on each other stop where they meet.
        [Test]
        public void DriveTable_ThatWouldNotRepeatTheRun_IsRefusedWithTheReason()
        {
            using SimulationSession fast = Recorded(4.0, 2);
            using SimulationSession slow = Recorded(0.4, 2);
            Assert.That(() => fast.DriveTable(0), Throws.TypeOf<ParameterException>().With.Message.Contains(
                "a drive as fast has a contactDistance of 0.0002 m, and the hand 5E-05 m"));
            Assert.That(slow.DriveTable(0), Is.Not.Empty);
            using SimulationSession met = Recorded(0.0, 0, "catheters=[{\"start\": 1, \"length\": 40, "
                + "\"elements\": 8, \"wireRadius\": 1e-3, \"lumenRadius\": 6e-4}]");
            for (int k = 0; k < 4; k++)
            {
                double[] opposed = { 0.4, 0.0, -0.4, 0.0 };
                met.Step(opposed);
            }
            Assert.That(() => met.DriveTable(0), Throws.TypeOf<ParameterException>().With.Message.Contains(
                "hubs that met were driven against each other"));
        }

        [TestCase(1e300, 0.0)]
        [TestCase(0.0, 1e300)]
        [TestCase(0.0, 5000.0)]
        public void DriveTable_OfWaysBeyondItsExactSums_IsRefused(double push, double turn)
        {
            using SimulationSession steered = Recorded(0.0, 1, "contactDistance=5e-5");
            steered.Step(push, turn);
            if (steered.Simulation.Outcome == Outcome.Running)
            {
                steered.Step(push, turn);
            }
            Assert.That(() => steered.DriveTable(0), Throws.TypeOf<ParameterException>().With.Message.Contains(
                "more than 16 m or 8192 rad"));
        }

        [Test]
        public void AnotherStart_CountsFromTheNextReset()
        {
            using SimulationSession session = Recorded(0.4, 2);
            session.Set("guidewireOffset", "-70");
            Assert.That(session.Simulation.State.Positions[0].Z, Is.EqualTo(-49.2).Within(1e-6), "it goes on");
            session.Reset();
            Assert.That(session.Simulation.State.Positions[0].Z, Is.EqualTo(-70.0).Within(1e-9));
        }

        [Test]
        public void PushOfARecordedSession_IsNearWhatIsAsked_AndItsSumsAreExact(
            [Values(1e-3, 0.0254, 1.0, 1.0 / 3e3)] double metres)
        {
            foreach (double wanted in new[] { 0.4, -0.04, 0.0, 1.2345e-3, -7e-7, 93.0 })
            {
                double push = DriveTableRecord.ExactPush(wanted, metres);
                double displacement = metres * push;
                Assert.That(push, Is.EqualTo(wanted).Within(1e-12 / metres));
                double sum = 0.0;
                for (int k = 1; k <= 100 && Math.Abs(k * displacement) < 12.0; k++)
                {
                    sum += displacement;
                    Assert.That(sum - (k - 1) * displacement, Is.EqualTo(displacement), "m");
                }
            }
        }

        [TestCase("timeStep")]
        [TestCase("=3")]
        [TestCase("timestep=0.01")]
        public void Override_ThatCannotBeRead_IsRefused(string line) =>
            Assert.Throws<ParameterException>(() => Open("", false, line));
    }
}
