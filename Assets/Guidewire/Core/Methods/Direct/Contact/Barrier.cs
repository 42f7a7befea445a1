using System;

namespace Guidewire.Core
{
    /// <summary>The energy of a gap g between the wire's surface and a wall: b(g) = -k (g - g0)^2 ln(g/g0) for g below
    /// g0, 0 beyond, infinite at 0 (Li et al. 2020, incremental potential contact).</summary>
    internal readonly struct Barrier
    {
        /// <summary>g0, m.</summary>
        public readonly double Distance;

        /// <summary>k, N/m: the force at half of g0 is 1.19 k g0.</summary>
        public readonly double Stiffness;

        /// <summary>With this distance and stiffness.</summary>
        public Barrier(double distance, double stiffness)
        {
            Distance = distance;
            Stiffness = stiffness;
        }

        /// <summary>b(g), J, with its first and second derivatives; infinite for a gap that is closed.</summary>
        public double At(double gap, out double slope, out double curvature)
        {
            slope = 0.0;
            curvature = 0.0;
            if (gap >= Distance)
            {
                return 0.0;
            }
            if (!(gap > 0.0))
            {
                return double.PositiveInfinity;
            }
            double x = gap / Distance;
            double below = x - 1.0;
            double log = Math.Log(x);
            double ratio = below / x;
            slope = -Stiffness * Distance * below * (2.0 * log + ratio);
            curvature = -Stiffness * (2.0 * log + ratio * (4.0 - ratio));
            return -Stiffness * Distance * Distance * below * below * log;
        }
    }
}
