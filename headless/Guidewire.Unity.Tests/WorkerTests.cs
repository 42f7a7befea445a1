using System;
using System.Diagnostics;
using System.Threading;

namespace Guidewire.Unity.Tests
{
    /// <summary>A loop whose steps a thread of its own makes.</summary>
    public sealed class WorkerTests
    {
        private const int Patience = 60_000;    // ms, of a machine that other programs keep busy

        [TearDown]
        public void Leave() => Engine.Unload();

        private static SimulationLoop Open(string file, params string[] overrides)
        {
            Engine.Reset(Stage.Root);
            var host = new GameObject("Wire");
            SimulationLoop loop = host.AddComponent<SimulationLoop>();
            host.AddComponent<WireView>();
            host.AddComponent<VesselView>();
            host.AddComponent<ContactView>();
            loop.Choose(file, overrides, "", isSteered: true);
            return loop;
        }

        private static void FramesUntil(Func<bool> isDone, string what)
        {
            var clock = Stopwatch.StartNew();
            while (!isDone())
            {
                Engine.Frame(Stage.Frame);
                Thread.Sleep(1);
                Assert.That(clock.ElapsedMilliseconds, Is.LessThan(Patience), what);
                Assert.That(Engine.Console.FindAll(line => line.Type == LogType.Error), Is.Empty, what);
            }
        }

        [TestCase("params/insertion.json")]
        [TestCase("params/insertion-accurate.json")]
        [TestCase("params/catheter.json")]
        public void RecordedCommands_GiveTheSameBits_WithAThreadAndWithout(string file)
        {
            string[] overrides = { "deltaThreshold=0", "maxSimulationSteps=1000000" };
            SimulationLoop loop = Open(file, overrides);
            loop.Recording = new SteeringRecord();
            var random = new Random(59);
            int frame = 0;
            FramesUntil(() =>
            {
                if (frame++ % 7 == 0)
                {
                    loop.Push = (float)random.NextDouble() * 2f - 0.7f;
                    loop.Turn = (float)random.NextDouble() * 2f - 1f;
                }
                if (frame == 60)
                {
                    loop.SteerNextInstrument();
                    loop.Set(file == "params/insertion.json" ? "damping" : "massDamping", "0.2");
                }
                return loop.State != null && loop.State.StepCount >= 80;
            }, "80 steps");
            Assert.That(loop.Problem, Is.Empty);
            loop.IsPaused = true;
            int steps = -1;
            FramesUntil(() =>
            {
                bool isAtRest = loop.State!.StepCount == steps;
                steps = loop.State.StepCount;
                Thread.Sleep(20);
                return isAtRest;
            }, "a pause");
            WireState threaded = loop.State!;
            Assert.That(loop.Recording.Count, Is.GreaterThan(3));

            var second = new GameObject("Again").AddComponent<SimulationLoop>();
            second.Stepping = SteppingMode.Frames;
            second.Choose(file, overrides, "", isSteered: true);
            second.Replay = loop.Recording;
            second.IsPaused = true;
            second.Load();
            while (second.State!.StepCount < steps)
            {
                second.Step();
                Assert.That(second.Problem, Is.Empty);
            }
            Assert.That(second.State.Time, Is.EqualTo(threaded.Time));
            Assert.That(second.State.Rod.Positions, Is.EqualTo(threaded.Rod.Positions));
            Assert.That(second.State.Rod.Orientations, Is.EqualTo(threaded.Rod.Orientations));
            Assert.That(second.State.ContactForces, Is.EqualTo(threaded.ContactForces));
            Assert.That(second.State.Hub, Is.EqualTo(threaded.Hub));
        }

        [Test]
        public void NoFrameWaits_ForAStepThatTakesLong()
        {
            SimulationLoop loop = Open("params/insertion.json");
            FramesUntil(() => loop.State != null, "an open run");
            using var goesOn = new ManualResetEventSlim();
            using var isIn = new ManualResetEventSlim();
            loop.BetweenSteps(session =>
            {
                isIn.Set();
                goesOn.Wait();
            });
            Assert.That(isIn.Wait(Patience), Is.True);
            int steps = loop.State!.StepCount;
            Stage.Frames(120);    // would never return if one waited
            Assert.That(loop.State.StepCount, Is.LessThanOrEqualTo(steps + 1), "at most one was on its way");
            Assert.That(loop.Speed, Is.LessThan(0.5), "and the loop says so");
            Assert.That(() => loop.Session, Throws.InvalidOperationException);
            goesOn.Set();
            FramesUntil(() => loop.State.StepCount > steps + 5, "steps after that");
        }

        [Test]
        public void FramesWithAThread_LeaveNoGarbage()
        {
            SimulationLoop loop = Open("params/insertion.json", "maxSimulationSteps=1000000");
            loop.Push = 0.2f;
            FramesUntil(() => loop.State != null && loop.State.StepCount > 100, "100 steps");
            long before = GC.GetAllocatedBytesForCurrentThread();
            for (int frame = 0; frame < 200; frame++)
            {
                Engine.Frame(Stage.Frame);
                Thread.Sleep(1);
            }
            Assert.That(GC.GetAllocatedBytesForCurrentThread() - before, Is.Zero);
        }

        [Test]
        public void Destroyed_WhileItOpens_AndInTheMiddleOfAStep_TheThreadEnds_WithoutAnError()
        {
            for (int wait = 0; wait < 60; wait += 12)
            {
                SimulationLoop loop = Open("params/insertion-accurate.json");
                loop.Push = 1f;
                Engine.Frame(Stage.Frame);
                Thread.Sleep(wait);
                Engine.Frame(Stage.Frame);
                Engine.Unload();
                Assert.That(loop.State, Is.Null);
                Assert.That(Engine.Console, Is.Empty);
            }
        }

        [Test]
        public void Load_WhileTheLastRunOpens_TakesTheNewOne()
        {
            SimulationLoop loop = Open("params/insertion-accurate.json");
            Engine.Frame(Stage.Frame);
            loop.Choose("params/longitudinal.json", Array.Empty<string>(), "", isSteered: false);
            loop.Load();
            Assert.That(loop.Progress, Does.Contain("opening"));
            FramesUntil(() => loop.State != null && loop.State.StepCount > 3, "the second run");
            Assert.That(loop.Parameters!.Method.Solver, Is.EqualTo(Solver.Pbd));
            Assert.That(loop.Generation, Is.EqualTo(1), "the first never came to be");
        }

        [Test]
        public void WhatCannotBeOpened_IsSaidOnce()
        {
            SimulationLoop loop = Open("params/nowhere.json");
            var clock = Stopwatch.StartNew();
            while (loop.Problem.Length == 0 && clock.ElapsedMilliseconds < Patience)
            {
                Stage.Frames(1);
                Thread.Sleep(1);
            }
            Assert.That(loop.Problem, Does.Contain("nowhere.json"));
            Stage.Frames(20);
            Assert.That(Engine.Console, Has.Count.EqualTo(1));
        }

        [Test]
        public void BatchModeAndWebGL_StepBetweenFrames()
        {
            foreach (bool isBatch in new[] { true, false })
            {
                SimulationLoop loop = Open("params/insertion.json");
                Application.isBatchMode = isBatch;
                Application.platform = isBatch ? RuntimePlatform.LinuxEditor : RuntimePlatform.WebGLPlayer;
                Stage.Frames(10);
                Assert.That(loop.Session!.Simulation.Time, Is.EqualTo(10 * Stage.Frame).Within(0.011));
                Engine.Unload();
            }
        }

        [Test]
        public void FixedSteps_MakeTheStepsOfFixedUpdate()
        {
            SimulationLoop loop = Open("params/insertion.json");
            loop.Stepping = SteppingMode.FixedSteps;
            Stage.Frames(61);
            double fixedTime = Time.fixedDeltaTime * Math.Floor(60 * Stage.Frame / Time.fixedDeltaTime);
            Assert.That(loop.State!.Time, Is.EqualTo(fixedTime).Within(1.5 * Time.fixedDeltaTime));
        }

        [Test]
        public void Log_IsWhole_AfterItsLoopIsGone()
        {
            string folder = Path.Combine(TestContext.CurrentContext.WorkDirectory, "worker-log");
            SimulationLoop loop = Open("params/insertion.json");
            loop.Choose("params/insertion.json", Array.Empty<string>(), folder, isSteered: true);
            FramesUntil(() => loop.State != null && loop.State.StepCount > 3, "steps");
            Engine.Unload();
            var clock = Stopwatch.StartNew();
            while (!File.Exists(Path.Combine(folder, "summary.json")) && clock.ElapsedMilliseconds < Patience)
            {
                Thread.Sleep(5);
            }
            Assert.That(File.ReadAllText(Path.Combine(folder, "summary.json")), Does.Contain("\"interrupted\""));
            Directory.Delete(folder, true);
        }
    }
}
