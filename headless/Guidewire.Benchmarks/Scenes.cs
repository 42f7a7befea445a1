namespace Guidewire.Benchmarks
{
    /// <summary>Scenes that more than one benchmark steps.</summary>
    internal static class Scenes
    {
        /// <summary>The default wire (thesis table 4.1) displaced along y, which excites stretch and bending,
        /// never at its
        /// end.</summary>
        public static Simulation Transversal(int elements, int iterations)
        {
            return Simulation.Create(new SimulationParameters
            {
                Scene = { NumberRodElements = elements, GuidewireLength = 10.0 * elements },
                Method =
                {
                    ConstraintSolverSteps = iterations,
                    DeltaThreshold = 0.0,
                    MaxSimulationSteps = int.MaxValue,
                },
                Drive = { DisplacementDirection = Vector3d.UnitY },
            });
        }
    }
}
