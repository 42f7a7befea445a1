using System;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Runtime
{
    /// <summary>The parameters that the Inspector shows and changes while a wire is simulated. At the start they take
    /// the parameter file's values.</summary>
    [Serializable]
    public sealed class LiveParameters
    {
        /// <summary>m.</summary>
        [Parameter("constraintSolverSteps")] public int constraintSolverSteps;

        /// <summary>k_A.</summary>
        [Parameter("stretchStiffness")] public double stretchStiffness;

        /// <summary>k_B in units.</summary>
        [Parameter("bendStiffness")] public double bendStiffness;

        /// <summary>k_C.</summary>
        [Parameter("collisionStiffness")] public double collisionStiffness;

        /// <summary>d.</summary>
        [Parameter("damping")] public double damping;

        /// <summary>dt in s.</summary>
        [Parameter("timeStep")] public double timeStep;

        /// <summary>Takes over what a run has.</summary>
        public void Read(SimulationParameters parameters)
        {
            constraintSolverSteps = parameters.Method.ConstraintSolverSteps;
            stretchStiffness = parameters.Pbd.StretchStiffness;
            bendStiffness = parameters.Pbd.BendStiffness;
            collisionStiffness = parameters.Contact.CollisionStiffness;
            damping = parameters.Method.Damping;
            timeStep = parameters.Method.TimeStep;
        }

        /// <summary>The first key whose value is not what a run has, or null.</summary>
        /// <param name="parameters">What the run has.</param>
        /// <param name="value">The value here.</param>
        public string? FirstChange(SimulationParameters parameters, out JToken? value)
        {
            if (constraintSolverSteps != parameters.Method.ConstraintSolverSteps)
            {
                value = constraintSolverSteps;
                return "constraintSolverSteps";
            }
            return Differs("stretchStiffness", stretchStiffness, parameters.Pbd.StretchStiffness, out value)
                ?? Differs("bendStiffness", bendStiffness, parameters.Pbd.BendStiffness, out value)
                ?? Differs("collisionStiffness", collisionStiffness, parameters.Contact.CollisionStiffness, out value)
                ?? Differs("damping", damping, parameters.Method.Damping, out value)
                ?? Differs("timeStep", timeStep, parameters.Method.TimeStep, out value);
        }

        private static string? Differs(string key, double here, double there, out JToken? value)
        {
            // A number that is not one equals nothing, and must be refused rather than overlooked.
            bool same = here.Equals(there);
            value = same ? null : new JValue(here);
            return same ? null : key;
        }
    }
}
