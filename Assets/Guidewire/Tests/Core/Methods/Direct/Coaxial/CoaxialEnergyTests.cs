using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Energy of runs of a wire in a catheter or in two, and the forces of their hubs, which are its
    /// differences.</summary>
    public sealed class CoaxialEnergyTests
    {
        [Test]
        public void HubForcesAndTorques_AreTheDifferencesOfTheEnergy([Values(2, 3)] int instruments)
        {
            DirectStep run = Swinging(instruments, 0.31, out _, out RodState state);
            var forces = new LargestError();
            var torques = new LargestError();
            for (int step = 0; step < 60; step++)
            {
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                Hub[] hubs = Hubs(run);
                for (int k = 1; k < instruments; k++)
                {
                    int hub = k;
                    forces.Add(EnergySlopes.Difference(1e-8, d => EnergyAt(run, hub, d, 0.0)), hubs[k].Force);
                    torques.Add(EnergySlopes.Difference(1e-5, d => EnergyAt(run, hub, 0.0, d)), hubs[k].Torque);
                }
            }
            forces.AssertSmall(0.02);
            torques.AssertSmall(1e-4);
        }

        [TestCase(2, 0.1, 25)]
        [TestCase(2, 0.31, 25)]
        [TestCase(2, 1.3, 25)]
        [TestCase(3, 0.02, 15)]
        [TestCase(3, 0.15, 15)]
        [TestCase(2, 0.31, 25, 0.01)]
        [TestCase(2, 0.1, 25, 0.005)]
        [TestCase(3, 0.15, 15, 0.01)]
        public void EveryStepOfImplicitEuler_ClosesItsEnergy(int instruments, double perStep, int fewest,
            double limit = 0.0)
        {
            // With z = (x, q, twist, hubs): work of the hubs, E'(z1) dz of them; change of T + E; drag, a h w.M w; and
            // the scheme's own, 1/2 |dv|^2_M + E(z0) - E(z1) - E'(z1)(z0 - z1), each by its own formula. The
            // spin of what is inside is a part of v and T, and has the drag of the lumen around it. A hub that slips
            // does work over what it went: over what it was asked it would be F times the slip more.
            DirectStep run = Swinging(instruments, perStep, out SimulationParameters parameters,
                out RodState state, limit);
            double h = parameters.Method.TimeStep;
            double worst = 0.0;
            double peak = 0.0;
            double slipped = 0.0;   // J, F times the slip
            int steps = 0;
            for (int k = 0; k < 60; k++)
            {
                RodDynamics motion = run.Dynamics;
                double elements = CoaxialScenes.ElementsOf(run);
                double asked = Asked(run);
                var before = new RodShape(motion.Shape.ElementCount, instruments - 1);
                before.CopyFrom(motion.Shape);
                var v = (Vector3d[])motion.Velocities.Clone();
                var w = (Vector3d[])motion.Spins.Clone();
                var rates = (double[])motion.TwistRates.Clone();
                RodMass mass = motion.Terms.Mass;
                Hub[] old = Hubs(run);
                double energy = EnergyAt(run, 1, 0.0, 0.0);
                double kinetic = motion.KineticEnergy;
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                if (CoaxialScenes.ElementsOf(run) != elements)
                {
                    continue;   // a node came in
                }
                steps++;
                Hub[] now = Hubs(run);
                double onHubs = WorkOf(now, old);
                double slip = Asked(run) - asked - (now[^1].Insertion - old[^1].Insertion);
                slipped += Math.Abs(now[^1].Force * slip);
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
                double slope = EnergySlopes.Along(motion, before) - OnHubsByEnergy(now, old)
                    - (limit > 0.0 ? OnSupport(now, old) : 0.0);
                double scheme = mass.KineticEnergy(v, w) + InnerSpin.KineticEnergy(RodOf(run), w, rates) + energy
                    - energyNow - slope;
                double left = onHubs - (energyNow - energy) - (kineticNow - kinetic) - drag - scheme;
                worst = Math.Max(worst, Math.Abs(left));
                peak = Math.Max(peak, energyNow + kineticNow);
            }
            TestContext.WriteLine("{0:G3} of {1:G3} J in {2} steps, {3:G3} J of slip", worst, peak, steps, slipped);
            Assert.That(slipped, limit > 0.0 ? Is.GreaterThan(5e-6) : Is.Zero);
            Assert.That(steps, Is.GreaterThan(fewest));
            Assert.That(peak, Is.GreaterThan(1e-3));
            // The spin has some 1e-7 of it.
            Assert.That(worst, Is.LessThan(1e-9 * peak));
        }

        // Work of the hubs by their forces at each step's end; nodes come in and go, at each tip.
        [Test]
        public void EnergyIsNeverGained_AtAnySpeed(
            [Values(0.03, 0.1, 0.31, 1.3, 3.7, -0.31, -1.3)] double perStep) => AssertNothingIsGained(2, perStep);

        [Test]
        public void EnergyOfThreeIsNeverGained_AtAnySpeed([Values(0.03, 0.15, -0.15, -1.3)] double perStep) =>
            AssertNothingIsGained(3, perStep);

        private static void AssertNothingIsGained(int instruments, double perStep)
        {
            DirectStep run = Swinging(instruments, perStep, out _, out RodState state);
            double start = EnergyAt(run, 1, 0.0, 0.0) + run.Dynamics.KineticEnergy;
            double work = 0.0;
            double gained = 0.0;
            double peak = start;
            int changed = 0;
            for (int k = 0; k < 60; k++)
            {
                double elements = CoaxialScenes.ElementsOf(run);
                Hub[] old = Hubs(run);
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                changed += CoaxialScenes.ElementsOf(run) == elements ? 0 : 1;
                work += WorkOf(Hubs(run), old);
                double energy = EnergyAt(run, 1, 0.0, 0.0) + run.Dynamics.KineticEnergy;
                peak = Math.Max(peak, energy);
                gained = Math.Max(gained, energy - start - work);
            }
            TestContext.WriteLine("{0:G3} of {1:G3} J, {2} times other elements", gained, peak, changed);
            Assert.That(peak, Is.GreaterThan(1e-3));
            Assert.That(changed, Is.GreaterThan(0));
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

        // All energy with an inner hub this much on, m, and turned on, radians.
        private static double EnergyAt(DirectStep run, int instrument, double on, double turn)
        {
            var bending = (CoaxialBendTwist)run.Dynamics.Terms.Bending;
            var leads = new double[bending.Joints.Count];
            for (int i = 1; i < leads.Length; i++)
            {
                leads[i] = bending.Joints.LeadOf(i);
            }
            double twist = bending.HubTwist[instrument];
            double lead = leads[instrument];
            leads[instrument] = lead - on;
            RodOf(run).SetHubs(leads, 0.0);
            bending.HubTwist[instrument] = twist + turn;
            RodTerms terms = run.Dynamics.Terms;
            double energy = EnergySlopes.OfInstruments(terms, run.Dynamics.Shape)
                + (terms.Walls()?.Spring.Value(run.Dynamics.Shape) ?? 0.0);
            leads[instrument] = lead;
            RodOf(run).SetHubs(leads, 0.0);
            terms.CoaxialLoads!.Place(terms.Loads.Force);
            bending.HubTwist[instrument] = twist;
            return energy;
        }

        // N m rad/s, of the fluid between each two.
        private static double DragPower(DirectStep run)
        {
            CoaxialJoints joints = RodOf(run).Joints;
            double[] rate = run.Dynamics.TwistRates;
            double[] drag = RodOf(run).LumenDrag;
            int n = joints.ElementCount;
            double power = 0.0;
            for (int j = 0; j < joints.InnerCount * n; j++)
            {
                bool isInCatheterInside = j >= n && RodOf(run).AroundOf(2, j - n) == 1 && joints.CarrierOf(j - n) == 0;
                double between = isInCatheterInside ? rate[j] - rate[j - n] : rate[j];
                power += drag[j] * between * between;
            }
            return power;
        }

        // The outermost one first.
        private static Hub[] Hubs(DirectStep run)
        {
            var hubs = new List<Hub>();
            for (CoaxialRecord? record = run.Coaxial(); record != null; record = record.Inside)
            {
                hubs.Add(new Hub { Force = record.Force, Torque = record.Torque, Insertion = record.Insertion,
                    Turn = record.Turn });
            }
            HubRecord wire = run.Hub()!;
            hubs.Add(new Hub { Force = wire.Force, Torque = wire.Torque, Insertion = wire.Insertion,
                Turn = wire.Turn });
            return hubs.ToArray();
        }

        // Of the wire's hub, m.
        private static double Asked(DirectStep run) => run.Coaxial()!.WireCommandedDisplacement;

        // J, by the forces of now.
        private static double WorkOf(Hub[] now, Hub[] old)
        {
            double work = 0.0;
            for (int i = 0; i < now.Length; i++)
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
            for (int i = 1; i < now.Length; i++)
            {
                work += now[i].Force * (now[i].Insertion - old[i].Insertion - outer)
                    + now[i].Torque * (now[i].Turn - old[i].Turn);
            }
            return work;
        }

        // The same of the support between walls, whose spring holds the first node with the force of all hubs.
        private static double OnSupport(Hub[] now, Hub[] old)
        {
            double force = 0.0;
            foreach (Hub hub in now)
            {
                force += hub.Force;
            }
            return force * (now[0].Insertion - old[0].Insertion);
        }

        private static double CycleWork(double perStep, out double peak)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Material.Sections[0].From = 312.0;
            parameters.Material.Sections[0].RestCurvature = new Vector3d(10.0, 0.0, 0.0);
            parameters.Scene.Catheters[0].Material.Sections[0].RestCurvature = new Vector3d(10.0, 4.0, 0.0);
            return CoaxialScenes.CycleWork(parameters, perStep, out peak);
        }

        private static CoaxialRod RodOf(DirectStep run) => run.Dynamics.Terms.Supports.Coaxial!;

        // All hubs move and turn in steps in which the instruments swing.
        private static DirectStep Swinging(int instruments, double perStep, out SimulationParameters parameters,
            out RodState state, double limit = 0.0)
        {
            parameters = instruments == 2 ? CoaxialScenes.Pair(Integrator.ImplicitEuler)
                : CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Method.MaxSimulationSteps = 60;
            parameters.Drive.InsertionSpeed = Math.Min(perStep * 0.01 / parameters.Method.TimeStep, 0.8);
            parameters.Drive.RotationSpeed = 5.0;
            if (limit > 0.0)
            {
                // Hubs slip between walls alone: one that nothing comes to.
                parameters.Scene.Walls = new ContactShape[] { new PlaneShape(new Vector3d(5000.0, 0.0, 0.0),
                    -Vector3d.UnitX) };
                parameters.Drive.HubForceLimit = limit;
            }
            IReadOnlyList<Catheter> catheters = parameters.Scene.Catheters;
            catheters[0].Drive.InsertionSpeed = (instruments == 2 ? 0.4 : 0.25) * parameters.Drive.InsertionSpeed;
            catheters[0].Drive.RotationSpeed = -3.0;
            if (instruments == 3)
            {
                catheters[1].Drive.InsertionSpeed = 0.5 * parameters.Drive.InsertionSpeed;
                catheters[1].Drive.RotationSpeed = 2.0;
            }
            MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
            state = start.State;
            return (DirectStep)start.Stepper;
        }

        private struct Hub
        {
            public double Force, Torque, Insertion, Turn;
        }
    }
}
