using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The material rods that tests share, and the numbers of the wire that most of them are about: L = 0.3 m,
    /// r = 0.5 mm, E = 60 GPa, G = 23 GPa, rho = 6450 kg/m^3.</summary>
    internal static class Rods
    {
        public const double Length = 0.3;
        public const double Radius = 0.5e-3;
        public const double Young = 60e9;
        public const double Shear = 23e9;
        public const double Density = 6450.0;
        public const double Area = Math.PI * Radius * Radius;
        public const double SecondMoment = 0.25 * Area * Radius * Radius;
        public const double BendStiffness = Young * SecondMoment;
        public const double TwistStiffness = 2.0 * Shear * SecondMoment;

        /// <summary>EI/L^2, N: the force that k = F L^2/EI counts in.</summary>
        public const double BendForce = BendStiffness / (Length * Length);

        /// <summary>True where campaigns run in full (environment GUIDEWIRE_ALL=1).</summary>
        public static bool InFull => Environment.GetEnvironmentVariable("GUIDEWIRE_ALL") == "1";

        /// <summary>Leaves a campaign out that runs in full only.</summary>
        /// <param name="others">What holds its claim in the short run.</param>
        public static void OnlyInFull(string others)
        {
            if (!InFull)
            {
                Assert.Ignore("in full only (GUIDEWIRE_ALL=1); " + others);
            }
        }

        /// <summary>The wire in n elements.</summary>
        public static MaterialRod Wire(int n) => MaterialRod.Round(n, Length, Radius, Young, Shear, Density);

        /// <summary>A run of the wire in millimetres, straight along z from the origin and clamped there, with the
        /// method's default integrator; xpbd with one sweep a substep.</summary>
        public static SimulationParameters Clamped(int n, Solver solver, double step, int steps)
        {
            var parameters = new SimulationParameters
            {
                Method =
                {
                    Solver = solver,
                    TimeStep = step,
                    MaxSimulationSteps = steps,
                    ConstraintSolverSteps = 1,
                    DeltaThreshold = 0.0,
                },
                Scene = { NumberRodElements = n, GuidewireLength = 1e3 * Length, GuidewireOffset = 0.0 },
                Drive = { Displacement = 0.0 },
            };
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            if (MethodTable.Of(solver).Integrators.Count > 0)
            {
                parameters.Method.Integrator = MethodTable.Of(solver).Integrators[0];
            }
            return parameters;
        }

        /// <summary>The wire, straight along z from the origin.</summary>
        public static RodShape Straight(MaterialRod rod)
        {
            var shape = new RodShape(rod.ElementCount);
            shape.SetStraight(Vector3d.Zero, Quaterniond.Identity, Stations(rod));
            return shape;
        }

        /// <summary>Makes so many steps of dt, s, each with a solution.</summary>
        public static void Step(RodDynamics motion, double dt, int steps)
        {
            for (int k = 0; k < steps; k++)
            {
                Assert.That(motion.Step(dt), Is.Null);
            }
        }

        /// <summary>Linear momentum, kg m/s.</summary>
        public static Vector3d Momentum(RodDynamics motion)
        {
            RodMass mass = motion.Terms.Mass;
            Vector3d[] v = motion.Velocities;
            Vector3d sum = mass.Diagonal[0] * v[0];
            for (int i = 1; i <= mass.ElementCount; i++)
            {
                sum += mass.Diagonal[i] * v[i] + mass.Coupling[i - 1] * (v[i - 1] + v[i]);
            }
            return sum;
        }

        /// <summary>What is prescribed of a wire in a scene, by default nothing.</summary>
        /// <param name="shape">Where its ends begin and how; null: at the origin, along z.</param>
        /// <param name="twistRate">Of the hub, rad/s.</param>
        public static RodSchedule Schedule(SceneParameters? scene = null, RodShape? shape = null,
            double twistRate = 0.0)
        {
            scene ??= new SceneParameters();
            shape ??= new RodShape(1);
            return new RodSchedule(new PrescribedLoads(scene, 1.0, Vector3d.Zero),
                new HubMotion(shape.X[0], shape.ProximalFrame, twistRate),
                new DistalMotion(scene, 1.0, shape.X[shape.ElementCount], shape.DistalFrame));
        }

        /// <summary>How far each node is from node 0 along the straight wire.</summary>
        public static double[] Stations(MaterialRod rod)
        {
            var stations = new double[rod.ElementCount + 1];
            for (int j = 0; j < rod.ElementCount; j++)
            {
                stations[j + 1] = stations[j] + rod.Length[j];
            }
            return stations;
        }

        /// <summary>A shape bent, twisted and strained at random.</summary>
        public static RodShape Random(MaterialRod rod, double angle, double strain, int seed)
        {
            var random = new System.Random(seed);
            RodShape shape = Straight(rod);
            Quaterniond frame = RotationVector.Exp(angle * Wires.Any(random));
            shape.ProximalFrame = frame;
            for (int j = 0; j < rod.ElementCount; j++)
            {
                frame = Quaterniond.Normalize(frame * RotationVector.Exp(angle * Wires.Any(random)));
                shape.Q[j] = frame;
                Vector3d chord = Vector3d.UnitZ + strain * Wires.Any(random);
                shape.X[j + 1] = shape.X[j] + rod.Length[j] * Quaterniond.Rotate(frame, chord);
            }
            shape.DistalFrame = Quaterniond.Normalize(frame * RotationVector.Exp(angle * Wires.Any(random)));
            return shape;
        }

        /// <summary>The rest shape under these loads, from the straight start; throws where there is none.</summary>
        public static RodShape AtRest(MaterialRod rod, RodSupports supports, in Vector3d gravity, in Vector3d tipForce,
            in Vector3d tipMoment)
        {
            RodShape shape = Straight(rod);
            var rodTerms = new RodTerms(rod, supports);
            rodTerms.Loads.Set(gravity, tipForce);
            rodTerms.Followers.Moment.Moment = tipMoment;
            EquilibriumResult result = new RodStatics(rodTerms).Solve(shape, 1e-10, 500);
            if (!result.Converged)
            {
                throw new InvalidOperationException(result.Reason);
            }
            return shape;
        }

        /// <summary>A copy of a shape.</summary>
        public static RodShape Copy(RodShape shape)
        {
            var copy = new RodShape(shape.ElementCount);
            copy.CopyFrom(shape);
            return copy;
        }
    }
}
