using System;

namespace Guidewire.Core
{
    /// <summary>Start shapes other than the straight wire.</summary>
    internal static class StartShapes
    {
        /// <summary>A polygon on a circle through the start, closed, in the y-z plane, tangent to z at the start. Both
        /// clamps have the frame of the start.</summary>
        public static void Ring(RodShape shape, in Vector3d start, double[] lengths)
        {
            int n = shape.ElementCount;
            double total = Sum(lengths);
            double s = 0.0;
            shape.X[0] = start;
            for (int j = 0; j < n; j++)
            {
                // Turned about -x, so that the ring rises into +y.
                double angle = 2.0 * Math.PI * (s + 0.5 * lengths[j]) / total;
                Quaterniond frame = Quaterniond.FromAxisAngle(-Vector3d.UnitX, angle);
                s += lengths[j];
                shape.Q[j] = frame;
                shape.X[j + 1] = shape.X[j] + lengths[j] * frame.Director3;
            }
            shape.X[n] = start;
            shape.ProximalFrame = Quaterniond.Identity;
            shape.DistalFrame = Quaterniond.Identity;
        }

        /// <summary>A helix about the z axis through the start, of this radius (m) and number of turns; its frames
        /// follow the tangent without turning about it. The clamps' frames look along z.</summary>
        /// <exception cref="ArgumentException">The wire is too short for so many turns.</exception>
        public static void Helix(RodShape shape, in Vector3d start, double[] lengths, double radius, double turns)
        {
            int n = shape.ElementCount;
            double total = Sum(lengths);
            double around = 2.0 * Math.PI * turns * radius / total;
            if (!(Math.Abs(around) < 1.0))
            {
                throw new ArgumentException("a helix of this radius and number of turns is longer than the wire");
            }
            double along = Math.Sqrt(1.0 - around * around);
            Quaterniond frame = Quaterniond.Identity;
            double s = 0.0;
            shape.X[0] = start;
            for (int j = 0; j < n; j++)
            {
                double angle = 2.0 * Math.PI * turns * (s + 0.5 * lengths[j]) / total;
                var tangent = new Vector3d(-around * Math.Sin(angle), around * Math.Cos(angle), along);
                frame = RodStart.Turned(frame, tangent);
                shape.Q[j] = frame;
                shape.X[j + 1] = shape.X[j] + lengths[j] * tangent;
                s += lengths[j];
            }
            shape.ProximalFrame = Quaterniond.Identity;
            shape.DistalFrame = Quaterniond.Identity;
        }

        private static double Sum(double[] lengths)
        {
            double total = 0.0;
            foreach (double l in lengths)
            {
                total += l;
            }
            return total;
        }
    }
}
