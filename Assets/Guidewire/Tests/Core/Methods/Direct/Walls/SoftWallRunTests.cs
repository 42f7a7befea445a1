using System;
using System.Globalization;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Runs between soft walls: energy, snapshots, and changes while they go on.</summary>
    public sealed class SoftWallRunTests
    {
        private const int Steps = 60;          // down, and as many up
        private const double Depth = 3e-4;     // m
        private const double Still = 1.0;      // s a step: so slow that nothing moves by inertia

        /// <summary>A cantilever is pressed onto a soft floor by its hub, and lifted again.</summary>
        [Test]
        public void Cycle_LeavesNothing_AndItsEnergyIsTheWorkOfTheHub([Values(0.0, 1e-2, 1.0)] double limit)
        {
            Simulation simulation = Simulation.Create(Pressed(2e3, limit));
            double work = 0.0;
            double force = 0.0;
            double bottom = 0.0;
            double start = EnergyOf(simulation);
            for (int k = 1; k <= 2 * Steps; k++)
            {
                simulation.Step();
                double now = simulation.Contacts!.ReactionAtEnd.Y;
                work -= 0.5 * (force + now) * (k <= Steps ? Depth : -Depth) / Steps;
                force = now;
                if (k == Steps)
                {
                    bottom = EnergyOf(simulation) - start;
                    Assert.That(bottom, Is.EqualTo(work).Within(2e-3 * bottom), "closes at the bottom");
                    Assert.That(simulation.Contacts.LargestDisplacement, Is.GreaterThan(1e-4), "the wall gives way");
                }
            }
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Finished), simulation.Reason);
            Assert.That(EnergyOf(simulation) - start, Is.EqualTo(0.0).Within(1e-6 * bottom), "nothing is left");
            Assert.That(work, Is.EqualTo(0.0).Within(1e-3 * bottom), "the way up gives back the work");
            Assert.That(simulation.Contacts!.MaxPenetration, Is.EqualTo(0.0));
        }

        [Test]
        public void Displacements_AreThoseOfTheContacts()
        {
            Simulation simulation = Simulation.Create(Pressed(2e3, 0.0));
            for (int k = 0; k < Steps; k++)
            {
                simulation.Step();
            }
            ContactRecord contacts = simulation.Contacts!;
            double largest = 0.0;
            for (int i = 0; i < simulation.State.SphereCount; i++)
            {
                largest = Math.Max(largest, -1e-3 * simulation.State.Positions[i].Y);
            }
            Assert.That(contacts.LargestDisplacement, Is.EqualTo(largest).Within(1e-12));
            Assert.That(contacts.MeanDisplacement, Is.GreaterThan(0.0).And.LessThan(largest));
            Vector3d farthest = Array.Find(contacts.Displacements, one => one.Length > largest - 1e-12);
            Assert.That((farthest + largest * Vector3d.UnitY).Length, Is.LessThan(1e-12), "out of the lumen");
            Assert.That(simulation.Report()!.Extremes!.WallDisplacement, Is.EqualTo(largest).Within(1e-12));
        }

        [Test]
        public void WhereTheWireBecomesThinner_NoLimitIsExceeded()
        {
            SimulationParameters parameters = Pressed(50.0, 0.0);
            parameters.Material.Sections = new[] { new WireSection { From = 150.0, To = 300.0, WireRadius = 0.2e-3 } };
            Simulation simulation = Simulation.Create(parameters);
            for (int k = 0; k < Steps; k++)
            {
                simulation.Step();
            }
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running), simulation.Reason);
            Assert.That(simulation.Report()!.Extremes!.LimitShare, Is.InRange(0.5, 1.0));
        }

        [Test]
        public void Restored_ItGoesOnWithTheSameBits_AndAChangedStiffnessCounts()
        {
            SimulationParameters parameters = Pressed(2e3, 0.0);
            Simulation simulation = Simulation.Create(parameters);
            for (int k = 0; k < Steps; k++)
            {
                simulation.Step();
            }
            Simulation restored = Simulation.Restore(parameters, simulation.Save());
            Assert.That(restored.Contacts!.Displacements, Is.EqualTo(simulation.Contacts!.Displacements));
            SimulationParameters softer = Pressed(1e3, 0.0);
            Simulation changed = simulation.Continue(softer);
            SimulationParameters hard = Pressed(2e3, 0.0);
            hard.Scene.Walls = WallScenes.Floor(-0.5 - 1e3 * Depth);
            Simulation rigid = simulation.Continue(hard);
            simulation.Step();
            restored.Step();
            changed.Step();
            rigid.Step();
            Assert.That(restored.State.Positions, Is.EqualTo(simulation.State.Positions));
            Assert.That(rigid.Outcome, Is.EqualTo(Outcome.Running), rigid.Reason);
            Assert.That(changed.Contacts!.Total.Y, Is.LessThan(0.7 * simulation.Contacts.Total.Y));
        }

        // A load on a node is spread over (4 EI/K)^(1/4), with an error of a quarter of the square of an element over
        // it.
        [Test]
        public void ElementsTooLongForTheWall_AreToldTheLengthThatIsOnePercentOff()
        {
            SimulationParameters parameters = Pressed(1e8, 0.0);
            double spread = Math.Pow(4.0 * parameters.Material.YoungsModulus * Math.PI / 4.0 * Math.Pow(0.5e-3, 4.0)
                / 1e8, 0.25);
            string warning = string.Join("; ", SoftWallConflict.Warnings(parameters));
            Assert.That(warning, Does.Contain("elements of 0.015 m are longer than " + spread.ToString("G3",
                CultureInfo.InvariantCulture) + " m"));
            Assert.That(warning, Does.Contain("with " + (Math.Sqrt(4.0 * 0.01) * spread).ToString("G3",
                CultureInfo.InvariantCulture) + " m, by more numberRodElements"));
        }

        private static double EnergyOf(Simulation simulation)
        {
            Vector3d energies = simulation.Energies()!.Value;
            return energies.X + energies.Y + energies.Z;
        }

        private static SimulationParameters Pressed(double stiffness, double limit)
        {
            SimulationParameters parameters = WallScenes.Wire(20, 0.5e-3);
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.Walls = WallScenes.Floor(-0.5);
            parameters.Scene.Walls[0].Softness = new WallSoftness("vessel", stiffness, limit);
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.DisplacementDirection = -Vector3d.UnitY;
            var times = new[] { 0.0, Steps * Still, 2.0 * Steps * Still };
            parameters.Drive.Table = new DriveTable(new TimeTable(times, new[] { 0.0, Depth, 0.0 }),
                new TimeTable(times, new double[3]));
            parameters.Method.TimeStep = Still;
            parameters.Method.SolverTolerance = 1e-9;
            parameters.Method.MaxSimulationSteps = 2 * Steps;
            parameters.Material.MassDamping = 1.0;
            return parameters;
        }
    }
}
