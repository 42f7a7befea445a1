using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Wires with a material pushed, pulled and turned hard in vessels of many kinds: none is ever outside,
    /// and each run ends as asked or says why not.</summary>
    /// <remarks>The environment variable GUIDEWIRE_WALL_PUSHES = FIRST:COUNT asks for other pushes than the first
    /// 80.</remarks>
    internal sealed class RandomWallPushTests
    {
        [Test]
        public void Wire_IsNeverOutside_AndEveryRunHasAnEnd()
        {
            Check(seed => new RandomWallPush(seed));
        }

        [Test]
        public void WireWithASoftBentTip_IsNeverOutside_AndEveryRunHasAnEnd()
        {
            Check(seed => new RandomWallPush(seed, scene => WithSoftTip(scene, seed)));
        }

        // The last 5 to 30 % of the wire down to 1/200 as stiff as the rest, bent at rest to a radius of 7 mm or more,
        // in elements of 3 mm, because it folds.
        private static SimulationParameters WithSoftTip(SimulationParameters scene, int seed)
        {
            var random = new RandomGeometry(seed);
            double length = scene.Scene.GuidewireLength;
            double young = scene.Material.YoungsModulus * Math.Pow(200.0, -random.Number(0.0, 1.0));
            double from = (1.0 - random.Number(0.05, 0.3)) * length;
            int elements = (int)Math.Ceiling((length - from) / 3.0);
            scene.Scene.NumberRodElements += elements;
            scene.Material.Sections = new[]
            {
                new WireSection
                {
                    From = from,
                    To = length,
                    NumberRodElements = elements,
                    YoungsModulus = young,
                    ShearModulus = 0.38 * young,
                    RestCurvature = new Vector3d(random.Number(-100.0, 100.0), random.Number(-100.0, 100.0), 0.0),
                },
            };
            return scene;
        }

        private static void Check(Func<int, RandomWallPush> start)
        {
            (int first, int runs) = RandomGeometry.Asked("GUIDEWIRE_WALL_PUSHES");
            runs = runs > 0 ? runs : RandomGeometry.Cases(80, 40);
            var worst = new List<string>();
            var refused = new List<string>();
            var delivered = new List<double>();
            int failed = 0;
            int free = 0;
            int freeFailed = 0;
            int outside = 0;
            foreach (RandomWallPush push in RandomGeometry.Runs(first, runs, start, refused))
            {
                bool isOutside = push.Contacts.Passages > 0 || push.PointsOutside > 0 || push.Deepest > 0.0
                    || push.Contacts.MaxPenetration > 0.0 || !push.IsFinite;
                bool hasEnd = push.Simulation.Outcome == Outcome.Finished
                    || (push.Simulation.Outcome == Outcome.Failed && push.Simulation.Reason.Length > 0);
                outside += isOutside || !hasEnd ? 1 : 0;
                bool hasFailed = push.Simulation.Outcome == Outcome.Failed;
                failed += hasFailed ? 1 : 0;
                free += push.IsBlocked ? 0 : 1;
                freeFailed += hasFailed && !push.IsBlocked ? 1 : 0;
                delivered.Add(1.0 - push.Contacts.DriveShortfall / push.Contacts.DriveAsked);
                if (isOutside || push.Simulation.Outcome != Outcome.Finished)
                {
                    worst.Add(push.ToString());
                }
            }
            delivered.Sort();
            TestContext.WriteLine(failed + " of " + runs + " failed, " + freeFailed + " of the " + free
                + " that nothing stands in the way of; median push " + delivered[delivered.Count / 2]);
            worst.AddRange(refused);
            foreach (string line in worst)
            {
                TestContext.WriteLine(line);
            }
            Assert.That(outside + refused.Count, Is.Zero, "runs with a wire outside, or without an end");
            Assert.That(failed, Is.LessThanOrEqualTo(0.005 * runs));
            Assert.That(freeFailed, Is.LessThanOrEqualTo(0.001 * free));
            Assert.That(delivered[delivered.Count / 2], Is.GreaterThanOrEqualTo(0.95));
        }

        /// <summary>An obstacle's face under a parallel element; edges that hardly bulge under the tip's element; a way
        /// of one and a half elements a step out of an open rim.</summary>
        [TestCase(39)]
        [TestCase(1603)]
        [TestCase(1754)]
        [TestCase(1135)]
        public void PushesThatOnceWentWrong_Finish(int seed)
        {
            if (seed != 1754)
            {
                Rods.OnlyInFull("1754, and the fortieth part of the campaigns above");
            }
            AssertGoesWell(new RandomWallPush(seed));
        }

        /// <summary>A wire that comes out of a mesh tube, whose tip bends back and meets the tube from
        /// outside.</summary>
        [TestCase(120599)]
        public void PushesWithASoftBentTipThatOnceWentWrong_Finish(int seed)
        {
            AssertGoesWell(new RandomWallPush(seed, scene => WithSoftTip(scene, seed)));
        }

        private static void AssertGoesWell(RandomWallPush push)
        {
            Assert.That(push.Simulation.Outcome, Is.EqualTo(Outcome.Finished), push.ToString());
            Assert.That(push.Contacts.Passages, Is.EqualTo(0), push.ToString());
            Assert.That(push.PointsOutside, Is.EqualTo(0), push.ToString());
            Assert.That(push.Deepest, Is.EqualTo(0.0), push.ToString());
            Assert.That(push.Contacts.MaxPenetration, Is.LessThanOrEqualTo(0.0), push.ToString());
        }
    }
}
