using Guidewire.Core;

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
                NumberRodElements = elements,
                GuidewireLength = 10.0 * elements,
                ConstraintSolverSteps = iterations,
                DisplacementDirection = Vector3d.UnitY,
                DeltaThreshold = 0.0,
                MaxSimulationSteps = int.MaxValue,
            });
        }
    }
}
