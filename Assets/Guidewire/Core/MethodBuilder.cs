using System;

namespace Guidewire.Core
{
    /// <summary>Builds the wire of a run and its time stepper; here alone the method is chosen.</summary>
    internal static class MethodBuilder
    {
        /// <summary>Gives the wire at its start, and its stepper.</summary>
        /// <exception cref="ArgumentException">A wire that starts outside the vessel, or a value that the method does
        /// not take.</exception>
        public static MethodStart Build(SimulationParameters parameters, Scene scene)
        {
            switch (parameters.Method.Solver)
            {
                case Solver.Pbd:
                    return PbdSetup.Build(parameters, scene);
                case Solver.Xpbd:
                    return MaterialSetup.Build(parameters, scene, MaterialSetup.Compliant);
                case Solver.Direct:
                    return MaterialSetup.Build(parameters, scene, MaterialSetup.Direct);
                case Solver.Explicit:
                    return MaterialSetup.Build(parameters, scene, MaterialSetup.Explicit);
                default:
                    throw new ArgumentException("unknown solver " + parameters.Method.Solver);
            }
        }
    }
}
