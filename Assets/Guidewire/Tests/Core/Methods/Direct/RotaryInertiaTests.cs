using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Elements that are not as heavy to turn about d1 as about d2: a flat wire.</summary>
    public sealed class RotaryInertiaTests
    {
        private const double Flat = 9.0;  // EI about d1 over EI about d2
        private const double SoftTwist = 1e-5;

        /// <summary>One element that nothing holds or strains, I = (1, 2.5, 3.5), thrown about an axis near its middle
        /// one, about which it tumbles: against Euler's equations by Runge and Kutta's steps.</summary>
        [Test]
        public void FreeElement_TumblesByEulersEquations()
        {
            double coarse = TopError(200);
            double fine = TopError(400);
            TestContext.WriteLine("{0:G3} and {1:G3}, order {2:G3}", coarse, fine, Math.Log(coarse / fine, 2.0));
            Assert.That(fine, Is.LessThan(1e-4));
            Assert.That(Math.Log(coarse / fine, 2.0), Is.EqualTo(3.0).Within(0.3));
        }

        [TestCase(Solver.Direct)]
        [TestCase(Solver.Explicit)]
        public void FlatWireThrownFreely_KeepsItsAngularMomentum(Solver solver)
        {
            if (solver == Solver.Explicit)
            {
                Rods.OnlyInFull("direct, whose rotary inertia is the same");
            }
            // 0.2 s at 60 rad/s about an axis askew, and 200 rad/s about its own.
            const int N = 10;
            SimulationParameters parameters = FlatWire(N, solver, solver == Solver.Direct ? 5e-4 : 1e-4,
                solver == Solver.Direct ? 400 : 2000);
            parameters.Method.Integrator = solver == Solver.Direct ? Integrator.Esdirk3 : parameters.Method.Integrator;
            parameters.Method.Substeps = solver == Solver.Direct ? 1 : 400;
            parameters.Material.MassRule = solver == Solver.Direct ? MassRule.Consistent : MassRule.Lumped;
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            var spin = new Vector3d(40.0, 45.0, 200.0);
            var start = new RodState(N, 1e3 * Rods.Length, 1.0, 0.0);
            var velocities = new Vector3d[N + 1];
            var spins = new Vector3d[N];
            for (int i = 0; i <= N; i++)
            {
                Vector3d arm = start.Positions[i] - new Vector3d(0.0, 0.0, 0.5e3 * Rods.Length);
                velocities[i] = Vector3d.Cross(spin, arm);
                spins[Math.Min(i, N - 1)] = spin;
            }
            parameters.Scene.Start = new RodStart(start.Positions, start.Orientations, velocities, spins);
            MaterialRod rod = new MaterialScene(parameters, new Scene(parameters)).Rod;
            var mass = new RodMass(rod, parameters.Material.MassRule);
            Simulation run = Simulation.Create(parameters);
            Vector3d before = AngularMomentum(mass, run.State);
            Wires.Finish(run);
            double change = Vector3d.Distance(AngularMomentum(mass, run.State), before) / before.Length;
            TestContext.WriteLine("angular momentum off by {0:G3}", change);
            Assert.That(change, Is.LessThan(1e-4));
        }

        /// <summary>Twist of a clamped wire, sin(pi s/(2 L)): frequency sqrt(GJ/(rho (I1 + I2)))/(4 L), here with a GJ
        /// so small that it is the lowest of all.</summary>
        [Test]
        public void FlatWire_TwistsAtThePolarInertiasFrequency()
        {
            double polar = (1.0 + Flat) * Rods.Density * Rods.SecondMoment;
            double expected = Math.Sqrt(SoftTwist * Rods.TwistStiffness / polar) / (4.0 * Rods.Length);
            double coarse = TwistFrequency(20) / expected - 1.0;
            double fine = TwistFrequency(40) / expected - 1.0;
            TestContext.WriteLine("{0:G3} and {1:G3} of the frequency off", coarse, fine);
            Assert.That(Math.Abs(fine), Is.LessThan(1e-4));
            Assert.That(Math.Log(coarse / fine, 2.0), Is.GreaterThan(1.8));
            SimulationParameters parameters = FlatWire(20, Solver.Direct, 1e-3, 1);
            parameters.Material.Sections[0].TorsionalStiffness = SoftTwist * Rods.TwistStiffness;
            Assert.That(ModalAnalysis.Of(parameters, 1).Shapes[0], Is.All.EqualTo(Vector3d.Zero), "shifts nothing");
        }

        [Test]
        public void InertiaThatIsNotGiven_IsMassTimesStiffnessOverEA_AboutEachAxis()
        {
            SimulationParameters parameters = FlatWire(4, Solver.Direct, 1e-3, 1);
            MaterialRod rod = new MaterialScene(parameters, new Scene(parameters)).Rod;
            double second = Rods.Density * Rods.SecondMoment;
            Assert.That(rod.RotaryInertia1[2], Is.EqualTo(Flat * second).Within(1e-9).Percent);
            Assert.That(rod.RotaryInertia2[2], Is.EqualTo(second).Within(1e-9).Percent);
            Vector3d rotary = new RodMass(rod, MassRule.Consistent).Rotary[2];
            Assert.That(rotary.Z, Is.EqualTo((1.0 + Flat) * second * Rods.Length / 4.0).Within(1e-9).Percent);
        }

        private static SimulationParameters FlatWire(int n, Solver solver, double step, int steps)
        {
            SimulationParameters parameters = Rods.Clamped(n, solver, step, steps);
            parameters.Material.Sections = new[]
            {
                new WireSection
                {
                    From = 0.0,
                    To = 1e3 * Rods.Length,
                    BendingStiffness1 = Flat * Rods.BendStiffness,
                    BendingStiffness2 = Rods.BendStiffness,
                    TorsionalStiffness = Rods.TwistStiffness,
                },
            };
            return parameters;
        }

        // kg m^2/s about the origin: sum of x x M v and of R I w.
        private static Vector3d AngularMomentum(RodMass mass, RodState state)
        {
            Vector3d sum = Vector3d.Zero;
            Vector3d[] x = state.Positions;
            Vector3d[] v = state.Velocities;
            for (int i = 0; i < x.Length; i++)
            {
                Vector3d p = mass.Diagonal[i] * v[i];
                p += i > 0 ? mass.Coupling[i - 1] * v[i - 1] : Vector3d.Zero;
                p += i < mass.Coupling.Length ? mass.Coupling[i] * v[i + 1] : Vector3d.Zero;
                sum += 1e-6 * Vector3d.Cross(x[i], p);
            }
            for (int j = 0; j < mass.Rotary.Length; j++)
            {
                Vector3d w = state.AngularVelocities[j];
                Vector3d i = mass.Rotary[j];
                sum += Quaterniond.Rotate(state.Orientations[j], new Vector3d(i.X * w.X, i.Y * w.Y, i.Z * w.Z));
            }
            return sum;
        }

        private static double TwistFrequency(int n)
        {
            SimulationParameters parameters = FlatWire(n, Solver.Direct, 1e-3, 1);
            parameters.Material.Sections[0].TorsionalStiffness = SoftTwist * Rods.TwistStiffness;
            return ModalAnalysis.Of(parameters, 1).Frequencies[0];
        }

        private static double TopError(int steps)
        {
            const double Time = 1.0;
            MaterialRod rod = MotionTests.Top(2.5);
            RodShape shape = Rods.Straight(rod);
            RodDynamics motion = MotionTests.Start(rod, new RodSupports { Proximal = ProximalEnd.Free },
                Rods.Schedule(), shape, Integrator.Esdirk3, 1e-13);
            var spin = new Vector3d(0.1, 10.0, 0.2);
            motion.Begin(new Vector3d[2], new[] { spin }, false);
            Rods.Step(motion, Time / steps, steps);
            const int Fine = 20000;
            double h = Time / Fine;
            Quaterniond turned = Quaterniond.Identity;
            for (int k = 0; k < Fine; k++)
            {
                Vector3d a = Euler(spin);
                Vector3d b = Euler(spin + 0.5 * h * a);
                Vector3d c = Euler(spin + 0.5 * h * b);
                Vector3d d = Euler(spin + h * c);
                Vector3d middle = spin + 0.25 * h * (a + b);
                Vector3d next = spin + h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
                // Magnus: the turn of a step is that of its mean spin, but for terms of h^3.
                turned = turned * RotationVector.Exp(h / 6.0 * (spin + 4.0 * middle + next));
                spin = next;
            }
            return Vector3d.Distance(motion.Spins[0], spin) / 10.0
                + RotationVector.Log(turned.Conjugate * shape.Q[0]).Length;
        }

        // I w' = -w x I w with I = (1, 2.5, 3.5).
        private static Vector3d Euler(in Vector3d w) =>
            new Vector3d((2.5 - 3.5) * w.Y * w.Z, (3.5 - 1.0) / 2.5 * w.Z * w.X, (1.0 - 2.5) / 3.5 * w.X * w.Y);
    }
}
