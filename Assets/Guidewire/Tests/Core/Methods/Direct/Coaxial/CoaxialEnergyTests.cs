using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Energy of runs of a wire in a catheter, and the forces of their hubs, which are its
    /// differences.</summary>
    public sealed class CoaxialEnergyTests
    {
        [Test]
        public void HubForcesAndTorques_AreTheDifferencesOfTheEnergy()
        {
            CoaxialStep run = Swinging(Integrator.ImplicitEuler, 0.31, out _, out RodState state);
            var forces = new LargestError();
            var torques = new LargestError();
            for (int k = 0; k < 60; k++)
            {
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                CoaxialRecord record = run.Coaxial()!;
                forces.Add(EnergySlopes.Difference(1e-6, d => EnergyAt(run, d, 0.0)), record.WireForce);
                torques.Add(EnergySlopes.Difference(1e-5, d => EnergyAt(run, 0.0, d)), record.WireTorque);
            }
            forces.AssertBelow(1e-6, 0.02);
            torques.AssertBelow(1e-6, 1e-4);
        }

        [Test]
        public void EveryStepOfImplicitEuler_ClosesItsEnergy([Values(0.1, 0.31, 1.3)] double perStep)
        {
            // With z = (x, q, twist, hubs): work of the hubs, E'(z1) dz of them; change of T + E; drag, a h w.M w; and
            // the scheme's own, 1/2 |dv|^2_M + E(z0) - E(z1) - E'(z1)(z0 - z1), each by its own formula. The wire's
            // spin in the catheter is a part of v and T, and has the drag of the lumen.
            CoaxialStep run = Swinging(Integrator.ImplicitEuler, perStep, out SimulationParameters parameters,
                out RodState state);
            double h = parameters.Method.TimeStep;
            double worst = 0.0;
            double peak = 0.0;
            int steps = 0;
            for (int k = 0; k < 60; k++)
            {
                RodDynamics motion = run.Dynamics;
                var before = new RodShape(motion.Shape.ElementCount, 1);
                before.CopyFrom(motion.Shape);
                var v = (Vector3d[])motion.Velocities.Clone();
                var w = (Vector3d[])motion.Spins.Clone();
                var rates = (double[])motion.TwistRates.Clone();
                RodMass mass = motion.Terms.Mass;
                Hubs old = new Hubs(run);
                double energy = EnergyAt(run, 0.0, 0.0);
                double kinetic = motion.KineticEnergy;
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                if (run.Dynamics != motion)
                {
                    continue;   // a node came in
                }
                steps++;
                Hubs now = new Hubs(run);
                double onHubs = now.WorkSince(old);
                double energyNow = EnergyAt(run, 0.0, 0.0);
                double kineticNow = motion.KineticEnergy;
                double drag = 2.0 * parameters.Material.MassDamping * h * kineticNow;
                for (int i = 0; i < v.Length; i++)
                {
                    v[i] = motion.Velocities[i] - v[i];
                }
                for (int j = 0; j < w.Length; j++)
                {
                    w[j] = motion.Spins[j] - w[j];
                    rates[j] = motion.TwistRates[j] - rates[j];
                    drag += j >= run.Rod.LumenDrag.Length ? 0.0
                        : h * run.Rod.LumenDrag[j] * motion.TwistRates[j] * motion.TwistRates[j];
                }
                double slope = EnergySlopes.Along(motion, before) - OnHubsByEnergy(run, now, old);
                double scheme = mass.KineticEnergy(v, w) + InnerSpin.KineticEnergy(run.Rod, w, rates) + energy
                    - energyNow - slope;
                double left = onHubs - (energyNow - energy) - (kineticNow - kinetic) - drag - scheme;
                worst = Math.Max(worst, Math.Abs(left));
                peak = Math.Max(peak, energyNow + kineticNow);
            }
            TestContext.WriteLine("{0:G3} of {1:G3} J in {2} steps", worst, peak, steps);
            Assert.That(steps, Is.GreaterThan(25));
            Assert.That(peak, Is.GreaterThan(1e-3));
            // The spin has some 1e-7 of it.
            Assert.That(worst, Is.LessThan(1e-9 * peak));
        }

        // Work of the hubs by their forces at each step's end; nodes come in and go, too.
        [Test]
        public void EnergyIsNeverGained_AtAnySpeed([Values(0.03, 0.1, 0.31, 1.3, 3.7, -0.31, -1.3)] double perStep)
        {
            CoaxialStep run = Swinging(Integrator.ImplicitEuler, perStep, out _, out RodState state);
            double start = EnergyAt(run, 0.0, 0.0) + run.Dynamics.KineticEnergy;
            double work = 0.0;
            double gained = 0.0;
            double peak = start;
            int rebuilt = 0;
            for (int k = 0; k < 60; k++)
            {
                RodDynamics motion = run.Dynamics;
                Hubs old = new Hubs(run);
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                rebuilt += run.Dynamics == motion ? 0 : 1;
                work += new Hubs(run).WorkSince(old);
                double energy = EnergyAt(run, 0.0, 0.0) + run.Dynamics.KineticEnergy;
                peak = Math.Max(peak, energy);
                gained = Math.Max(gained, energy - start - work);
            }
            TestContext.WriteLine("{0:G3} of {1:G3} J, {2} times rebuilt", gained, peak, rebuilt);
            Assert.That(peak, Is.GreaterThan(1e-3));
            Assert.That(rebuilt, Is.GreaterThan(0));
            Assert.That(gained, Is.LessThan(0.01 * peak));
        }

        [Test]
        public void ClosedCycleOfBothHubs_TakesNoWork()
        {
            // Slowly, in steps of 0.1 of an element, while no border of the one's pieces passes one of the other's, for
            // there a force jumps: trapezoids of forces and torques over one cycle of both hubs.
            double one = CycleWork(0.1, out double peak);
            double two = CycleWork(0.2, out _);
            TestContext.WriteLine("{0:G3} and {1:G3} of {2:G3} J", one, two, peak);
            Assert.That(peak, Is.GreaterThan(2e-5));
            Assert.That(Math.Abs(one), Is.LessThan(1e-4 * peak));
            Assert.That(Math.Abs(one), Is.LessThan(0.35 * Math.Abs(two)));
        }

        // All energy with the wire's hub this much on, m, and turned on, radians.
        private static double EnergyAt(CoaxialStep run, double on, double turn)
        {
            var bending = (CoaxialBendTwist)run.Dynamics.Terms.Bending;
            double lead = bending.Joints.LeadOf(1);
            double twist = bending.HubTwist[1];
            run.Rod.SetHubs(new[] { 0.0, lead - on }, 0.0);
            bending.HubTwist[1] = twist + turn;
            double energy = run.Dynamics.Terms.Potential(run.Dynamics.Shape);
            run.Rod.SetHubs(new[] { 0.0, lead }, 0.0);
            bending.HubTwist[1] = twist;
            return energy;
        }

        // E'(z1) (z1 - z0) of the hubs but for the first node, which is among the coordinates.
        private static double OnHubsByEnergy(CoaxialStep run, Hubs now, Hubs old)
        {
            double move = now.WireInsertion - old.WireInsertion - (now.Insertion - old.Insertion);
            return now.WireForce * move + now.WireTorque * (now.WireTurn - old.WireTurn)
                + now.Torque * (now.Turn - old.Turn);
        }

        private readonly struct Hubs
        {
            public readonly double Force, Torque, Insertion, Turn;
            public readonly double WireForce, WireTorque, WireInsertion, WireTurn;

            public Hubs(CoaxialStep run)
            {
                CoaxialRecord record = run.Coaxial()!;
                HubRecord hub = run.Hub()!;
                Force = record.Force;
                Torque = record.Torque;
                Insertion = record.Insertion;
                Turn = record.Turn;
                WireForce = hub.Force;
                WireTorque = hub.Torque;
                WireInsertion = hub.Insertion;
                WireTurn = hub.Turn;
            }

            // J, by the forces of now.
            public double WorkSince(Hubs old)
            {
                return Force * (Insertion - old.Insertion) + Torque * (Turn - old.Turn)
                    + WireForce * (WireInsertion - old.WireInsertion) + WireTorque * (WireTurn - old.WireTurn);
            }
        }

        private static double CycleWork(double perStep, out double peak)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Material.Sections[0].From = 312.0;
            parameters.Material.Sections[0].RestCurvature = new Vector3d(10.0, 0.0, 0.0);
            parameters.Scene.Catheters[0].Material.Sections[0].RestCurvature = new Vector3d(10.0, 4.0, 0.0);
            return CoaxialScenes.CycleWork(parameters, perStep, out peak);
        }

        // Both hubs move and turn in steps in which the instruments swing.
        private static CoaxialStep Swinging(Integrator integrator, double perStep, out SimulationParameters parameters,
            out RodState state)
        {
            parameters = CoaxialScenes.Pair(integrator);
            parameters.Material.MassDamping = 20.0;
            parameters.Method.TimeStep = 2e-3;
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Method.MaxSimulationSteps = 60;
            parameters.Drive.InsertionSpeed = Math.Min(perStep * 0.01 / parameters.Method.TimeStep, 0.8);
            parameters.Drive.RotationSpeed = 5.0;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = 0.4 * parameters.Drive.InsertionSpeed;
            parameters.Scene.Catheters[0].Drive.RotationSpeed = -3.0;
            MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
            state = start.State;
            return (CoaxialStep)start.Stepper;
        }
    }
}
