using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Damping in SI units: a mode of circular frequency w decays with the ratio a/(2 w) + b w/2, under every
    /// scheme and time step.</summary>
    public sealed class DampingTests
    {
        private const int N = 40;
        private const int Periods = 4;

        // beta L of the clamped-free beam: cos(beta L) cosh(beta L) = -1.
        private static readonly double[] Roots = { 1.8751040687, 4.6940911330, 7.8547574382 };

        [Test]
        public void Modes_DecayAsTheirRatioSays([Values(1, 2, 3)] int mode, [Values(true, false)] bool ofMass,
            [Values(Integrator.Bdf2, Integrator.Trbdf2, Integrator.Esdirk3, Integrator.Esdirk4)]
            Integrator integrator)
        {
            if (mode == 2)
            {
                Rods.OnlyInFull("the first and the third");
            }
            const double Ratio = 0.02;
            double omega = Omega(mode);
            MaterialRod rod = Rods.Wire(N);
            rod.MassDamping = ofMass ? 2.0 * omega * Ratio : 0.0;
            rod.MaterialDamping = ofMass ? 0.0 : 2.0 * Ratio / omega;
            double measured = Decrement(rod, mode, integrator, 160);
            double expected = 2.0 * Math.PI * Ratio / Math.Sqrt(1.0 - Ratio * Ratio);
            TestContext.WriteLine("{0:G6} of {1:G6}", measured, expected);
            Assert.That(measured, Is.EqualTo(expected).Within(1).Percent);
        }

        [Test]
        public void Decay_DoesNotDependOnTheTimeStep()
        {
            MaterialRod rod = Rods.Wire(N);
            rod.MassDamping = 0.04 * Omega(1);
            rod.MaterialDamping = 0.04 / Omega(1);
            double coarse = Decrement(rod, 1, Integrator.Esdirk3, 50);
            Assert.That(coarse, Is.EqualTo(Decrement(rod, 1, Integrator.Esdirk3, 200)).Within(1).Percent);
        }

        /// <summary>In whole periods the energy decays by exp(-2 z w t). At 1e-8 of L a step, of an amplitude of 1e-3,
        /// the error of some hundred steps is below 1 %.</summary>
        [Test]
        public void CutSteps_DecayAsTheirRatioSays([Values(true, false)] bool ofMass,
            [Values(Integrator.Trbdf2, Integrator.Esdirk3, Integrator.Esdirk4)] Integrator integrator)
        {
            const double Ratio = 0.02;
            double omega = Omega(1);
            MaterialRod rod = Rods.Wire(N);
            rod.MassDamping = ofMass ? 2.0 * omega * Ratio : 0.0;
            rod.MaterialDamping = ofMass ? 0.0 : 2.0 * Ratio / omega;
            RodDynamics motion = Swinging(rod, 1, integrator, 1e-3, out omega);
            motion.Control.Tolerance = 1e-8;
            double start = motion.Energy;
            double period = 2.0 * Math.PI / (omega * Math.Sqrt(1.0 - Ratio * Ratio));
            Rods.Step(motion, 0.2 * period, 5 * Periods);
            Assert.That(motion.Control.Steps, Is.GreaterThan(10 * Periods), "steps are cut");
            Assert.That(motion.Control.StepsAbove, Is.Zero);
            double expected = 2.0 * Ratio * omega * Periods * period;
            TestContext.WriteLine("{0:G6} of {1:G6}", Math.Log(start / motion.Energy), expected);
            Assert.That(Math.Log(start / motion.Energy), Is.EqualTo(expected).Within(1).Percent);
        }

        /// <summary>A straight wire that is pulled and twisted evenly at its distal end: once its waves are damped, the
        /// clamp's force is EA (e + b e') and its couple GJ (t + b t'), and EA e and GJ t after the end of the
        /// ramp.</summary>
        [Test]
        public void RampedEnd_IsHeldByStrainAndItsRate([Values(Integrator.ImplicitEuler, Integrator.Bdf2,
            Integrator.Trbdf2, Integrator.Esdirk3, Integrator.Esdirk4)] Integrator integrator,
            [Values(0.0, 1e-7)] double stepError)
        {
            const double Damping = 5e-4;  // s
            const double Step = 1e-4;     // s
            const double Ramp = 0.01;     // s, 0.4 of it when looked at: waves have died out by exp(-8)
            const double Pull = 1e-4;     // of L
            const double Turn = 0.5;      // rad
            bool tellsError = integrator != Integrator.ImplicitEuler && integrator != Integrator.Bdf2;
            MaterialRod rod = Rods.Wire(8);
            rod.MaterialDamping = Damping;
            var terms = new RodTerms(rod, new RodSupports { Distal = DistalEnd.Clamped });
            RodShape shape = Rods.Straight(rod);
            var schedule = Rods.Schedule(new SceneParameters
            {
                DistalDisplacement = Pull * Rods.Length,
                DistalRotation = Turn,
                DistalRampTime = Ramp,
            }, shape);
            var motion = new RodDynamics(terms, schedule, shape, DirectSetup.Scheme(integrator), 1e-10, 50);
            motion.Control.Tolerance = tellsError ? stepError : 0.0;
            motion.Begin(new Vector3d[9], new Vector3d[8], true);
            for (int k = 1; k <= 200; k++)
            {
                Assert.That(motion.Step(Step), Is.Null);
                if (k == 40 || k == 200)
                {
                    double fraction = k == 40 ? 0.4 + Damping / Ramp : 1.0;
                    Assert.That(motion.ReactionAt(0).Z, Is.EqualTo(-fraction * Pull * Rods.Young * Rods.Area)
                        .Within(0.1).Percent, "force, step " + k);
                    double couple = motion.Reactions.ProximalCouple.Z;
                    Assert.That(couple, Is.EqualTo(-fraction * Turn * Rods.TwistStiffness / Rods.Length)
                        .Within(0.1).Percent, "couple, step " + k);
                    Assert.That(motion.Reactions.DistalCouple.Z, Is.EqualTo(-couple).Within(0.1).Percent);
                }
            }
        }

        /// <summary>The wire starts with velocities alone, so the damping is all that acts in the first step's explicit
        /// stage; without it there the error would fall by less.</summary>
        [TestCase(Integrator.Trbdf2, 2)]
        [TestCase(Integrator.Esdirk3, 3)]
        [TestCase(Integrator.Esdirk4, 4)]
        public void Motion_KeepsTheOrderOfItsScheme(Integrator integrator, int order)
        {
            double exact = Tip(integrator, 192);
            double coarse = Math.Abs(Tip(integrator, 12) - exact);
            double fine = Math.Abs(Tip(integrator, 24) - exact);
            TestContext.WriteLine("{0:G3} and {1:G3}, order {2:G3}", coarse, fine, Math.Log(coarse / fine, 2.0));
            Assert.That(Math.Log(coarse / fine, 2.0), Is.GreaterThan(order - 0.3));
        }

        [Test]
        public void RatesOfJoints_AreTheDifferencesOfTheirTurns([Values] BendLaw law)
        {
            const double Time = 1e-5;  // s; what differences leave is (w t)^2 of a rate
            MaterialRod rod = Rods.Wire(3);
            var supports = new RodSupports { Bend = law, Distal = DistalEnd.Clamped };
            BendTwistTerm bending = BendTwistTerm.Create(rod.Joints(supports), supports);
            RodShape shape = Rods.Random(rod, 0.8, 0.2, 5);
            var spins = new[]
            {
                new Vector3d(3.0, -1.0, 2.0), new Vector3d(0.5, 4.0, -2.0), new Vector3d(-1.0, 1.0, 5.0),
            };
            var proximal = new Vector3d(0.0, 0.0, 7.0);
            var distal = new Vector3d(0.0, 0.0, -6.0);
            Vector3d[][] turns = { new Vector3d[4], new Vector3d[4] };
            for (int k = 0; k < 2; k++)
            {
                double t = k == 0 ? -Time : Time;
                var moved = new RodShape(3);
                moved.CopyFrom(shape);
                for (int j = 0; j < 3; j++)
                {
                    moved.Q[j] = shape.Q[j] * RotationVector.Exp(t * spins[j]);
                }
                moved.ProximalFrame = shape.ProximalFrame * RotationVector.Exp(t * proximal);
                moved.DistalFrame = shape.DistalFrame * RotationVector.Exp(t * distal);
                bending.Measure(moved, turns[k]);
            }
            var rates = new Vector3d[4];
            bending.MeasureRates(shape, spins, proximal, distal, rates);
            for (int k = 0; k < 4; k++)
            {
                Vector3d expected = (0.5 / Time) * (turns[1][k] - turns[0][k]);
                Assert.That(Vector3d.Distance(rates[k], expected), Is.LessThan(1e-7 * expected.Length));
            }
        }

        /// <summary>A wire that turns as a whole changes no strain: Kelvin-Voigt damping leaves it alone.</summary>
        [Test]
        public void MaterialDamping_LeavesRigidTurnsAlone()
        {
            double plain = EnergyOfATurningWire(0.0);
            Assert.That(EnergyOfATurningWire(1e-3), Is.EqualTo(plain).Within(1e-3).Percent);
        }

        [TestCase(Solver.Xpbd)]
        [TestCase(Solver.Explicit)]
        [TestCase(Solver.Direct)]
        public void FreeWire_LosesItsMomentumAtTheRateOfItsDamping(Solver solver)
        {
            // P' = -a P: after 0.1 s at a = 5/s, exp(-0.5) of it.
            SimulationParameters parameters = Rods.Clamped(4, solver, 1e-3, 100);
            parameters.Method.Integrator = Integrator.Esdirk3;
            parameters.Method.Substeps = solver == Solver.Explicit ? 200 : 1;
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            parameters.Material.MassDamping = 5.0;
            var start = new RodState(4, 1e3 * Rods.Length, 1.0, 0.0);
            var velocities = new Vector3d[5];
            for (int i = 0; i <= 4; i++)
            {
                velocities[i] = new Vector3d(3.0, 0.0, 0.0);
            }
            parameters.Scene.Start = new RodStart(start.Positions, start.Orientations, velocities, null);
            RodState end = Wires.Run(parameters).State;
            Assert.That(end.Velocities[2].X, Is.EqualTo(3.0 * Math.Exp(-0.5)).Within(1e-3).Percent);
        }

        [Test]
        public void SpinningWire_LosesItsSpinAtTheRateOfItsDamping([Values(Integrator.Bdf2, Integrator.Trbdf2,
            Integrator.Esdirk3, Integrator.Esdirk4)] Integrator integrator)
        {
            // Free and straight, turning about its axis by nearly a whole turn a step: w' = -a w. The first step of
            // BDF2 is one of implicit Euler, which leaves (a dt)^2/2 of w.
            const double Damping = 5.0;  // 1/s
            const double Step = 1e-3;    // s
            MaterialRod rod = Rods.Wire(4);
            rod.MassDamping = Damping;
            var terms = new RodTerms(rod, new RodSupports { Proximal = ProximalEnd.Free });
            var motion = new RodDynamics(terms, Rods.Schedule(), Rods.Straight(rod),
                DirectSetup.Scheme(integrator), 1e-10, 50);
            var spins = new Vector3d[4];
            for (int j = 0; j < 4; j++)
            {
                spins[j] = new Vector3d(0.0, 0.0, 6000.0);
            }
            motion.Begin(new Vector3d[5], spins, false);
            Rods.Step(motion, Step, 100);
            Assert.That(motion.Spins[2].Z, Is.EqualTo(6000.0 * Math.Exp(-100.0 * Damping * Step))
                .Within(100.0 * (Damping * Step) * (Damping * Step)).Percent);
        }

        [Test]
        public void DampingAStep_WithAMaterial_IsRefused()
        {
            SimulationParameters parameters = Rods.Clamped(4, Solver.Direct, 1e-3, 1);
            parameters.Method.Integrator = Integrator.Esdirk3;
            parameters.Method.Damping = 0.1;
            Assert.That(() => Simulation.Create(parameters),
                Throws.ArgumentException.With.Message.Contains("massDamping"));
        }

        /// <summary>The tip's deflection, of L, at 0.6 of a period of mode 1 with a ratio of 0.3.</summary>
        private static double Tip(Integrator integrator, int steps)
        {
            MaterialRod rod = Rods.Wire(N);
            double omega = Omega(1);
            rod.MassDamping = 0.3 * omega;
            rod.MaterialDamping = 0.3 / omega;
            RodDynamics motion = Swinging(rod, 1, integrator, 1e-4, out omega);
            Rods.Step(motion, 0.6 * 2.0 * Math.PI / omega / steps, steps);
            return motion.Shape.X[N].Y / Rods.Length;
        }

        private static double Omega(int mode)
        {
            double root = Roots[mode - 1] / Rods.Length;
            return root * root * Math.Sqrt(Rods.BendStiffness / (Rods.Density * Rods.Area));
        }

        /// <summary>Decrease of the logarithm of a mode's amplitude in a period, from y^2 + (v/w)^2 of the tip at whole
        /// damped periods.</summary>
        private static double Decrement(MaterialRod rod, int mode, Integrator integrator, int steps)
        {
            RodDynamics motion = Swinging(rod, mode, integrator, 1e-4, out double omega);
            double ratio = 0.5 * (rod.MassDamping / omega + rod.MaterialDamping * omega);
            double step = 2.0 * Math.PI / (omega * Math.Sqrt(1.0 - ratio * ratio)) / steps;
            double first = 0.0;
            double last = 0.0;
            for (int k = 1; k <= (Periods + 1) * steps; k++)
            {
                Assert.That(motion.Step(step), Is.Null);
                double y = motion.Shape.X[N].Y;
                double v = motion.Velocities[N].Y / omega;
                first = k == steps ? y * y + v * v : first;
                last = y * y + v * v;
            }
            return 0.5 * Math.Log(first / last) / Periods;
        }

        /// <summary>A straight wire with the velocities of a mode, whose tip would swing by this fraction of
        /// L.</summary>
        private static RodDynamics Swinging(MaterialRod rod, int mode, Integrator integrator, double amplitude,
            out double omega)
        {
            var supports = new RodSupports();
            RodVector[] shape = Modes.Of(rod, supports).Mode(mode, out omega);
            var velocities = new Vector3d[N + 1];
            var spins = new Vector3d[N];
            double speed = amplitude * Rods.Length * omega;
            for (int i = 0; i <= N; i++)
            {
                velocities[i] = new Vector3d(0.0, speed * shape[i].X2, 0.0);
                if (i < N)
                {
                    spins[i] = new Vector3d(speed * shape[i].T1, 0.0, 0.0);
                }
            }
            var motion = new RodDynamics(new RodTerms(rod, supports), Rods.Schedule(), Rods.Straight(rod),
                DirectSetup.Scheme(integrator), 1e-11, 50);
            motion.Begin(velocities, spins, false);
            return motion;
        }

        private static double EnergyOfATurningWire(double damping)
        {
            const double Rate = 20.0;
            MaterialRod rod = Rods.Wire(10);
            rod.MaterialDamping = damping;
            var supports = new RodSupports { Proximal = ProximalEnd.Free };
            RodShape shape = Rods.Straight(rod);
            var velocities = new Vector3d[11];
            var spins = new Vector3d[10];
            for (int i = 0; i <= 10; i++)
            {
                velocities[i] = new Vector3d(Rate * (shape.X[i].Z - 0.5 * Rods.Length), 0.0, 0.0);
                spins[Math.Min(i, 9)] = new Vector3d(0.0, Rate, 0.0);
            }
            var terms = new RodTerms(rod, supports);
            var motion = new RodDynamics(terms, Rods.Schedule(), shape,
                DirectSetup.Scheme(Integrator.Bdf2), 1e-10, 50);
            motion.Begin(velocities, spins, false);
            Rods.Step(motion, 1e-4, 200);
            return motion.Energy;
        }
    }
}
