using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What the steps of a run may take, in iterations.</summary>
    public sealed class WorkLimitTests
    {
        private const int Solution = 50;              // iterations that one may take
        private const int AtOnce = 200 * Solution;
        private const int AStep = 4 * Solution;

        [Test]
        public void StepsThatAreSolvedAtOnce_AreNotCounted()
        {
            var work = new WorkLimit(Solution);
            for (int step = 0; step < 10; step++)
            {
                work.BeginStep();
                work.Spend(10 * AtOnce);
                Assert.That(work.IsOver || work.IsScarce, Is.False);
            }
        }

        [TestCase(0, 1)]
        [TestCase(1, 1)]
        [TestCase(2, 4)]
        [TestCase(3, 16)]
        public void OneStep_MayTakeAllAtOnce_MoreWithHubsThatMaySlip(int limitedHubs, int times)
        {
            var work = new WorkLimit(Solution, limitedHubs);
            work.BeginStep();
            work.Count();
            work.Spend(times * AtOnce);
            Assert.That(work.IsScarce && !work.IsOver);
            work.Spend(1);
            Assert.That(work.IsOver);
        }

        // Each takes so many more than a step may in the long run; what is left at the start bears it so long.
        [TestCase(0, -1)]
        [TestCase(1, AtOnce)]
        [TestCase(100, AtOnce / 100)]
        [TestCase(333, AtOnce / 333)]
        public void ManySteps_EndWhereTheStartIsUsed(int more, int steps)
        {
            var work = new WorkLimit(Solution);
            int done = 0;
            for (int step = 0; step < 2 * AtOnce; step++)
            {
                work.BeginStep();
                work.Count();
                work.Spend(AStep + more);
                if (work.IsOver)
                {
                    break;
                }
                done++;
            }
            // The first step finds all of it, and is given nothing.
            Assert.That(done, steps < 0 ? Is.EqualTo(2 * AtOnce) : Is.InRange(steps - 1 - AStep / more, steps));
        }

        [Test]
        public void WhatStepsLeave_AddsUpToTheStartAndNoMore()
        {
            var work = new WorkLimit(Solution);
            work.BeginStep();
            work.Count();
            work.Spend(AtOnce);
            for (int step = 0; step < AtOnce / AStep / 2; step++)
            {
                Assert.That(work.IsScarce);
                work.BeginStep();
            }
            Assert.That(work.IsScarce, Is.False);
            for (int step = 0; step < AtOnce; step++)
            {
                work.BeginStep();
            }
            work.Count();
            work.Spend(AtOnce + 1);
            Assert.That(work.IsOver);
        }

        [Test]
        public void RestoredLimit_EndsAtTheSameIteration()
        {
            var work = new WorkLimit(Solution);
            work.BeginStep();
            work.Count();
            work.Spend(AtOnce - 7);
            var kept = new Snapshot();
            work.Serialize(kept);
            var restored = new WorkLimit(Solution);
            restored.Serialize(kept.ToRead());
            restored.Count();
            restored.Spend(7);
            Assert.That(restored.IsOver, Is.False);
            restored.Spend(1);
            Assert.That(restored.IsOver);
        }
    }
}
