namespace Guidewire.Core
{
    /// <summary>A scene whose wire is a material, in SI units: the rod and how it is held, beside what is simulated.
    /// Every method for a material begins here.</summary>
    internal sealed class MaterialScene
    {
        private readonly Scene _scene;

        /// <summary>The scene of these parameters.</summary>
        public MaterialScene(SimulationParameters parameters, Scene scene)
        {
            _scene = scene;
            Rod = CreateRod(parameters, scene.ElementLengths);
            Supports = new RodSupports
            {
                Proximal = parameters.Drive.Kind == Core.Drive.Force ? ProximalEnd.Free : parameters.Scene.ProximalEnd,
                Distal = parameters.Scene.DistalEnd,
                SlidingAxis = scene.Shape.DistalFrame.Director3,
                Clamp = parameters.Material.ClampRule,
                Mass = parameters.Material.MassRule,
                Bend = parameters.Material.BendLaw,
            };
            scene.Schedule.ProximalPosition += scene.Displacement;
            Drive = new MaterialDrive(parameters, scene);
        }

        /// <summary>Metres per unit.</summary>
        public double Metres => _scene.UnitLength;

        /// <summary>The rod.</summary>
        public MaterialRod Rod { get; }

        /// <summary>How it is held.</summary>
        public RodSupports Supports { get; }

        /// <summary>What moves node 0 in every step.</summary>
        public MaterialDrive Drive { get; }

        /// <summary>Where the rod is at the start, before the displacement of sphere 0, m.</summary>
        public RodShape Shape => _scene.Shape;

        /// <summary>Velocities at the start, m/s.</summary>
        public Vector3d[] Velocities => _scene.Velocities;

        /// <summary>Angular velocities at the start along the elements' axes, rad/s.</summary>
        public Vector3d[] Spins => _scene.Spins;

        /// <summary>What is prescribed.</summary>
        public RodSchedule Schedule => _scene.Schedule;

        /// <summary>Writes a moment of the rod into a state: positions and velocities in units, orientations and
        /// angular velocities.</summary>
        public void Write(RodState state, RodShape shape, Vector3d[] velocities, Vector3d[] spins)
        {
            double units = 1.0 / Metres;
            for (int i = 0; i < shape.X.Length; i++)
            {
                state.PredictedPositions[i] = units * shape.X[i];
                state.Velocities[i] = units * velocities[i];
            }
            System.Array.Copy(shape.Q, state.PredictedOrientations, shape.Q.Length);
            System.Array.Copy(spins, state.AngularVelocities, spins.Length);
            state.Advance();
        }

        private static MaterialRod CreateRod(SimulationParameters parameters, double[] lengths)
        {
            var profile = new WireProfile(parameters.Material, parameters.Scene.GuidewireLength);
            ElementLayout.Lengths(parameters, 1.0, out double[] places);
            var rod = new MaterialRod(lengths.Length);
            for (int j = 0; j < lengths.Length; j++)
            {
                rod.Length[j] = lengths[j];
                profile.SetElement(rod, j, places[j], places[j + 1]);
            }
            return rod;
        }
    }
}
