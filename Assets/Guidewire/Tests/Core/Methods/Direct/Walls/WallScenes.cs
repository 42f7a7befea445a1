using System;
using System.Collections.Generic;

namespace Guidewire.Core.Tests
{
    /// <summary>Scenes in which a wire with a material meets walls.</summary>
    internal static class WallScenes
    {
        /// <summary>Radius of the lumen of <see cref="Arch"/>, units.</summary>
        public const double LumenRadius = 3.0;

        private const double BendRadius = 30.0;   // units
        private const int BendPieces = 40;

        /// <summary>A straight sheath along z to z = 0, then half a circle in the y z plane, then straight back;
        /// as a tube.</summary>
        public static TubeShape ArchTube(int pieces)
        {
            var knots = new List<Vector3d> { new Vector3d(0.0, 0.0, -320.0) };
            for (int k = 0; k <= pieces; k++)
            {
                double angle = Math.PI * k / pieces;
                knots.Add(new Vector3d(0.0, BendRadius * (1.0 - Math.Cos(angle)), BendRadius * Math.Sin(angle)));
            }
            knots.Add(new Vector3d(0.0, 2.0 * BendRadius, -200.0));
            return new TubeShape(knots.ToArray(), knots.ConvertAll(_ => LumenRadius).ToArray(), true, true);
        }

        /// <summary>Distance of a point from the axis of <see cref="Arch"/>, units.</summary>
        public static double FromArchAxis(Vector3d x)
        {
            double y = x.Y - BendRadius;
            double across = (x.Z > 0.0 ? Math.Sqrt(y * y + x.Z * x.Z) : Math.Abs(y)) - BendRadius;
            return Math.Sqrt(across * across + x.X * x.X);
        }

        /// <summary>The same as a mesh: rings of corners on the tube, a pair of them in the bend's plane, so that the
        /// wire lies where chords take nothing off around the tube.</summary>
        /// <param name="around">Vertices per ring.</param>
        /// <param name="pieces">Of the bend; rings are as far apart elsewhere.</param>
        public static MeshShape ArchMesh(int around, int pieces)
        {
            double apart = Math.PI * BendRadius / pieces;
            var places = new List<Vector3d>();
            var turns = new List<double>();
            for (int k = -(int)Math.Ceiling(320.0 / apart); k < 0; k++)
            {
                places.Add(new Vector3d(0.0, 0.0, k * apart));
                turns.Add(0.0);
            }
            for (int k = 0; k <= pieces; k++)
            {
                double angle = Math.PI * k / pieces;
                places.Add(new Vector3d(0.0, BendRadius * (1.0 - Math.Cos(angle)), BendRadius * Math.Sin(angle)));
                turns.Add(angle);
            }
            for (int k = 1; k * apart < 200.0; k++)
            {
                places.Add(new Vector3d(0.0, 2.0 * BendRadius, -k * apart));
                turns.Add(Math.PI);
            }
            TestMeshes mesh = TestMeshes.Pipe(places.ToArray(), turns.ToArray(), LumenRadius, around);
            return new MeshShape(mesh.Build(places[0], places[places.Count - 1]));
        }

        /// <summary>A horizontal plane at this height, units, under the wire.</summary>
        public static ContactShape[] Floor(double height) =>
            new ContactShape[] { new PlaneShape(new Vector3d(0.0, height, 0.0), Vector3d.UnitY) };

        /// <summary>A straight tube along z, all in units.</summary>
        /// <param name="height">Of its axis, along y.</param>
        public static ContactShape[] Tube(double from, double to, double radius, bool openStart = true,
            bool openEnd = true, double height = 0.0, double friction = 0.0)
        {
            var knots = new[] { new Vector3d(0.0, height, from), new Vector3d(0.0, height, to) };
            var tube = new TubeShape(knots, new[] { radius, radius }, openStart, openEnd);
            tube.FrictionCoefficient = friction;
            return new ContactShape[] { tube };
        }

        /// <summary>A nitinol wire, r = 0.4 mm and 300 mm long, that is pushed from the sheath into the arch.</summary>
        /// <param name="speed">mm/s.</param>
        /// <param name="insertion">mm.</param>
        public static SimulationParameters Arch(int n, double timeStep, double speed, double insertion)
        {
            var parameters = Wire(n, 0.4e-3);
            parameters.Scene.GuidewireOffset = -300.0;
            parameters.Scene.Walls = new ContactShape[] { ArchTube(BendPieces) };
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.DisplacementPerStep = speed * timeStep;
            parameters.Method.TimeStep = timeStep;
            parameters.Method.MaxSimulationSteps = (int)Math.Round(insertion / (speed * timeStep));
            return parameters;
        }

        /// <summary>A nitinol cantilever, 300 mm long, above a plane 20 mm below it.</summary>
        public static SimulationParameters OverPlane(int n, double radius)
        {
            SimulationParameters parameters = Wire(n, radius);
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.Walls = Floor(-20.0);
            parameters.Method.TimeStep = 5e-3;
            parameters.Material.MassDamping = 10.0;    // 1/s
            parameters.Method.DeltaThreshold = 1e-6;
            parameters.Method.MaxSimulationSteps = 3000;
            return parameters;
        }

        /// <summary>Momentum of a run's nitinol wire of 0.4 mm radius and 300 mm length, kg m/s: half of each element
        /// beside a node moves with it.</summary>
        public static Vector3d Momentum(RodState state)
        {
            double element = 6450.0 * Math.PI * 0.16e-6 * 0.3 / state.ElementCount;
            Vector3d momentum = Vector3d.Zero;
            for (int i = 0; i <= state.ElementCount; i++)
            {
                momentum += (1e-3 * element * (i == 0 || i == state.ElementCount ? 0.5 : 1.0)) * state.Velocities[i];
            }
            return momentum;
        }

        /// <summary>A wire of the base rod's material, clamped, in a scene to be set.</summary>
        public static SimulationParameters Wire(int n, double radius)
        {
            var parameters = new SimulationParameters();
            parameters.Method.Solver = Solver.Direct;
            MethodTable.Of(Solver.Direct).SetDefaults(parameters);
            parameters.Method.Integrator = Integrator.ImplicitEuler;
            parameters.Method.DeltaThreshold = 0.0;
            parameters.Scene.NumberRodElements = n;
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Material.WireRadius = radius;
            return parameters;
        }

        /// <summary>The same scene for xpbd with one sweep a substep; a soft wire's substeps are long.</summary>
        /// <param name="young">E, Pa.</param>
        /// <param name="fraction">Of the time, l sqrt(rho/E), that sound takes along an element.</param>
        public static SimulationParameters Compliant(SimulationParameters scene, double young, double fraction = 0.4)
        {
            SimulationParameters parameters = Soft(scene, young);
            double sound = Math.Sqrt(young / parameters.Material.Density);
            double length = parameters.Scene.MetresPerUnit * parameters.Scene.GuidewireLength
                / parameters.Scene.NumberRodElements;
            parameters.Method.Solver = Solver.Xpbd;
            parameters.Method.Integrator = new MethodParameters().Integrator;
            parameters.Method.ConstraintSolverSteps = 1;
            parameters.Method.Substeps = (int)Math.Ceiling(
                parameters.Method.TimeStep * sound / (fraction * length));
            return parameters;
        }

        /// <summary>The same scene with a wire of another Young's modulus, and a shear modulus that goes with
        /// it.</summary>
        public static SimulationParameters Soft(SimulationParameters scene, double young)
        {
            SimulationParameters parameters = scene.Copy();
            parameters.Material.YoungsModulus = young;
            parameters.Material.ShearModulus = 0.38 * young;
            return parameters;
        }
    }
}
