using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Large strains and displacements are requested here, and no instability; energy from nowhere is
    /// one.</summary>
    public sealed class LargeMotionTests
    {
        [TestCase(Solver.Direct, 1, 1e-9)]
        [TestCase(Solver.Xpbd, 10, 1e-4)]
        [TestCase(Solver.Explicit, 1000, 1e-6)]
        public void SoftWire_HoldsItsStrain(Solver solver, int substeps, double tolerance)
        {
            if (solver == Solver.Explicit)
            {
                Rods.OnlyInFull("direct and xpbd");
            }
            // E = 1 MPa under 0.3 N: F/EA = 38.2 %. One sweep a substep lets the end swing by 2e-5. A pull turns the
            // elements of a rod that shears over where F/kGA > 1 + F/EA; here F/kGA = 1.21.
            SimulationParameters parameters = Rods.Clamped(30, solver, 1e-3, solver == Solver.Direct ? 2000 : 300);
            parameters.Material.YoungsModulus = 1e6;
            parameters.Material.ShearModulus = 3.5e5;
            parameters.Method.Substeps = substeps;
            parameters.Scene.TipForce = new Vector3d(0.0, 0.0, 0.3);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            Simulation run = Wires.Finish(parameters);
            double strain = run.State.Positions[30].Z / 300.0 - 1.0;
            Assert.That(strain, Is.EqualTo(0.3 / (1e6 * Rods.Area)).Within(tolerance));
        }

        [TestCase(Solver.Direct, 1, 1e-10)]
        [TestCase(Solver.Xpbd, 1, 5e-3)]
        public void FreeWire_FallsInAParabola(Solver solver, int substeps, double tolerance)
        {
            // 19.6 m in 2 s, 65 wire lengths; implicit Euler, as xpbd has it, falls g t dt/2 farther.
            SimulationParameters parameters = Rods.Clamped(30, solver, 1e-2, 200);
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Method.Substeps = substeps;
            Simulation run = Wires.Finish(parameters);
            double fall = -1e-3 * run.State.Positions[17].Y;
            Assert.That(fall, Is.EqualTo(0.5 * 9.81 * 4.0).Within(tolerance * 0.5 * 9.81 * 4.0 * 1.0001));
        }

        [TestCase(Drive.Displace)]
        [TestCase(Drive.Push)]
        public void WirePushedFar_GoesThere(Drive drive)
        {
            // 10 m/s from the first step on, 4 m in all: 13 wire lengths. Jerked so, the wire bends, and a push follows
            // its first element: the path is as long as asked, its end somewhat nearer.
            SimulationParameters parameters = Rods.Clamped(30, Solver.Direct, 1e-3, 400);
            parameters.Drive.Kind = drive;
            parameters.Drive.DisplacementPerStep = 10.0;
            Simulation run = Simulation.Create(parameters);
            double gone = 0.0;
            while (run.Outcome == Outcome.Running)
            {
                Vector3d before = run.State.Positions[0];
                run.Step();
                gone += Vector3d.Distance(before, run.State.Positions[0]);
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(gone, Is.EqualTo(4000.0).Within(1e-6));
            Assert.That(run.State.Positions[0].Z, Is.EqualTo(4000.0).Within(drive == Drive.Displace ? 1e-6 : 300.0));
            Assert.That(run.State.Positions[30].Z, Is.EqualTo(4300.0).Within(300.0));
        }

        [Test]
        public void EnergyFromNowhere_IsABlowUp_AndSoIsANumberThatIsNone()
        {
            MaterialRod rod = Rods.Wire(10);
            var terms = new RodTerms(rod, new RodSupports());
            RodShape shape = Rods.Straight(rod);
            var velocities = new Vector3d[11];
            var spins = new Vector3d[10];
            velocities[10] = new Vector3d(0.0, 1.0, 0.0);
            var watch = new EnergyMonitor(terms, new FreeInertia(terms.Mass, terms.Supports), shape, velocities, spins,
                new HeldEnds(terms, Rods.Schedule()));
            velocities[10] = new Vector3d(0.0, 0.99 * Math.Sqrt(EnergyMonitor.MinAllowance), 0.0);
            Assert.That(watch.Blowup(), Is.Null);
            velocities[10] = new Vector3d(0.0, 1.01 * Math.Sqrt(EnergyMonitor.MinAllowance), 0.0);
            Assert.That(watch.Blowup(), Does.Contain("energy").And.Contain("step 2"));
            velocities[10] = new Vector3d(0.0, double.NaN, 0.0);
            Assert.That(watch.Blowup(), Does.Contain("no finite"));
        }

        /// <summary>The work put into it is infinite too.</summary>
        [Test]
        public void PushedSoFastThatNoNumberHoldsItsEnergy_AWireHasDiverged()
        {
            Simulation run = Simulation.Create(new SimulationParameters
            {
                Material = { YoungsModulus = 1.0, MassDamping = 1.5 },
                Method = { Solver = Solver.Explicit, MaxSimulationSteps = 60 },
                Drive = { Displacement = 1e300 },
            });
            run.Step();
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Diverged), run.Reason);
            Assert.That(run.Reason, Does.Contain("no finite kinetic energy at step 1"));
        }
    }
}
