using System;
using Guidewire.Runtime;
using NUnit.Framework;
using UnityEngine;
using UnityStubs;

namespace Guidewire.Unity.Tests
{
    /// <summary>Unity's garbage collector is not generational: what a frame leaves behind, frames later stop
    /// for.</summary>
    [TestFixture]
    public sealed class GarbageTests
    {
        private const int WarmUp = 60;
        private const int Counted = 120;

        [TearDown]
        public void Leave()
        {
            Engine.Unload();
        }

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
            string text = Engine.Find<Hud>().Text;
            long before = GC.GetAllocatedBytesForCurrentThread();
            int same = 0;
            while (ReferenceEquals(Engine.Find<Hud>().Text, text) && same < 100)
            {
                Assert.That(GC.GetAllocatedBytesForCurrentThread() - before, Is.EqualTo(0), "frame " + same);
                Stage.Frames(1);
                same++;
                if (ReferenceEquals(Engine.Find<Hud>().Text, text))
                {
                    continue;
                }
                Assert.That(same, Is.LessThanOrEqualTo(13), "five texts a second");
                return;
            }
            Assert.Fail("the text was never made anew");
        }
    }
}
