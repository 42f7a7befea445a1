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
            MaterialParameters material = parameters.Material;
            Metres = material.MetresPerUnit;
            Rod = CreateRod(parameters);
            int n = Rod.ElementCount;
            Shape = new RodShape(n);
            Velocities = new Vector3d[n + 1];
            Spins = new Vector3d[n];
            var start = new Vector3d(0.0, 0.0, Metres * parameters.GuidewireOffset);
            SetStartShape(material, start);
            if (parameters.Start != null)
            {
                Load(parameters.Start);
            }
            Supports = new RodSupports
            {
                Proximal = parameters.Drive == Drive.Force ? ProximalEnd.Free : material.ProximalEnd,
                Distal = material.DistalEnd,
                SlidingAxis = Shape.DistalFrame.Director3,
                Clamp = material.ClampRule,
                Mass = material.MassRule,
                Bend = material.BendLaw,
            };
            Schedule = new RodSchedule
            {
                Gravity = parameters.Gravity,
                TipForce = material.TipForce,
                TipForceReleaseTime = material.TipForceReleaseTime,
                AxialForce = material.DistalEnd == DistalEnd.Sliding ? material.AxialForce : 0.0,
                ProximalForce = parameters.Drive == Drive.Force ? parameters.ExternalForce : Vector3d.Zero,
                ProximalPosition = Shape.X[0],
                ProximalFrame = Shape.ProximalFrame,
                ProximalTwistRate = parameters.TwistPerStep / parameters.TimeStep,
                DistalPosition = Shape.X[n],
                DistalFrame = Shape.DistalFrame,
                DistalDisplacement = Metres * material.DistalDisplacement,
                DistalRotation = material.DistalRotation,
                DistalRampTime = material.DistalRampTime,
            };
            if (parameters.Drive == Drive.Hold)
            {
                Displacement = (Metres * parameters.Displacement)
                    * Vector3d.Normalize(parameters.DisplacementDirection);
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
            MaterialParameters material = parameters.Material;
            int n = parameters.NumberRodElements;
            double metres = material.MetresPerUnit;
            MaterialRod rod = MaterialRod.Round(n, metres * parameters.GuidewireLength, material.WireRadius,
                material.YoungsModulus, material.ShearModulus, material.Density);
            for (int j = 0; j < n; j++)
            {
                double radius = material.WireRadius;
                double young = material.YoungsModulus;
                double shear = material.ShearModulus;
                double density = material.Density;
                Vector3d curvature = material.RestCurvature;
                double middle = (j + 0.5) / n * parameters.GuidewireLength;
                foreach (WireSection section in material.Sections)
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

        private void SetStartShape(MaterialParameters material, in Vector3d start)
        {
            switch (material.StartShape)
            {
                case StartShape.Ring:
                    StartShapes.Ring(Shape, start, Rod.Length);
                    break;
                case StartShape.Helix:
                    StartShapes.Helix(Shape, start, Rod.Length, Metres * material.StartRadius, material.StartTurns);
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
