using System;

namespace Guidewire.Core
{
    /// <summary>The energy of a gap g between the wire's surface and a wall: b(g) = -k (g - g0)^2 ln(g/g0) for g below
    /// g0, 0 beyond, infinite at 0 (Li et al. 2020, incremental potential contact). A soft wall adds that of a spring,
    /// s (g0 - g)^2/2 (<see cref="WallLaw"/>), which a wall that lags behind begins later (<see cref="WallLag"/>).
    /// </summary>
    internal readonly struct Barrier
    {
        /// <summary>The distance g0, m.</summary>
        public readonly double Distance;

        /// <summary>k, N/m: the force at half of g0 is 1.19 k g0.</summary>
        public readonly double Stiffness;

        /// <summary>s, N/m; 0 of a rigid wall.</summary>
        public readonly double Spring;

        /// <summary>Displacement at which the spring begins to act, m; 0 but where the wall lags.</summary>
        public readonly double Onset;

        private const double ForceTolerance = 1e-3;    // relative, of where a chord ends
        private const int MaxIterations = 30;

        /// <summary>With this distance and stiffness.</summary>
        public Barrier(double distance, double stiffness, double spring = 0.0, double onset = 0.0)
        {
            Distance = distance;
            Stiffness = stiffness;
            Spring = spring;
            Onset = onset;
        }

        /// <summary>So many times as stiff.</summary>
        public Barrier Times(double factor) => new Barrier(Distance, factor * Stiffness, factor * Spring, Onset);

        /// <summary>How far the spring is pressed, m; 0 before it acts.</summary>
        public double Pressed(double gap) => Math.Max(0.0, Distance - gap - Onset);

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
            double factor = Factor(x, out double log, out double derivative);
            double sunk = Pressed(gap);
            slope = -Stiffness * Distance * below * factor - Spring * sunk;
            curvature = -Stiffness * derivative + (sunk > 0.0 ? Spring : 0.0);
            return -Stiffness * Distance * Distance * below * below * log + 0.5 * Spring * sunk * sunk;
        }

        /// <summary>The mean stiffness on the way from a gap to where the force is so many times as large, as a
        /// multiple of b''. Where that is 0 or less, the way ends where the force does.</summary>
        public double ChordStiffness(double gap, double ratio)
        {
            double x = gap / Distance;
            double force = ForceAt(x, out double slope);
            if (!(ratio > 0.0))
            {
                return force / (slope * (x - 1.0));
            }
            double asked = ratio * force;
            // Both are below the gap that is looked for: |f| >= 3 (1 - x)^2, and |f| >= 1/x - 1 for x <= 0.6. With a
            // spring it is larger still.
            double end = 1.0 - Math.Sqrt(asked / 3.0);
            end = asked > 2.0 / 3.0 ? Math.Max(end, 1.0 / (1.0 + asked)) : end;
            end = ratio < 1.0 ? Math.Max(end, x) : end;
            double forceAtEnd = ForceAt(end, out double slopeAtEnd);
            for (int k = 0; k < MaxIterations && Math.Abs(forceAtEnd - asked) > ForceTolerance * asked; k++)
            {
                if (!(slopeAtEnd < 0.0))
                {
                    break;    // rounded to g0
                }
                end -= (forceAtEnd - asked) / slopeAtEnd;
                forceAtEnd = ForceAt(end, out slopeAtEnd);
            }
            double way = end - x;
            return Math.Abs(way) > ForceTolerance * (1.0 - x) * x ? (forceAtEnd - force) / (way * slope) : 1.0;
        }

        // Of x = g/g0: |b'|/(k g0), a convex function, and its derivative.
        private double ForceAt(double x, out double slope)
        {
            double factor = Factor(x, out _, out slope);
            double spring = x < 1.0 - Onset / Distance ? Spring / Stiffness : 0.0;
            slope -= spring;
            return (x - 1.0) * (factor - spring) - spring * Onset / Distance;
        }

        // |b'|/(k g0) over x - 1, with ln x and the derivative of the former.
        private static double Factor(double x, out double log, out double derivative)
        {
            log = Math.Log(x);
            double ratio = (x - 1.0) / x;
            derivative = 2.0 * log + ratio * (4.0 - ratio);
            return 2.0 * log + ratio;
        }
    }
}
