using System;

namespace Guidewire.Unity.Tests
{
    /// <summary>Unity's garbage collector is not generational: what a frame leaves behind, frames later stop
    /// for.</summary>
    public sealed class GarbageTests
    {
        private const int WarmUp = 60;
        private const int Counted = 120;

        [TearDown]
        public void Leave() => Engine.Unload();

        private static long Count()
        {
            long before = GC.GetAllocatedBytesForCurrentThread();
            Stage.Frames(Counted);
            return GC.GetAllocatedBytesForCurrentThread() - before;
        }

        [Test]
        public void Frames_LeaveNoGarbage()
        {
            Stage.OpenInsertion();
            Engine.Find<Hud>().enabled = false;
            Stage.Wire.ShowsSpheres = true;
            Stage.Wire.ShowsDirectors = true;
            Engine.Press(KeyCode.W);
            Engine.Press(KeyCode.D);
            Stage.Frames(WarmUp);
            int steps = Stage.Loop.Session!.Simulation.StepCount;
            Assert.That(Count(), Is.EqualTo(0));
            Assert.That(Stage.Loop.Session.Simulation.StepCount, Is.GreaterThan(steps), "the frames had steps");
        }

        [Test]
        public void Hud_LeavesGarbageOnlyWhenItsTextIsMadeAnew()
        {
            Stage.OpenInsertion();
            Stage.Frames(WarmUp);
            Hud hud = Engine.Find<Hud>();
            for (int frame = 1; frame <= 13; frame++)
            {
                string text = hud.Text;
                long before = GC.GetAllocatedBytesForCurrentThread();
                Stage.Frames(1);
                long left = GC.GetAllocatedBytesForCurrentThread() - before;
                if (!ReferenceEquals(hud.Text, text))
                {
                    Assert.That(left, Is.GreaterThan(0), "the count sees what a text leaves");
                    return;
                }
                Assert.That(left, Is.EqualTo(0), "frame " + frame);
            }
            Assert.Fail("the text was not made anew within 0.2 s");
        }
    }
}
