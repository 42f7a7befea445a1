using System;

namespace Guidewire.Core
{
    /// <summary>A run's parameters as a material rod in SI units: the rod, its supports, its start shape, and what is
    /// prescribed in time. Every solver for a material begins here.</summary>
    internal sealed class MaterialScene
    {
        /// <summary>The scene of these parameters.</summary>
        /// <exception cref="ArgumentException">The start has another number of elements than the wire.</exception>
        public MaterialScene(SimulationParameters parameters)
        {
            Metres = parameters.Scene.MetresPerUnit;
            Rod = CreateRod(parameters);
            int n = Rod.ElementCount;
            Shape = new RodShape(n);
            Velocities = new Vector3d[n + 1];
            Spins = new Vector3d[n];
            var start = new Vector3d(0.0, 0.0, Metres * parameters.Scene.GuidewireOffset);
            SetStartShape(parameters.Scene, start);
            if (parameters.Scene.Start != null)
            {
                Load(parameters.Scene.Start);
            }
            Supports = new RodSupports
            {
                Proximal = parameters.Drive.Kind == Drive.Force ? ProximalEnd.Free : parameters.Scene.ProximalEnd,
                Distal = parameters.Scene.DistalEnd,
                SlidingAxis = Shape.DistalFrame.Director3,
                Clamp = parameters.Material.ClampRule,
                Mass = parameters.Material.MassRule,
                Bend = parameters.Material.BendLaw,
            };
            Schedule = new RodSchedule
            {
                Gravity = parameters.Scene.Gravity,
                TipForce = parameters.Scene.TipForce,
                TipForceReleaseTime = parameters.Scene.TipForceReleaseTime,
                AxialForce = parameters.Scene.DistalEnd == DistalEnd.Sliding ? parameters.Scene.AxialForce : 0.0,
                ProximalForce = parameters.Drive.Kind == Drive.Force ? parameters.Drive.ExternalForce : Vector3d.Zero,
                ProximalPosition = Shape.X[0],
                ProximalFrame = Shape.ProximalFrame,
                ProximalTwistRate = parameters.Drive.TwistPerStep / parameters.Method.TimeStep,
                DistalPosition = Shape.X[n],
                DistalFrame = Shape.DistalFrame,
                DistalDisplacement = Metres * parameters.Scene.DistalDisplacement,
                DistalRotation = parameters.Scene.DistalRotation,
                DistalRampTime = parameters.Scene.DistalRampTime,
            };
            if (parameters.Drive.Kind == Drive.Hold)
            {
                Displacement = (Metres * parameters.Drive.Displacement)
                    * Vector3d.Normalize(parameters.Drive.DisplacementDirection);
                Schedule.ProximalPosition += Displacement;
            }
        }

        /// <summary>Metres per unit.</summary>
        public double Metres { get; }

        /// <summary>The rod.</summary>
        public MaterialRod Rod { get; }

        /// <summary>How it is held.</summary>
        public RodSupports Supports { get; }

        /// <summary>Where it is at the start, before the displacement of sphere 0, m.</summary>
        public RodShape Shape { get; }

        /// <summary>Velocities at the start, m/s.</summary>
        public Vector3d[] Velocities { get; }

        /// <summary>Angular velocities at the start along the elements' axes, rad/s.</summary>
        public Vector3d[] Spins { get; }

        /// <summary>What is prescribed.</summary>
        public RodSchedule Schedule { get; }

        /// <summary>Displacement of sphere 0 at the start, m.</summary>
        public Vector3d Displacement { get; }

        /// <summary>Writes positions and velocities in units, orientations and angular velocities into a
        /// state.</summary>
        public void Write(RodState state, RodShape shape, Vector3d[] velocities, Vector3d[] spins)
        {
            double units = 1.0 / Metres;
            for (int i = 0; i < shape.X.Length; i++)
            {
                state.PredictedPositions[i] = units * shape.X[i];
                state.Velocities[i] = units * velocities[i];
            }
            Array.Copy(shape.Q, state.PredictedOrientations, shape.Q.Length);
            Array.Copy(spins, state.AngularVelocities, spins.Length);
            state.Advance();
        }

        private static MaterialRod CreateRod(SimulationParameters parameters)
        {
            int n = parameters.Scene.NumberRodElements;
            double metres = parameters.Scene.MetresPerUnit;
            MaterialRod rod = MaterialRod.Round(n, metres * parameters.Scene.GuidewireLength,
                parameters.Material.WireRadius, parameters.Material.YoungsModulus, parameters.Material.ShearModulus,
                parameters.Material.Density);
            for (int j = 0; j < n; j++)
            {
                double radius = parameters.Material.WireRadius;
                double young = parameters.Material.YoungsModulus;
                double shear = parameters.Material.ShearModulus;
                double density = parameters.Material.Density;
                Vector3d curvature = parameters.Material.RestCurvature;
                double middle = (j + 0.5) / n * parameters.Scene.GuidewireLength;
                foreach (WireSection section in parameters.Material.Sections)
                {
                    if (middle >= section.From && middle < section.To)
                    {
                        radius = section.WireRadius ?? radius;
                        young = section.YoungsModulus ?? young;
                        shear = section.ShearModulus ?? shear;
                        density = section.Density ?? density;
                        curvature = section.RestCurvature ?? curvature;
                    }
                }
                rod.SetRound(j, radius, young, shear, density);
                rod.RestCurvature[j] = curvature;
            }
            return rod;
        }

        private void SetStartShape(SceneParameters scene, in Vector3d start)
        {
            switch (scene.StartShape)
            {
                case StartShape.Ring:
                    StartShapes.Ring(Shape, start, Rod.Length);
                    break;
                case StartShape.Helix:
                    StartShapes.Helix(Shape, start, Rod.Length, Metres * scene.StartRadius, scene.StartTurns);
                    break;
                default:
                    Shape.SetStraight(start, Quaterniond.Identity, Rod.Length);
                    break;
            }
        }

        private void Load(RodStart start)
        {
            if (start.Orientations.Length != Rod.ElementCount)
            {
                throw new ArgumentException("the start has " + start.Orientations.Length + " elements, the wire "
                    + Rod.ElementCount);
            }
            for (int i = 0; i < Shape.X.Length; i++)
            {
                Shape.X[i] = Metres * start.Positions[i];
                Velocities[i] = Metres * start.Velocities[i];
            }
            for (int j = 0; j < Shape.Q.Length; j++)
            {
                Shape.Q[j] = Quaterniond.Normalize(start.Orientations[j]);
                Spins[j] = start.AngularVelocities[j];
            }
        }
    }
}
