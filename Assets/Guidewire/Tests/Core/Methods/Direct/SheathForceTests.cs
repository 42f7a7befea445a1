using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The hub of a wire whose bent tip slides out of a straight sheath without friction: its force and torque
    /// are the slopes of the energy, at any speed, and no energy comes from nowhere.</summary>
    public sealed class SheathForceTests
    {
        private const double Radius = 0.18e-3;    // m
        private const double TipLength = 14.1e-3; // m
        private const double SoftModulus = 6e9;   // Pa

        [TestCase(0.03, 16, -333.0, 0.02)]
        [TestCase(0.4, 40, -333.0, 0.02)]
        [TestCase(0.57, 27, 250.0, 0.02)]
        [TestCase(1.0, 40, -333.0, 0.02)]
        [TestCase(1.13, 61, -150.0, 0.05)]
        [TestCase(2.13, 40, -333.0, 0.05)]
        [TestCase(3.0, 61, 333.0, 0.05)]
        public void HubForce_IsWhatDrivesABentWireOut_AtAnySpeed(double perStep, int tipElements, double curvature,
            double fraction)
        {
            // -EI kappa^2/2, whatever the elements are and wherever nodes stand: fed, and drawn back.
            double length = TipLength / tipElements;
            double right = -0.5 * Bend * curvature * curvature;
            const double Start = 0.1e-3;
            SimulationParameters parameters = Bent(tipElements, curvature, Start);
            // Steps are long enough for the tip to come to rest in each.
            int half = (int)((TipLength - Start) / (perStep * length));
            parameters.Drive.Table = FedAndDrawnBack(half, half * perStep * length, parameters);
            Simulation run = Simulation.Create(parameters);
            var last = new double[5];
            int seen = 0;
            int means = 0;
            Wires.Finish(run, () =>
            {
                HubRecord hub = run.Hub()!;
                double bent = Start + hub.Insertion;
                bool counts = bent > 2.0 * length && bent < TipLength - 2.0 * length && run.StepCount != half + 1;
                seen = counts ? seen + 1 : 0;
                last[run.StepCount % 5] = hub.Force;
                if (seen >= 5)
                {
                    double mean = (last[0] + last[1] + last[2] + last[3] + last[4]) / 5.0;
                    Assert.That(mean, Is.EqualTo(right).Within(-fraction * right), "at " + bent);
                    means++;
                }
            });
            Assert.That(means, Is.GreaterThan(2));
        }

        [Test]
        public void HubForceAndTorque_AreTheSlopesOfTheEnergy([Values(0.17, 1.7)] double perStep)
        {
            // At steps of a run that feeds, turns and swings: a little on and back with all coordinates held.
            DirectStep run = Turning(perStep, Integrator.ImplicitEuler, out SimulationParameters parameters,
                out RodState state);
            var forces = new LargestError();
            var torques = new LargestError();
            for (int k = 0; k < (int)(20.0 / perStep); k++)
            {
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                HubRecord hub = run.Hub()!;
                forces.Add(EnergySlopes.Difference(1e-8, d => EnergyAt(run, d, 0.0)), hub.Force);
                torques.Add(EnergySlopes.Difference(1e-5, d => EnergyAt(run, 0.0, d)), hub.Torque);
            }
            forces.AssertSmall(0.1);
            torques.AssertSmall(1e-7);
        }

        [Test]
        public void EveryStepOfImplicitEuler_ClosesItsEnergy([Values(0.17, 1.0, 2.7)] double perStep)
        {
            // With z = (x, q, hub): work of the hub, E'(z1) dz of the hub; change of T + E; drag, a h w.M w; and the
            // scheme's own, 1/2 |dv|^2_M + E(z0) - E(z1) - E'(z1)(z0 - z1), each by its own formula.
            DirectStep run = Turning(perStep, Integrator.ImplicitEuler, out SimulationParameters parameters,
                out RodState state);
            double h = parameters.Method.TimeStep;
            double worst = 0.0;
            double peak = 0.0;
            for (int k = 0; k < (int)(20.0 / perStep); k++)
            {
                ((CoaxialInstruments)run).Chain.MoveWindow();
                RodDynamics motion = run.Dynamics;
                double elements = CoaxialScenes.ElementsOf(run);
                RodShape before = Rods.Copy(motion.Shape);
                var v = (Vector3d[])motion.Velocities.Clone();
                var w = (Vector3d[])motion.Spins.Clone();
                RodMass mass = motion.Terms.Mass;
                HubRecord hub = run.Hub()!;
                (double insertion, double turn) = (hub.Insertion, hub.Turn);
                double energy = EnergyAt(run, 0.0, 0.0);
                double kinetic = mass.KineticEnergy(v, w);
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                Assert.That(CoaxialScenes.ElementsOf(run), Is.EqualTo(elements), "one window");
                hub = run.Hub()!;
                double onHub = hub.Force * (hub.Insertion - insertion) + hub.Torque * (hub.Turn - turn);
                double energyNow = EnergyAt(run, 0.0, 0.0);
                double kineticNow = mass.KineticEnergy(motion.Velocities, motion.Spins);
                double slope = EnergySlopes.Along(motion, before) - onHub;
                for (int i = 0; i < v.Length; i++)
                {
                    v[i] = motion.Velocities[i] - v[i];
                }
                for (int j = 0; j < w.Length; j++)
                {
                    w[j] = motion.Spins[j] - w[j];
                }
                double scheme = mass.KineticEnergy(v, w) + energy - energyNow - slope;
                double drag = 2.0 * parameters.Material.MassDamping * h * kineticNow;
                double left = onHub - (energyNow - energy) - (kineticNow - kinetic) - drag - scheme;
                worst = Math.Max(worst, Math.Abs(left));
                peak = Math.Max(peak, energyNow + kineticNow);
            }
            Assert.That(peak, Is.GreaterThan(1e-3));
            Assert.That(worst, Is.LessThan(1e-6 * peak));
        }

        [Test]
        public void ClosedCycle_TakesNoWork()
        {
            // Fed in and drawn back under a load at the tip, so slowly that nothing swings, in steps of 0.1 of an
            // element on and 0.137 back: the trapezoids of the hub's force leave less than 1e-4 of the peak of the
            // work, and in twice the step four times as much.
            double one = CycleWork(0.1, out double peak);
            double two = CycleWork(0.2, out _);
            Assert.That(peak, Is.GreaterThan(4e-4));
            Assert.That(Math.Abs(one), Is.LessThan(1e-4 * peak));
            Assert.That(Math.Abs(one), Is.LessThan(0.35 * Math.Abs(two)));
        }

        [Test]
        public void HubThatGivesWay_NeverHoldsMoreThanItsLimit_OfAWireThatIsDrivenOut()
        {
            // 0.275 N drive the wire out and the hub holds 0.1: it slides out by itself, damped by its drag. Within a
            // step the hub takes what drives it from the step's start; that changes fast while the tip bends at first.
            SimulationParameters parameters = Bent(20, -333.0, 0.5 * TipLength);
            parameters.Drive.HubForceLimit = 0.1;
            parameters.Drive.InsertionSpeed = 1e-4;
            parameters.Material.MassDamping = 2e5;
            parameters.Method.TimeStep = 1e-4;
            parameters.Method.MaxSimulationSteps = 400;
            Simulation run = Simulation.Create(parameters);
            Wires.Finish(run, () =>
            {
                Assert.That(run.StepCount < 100 || Math.Abs(run.Hub()!.Force) < 1.02 * 0.1, run.StepCount + " "
                    + run.Hub()!.Force);
            });
            Assert.That(run.Hub()!.Insertion, Is.GreaterThan(1e-4));
            Assert.That(run.Hub()!.LengthInBody, Is.EqualTo(0.5 * TipLength + run.Hub()!.Insertion).Within(1e-4));
        }

        [Test]
        public void WhatTheHubIsShortOf_IsWhatNodeZeroLacks_WhereElementsComeAndGoWhileItSlips()
        {
            // The sheath drives the wire out with 0.275 N, of which the hub holds 0.05: node 0 carries all of it, and
            // what is missing of the drive is measured there.
            SimulationParameters parameters = Bent(40, -333.0, 0.3 * TipLength);
            parameters.Drive.HubForceLimit = 0.05;
            parameters.Drive.InsertionSpeed = 0.002;
            parameters.Material.MassDamping = 2e5;
            parameters.Method.TimeStep = 1e-3;
            parameters.Method.MaxSimulationSteps = 60;
            Simulation run = Simulation.Create(parameters);
            Vector3d start = run.State.Positions[0];
            int entries = 0;
            int before = run.Hub()?.SpheresInBody ?? 0;
            Wires.Finish(run, () =>
            {
                entries += run.Hub()!.SpheresInBody != before ? 1 : 0;
                before = run.Hub()!.SpheresInBody!.Value;
            });
            Assert.That(entries, Is.GreaterThan(4));
            double gone = run.State.Positions[0].Z - start.Z;
            Assert.That(gone + run.Contacts!.DriveShortfall, Is.EqualTo(run.Contacts.DriveAsked).Within(1e-9));
            Assert.That(run.Contacts.DriveShortfall, Is.LessThan(-0.5), "it slipped on");
        }

        [Test]
        public void NoEnergyComesFromNowhere_AtAnySpeed(
            [Values(Integrator.ImplicitEuler, Integrator.Esdirk3)] Integrator integrator,
            [Values(0.3, 1.13, 2.9)] double perStep)
        {
            DirectStep run = Turning(perStep, integrator, out _, out RodState state);
            double start = run.Dynamics.Energy;
            double peak = start;
            double most = 0.0;
            for (int k = 0; k < (int)(34.0 / perStep); k++)
            {
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                double energy = run.Dynamics.Energy;
                peak = Math.Max(peak, energy);
                most = Math.Max(most, energy - start - run.Hub()!.Work);
            }
            Assert.That(most, Is.LessThan(0.01 * peak));
        }

        private static double Bend => SoftModulus * 0.25 * Math.PI * Math.Pow(Radius, 4.0);

        // Elastic energy, with the hub a little on or turned and every coordinate held.
        private static double EnergyAt(DirectStep run, double on, double turn)
        {
            double ahead = run.Hub()!.Turn - run.Dynamics.ProximalTurn;
            RodTerms terms = run.Dynamics.Terms;
            SupportSpring spring = terms.Walls()!.Spring;
            Vector3d place = spring.Position;
            spring.Position = place + on * spring.Axis;
            SheathEnergy sheath = Array.Find(terms.All, term => term is SheathEnergy) as SheathEnergy
                ?? throw new InvalidOperationException("no sheath");
            var bending = (BendTwistEnergy<RotationVectorLaw>)terms.Bending;
            double exit = run.Dynamics.Terms.Supports.Coaxial!.Joints.Sheathed;
            sheath.SetExit(exit - on);
            bending.TurnProximal(ahead + turn);
            double energy = terms.Potential(run.Dynamics.Shape);
            spring.Position = place;
            sheath.SetExit(exit);
            bending.TurnProximal(ahead);
            return energy;
        }

        private static double CycleWork(double perStep, out double peak)
        {
            SimulationParameters parameters = Bent(10, -150.0, 0.1 * TipLength);
            int on = (int)Math.Round(7.3 / perStep);
            int back = (int)Math.Round(7.3 / (1.37 * perStep));
            double most = on * perStep * TipLength / 10.0;
            parameters.Scene.TipForce = new Vector3d(0.0, -0.005, 0.0);
            parameters.Material.MassDamping = 0.0;
            double dt = 40.0 * perStep;
            parameters.Method.TimeStep = dt;
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Method.MaxSimulationSteps = 10 + on + back;
            parameters.Drive.Table = new DriveTable(new TimeTable(
                new[] { 0.0, 10.0 * dt, (10 + on) * dt, (10 + on + back) * dt }, new[] { 0.0, 0.0, most, 0.0 }),
                new TimeTable(new[] { 0.0 }, new[] { 0.0 }));
            Simulation run = Simulation.Create(parameters);
            double work = 0.0;
            double force = 0.0;
            double place = 0.0;
            peak = 0.0;
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
                HubRecord hub = run.Hub()!;
                work += 0.5 * (force + hub.Force) * (hub.Insertion - place);
                force = hub.Force;
                place = hub.Insertion;
                peak = Math.Max(peak, Math.Abs(work));
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            return work;
        }

        private static DriveTable FedAndDrawnBack(int half, double most, SimulationParameters parameters)
        {
            double time = half * parameters.Method.TimeStep;
            parameters.Method.MaxSimulationSteps = 2 * half;
            return new DriveTable(new TimeTable(new[] { 0.0, time, 2.0 * time }, new[] { 0.0, most, 0.0 }),
                new TimeTable(new[] { 0.0 }, new[] { 0.0 }));
        }

        // A tip of uneven bend that is fed while the hub turns, in steps in which it swings.
        private static DirectStep Turning(double perStep, Integrator integrator, out SimulationParameters parameters,
            out RodState state)
        {
            parameters = Bent(23, -333.0, 0.3e-3);
            parameters.Material.Sections = new[]
            {
                parameters.Material.Sections[0],
                new WireSection
                {
                    From = parameters.Scene.GuidewireLength - 7.3, To = parameters.Scene.GuidewireLength - 3.1,
                    YoungsModulus = 9e9, RestCurvature = new Vector3d(120.0, 180.0, 40.0),
                },
            };
            parameters.Material.MassDamping = 300.0;
            parameters.Method.TimeStep = 2e-3;
            parameters.Method.Integrator = integrator;
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Drive.InsertionSpeed = perStep * TipLength / 23.0 / parameters.Method.TimeStep;
            parameters.Drive.RotationSpeed = 5.0;
            MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
            state = start.State;
            return (DirectStep)start.Stepper;
        }

        // 120 mm of wire whose tip is soft and bent, this much (m) of the tip out of a sheath in a wide tube.
        private static SimulationParameters Bent(int tipElements, double curvature, double isOut)
        {
            SimulationParameters parameters = WallScenes.Wire(24, Radius);
            const double Whole = 120.0;
            parameters.Scene.GuidewireLength = Whole;
            parameters.Scene.GuidewireOffset = 1e3 * (isOut - TipLength) + 1e3 * TipLength - Whole;
            parameters.Scene.Sheath = new Sheath { Exit = Vector3d.Zero };
            parameters.Scene.Walls = WallScenes.Tube(-60.0, 100.0, 40.0);
            parameters.Drive.Kind = Drive.Displace;
            parameters.Material.MassDamping = 50.0;
            parameters.Material.Sections = new[]
            {
                new WireSection
                {
                    From = Whole - 1e3 * TipLength, To = Whole, NumberRodElements = tipElements,
                    YoungsModulus = SoftModulus, ShearModulus = SoftModulus / 2.6,
                    RestCurvature = new Vector3d(curvature, 0.0, 0.0),
                },
            };
            parameters.Method.TimeStep = 0.2;
            return parameters;
        }
    }
}
