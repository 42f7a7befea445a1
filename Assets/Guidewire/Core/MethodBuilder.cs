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

    /// <summary>A run as built by a method, before its first step.</summary>
    internal sealed class MethodStart
    {
        /// <summary>A wire and what steps it.</summary>
        public MethodStart(RodState state, TimeStepper stepper)
        {
            State = state;
            Stepper = stepper;
        }

        /// <summary>The wire at its start.</summary>
        public RodState State { get; }

        /// <summary>What steps the wire.</summary>
        public TimeStepper Stepper { get; }

        /// <summary>Why there is no start, in one line, or null.</summary>
        public string? Failure { get; set; }

        /// <summary>Whether the wire starts in its rest shape.</summary>
        public bool IsAtRest { get; set; }
    }
}
