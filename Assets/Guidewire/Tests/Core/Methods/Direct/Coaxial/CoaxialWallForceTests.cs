using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Forces of walls on each of several instruments in one another.</summary>
    internal sealed class CoaxialWallForceTests
    {
        [TestCase(false)]
        [TestCase(true)]
        public void ForcesOnAllInstruments_AddUpToTheWalls_AndNoneIsOnWhatIsInside(bool isSoft)
        {
            SimulationParameters parameters = Scene(isSoft);
            Simulation run = Simulation.Create(parameters);
            for (int k = 0; k < 160; k++)
            {
                run.Step();
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            Vector3d[] wire = run.Contacts!.Forces;
            Vector3d[][] others = run.Catheters().Select(one => one.ContactForces).ToArray();
            Vector3d sum = others.Append(wire).SelectMany(forces => forces)
                .Aggregate(Vector3d.Zero, (total, force) => total + force);
            Assert.That((sum - run.Contacts.Total).Length, Is.LessThan(1e-9));
            Assert.That(others.Append(wire), Is.All.Matches<Vector3d[]>(
                forces => forces.Any(force => force.Length > 1e-3)), "each is touched");

            // Nodes before the hub of what is around, and behind its tip, are not seen by walls.
            Vector3d tip = run.Catheters()[others.Length - 1].Positions[^1];
            int covered = Nearest(run.State.Positions, tip) - 1;
            Assert.That(run.Catheters()[others.Length - 1].Extension, Is.GreaterThan(0.0));
            Assert.That(wire.Take(covered), Is.All.EqualTo(Vector3d.Zero));
            AssertDisplaced(run);
            Simulation again = Simulation.Restore(parameters, run.Save());
            Assert.That(again.Contacts!.Forces, Is.EqualTo(wire));
            Assert.That(again.Catheters().Select(one => one.ContactForces), Is.EqualTo(others));
            Assert.That(SoftWallDisplacements.Of(again), Is.EqualTo(SoftWallDisplacements.Of(run)));
        }

        // All three are pushed into an arch, each so far that its tip is in the bend.
        private static SimulationParameters Scene(bool isSoft)
        {
            SimulationParameters parameters = CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Scene.GuidewireOffset = -400.0;
            TubeShape arch = WallScenes.ArchTube(40);
            arch.Softness = isSoft ? new WallSoftness("wall", 1e6) : null;
            parameters.Scene.Walls = new ContactShape[] { arch };
            parameters.Drive.Steering = new Steering { Push = 0.5 };
            parameters.Scene.Catheters[1].Drive.Steering = new Steering { Push = 0.75 };
            parameters.Scene.Catheters[0].Drive.Steering = new Steering { Push = 0.9 };
            return parameters;
        }

        // Walls that give way do so at the elements that they press on, against the force there.
        private static void AssertDisplaced(Simulation run)
        {
            Vector3d[][] displaced = SoftWallDisplacements.Of(run).ToArray();
            if (displaced.Length == 0)
            {
                return;    // rigid
            }
            Vector3d[][] forces = run.Catheters().Select(one => one.ContactForces).Prepend(run.Contacts!.Forces)
                .ToArray();
            Assert.That(displaced.Select(one => one.Length), Is.EqualTo(forces.Select(one => one.Length - 1)));
            Assert.That(displaced.SelectMany(one => one).Max(one => one.Length),
                Is.EqualTo(run.Contacts!.LargestDisplacement).Within(1e-12));
            for (int k = 0; k < displaced.Length; k++)
            {
                for (int j = 0; j < displaced[k].Length; j++)
                {
                    bool isAtTip = k != 1 && forces[k][j] == Vector3d.Zero;    // a tip around it has the force
                    Assert.That(displaced[k][j] == Vector3d.Zero || isAtTip
                        || Vector3d.Dot(displaced[k][j], forces[k][j] + forces[k][j + 1]) < 0.0, k + ", " + j);
                }
            }
        }

        private static int Nearest(Vector3d[] points, Vector3d point) =>
            Enumerable.Range(0, points.Length).OrderBy(i => Vector3d.Distance(points[i], point)).First();
    }
}
