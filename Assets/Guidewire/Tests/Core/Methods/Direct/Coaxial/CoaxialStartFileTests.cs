using System;
using System.IO;
using System.Linq;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A run of one to three instruments that is cut in two and goes on by a start, against the whole
    /// run.</summary>
    /// <remarks>A start has what logs have, nodes, frames and hubs of each, and velocities of the wire. What it lacks,
    /// velocities of catheters and of angles between instruments, is gone after some steps. What contacts hold by
    /// friction is not, and these runs have none.</remarks>
    public sealed class CoaxialStartFileTests : FolderTests
    {
        private const int Before = 40;
        private const int After = 60;

        public enum Kind
        {
            Sheath, Pair, Three, PairInSheath, ThreeInSheath,
        }

        // The hubs turn against one another by more than a turn where the number, rad a step, is the larger one.
        [Test]
        public void RunThatGoesOn_IsTheWholeRun([Values] Kind kind, [Values(0.01, 0.1)] double turn)
        {
            if (turn < 0.1)
            {
                Rods.OnlyInFull("the same at a higher rate");
            }
            SimulationParameters parameters = Scene(kind);
            Simulation whole = Simulation.Create(parameters);
            Move(whole, parameters, Before, 0.3, turn);
            SimulationParameters next = Scene(kind);
            next.Scene.Start = StartOf(whole, parameters);
            Simulation part = Simulation.Create(next);
            Assert.That(Distance(whole, part), Is.LessThan(1e-4), "mm, before a step");
            double first = 0.0;
            for (int k = 0; k < After; k++)
            {
                Move(whole, parameters, 1, 0.2, -turn);
                Move(part, next, 1, 0.2, -turn);
                first = k == 0 ? Distance(whole, part) : first;
            }
            TestContext.WriteLine("{0:G3} mm after a step, {1:G3} mm and {2:G3} N of {3:G3} N after {4}", first,
                Distance(whole, part), ForceDifference(whole, part), whole.Hub()!.Force, After);
            Assert.That(whole.Outcome, Is.EqualTo(Outcome.Running), whole.Reason);
            Assert.That(first, Is.LessThan(kind == Kind.Sheath ? 1e-6 : 0.05), "mm");
            Assert.That(Distance(whole, part), Is.LessThan(kind == Kind.Sheath ? 1e-9 : 2e-4), "mm");
            Assert.That(ForceDifference(whole, part), Is.LessThan(1e-7), "N");
            Assert.That(part.Hub()!.Insertion, Is.EqualTo(whole.Hub()!.Insertion).Within(1e-12));
            Assert.That(part.Hub()!.Turn, Is.EqualTo(whole.Hub()!.Turn).Within(1e-12));
            Simulation restored = Simulation.Restore(next, part.Save());
            Move(restored, next, 1, 0.2, -turn);
            Move(part, next, 1, 0.2, -turn);
            Assert.That(Distance(restored, part), Is.Zero, "the same bits");
        }

        [Test]
        public void RecordsThatAreRead_LeaveTheNextStepsTheirBits([Values] Kind kind)
        {
            SimulationParameters parameters = Scene(kind);
            Simulation read = Simulation.Create(parameters);
            SimulationParameters same = Scene(kind);
            Simulation unread = Simulation.Create(same);
            for (int k = 0; k < Before; k++)
            {
                Move(read, parameters, 1, 0.3, 0.1);
                Move(unread, same, 1, 0.3, 0.1);
                read.Hub();
                read.Coaxial();
                read.Stress();
                Assert.That(ForceDifference(read, Simulation.Restore(parameters, read.Save())), Is.Zero, "restored");
            }
            Assert.That(Distance(read, unread), Is.Zero);
            Assert.That(ForceDifference(read, unread), Is.Zero);
        }

        [Test]
        public void RunAtRest_StaysWhereItIs([Values] Kind kind)
        {
            SimulationParameters parameters = Scene(kind);
            Simulation whole = Simulation.Create(parameters);
            Move(whole, parameters, Before, 0.3, 0.1);
            Move(whole, parameters, 150, 0.0, 0.0);
            SimulationParameters next = Scene(kind);
            next.Scene.Start = StartOf(whole, parameters);
            Simulation part = Simulation.Create(next);
            Move(part, next, 3, 0.0, 0.0);
            Assert.That(Distance(whole, part), Is.LessThan(1e-5), "mm");
            Assert.That(ForceDifference(whole, part), Is.LessThan(1e-6), "N");
        }

        // More of the wire has gone in than is left of it in the sheath.
        [Test]
        public void WireInItsSheath_MayGoOnToTheExit_AfterItsRunIsContinued([Values] bool isFile)
        {
            SimulationParameters parameters = Scene(Kind.Sheath);
            Simulation run = Simulation.Create(parameters);
            Move(run, parameters, 150, 0.9, 0.0);
            double gone = run.Hub()!.Insertion;
            SimulationParameters next = Scene(Kind.Sheath);
            if (isFile)
            {
                next.Scene.Start = StartOf(run, parameters);
            }
            Simulation on = isFile ? Simulation.Create(next) : run.Continue(next);
            Move(on, next, 100, 0.9, 0.0);
            Assert.That(gone, Is.EqualTo(0.135).Within(1e-9));
            Assert.That(on.Hub()!.Insertion, Is.EqualTo(0.2).Within(1e-9), "m, to the exit and not farther");
        }

        [TestCase("hub", null, "hub is missing: where the hub of each instrument is")]
        [TestCase("catheters[0].hub", null, "catheters[0].hub is missing")]
        [TestCase("catheters", null, "catheters needs a list of 1 objects, one for each catheter of the scene")]
        [TestCase("catheters", "[]", "catheters needs a list of 1 objects")]
        [TestCase("catheters[0].positions", "[[0, 0, 0]]", "catheters[0].positions needs a list of 26 [x, y, z]")]
        [TestCase("catheters[0].orientations", "[]", "catheters[0].orientations needs a list of 25 [x, y, z, w]")]
        [TestCase("catheters[0].hub", "{\"insertion\": 0}", "catheters[0].hub = {\"insertion\":0} is not allowed")]
        [TestCase("hub", "{\"insertion\": 0, \"turn\": \"left\"}", "hub = ")]
        [TestCase("hub", "{\"insertion\": 0.02, \"turn\": 0}", "positions[0] is 0.008 m from where the hub is")]
        [TestCase("catheters[0].hub", "{\"insertion\": -0.02, \"turn\": 0}", "catheters[0]: positions[0] is ")]
        [TestCase("catheters[0].positions[3]", "[0, 0, 127.5]", "catheters[0]: positions[2] and positions[3] are ")]
        [TestCase("catheters[0].orientations[2]", "[0, 1, 0, 1]", "catheters[0]: orientations[2] is 89 degrees off")]
        [TestCase("proximalFrame", "[0, 0, 0, 1]", "proximalFrame and hub: give one of the two")]
        [TestCase("catheters[0].catheters", "[]", "unknown key 'catheters[0].catheters'")]
        public void StartThatDoesNotFit_IsRefused(string path, string? value, string message)
        {
            SimulationParameters parameters = Scene(Kind.Pair);
            Simulation run = Simulation.Create(parameters);
            Move(run, parameters, 3, 4.0, 0.01);
            JObject start = Json(StartOf(run, parameters));
            JToken? holder = path.Contains(".") ? start.SelectToken(path.Substring(0, path.LastIndexOf('.'))) : start;
            string key = path.Substring(path.LastIndexOf('.') + 1);
            if (value == null)
            {
                ((JObject)holder!).Remove(key);
            }
            else if (key.EndsWith("]", StringComparison.Ordinal))
            {
                start.SelectToken(path)!.Replace(JToken.Parse(value));
            }
            else
            {
                holder![key] = JToken.Parse(value);
            }
            Exception? error = Assert.Throws<ParameterException>(() => Load(start, PairKeys));
            Assert.That(error!.Message, Does.Contain(message).And.Not.Contains("\n"));
        }

        [TestCase(WireKeys, "hub needs a sheath or catheters")]
        [TestCase(PairKeys + ", \"initialState\": \"equilibrium\"", "needs \"straight\" where a start has a")]
        public void StartOfInstruments_IsRefused_WhereTheSceneHasNoneOrSeeksItsOwn(string keys, string message)
        {
            SimulationParameters parameters = Scene(Kind.Pair);
            JObject start = Json(StartOf(Simulation.Create(parameters), parameters));
            Assert.That(() => Load(start, keys), Throws.InstanceOf<ParameterException>()
                .With.Message.Contains(message));
        }

        private const string WireKeys = "\"solver\": \"direct\", \"integrator\": \"implicitEuler\", "
            + "\"guidewireLength\": 400, \"guidewireOffset\": 0, \"numberRodElements\": 40, "
            + "\"proximalEnd\": \"clamped\", \"drive\": \"displace\"";
        private const string PairKeys = WireKeys + ", \"catheters\": [{\"elements\": 25, \"length\": 250, \"start\": "
            + "100, \"wireRadius\": 0.00083, \"lumenRadius\": 0.0006}]";

        private ParameterHandler Load(JObject start, string keys)
        {
            File.WriteAllText(Path.Combine(Folder, "start.json"), start.ToString());
            File.WriteAllText(Path.Combine(Folder, "scene.json"), "{\"startFile\": \"start.json\", " + keys + "}");
            return ParameterHandler.Load(Path.Combine(Folder, "scene.json"),
                CommandLineHandler.ReadAssignments(Array.Empty<string>()));
        }

        private static SimulationParameters Scene(Kind kind)
        {
            bool isThree = kind == Kind.Three || kind == Kind.ThreeInSheath;
            SimulationParameters parameters = isThree ? CoaxialScenes.Three(Integrator.ImplicitEuler)
                : CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Method.TimeStep = 0.02;
            parameters.Method.MaxSimulationSteps = 1000;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.TipForce = new Vector3d(0.01, 0.0, 0.0);
            if (kind == Kind.Sheath)
            {
                parameters.Scene.Catheters = Array.Empty<Catheter>();
            }
            if (kind != Kind.Pair && kind != Kind.Three)
            {
                double exit = kind == Kind.Sheath ? 200.0 : 260.0;
                parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, exit) };
                parameters.Scene.Walls = WallScenes.Floor(-500.0);
            }
            parameters.Drive.Steering = new Steering();
            foreach (Catheter catheter in parameters.Scene.Catheters)
            {
                catheter.Drive.Steering = new Steering();
            }
            return parameters;
        }

        // The hubs of catheters go half as far, and turn the other way.
        private static void Move(Simulation run, SimulationParameters parameters, int steps, double push, double turn)
        {
            parameters.Drive.Steering!.Push = push;
            parameters.Drive.Steering.Turn = turn;
            foreach (Catheter catheter in parameters.Scene.Catheters)
            {
                catheter.Drive.Steering!.Push = 0.5 * push;
                catheter.Drive.Steering.Turn = -turn;
            }
            for (int k = 0; k < steps; k++)
            {
                run.Step();
            }
        }

        private static RodStart StartOf(Simulation run, SimulationParameters parameters)
        {
            RodState state = run.State;
            HubRecord hub = run.Hub()!;
            return new RodStart(state.Positions.ToArray(), state.Orientations.ToArray(), state.Velocities.ToArray(),
                state.AngularVelocities.ToArray())
            {
                Hub = (hub.Insertion, hub.Turn),
                Catheters = run.Catheters().Take(parameters.Scene.Catheters.Count).Select(one => new RodStart(
                    one.Positions.ToArray(), one.Orientations.ToArray(), one.Velocities.ToArray(),
                    one.AngularVelocities.ToArray())
                {
                    Hub = (one.Insertion, one.Turn),
                }).ToArray(),
            };
        }

        private static JObject Json(RodStart start)
        {
            var json = new JObject
            {
                ["positions"] = new JArray(start.Positions.Select(x => new JArray(x.X, x.Y, x.Z))),
                ["orientations"] = new JArray(start.Orientations.Select(q => new JArray(q.X, q.Y, q.Z, q.W))),
                ["hub"] = new JObject { ["insertion"] = start.Hub!.Value.Insertion, ["turn"] = start.Hub.Value.Turn },
            };
            if (start.Catheters.Count > 0)
            {
                json["catheters"] = new JArray(start.Catheters.Select(Json));
            }
            return json;
        }

        // Of nodes, mm.
        private static double Distance(Simulation a, Simulation b)
        {
            return a.Centrelines().Select(nodes => nodes.ToArray()).Zip(
                b.Centrelines().Select(nodes => nodes.ToArray()), Wires.Distance).Max();
        }

        private static double ForceDifference(Simulation a, Simulation b)
        {
            double wire = Math.Abs(a.Hub()!.Force - b.Hub()!.Force);
            double[] others = b.Catheters().Where(one => one != null).Select(one => one.Force).ToArray();
            return a.Catheters().Where(one => one != null).Select((one, k) => Math.Abs(one.Force - others[k]))
                .Append(wire).Max();
        }
    }
}
