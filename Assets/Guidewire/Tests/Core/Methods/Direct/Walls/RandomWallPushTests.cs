using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Pushes of wires with a material that a campaign once found wrong. Campaigns are Python's, whose judge
    /// shares no code with Core.</summary>
    internal sealed class RandomWallPushTests
    {
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
                Rods.OnlyInFull("1754, and the pushes of test_random_pushes.py");
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
