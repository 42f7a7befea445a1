using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Wires with compliance (xpbd) pushed, pulled and turned hard in vessels of many kinds: none passes a
    /// wall, and each run ends as asked or says why not.</summary>
    /// <remarks>The environment variable GUIDEWIRE_COMPLIANT_PUSHES = FIRST:COUNT asks for other pushes than the first
    /// 100.</remarks>
    internal sealed class CompliantPushTests
    {
        [Test]
        [Category("Long")]
        public void Wire_PassesNoWall_AndEveryRunHasAnEnd()
        {
            (int first, int runs) = RandomGeometry.Asked("GUIDEWIRE_COMPLIANT_PUSHES");
            if (runs == 0)
            {
                Rods.OnlyInFull("the random pushes of test_random_pushes.py have xpbd, too");
                runs = 100;
            }
            int outside = 0;
            int lost = 0;
            int deep = 0;
            var notes = new List<string>();
            for (int seed = first; seed < first + runs; seed++)
            {
                var push = new RandomWallPush(seed, Compliant);
                Outcome outcome = push.Simulation.Outcome;
                bool hasEnd = outcome == Outcome.Finished
                    || ((outcome == Outcome.Diverged || outcome == Outcome.Failed)
                        && push.Simulation.Reason.Length > 0);
                bool isOutside = push.Contacts.Passages > 0 || push.PointsOutside > 0 || !push.IsFinite || !hasEnd;
                outside += isOutside ? 1 : 0;
                lost += outcome == Outcome.Finished ? 0 : 1;
                bool isDeep = Math.Max(push.Deepest, push.Contacts.MaxPenetration) > 0.05 * push.Radius;
                deep += isDeep ? 1 : 0;
                if (isOutside || isDeep || outcome != Outcome.Finished)
                {
                    notes.Add(push.ToString());
                }
            }
            TestContext.WriteLine("{0} runs: {1} outside, {2} lost, {3} deeper than 5 % of the radius", runs, outside,
                lost, deep);
            notes.ForEach(TestContext.WriteLine);
            Assert.That(outside, Is.EqualTo(0), "runs with a wire outside, or without an end");
            Assert.That(deep, Is.LessThanOrEqualTo(0.02 * runs));
            Assert.That(lost, Is.LessThanOrEqualTo(0.1 * runs));
        }

        // With a third of the elements and a hundredth of the stiffness substeps are long.
        private static SimulationParameters Compliant(SimulationParameters drawn)
        {
            SimulationParameters scene = drawn.Copy();
            scene.Scene.NumberRodElements = 10 + drawn.Scene.NumberRodElements / 4;
            scene.Method.MaxSimulationSteps = Math.Min(150, drawn.Method.MaxSimulationSteps);
            return WallScenes.Compliant(scene, 1e-2 * drawn.Material.YoungsModulus);
        }
    }
}
