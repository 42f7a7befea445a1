using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>A joint of coaxial instruments in a shape: its energy's derivatives.</summary>
    internal struct CoaxialJointState
    {
        public Quaterniond Relative;
        public Vector3d Turn;           // phi
        public Joint Joint;             // as it is at its angles
        public double FrameBefore;      // angle before the joint of the instrument whose frame it is, where it differs
        public double Held;             // energy that does not go with phi, J
        public CoaxialPartState First;  // of the others
        public CoaxialPartState Second;
        public double MixedSecond;      // d2E/(dt dt') of both, J
        public FibreJoint Fibres;       // the correction by their fibres

        /// <summary>Sets all from the relative turn and the angles of both parts.</summary>
        /// <param name="hasSecond">Whether there are three instruments.</param>
        public void Set(in CoaxialJoint joint, in RotationVectorLaw law, bool hasSecond)
        {
            var rest = new Vector3d(joint.FixedX, joint.FixedY, 0.0);
            double t = First.Mean(joint.First);
            double u = hasSecond ? Second.Mean(joint.Second) : 0.0;
            joint.First.AddRest(t, ref rest, out Vector3d slope, out Vector3d turned);
            Vector3d secondSlope = default;
            Vector3d secondTurned = default;
            if (hasSecond)
            {
                joint.Second.AddRest(u, ref rest, out secondSlope, out secondTurned);
            }
            Held = joint.HeldAt(t, u, out AngleHessian hessian, out First.Slope, out Second.Slope);
            Joint.Bend1 = 1.0 / joint.Compliance1;
            Joint.Bend2 = 1.0 / joint.Compliance2;
            Turn = law.Measure(Relative);
            double moment1 = Joint.Bend1 * (Turn.X - rest.X);
            double moment2 = Joint.Bend2 * (Turn.Y - rest.Y);
            Joint.Twist = joint.Twist;
            double restTwist = joint.RestTwist;
            First.Second = hessian.First;
            Set(ref First, joint.First, slope, turned, moment1, moment2, ref restTwist);
            if (hasSecond)
            {
                Second.Second = hessian.Second;
                Set(ref Second, joint.Second, secondSlope, secondTurned, moment1, moment2, ref restTwist);
                MixedSecond = hessian.Mixed + Joint.Bend1 * slope.X * secondSlope.X
                    + Joint.Bend2 * slope.Y * secondSlope.Y;
            }
            Joint.Rest = new Vector3d(rest.X, rest.Y, restTwist);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private void Set(ref CoaxialPartState part, in CoaxialPart joint, in Vector3d slope, in Vector3d turned,
            double moment1, double moment2, ref double restTwist)
        {
            part.Mixed = new Vector3d(-Joint.Bend1 * slope.X, -Joint.Bend2 * slope.Y, 0.0);
            part.Slope -= moment1 * slope.X + moment2 * slope.Y;
            part.Second += Joint.Bend1 * slope.X * slope.X + Joint.Bend2 * slope.Y * slope.Y
                + moment1 * turned.X + moment2 * turned.Y;
            if (joint.Twist > 0.0)
            {
                // Springs about one axis: one about their mean, and the energy of their difference.
                double inner = joint.RestTwist - (part.After - part.Before);
                double before = Joint.Twist;
                Joint.Twist += joint.Twist;
                double fraction = joint.Twist / Joint.Twist;
                double apart = inner - restTwist;
                restTwist += fraction * apart;
                Held += 0.5 * before * fraction * apart * apart;
                part.Couple = joint.Twist * (Turn.Z - inner);
            }
        }
    }
}
