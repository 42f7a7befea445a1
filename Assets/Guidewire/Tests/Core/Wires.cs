using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The wires that tests share.</summary>
    internal static class Wires
    {
        /// <summary>Thesis table 4.1, displaced along y, with no steady state to end it.</summary>
        public static SimulationParameters Transversal(int maxSteps)
        {
            return new SimulationParameters
            {
                Drive = { DisplacementDirection = Vector3d.UnitY },
                Method = { DeltaThreshold = 0.0, MaxSimulationSteps = maxSteps },
            };
        }

        /// <summary>Thesis table 4.1, displaced along z, with no steady state to end it.</summary>
        public static SimulationParameters Longitudinal(int maxSteps)
        {
            return new SimulationParameters
            {
                Method = { DeltaThreshold = 0.0, MaxSimulationSteps = maxSteps },
            };
        }

        /// <summary>A bent and twisted start at rest with velocities, from a seed.</summary>
        public static RodStart Random(int n, double length, int seed)
        {
            var random = new System.Random(seed);
            double l = length / n;
            var positions = new Vector3d[n + 1];
            var velocities = new Vector3d[n + 1];
            var orientations = new Quaterniond[n];
            var spins = new Vector3d[n];
            Quaterniond frame = Quaterniond.Identity;
            for (int j = 0; j < n; j++)
            {
                frame = frame * Quaterniond.FromAxisAngle(Vector3d.Normalize(Any(random)), 0.4 * random.NextDouble());
                orientations[j] = frame;
                positions[j + 1] = positions[j] + l * (1.0 + 0.1 * (random.NextDouble() - 0.5)) * frame.Director3;
                velocities[j + 1] = l * Any(random);
                spins[j] = Any(random);
            }
            return new RodStart(positions, orientations, velocities, spins);
        }

        /// <summary>The straight wire of these parameters, in units.</summary>
        public static RodState Straight(SimulationParameters parameters)
        {
            return new RodState(parameters.Scene.NumberRodElements, parameters.Scene.GuidewireLength,
                parameters.Pbd.TotalMass, parameters.Scene.GuidewireOffset);
        }

        /// <summary>Gives a wire another start.</summary>
        public static void Load(RodState state, RodStart start)
        {
            var scene = new Scene(new SimulationParameters
            {
                Scene = { NumberRodElements = state.ElementCount, Start = start },
            });
            state.Start(scene.Shape, scene.Velocities, scene.Spins);
        }

        /// <summary>Runs to its end.</summary>
        public static Simulation Run(SimulationParameters parameters) => Run(Simulation.Create(parameters));

        /// <summary>Goes on to the run's end.</summary>
        /// <param name="afterStep">Called after every step.</param>
        public static Simulation Run(Simulation simulation, Action? afterStep = null)
        {
            while (simulation.Outcome == Outcome.Running)
            {
                simulation.Step();
                afterStep?.Invoke();
            }
            return simulation;
        }

        /// <summary>Runs to its end, which must be that of its last step.</summary>
        public static Simulation Finish(SimulationParameters parameters) => Finish(Simulation.Create(parameters));

        /// <summary>Goes on to the run's end, which must be that of its last step.</summary>
        /// <param name="afterStep">Called after every step.</param>
        public static Simulation Finish(Simulation simulation, Action? afterStep = null)
        {
            Run(simulation, afterStep);
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Finished), simulation.Reason);
            return simulation;
        }

        /// <summary>Makes so many steps.</summary>
        public static void Step(Simulation simulation, int steps)
        {
            for (int i = 0; i < steps; i++)
            {
                simulation.Step();
            }
        }

        /// <summary>Makes so many steps, which must not be its last.</summary>
        public static Simulation GoOn(Simulation simulation, int steps)
        {
            Step(simulation, steps);
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running), simulation.Reason);
            return simulation;
        }

        /// <summary>Runs to its end, that of its last step, and beside it a run that is restored from it after so many
        /// steps and is the same.</summary>
        public static Simulation RunAndRestore(SimulationParameters parameters, int steps)
        {
            Simulation simulation = Simulation.Create(parameters);
            Simulation? other = null;
            while (simulation.Outcome == Outcome.Running)
            {
                if (simulation.StepCount == steps)
                {
                    other = Simulation.Restore(parameters, simulation.Save());
                }
                simulation.Step();
                other?.Step();
            }
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Finished), simulation.Reason);
            SameRun.AssertSame(other!, simulation, "at the end");
            return simulation;
        }

        /// <summary>Makes so many steps, and beside them those of a run that is continued before one of them and
        /// restored before another, with the same bits.</summary>
        public static Simulation RunInParts(SimulationParameters parameters, int steps, int continued, int restored,
            out Simulation part)
        {
            Simulation whole = Simulation.Create(parameters);
            part = Simulation.Create(parameters);
            for (int k = 0; k < steps; k++)
            {
                whole.Step();
                part = k == continued ? part.Continue(parameters)
                    : k == restored ? Simulation.Restore(parameters, part.Save()) : part;
                part.Step();
            }
            Assert.That(part.State.Positions, Is.EqualTo(whole.State.Positions));
            Assert.That(part.State.Velocities, Is.EqualTo(whole.State.Velocities));
            return whole;
        }

        /// <summary>A vector with components in [-1, 1).</summary>
        public static Vector3d Any(System.Random random)
        {
            return new Vector3d(2.0 * random.NextDouble() - 1.0, 2.0 * random.NextDouble() - 1.0,
                2.0 * random.NextDouble() - 1.0);
        }

        /// <summary>The largest distance between spheres of the same index.</summary>
        public static double Distance(RodState a, RodState b) => Distance(a.Positions, b.Positions);

        /// <summary>The largest distance between points of the same index.</summary>
        public static double Distance(Vector3d[] a, Vector3d[] b)
        {
            double worst = 0.0;
            for (int i = 0; i < a.Length; i++)
            {
                worst = Math.Max(worst, Vector3d.Distance(a[i], b[i]));
            }
            return worst;
        }

        /// <summary>Whether all places, velocities and turns are numbers.</summary>
        public static bool IsFinite(RodState state)
        {
            bool finite = true;
            for (int i = 0; i < state.SphereCount; i++)
            {
                finite &= state.Positions[i].IsFinite && state.Velocities[i].IsFinite;
            }
            for (int j = 0; j < state.ElementCount; j++)
            {
                finite &= state.AngularVelocities[j].IsFinite && state.Orientations[j].Imaginary.IsFinite;
            }
            return finite;
        }

        /// <summary>A wire of radius 1 along z that just touches a plane, under its weight.</summary>
        public static SimulationParameters LyingOnAPlane(Drive drive, double collisionStiffness)
        {
            return new SimulationParameters
            {
                Scene =
                {
                    NumberRodElements = 10,
                    GuidewireLength = 100.0,
                    GuidewireOffset = 0.0,
                    Gravity = new Vector3d(0.0, -10.0, 0.0),
                    Walls = new ContactShape[] { new PlaneShape(-1.0 * Vector3d.UnitY, Vector3d.UnitY) },
                },
                Contact = { SphereRadius = 1.0, CollisionStiffness = collisionStiffness },
                Method = { ConstraintSolverSteps = 50, DeltaThreshold = 0.0, MaxSimulationSteps = 100_000 },
                Drive = { Kind = drive, Displacement = 0.0 },
            };
        }
    }
}
