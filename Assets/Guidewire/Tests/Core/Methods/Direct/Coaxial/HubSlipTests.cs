using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The displacement of a hub that slips, of an instrument that answers as a spring.</summary>
    public sealed class HubSlipTests
    {
        private const double Limit = 0.05;       // N
        private const double Asked = 3e-4;       // m
        private const double Shortest = 5e-6;    // m
        private const int MaxTrials = 24;

        // Softer than a tip that bends, and stiffer than steel along its axis; without force where it is from far
        // behind to far ahead of what is asked.
        [Test]
        public void HubGoesToItsLimit_OnTheSideOfWhatIsAsked([Values(-3e-3, -3e-4, -2e-5, 2e-5, 2.9e-4, 4e-4, 2e-3)]
            double rest, [Values(3e2, 1e4, 1e5, 1e6)] double stiffness, [Values(1.0, -1.0)] double sense)
        {
            double Force(double u) => stiffness * (u - sense * rest);
            var slip = new HubSlip(null!, Limit, Shortest);
            slip.Begin();
            double asked = sense * Asked;
            double moved = asked;
            int trials = 1;
            while (slip.NeedsAnother(moved, Force(moved), false))
            {
                moved = slip.Displacement!.Value;
                trials++;
            }
            slip.EndStep(Force(moved));
            double right = Math.Abs(Force(asked)) <= Limit ? asked
                : sense * rest + Math.Sign(Force(asked)) * Limit / stiffness;
            TestContext.WriteLine("{0} trials, {1:G6} of {2:G6} m", trials, moved, right);
            Assert.That(trials, Is.LessThan(MaxTrials));
            Assert.That(moved, Is.EqualTo(right).Within(0.0201 * Limit / stiffness));
            Assert.That(Math.Abs(Force(moved)), Is.LessThanOrEqualTo(Limit));
            Assert.That(slip.FindExcess("a hub"), Is.Null);
        }

        // Of the two forces on either side of the jump it has the smaller one, whichever the search ends at.
        [TestCase(0.2, -0.1)]
        [TestCase(0.1, -0.2)]
        [TestCase(0.07, -5.0)]
        public void HubWhoseForceJumpsPastItsLimit_HasTheLeastOfThem_AndIsSaidTo(double ahead, double behind)
        {
            var slip = new HubSlip(null!, Limit, Shortest);
            double least = Math.Min(Math.Abs(ahead), Math.Abs(behind));
            for (int step = 0; step < 2; step++)
            {
                slip.Begin();
                double moved = Asked;
                int trials = 0;
                while (slip.NeedsAnother(moved, moved > 1e-4 ? ahead : behind, false))
                {
                    moved = slip.Displacement!.Value;
                    Assert.That(trials++, Is.LessThanOrEqualTo(MaxTrials));
                }
                Assert.That(Math.Abs(moved > 1e-4 ? ahead : behind), Is.EqualTo(least));
                slip.EndStep(moved > 1e-4 ? ahead : behind);
            }
            Assert.That(slip.FindExcess("the wire's hub")!.Value.Text, Does.Contain("the wire's hub had up to")
                .And.Contain("hubForceLimit of 0.05 N"));
            Assert.That(slip.FindExcess("a hub")!.Value.Text, Does.Contain("in 2 of the steps"));
        }
    }
}
