using System;
using Guidewire.Io;

namespace Guidewire.Unity.Tests
{
    /// <summary>A wire in a catheter, in the scene that a user steers.</summary>
    public sealed class CatheterTests
    {
        private static readonly string[] NoDrive = { "deltaThreshold=0", "maxSimulationSteps=1000000" };

        [SetUp]
        public void Open()
        {
            Stage.OpenInsertion();
            Stage.Frames(1);
            Stage.Loop.Choose("params/catheter.json", NoDrive, "", isSteered: true);
            Stage.Tap(KeyCode.R);
            Assert.That(Stage.Loop.Problem, Is.Empty);
        }

        [TearDown]
        public void Leave() => Engine.Unload();

        private static CoaxialRecord Catheter => Stage.Loop.Session!.Simulation.Catheters()[0];

        private static double WireInsertion => Stage.Loop.Session!.Simulation.Hub()!.Insertion;

        [Test]
        public void I_PutsTheCatheterIntoTheHand_AndTheWireAgain()
        {
            Assert.That(Stage.Loop.SteeredInstrument, Is.EqualTo(0));
            Stage.Tap(KeyCode.I);
            Assert.That(Stage.Loop.SteeredInstrument, Is.EqualTo(1));
            double time = Stage.Loop.Session!.Simulation.Time;
            Engine.Press(KeyCode.W);
            Stage.Frames(8);
            Engine.Release(KeyCode.W);
            double asked = 0.04 * (Stage.Loop.Session.Simulation.Time - time);
            Assert.That(Catheter.Insertion, Is.EqualTo(asked).Within(1e-12), "40 units of a mm a second");
            Assert.That(asked, Is.GreaterThan(1e-3));
            Assert.That(WireInsertion, Is.Zero);
            Stage.Tap(KeyCode.I);
            Assert.That(Stage.Loop.SteeredInstrument, Is.EqualTo(0));
            double before = Catheter.Insertion;
            Engine.Press(KeyCode.W);
            Stage.Frames(8);
            Engine.Release(KeyCode.W);
            Assert.That(WireInsertion, Is.GreaterThan(1e-3));
            Assert.That(Catheter.Insertion, Is.EqualTo(before));
        }

        [Test]
        public void Catheter_IsDrawnWithItsRadius_AroundItsCentreline()
        {
            Stage.Frames(3);
            CatheterTubes view = Stage.Wire.Catheters;
            Assert.That(view.Count, Is.EqualTo(1));
            Assert.That(Engine.Drawn.Exists(one => one.Material.color.a is > 0.2f and < 0.8f), "seen through");
            TubeMesh tube = view.TubeOf(0);
            Vector3d[] x = Stage.Loop.Shown!.Catheters[0].Positions;
            double times = 5.0 / 6.0 / 0.4445;    // 5 F over 0.035 in
            for (int i = 0; i < x.Length; i += 10)
            {
                int ring = tube.RingOf(i);
                float radius = (tube.Vertices[ring] - x[i].ToUnity()).magnitude;
                Assert.That(radius, Is.EqualTo(times * Stage.Wire.DrawnRadius).Within(1e-3), "sphere " + i);
            }
            Stage.Loop.Choose("params/insertion.json", Array.Empty<string>(), "", isSteered: true);
            Stage.Tap(KeyCode.R);
            Stage.Frames(1);
            Assert.That(view.Count, Is.Zero, "another run has none");
        }

        [Test]
        public void Hud_SaysWhatEachHubFeels_AndWhichIsHeld()
        {
            Stage.Tap(KeyCode.I);
            Engine.Find<Hud>().Refresh();
            string text = Engine.Find<Hud>().Text;
            Assert.That(text, Does.Contain("catheter-angled-5f: 0.0 mm in, turned by 0 degrees")
                .And.Contain("overlap 190.0 mm").And.Contain("the hand holds catheter-angled-5f"));
            Stage.Tap(KeyCode.I);
            Engine.Find<Hud>().Refresh();
            Assert.That(Engine.Find<Hud>().Text, Does.Contain("the hand holds bentson-0.035"));
        }

        [Test]
        public void Instruments_AreTakenByName_TheCathetersAmongCatheters()
        {
            var catheters = Stage.Loop.Session!.ChoicesOf(1);
            int all = Directory.GetFiles(Path.Combine(Stage.Root, "instruments"), "*.json").Length;
            Assert.That(Stage.Loop.Session.ChoicesOf(0).Count, Is.EqualTo(all));
            Assert.That(catheters, Is.EqualTo(new[] { "catheter-angled-5f", "catheter-guide-6f",
                "catheter-simmons-2-5f", "microcatheter-2.4f" }));
            Stage.Loop.UseNextInstrument(1);
            Assert.That(Stage.Loop.Session!.NameOf(1), Is.EqualTo("catheter-guide-6f"), Stage.Loop.Problem);
            Assert.That(Stage.Loop.Session.NameOf(0), Is.EqualTo("bentson-0.035"));
            Stage.Loop.UseNextInstrument(0);
            Assert.That(Stage.Loop.Problem, Is.Empty, "a catheter of 5 F goes through a guide of 6 F");
            Assert.That(Stage.Loop.Session!.NameOf(0), Is.EqualTo("catheter-angled-5f"));
            Stage.Loop.UseNextInstrument(0);
            Assert.That(Stage.Loop.Session!.NameOf(0), Is.EqualTo("catheter-simmons-2-5f"),
                "a guide does not fit into a guide");
        }

        [Test]
        public void HubThatIsNotThere_StopsInOneLine()
        {
            SimulationSession session = Stage.Loop.Session!;
            int steps = session.Simulation.StepCount;
            foreach (int hub in new[] { 2, -1, int.MaxValue, int.MinValue })
            {
                Assert.That(() => session.Step(1.0, 0.0, hub), Throws.TypeOf<ParameterException>()
                    .With.Message.EqualTo("request: hub = " + hub
                        + " is not allowed: needs 0, the wire's, or that of a catheter, from 1 to 1"));
            }
            Assert.That(session.Simulation.StepCount, Is.EqualTo(steps));
            Assert.That(WireInsertion, Is.Zero);
        }

        [Test]
        public void FramesWithACatheter_LeaveNoGarbageButWhereTheRodIsBuiltAnew()
        {
            Engine.Find<Hud>().enabled = false;
            Stage.Frames(20);
            long before = GC.GetAllocatedBytesForCurrentThread();
            Stage.Frames(30);
            Assert.That(GC.GetAllocatedBytesForCurrentThread() - before, Is.Zero);
        }
    }
}
