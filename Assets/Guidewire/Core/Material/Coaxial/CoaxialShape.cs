using System;

namespace Guidewire.Core
{
    /// <summary>What becomes of a shape of coaxial instruments where inner nodes come in beyond the outer tip, or
    /// go.</summary>
    internal static class CoaxialShape
    {
        /// <summary>The shape with as many nodes as these joints have: an element that comes in is a piece of the first
        /// one beyond the tip, or goes on from the tip; where one goes, the next one reaches back to the tip.</summary>
        public static RodShape Take(RodShape old, CoaxialJoints joints)
        {
            int n = joints.ElementCount;
            int tip = joints.OuterCount;
            int more = n - old.ElementCount;
            var shape = new RodShape(n, true) { ProximalFrame = old.ProximalFrame, DistalFrame = old.DistalFrame };
            for (int j = 0; j < n; j++)
            {
                int from = SourceOf(j, tip, more, old.ElementCount);
                shape.Q[j] = from >= 0 ? old.Q[from] : InnerFrame(old, tip - 1);
                shape.Twist[j] = j < tip ? old.Twist[j] : 0.0;
            }
            Array.Copy(old.X, shape.X, tip + 1);
            for (int i = tip + 1; i <= n; i++)
            {
                if (i - more > tip)
                {
                    shape.X[i] = old.X[i - more];
                }
            }
            // What comes in lies on the element that it divides, or on the axis of the outer tip.
            double[] station = joints.Stations;
            bool isDivided = old.ElementCount > tip;
            for (int i = tip + 1; i <= tip + more; i++)
            {
                Vector3d chord = isDivided
                    ? (1.0 / (station[tip + more + 1] - station[tip])) * (old.X[tip + 1] - old.X[tip])
                    : old.Q[tip - 1].Director3;
                shape.X[i] = old.X[tip] + (station[i] - station[tip]) * chord;
            }
            return shape;
        }

        /// <summary>The old element of which element j goes on; -1 where there was none beyond the outer tip.</summary>
        /// <param name="more">Elements that come in, negative where some go.</param>
        public static int SourceOf(int j, int tip, int more, int oldCount)
        {
            return j < tip ? j : oldCount > tip ? Math.Max(j - more, tip) : -1;
        }

        /// <summary>The turn in a direction of the first element beyond the outer tip against the inner instrument's
        /// frame before it, radians: |theta_b - R^T theta_a - e3 dz|; 0 where none is beyond.</summary>
        /// <param name="rod">The instruments, or null for one alone.</param>
        public static double TurnAtTip(CoaxialRod? rod, RodShape shape, RodVector[] direction)
        {
            if (rod == null || rod.Joints.Beyond == 0)
            {
                return 0.0;
            }
            int tip = rod.Joints.OuterCount;
            RodVector a = direction[tip - 1];
            RodVector b = direction[tip];
            double c = Math.Cos(shape.Twist[tip - 1]);
            double s = Math.Sin(shape.Twist[tip - 1]);
            return new Vector3d(b.T1 - c * a.T1 - s * a.T2, b.T2 + s * a.T1 - c * a.T2,
                b.T3 - a.T3 - direction[shape.ElementCount + 1 + tip].T3).Length;
        }

        /// <summary>The frame of the inner instrument in an element of the outer one.</summary>
        public static Quaterniond InnerFrame(RodShape shape, int element)
        {
            return shape.Q[element] * Quaterniond.FromAxisAngle(Vector3d.UnitZ, shape.Twist[element]);
        }
    }
}
