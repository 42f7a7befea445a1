using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Energy of runs of three coaxial instruments, and the forces of their hubs, which are its differences:
    /// as those of two (<see cref="CoaxialEnergyTests"/>).</summary>
    public sealed class ThreeEnergyTests
    {
        [Test]
        public void HubForcesAndTorques_AreTheDifferencesOfTheEnergy()
        {
            CoaxialStep run = Swinging(Integrator.ImplicitEuler, 0.31, out _, out RodState state);
            var forces = new LargestError();
            var torques = new LargestError();
            for (int k = 0; k < 40; k++)
            {
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                CoaxialRecord record = run.Coaxial()!;
                double[] force = { 0.0, record.Inside!.Force, record.WireForce };
                double[] torque = { 0.0, record.Inside.Torque, record.WireTorque };
                for (int i = 1; i < 3; i++)
                {
                    forces.Add(EnergySlopes.Difference(1e-6, d => EnergyAt(run, i, d, 0.0)), force[i]);
                    torques.Add(EnergySlopes.Difference(1e-5, d => EnergyAt(run, i, 0.0, d)), torque[i]);
                }
            }
            forces.AssertBelow(1e-6, 0.02);
            torques.AssertBelow(1e-6, 1e-4);
        }

        // Each step by the scheme's own dissipation, as of two instruments; the drag of the innermost one goes with its
        // rate against that around it.
        [Test]
        public void EveryStepOfImplicitEuler_ClosesItsEnergy([Values(0.02, 0.15)] double perStep)
        {
            CoaxialStep run = Swinging(Integrator.ImplicitEuler, perStep, out SimulationParameters parameters,
                out RodState state);
            double h = parameters.Method.TimeStep;
            double worst = 0.0;
            double peak = 0.0;
            int steps = 0;
            for (int k = 0; k < 60; k++)
            {
                RodDynamics motion = run.Dynamics;
                var before = new RodShape(motion.Shape.ElementCount, 2);
                before.CopyFrom(motion.Shape);
                var v = (Vector3d[])motion.Velocities.Clone();
                var w = (Vector3d[])motion.Spins.Clone();
                var rates = (double[])motion.TwistRates.Clone();
                Hub[] old = Hubs(run);
                double energy = EnergyAt(run, 1, 0.0, 0.0);
                double kinetic = motion.KineticEnergy;
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                if (run.Dynamics != motion)
                {
                    continue;   // a node came in
                }
                steps++;
                Hub[] now = Hubs(run);
                double energyNow = EnergyAt(run, 1, 0.0, 0.0);
                double kineticNow = motion.KineticEnergy;
                double drag = 2.0 * parameters.Material.MassDamping * h * kineticNow + h * DragPower(run);
                for (int i = 0; i < v.Length; i++)
                {
                    v[i] = motion.Velocities[i] - v[i];
                }
                for (int j = 0; j < w.Length; j++)
                {
                    w[j] = motion.Spins[j] - w[j];
                }
                for (int j = 0; j < rates.Length; j++)
                {
                    rates[j] = motion.TwistRates[j] - rates[j];
                }
                double onHubs = WorkOf(now, old);
                double slope = EnergySlopes.Along(motion, before) - OnHubsByEnergy(now, old);
                double scheme = motion.Terms.Mass.KineticEnergy(v, w) + InnerSpin.KineticEnergy(run.Rod, w, rates)
                    + energy - energyNow - slope;
                double left = onHubs - (energyNow - energy) - (kineticNow - kinetic) - drag - scheme;
                worst = Math.Max(worst, Math.Abs(left));
                peak = Math.Max(peak, energyNow + kineticNow);
            }
            TestContext.WriteLine("{0:G3} of {1:G3} J in {2} steps", worst, peak, steps);
            Assert.That(steps, Is.GreaterThan(15));
            Assert.That(peak, Is.GreaterThan(1e-3));
            Assert.That(worst, Is.LessThan(1e-9 * peak));
        }

        // The hubs go forth and back: nodes come in and go at both tips.
        [Test]
        public void EnergyIsNeverGained_AtAnySpeed([Values(0.03, 0.15, -0.15, -1.3)] double perStep)
        {
            CoaxialStep run = Swinging(Integrator.ImplicitEuler, perStep, out _, out RodState state);
            double start = EnergyAt(run, 1, 0.0, 0.0) + run.Dynamics.KineticEnergy;
            double work = 0.0;
            double gained = 0.0;
            double peak = start;
            int rebuilt = 0;
            for (int k = 0; k < 60; k++)
            {
                RodDynamics motion = run.Dynamics;
                Hub[] old = Hubs(run);
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                rebuilt += run.Dynamics == motion ? 0 : 1;
                work += WorkOf(Hubs(run), old);
                double energy = EnergyAt(run, 1, 0.0, 0.0) + run.Dynamics.KineticEnergy;
                peak = Math.Max(peak, energy);
                gained = Math.Max(gained, energy - start - work);
            }
            TestContext.WriteLine("{0:G3} of {1:G3} J, {2} times rebuilt", gained, peak, rebuilt);
            Assert.That(peak, Is.GreaterThan(1e-3));
            Assert.That(rebuilt, Is.GreaterThan(0));
            Assert.That(gained, Is.LessThan(0.01 * peak));
        }

        // All energy with an inner hub this much on, m, and turned on, radians.
        private static double EnergyAt(CoaxialStep run, int instrument, double on, double turn)
        {
            var bending = (CoaxialBendTwist)run.Dynamics.Terms.Bending;
            double[] leads = { 0.0, bending.Joints.LeadOf(1), bending.Joints.LeadOf(2) };
            double twist = bending.HubTwist[instrument];
            double lead = leads[instrument];
            leads[instrument] = lead - on;
            run.Rod.SetHubs(leads, 0.0);
            bending.HubTwist[instrument] = twist + turn;
            double energy = run.Dynamics.Terms.Potential(run.Dynamics.Shape);
            leads[instrument] = lead;
            run.Rod.SetHubs(leads, 0.0);
            bending.HubTwist[instrument] = twist;
            return energy;
        }

        // N m rad/s, of the fluid between each two.
        private static double DragPower(CoaxialStep run)
        {
            double[] rate = run.Dynamics.TwistRates;
            double[] drag = run.Rod.LumenDrag;
            int n = rate.Length / 2;
            double power = 0.0;
            for (int j = 0; j < n; j++)
            {
                double between = run.Rod.AroundOf(2, j) == 1 && run.Rod.Joints.CarrierOf(j) == 0
                    ? rate[n + j] - rate[j] : rate[n + j];
                power += drag[j] * rate[j] * rate[j] + drag[n + j] * between * between;
            }
            return power;
        }

        private static Hub[] Hubs(CoaxialStep run)
        {
            CoaxialRecord record = run.Coaxial()!;
            CoaxialRecord inside = record.Inside!;
            HubRecord wire = run.Hub()!;
            return new[]
            {
                new Hub { Force = record.Force, Torque = record.Torque, Insertion = record.Insertion,
                    Turn = record.Turn },
                new Hub { Force = inside.Force, Torque = inside.Torque, Insertion = inside.Insertion,
                    Turn = inside.Turn },
                new Hub { Force = wire.Force, Torque = wire.Torque, Insertion = wire.Insertion, Turn = wire.Turn },
            };
        }

        // J, by the forces of now.
        private static double WorkOf(Hub[] now, Hub[] old)
        {
            double work = 0.0;
            for (int i = 0; i < 3; i++)
            {
                work += now[i].Force * (now[i].Insertion - old[i].Insertion)
                    + now[i].Torque * (now[i].Turn - old[i].Turn);
            }
            return work;
        }

        // E'(z1) (z1 - z0) of the hubs but for the first node, which is among the coordinates.
        private static double OnHubsByEnergy(Hub[] now, Hub[] old)
        {
            double outer = now[0].Insertion - old[0].Insertion;
            double work = now[0].Torque * (now[0].Turn - old[0].Turn);
            for (int i = 1; i < 3; i++)
            {
                work += now[i].Force * (now[i].Insertion - old[i].Insertion - outer)
                    + now[i].Torque * (now[i].Turn - old[i].Turn);
            }
            return work;
        }

        // All hubs move and turn in steps in which the instruments swing.
        private static CoaxialStep Swinging(Integrator integrator, double perStep, out SimulationParameters parameters,
            out RodState state)
        {
            parameters = CoaxialScenes.Three(integrator);
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Method.MaxSimulationSteps = 60;
            parameters.Drive.InsertionSpeed = Math.Min(perStep * 0.01 / parameters.Method.TimeStep, 0.8);
            parameters.Drive.RotationSpeed = 5.0;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = 0.25 * parameters.Drive.InsertionSpeed;
            parameters.Scene.Catheters[0].Drive.RotationSpeed = -3.0;
            parameters.Scene.Catheters[1].Drive.InsertionSpeed = 0.5 * parameters.Drive.InsertionSpeed;
            parameters.Scene.Catheters[1].Drive.RotationSpeed = 2.0;
            MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
            state = start.State;
            return (CoaxialStep)start.Stepper;
        }

        private struct Hub
        {
            public double Force, Torque, Insertion, Turn;
        }
    }
}
