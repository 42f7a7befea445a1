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
            var slip = new HubSlip(HubLimit.OfForce(Limit), Shortest);
            double asked = sense * Asked;
            slip.Begin(asked, 0.0);
            double moved = asked;
            int trials = 1;
            while (slip.NeedsAnother(moved, 0.0, Force(moved), false))
            {
                moved = slip.Displacement ?? asked;
                trials++;
            }
            slip.EndStep(Force(moved), 0.0);
            double right = Math.Abs(Force(asked)) <= Limit ? asked
                : sense * rest + Math.Sign(Force(asked)) * Limit / stiffness;
            TestContext.WriteLine("{0} trials, {1:G6} of {2:G6} m", trials, moved, right);
            Assert.That(trials, Is.LessThan(MaxTrials));
            Assert.That(moved, Is.EqualTo(right).Within(0.0201 * Limit / stiffness));
            Assert.That(Math.Abs(Force(moved)), Is.LessThanOrEqualTo(Limit));
            Assert.That(slip.Record.FindExcess("a hub"), Is.Null);
        }

        // Its force would take 3 mm to fall to the limit, and it goes no farther than it may.
        [Test]
        public void HubGoesNoFartherThanItSlipsInAStep([Values(-3e-3, 3e-3)] double rest,
            [Values(1e-3, 1e-4)] double most)
        {
            var slip = new HubSlip(HubLimit.OfForce(Limit), Shortest, most);
            double asked = Asked * Math.Sign(rest);
            double Force(double u) => 1e4 * (u - rest);
            double largest = Math.Max(most, Asked);
            slip.Begin(asked, 0.0);
            double moved = asked;
            int trials = 1;
            while (slip.NeedsAnother(moved, 0.0, Force(moved), false))
            {
                moved = slip.Displacement ?? asked;
                Assert.That(moved, Is.InRange(-most, largest).Or.InRange(-largest, most));
                Assert.That(Math.Abs(moved), Is.LessThanOrEqualTo(Math.Max(most, Asked)));
                Assert.That(trials++, Is.LessThan(MaxTrials));
            }
            slip.EndStep(Force(moved), 0.5);
            Assert.That(moved, Is.EqualTo(Math.Sign(rest) * largest), "towards where it has no force");
            Assert.That(slip.Record.FindExcess("the hub"), Is.Not.Null);
            Assert.That(slip.Record.SlippedFrom, Is.EqualTo(0.5));
        }

        // 2 mu P of two fingers, and Euler's load of a clamped shaft of 20 mm.
        [TestCase(1e-5, 4.0 * Math.PI * Math.PI * 1e-5 / (0.02 * 0.02))]
        [TestCase(1e-2, 10.0)]
        public void HandPushesNoHarderThanItsGripAndTheShaftBear_AndPullsWithItsGrip(double bending, double push)
        {
            HubLimit limit = HubLimit.OfHand(bending);
            Assert.That(limit.Push, Is.EqualTo(push).Within(1e-12));
            Assert.That(limit.Pull, Is.EqualTo(10.0));
            Assert.That(limit.Excess(push + 1.0), Is.EqualTo(1.0).Within(1e-12));
            Assert.That(limit.Excess(-11.0), Is.EqualTo(-1.0));
            Assert.That(limit.Excess(-9.0), Is.Zero);
            Assert.That(limit.Excess(double.NaN), Is.NaN);
            var drive = new DriveParameters { Kind = Drive.Displace };
            var material = new MaterialParameters { WireRadius = 2e-4, YoungsModulus = 60e9 };
            Assert.That(HubLimit.Of(drive, material).IsOfHand);
            drive.HubForceLimit = 0.0;
            Assert.That(HubLimit.Of(drive, material).IsLimited, Is.False);
            drive.HubForceLimit = 0.3;
            Assert.That(HubLimit.Of(drive, material).Pull, Is.EqualTo(0.3));
            drive = new DriveParameters { Kind = Drive.Hold };
            Assert.That(HubLimit.Of(drive, material).IsLimited, Is.False, "nothing moves a hub");
        }

        // Of the two forces on either side of the jump it has the smaller one, whichever the search ends at.
        [TestCase(0.2, -0.1)]
        [TestCase(0.1, -0.2)]
        [TestCase(0.07, -5.0)]
        public void HubWhoseForceJumpsPastItsLimit_HasTheLeastOfThem_AndIsSaidTo(double ahead, double behind)
        {
            var slip = new HubSlip(HubLimit.OfForce(Limit), Shortest);
            double least = Math.Min(Math.Abs(ahead), Math.Abs(behind));
            for (int step = 0; step < 2; step++)
            {
                slip.Begin(Asked, 0.0);
                double moved = Asked;
                int trials = 0;
                while (slip.NeedsAnother(moved, 0.0, moved > 1e-4 ? ahead : behind, false))
                {
                    moved = slip.Displacement ?? Asked;
                    Assert.That(trials++, Is.LessThanOrEqualTo(MaxTrials));
                }
                Assert.That(Math.Abs(moved > 1e-4 ? ahead : behind), Is.EqualTo(least));
                slip.EndStep(moved > 1e-4 ? ahead : behind, 0.1 * (step + 1));
            }
            Assert.That(slip.Record.FindExcess("the wire's hub")!.Value.Text, Does.Contain("the wire's hub had up to")
                .And.Contain("hubForceLimit of 0.05 N"));
            Assert.That(slip.Record.FindExcess("a hub")!.Value.Text, Does.Contain("in 2 of the steps"));
        }

        // What is around it goes another way in the second step, and in the third the hub may go what it is asked.
        [Test]
        public void HubThatSlipped_BeginsBesideWhatIsAroundIt_WhereItWasFound([Values(1e4, 1e6, 1e8)] double stiffness,
            [Values(1.0, -1.0)] double sense)
        {
            var slip = new HubSlip(HubLimit.OfForce(Limit), Shortest);
            int[] trials = new int[3];
            double moved = 0.0;
            for (int step = 0; step < trials.Length; step++)
            {
                double around = step == 1 ? -1e-4 : 1e-4;
                double rest = step == 2 ? sense * Asked : around;
                double Force(double u) => Math.Max(-1.0, Math.Min(1.0, stiffness * (u - rest)));
                var kept = new Snapshot();
                slip.Serialize(kept);
                slip = new HubSlip(HubLimit.OfForce(Limit), Shortest);
                slip.Serialize(kept.ToRead());
                slip.BeginStep();
                slip.Begin(sense * Asked, around);
                do
                {
                    moved = slip.Displacement ?? sense * Asked;
                    trials[step]++;
                }
                while (slip.NeedsAnother(moved, around, Force(moved), false));
                slip.EndStep(Force(moved), 0.0);
                Assert.That(Math.Abs(Force(moved)), Is.LessThanOrEqualTo(Limit));
                Assert.That(moved, Is.EqualTo(step == 2 ? sense * Asked : rest + sense * Limit / stiffness)
                    .Within(0.0201 * Limit / stiffness));
            }
            TestContext.WriteLine(string.Join(", ", trials));
            Assert.That(trials[1], Is.LessThanOrEqualTo(2));
            Assert.That(trials[2], Is.LessThan(MaxTrials / 2));
        }
    }
}
