using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Contribution to a joint of an instrument that is rotated by an angle t against the joint's frame
    /// (<see cref="CoaxialJoint"/>).</summary>
    internal struct CoaxialPart
    {
        public double RestX, RestY;   // F', rest rotation of the part in its own axes, rad
        public double FrameCosine;    // C of its energy C cos t + S sin t with the instrument whose frame it is, J
        public double FrameSine;      // S
        public double Twist;       // K', N m; 0 where it ends at the joint
        public double RestTwist;   // r', rad
        public double Weight;      // of the angle after the joint in t; the rest is that before it

        /// <summary>Adds R(t) F' to f.</summary>
        /// <param name="slope">Derivative of f by t.</param>
        /// <param name="turned">What was added, minus the second derivative.</param>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly void AddRest(double t, ref Vector3d rest, out Vector3d slope, out Vector3d turned)
        {
            slope = Vector3d.Zero;
            turned = Vector3d.Zero;
            if (RestX == 0.0 && RestY == 0.0)
            {
                return;
            }
            double c = Math.Cos(t);
            double s = Math.Sin(t);
            double x = c * RestX - s * RestY;
            double y = s * RestX + c * RestY;
            Vector3d before = rest;
            rest = new Vector3d(before.X + x, before.Y + y, 0.0);
            slope = new Vector3d(-y, x, 0.0);
            turned = rest - before;
        }

        /// <summary>Gives its turn under a torque, N m, radians: at rest where it ends before the joint.</summary>
        public readonly double TurnBy(double torque) => Twist == 0.0 ? RestTwist : torque / Twist + RestTwist;

        /// <summary>C cos t + S sin t, J, which is its second derivative's negative, and minus its first.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly double Held(double t, out double slope)
        {
            slope = 0.0;
            return FrameCosine == 0.0 && FrameSine == 0.0 ? 0.0
                : CoaxialJoint.Wave(FrameCosine, FrameSine, t, out slope);
        }
    }
}
