using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What schemes take of the angular momentum of a wire that spins freely, and what a run says of
    /// it.</summary>
    public sealed class SpinLossTests
    {
        private const int N = 10;
        private const string Warned = "angular momentum";

        /// <summary>A straight wire about a lateral axis. What the run tells is what is missing, to a third, wherever
        /// that is more than 1 %; it tells nothing where less is missing.</summary>
        [TestCase(Integrator.Esdirk3, 0.3, 600)]
        [TestCase(Integrator.Esdirk3, 0.25, 300)]
        [TestCase(Integrator.Esdirk3, 0.1, 600)]
        [TestCase(Integrator.Esdirk4, 0.4, 300)]
        [TestCase(Integrator.Esdirk4, 0.2, 600)]
        [TestCase(Integrator.Trbdf2, 0.3, 600)]
        [TestCase(Integrator.Trbdf2, 0.17, 500)]
        [TestCase(Integrator.Trbdf2, 0.1, 600)]
        [TestCase(Integrator.Bdf2, 0.3, 600)]
        [TestCase(Integrator.Bdf2, 0.1, 400)]
        [TestCase(Integrator.Bdf2, 0.04, 600)]
        [TestCase(Integrator.ImplicitEuler, 0.3, 600)]
        [TestCase(Integrator.ImplicitEuler, 0.02, 600)]
        [TestCase(Integrator.ImplicitEuler, 0.003, 600)]
        public void FreeSpin_IsToldWhatItLoses(Integrator integrator, double angle, int steps)
        {
            Simulation run = Spun(integrator, angle / 1e-3 * Vector3d.UnitX, steps, out double lost);
            TestContext.WriteLine("{0:P3} {1}", lost, run.Reason);
            if (Math.Abs(lost) < 0.009)
            {
                Assert.That(run.Reason, Does.Not.Contains(Warned));
                return;
            }
            Assert.That(run.Reason, Does.Contain(Warned));
            string stated = run.Reason.Split(new[] { "by some " }, StringSplitOptions.None)[1].Split(new[] { ' ' })[0];
            double expected = 0.01 * double.Parse(stated, System.Globalization.CultureInfo.InvariantCulture);
            Assert.That(Math.Abs(lost), Is.EqualTo(expected).Within(expected / 3.0));
        }

        /// <summary>A mass on a stiff bar in steps of implicit Euler: 2 sin(theta_1) = sin(theta_0 + theta_1), by
        /// which it slows down as 1/sqrt(1 + 2 theta_0^2 k).</summary>
        [TestCase(0.01)]
        [TestCase(0.1)]
        public void ImplicitEuler_SlowsASpinAsItSlowsAMassOnABar(double angle)
        {
            const int Steps = 300;
            Spun(Integrator.ImplicitEuler, angle / 1e-3 * Vector3d.UnitX, Steps, out double lost);
            double turn = angle;
            for (int k = 0; k < Steps; k++)
            {
                // tan(theta_1) (2 - cos(theta_0)) = sin(theta_0).
                turn = Math.Atan2(Math.Sin(turn), 2.0 - Math.Cos(turn));
            }
            Assert.That(1.0 - lost, Is.EqualTo(turn / angle).Within(0.01 * turn / angle));
            Assert.That(turn / angle, Is.EqualTo(1.0 / Math.Sqrt(1.0 + 2.0 * angle * angle * Steps)).Within(0.01));
        }

        [Test]
        public void SpinAboutTheWiresOwnAxis_LosesNothing([Values] bool isFast)
        {
            double rate = isFast ? 3000.0 : 30.0;
            Simulation run = Spun(Integrator.Esdirk3, rate * Vector3d.UnitZ, 200, out double lost);
            Assert.That(Math.Abs(lost), Is.LessThan(1e-6));
            Assert.That(run.Reason, Does.Not.Contains(Warned));
        }

        /// <summary>A wire that is held may give its angular momentum to what holds it.</summary>
        [Test]
        public void HeldWire_IsNotWarnedOfASpin()
        {
            Simulation run = Spun(Integrator.Bdf2, 200.0 * Vector3d.UnitX, 300, out _, ProximalEnd.Held);
            Assert.That(run.Reason, Does.Not.Contains(Warned));
        }

        // In steps of 1 ms; what is lost of the angular momentum about the spin's axis, relative.
        private static Simulation Spun(Integrator integrator, Vector3d spin, int steps, out double lost,
            ProximalEnd end = ProximalEnd.Free)
        {
            SimulationParameters parameters = Rods.Clamped(N, Solver.Direct, 1e-3, steps);
            parameters.Method.Integrator = integrator;
            parameters.Scene.ProximalEnd = end;
            var x = new Vector3d[N + 1];
            var v = new Vector3d[N + 1];
            var q = new Quaterniond[N];
            var w = new Vector3d[N];
            double first = end == ProximalEnd.Free ? -0.5 : 0.0;
            for (int i = 0; i <= N; i++)
            {
                x[i] = 1e3 * Rods.Length * ((double)i / N + first) * Vector3d.UnitZ;
                v[i] = Vector3d.Cross(spin, x[i]);
                q[Math.Min(i, N - 1)] = Quaterniond.Identity;
                w[Math.Min(i, N - 1)] = spin;
            }
            parameters.Scene.Start = new RodStart(x, q, v, w);
            Simulation run = Simulation.Create(parameters);
            Vector3d before = AngularMomentum(run.State);
            Wires.Finish(run);
            lost = 1.0 - Vector3d.Dot(AngularMomentum(run.State), before) / before.LengthSquared;
            return run;
        }

        private static Vector3d AngularMomentum(RodState state)
        {
            var wire = new WireEnergy(N, Rods.Radius);
            return wire.Of(Array.ConvertAll(state.Positions, p => 1e-3 * p),
                Array.ConvertAll(state.Velocities, p => 1e-3 * p), state.Orientations, state.AngularVelocities)
                .AngularMomentum;
        }
    }
}
