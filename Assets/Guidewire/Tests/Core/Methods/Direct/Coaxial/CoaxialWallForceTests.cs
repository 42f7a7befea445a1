using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Forces of walls on each of several instruments in one another.</summary>
    internal sealed class CoaxialWallForceTests
    {
        [TestCase(false)]
        [TestCase(true)]
        public void ForcesOnAllInstruments_AddUpToTheWalls_AndNoneIsOnWhatIsInside(bool hasOuter)
        {
            if (!hasOuter)
            {
                Rods.OnlyInFull("two catheters around the wire");
            }
            int wires = 0;
            int catheters = 0;
            // Of pushes 6 to 9 most end with a force on the node where one instrument comes out of another.
            int runs = RandomGeometry.Cases(12, 3);
            int first = Rods.InFull ? 0 : 6;
            for (int seed = first; seed < first + runs; seed++)
            {
                var push = new RandomCoaxialPush(seed, hasOuter: hasOuter, isSoft: seed % 2 == 1);
                Simulation run = push.Simulation;
                Vector3d[] wire = push.Contacts.Forces;
                Vector3d[][] others = run.Catheters().Select(one => one.ContactForces).ToArray();
                Vector3d sum = others.Append(wire).SelectMany(forces => forces)
                    .Aggregate(Vector3d.Zero, (total, force) => total + force);
                Assert.That((sum - push.Contacts.Total).Length, Is.LessThan(1e-9), push.ToString());
                wires += wire.Any(force => force.Length > 0.0) ? 1 : 0;
                catheters += others[0].Any(force => force.Length > 0.0) ? 1 : 0;

                // Nodes before the hub of what is around, and behind its tip, are not seen by walls.
                Vector3d tip = run.Catheters()[others.Length - 1].Positions[^1];
                int covered = Nearest(run.State.Positions, tip) - 1;
                if (run.Catheters()[others.Length - 1].Extension > 0.0)
                {
                    Assert.That(wire.Take(covered), Is.All.EqualTo(Vector3d.Zero), push.ToString());
                }
                AssertDisplaced(run, push.ToString());
                Simulation again = Simulation.Restore(push.Parameters, run.Save());
                Assert.That(again.Contacts!.Forces, Is.EqualTo(wire));
                Assert.That(again.Catheters().Select(one => one.ContactForces), Is.EqualTo(others));
                Assert.That(SoftWallDisplacements.Of(again),
                    Is.EqualTo(SoftWallDisplacements.Of(run)));
            }
            Assert.That(wires, Is.GreaterThan(runs / 6), "runs whose wire a wall touches at the end");
            Assert.That(catheters, Is.GreaterThan(runs / 6), "runs whose outermost catheter a wall touches");
        }

        // Walls that give way do so at the elements that they press on, against the force there.
        private static void AssertDisplaced(Simulation run, string name)
        {
            Vector3d[][] displaced = SoftWallDisplacements.Of(run).ToArray();
            if (displaced.Length == 0)
            {
                return;    // rigid
            }
            Vector3d[][] forces = run.Catheters().Select(one => one.ContactForces).Prepend(run.Contacts!.Forces)
                .ToArray();
            Assert.That(displaced.Select(one => one.Length), Is.EqualTo(forces.Select(one => one.Length - 1)), name);
            Assert.That(displaced.SelectMany(one => one).Max(one => one.Length),
                Is.EqualTo(run.Contacts!.LargestDisplacement).Within(1e-12), name);
            for (int k = 0; k < displaced.Length; k++)
            {
                for (int j = 0; j < displaced[k].Length; j++)
                {
                    bool isAtTip = k != 1 && forces[k][j] == Vector3d.Zero;    // a tip around it has the force
                    Assert.That(displaced[k][j] == Vector3d.Zero || isAtTip
                        || Vector3d.Dot(displaced[k][j], forces[k][j] + forces[k][j + 1]) < 0.0, name + ", " + j);
                }
            }
        }

        private static int Nearest(Vector3d[] points, Vector3d point)
        {
            return Enumerable.Range(0, points.Length).OrderBy(i => Vector3d.Distance(points[i], point)).First();
        }
    }
}
