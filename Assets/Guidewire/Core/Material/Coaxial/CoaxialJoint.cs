using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>A joint of up to three instruments: its pieces in series. With phi its rotation vector, t the mean
    /// twist angle of another instrument than the one on whose frame the joint stands, at the pieces where it is, delta
    /// the difference of its angles,
    ///   E = 1/2 sum_i (phi_i - f_i)^2/A_i + e - sum (C cos t + S sin t) - C'' cos u - S'' sin u
    ///       + 1/2 K (phi_3 - r)^2 + sum 1/2 K' (phi_3 + delta - r')^2,    f = F + sum R(t) F',
    /// u the second angle less the first.</summary>
    /// <remarks>A_i = sum lambda/B, lambda the integral of the joint's hat function over a piece, B the sum of the
    /// bending stiffnesses of the instruments there; F and F' are the sums of lambda B_i kappa_i/B; and each two
    /// instruments of different curvature hold the energy 1/2 lambda B_i B_k/B |kappa_i - R kappa_k|^2 however they are
    /// bent, R from one's frame to the other's (Rucker, Jones and Webster 2010, equations 8 and 9, as an energy). The
    /// frame is that of the outermost instrument after the joint: at the tip of one, that one is another.</remarks>
    internal struct CoaxialJoint
    {
        public double Compliance1;   // A_1, 1/(N m)
        public double Compliance2;
        public double FixedX, FixedY;     // F, rad
        public double Held;          // e, J
        public double Twist;         // K, N m: of the instrument whose frame it is
        public double RestTwist;     // r, rad
        public CoaxialPart First;    // of the others the outer one
        public CoaxialPart Second;   // and the inner one
        public double PairCosine;    // C'', J
        public double PairSine;      // S''
        public double Axial;         // compliance along the axis of the element after it, m/N: of all, held together
        public double Shear;         // and across it: GA of all that are there adds

        /// <summary>As that of an instrument alone.</summary>
        public readonly Joint Alone => new Joint
        {
            Bend1 = 1.0 / Compliance1,
            Bend2 = 1.0 / Compliance2,
            Twist = Twist,
            Rest = new Vector3d(FixedX, FixedY, RestTwist),
        };

        /// <summary>Adds a piece of one instrument.</summary>
        /// <param name="lambda">m.</param>
        public void AddAlone(double lambda, in CrossSection piece)
        {
            Compliance1 += lambda / piece.BendStiffness1;
            Compliance2 += lambda / piece.BendStiffness2;
            FixedX += lambda * piece.RestCurvature.X;
            FixedY += lambda * piece.RestCurvature.Y;
        }

        /// <summary>Adds a piece of two instruments.</summary>
        /// <param name="joint">To which.</param>
        /// <param name="part">Of the joint: the one on whose frame it does not stand.</param>
        /// <param name="isInner">Whether it stands on the inner one's.</param>
        public static void AddShared(ref CoaxialJoint joint, ref CoaxialPart part, double lambda,
            in CrossSection outer, in CrossSection inner, bool isInner)
        {
            double sum = outer.BendStiffness1 + inner.BendStiffness1;
            double reduced = lambda * outer.BendStiffness1 * inner.BendStiffness1 / sum;
            joint.Compliance1 += lambda / sum;
            joint.Compliance2 += lambda / sum;
            AddPair(reduced, isInner ? -1.0 : 1.0, outer, inner, ref joint.Held, ref part.FrameCosine,
                ref part.FrameSine);
            double fraction = lambda * outer.BendStiffness1 / sum;
            Vector3d own = fraction * outer.RestCurvature;
            Vector3d other = (lambda - fraction) * inner.RestCurvature;
            joint.FixedX += isInner ? other.X : own.X;
            joint.FixedY += isInner ? other.Y : own.Y;
            part.RestX += isInner ? own.X : other.X;
            part.RestY += isInner ? own.Y : other.Y;
        }

        /// <summary>Adds a piece of all three.</summary>
        /// <param name="frame">The instrument on whose frame the joint stands.</param>
        /// <param name="first">The outer one of the others.</param>
        /// <param name="second">The inner one.</param>
        public void AddThree(double lambda, in CrossSection frame, in CrossSection first, in CrossSection second)
        {
            double sum = frame.BendStiffness1 + first.BendStiffness1 + second.BendStiffness1;
            double perSum = lambda / sum;
            Compliance1 += perSum;
            Compliance2 += perSum;
            Vector3d own = perSum * frame.BendStiffness1 * frame.RestCurvature;
            FixedX += own.X;
            FixedY += own.Y;
            AddTurned(ref First, perSum, frame, first, ref Held);
            AddTurned(ref Second, perSum, frame, second, ref Held);
            double reduced = perSum * first.BendStiffness1 * second.BendStiffness1;
            AddPair(reduced, 1.0, first, second, ref Held, ref PairCosine, ref PairSine);
        }

        /// <summary>Adds a piece in a sheath: it is straight, whatever it is made of.</summary>
        /// <param name="lambda">m.</param>
        /// <param name="bend">B, of all that is there, N m^2.</param>
        /// <param name="held">Energy that keeps it straight, J/m.</param>
        public void AddSheathed(double lambda, double bend, double held)
        {
            Compliance1 += SheathEnd.RetainedBend * lambda / bend;
            Compliance2 += SheathEnd.RetainedBend * lambda / bend;
            Held += lambda * held;
        }

        /// <summary>Energy that does not depend on the joint's rotation, J, and its derivatives by the two
        /// angles.</summary>
        public readonly double HeldAt(double first, double second, out AngleHessian hessian, out double firstSlope,
            out double secondSlope)
        {
            hessian.First = First.Held(first, out firstSlope);
            hessian.Second = Second.Held(second, out secondSlope);
            hessian.Mixed = 0.0;
            double held = Held - hessian.First - hessian.Second;
            if (PairCosine != 0.0 || PairSine != 0.0)
            {
                double pair = Wave(PairCosine, PairSine, second - first, out double slope);
                firstSlope -= slope;
                secondSlope += slope;
                hessian.First += pair;
                hessian.Second += pair;
                hessian.Mixed = -pair;
                held -= pair;
            }
            return held;
        }

        /// <summary>Of a joint whose sums are derivatives: that of the energy of bending, J over their unit.</summary>
        /// <param name="moment1">Of the joint itself about d1, N m.</param>
        /// <param name="rest">The derivative of f.</param>
        /// <param name="held">That of what does not go with phi.</param>
        public readonly double BendingRate(double moment1, double moment2, in Vector3d rest, double held)
        {
            return held - moment1 * (0.5 * moment1 * Compliance1 + rest.X)
                - moment2 * (0.5 * moment2 * Compliance2 + rest.Y);
        }

        /// <summary>C cos t + S sin t, and minus its derivative.</summary>
        public static double Wave(double cosine, double sine, double t, out double slope)
        {
            double c = Math.Cos(t);
            double s = Math.Sin(t);
            slope = cosine * s - sine * c;
            return cosine * c + sine * s;
        }

        private static void AddTurned(ref CoaxialPart part, double perSum, in CrossSection frame,
            in CrossSection other, ref double held)
        {
            double reduced = perSum * frame.BendStiffness1 * other.BendStiffness1;
            AddPair(reduced, 1.0, frame, other, ref held, ref part.FrameCosine, ref part.FrameSine);
            Vector3d turned = perSum * other.BendStiffness1 * other.RestCurvature;
            part.RestX += turned.X;
            part.RestY += turned.Y;
        }

        // What two instruments of different curvature hold; sense: 1 where the angle is counted from the first, or -1.
        private static void AddPair(double reduced, double sense, in CrossSection one, in CrossSection other,
            ref double held, ref double cosine, ref double sine)
        {
            Vector3d a = one.RestCurvature;
            Vector3d b = other.RestCurvature;
            held += 0.5 * reduced * (a.X * a.X + a.Y * a.Y + b.X * b.X + b.Y * b.Y);
            cosine += reduced * (a.X * b.X + a.Y * b.Y);
            sine += sense * (reduced * (a.Y * b.X - a.X * b.Y));
        }
    }

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

    /// <summary>Derivatives of a joint's energy for one instrument with an angle of its own
    /// (<see cref="CoaxialPart"/>).</summary>
    internal struct CoaxialPartState
    {
        public double Before;     // its angle before the joint, from the joint's frame
        public double After;
        public double Slope;      // dE/dt
        public double Second;     // d2E/dt2
        public double Couple;     // dE/ddelta
        public Vector3d Mixed;    // d2E/(dphi dt)

        /// <summary>Gives the mean angle t.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly double Mean(in CoaxialPart part) => (1.0 - part.Weight) * Before + part.Weight * After;
    }
}
