using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Runs of a wire in a catheter: what hubs feel, the energy, snapshots, and hubs that meet.</summary>
    public sealed class CoaxialRunTests
    {
        private const double Unit = 1e-3;   // m

        [Test]
        public void HubForcesAndTorques_AreTheDifferencesOfTheEnergy()
        {
            CoaxialStep run = Swinging(Integrator.ImplicitEuler, 0.31, out _, out RodState state);
            double worst = 0.0;
            double peak = 0.0;
            double worstTorque = 0.0;
            double peakTorque = 0.0;
            for (int k = 0; k < 60; k++)
            {
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                CoaxialRecord record = run.Coaxial()!;
                double force = Slope(1e-6, d => EnergyAt(run, d, 0.0));
                double torque = Slope(1e-5, d => EnergyAt(run, 0.0, d));
                peak = Math.Max(peak, Math.Abs(record.WireForce));
                peakTorque = Math.Max(peakTorque, Math.Abs(record.WireTorque));
                worst = Math.Max(worst, Math.Abs(force - record.WireForce));
                worstTorque = Math.Max(worstTorque, Math.Abs(torque - record.WireTorque));
            }
            Assert.That(peak, Is.GreaterThan(0.02));
            Assert.That(peakTorque, Is.GreaterThan(1e-4));
            Assert.That(worst, Is.LessThan(1e-6 * peak));
            Assert.That(worstTorque, Is.LessThan(1e-6 * peakTorque));
        }

        [Test]
        public void EveryStepOfImplicitEuler_ClosesItsEnergy([Values(0.1, 0.31, 1.3)] double perStep)
        {
            // With z = (x, q, twist, hubs): work of the hubs, E'(z1) dz of them; change of T + E; drag, a h w.M w; and
            // the scheme's own, 1/2 |dv|^2_M + E(z0) - E(z1) - E'(z1)(z0 - z1), each by its own formula.
            CoaxialStep run = Swinging(Integrator.ImplicitEuler, perStep, out SimulationParameters parameters,
                out RodState state);
            double h = parameters.Method.TimeStep;
            double worst = 0.0;
            double peak = 0.0;
            int steps = 0;
            for (int k = 0; k < 60; k++)
            {
                RodDynamics motion = run.Dynamics;
                var before = new RodShape(motion.Shape.ElementCount, true);
                before.CopyFrom(motion.Shape);
                var v = (Vector3d[])motion.Velocities.Clone();
                var w = (Vector3d[])motion.Spins.Clone();
                RodMass mass = motion.Terms.Mass;
                Hubs old = new Hubs(run);
                double energy = EnergyAt(run, 0.0, 0.0);
                double kinetic = mass.KineticEnergy(v, w);
                run.Advance(state);
                Assert.That(run.Failure, Is.Null);
                if (run.Dynamics != motion)
                {
                    continue;   // a node came in
                }
                steps++;
                Hubs now = new Hubs(run);
                double onHubs = now.Force * (now.Insertion - old.Insertion) + now.Torque * (now.Turn - old.Turn)
                    + now.WireForce * (now.WireInsertion - old.WireInsertion)
                    + now.WireTorque * (now.WireTurn - old.WireTurn);
                double energyNow = EnergyAt(run, 0.0, 0.0);
                double kineticNow = mass.KineticEnergy(motion.Velocities, motion.Spins);
                for (int i = 0; i < v.Length; i++)
                {
                    v[i] = motion.Velocities[i] - v[i];
                }
                for (int j = 0; j < w.Length; j++)
                {
                    w[j] = motion.Spins[j] - w[j];
                }
                double slope = SlopeAlong(motion, before) - OnHubsByEnergy(run, now, old);
                double scheme = mass.KineticEnergy(v, w) + energy - energyNow - slope;
                double drag = 2.0 * parameters.Material.MassDamping * h * kineticNow;
                double left = onHubs - (energyNow - energy) - (kineticNow - kinetic) - drag - scheme;
                worst = Math.Max(worst, Math.Abs(left));
                peak = Math.Max(peak, energyNow + kineticNow);
            }
            TestContext.WriteLine("{0:G3} of {1:G3} J in {2} steps", worst, peak, steps);
            Assert.That(steps, Is.GreaterThan(25));
            Assert.That(peak, Is.GreaterThan(1e-3));
            Assert.That(worst, Is.LessThan(1e-6 * peak));
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

        [Test]
        public void MotionSettlesToTheRestShape([Values(Integrator.ImplicitEuler, Integrator.Bdf2, Integrator.Trbdf2,
            Integrator.Esdirk3, Integrator.Esdirk4)] Integrator integrator)
        {
            SimulationParameters parameters = Pair(integrator);
            parameters.Drive.InsertionSpeed = 0.02;
            parameters.Material.MassDamping = 60.0;
            parameters.Method.TimeStep = 4e-3;
            parameters.Method.MaxSimulationSteps = 100;
            Simulation run = Simulation.Create(parameters);
            Finish(run);
            SimulationParameters resting = parameters.Copy();
            resting.Drive.InsertionSpeed = 0.0;
            resting.Method.MaxSimulationSteps = 1000;
            resting.Method.DeltaThreshold = 1e-4;
            run = run.Continue(resting);
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            // The same place of both hubs, from the start at rest there.
            SimulationParameters still = Pair(integrator);
            still.Scene.InitialState = InitialState.Equilibrium;
            still.Scene.GuidewireOffset += 0.02 * 0.4 / Unit;
            ((Catheter)still.Scene.Catheters[0]).Start -= 0.02 * 0.4 / Unit;
            still.Method.MaxSimulationSteps = 0;
            Simulation rest = Simulation.Create(still);
            Assert.That(rest.Outcome, Is.EqualTo(Outcome.Converged), rest.Reason);
            for (int i = 0; i <= 40; i++)
            {
                Assert.That((run.State.Positions[i] - rest.State.Positions[i]).Length, Is.LessThan(1e-3), "node " + i);
            }
            Assert.That(run.Coaxial()!.Extension, Is.EqualTo(rest.Coaxial()!.Extension).Within(1e-9));
        }

        [Test]
        public void RunThatIsRestored_TakesTheSameSteps([Values(Integrator.ImplicitEuler, Integrator.Esdirk3)]
            Integrator integrator)
        {
            SimulationParameters parameters = Pair(integrator);
            parameters.Drive.InsertionSpeed = 0.2;
            parameters.Drive.RotationSpeed = 2.0;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = 0.07;
            parameters.Method.MaxSimulationSteps = 160;
            Simulation run = Wires.RunAndRestore(parameters, 70, out Simulation other);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(other.Coaxial()!.Positions, Is.EqualTo(run.Coaxial()!.Positions));
            Assert.That(other.Coaxial()!.WireForce, Is.EqualTo(run.Coaxial()!.WireForce));
            Assert.That(other.Coaxial()!.WireAsked, Is.EqualTo(run.Coaxial()!.WireAsked));
            Assert.That(other.Coaxial()!.Gone, Is.EqualTo(run.Coaxial()!.Gone));
            parameters.Scene.Catheters = Array.Empty<Catheter>();
            Assert.That(() => run.Continue(parameters), Throws.ArgumentException.With.Message.StartsWith("catheters"));
        }

        [TestCase(0.4, 0.0)]
        [TestCase(-0.6, 0.0)]
        [TestCase(0.0, 0.5)]
        [TestCase(0.0, -0.5)]
        public void HubsGoAsFarAsTheyMay(double wire, double catheter)
        {
            // Steered, for what a file asks beyond is refused: in till the hubs meet, back till the tip is in the
            // catheter's first element, the catheter over the wire and back to its hub.
            SimulationParameters parameters = Pair(Integrator.ImplicitEuler);
            parameters.Drive.Steering = new Steering { Push = wire / Unit * parameters.Method.TimeStep };
            parameters.Scene.Catheters[0].Drive.Steering =
                new Steering { Push = catheter / Unit * parameters.Method.TimeStep };
            Simulation run = Simulation.Create(parameters);
            double start = run.Coaxial()!.Extension;
            double went = 0.0;
            double wireWent = 0.0;
            CoaxialRecord record = run.Coaxial()!;
            for (int k = 0; k < 500 && run.Outcome == Outcome.Running; k++)
            {
                double from = record.Insertion;
                double wireFrom = run.Hub()!.Insertion;
                run.Step();
                record = run.Coaxial()!;
                went += Math.Abs(record.Insertion - from);
                wireWent += Math.Abs(run.Hub()!.Insertion - wireFrom);
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            double asked = 500.0 * parameters.Method.TimeStep;
            Assert.That(record.Asked, Is.EqualTo(asked * Math.Abs(catheter)).Within(1e-9));
            Assert.That(record.WireAsked, Is.EqualTo(asked * Math.Abs(wire)).Within(1e-9));
            Assert.That(record.Gone, Is.EqualTo(went).Within(1e-9));
            Assert.That(record.WireGone, Is.EqualTo(wireWent).Within(1e-9));
            Assert.That(record.WireShortfall, Is.EqualTo(asked * Math.Abs(wire) - wireWent).Within(1e-9));
            Assert.That(Math.Abs(run.Hub()!.Insertion) + (wire == 0.0 ? 0.0 : WireShortfall(run, asked * wire)),
                Is.EqualTo(asked * Math.Abs(wire)).Within(1e-9));
            Assert.That(Math.Abs(record.Insertion) + record.Shortfall, Is.EqualTo(asked * Math.Abs(catheter))
                .Within(1e-9));
            double gone = run.Hub()!.Insertion - record.Insertion;
            bool isOut = wire > 0.0 || catheter < 0.0;
            double expected = isOut ? 0.1 : -(start + 0.25 - 0.01);
            Assert.That(gone, Is.EqualTo(expected).Within(1e-9));
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running));
        }

        private static double WireShortfall(Simulation run, double asked)
        {
            return Math.Abs(asked - run.Hub()!.Insertion);
        }

        [Test]
        public void Step_LeavesNothingForTheCollector_WhereNoNodeComesOrGoes()
        {
            SimulationParameters parameters = Pair(Integrator.ImplicitEuler);
            parameters.Drive.InsertionSpeed = 1e-5;
            parameters.Drive.RotationSpeed = 1.0;
            Simulation run = Simulation.Create(parameters);
            for (int k = 0; k < 20; k++)
            {
                run.Step();
            }
            Assert.That(Garbage.LeftBy(() =>
            {
                for (int k = 0; k < 20; k++)
                {
                    run.Step();
                }
            }), Is.Zero);
        }

        private static void Finish(Simulation run)
        {
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
        }

        private static double Slope(double step, Func<double, double> value)
        {
            return (value(step) - value(-step)) / (2.0 * step);
        }

        // All energy with the wire's hub this much on, m, and turned on, radians.
        private static double EnergyAt(CoaxialStep run, double on, double turn)
        {
            var bending = (CoaxialBendTwist)run.Dynamics.Terms.Bending;
            double lead = bending.Lead;
            double twist = bending.HubTwist;
            run.Rod.SetLead(lead - on);
            bending.HubTwist = twist + turn;
            double energy = run.Dynamics.Terms.Potential(run.Dynamics.Shape);
            run.Rod.SetLead(lead);
            bending.HubTwist = twist;
            return energy;
        }

        // E'(z1)(z0 - z1) of the coordinates, all nodes and frames among them.
        private static double SlopeAlong(RodDynamics motion, RodShape before)
        {
            RodShape shape = motion.Shape;
            var gradient = new RodVector[motion.Terms.VectorCount];
            motion.Terms.AddGradient(shape, gradient);
            double sum = 0.0;
            int n = shape.ElementCount;
            for (int i = 0; i <= n; i++)
            {
                Vector3d move = before.X[i] - shape.X[i];
                RodVector g = gradient[i];
                sum += g.X1 * move.X + g.X2 * move.Y + g.X3 * move.Z;
                if (i < n)
                {
                    Vector3d turn = RotationVector.Log(shape.Q[i].Conjugate * before.Q[i]);
                    sum += g.T1 * turn.X + g.T2 * turn.Y + g.T3 * turn.Z;
                    sum += gradient[n + 2 + i].T3 * (before.Twist[i] - shape.Twist[i]);
                }
            }
            return sum;
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
        }

        private static double CycleWork(double perStep, out double peak)
        {
            SimulationParameters parameters = Pair(Integrator.ImplicitEuler);
            double l = 0.01;
            int steps = (int)Math.Round(3.2 / perStep);
            double dt = 40.0 * perStep;
            double way = steps * perStep * l;
            parameters.Material.MassDamping = 0.0;
            parameters.Material.Sections[0].From = 312.0;
            parameters.Material.Sections[0].RestCurvature = new Vector3d(10.0, 0.0, 0.0);
            parameters.Scene.Catheters[0].Material.Sections[0].RestCurvature = new Vector3d(10.0, 4.0, 0.0);
            parameters.Method.TimeStep = dt;
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Method.MaxSimulationSteps = 10 + 4 * steps;
            double[] times = { 0.0, 10.0 * dt, (10 + steps) * dt, (10 + 2 * steps) * dt, (10 + 3 * steps) * dt,
                (10 + 4 * steps) * dt };
            parameters.Drive.Table = new DriveTable(new TimeTable(times, new[] { 0.0, 0.0, way, way, 0.6 * way, 0.0 }),
                new TimeTable(times, new[] { 0.0, 0.0, 0.5, 0.5, 0.0, 0.0 }));
            parameters.Scene.Catheters[0].Drive.Table = new DriveTable(
                new TimeTable(times, new[] { 0.0, 0.0, 0.0, 0.6 * way, 0.6 * way, 0.0 }),
                new TimeTable(times, new[] { 0.0, 0.0, 0.0, -0.4, -0.4, 0.0 }));
            Simulation run = Simulation.Create(parameters);
            double work = 0.0;
            peak = 0.0;
            double[] old = new double[8];
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
                CoaxialRecord record = run.Coaxial()!;
                HubRecord hub = run.Hub()!;
                double[] now = { hub.Force, hub.Torque, record.Force, record.Torque, hub.Insertion, hub.Turn,
                    record.Insertion, record.Turn };
                for (int k = 0; k < 4 && run.StepCount > 5; k++)
                {
                    work += 0.5 * (now[k] + old[k]) * (now[k + 4] - old[k + 4]);
                }
                old = now;
                peak = Math.Max(peak, Math.Abs(work));
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            return work;
        }

        // Both hubs move and turn in steps in which the instruments swing.
        private static CoaxialStep Swinging(Integrator integrator, double perStep, out SimulationParameters parameters,
            out RodState state)
        {
            parameters = Pair(integrator);
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

        // A wire of 400 mm with a bent soft tip in a catheter of 250 mm with a bent tip, 0.1 m between the hubs.
        private static SimulationParameters Pair(Integrator integrator)
        {
            SimulationParameters parameters = SimulationParameters.DefaultsOf(Solver.Direct);
            parameters.Method.Integrator = integrator;
            parameters.Method.TimeStep = 2e-3;
            parameters.Method.DeltaThreshold = 0.0;
            parameters.Scene.GuidewireLength = 400.0;
            parameters.Scene.NumberRodElements = 40;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Drive.Kind = Drive.Displace;
            parameters.Material.WireRadius = 0.445e-3;
            parameters.Material.MassDamping = 20.0;
            parameters.Material.Sections = new[]
            {
                new WireSection { From = 370.0, To = 400.0, YoungsModulus = 9e9, ShearModulus = 3.5e9,
                    RestCurvature = new Vector3d(30.0, 0.0, 0.0) },
            };
            var catheter = new Catheter { Length = 250.0, Elements = 25, Start = 100.0 };
            catheter.Material.WireRadius = 0.83e-3;
            catheter.Material.InnerRadius = 0.6e-3;
            catheter.Material.YoungsModulus = 4e9;
            catheter.Material.ShearModulus = 1.5e9;
            catheter.Material.Density = 1200.0;
            catheter.Material.Sections = new[]
            {
                new WireSection { From = 210.0, To = 250.0, YoungsModulus = 2e9,
                    RestCurvature = new Vector3d(30.0, 10.0, 0.0) },
            };
            parameters.Scene.Catheters = new[] { catheter };
            return parameters;
        }
    }
}
