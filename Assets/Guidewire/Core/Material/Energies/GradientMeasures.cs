using System;

namespace Guidewire.Core
{
    /// <summary>Quantities that the terms measure while they add their gradients, combined over all terms and
    /// ranges.</summary>
    internal struct GradientMeasures
    {
        /// <summary>The largest force in an element, N.</summary>
        public double LargestForce;

        /// <summary>Takes in the largest force that one term found in one range, N.</summary>
        public void IncludeForce(double force) => LargestForce = Math.Max(LargestForce, force);
    }
}
