using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire in one or two catheters, pushed, pulled and turned at all hubs in vessels of many kinds: none is
    /// ever outside, and each run ends as asked or says why not.</summary>
    /// <remarks>The environment variable GUIDEWIRE_COAXIAL_PUSHES = FIRST:COUNT asks for other pushes than the first
    /// 100.</remarks>
    internal sealed class RandomCoaxialPushTests
    {
        // The wire is drawn in by as much a step as is left of its first element beyond the catheter's tip: a
        // prediction that counts that twice has the element reversed, and its joint loses a turn.
        [TestCase(454)]
        [TestCase(932)]
        public void WireThatIsDrawnInFast_LosesNoTurnAtTheTip(int seed)
        {
            var push = new RandomCoaxialPush(seed);
            Assert.That(push.Simulation.Outcome, Is.EqualTo(Outcome.Running), push.Simulation.Reason);
        }

        [TestCase(81231)]
        public void BothThatBuckleAtTheExitOfTheSheath_EndBeforeTheyAreOutside(int seed)
        {
            var push = new RandomCoaxialPush(seed, true);
            Assert.That(push.Simulation.Outcome, Is.EqualTo(Outcome.Failed));
            Assert.That(push.Simulation.Reason, Does.Contain("buckles at the exit of its sheath"));
            Assert.That(push.Contacts.Passages + push.PointsOutside, Is.Zero);
        }

        [TestCase(false, false)]
        [TestCase(true, false, Category = "Long")]
        [TestCase(false, true, Category = "Long")]
        [TestCase(true, true)]
        [TestCase(false, false, true, Category = "Long")]
        public void NoInstrumentIsEverOutside_AndEveryRunHasAnEnd(bool isSheathed, bool hasOuter, bool isSoft = false)
        {
            (int first, int runs) = RandomGeometry.Asked("GUIDEWIRE_COAXIAL_PUSHES");
            runs = runs > 0 ? runs : RandomGeometry.Cases(100, 14);
            var worst = new List<string>();
            var refused = new List<string>();
            int outside = 0;
            int failed = 0;
            int touching = 0;
            int overtaking = 0;
            int beyond = 0;
            double wrong = 0.0;
            foreach (RandomCoaxialPush push in RandomGeometry.Runs(first, runs,
                seed => new RandomCoaxialPush(seed, isSheathed, hasOuter, isSoft), refused))
            {
                bool isOutside = push.Contacts.Passages > 0 || push.PointsOutside > 0 || !push.IsFinite
                    || push.Contacts.MaxPenetration > 0.0;
                bool isRunning = push.Simulation.Outcome == Outcome.Running;
                touching += push.Contacts.LargestForce > 1e-3 ? 1 : 0;
                overtaking += push.Overtakings;
                outside += isOutside ? 1 : 0;
                failed += isRunning ? 0 : 1;
                beyond += push.Beyond > 1e-3 ? 1 : 0;
                wrong = Math.Max(wrong, isRunning ? push.Missing : 0.0);
                if (isOutside || !isRunning || push.Beyond > 1e-3)
                {
                    worst.Add(push.ToString());
                }
            }
            worst.AddRange(refused);
            foreach (string line in worst)
            {
                TestContext.WriteLine(line);
            }
            TestContext.WriteLine(failed + " of " + runs + " failed, " + outside + " outside, " + touching
                + " touched a wall, " + overtaking + " overtakings, "
                + beyond + " with a hub beyond its force");
            Assert.That(touching, Is.GreaterThan(runs / 2), "runs in which a wall is touched");
            Assert.That(overtaking, Is.GreaterThan(runs / 4), "times that one tip overtakes the other");
            Assert.That(outside + refused.Count, Is.Zero, "runs with an instrument outside");
            Assert.That(wrong, Is.LessThan(1e-9), "m between what a hub was asked, and what it went and fell short");
            Assert.That(failed, Is.LessThanOrEqualTo(0.005 * runs));
        }
    }
}
