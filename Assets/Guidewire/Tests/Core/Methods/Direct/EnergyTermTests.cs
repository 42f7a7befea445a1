using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What a term may ask of the solvers: to bound a step, to keep a step's start, to follow the time, to
    /// hand back what it measured.</summary>
    public sealed class EnergyTermTests
    {
        private const int N = 20;

        [Test]
        public void RestShapeAboveAFloor_IsFoundWithoutCrossingIt()
        {
            // 60 EI/L^2 at the tip, towards a floor 0.1 L below: a full first step would go far through it.
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports();
            const double Depth = 0.1 * Rods.Length;
            double strength = 1e-3 * Rods.BendForce * Rods.Length;
            var floor = new Floor(rod, supports, strength, Depth);
            var terms = new RodTerms(rod, supports, new SceneParameters(), floor);
            terms.Loads.Set(Vector3d.Zero, new Vector3d(0.0, -60.0 * Rods.BendForce, 0.0));
            RodShape shape = Rods.Straight(rod);
            EquilibriumResult result = new RodStatics(terms).Solve(shape, 1e-9, 500);
            Assert.That(result.Converged, Is.True, result.Reason);
            Assert.That(floor.Cuts, Is.Positive);
            Assert.That(floor.SmallestGap, Is.Positive);
            // Pressed flat to the floor: the clamp and the floor carry the force.
            double floorForce = 0.0;
            foreach (Vector3d x in shape.X)
            {
                floorForce += strength / (x.Y + Depth);
            }
            var gradient = new RodVector[N + 2];
            terms.AddGradient(shape, gradient);
            // The reaction at node 0 is the gradient there, which holds the floor's force on it too.
            Assert.That(gradient[0].X2 + floorForce, Is.EqualTo(60.0 * Rods.BendForce).Within(1e-6 * Rods.BendForce));
            Assert.That(shape.X[N].Y, Is.LessThan(-0.9 * Depth));
        }

        [Test]
        public void StepThatATermCuts_IsTakenInParts()
        {
            // The term stores nothing and allows half of each stage's first step: the same motion, in more steps.
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports { Proximal = ProximalEnd.Free };
            var schedule = Rods.Schedule(new SceneParameters { TipForce = new Vector3d(0.0, Rods.BendForce, 0.0) });
            var motions = new RodDynamics[2];
            for (int k = 0; k < 2; k++)
            {
                EnergyTerm[] others = k == 0 ? Array.Empty<EnergyTerm>() : new EnergyTerm[] { new StepCutter(N) };
                motions[k] = new RodDynamics(new RodTerms(rod, supports, new SceneParameters(), others), schedule,
                    Rods.Straight(rod), RungeKuttaScheme.Esdirk3(), 1e-8, 100);
                Rods.Step(motions[k], 1e-3, 10);
            }
            Assert.That(motions[1].Newton.Factorisations, Is.GreaterThanOrEqualTo(2 * 10 * 3));
            // The force comes at once: the two stages of the starting step may need the search, no other does.
            Assert.That(motions[1].Newton.Searches, Is.LessThanOrEqualTo(2));
            Assert.That(Wires.Distance(motions[0].Shape.X, motions[1].Shape.X), Is.LessThan(1e-6 * Rods.Length));
        }

        [Test]
        public void TermThatKeepsTheStartOfAStep_IsADrag()
        {
            // Implicit Euler on m v' = -a m v: v is divided by 1 + a dt a step, for the whole wire alike.
            const double Rate = 30.0;
            const double Dt = 1e-3;
            const int Steps = 20;
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports { Proximal = ProximalEnd.Free, Mass = MassRule.Lumped };
            var drag = new StepDrag(new RodMass(rod, MassRule.Lumped), Rate);
            RodDynamics motion = Start(new RodTerms(rod, supports, new SceneParameters(), drag),
                Integrator.ImplicitEuler, new Vector3d(0.3, 0.0, 0.1));
            Rods.Step(motion, Dt, Steps);
            double fraction = Math.Pow(1.0 + Rate * Dt, -Steps);
            for (int i = 0; i <= N; i++)
            {
                Assert.That(motion.Velocities[i].X, Is.EqualTo(0.3 * fraction).Within(1e-7), "node " + i);
                Assert.That(motion.Velocities[i].Z, Is.EqualTo(0.1 * fraction).Within(1e-7), "node " + i);
            }
        }

        [TestCase(Solver.Direct, 1e-4, 1, 1e-3)]
        [TestCase(Solver.Explicit, 1e-4, 500, 1e-3)]
        [TestCase(Solver.Xpbd, 1e-4, 50, 2e-3)]  // the spring acts a substep late: omega h/2 = 3e-4
        public void SpringToAMovingTarget_IsADrive(Solver solver, double dt, int substeps, double tolerance)
        {
            // A mass M on a spring k whose other end moves at v from rest: z = v t - (v/w) sin(w t), w^2 = k/M. The
            // wire's own spring EA/L is 1,600 times stiffer: a third of its compliance lowers w^2 by 2e-4.
            const int Elements = 3;
            const double Stiffness = 100.0;
            const double Speed = 0.1;
            const int Steps = 120;
            SimulationParameters parameters = Rods.Clamped(Elements, solver, dt, Steps);
            parameters.Method.Integrator = Integrator.Esdirk3;
            parameters.Method.Substeps = substeps;
            parameters.Method.ConstraintSolverSteps = 10;
            parameters.Drive.Kind = Drive.Force;
            var scene = new MaterialScene(parameters, new Scene(parameters));
            var terms = new RodTerms(scene.Rod, scene.Supports, parameters.Scene,
                new PullingSpring(Elements, Stiffness, Speed));
            var state = new RodState(Elements, parameters.Scene.GuidewireLength, 1.0, 0.0);
            TimeStepper stepper = Stepper(solver, parameters, scene, terms);
            double omega = Math.Sqrt(Stiffness / (Rods.Density * Rods.Area * Rods.Length));
            for (int k = 1; k <= Steps; k++)
            {
                stepper.Advance(state);
                Assert.That(stepper.Divergence ?? stepper.Failure, Is.Null);
                double t = k * dt;
                double expected = Speed * t - Speed / omega * Math.Sin(omega * t);
                Assert.That(1e-3 * state.Positions[0].Z, Is.EqualTo(expected).Within(tolerance * Speed * Steps * dt));
            }
        }

        [Test]
        public void LargestForce_IsHandedBackWithTheGradient()
        {
            const double Pull = 3.0;
            MaterialRod rod = Rods.Wire(N);
            var terms = new RodTerms(rod, new RodSupports());
            terms.Loads.Set(Vector3d.Zero, new Vector3d(0.0, 0.0, Pull));
            RodShape shape = Rods.Straight(rod);
            Assert.That(new RodStatics(terms).Solve(shape, 1e-10, 50).Converged, Is.True);
            var system = new BlockTridiagonal(rod, new RodSupports());
            GradientMeasures whole = system.Gradient(terms.All, shape, new RodVector[N + 2], new RodVector[N + 2]);
            Assert.That(whole.LargestForce, Is.EqualTo(Pull).Within(1e-6 * Pull));
            // One element stretched more than the others is found, whatever the ranges are.
            for (int i = 8; i <= N; i++)
            {
                shape.X[i] += new Vector3d(0.0, 0.0, 1e-6);
            }
            double more = Pull + Rods.Young * Rods.Area * 1e-6 * N / Rods.Length;
            var parts = default(GradientMeasures);
            foreach (int from in new[] { 0, 5, 10, 15 })
            {
                terms.Stretch.AddGradient(shape, new RodVector[N + 2], from, from + 5, ref parts);
            }
            Assert.That(parts.LargestForce, Is.EqualTo(more).Within(1e-6 * more));
        }

        [Test]
        public void WhatATermKeeps_GoesIntoTheSnapshot()
        {
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports { Proximal = ProximalEnd.Free };
            var mass = new RodMass(rod, supports.Mass);
            var written = new StepDrag(mass, 1.0);
            written.BeginStep(Rods.Straight(rod), 0.5);
            var read = new StepDrag(mass, 2.0);
            var snapshot = new Snapshot();
            new RodTerms(rod, supports, new SceneParameters(), written).Serialize(snapshot);
            new RodTerms(rod, supports, new SceneParameters(), read).Serialize(snapshot.ToRead());
            Assert.That(read.Target, Is.EqualTo(written.Target));
            Assert.That(read.Stiffness, Is.EqualTo(written.Stiffness));
        }

        private static TimeStepper Stepper(Solver solver, SimulationParameters parameters, MaterialScene scene,
            RodTerms terms)
        {
            var report = new SolverReport();
            switch (solver)
            {
                case Solver.Direct:
                    var dynamics = new RodDynamics(terms, scene.Schedule, scene.Shape,
                        DirectSetup.Scheme(parameters.Method.Integrator), 1e-9, 50);
                    return new DirectStep(new MonitoredRod(scene, dynamics, parameters.Method, report, null),
                        parameters.Method.TimeStep);
                case Solver.Explicit:
                    return new ExplicitStep(scene, terms, parameters.Method, report, null);
                default:
                    return new CompliantStep(scene, terms, parameters.Method, report, 0.0);
            }
        }

        private static RodDynamics Start(RodTerms terms, Integrator scheme, Vector3d velocity)
        {
            var motion = new RodDynamics(terms, Rods.Schedule(), Rods.Straight(terms.Rod),
                DirectSetup.Scheme(scheme), 1e-8, 100);
            var velocities = new Vector3d[N + 1];
            for (int i = 0; i <= N; i++)
            {
                velocities[i] = velocity;
            }
            motion.Begin(velocities, new Vector3d[N], false);
            return motion;
        }
    }
}
