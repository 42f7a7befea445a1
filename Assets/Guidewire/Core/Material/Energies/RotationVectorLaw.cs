using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Couple = K (theta - theta0) with theta the rotation vector of conj(q_a) q_b: linear in the angle up to
    /// pi, so that a ring of equal elements closes exactly.</summary>
    /// <remarks>With T = b 1 + c theta theta^T + [theta]/2, b = 1 - c a, a = |theta|^2 and c(a) the cotangent factor,
    /// dtheta = T delta_b - T^T delta_a. The second derivatives are T^T K T and its like, plus the change of T under
    /// the couple m = K (theta - theta0). Multiplied out with s = theta . m and w = m x theta,
    ///   C_b = sigma 1 + sym(theta (zeta theta + alpha m + c w)^T) + k p p^T,      p = T^T e3, r = T e3,
    ///   C_a = sigma 1 + sym(theta (zeta theta + alpha m - c w)^T) + k r r^T,      k = twist - bend stiffness,
    ///   F  = -(sigma' 1 + theta y^T + z theta^T + [v] + k p r^T),
    /// with the coefficients named below;
    /// another stiffness about d2 adds its own p p^T. The tests take them from differences of the energy.</remarks>
    internal readonly struct RotationVectorLaw : IJointLaw
    {
        /// <inheritdoc/>
        public Vector3d Measure(in Quaterniond relative) => RotationVector.Log(relative);

        /// <inheritdoc/>
        /// <remarks>T after - T^T before.</remarks>
        public Vector3d Rate(in Quaterniond relative, in Vector3d before, in Vector3d after)
        {
            Vector3d theta = RotationVector.Log(relative);
            double square = theta.LengthSquared;
            double c = RotationVector.CotangentFactor(square);
            Vector3d change = after - before;
            return (1.0 - c * square) * change + (c * Vector3d.Dot(theta, change)) * theta
                + 0.5 * Vector3d.Cross(theta, before + after);
        }

        /// <inheritdoc/>
        public Quaterniond AtRest(in Joint joint) => RotationVector.Exp(joint.Rest);

        /// <inheritdoc/>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public double Value(in Joint joint, in Quaterniond relative)
        {
            Vector3d strain = RotationVector.Log(relative) - joint.Rest;
            return 0.5 * (joint.Bend1 * (strain.X * strain.X + strain.Y * strain.Y) + joint.Twist * strain.Z * strain.Z
                + (joint.Bend2 - joint.Bend1) * strain.Y * strain.Y);
        }

        /// <inheritdoc/>
        public void AddGradient(in Joint joint, in Quaterniond relative, ref RodVector a, ref RodVector b)
        {
            Vector3d theta = RotationVector.Log(relative);
            Vector3d strain = theta - joint.Rest;
            Vector3d m = new Vector3d(joint.Bend1 * strain.X, joint.Bend2 * strain.Y, joint.Twist * strain.Z);
            AddGradient(theta, m, ref a, ref b);
        }

        /// <summary>Adds the couples of a joint with the turn theta and the couple m.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static void AddGradient(in Vector3d theta, in Vector3d m, ref RodVector a, ref RodVector b)
        {
            double square = theta.LengthSquared;
            double c = RotationVector.CotangentFactor(square);
            AddCouple(1.0 - c * square, c * Vector3d.Dot(theta, m), theta, m, Vector3d.Cross(m, theta), ref a, ref b);
        }

        /// <summary>Adds second derivatives of a joint with the turn theta, the couple m, and a stiffness about d1 and
        /// d2 with the coefficients s.</summary>
        public static void AddBlocks(in Vector3d theta, in Vector3d m, double s11, double s12, double s22,
            ref RodBlock blockA, ref RodBlock blockB)
        {
            double square = theta.LengthSquared;
            double c = RotationVector.CotangentFactor(square);
            double tb = 1.0 - c * square;
            if (m != Vector3d.Zero)
            {
                AddBlocks(0.0, 0.0, theta, m, tb, c, ref blockA, ref blockB);
            }
            double mean = 0.5 * (s11 + s22);
            double half = 0.5 * (s11 - s22);
            double apart = Math.Sqrt(half * half + s12 * s12);
            if (mean != 0.0 || apart != 0.0)
            {
                double angle = 0.5 * Math.Atan2(s12, half);
                var first = new Vector3d(Math.Cos(angle), Math.Sin(angle), 0.0);
                AddAlong(mean + apart, first, theta, tb, c, ref blockA, ref blockB);
                AddAlong(mean - apart, new Vector3d(-first.Y, first.X, 0.0), theta, tb, c, ref blockA, ref blockB);
            }
        }

        /// <inheritdoc/>
        public void AddBlocks(in Joint joint, in Quaterniond relative, ref RodVector a, ref RodVector b,
            ref RodBlock blockA, ref RodBlock blockB)
        {
            Vector3d theta = RotationVector.Log(relative);
            Vector3d strain = theta - joint.Rest;
            double bend = joint.Bend1;
            double k = joint.Twist - bend;
            Vector3d m = new Vector3d(bend * strain.X, joint.Bend2 * strain.Y, joint.Twist * strain.Z);
            double square = theta.LengthSquared;
            double c = RotationVector.CotangentFactor(square);
            double tb = 1.0 - c * square;
            AddCouple(tb, c * Vector3d.Dot(theta, m), theta, m, Vector3d.Cross(m, theta), ref a, ref b);
            AddBlocks(bend, k, theta, m, tb, c, ref blockA, ref blockB);
            if (joint.Bend2 != bend)
            {
                AddAlong(joint.Bend2 - bend, Vector3d.UnitY, theta, tb, c, ref blockA, ref blockB);
            }
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static void AddBlocks(double bend, double k, Vector3d theta, Vector3d m, double tb, double c,
            ref RodBlock blockA, ref RodBlock blockB)
        {
            double square = theta.LengthSquared;
            double slope = RotationVector.CotangentSlope(square, c);
            double s = Vector3d.Dot(theta, m);
            Vector3d w = Vector3d.Cross(m, theta);
            double tt = theta.X;
            double tu = theta.Y;
            double tv = theta.Z;
            Vector3d p = new Vector3d(c * tv * tt - 0.5 * tu, c * tv * tu + 0.5 * tt, tb + c * tv * tv);
            Vector3d r = new Vector3d(c * tv * tt + 0.5 * tu, c * tv * tu - 0.5 * tt, tb + c * tv * tv);

            double mixed = 2.0 * tb * c + c * c * square;
            double beta = (2.0 * c * c + slope) * s;
            double sigma = bend * (tb * tb + 0.25 * square) + s * (c * tb - 0.25);
            double zeta = bend * (mixed - 0.25) + beta;
            double alpha = 0.25 + c * tb - 2.0 * c - slope * square;
            Vector3d even = zeta * theta + alpha * m;
            Vector3d odd = c * w;
            AddSymmetric(ref blockB, sigma, theta, even + odd, k, p);
            AddSymmetric(ref blockA, sigma, theta, even - odd, k, r);

            double sigmaMixed = bend * (tb * tb - 0.25 * square) + s * (0.25 + c * tb);
            Vector3d y = (bend * (mixed + 0.25) + beta) * theta - (2.0 * c + slope * square) * m - 0.5 * odd;
            Vector3d z = (c * tb - 0.25) * m + 0.5 * odd;
            Vector3d v = (0.5 * tb) * m - (bend * tb + 0.5 * c * s) * theta;
            double k1 = k * p.X;
            double k2 = k * p.Y;
            double k3 = k * p.Z;
            blockA.F11 -= sigmaMixed + tt * y.X + z.X * tt + k1 * r.X;
            blockA.F12 -= tt * y.Y + z.X * tu - v.Z + k1 * r.Y;
            blockA.F13 -= tt * y.Z + z.X * tv + v.Y + k1 * r.Z;
            blockA.F21 -= tu * y.X + z.Y * tt + v.Z + k2 * r.X;
            blockA.F22 -= sigmaMixed + tu * y.Y + z.Y * tu + k2 * r.Y;
            blockA.F23 -= tu * y.Z + z.Y * tv - v.X + k2 * r.Z;
            blockA.F31 -= tv * y.X + z.Z * tt - v.Y + k3 * r.X;
            blockA.F32 -= tv * y.Y + z.Z * tu + v.X + k3 * r.Y;
            blockA.F33 -= sigmaMixed + tv * y.Z + z.Z * tv + k3 * r.Z;
        }

        /// <summary>What a stiffness d about an axis e across the wire adds: d p p^T to C_b, d r r^T to C_a and -d p
        /// r^T to F with p = T^T e and r = T e. Theta by value: a reference would exclude it of registers in an even
        /// wire too.</summary>
        private static void AddAlong(double difference, Vector3d e, Vector3d theta, double tb, double c,
            ref RodBlock blockA, ref RodBlock blockB)
        {
            double along = c * Vector3d.Dot(theta, e);
            Vector3d across = 0.5 * Vector3d.Cross(theta, e);
            Vector3d p = tb * e + along * theta - across;
            Vector3d r = tb * e + along * theta + across;
            AddSymmetric(ref blockB, 0.0, theta, Vector3d.Zero, difference, p);
            AddSymmetric(ref blockA, 0.0, theta, Vector3d.Zero, difference, r);
            Vector3d d = difference * p;
            blockA.F11 -= d.X * r.X;
            blockA.F12 -= d.X * r.Y;
            blockA.F13 -= d.X * r.Z;
            blockA.F21 -= d.Y * r.X;
            blockA.F22 -= d.Y * r.Y;
            blockA.F23 -= d.Y * r.Z;
            blockA.F31 -= d.Z * r.X;
            blockA.F32 -= d.Z * r.Y;
            blockA.F33 -= d.Z * r.Z;
        }

        /// <summary>Adds T^T m on b and -T m on a.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static void AddCouple(double tb, double cs, in Vector3d theta, in Vector3d m, in Vector3d w,
            ref RodVector a, ref RodVector b)
        {
            Vector3d even = tb * m + cs * theta;
            b.T1 += even.X + 0.5 * w.X;
            b.T2 += even.Y + 0.5 * w.Y;
            b.T3 += even.Z + 0.5 * w.Z;
            a.T1 -= even.X - 0.5 * w.X;
            a.T2 -= even.Y - 0.5 * w.Y;
            a.T3 -= even.Z - 0.5 * w.Z;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static void AddSymmetric(ref RodBlock block, double sigma, in Vector3d theta, in Vector3d u, double k,
            in Vector3d p)
        {
            block.C11 += sigma + theta.X * u.X + k * p.X * p.X;
            block.C22 += sigma + theta.Y * u.Y + k * p.Y * p.Y;
            block.C33 += sigma + theta.Z * u.Z + k * p.Z * p.Z;
            block.C21 += 0.5 * (theta.X * u.Y + theta.Y * u.X) + k * p.X * p.Y;
            block.C31 += 0.5 * (theta.X * u.Z + theta.Z * u.X) + k * p.X * p.Z;
            block.C32 += 0.5 * (theta.Y * u.Z + theta.Z * u.Y) + k * p.Y * p.Z;
        }
    }
}
