using System;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Wires between walls that move as it is prescribed.</summary>
    public sealed class MovingWallTests
    {
        private const double Weight = 6.298234e-4;    // N, of 100 mm of nitinol, r = 0.178 mm, under 9.81 m/s^2
        private const double Mass = Weight / 9.81;

        private static readonly Integrator[] Integrators =
            { Integrator.ImplicitEuler, Integrator.Bdf2, Integrator.Trbdf2, Integrator.Esdirk3 };

        /// <summary>A wire that lies on a floor goes up and down with it: N = m (g - A w^2 sin w t).</summary>
        [Test]
        public void OnARisingFloor_TheWallBearsWeightLessAcceleration(
            [ValueSource(nameof(Integrators))] Integrator integrator, [Values(1.0, 5.0)] double frequency)
        {
            double period = 1.0 / frequency;
            SimulationParameters parameters = Lying(MotionCycle.Sine(period, 0.0, new Vector3d(0.0, 5.0, 0.0),
                Vector3d.Zero, Vector3d.Zero), period);
            parameters.Method.Integrator = integrator;
            parameters.Method.TimeStep = period / 200.0;
            Simulation simulation = Simulation.Create(parameters);
            double amplitude = 5e-3 * Math.Pow(2.0 * Math.PI * frequency, 2.0);
            Go(simulation, 450);
            Assert.That(simulation.Contacts!.Total.Y, Is.EqualTo(Weight - Mass * amplitude).Within(1e-3 * Weight),
                "at the top");
            Go(simulation, 100);
            if (frequency == 1.0)
            {
                Assert.That(simulation.Contacts.Total.Y, Is.EqualTo(Weight + Mass * amplitude).Within(1e-3 * Weight),
                    "at the bottom");
            }
            Assert.That(simulation.Contacts.Passages, Is.EqualTo(0));
            Assert.That(simulation.Contacts.MaxPenetration, Is.EqualTo(0.0));
        }

        [Test]
        public void OnAFloorThatMovesAlongItself_TheWireSticksOrStays([Values(0.1, 0.0)] double friction)
        {
            SimulationParameters parameters = Lying(MotionCycle.Sine(1.0, 0.0, new Vector3d(0.0, 0.0, 5.0),
                Vector3d.Zero, Vector3d.Zero), 1.0);
            parameters.Scene.Walls[0].FrictionCoefficient = friction;
            parameters.Material.MassDamping = 0.0;
            parameters.Method.TimeStep = 0.01;
            Simulation simulation = Simulation.Create(parameters);
            var field = new WallField(parameters.Scene.Walls[0].Motion!);
            Go(simulation, 10);    // it settles
            field.SetTime(simulation.Time);
            Vector3d start = field.AtRest(simulation.State.Positions[7]);
            start = friction > 0.0 ? start : simulation.State.Positions[7];
            for (int k = 0; k < 300; k++)
            {
                simulation.Step();
                field.SetTime(simulation.Time);
                Vector3d now = simulation.State.Positions[7];
                Vector3d moved = friction > 0.0 ? field.Moved(start) : start;
                Assert.That(Math.Abs(now.Z - moved.Z), Is.LessThan(1e-3),
                    "in mm, at " + simulation.Time);
            }
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running), simulation.Reason);
        }

        [Test]
        public void WithoutAmplitude_ForcesAreThoseOfAWallAtRest([Values] bool isRigid)
        {
            SimulationParameters moving = WallScenes.Arch(60, 0.05, 20.0, 60.0);
            moving.Scene.Walls[0].FrictionCoefficient = 0.1;
            moving.Method.SolverTolerance = 1e-9;
            SimulationParameters still = moving.Copy();
            moving.Scene.Walls = new ContactShape[] { WallScenes.ArchTube(40) };
            moving.Scene.Walls[0].FrictionCoefficient = 0.1;
            moving.Scene.Walls[0].Motion = isRigid ? new WallMotion(new[] { MotionCycle.Sine(1.0, 0.0, Vector3d.Zero,
                Vector3d.Zero, new Vector3d(1.0, 2.0, 3.0)) }, Array.Empty<Vector3d[]>(), 1.0, 0.2)
                : Bent(_ => Vector3d.Zero);
            Simulation one = Simulation.Create(moving);
            Simulation other = Simulation.Create(still);
            for (int k = 0; k < 60; k++)
            {
                one.Step();
                other.Step();
                double largest = other.Contacts!.Forces.Max(force => force.Length);
                for (int i = 0; i < other.State.SphereCount; i++)
                {
                    Assert.That(Vector3d.Distance(one.Contacts!.Forces[i], other.Contacts.Forces[i]),
                        Is.LessThanOrEqualTo(1e-9 * largest), "step " + k + ", node " + i);
                }
            }
        }

        /// <summary>The derivative of the energy of an arch that is bent and turned is that of its values.</summary>
        [Test]
        public void Gradient_IsTheDifferenceOfTheEnergy([ValueSource(typeof(TestShapes), nameof(TestShapes.Names))]
            string name)
        {
            int tried = 0;
            ContactShape wall = TestShapes.Make(name);
            wall.Motion = Wavy();
            MaterialRod rod = MaterialRod.Round(6, 1.2, 0.3, 1e6, 1e6, 1e3);
            var energy = new BarrierEnergy(rod, new[] { wall }, 1.0, new Barrier(0.1, 10.0));
            energy.SetTime(0.37);
            for (int seed = 0; seed < 3000 && tried < 6; seed++)
            {
                var random = new RandomGeometry(seed);
                var shape = new RodShape(6);
                Vector3d x = random.Point();
                Vector3d step = 0.2 * random.Direction();
                for (int i = 0; i <= 6; i++, x += step + 0.05 * random.Point())
                {
                    shape.X[i] = x;
                }
                Array.Fill(shape.Q, Quaterniond.Identity);
                double value = energy.Value(shape);
                if (!(value > 0.0) || !(value < 1e3))
                {
                    continue;
                }
                tried++;
                var gradient = new RodVector[8];
                var measured = default(GradientMeasures);
                energy.AddGradient(shape, gradient, 0, 7, ref measured);
                for (int i = 0; i <= 6; i++)
                {
                    foreach (Vector3d along in new[] { Vector3d.UnitX, Vector3d.UnitY, Vector3d.UnitZ })
                    {
                        Vector3d at = shape.X[i];
                        shape.X[i] = at + 1e-7 * along;
                        double above = energy.Value(shape);
                        shape.X[i] = at - 1e-7 * along;
                        double below = energy.Value(shape);
                        shape.X[i] = at;
                        Assert.That(Vector3d.Dot(gradient[i].X, along), Is.EqualTo((above - below) / 2e-7)
                            .Within(1e-4 * measured.LargestForce), name + ", seed " + seed + ", node " + i);
                    }
                }
            }
            Assert.That(tried, Is.GreaterThanOrEqualTo(2));
        }

        [Test]
        public void Field_IsInvertedByItsInverse_AndMovesItsCentreline()
        {
            WallMotion motion = Wavy();
            var field = new WallField(motion);
            field.SetTime(0.37);
            var random = new RandomGeometry(5);
            for (int k = 0; k < 200; k++)
            {
                Vector3d rest = random.Point();
                Assert.That(Vector3d.Distance(field.AtRest(field.Moved(rest)), rest), Is.LessThan(1e-12));
                Vector3d x = field.Moved(rest);
                field.AtRest(x, out Matrix3 gradient);
                Vector3d along = random.Direction();
                Vector3d slope = (0.5 / 1e-6) * (field.AtRest(x + 1e-6 * along) - field.AtRest(x - 1e-6 * along));
                Assert.That(Vector3d.Distance(gradient * along, slope), Is.LessThan(1e-8));
            }
        }

        // A wall of 1 s seen every half second stands still.
        [TestCase(0.5)]
        [TestCase(0.126)]
        public void StepLongerThanAnEighthOfAPeriod_IsRefused(double timeStep)
        {
            SimulationParameters parameters = Clamped(new Vector3d(1.0, 0.0, 0.0));
            parameters.Method.TimeStep = timeStep;
            Assert.That(() => Simulation.Create(parameters), Throws.ArgumentException.With.Message.Contains(
                "timeStep needs at most an eighth of each period"));
            parameters.Method.TimeStep = 0.125;
            Assert.That(() => Simulation.Create(parameters), Throws.Nothing);
        }

        // The clearance is 4.8: in the second case it is passed by a tenth of the wire's radius.
        [TestCase(30.0)]
        [TestCase(4.82)]
        public void VesselThatMovesAwayFromTheHeldEnd_EndsTheRun(double way)
        {
            SimulationParameters parameters = Clamped(new Vector3d(way, 0.0, 0.0));
            Simulation simulation = Simulation.Create(parameters);
            for (int k = 0; k < 100 && simulation.Outcome == Outcome.Running; k++)
            {
                simulation.Step();
            }
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Failed));
            Assert.That(simulation.Reason, Does.Contain("the vessel has moved away from the end that is held"));
        }

        /// <summary>Blood that goes along with the walls drags a clamped wire that touches none of them, and no scheme
        /// takes its motion for one that comes from nowhere.</summary>
        [Test]
        public void BloodInAMovingVessel_DragsAWireThatTouchesNothing([ValueSource(nameof(Integrators))]
            Integrator integrator, [Values(1.0, 20.0)] double frequency)
        {
            SimulationParameters parameters = Clamped(new Vector3d(4.0, 0.0, 0.0), 1.0 / frequency);
            parameters.Method.Integrator = integrator;
            parameters.Method.TimeStep = 0.02 / frequency;
            Simulation simulation = Simulation.Create(parameters);
            Go(simulation, 80);
            double farthest = 0.0;
            for (int k = 0; k < 50; k++)
            {
                Go(simulation, 1);
                farthest = Math.Max(farthest, Math.Abs(simulation.State.Positions[30].X));
            }
            if (frequency == 1.0)
            {
                // So slow that the tip is where a cantilever's is under the drag, q L^4/(8 EI), q = a m A w.
                double load = 20.0 * 6450.0 * Math.PI * 4e-8 * 4e-3 * 2.0 * Math.PI;
                double stiffness = parameters.Material.YoungsModulus * Math.PI / 4.0 * Math.Pow(0.2e-3, 4.0);
                double tip = 1e3 * load * Math.Pow(0.06, 4.0) / (8.0 * stiffness);
                Assert.That(farthest, Is.EqualTo(tip).Within(0.01 * tip), "mm");
            }
            Assert.That(farthest, Is.LessThan(4.5), "mm");
        }

        [Test]
        public void AnotherHeartRate_GoesOnFromThePhaseThatItFinds()
        {
            SimulationParameters parameters = Clamped(Vector3d.UnitX);
            Simulation simulation = Simulation.Create(parameters);
            Go(simulation, 40);
            SimulationParameters faster = parameters.Copy();
            faster.Scene.Walls = WallScenes.Tube(-10.0, 200.0, 5.0);
            faster.Scene.Walls[0].Motion = Clamped(Vector3d.UnitX, 0.4).Scene.Walls[0].Motion;
            Simulation changed = simulation.Continue(faster);
            double phase = simulation.FieldOf(0)!.PhaseOf(0);
            Assert.That(changed.FieldOf(0)!.PhaseOf(0), Is.EqualTo(phase).Within(1e-12));
            Go(changed, 1);
            Assert.That(changed.FieldOf(0)!.PhaseOf(0),
                Is.EqualTo(phase + parameters.Method.TimeStep / 0.4).Within(1e-12));
        }

        /// <summary>The ramp, a quarter of the period, is over at 0.25 s. One of a slower heart would have begun
        /// anew.</summary>
        [Test]
        public void AnotherHeartRate_LeavesTheWallWhereItIs([Values(12, 40)] int steps)
        {
            SimulationParameters parameters = Clamped(Vector3d.UnitX);
            Simulation simulation = Simulation.Create(parameters);
            Go(simulation, steps);
            SimulationParameters slower = parameters.Copy();
            slower.Scene.Walls = WallScenes.Tube(-10.0, 200.0, 5.0);
            slower.Scene.Walls[0].Motion = Clamped(Vector3d.UnitX, 10.0).Scene.Walls[0].Motion;
            Simulation changed = simulation.Continue(slower);
            double x = simulation.FieldOf(0)!.Moved(Vector3d.Zero).X;
            Assert.That(x, Is.GreaterThan(0.01));
            Assert.That(changed.FieldOf(0)!.Moved(Vector3d.Zero).X, Is.EqualTo(x).Within(1e-12));
            Go(changed, 1);
            Assert.That(changed.FieldOf(0)!.Moved(Vector3d.Zero).X, Is.EqualTo(x).Within(0.05));
        }

        /// <summary>Another amplitude or phase would make the wall leap: the wire in its lumen would be outside, or not
        /// know.</summary>
        [TestCase(0.5, 0.0)]
        [TestCase(1.0, 0.25)]
        public void AMotionThatLeaps_IsRefused_WhileTheRunGoesOn(double part, double phase)
        {
            SimulationParameters parameters = Clamped(Vector3d.UnitX);
            Simulation simulation = Simulation.Create(parameters);
            Go(simulation, 40);
            SimulationParameters other = parameters.Copy();
            other.Scene.Walls = WallScenes.Tube(-10.0, 200.0, 5.0);
            other.Scene.Walls[0].Motion = Clamped(part * Vector3d.UnitX, 1.0, phase).Scene.Walls[0].Motion;
            Assert.That(() => simulation.Continue(other), Throws.ArgumentException.With.Message.Contains(
                "vessel.motion: the wall would leap by up to"));
            Go(simulation, 1);
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running));
        }

        private static SimulationParameters Clamped(Vector3d translation, double period = 1.0, double phase = 0.0)
        {
            SimulationParameters parameters = WallScenes.Wire(30, 0.2e-3);
            parameters.Scene.GuidewireLength = 60.0;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.Walls = WallScenes.Tube(-10.0, 200.0, 5.0);
            parameters.Scene.Walls[0].Motion = new WallMotion(new[] { MotionCycle.Sine(period, phase,
                translation, Vector3d.Zero, Vector3d.Zero) }, Array.Empty<Vector3d[]>(), 1.0, 0.25 * period);
            parameters.Drive.Kind = Drive.Hold;
            parameters.Drive.Displacement = 0.0;
            parameters.Material.MassDamping = 20.0;
            parameters.Method.MaxSimulationSteps = 1000;
            return parameters;
        }

        [Test]
        public void Restored_ItGoesOnWithTheSameBits()
        {
            SimulationParameters parameters = InBeatingArch(0.1);
            Simulation simulation = Simulation.Create(parameters);
            Go(simulation, 17);
            Simulation restored = Simulation.Restore(parameters, simulation.Save());
            Simulation continued = simulation.Continue(parameters);
            Go(simulation, 13);
            Go(restored, 13);
            Go(continued, 13);
            Assert.That(restored.State.Positions, Is.EqualTo(simulation.State.Positions));
            Assert.That(continued.State.Positions, Is.EqualTo(simulation.State.Positions));
            Assert.That(restored.Save(), Is.EqualTo(simulation.Save()));
        }

        /// <summary>A wire in a bend whose radius breathes has the couple EI/R(t); the walls do the work that bends
        /// it.</summary>
        [Test]
        public void InABreathingBend_TheCoupleFollowsTheRadius_AndTheAccountCloses()
        {
            const double radius = 40.0;
            const double change = 0.2;
            const double period = 8.0;
            SimulationParameters parameters = InBend(radius, x => change * (x - new Vector3d(0.0, radius, 0.0)),
                period);
            double stiffness = parameters.Material.YoungsModulus * Math.PI / 4.0 * Math.Pow(0.2e-3, 4.0);
            Simulation simulation = Simulation.Create(parameters);
            Go(simulation, 100);
            double stored = Energy(simulation);
            double work = simulation.Report()!.Extremes!.WallWork;
            double largest = 0.0;
            for (int k = 0; k < 200; k++)
            {
                Go(simulation, 1);
                double bend = stiffness / (1e-3 * radius
                    * (1.0 + change * Math.Sin(2.0 * Math.PI * simulation.Time / period)));
                StressRecord stress = simulation.Stress()!;
                double couple = Enumerable.Range(28, 5).Average(j => stress.Couple[j].Length);
                Assert.That(couple, Is.EqualTo(bend).Within(0.01 * bend), "at " + simulation.Time);
                double gained = Energy(simulation) - stored;
                largest = Math.Max(largest, Math.Abs(gained));
                double done = simulation.Report()!.Extremes!.WallWork - work;
                Assert.That(done, Is.EqualTo(gained).Within(0.02 * Math.Max(largest, 0.1 * stored)),
                    "work at " + simulation.Time);
            }
        }

        [Test]
        public void AnElasticWireWithoutFriction_IsAfterACycleWhereItWas()
        {
            SimulationParameters parameters = InBeatingArch(0.0);
            var times = new[] { 0.0, 4.0, 100.0 };
            parameters.Drive.Table = new DriveTable(new TimeTable(times, new[] { 0.0, 0.07, 0.07 }),
                new TimeTable(times, new double[3]));
            parameters.Drive.DisplacementPerStep = 0.0;
            parameters.Material.MassDamping = 20.0;
            parameters.Method.MaxSimulationSteps = 1000;
            Simulation simulation = Simulation.Create(parameters);
            Go(simulation, 120);
            for (int quarter = 0; quarter < 4; quarter++)
            {
                Vector3d[] start = simulation.State.Positions.ToArray();
                Go(simulation, 20);
                for (int i = 0; i < start.Length; i++)
                {
                    Assert.That(Vector3d.Distance(simulation.State.Positions[i], start[i]), Is.LessThan(1e-3), "mm");
                }
                Go(simulation, 5);
            }
        }

        private static double Energy(Simulation simulation)
        {
            Vector3d energies = simulation.Energies()!.Value;
            return energies.X + energies.Y + energies.Z;
        }

        // A wire of 60 mm in a bend with 0.05 mm around it.
        private static SimulationParameters InBend(double radius, Func<Vector3d, Vector3d> amplitude, double period)
        {
            const int n = 60;
            SimulationParameters parameters = WallScenes.Wire(n, 0.2e-3);
            Vector3d On(double s) => new Vector3d(0.0, radius * (1.0 - Math.Cos(s / radius)),
                radius * Math.Sin(s / radius));
            Vector3d[] axis = Enumerable.Range(0, 111).Select(k => On(k)).ToArray();
            parameters.Scene.Walls = new ContactShape[]
            {
                new TubeShape(axis, axis.Select(_ => 0.25).ToArray(), true, true)
                {
                    Motion = Beating(axis, 1.0, amplitude, period),
                },
            };
            parameters.Scene.GuidewireLength = n;
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            parameters.Scene.Start = new RodStart(
                Enumerable.Range(0, n + 1).Select(k => On(25.0 + k)).ToArray(),
                Enumerable.Range(0, n).Select(k => Quaterniond.FromAxisAngle(Vector3d.UnitX, -(25.5 + k) / radius))
                    .ToArray(), new Vector3d[n + 1], new Vector3d[n]);
            parameters.Drive.Kind = Drive.Hold;
            parameters.Drive.Displacement = 0.0;
            parameters.Material.MassDamping = 20.0;
            parameters.Method.TimeStep = 0.04;
            parameters.Method.MaxSimulationSteps = 10000;
            return parameters;
        }

        private static SimulationParameters InBeatingArch(double friction)
        {
            SimulationParameters parameters = WallScenes.Arch(60, 0.05, 20.0, 100.0);
            parameters.Scene.Walls[0].FrictionCoefficient = friction;
            parameters.Scene.Walls[0].Motion = Bent(x => (x.Z > 0.0 ? x.Z / 30.0 : 0.0) * new Vector3d(4.0, 3.0, 0.0));
            return parameters;
        }

        // The centreline of the arch, displaced in a cycle of 1 s.
        private static WallMotion Bent(Func<Vector3d, Vector3d> amplitude)
        {
            const double spacing = 3.0;
            var points = Enumerable.Range(0, 107).Select(k => new Vector3d(0.0, 0.0, spacing * (k - 107)))
                .Concat(Enumerable.Range(0, 32).Select(k => Math.PI * k / 31.0).Select(angle => new Vector3d(0.0,
                    30.0 * (1.0 - Math.Cos(angle)), 30.0 * Math.Sin(angle))))
                .Concat(Enumerable.Range(1, 66).Select(k => new Vector3d(0.0, 60.0, -spacing * k))).ToArray();
            return Beating(points, spacing, amplitude, 1.0);
        }

        private static WallMotion Wavy()
        {
            Vector3d[] points = Enumerable.Range(0, 13).Select(k => new Vector3d(0.0, 0.3 * Math.Sin(0.5 * k),
                0.4 * (k - 6))).ToArray();
            WallMotion beat = Beating(points, 0.4, x => new Vector3d(0.2 * Math.Sin(x.Z), 0.1 * x.Z, 0.1), 1.0);
            return new WallMotion(beat.Cycles.Append(MotionCycle.Sine(2.0, 0.1, new Vector3d(0.0, 0.2, 0.1),
                new Vector3d(0.3, 0.1, 0.4), new Vector3d(0.5, 0.0, 0.0))).ToArray(), beat.Branches, 0.4, 0.1);
        }

        private static WallMotion Beating(Vector3d[] points, double spacing, Func<Vector3d, Vector3d> amplitude,
            double period)
        {
            double[] phases = Enumerable.Range(0, 12).Select(k => k / 12.0).ToArray();
            double[][] rows = Array.ConvertAll(phases, phase => points.SelectMany(x =>
            {
                Vector3d moved = Math.Sin(2.0 * Math.PI * phase) * amplitude(x);
                return new[] { moved.X, moved.Y, moved.Z, 0.0, 0.0, 0.0, 0.0 };
            }).ToArray());
            return new WallMotion(new[] { MotionCycle.Table(period, 0.0, phases, rows, null) }, new[] { points },
                spacing, 0.25 * period);
        }

        private static SimulationParameters Lying(MotionCycle cycle, double ramp)
        {
            SimulationParameters parameters = WallScenes.Wire(40, 0.178e-3);
            parameters.Scene.GuidewireLength = 100.0;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.Walls = WallScenes.Floor(-0.19);
            parameters.Scene.Walls[0].Motion = new WallMotion(new[] { cycle }, Array.Empty<Vector3d[]>(), 1.0, ramp);
            parameters.Drive.Kind = Drive.Hold;
            parameters.Drive.Displacement = 0.0;
            parameters.Material.MassDamping = 50.0;
            parameters.Method.MaxSimulationSteps = 10000;
            return parameters;
        }

        private static void Go(Simulation simulation, int steps)
        {
            for (int k = 0; k < steps; k++)
            {
                simulation.Step();
            }
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running), simulation.Reason);
        }
    }
}
