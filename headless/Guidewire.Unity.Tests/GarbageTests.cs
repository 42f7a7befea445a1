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
    }
}
