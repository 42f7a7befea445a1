using System;
using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.Intrinsics;
#endif

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

    /// <summary><see cref="RotationVectorLaw"/> of four successive joints at once, those between elements j and j+1 to
    /// j+3 and j+4, with its formulas in its order: the same bits.</summary>
    /// <remarks>Where one of the four turns by more than its series can take, or its two stiffnesses of bending differ,
    /// nothing is done and false is returned: they are for the law itself. So are all joints where the processor has
    /// no such registers.</remarks>
    internal static class RotationVectorLanes
    {
#if NET8_0_OR_GREATER
        private const int Stride = 48;       // numbers of a RodBlock
        private const int Step = 6;          // and of a RodVector
        private const int JointStride = 6;   // and of a Joint
#endif

        /// <summary>Adds the energies to a sum, J.</summary>
        public static bool AddValue(Joint[] joints, RodShape shape, int j, ref double sum)
        {
#if NET8_0_OR_GREATER
            if (Load(joints, shape, j, out Stiffness k, out Vector3d4 theta, out Vector3d4 rest))
            {
                Vector3d4 strain = theta - rest;
                Vector256<double> bends = k.Bend * (strain.X * strain.X + strain.Y * strain.Y);
                sum = Rows4.Sum(sum, Vector256.Create(0.5) * (bends + k.Twist * strain.Z * strain.Z));
                return true;
            }
#endif
            return false;
        }

        /// <summary>Writes the turns of the joints.</summary>
        public static bool Measure(RodShape shape, Vector3d[] turns, int j)
        {
#if NET8_0_OR_GREATER
            if (Rows4.IsSupported && RotationVector4.TryLog(Relative(shape, j), out Vector3d4 theta))
            {
                theta.Store(ref turns[j + 1]);
                return true;
            }
#endif
            return false;
        }

        /// <summary>Adds the gradients of each joint along the element before it and along the element after
        /// it.</summary>
        public static bool AddGradient(Joint[] joints, RodShape shape, RodVector[] before, RodVector[] after, int j)
        {
#if NET8_0_OR_GREATER
            if (Load(joints, shape, j, out Stiffness k, out Vector3d4 theta, out Vector3d4 rest))
            {
                Vector256<double> square = theta.LengthSquared;
                Vector256<double> c = RotationVector4.CotangentFactor(square);
                Vector256<double> tb = Vector256.Create(1.0) - c * square;
                AddCouple(tb, c, theta, Couple(k, theta - rest), ref before[j], ref after[j + 1]);
                return true;
            }
#endif
            return false;
        }

        /// <summary>Adds gradients and blocks.</summary>
        /// <param name="dropsGeometricStiffness">Whether the blocks are those of joints at rest.</param>
        public static bool AddBlocks(Joint[] joints, RodShape shape, RodBlock[] blocks, RodVector[] gradient, int j,
            bool dropsGeometricStiffness)
        {
#if NET8_0_OR_GREATER
            if (!Load(joints, shape, j, out Stiffness stiffness, out Vector3d4 theta, out Vector3d4 rest))
            {
                return false;
            }
            ref RodBlock blockA = ref blocks[j];
            ref RodBlock blockB = ref blocks[j + 1];
            Vector256<double> half = Vector256.Create(0.5);
            Vector256<double> quarter = Vector256.Create(0.25);
            Vector256<double> two = Vector256.Create(2.0);
            Vector256<double> square = theta.LengthSquared;
            Vector256<double> c = RotationVector4.CotangentFactor(square);
            Vector256<double> slope = RotationVector4.CotangentSlope(square);
            Vector256<double> tb = Vector256.Create(1.0) - c * square;
            Vector3d4 m = Couple(stiffness, theta - rest);
            if (dropsGeometricStiffness)
            {
                Vector3d4 couple = m;
                m = Couple(stiffness, theta - theta);
                AddCouple(tb, c, theta, m, ref gradient[j], ref gradient[j + 1]);
                AddCouple(tb, c, theta, couple, ref gradient[j], ref gradient[j + 1]);
            }
            else
            {
                AddCouple(tb, c, theta, m, ref gradient[j], ref gradient[j + 1]);
            }
            Vector256<double> bend = stiffness.Bend;
            Vector256<double> k = stiffness.Twist - bend;
            Vector256<double> s = Vector3d4.Dot(theta, m);
            Vector3d4 w = Vector3d4.Cross(m, theta);
            Vector256<double> tt = theta.X;
            Vector256<double> tu = theta.Y;
            Vector256<double> tv = theta.Z;
            Vector256<double> cvt = c * tv * tt;
            Vector256<double> cvu = c * tv * tu;
            Vector256<double> pz = tb + c * tv * tv;
            var p = new Vector3d4(cvt - half * tu, cvu + half * tt, pz);
            var r = new Vector3d4(cvt + half * tu, cvu - half * tt, pz);

            Vector256<double> mixed = two * tb * c + c * c * square;
            Vector256<double> beta = (two * c * c + slope) * s;
            Vector256<double> sigma = bend * (tb * tb + quarter * square) + s * (c * tb - quarter);
            Vector256<double> zeta = bend * (mixed - quarter) + beta;
            Vector256<double> alpha = quarter + c * tb - two * c - slope * square;
            Vector3d4 even = zeta * theta + alpha * m;
            Vector3d4 odd = c * w;
            Triangle onB = Symmetric(sigma, theta, even + odd, k, p);
            Rows4.Add(ref blockB.C11, Stride, onB.C11, onB.C21, onB.C31, Rows4.Nothing);
            Rows4.Add(ref blockB.C22, Stride, onB.C22, onB.C32);
            Rows4.Add(ref blockB.C33, Stride, onB.C33, Rows4.Nothing);
            Triangle onA = Symmetric(sigma, theta, even - odd, k, r);
            Rows4.Add(ref blockA.C11, Stride, onA.C11, onA.C21, onA.C31, Rows4.Nothing);

            Vector256<double> sigmaMixed = bend * (tb * tb - quarter * square) + s * (quarter + c * tb);
            Vector3d4 y = (bend * (mixed + quarter) + beta) * theta - (two * c + slope * square) * m - half * odd;
            Vector3d4 z = (c * tb - quarter) * m + half * odd;
            Vector3d4 v = (half * tb) * m - (bend * tb + half * c * s) * theta;
            Vector3d4 kp = k * p;
            Vector256<double> sign = Vector256.Create(-0.0);
            Vector256<double> f11 = sigmaMixed + tt * y.X + z.X * tt + kp.X * r.X;
            Vector256<double> f21 = tu * y.X + z.Y * tt + v.Z + kp.Y * r.X;
            Vector256<double> f31 = tv * y.X + z.Z * tt - v.Y + kp.Z * r.X;
            Rows4.Add(ref blockA.F11, Stride, f11 ^ sign, f21 ^ sign, f31 ^ sign, onA.C22);
            Vector256<double> f12 = tt * y.Y + z.X * tu - v.Z + kp.X * r.Y;
            Vector256<double> f22 = sigmaMixed + tu * y.Y + z.Y * tu + kp.Y * r.Y;
            Vector256<double> f32 = tv * y.Y + z.Z * tu + v.X + kp.Z * r.Y;
            Rows4.Add(ref blockA.C32, Stride, onA.C32, Rows4.Nothing);
            Rows4.Add(ref blockA.F12, Stride, f12 ^ sign, f22 ^ sign, f32 ^ sign, onA.C33);
            Vector256<double> f13 = tt * y.Z + z.X * tv + v.Y + kp.X * r.Z;
            Vector256<double> f23 = tu * y.Z + z.Y * tv - v.X + kp.Y * r.Z;
            Vector256<double> f33 = sigmaMixed + tv * y.Z + z.Z * tv + kp.Z * r.Z;
            Rows4.Add(ref blockA.E33, Stride, Rows4.Nothing, f13 ^ sign, f23 ^ sign, f33 ^ sign);
            return true;
#else
            return false;
#endif
        }

#if NET8_0_OR_GREATER
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static bool Load(Joint[] joints, RodShape shape, int j, out Stiffness stiffness, out Vector3d4 theta,
            out Vector3d4 rest)
        {
            stiffness = default;
            theta = default;
            rest = default;
            if (!Rows4.IsSupported)
            {
                return false;
            }
            ref Joint joint = ref joints[j + 1];
            Rows4.Load(ref joint.Bend1, JointStride, out Vector256<double> bend1, out Vector256<double> bend2,
                out Vector256<double> twist, out Vector256<double> restX);
            if (!RotationVector4.TryLog(Relative(shape, j), out theta) || !Rows4.All(Vector256.Equals(bend1, bend2)))
            {
                return false;
            }
            Rows4.Load(ref Unsafe.Add(ref joint.Bend1, 4), JointStride, out Vector256<double> restY,
                out Vector256<double> restZ);
            stiffness = new Stiffness(bend1, twist);
            rest = new Vector3d4(restX, restY, restZ);
            return true;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Quaterniond4 Relative(RodShape shape, int j) =>
            Quaterniond4.Load(ref shape.Q[j]).Conjugate * Quaterniond4.Load(ref shape.Q[j + 1]);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector3d4 Couple(Stiffness k, Vector3d4 strain) =>
            new Vector3d4(k.Bend * strain.X, k.Bend * strain.Y, k.Twist * strain.Z);

        // RotationVectorLaw.AddCouple.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static void AddCouple(Vector256<double> tb, Vector256<double> c, Vector3d4 theta, Vector3d4 m,
            ref RodVector a, ref RodVector b)
        {
            Vector256<double> sign = Vector256.Create(-0.0);
            Vector256<double> cs = c * Vector3d4.Dot(theta, m);
            Vector3d4 odd = Vector256.Create(0.5) * Vector3d4.Cross(m, theta);
            Vector3d4 even = tb * m + cs * theta;
            Vector3d4 onB = even + odd;
            Vector3d4 onA = even - odd;
            Rows4.Add(ref b.X3, Step, Rows4.Nothing, onB.X, onB.Y, onB.Z);
            Rows4.Add(ref a.X3, Step, Rows4.Nothing, onA.X ^ sign, onA.Y ^ sign, onA.Z ^ sign);
        }

        // What RotationVectorLaw.AddSymmetric adds.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Triangle Symmetric(Vector256<double> sigma, Vector3d4 theta, Vector3d4 u, Vector256<double> k,
            Vector3d4 p)
        {
            Vector256<double> half = Vector256.Create(0.5);
            Triangle c;
            c.C11 = sigma + theta.X * u.X + k * p.X * p.X;
            c.C22 = sigma + theta.Y * u.Y + k * p.Y * p.Y;
            c.C33 = sigma + theta.Z * u.Z + k * p.Z * p.Z;
            c.C21 = half * (theta.X * u.Y + theta.Y * u.X) + k * p.X * p.Y;
            c.C31 = half * (theta.X * u.Z + theta.Z * u.X) + k * p.X * p.Z;
            c.C32 = half * (theta.Y * u.Z + theta.Z * u.Y) + k * p.Y * p.Z;
            return c;
        }

        // The lower triangle of C.
        private struct Triangle
        {
            public Vector256<double> C11;
            public Vector256<double> C21;
            public Vector256<double> C22;
            public Vector256<double> C31;
            public Vector256<double> C32;
            public Vector256<double> C33;
        }

        // EI/(w l) and GJ/(w l) of a joint, N m.
        private readonly struct Stiffness
        {
            public readonly Vector256<double> Bend;
            public readonly Vector256<double> Twist;

            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            public Stiffness(Vector256<double> bend, Vector256<double> twist)
            {
                Bend = bend;
                Twist = twist;
            }
        }
#endif
    }
}
