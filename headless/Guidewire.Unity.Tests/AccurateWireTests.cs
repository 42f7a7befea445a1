using System;

namespace Guidewire.Unity.Tests
{
    /// <summary>The wire with a material, in the scene that a user steers.</summary>
    public sealed class AccurateWireTests
    {
        private static readonly bool InFull = Environment.GetEnvironmentVariable("GUIDEWIRE_ALL") == "1";

        [SetUp]
        public void Open()
        {
            Stage.OpenInsertion();
            Stage.Frames(2);
            Stage.Tap(KeyCode.M);
        }

        [TearDown]
        public void Leave() => Engine.Unload();

        [Test]
        public void M_TakesTheMaterialInPlaceOfGains_AndBack()
        {
            Assert.That(Stage.Loop.Session!.Text("solver"), Is.EqualTo("direct"), Stage.Loop.Problem);
            Assert.That(Stage.Loop.Session.IsSteered, Is.True);
            Stage.Tap(KeyCode.M);
            Assert.That(Stage.Loop.Session!.Text("solver"), Is.EqualTo("pbd"), Stage.Loop.Problem);
        }

        [Test]
        public void Keys_PushPullAndTurnTheHub_AndTheHudSaysWhatItFeels()
        {
            Engine.Press(KeyCode.W);
            Stage.Frames(30);
            Engine.Release(KeyCode.W);
            HubRecord hub = Stage.Loop.Session!.Simulation.Hub()!;
            double time = Stage.Loop.Session.Simulation.Time;
            Assert.That(hub.Insertion, Is.EqualTo(0.04 * time).Within(0.04 * 3.0 * Stage.Frame), "40 units a second");
            double pushed = hub.Insertion;
            Engine.Press(KeyCode.D);
            Stage.Frames(20);
            Engine.Release(KeyCode.D);
            hub = Stage.Loop.Session.Simulation.Hub()!;
            double turned = Math.PI * (Stage.Loop.Session.Simulation.Time - time);
            Assert.That(hub.Turn, Is.EqualTo(turned).Within(Math.PI * 3.0 * Stage.Frame), "180 degrees a second");
            Assert.That(hub.Insertion, Is.EqualTo(pushed).Within(0.04 * 2.0 * Stage.Frame));
            Engine.Press(KeyCode.S);
            Stage.Frames(15);
            Engine.Release(KeyCode.S);
            Assert.That(Stage.Loop.Session.Simulation.Hub()!.Insertion, Is.LessThan(pushed - 0.005));
            Engine.Find<Hud>().Refresh();
            string text = Engine.Find<Hud>().Text;
            foreach (string line in new[] { "hub: ", " mm in, turned by ", "push ", " mN m", "largest curvature",
                " N\n" })
            {
                Assert.That(text, Does.Contain(line));
            }
        }

        [Test]
        public void FramesUnderAScriptOfKeys_GoIntoTheBranch_AndLeaveNoGarbage()
        {
            // Some 200 mm at 40 mm/s; in full 3,000 frames, with a turn to and fro at the end.
            Engine.Find<Hud>().enabled = false;
            Engine.Press(KeyCode.W);
            Stage.Frames(240);
            long before = GC.GetAllocatedBytesForCurrentThread();
            Stage.Frames(120);
            long left = GC.GetAllocatedBytesForCurrentThread() - before;
            if (InFull)
            {
                Engine.Release(KeyCode.W);
                Engine.Press(KeyCode.D);
                Stage.Frames(1320);
                Engine.Release(KeyCode.D);
                Engine.Press(KeyCode.A);
                Stage.Frames(1320);
            }
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
            Simulation run = Stage.Loop.Session!.Simulation;
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            Vector3d tip = run.State.Positions[run.State.ElementCount];
            Assert.That(tip.Z, Is.GreaterThan(165.0), "the branch leaves the arch at z = 132 and goes up");
            Assert.That(run.Contacts!.Passages, Is.Zero);
            Assert.That(left, Is.Zero);
        }

        [Test]
        public void RunThatFails_SaysWhy_AndStartsAnew()
        {
            Stage.Loop.Choose("params/insertion-accurate.json",
                new[] { "insertionSpeed=0", "deltaThreshold=0", "maxNewtonIterations=1", "contactStiffness=1e9" }, "",
                true);
            Stage.Tap(KeyCode.R);
            Engine.Press(KeyCode.W);
            for (int frame = 0; frame < 600 && Stage.Loop.Problem.Length == 0; frame++)
            {
                Stage.Frames(1);
            }
            Engine.Release(KeyCode.W);
            Assert.That(Stage.Loop.Problem,
                Does.StartWith("failed: the step to t = ").And.Contain("maxNewtonIterations"));
            Stage.Frames(1);
            Assert.That(Engine.Find<Hud>().Text, Does.Contain("STOPPED: failed"));
            Stage.Loop.Choose("params/insertion-accurate.json", new[] { "insertionSpeed=0" }, "", true);
            Stage.Tap(KeyCode.R);
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
            Assert.That(Stage.Loop.Session!.Simulation.Outcome, Is.EqualTo(Outcome.Running));
        }
    }
}
