using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Wires that turn far, where stretching is stiff and driven all the time: what a scheme keeps there of
    /// energy, momenta and order. Energies are those of <see cref="WireEnergy"/>.</summary>
    [Category("Row")]
    public sealed class LargeTurnTests
    {
        [TestCase(Integrator.Trbdf2, Rods.Radius, 5e-5)]
        [TestCase(Integrator.Esdirk3, Rods.Radius, 5e-5)]
        [TestCase(Integrator.Esdirk4, Rods.Radius, 5e-5)]
        [TestCase(Integrator.Bdf2, Rods.Radius, 3e-4)]
        [TestCase(Integrator.Bdf2, 0.2 * Rods.Radius, 3e-4)]
        [TestCase(Integrator.Trbdf2, 0.2 * Rods.Radius, 5e-5)]
        [TestCase(Integrator.Esdirk3, 0.2 * Rods.Radius, 5e-5)]
        [TestCase(Integrator.Esdirk4, 0.2 * Rods.Radius, 5e-5)]
        public void Pendulum_LetGoLevel_KeepsItsEnergy(Integrator scheme, double radius, double fraction)
        {
            // On a ball joint, 2 s; as a fraction of m g L/2, the energy that falling turns into motion.
            const int N = 30;
            const double Gravity = 9.81;
            MaterialRod rod = MaterialRod.Round(N, Rods.Length, radius, Rods.Young, Rods.Shear, Rods.Density);
            RodShape shape = Rods.Straight(rod);
            var schedule = Rods.Schedule(new SceneParameters { Gravity = new Vector3d(0.0, -Gravity, 0.0) });
            RodDynamics motion = MotionTests.Start(rod, new RodSupports { Proximal = ProximalEnd.Held }, schedule,
                shape, scheme, 1e-6);
            var energy = new WireEnergy(N, radius);
            for (int k = 1; k <= 2000; k++)
            {
                Assert.That(motion.Step(1e-3), Is.Null);
            }
            energy.Of(shape.X, motion.Velocities, shape.Q, motion.Spins);
            double lost = energy.Kinetic + energy.Elastic + Gravity * energy.MassMoment.Y;
            Row.Holds("pendulum released from the horizontal, r = " + 1e3 * radius + " mm, 2 s at 1 ms, " + scheme
                + ": change of energy, m g L/2", lost / (0.5 * energy.Mass * Gravity * Rods.Length), 0.0, fraction);
        }

        [TestCase(Integrator.Trbdf2, 3e-4, 1e-4)]
        [TestCase(Integrator.Esdirk3, 3e-4, 1e-4)]
        [TestCase(Integrator.Esdirk4, 3e-4, 1e-4)]
        [TestCase(Integrator.Bdf2, 1.5e-3, 8e-4)]
        [TestCase(Integrator.ImplicitEuler, 1.0, 1.0)]  // it loses most of both, and gains none
        public void SpinningWire_KeepsEnergyAndMomenta(Integrator scheme, double energyShare, double momentumShare)
        {
            // Free, straight, 40 rad/s about its middle, 1 s.
            const int N = 20;
            const double Rate = 40.0;
            MaterialRod rod = Rods.Wire(N);
            RodShape shape = Rods.Straight(rod);
            RodDynamics motion = MotionTests.Start(rod, new RodSupports { Proximal = ProximalEnd.Free },
                Rods.Schedule(), shape, scheme, 1e-6);
            var velocities = new Vector3d[N + 1];
            var spins = new Vector3d[N];
            for (int i = 0; i <= N; i++)
            {
                velocities[i] = new Vector3d(0.0, Rate * (0.5 * Rods.Length - shape.X[i].Z), 0.0);
            }
            for (int j = 0; j < N; j++)
            {
                spins[j] = new Vector3d(Rate, 0.0, 0.0);
            }
            motion.Begin(velocities, spins, false);
            WireEnergy wire = Wire(N).Of(shape.X, velocities, shape.Q, spins);
            double energy = wire.Kinetic;
            Vector3d angular = wire.AngularMomentum;
            Rods.Step(motion, 0.5e-3, 2000);
            wire.Of(shape.X, motion.Velocities, shape.Q, motion.Spins);
            string what = "free wire spun at 40 rad/s, 1 s at 0.5 ms, " + scheme + ": ";
            Row.Holds(what + "energy left", (wire.Kinetic + wire.Elastic) / energy, 1.0, energyShare);
            Row.Holds(what + "change of angular momentum",
                Vector3d.Distance(wire.AngularMomentum, angular) / angular.Length, 0.0, momentumShare);
            Row.Holds(what + "momentum, m w L/2", wire.Momentum.Length / (wire.Mass * velocities[0].Length), 0.0, 1e-9);
        }

        [TestCase(Integrator.ImplicitEuler)]
        [TestCase(Integrator.Bdf2)]
        [TestCase(Integrator.Trbdf2)]
        [TestCase(Integrator.Esdirk3)]
        [TestCase(Integrator.Esdirk4)]
        public void WireThatSpinsByMoreThanHalfATurnInAStep_GoesOn(Integrator scheme)
        {
            // Free, about its own axis, by 4.4 rad a step.
            const int N = 5;
            const double Rate = 4400.0;
            MaterialRod rod = Rods.Wire(N);
            RodShape shape = Rods.Straight(rod);
            RodDynamics motion = MotionTests.Start(rod, new RodSupports { Proximal = ProximalEnd.Free },
                Rods.Schedule(), shape, scheme, 1e-6);
            var spins = new Vector3d[N];
            Array.Fill(spins, new Vector3d(0.0, 0.0, Rate));
            motion.Begin(new Vector3d[N + 1], spins, false);
            Rods.Step(motion, 1e-3, 10);
            Assert.That(motion.Clock.Halvings, Is.Zero);
            for (int j = 0; j < N; j++)
            {
                Assert.That(motion.Spins[j].Z, Is.EqualTo(Rate).Within(1e-6 * Rate));
                Assert.That(Math.Abs(shape.Q[j].W), Is.EqualTo(Math.Abs(Math.Cos(0.5 * 44.0))).Within(1e-6));
            }
        }

        [TestCase(Integrator.Bdf2, 2.0, 400)]
        [TestCase(Integrator.Trbdf2, 2.0, 200)]
        [TestCase(Integrator.Esdirk3, 3.0, 200)]
        [TestCase(Integrator.Esdirk4, 4.0, 200)]
        public void TurningWire_MovesWithTheSchemesOrder(Integrator scheme, double order, int steps)
        {
            double coarse = SoftWireError(scheme, steps);
            double fine = SoftWireError(scheme, 2 * steps);
            Row.Holds("soft wire tumbling by 4 rad, " + steps + " to " + 2 * steps + " steps, " + scheme
                + ": order in time", Math.Log(coarse / fine, 2.0), order, 0.2);
        }

        /// <summary>Distance of a thick soft wire from its motion by 1600 steps of the scheme of order 4, whose own
        /// error is 2e-10 by its errors with 100 to 400.</summary>
        /// <remarks>It tumbles in space at 20 rad/s for 0.2 s, 4 rad, bends and twists. Sound takes l/c = 10 ms along
        /// an element, c = 5 m/s: the fastest axial wave has sqrt(12) c/l = 346 rad/s, and elements turn against their
        /// shear with 2 sqrt(G/rho)/r = 310 rad/s; omega dt is 0.35 in the longest step.</remarks>
        private static double SoftWireError(Integrator scheme, int steps)
        {
            RodShape exact = SoftWire(Integrator.Esdirk4, 1600);
            RodShape shape = SoftWire(scheme, steps);
            double worst = Wires.Distance(shape.X, exact.X) / Rods.Length;
            for (int j = 0; j < shape.Q.Length; j++)
            {
                worst = Math.Max(worst, 2.0 * (exact.Q[j].Conjugate * shape.Q[j]).Imaginary.Length);
            }
            return worst;
        }

        private static RodShape SoftWire(Integrator scheme, int steps)
        {
            const int N = 6;
            const double Time = 0.2;
            const double Rate = 20.0;
            MaterialRod rod = MaterialRod.Round(N, Rods.Length, 0.02, 25.0 * Rods.Density, 9.6 * Rods.Density,
                Rods.Density);
            RodShape shape = Rods.Straight(rod);
            RodDynamics motion = MotionTests.Start(rod, new RodSupports { Proximal = ProximalEnd.Free },
                Rods.Schedule(), shape, scheme, 1e-13);
            var velocities = new Vector3d[N + 1];
            var spins = new Vector3d[N];
            var rate = new Vector3d(Rate, 0.3 * Rate, 0.0);
            for (int i = 0; i <= N; i++)
            {
                double s = shape.X[i].Z / Rods.Length - 0.5;
                velocities[i] = Vector3d.Cross(rate, new Vector3d(0.0, 0.0, Rods.Length * s))
                    + new Vector3d(0.5 * s * s, 0.0, 0.0);
            }
            for (int j = 0; j < N; j++)
            {
                double s = (j + 0.5) / N - 0.5;
                spins[j] = rate + new Vector3d(0.0, s / Rods.Length, 10.0 * s);
            }
            motion.Begin(velocities, spins, false);
            Rods.Step(motion, Time / steps, steps);
            return shape;
        }

        private static WireEnergy Wire(int n) => new WireEnergy(n, Rods.Radius);
    }
}
