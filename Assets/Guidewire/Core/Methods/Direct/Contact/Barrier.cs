using System;

namespace Guidewire.Core
{
    /// <summary>The energy of a gap g between the wire's surface and a wall: b(g) = -k (g - g0)^2 ln(g/g0) for g below
    /// g0, 0 beyond, infinite at 0 (Li et al. 2020, incremental potential contact).</summary>
    internal readonly struct Barrier
    {
        private const int MostIterations = 8;
        private const double Accuracy = 1e-3;    // of the gap at a force

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

        /// <summary>Stiffness of the chord of the force -b' between the gap of one force and that of another, N/m.
        /// </summary>
        /// <param name="gap">The gap of the one, between 0 and g0, m.</param>
        /// <param name="force">The one, -b'(gap), N.</param>
        /// <param name="other">The other, 0 or more, N.</param>
        public double ChordStiffness(double gap, double force, double other)
        {
            return (force - other) / (Distance * RelativeGapAt(other / (Stiffness * Distance)) - gap);
        }

        // g/g0 at a force over k g0, by Newton's method from near g0 or from near a wall.
        private static double RelativeGapAt(double force)
        {
            double x = force < 1.0 ? 1.0 - Math.Sqrt(force / 3.0) : 1.0 / (1.0 + force);
            bool isFound = force == 0.0;
            for (int k = 0; k < MostIterations && !isFound; k++)
            {
                double below = x - 1.0;
                double log = Math.Log(x);
                double ratio = below / x;
                double next = x - (below * (2.0 * log + ratio) - force) / (2.0 * log + ratio * (4.0 - ratio));
                next = Math.Max(0.5 * x, Math.Min(next, 0.5 * (1.0 + x)));
                isFound = Math.Abs(next - x) <= Accuracy * Math.Min(x, 1.0 - x);
                x = next;
            }
            return x;
        }
    }
}
