using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Soft walls that follow with a delay: closed forms of a spring with a dashpot beside it.</summary>
    public sealed class WallLagTests
    {
        private const double Stiffness = 1e3;    // Pa
        private const double Time = 0.1;         // tau, s
        private const double Step = 2e-3;        // s
        private const int Loaded = 60;           // steps with weight; then as many without
        private const double After = Loaded * Step;
        private const double Rise = 20 * Step;
        private const double Left = 0.3;         // of the weight: without any the wire leaves the wall

        /// <summary>A wire that becomes heavy on the floor, and light again: w(t) = K u + K tau u', but for 4e-4 of it
        /// by inertia.</summary>
        [TestCase(Integrator.ImplicitEuler, 8e-3)]
        [TestCase(Integrator.Bdf2, 2e-3)]
        [TestCase(Integrator.Trbdf2, 2e-3)]
        [TestCase(Integrator.Esdirk3, 2e-3)]
        [TestCase(Integrator.Esdirk4, 2e-3)]
        public void Wire_SinksAndRises_AsASpringWithADashpot(Integrator integrator, double accuracy)
        {
            SimulationParameters parameters = Lying(integrator);
            Simulation simulation = Simulation.Create(parameters);
            double final = 6450.0 * Math.PI * 0.25e-6 * 9.81 / Stiffness;
            double work = 0.0;
            double before = 0.0;
            for (int k = 1; k <= 2 * Loaded; k++)
            {
                simulation.Step();
                double t = k * Step;
                double sunk = -1e-3 * simulation.State.Positions[3].Y;
                double exact = Ramp(t) - Ramp(t - Rise) - (1.0 - Left) * (Ramp(t - After) - Ramp(t - After - Rise));
                Assert.That(sunk, Is.EqualTo(final * exact).Within(accuracy * final), "step " + k);
                work += WeightAt(t - 0.5 * Step) * (sunk - before);
                before = sunk;
            }
            double force = final * Stiffness * parameters.Scene.GuidewireLength * 1e-3;
            double stored = 0.5 * force / final * before * before;
            double lost = -simulation.Report()!.Extremes!.WallWork;
            Assert.That(force * work - stored, Is.EqualTo(lost).Within(accuracy * force * work), "energy");
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Finished), simulation.Reason);
        }

        [Test]
        public void WallThatTheWireLeaves_ComesBackOnItsOwn_AndMeetsItLater([Values(0.5, 5.0)] double stepOfTime)
        {
            const double sunk = 0.02;
            const double h = 0.3;
            double time = h / stepOfTime;
            BarrierEnergy energy = OnPlane(time);
            RodShape pressed = At(sunk);
            RodShape lifted = At(-0.5);
            Move(energy, lifted, pressed, h);
            Move(energy, pressed, pressed, h);
            double stored = energy.Stored(pressed);
            double heat = energy.Lag!.Dissipated;
            double left = sunk;
            for (int k = 0; k < 4; k++)
            {
                Move(energy, k == 0 ? pressed : lifted, lifted, h);
                left *= time / (time + h);
                Assert.That(energy.Value(lifted), Is.EqualTo(0.0), "the wall does not pull");
                Assert.That(energy.Stored(lifted) + energy.Lag.Dissipated - heat, Is.EqualTo(stored)
                    .Within(2e-3 * stored), "what it stored turns into heat");
            }
            energy.BeginStep(lifted, h);
            Stage(energy, lifted, h);
            double next = left * time / (time + h);
            double below = next - 1e-4 * sunk;
            double barrier = BarrierAlone(below);
            Assert.That(ForceOn(energy, At(below)), Is.EqualTo(barrier).Within(1e-9), "the spring of a wall behind");
            double above = next + 0.1 * sunk;
            double expected = BarrierAlone(above) + 7.0 * (1.0 + time / h) * (above - next);
            Assert.That(ForceOn(energy, At(above)), Is.EqualTo(expected).Within(1e-9 * expected));
        }

        [Test]
        public void Restored_ItGoesOnWithTheSameBits_AndAChangedTimeCounts()
        {
            SimulationParameters parameters = Lying(Integrator.ImplicitEuler);
            parameters.Scene.Walls[0].FrictionCoefficient = 0.2;
            Simulation simulation = Simulation.Create(parameters);
            for (int k = 0; k < Loaded + 10; k++)
            {
                simulation.Step();
            }
            Simulation restored = Simulation.Restore(parameters, simulation.Save());
            Simulation sudden = simulation.Continue(Lying(Integrator.ImplicitEuler, 0.0));
            Simulation slower = sudden.Continue(Lying(Integrator.ImplicitEuler, 10.0 * Time));
            double before = simulation.State.Positions[3].Y;
            foreach (Simulation each in new[] { simulation, restored, sudden, slower })
            {
                each.Step();
                Assert.That(each.Outcome, Is.EqualTo(Outcome.Running), each.Reason);
            }
            Assert.That(restored.State.Positions, Is.EqualTo(simulation.State.Positions));
            double rise = simulation.State.Positions[3].Y - before;
            Assert.That(slower.State.Positions[3].Y - before, Is.LessThan(0.5 * rise));
            Assert.That(sudden.State.Positions[3].Y - before, Is.GreaterThan(2.0 * rise));
        }

        [Test]
        public void Gradient_IsTheDifferenceOfTheEnergy(
            [ValueSource(typeof(TestShapes), nameof(TestShapes.Names))] string name)
        {
            int tried = 0;
            for (int seed = 0; seed < 400 && tried < RandomGeometry.Cases(6, 2); seed++)
            {
                var random = new RandomGeometry(seed);
                var shape = new RodShape(6);
                var velocities = new Vector3d[7];
                Vector3d x = random.Point();
                Vector3d step = 0.2 * random.Direction();
                for (int i = 0; i <= 6; i++)
                {
                    shape.X[i] = x;
                    velocities[i] = 0.1 * random.Point();
                    x += step + 0.05 * random.Point();
                }
                Array.Fill(shape.Q, Quaterniond.Identity);
                ContactShape wall = TestShapes.Make(name);
                wall.Softness = new WallSoftness("vessel", 40.0, 0.0, 0.1, 2.0);
                MaterialRod rod = MaterialRod.Round(6, 1.2, 0.3, 1e6, 1e6, 1e3);
                var energy = new BarrierEnergy(rod, new[] { wall }, 1.0, new Barrier(0.1, 10.0));
                energy.BeginStage(shape.X, velocities, 0.5);
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
                    var exact = new Vector3d(gradient[i].X1, gradient[i].X2, gradient[i].X3);
                    Vector3d difference = SoftWallTests.Difference(energy, shape, i);
                    Assert.That(Vector3d.Distance(exact, difference), Is.LessThan(5e-5 * measured.LargestForce),
                        name + ", seed " + seed + ", node " + i);
                }
            }
            Assert.That(tried, Is.GreaterThanOrEqualTo(2), "too few wires touch the wall");
        }

        // Over the largest.
        private static double WeightAt(double t) =>
            Math.Min(1.0, t / Rise) - (1.0 - Left) * Math.Min(1.0, Math.Max(0.0, t - After) / Rise);

        // Displacement, over the final one, under a load that grows to 1 in the rise and on.
        private static double Ramp(double t) => t <= 0.0 ? 0.0 : (t - Time * (1.0 - Math.Exp(-t / Time))) / Rise;

        private static SimulationParameters Lying(Integrator integrator, double time = Time)
        {
            SimulationParameters parameters = WallScenes.Wire(6, 0.5e-3);
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.Gravity = -9.81 * Vector3d.UnitY;
            parameters.Scene.GravityTable = new TimeTable(
                new[] { 0.0, Rise, After, After + Rise }, new[] { 0.0, 1.0, 1.0, Left });
            parameters.Scene.Walls = WallScenes.Floor(-0.5);
            parameters.Scene.Walls[0].Softness = new WallSoftness("vessel", Stiffness, 10.0, 1e-9, time);
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            parameters.Drive.Kind = Drive.Hold;
            parameters.Method.Integrator = integrator;
            parameters.Method.TimeStep = Step;
            parameters.Method.SolverTolerance = 1e-9;
            parameters.Method.MaxSimulationSteps = 2 * Loaded;
            parameters.Material.MassDamping = 0.0;
            return parameters;
        }

        // One node's length of 1 m on a plane, limit 10 m.
        private static BarrierEnergy OnPlane(double time)
        {
            var plane = new PlaneShape(Vector3d.Zero, Vector3d.UnitY)
            {
                Softness = new WallSoftness("vessel", 7.0, 10.0, 1e-9, time),
            };
            MaterialRod rod = MaterialRod.Round(2, 2.0, 0.3, 1e6, 1e6, 1e3);
            return new BarrierEnergy(rod, new ContactShape[] { plane }, 1.0, new Barrier(0.1, 10.0));
        }

        private static RodShape At(double sunk)
        {
            var shape = new RodShape(2);
            for (int i = 0; i <= 2; i++)
            {
                shape.X[i] = new Vector3d(0.0, 0.3 - sunk, i);
            }
            Array.Fill(shape.Q, Quaterniond.Identity);
            return shape;
        }

        private static void Move(BarrierEnergy energy, RodShape from, RodShape to, double h)
        {
            energy.BeginStep(from, h);
            Stage(energy, from, h);
            energy.EndStep(to);
        }

        private static void Stage(BarrierEnergy energy, RodShape from, double h) =>
            energy.BeginStage(from.X, new Vector3d[3], h);

        private static double BarrierAlone(double sunk)
        {
            new Barrier(10.0, 0.3 * 7.0).At(10.0 - sunk, out double slope, out _);
            return -slope;
        }

        // On the node in the middle, whose length is 1 m.
        private static double ForceOn(BarrierEnergy energy, RodShape shape)
        {
            var gradient = new RodVector[4];
            var measured = default(GradientMeasures);
            energy.AddGradient(shape, gradient, 0, 3, ref measured);
            return -gradient[1].X2;
        }
    }
}
