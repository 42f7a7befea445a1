using System;
using System.Numerics;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Motion against closed forms: modes, the exact chain, a parabola, a top.</summary>
    public sealed class MotionTests
    {
        [Category("Row")]
        [TestCase(Integrator.ImplicitEuler, 1.0)]
        [TestCase(Integrator.Bdf2, 2.0)]
        [TestCase(Integrator.Trbdf2, 2.0)]
        [TestCase(Integrator.Esdirk3, 3.0)]
        [TestCase(Integrator.Esdirk4, 4.0)]
        public void OneMode_MovesWithTheSchemesOrder(Integrator scheme, double order)
        {
            // First mode of the chain as start, amplitude 1e-4 L. After one period the tip's y - i v/omega is that of
            // the start times lambda^N; the error of log(lambda) per unit time is the scheme's own.
            const int N = 10;
            RodVector[] mode = Modes.Of(Rods.Wire(N), new RodSupports()).First(out double omega);
            int[] steps = { 10, 20, 40, 80, 160 };
            double finest = 0.0;
            double last = 0.0;    // order from 80 to 160
            double sumX = 0.0;
            double sumY = 0.0;
            double sumXX = 0.0;
            double sumXY = 0.0;
            foreach (int count in steps)
            {
                double x = Math.Log(1.0 / count);
                double y = Math.Log(ModeError(scheme, mode, omega, N, count));
                last = (finest - y) / Math.Log(2.0);
                finest = y;
                sumX += x;
                sumY += y;
                sumXX += x * x;
                sumXY += x * y;
            }
            double slope = (steps.Length * sumXY - sumX * sumY) / (steps.Length * sumXX - sumX * sumX);
            Assert.That(slope, Is.EqualTo(order).Within(0.1));
            Row.Holds("order in time on the first mode, 80 to 160 steps a period, " + scheme, last, order, 0.1);
        }

        [Test]
        public void CantileverLetGo_FollowsTheModalSeries()
        {
            // k = 1e-3: deflection L/3000, where linear theory holds to 1e-6. y(t) = sum of modes of the clamped-free
            // beam with the static tip-load shape as start.
            const int N = 16;
            const double K = 1e-3;
            const double Step = 0.5e-3;
            const int Steps = 400;
            MaterialRod rod = Rods.Wire(N);
            RodShape shape = Rods.AtRest(rod, new RodSupports(), Vector3d.Zero,
                new Vector3d(0.0, K * Rods.BendForce, 0.0), Vector3d.Zero);
            RodDynamics motion = Start(rod, new RodSupports(), Rods.Schedule(), shape, Integrator.Esdirk4, 1e-10);
            double square = 0.0;
            double reference = 0.0;
            for (int i = 1; i <= Steps; i++)
            {
                Assert.That(motion.Step(Step), Is.Null);
                double exact = ModalTip(K, motion.Time);
                square += (shape.X[N].Y - exact) * (shape.X[N].Y - exact);
                reference += exact * exact;
            }
            Assert.That(Math.Sqrt(square / reference), Is.LessThan(3e-3));
        }

        [Test]
        public void FreeRod_FliesOnItsParabola()
        {
            // Bent, spinning, free at both ends: the centre of mass falls as a point does. ESDIRK3 is exact for a
            // parabola.
            const int N = 8;
            const double Step = 2e-3;
            MaterialRod rod = Rods.Wire(N);
            RodShape shape = Rods.Random(rod, 0.05, 0.0, 3);
            var schedule = Rods.Schedule(new SceneParameters { Gravity = new Vector3d(0.0, -9.81, 0.0) });
            var supports = new RodSupports { Proximal = ProximalEnd.Free };
            RodDynamics motion = Start(rod, supports, schedule, shape, Integrator.Esdirk3, 1e-10);
            double mass = Rods.Density * Rods.Area * Rods.Length;
            Vector3d start = Centre(shape);
            Rods.Step(motion, Step, 50);
            double fall = 0.5 * 9.81 * motion.Time * motion.Time;
            Vector3d centre = Centre(shape);
            Assert.That(centre.Y - start.Y, Is.EqualTo(-fall).Within(1e-8));
            Assert.That(centre.X - start.X, Is.EqualTo(0.0).Within(1e-8));
            Assert.That(Rods.Momentum(motion).Y, Is.EqualTo(-mass * 9.81 * motion.Time).Within(1e-8 * mass));
        }

        [Category("Row")]
        [TestCase(Solver.Direct, 1, 1e-5)]
        [TestCase(Solver.Explicit, 5, 1e-3)]
        public void DisplacedBase_SendsTheExactChainsWave(Solver solver, int substeps, double limit)
        {
            // n = 30 masses M/31 on springs EA/l, base displaced by 1 mm at once. With all masses equal the free end's
            // chain has omega_k = 2 sqrt(K/m) sin(a_k/2), a_k = (2k - 1) pi/(2n + 1), modes sin(i a_k).
            const int N = 30;
            SimulationParameters parameters = Rods.Clamped(N, solver, 2.5e-7, 8000);
            parameters.Method.Integrator = solver == Solver.Direct ? Integrator.Esdirk4 : parameters.Method.Integrator;
            parameters.Method.Substeps = substeps;
            parameters.Material.MassRule = MassRule.Uniform;
            parameters.Drive.Displacement = 1.0;
            Simulation run = Simulation.Create(parameters);
            double square = 0.0;
            double reference = 0.0;
            Wires.Finish(run, () =>
            {
                double exact = ChainTip(N, 1.0, run.StepCount * 2.5e-7);
                square += Math.Pow(run.State.Positions[N].Z - 300.0 - exact, 2);
                reference += exact * exact;
            });
            Row.Holds("bar struck by 1 mm, n = 30, 2 ms, " + solver + ": RMS error of its tip",
                Math.Sqrt(square / reference), 0.0, limit);
        }

        [Category("Row")]
        [TestCase(Solver.Explicit, 1, 2.0)]
        [TestCase(Solver.Xpbd, 100, 1.0)]
        public void AxialMode_MovesWithTheOrderOfSmallSteps(Solver solver, int sweeps, double order)
        {
            // Half a period in 40 and 80 steps.
            var errors = new double[2];
            for (int k = 0; k < 2; k++)
            {
                int steps = 40 << k;
                SimulationParameters parameters = AxialMode(solver, 2 * steps, steps, out double amplitude, out _);
                parameters.Method.ConstraintSolverSteps = sweeps;
                Simulation run = Simulation.Create(parameters);
                Wires.Finish(run, () => errors[k] += Math.Pow(run.State.Positions[4].Z - 300.0
                    - amplitude * Math.Cos(Math.PI * run.StepCount / steps), 2) / steps);
            }
            Row.Holds("first axial mode, 80 to 160 steps a period, " + solver + ": order in time",
                0.5 * Math.Log(errors[0] / errors[1], 2.0), order, 0.1);
        }

        [Category("Row")]
        [TestCase(Solver.Explicit, 1)]
        [TestCase(Solver.Xpbd, 70, Category = "Long")]
        public void AxialMode_KeepsTheEnergyThatSmallStepsLeave(Solver solver, int substeps)
        {
            // Verlet's steps keep it; xpbd's are implicit Euler's, by which x + i v/omega is divided by 1 + i omega h.
            SimulationParameters parameters = AxialMode(solver, 100, 10_000, out double amplitude, out double omega);
            parameters.Method.Substeps = substeps;
            parameters.Method.ConstraintSolverSteps = 3;
            RodState state = Wires.Finish(parameters).State;
            double turn = 0.02 * Math.PI / substeps;
            Row.Holds("axial mode, energy left after 100 periods of 100 steps, " + solver,
                Math.Pow((state.Positions[4].Z - 300.0) / amplitude, 2)
                + Math.Pow(state.Velocities[4].Z / (omega * amplitude), 2),
                solver == Solver.Xpbd ? Math.Pow(1.0 + turn * turn, -10_000 * substeps) : 1.0, 1e-4);
        }

        /// <summary>Over 100 periods of the first mode in 100 steps each.</summary>
        [Test]
        [Category("Row")]
        public void OneMode_KeepsTheEnergyThatItsSchemeLeaves([Values(Integrator.ImplicitEuler, Integrator.Bdf2,
            Integrator.Trbdf2, Integrator.Esdirk3, Integrator.Esdirk4)] Integrator scheme)
        {
            var z = new Complex(0.0, 0.02 * Math.PI);
            Complex growth;
            Complex first = Complex.One;
            if (scheme == Integrator.Bdf2)
            {
                // The roots of (3 - 2 z) g^2 - 4 g + 1 = 0; the first step is implicit Euler's.
                Complex root = Complex.Sqrt(1.0 + 2.0 * z);
                growth = (2.0 + root) / (3.0 - 2.0 * z);
                Complex other = (2.0 - root) / (3.0 - 2.0 * z);
                first = (1.0 / (1.0 - z) - other) / (growth - other);
            }
            else
            {
                growth = RungeKuttaSchemeTests.Growth(DirectSetup.Scheme(scheme)!, z);
            }
            RodVector[] mode = Modes.Of(Rods.Wire(10), new RodSupports()).First(out double omega);
            Row.Holds("first mode, energy left after 100 periods of 100 steps, " + scheme,
                Math.Pow(ModeAfter(scheme, mode, omega, 10, 100, 100).Magnitude, 2),
                Math.Pow(first.Magnitude, 2) * Math.Pow(growth.Magnitude, 20_000), 1e-6);
        }

        [TestCase(Integrator.ImplicitEuler, DistalEnd.Free)]
        [TestCase(Integrator.Bdf2, DistalEnd.Free)]
        [TestCase(Integrator.Trbdf2, DistalEnd.Free)]
        [TestCase(Integrator.Esdirk3, DistalEnd.Free)]
        [TestCase(Integrator.Esdirk4, DistalEnd.Free)]
        [TestCase(Integrator.Esdirk3, DistalEnd.Clamped)]
        public void TurnedAndMovedScene_MovesTheSame(Integrator scheme, DistalEnd distal)
        {
            // Weight, a tip force that is let go half-way and turning clamps. Rounding of the positions decides where a
            // stage may end, so shapes differ by what is then left: the unbalanced force allowed, below 1e-8 of the
            // load, bends by less than 1e-8 L; by the second order of Newton's last step far less is left.
            const int N = 10;
            Quaterniond turn = Quaterniond.FromAxisAngle(Vector3d.Normalize(new Vector3d(1.0, 0.4, -0.3)), 1.9);
            var offset = new Vector3d(0.5, -0.2, 0.1);
            RodShape[] shapes = new RodShape[2];
            for (int k = 0; k < 2; k++)
            {
                Quaterniond r = k == 0 ? Quaterniond.Identity : turn;
                MaterialRod rod = Rods.Wire(N);
                var shape = new RodShape(N);
                shape.SetStraight(k == 0 ? Vector3d.Zero : offset, r, Rods.Stations(rod));
                var schedule = Rods.Schedule(new SceneParameters
                {
                    Gravity = Quaterniond.Rotate(r, new Vector3d(3.0, -9.81, 1.0)),
                    TipForce = Quaterniond.Rotate(r, Rods.BendForce * new Vector3d(0.5, 1.0, 0.0)),
                    TipForceReleaseTime = 0.0255,
                    DistalRotation = 1.0,
                    DistalRampTime = 0.03,
                }, shape, 20.0);
                RodDynamics motion = Start(rod, new RodSupports { Distal = distal }, schedule, shape, scheme, 1e-8);
                Rods.Step(motion, 1e-3, 50);
                shapes[k] = shape;
            }
            double largest = 0.0;
            for (int i = 0; i <= N; i++)
            {
                Vector3d expected = Quaterniond.Rotate(turn, shapes[0].X[i]) + offset;
                largest = Math.Max(largest, Vector3d.Distance(shapes[1].X[i], expected));
            }
            Assert.That(largest, Is.LessThan(1e-10 * Rods.Length));
        }

        [Test]
        public void SpinningElement_KeepsThirdOrder_ForLargeTurns()
        {
            double coarse = TopError(20);
            double fine = TopError(40);
            Assert.That(Math.Log(coarse / fine) / Math.Log(2.0), Is.EqualTo(3.0).Within(0.1));
        }

        internal static RodDynamics Start(MaterialRod rod, RodSupports supports, RodSchedule schedule, RodShape shape,
            Integrator scheme, double tolerance)
        {
            return new RodDynamics(new RodTerms(rod, supports), schedule, shape, DirectSetup.Scheme(scheme),
                tolerance, 100);
        }

        /// <summary>One element that hardly resists: a top.</summary>
        /// <param name="secondInertia">About d2, for each length; that about d1 is 1.</param>
        internal static MaterialRod Top(double secondInertia)
        {
            var rod = new MaterialRod(1);
            rod.Length[0] = 1.0;
            rod.StretchStiffness[0] = 1e-9;
            rod.ShearStiffness[0] = 1e-9;
            rod.BendStiffness1[0] = 1.0;
            rod.BendStiffness2[0] = 1.0;
            rod.TwistStiffness[0] = 1.0;
            rod.LineDensity[0] = 1.0;
            rod.RotaryInertia1[0] = 1.0;
            rod.RotaryInertia2[0] = secondInertia;
            return rod;
        }

        /// <summary>Error of orientation and angular velocity of one element that nothing holds: a symmetric top with
        /// I = diag(1, 1, 2). Along its own axes (w1, w2) turns at w3; in space the top is turned by exp(t L/I1) after
        /// a turn of -w3 t about its own axis, L its angular momentum.</summary>
        private static double TopError(int steps)
        {
            const double Time = 0.05;
            const double Spin = 40.0;
            const double Tilt = 15.0;
            MaterialRod rod = Top(1.0);
            RodShape shape = Rods.Straight(rod);
            var supports = new RodSupports { Proximal = ProximalEnd.Free };
            RodDynamics motion = Start(rod, supports, Rods.Schedule(), shape, Integrator.Esdirk3, 1e-13);
            motion.Begin(new Vector3d[2], new[] { new Vector3d(Tilt, 0.0, Spin) }, false);
            Rods.Step(motion, Time / steps, steps);
            double angle = Spin * Time;
            var spin = new Vector3d(Tilt * Math.Cos(angle), Tilt * Math.Sin(angle), Spin);
            Quaterniond turned = RotationVector.Exp(Time * new Vector3d(Tilt, 0.0, 2.0 * Spin))
                * Quaterniond.FromAxisAngle(Vector3d.UnitZ, -angle);
            return Vector3d.Distance(motion.Spins[0], spin) / Spin
                + RotationVector.Log(turned.Conjugate * shape.Q[0]).Length;
        }

        private static double ModeError(Integrator scheme, RodVector[] mode, double omega, int n, int steps) =>
            // After one period the exact factor is 1, so its logarithm is 0.
            Complex.Log(ModeAfter(scheme, mode, omega, n, steps, 1)).Magnitude;

        /// <summary>y + i v/omega of the tip after some periods, over that of the start.</summary>
        private static Complex ModeAfter(Integrator scheme, RodVector[] mode, double omega, int n, int steps,
            int periods)
        {
            const double Amplitude = 1e-4 * Rods.Length;
            MaterialRod rod = Rods.Wire(n);
            RodShape straight = Rods.Straight(rod);
            RodShape shape = Rods.Straight(rod);
            RodStep.Apply(rod, new RodSupports(), straight, mode, Amplitude, shape);
            RodDynamics motion = Start(rod, new RodSupports(), Rods.Schedule(), shape, scheme, 1e-12);
            double start = shape.X[n].Y;
            Rods.Step(motion, 2.0 * Math.PI / omega / steps, periods * steps);
            return new Complex(shape.X[n].Y, motion.Velocities[n].Y / omega) / start;
        }

        /// <summary>A wire in the first axial mode of four springs and lumped masses, sin(i pi/8) and 2 sqrt(k/m)
        /// sin(pi/16), so thick that its shear does not limit the step.</summary>
        private static SimulationParameters AxialMode(Solver solver, int stepsOfAPeriod, int steps,
            out double amplitude, out double omega)
        {
            const int N = 4;
            amplitude = 3e-3;  // units
            double sound = Rods.Length / N / Math.Sqrt(Rods.Young / Rods.Density);
            omega = 2.0 / sound * Math.Sin(Math.PI / 16.0);
            SimulationParameters parameters = Rods.Clamped(N, solver, 2.0 * Math.PI / omega / stepsOfAPeriod, steps);
            parameters.Material.WireRadius = 0.05;
            parameters.Material.MassRule = MassRule.Lumped;
            RodState start = Wires.Straight(parameters);
            for (int i = 0; i <= N; i++)
            {
                start.Positions[i] += amplitude * Math.Sin(i * Math.PI / 8.0) * Vector3d.UnitZ;
            }
            parameters.Scene.Start = new RodStart(start.Positions, start.Orientations, start.Velocities,
                start.AngularVelocities);
            return parameters;
        }

        private static double ModalTip(double k, double time)
        {
            // Static shape k L (3 s^2 - s^3)/6 on s in [0, 1]; tip displacement sum a_j phi_j(1) cos(omega_j t) with
            // a_j = (phi_j, y)/(phi_j, phi_j) and (phi_j, y) = k L phi_j(1)/(beta_j)^4 by parts, (phi, phi) =
            // phi(1)^2/4.
            double sum = 0.0;
            double frequency = Math.Sqrt(Rods.BendStiffness / (Rods.Density * Rods.Area)) / (Rods.Length * Rods.Length);
            for (int j = 1; j <= 12; j++)
            {
                double beta = Root(j);
                sum += 4.0 * k * Rods.Length / Math.Pow(beta, 4) * Math.Cos(beta * beta * frequency * time);
            }
            return sum;
        }

        private static double Root(int mode)
        {
            double b = (mode - 0.5) * Math.PI;
            for (int i = 0; i < 50; i++)
            {
                // cos(b) + 1/cosh(b) = 0 by Newton.
                b += (Math.Cos(b) + 1.0 / Math.Cosh(b)) / (Math.Sin(b) + Math.Sinh(b) / (Math.Cosh(b) * Math.Cosh(b)));
            }
            return b;
        }

        private static double ChainTip(int n, double shift, double time)
        {
            double mass = Rods.Density * Rods.Area * Rods.Length / (n + 1);
            double spring = Rods.Young * Rods.Area * n / Rods.Length;
            double sum = 0.0;
            for (int k = 1; k <= n; k++)
            {
                double a = (2.0 * k - 1.0) * Math.PI / (2.0 * n + 1.0);
                double overlap = 0.0;
                double square = 0.0;
                for (int i = 1; i <= n; i++)
                {
                    overlap += Math.Sin(i * a);
                    square += Math.Sin(i * a) * Math.Sin(i * a);
                }
                double omega = 2.0 * Math.Sqrt(spring / mass) * Math.Sin(0.5 * a);
                sum += overlap / square * Math.Sin(n * a) * Math.Cos(omega * time);
            }
            return shift * (1.0 - sum);
        }

        private static Vector3d Centre(RodShape shape)
        {
            Vector3d sum = Vector3d.Zero;
            for (int j = 0; j < shape.ElementCount; j++)
            {
                sum += 0.5 * (shape.X[j] + shape.X[j + 1]);
            }
            return sum / shape.ElementCount;
        }
    }
}
