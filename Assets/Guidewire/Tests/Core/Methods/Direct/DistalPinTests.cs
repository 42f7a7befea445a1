using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire between two ball joints, and forces at places of a wire, against linear beams.</summary>
    public sealed class DistalPinTests
    {
        private const double Length = 0.3;       // m
        private const double Bending = 60e9 * Math.PI / 4.0 * 0.5e-3 * 0.5e-3 * 0.5e-3 * 0.5e-3;  // EI, N m^2

        [TestCase(20)]
        [TestCase(41)]
        public void EvenLoad_BendsTheWireBetweenPins_By5WL4Over384EI(int n)
        {
            // So small a load (a deflection of r/100) that the ends do not pull: A d^2/(16 I) = 2.5e-5 of it.
            // An element's curvature stands for its joint: (pi/n)^2/12 of the first mode.
            const double Sag = 5e-6;
            double load = Sag * 384.0 * Bending / (5.0 * Math.Pow(Length, 4));
            SimulationParameters parameters = Pinned(n);
            parameters.Scene.DistributedForce = new Vector3d(load, 0.0, 0.0);
            Simulation simulation = Simulation.Create(parameters);
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Converged), simulation.Reason);
            double middle = 0.0;
            foreach (Vector3d x in simulation.State.Positions)
            {
                middle = Math.Max(middle, 1e-3 * x.X);
            }
            Assert.That(middle / Sag, Is.EqualTo(1.0).Within(1e-4 + 2.0 * Math.PI * Math.PI / (12.0 * n * n)));
            Vector3d force = simulation.Report()!.DistalForce!.Value;
            Assert.That(force.X, Is.EqualTo(-0.5 * load * Length).Within(1e-6 * load * Length));
        }

        [TestCase(0.0625)]
        [TestCase(0.39)]
        [TestCase(1.0)]
        public void Force_AtAPlaceOfACantilever_BendsItAsABeam(double fraction)
        {
            // Tip: F a^2 (3 L - a)/(6 EI). Between two spheres the lever rule adds to a load's second moment by at most
            // (l/2)^2: below (l/a)^2/2.
            const int N = 40;
            const double Force = 1e-5;
            double a = fraction * Length;
            SimulationParameters parameters = Base(N);
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Scene.PointLoads = new[] { new PointLoad(1e3 * a, new Vector3d(0.0, Force, 0.0)) };
            Simulation simulation = Simulation.Create(parameters);
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Converged), simulation.Reason);
            double expected = Force * a * a * (3.0 * Length - a) / (6.0 * Bending);
            double l = Length / N;
            Assert.That(1e-3 * simulation.State.Positions[N].Y / expected, Is.EqualTo(1.0).Within(
                1e-4 + 0.5 * l * l / (a * a)));
            Assert.That(simulation.Report()!.ProximalForce!.Value.Y, Is.EqualTo(-Force).Within(1e-6 * Force));
        }

        [TestCase(Solver.Direct, 1e-3, 1)]
        [TestCase(Solver.Explicit, 1e-4, 800)]
        [TestCase(Solver.Xpbd, 1e-4, 200)]
        public void Pin_HoldsTheLastSphere_WhileTheWireSwings(Solver solver, double timeStep, int substeps)
        {
            // Between pins 0.25 m apart it falls; both pins go on holding it, and it turns about them.
            SimulationParameters parameters = SimulationParameters.DefaultsOf(solver);
            parameters.Scene.NumberRodElements = 10;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.DistalEnd = DistalEnd.Held;
            parameters.Scene.DistalDisplacement = -0.5;
            parameters.Scene.DistalRampTime = 5e-3;
            parameters.Material.WireRadius = 1e-3;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Method.TimeStep = timeStep;
            parameters.Method.Substeps = substeps;
            parameters.Method.DeltaThreshold = 0.0;
            parameters.Method.MaxSimulationSteps = (int)(0.02 / timeStep);
            Simulation simulation = Wires.Finish(parameters);
            Vector3d end = simulation.State.Positions[10];
            Assert.That(Vector3d.Distance(end, new Vector3d(0.0, 0.0, 299.5)), Is.LessThan(1e-9));
            Assert.That(simulation.State.Orientations[9].Director3.Y, Is.Not.EqualTo(0.0).Within(1e-4));
        }

        [Test]
        public void Pin_LeavesTheWireToItsWeightBetweenBothEnds()
        {
            // A limp wire 0.3 m long between pins 0.24 m apart: Irvine's cable, H by 0.24 w/(2 H) = asinh(0.3 w/(2 H)),
            // whose bending stiffness is too small to count: EI/(H L^2) = 2e-6.
            const int N = 60;
            SimulationParameters parameters = Pinned(N);
            parameters.Scene.DistalDisplacement = -60.0;
            parameters.Material.WireRadius = 0.5e-3;
            parameters.Material.YoungsModulus = 1e6;
            parameters.Material.AxialStiffness = 1e3;
            parameters.Scene.Gravity = new Vector3d(1e-3, -9.81, 0.0);
            Simulation simulation = Simulation.Create(parameters);
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Converged), simulation.Reason);
            double parameter = Bisection.Limit(1e-3, 10.0,
                a => 2.0 * a * Math.Log(0.15 / a + Math.Sqrt(1.0 + 0.0225 / (a * a))) <= 0.24);
            double sag = Math.Sqrt(parameter * parameter + 0.0225) - parameter;
            double found = 0.0;
            foreach (Vector3d x in simulation.State.Positions)
            {
                found = Math.Max(found, -1e-3 * x.Y);
            }
            Assert.That(found / sag, Is.EqualTo(1.0).Within(2e-3));
        }

        private static SimulationParameters Base(int n)
        {
            SimulationParameters parameters = SimulationParameters.DefaultsOf(Solver.Direct);
            parameters.Scene.NumberRodElements = n;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Method.MaxSimulationSteps = 0;
            return parameters;
        }

        private static SimulationParameters Pinned(int n)
        {
            SimulationParameters parameters = Base(n);
            parameters.Scene.DistalEnd = DistalEnd.Held;
            return parameters;
        }
    }
}
