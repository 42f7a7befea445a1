using System;

namespace Guidewire.Core
{
    /// <summary>Places, frames and angles of coaxial instruments on a chain.</summary>
    internal static class CoaxialShape
    {
        /// <summary>Gives the element at a place along the chain, m, from one before it on.</summary>
        public static int ElementAt(CoaxialJoints joints, double at, int from)
        {
            while (from < joints.ElementCount - 1 && at > joints.Stations[from + 1])
            {
                from++;
            }
            return from;
        }

        /// <summary>Gives the angle on an element from one instrument's frame to another's, radians; beyond the tip of
        /// one of them, at that tip.</summary>
        /// <param name="values">Angles of the chain, or their rates.</param>
        public static double Angle(RodShape shape, double[] values, CoaxialJoints joints, int element, int instrument,
            int frame)
        {
            int outer = Math.Min(instrument, frame);
            if (joints.CarrierOf(element) > outer)
            {
                element = joints.TipOf(outer) - 1;
            }
            int carrier = joints.CarrierOf(element);
            int n = shape.ElementCount;
            double to = instrument > carrier ? values[(instrument - 1) * n + element] : 0.0;
            return frame > carrier ? to - values[(frame - 1) * n + element] : to;
        }

        /// <summary>Turns all instruments along their whole length as their hubs are turned at the start.</summary>
        public static void SetTwists(RodShape shape, CoaxialJoints joints, CoaxialHubs hubs)
        {
            for (int i = 1; i < joints.Count; i++)
            {
                for (int j = 0; j < joints.ActiveCountOf(i); j++)
                {
                    int carrier = joints.CarrierOf(j);
                    shape.Twist[(i - 1) * joints.ElementCount + j] = hubs.TwistAt(i, 0.0)
                        - (carrier == 0 ? 0.0 : hubs.TwistAt(carrier, 0.0));
                }
            }
            for (int j = joints.OuterCount; j < joints.ElementCount; j++)
            {
                shape.Q[j] *= Quaterniond.FromAxisAngle(Vector3d.UnitZ, hubs.TwistAt(joints.CarrierOf(j), 0.0));
            }
        }

        /// <summary>Gives the frame of an instrument in an element.</summary>
        public static Quaterniond FrameOf(RodShape shape, CoaxialJoints joints, int element, int instrument)
        {
            int carrier = joints.CarrierOf(element);
            return instrument == carrier ? shape.Q[element] : shape.Q[element] * Quaterniond.FromAxisAngle(
                Vector3d.UnitZ, Angle(shape, shape.Twist, joints, element, instrument, carrier));
        }

        /// <summary>The spin of an instrument in an element, along its own axes, rad/s.</summary>
        /// <param name="spin">That of the outermost one there.</param>
        public static Vector3d SpinOf(RodShape shape, double[] twistRates, CoaxialJoints joints, int element,
            int instrument, in Vector3d spin)
        {
            int carrier = joints.CarrierOf(element);
            double angle = Angle(shape, shape.Twist, joints, element, instrument, carrier);
            double c = Math.Cos(angle);
            double s = Math.Sin(angle);
            return new Vector3d(c * spin.X + s * spin.Y, c * spin.Y - s * spin.X,
                spin.Z + Angle(shape, twistRates, joints, element, instrument, carrier));
        }

        /// <summary>By how much the innermost instrument's own angle from its hub to the end of the elements around it
        /// is more than theirs, rad.</summary>
        public static double InnermostTwist(RodShape shape, CoaxialBendTwist bending)
        {
            CoaxialJoints joints = bending.Joints;
            int wire = joints.InnerCount;
            int first = (wire - 1) * shape.ElementCount;
            int active = joints.ActiveCountOf(wire);
            int last = Math.Max(Math.Min(active, joints.OuterCount) - 1, 0);
            double twist = shape.Twist[first + last] - bending.HubTwist[wire];
            return active <= joints.OuterCount ? twist : twist + shape.Twist[first + active - 1]
                - Angle(shape, shape.Twist, joints, joints.OuterCount - 1, wire, 1);
        }

        /// <summary>Curvature at joint k about the axes of an instrument inside, and its own twist, rad/m; 0 in a
        /// sheath.</summary>
        public static Vector3d CurvatureOf(RodShape shape, CoaxialBendTwist bending, int k, int instrument)
        {
            CoaxialJoints joints = bending.Joints;
            double outside = joints.FractionOutside(k);
            int frame = joints.CarrierOf(k);
            double before = bending.AngleAt(shape, k - 1, instrument, frame);
            double after = bending.AngleAt(shape, k, instrument, frame);
            Vector3d turn = bending.TurnOf(shape, k);
            double bend = outside > CoaxialJoints.MinFraction ? 1.0 / outside : 0.0;
            double c = bend * Math.Cos(0.5 * (before + after));
            double s = bend * Math.Sin(0.5 * (before + after));
            Vector3d curvature = 1.0 / joints.LengthOf(k) * new Vector3d(c * turn.X + s * turn.Y,
                c * turn.Y - s * turn.X, turn.Z + after - before);
            return k > 0 ? curvature
                : new Vector3d(curvature.X, curvature.Y, LeadTwist(shape, bending, instrument).Z);
        }

        /// <summary>Gives the even twist of an instrument inside from its own hub to the middle of the chain's first
        /// element, rad/m.</summary>
        public static Vector3d LeadTwist(RodShape shape, CoaxialBendTwist bending, int instrument)
        {
            CoaxialJoints joints = bending.Joints;
            double length = joints.LeadOf(instrument) + 0.5 * (joints.Stations[0] + joints.Stations[1]);
            double twist = bending.TurnOf(shape, 0).Z + bending.AngleAt(shape, 0, instrument, 0)
                - bending.HubTwist[instrument];
            return twist / length * Vector3d.UnitZ;
        }

        /// <summary>The largest turn in a direction of the first element beyond a tip against the frame before it of
        /// the instrument that goes on, radians: |theta_b - R^T theta_a - e3 dz|; 0 where none is beyond.</summary>
        /// <param name="rod">The instruments, or null for one alone.</param>
        public static double TurnAtTips(CoaxialRod? rod, RodShape shape, RodVector[] direction)
        {
            double largest = 0.0;
            for (int i = 0; rod != null && i < rod.Joints.InnerCount; i++)
            {
                int tip = rod.Joints.TipOf(i);
                if (rod.Joints.IsTip(tip) && rod.Joints.CarrierOf(tip - 1) == i)
                {
                    largest = Math.Max(largest, TurnAtTip(rod.Joints, shape, direction, tip));
                }
            }
            return largest;
        }

        private static double TurnAtTip(CoaxialJoints joints, RodShape shape, RodVector[] direction, int tip)
        {
            int instrument = joints.CarrierOf(tip);
            RodVector a = direction[tip - 1];
            RodVector b = direction[tip];
            RodVector z = direction[shape.ElementCount + 1 + tip];
            double angle = Angle(shape, shape.Twist, joints, tip - 1, instrument, joints.CarrierOf(tip - 1));
            double c = Math.Cos(angle);
            double s = Math.Sin(angle);
            return new Vector3d(b.T1 - c * a.T1 - s * a.T2, b.T2 + s * a.T1 - c * a.T2,
                b.T3 - a.T3 - (instrument == 1 ? z.T3 : z.T2)).Length;
        }
    }
}
