using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A motion that is interrupted and goes on from a snapshot, with every method for a material.</summary>
    public sealed class MaterialSnapshotTests
    {
        private const int N = 8;
        private const double RampSteps = 40.0;
        private const double Displacement = -2.0;  // mm

        /// <summary>Motions that are interrupted in <see cref="ContinueTests"/>.</summary>
        internal static IEnumerable<(string Name, SimulationParameters Parameters)> Motions()
        {
            foreach (string scene in new[] { "halved steps", "cut steps", "damped cut steps",
                "damped ramp", "twist and push",
                "release", "free", "sliding", "couple" })
            {
                bool isCut = scene.EndsWith("steps", StringComparison.Ordinal);
                foreach (Integrator scheme in MethodTable.Of(Solver.Direct).Integrators)
                {
                    if (!isCut || scheme == Integrator.Trbdf2 || scheme == Integrator.Esdirk3
                        || scheme == Integrator.Esdirk4)
                    {
                        yield return Motion(Solver.Direct, scheme, scene);
                    }
                }
                if (!isCut && scene != "sliding")    // what direct alone does
                {
                    yield return Motion(Solver.Explicit, Integrator.Verlet, scene);
                }
                if (!isCut && scene != "sliding" && scene != "couple")    // xpbd takes none
                {
                    yield return Motion(Solver.Xpbd, Integrator.Verlet, scene);
                }
            }

            static (string, SimulationParameters) Motion(Solver solver, Integrator scheme, string scene) =>
                (solver + ", " + scheme + ", " + scene, Parameters(solver, scheme, scene));
        }

        [TestCase(Solver.Direct, Integrator.Esdirk3)]
        [TestCase(Solver.Direct, Integrator.Bdf2)]
        [TestCase(Solver.Xpbd, Integrator.Verlet)]
        [TestCase(Solver.Explicit, Integrator.Verlet)]
        public void TwistAtAnotherRate_GoesOnFromThePresentTurn(Solver solver, Integrator scheme)
        {
            // The clamp has turned by 0.4 rad, stops, and turns back.
            const double Turn = 0.4;
            SimulationParameters parameters = Parameters(solver, scheme, "");
            parameters.Drive.TwistPerStep = Turn / 10.0;
            var first = new Motion(parameters);
            first.Advance(10);
            var second = new Motion(Parameters(solver, scheme, ""));
            second.GoOnFrom(first);
            second.Advance(5);
            SimulationParameters back = Parameters(solver, scheme, "");
            back.Drive.TwistPerStep = -Turn / 10.0;
            var third = new Motion(back);
            third.GoOnFrom(second);
            AssertTurn(second, Turn);
            third.Advance(10);
            AssertTurn(third, 0.0);
        }

        [TestCase(Solver.Xpbd)]
        [TestCase(Solver.Explicit)]
        public void StifferWire_IsNoBlowup(Solver solver)
        {
            // A straight wire that is bent at rest is let go: all its energy is in its strains. Moduli a hundred times
            // larger, above the watch's allowance of 4, turn into motion a hundred times the energy put in at first.
            const double Factor = 100.0;
            SimulationParameters soft = Parameters(solver, Integrator.Verlet, "");
            soft.Material.RestCurvature = new Vector3d(4.0, 0.0, 0.0);
            var first = new Motion(soft);
            first.Advance(1);
            SimulationParameters stiff = Parameters(solver, Integrator.Verlet, "");
            stiff.Material.RestCurvature = soft.Material.RestCurvature;
            stiff.Material.YoungsModulus *= Factor;
            stiff.Material.ShearModulus *= Factor;
            stiff.Method.TimeStep = 1e-3;
            stiff.Method.Substeps = solver == Solver.Xpbd ? 1000 : 50000;
            var second = new Motion(stiff);
            second.GoOnFrom(first);
            second.Advance(solver == Solver.Explicit ? 3 : 10);
            Assert.That(second.Stepper.Divergence, Is.Null);
        }

        [TestCase(Solver.Direct, Integrator.Esdirk3, Solver.Direct, Integrator.Bdf2)]
        [TestCase(Solver.Direct, Integrator.Bdf2, Solver.Direct, Integrator.ImplicitEuler)]
        [TestCase(Solver.Direct, Integrator.Esdirk4, Solver.Explicit, Integrator.Verlet)]
        [TestCase(Solver.Explicit, Integrator.Verlet, Solver.Direct, Integrator.Esdirk4)]
        [TestCase(Solver.Explicit, Integrator.Verlet, Solver.Xpbd, Integrator.Verlet)]
        [TestCase(Solver.Xpbd, Integrator.Verlet, Solver.Direct, Integrator.Trbdf2)]
        public void AnotherMethod_GoesOnFromWhereTheWireIs(Solver before, Integrator schemeBefore, Solver after,
            Integrator schemeAfter)
        {
            // In the middle of a ramp: the distal end continues from where the first method had it, as the ramp says.
            SimulationParameters start = Parameters(before, schemeBefore, "ramp");
            SimulationParameters parameters = Parameters(after, schemeAfter, "ramp");
            start.Scene.DistalRampTime = RampSteps * Step(Solver.Direct);
            parameters.Scene.DistalRampTime = start.Scene.DistalRampTime;
            var first = new Motion(start);
            first.Advance(5);
            double time = 5.0 * Step(before);
            var second = new Motion(parameters);
            second.GoOnFrom(first);
            Vector3d end = second.State.Positions[N];
            second.Advance(1);
            double moved = Displacement * Step(after) / parameters.Scene.DistalRampTime;
            Assert.That(second.State.Positions[N].Z - end.Z, Is.EqualTo(moved).Within(1e-9));
            Assert.That(second.Stepper.Failure, Is.Null);
            Assert.That(second.Stepper.Divergence, Is.Null);
            Assert.That(end.Z - 1e3 * Rods.Length, Is.EqualTo(Displacement * time
                / parameters.Scene.DistalRampTime).Within(1e-9), "the ramp so far");
        }

        [TestCase(Integrator.Trbdf2)]
        [TestCase(Integrator.Esdirk3)]
        [TestCase(Integrator.Esdirk4)]
        public void AnotherLoad_ActsAtOnce(Integrator scheme)
        {
            // A free wire at rest, then with weight: rates kept from before the weight would make it fall by less than
            // g dt^2/2, for which each of the schemes is exact.
            SimulationParameters still = Parameters(Solver.Direct, scheme, "");
            still.Scene.ProximalEnd = ProximalEnd.Free;
            SimulationParameters heavy = Parameters(Solver.Direct, scheme, "");
            heavy.Scene.ProximalEnd = ProximalEnd.Free;
            heavy.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            var first = new Motion(still);
            first.Advance(3);
            var second = new Motion(heavy);
            second.GoOnFrom(first);
            second.Advance(1);
            double fall = 1e3 * 0.5 * 9.81 * 1e-6;  // mm
            Assert.That(second.State.Positions[N].Y, Is.EqualTo(-fall).Within(1e-9 * fall));
        }

        private static double Step(Solver solver) =>
            solver == Solver.Direct ? 1e-3 : solver == Solver.Xpbd ? 1e-4 : 1e-5;

        private static SimulationParameters Parameters(Solver solver, Integrator scheme, string scene)
        {
            double dt = Step(solver);
            SimulationParameters parameters = Rods.Clamped(N, solver, dt, 1000);
            parameters.Method.Integrator = scheme;
            parameters.Method.Substeps = solver == Solver.Direct ? 1 : solver == Solver.Xpbd ? 10 : 50;
            parameters.Method.ConstraintSolverSteps = 2;
            parameters.Method.StatesReactions = solver != Solver.Xpbd;
            switch (scene)
            {
                case "ramp":
                    parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
                    parameters.Scene.DistalEnd = DistalEnd.Clamped;
                    parameters.Scene.DistalRotation = 1.5;
                    parameters.Scene.DistalDisplacement = Displacement;
                    parameters.Scene.DistalRampTime = RampSteps * dt;
                    break;
                case "damped ramp":
                case "damped cut steps":
                    parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
                    parameters.Scene.DistalEnd = DistalEnd.Clamped;
                    parameters.Scene.DistalRotation = 1.5;
                    parameters.Scene.DistalDisplacement = Displacement;
                    parameters.Scene.DistalRampTime = 20.3 * dt;
                    parameters.Material.MassDamping = 0.02 / dt;
                    parameters.Material.MaterialDamping = solver == Solver.Direct ? 0.3 * dt : 0.0;
                    parameters.Method.TimeStepError = scene == "damped ramp" ? 0.0 : 1e-5;
                    break;
                case "twist and push":
                    parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
                    parameters.Material.MassDamping = 0.01 / dt;
                    parameters.Material.MaterialDamping = solver == Solver.Direct ? 0.1 * dt : 0.0;
                    parameters.Drive.Kind = Drive.Push;
                    parameters.Drive.DisplacementPerStep = 50.0 * dt;
                    parameters.Drive.TwistPerStep = 20.0 * dt;
                    break;
                case "release":
                    parameters.Scene.InitialState = InitialState.Equilibrium;
                    parameters.Scene.TipForce = new Vector3d(0.0, Rods.BendForce, 0.0);
                    parameters.Scene.TipForceReleaseTime = 10.5 * dt;
                    break;
                case "cut steps":
                    parameters.Scene.InitialState = InitialState.Equilibrium;
                    parameters.Scene.TipForce = new Vector3d(0.0, 3.0 * Rods.BendForce, 0.0);
                    parameters.Scene.TipForceReleaseTime = 5.3 * dt;
                    parameters.Method.TimeStepError = 1e-5;
                    break;
                case "halved steps":
                    parameters.Scene.InitialState = InitialState.Equilibrium;
                    parameters.Scene.TipForce = new Vector3d(0.0, 3.0 * Rods.BendForce, 0.0);
                    parameters.Scene.TipForceReleaseTime = 5.3 * dt;
                    parameters.Method.TimeStep = 10.0 * dt;
                    parameters.Method.MaxNewtonIterations = 4;
                    break;
                case "free":
                    parameters.Scene.ProximalEnd = ProximalEnd.Free;
                    parameters.Drive.Kind = Drive.Force;
                    parameters.Drive.ExternalForce = new Vector3d(0.0, 0.01, 0.0);
                    break;
                case "sliding":
                    parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
                    parameters.Scene.DistalEnd = DistalEnd.Sliding;
                    parameters.Scene.AxialForce = -0.05;
                    break;
                case "couple":
                    parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
                    parameters.Scene.TipMoment = new Vector3d(2e-3, 1e-3, 5e-4);
                    break;
                default:
                    break;
            }
            return parameters;
        }

        private static void AssertTurn(Motion motion, double turn)
        {
            // The frame is read off by a snapshot, where it follows time, nodes and elements.
            var shape = new RodShape(N);
            var snapshot = new Snapshot();
            motion.Stepper.Serialize(snapshot);
            Snapshot reader = snapshot.ToRead();
            double time = 0.0;
            reader.Serialize(ref time);
            shape.Serialize(reader);
            Assert.That(RotationVector.Log(shape.ProximalFrame).Z, Is.EqualTo(turn).Within(1e-12));
        }

        /// <summary>A stepper and its wire.</summary>
        private sealed class Motion
        {
            public Motion(SimulationParameters parameters)
            {
                MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
                State = start.State;
                Stepper = start.Stepper;
                Assert.That(start.Failure, Is.Null);
            }

            public RodState State { get; }

            public TimeStepper Stepper { get; }

            public void Advance(int steps)
            {
                for (int k = 0; k < steps; k++)
                {
                    Stepper.Advance(State);
                }
            }

            /// <summary>Takes over all that another motion has come to.</summary>
            public void GoOnFrom(Motion other)
            {
                var snapshot = new Snapshot();
                other.Stepper.Serialize(snapshot);
                Stepper.Serialize(snapshot.ToRead());
                Array.Copy(other.State.Positions, State.Positions, N + 1);
                Array.Copy(other.State.PreviousPositions, State.PreviousPositions, N + 1);
                Array.Copy(other.State.Velocities, State.Velocities, N + 1);
                Array.Copy(other.State.Orientations, State.Orientations, N);
                Array.Copy(other.State.AngularVelocities, State.AngularVelocities, N);
            }
        }
    }
}
