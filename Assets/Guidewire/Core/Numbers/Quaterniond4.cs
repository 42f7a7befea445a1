#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
#endif

namespace Guidewire.Core
{
#if NET8_0_OR_GREATER
    /// <summary>Four quaternions, one a lane, with the operations of <see cref="Quaterniond"/> in the same order: each
    /// lane holds the bits which plain doubles give.</summary>
    internal readonly struct Quaterniond4
    {
        /// <summary>The first imaginary components.</summary>
        public readonly Vector256<double> X;

        /// <summary>The second imaginary components.</summary>
        public readonly Vector256<double> Y;

        /// <summary>The third imaginary components.</summary>
        public readonly Vector256<double> Z;

        /// <summary>The real components.</summary>
        public readonly Vector256<double> W;

        /// <summary>Makes the quaternions x i + y j + z k + w.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Quaterniond4(Vector256<double> x, Vector256<double> y, Vector256<double> z, Vector256<double> w)
        {
            X = x;
            Y = y;
            Z = z;
            W = w;
        }

        /// <summary>Gives the conjugates q*.</summary>
        public Quaterniond4 Conjugate
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get
            {
                Vector256<double> sign = Vector256.Create(-0.0);
                return new Quaterniond4(X ^ sign, Y ^ sign, Z ^ sign, W);
            }
        }

        /// <summary>(x, y, z), the imaginary parts.</summary>
        public Vector3d4 Imaginary
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d4(X, Y, Z);
        }

        /// <summary>Gives the first directors.</summary>
        public Vector3d4 Director1
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d4(One - Two * (Y * Y + Z * Z), Two * (X * Y + W * Z), Two * (X * Z - W * Y));
        }

        /// <summary>Gives the second directors.</summary>
        public Vector3d4 Director2
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d4(Two * (X * Y - W * Z), One - Two * (X * X + Z * Z), Two * (Y * Z + W * X));
        }

        /// <summary>Gives the third directors.</summary>
        public Vector3d4 Director3
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d4(Two * (X * Z + W * Y), Two * (Y * Z - W * X), One - Two * (X * X + Y * Y));
        }

        private static Vector256<double> One => Vector256.Create(1.0);

        private static Vector256<double> Two => Vector256.Create(2.0);

        /// <summary>Takes Hamilton's product.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Quaterniond4 operator *(Quaterniond4 a, Quaterniond4 b)
        {
            return new Quaterniond4(
                a.W * b.X + a.X * b.W + a.Y * b.Z - a.Z * b.Y,
                a.W * b.Y - a.X * b.Z + a.Y * b.W + a.Z * b.X,
                a.W * b.Z + a.X * b.Y - a.Y * b.X + a.Z * b.W,
                a.W * b.W - a.X * b.X - a.Y * b.Y - a.Z * b.Z);
        }

        /// <summary>Rotates vectors: q v q*.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d4 Rotate(Quaterniond4 q, Vector3d4 v)
        {
            Vector3d4 u = q.Imaginary;
            Vector3d4 t = Two * Vector3d4.Cross(u, v);
            return v + q.W * t + Vector3d4.Cross(u, t);
        }

        /// <summary>Gives q / |q|.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Quaterniond4 Normalize(Quaterniond4 q)
        {
            Vector256<double> square = q.X * q.X + q.Y * q.Y + q.Z * q.Z + q.W * q.W;
            Vector256<double> s = Vector256.Create(1.0) / Vector256.Sqrt(square);
            return new Quaterniond4(s * q.X, s * q.Y, s * q.Z, s * q.W);
        }

        /// <summary>(1.5 - 0.5 |q|^2) q, which is of unit length where |q| is nearly 1.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Quaterniond4 NearlyNormalized(Quaterniond4 q)
        {
            Vector256<double> square = q.X * q.X + q.Y * q.Y + q.Z * q.Z + q.W * q.W;
            Vector256<double> s = Vector256.Create(1.5) - Vector256.Create(0.5) * square;
            return new Quaterniond4(s * q.X, s * q.Y, s * q.Z, s * q.W);
        }

        /// <summary>Gives four successive quaternions in memory.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Quaterniond4 Load(ref Quaterniond first)
        {
            Rows4.Load(ref Unsafe.As<Quaterniond, double>(ref first), 4, out Vector256<double> x,
                out Vector256<double> y, out Vector256<double> z, out Vector256<double> w);
            return new Quaterniond4(x, y, z, w);
        }

        /// <summary>Writes the quaternions to successive positions in memory.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void Store(ref Quaterniond first) =>
            Rows4.Store(ref Unsafe.As<Quaterniond, double>(ref first), 4, X, Y, Z, W);
    }
#endif

#if NET8_0_OR_GREATER
    /// <summary><see cref="RotationVector"/> in four lanes, where all of them are small enough for its series: the same
    /// bits.</summary>
    internal static class RotationVector4
    {
        /// <summary>exp(theta/2) of rotation vectors; false where one is too large for the series.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static bool TryExp(Vector3d4 theta, out Quaterniond4 q)
        {
            Vector256<double> squared = theta.LengthSquared;
            Vector256<double> h = Of(0.25) * squared;
            Vector256<double> h2 = h * h;
            Vector256<double> h4 = h2 * h2;
            Vector256<double> scale = Of(0.5) - h * Of(0.5 / 6.0) + h2 * (Of(0.5 / 120.0) - h * Of(0.5 / 5040.0))
                + h4 * (Of(0.5 / 362880.0) - h * Of(0.5 / 39916800.0));
            Vector256<double> real = Of(1.0) - h * Of(1.0 / 2.0) + h2 * (Of(1.0 / 24.0) - h * Of(1.0 / 720.0))
                + h4 * (Of(1.0 / 40320.0) - h * Of(1.0 / 3628800.0) + h2 * Of(1.0 / 479001600.0));
            q = new Quaterniond4(scale * theta.X, scale * theta.Y, scale * theta.Z, real);
            return Vector256.LessThanAll(squared, Of(RotationVector.SmallAngleSquared));
        }

        /// <summary>Rotation vectors of unit quaternions; false where one is too large for the series, or its real part
        /// is negative.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static bool TryLog(Quaterniond4 q, out Vector3d4 theta)
        {
            Vector256<double> s = q.X * q.X + q.Y * q.Y + q.Z * q.Z;
            Vector256<double> s2 = s * s;
            Vector256<double> s4 = s2 * s2;
            Vector256<double> scale = Of(2.0) + s * Of(2.0 / 6.0) + s2 * (Of(6.0 / 40.0) + s * Of(10.0 / 112.0))
                + s4 * (Of(70.0 / 1152.0) + s * Of(126.0 / 2816.0)
                + s2 * (Of(462.0 / 13312.0) + s * Of(286.0 / 10240.0)) + s4 * Of(12870.0 / 557056.0));
            theta = new Vector3d4(scale * q.X, scale * q.Y, scale * q.Z);
            return Vector256.GreaterThanOrEqualAll(q.W, Vector256<double>.Zero)
                && Vector256.LessThanAll(s, Of(RotationVector.SmallSineSquared));
        }

        /// <summary>The cotangent factor of small angles.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector256<double> CotangentFactor(Vector256<double> a)
        {
            Vector256<double> a2 = a * a;
            return Of(1.0 / 12.0) + a * Of(1.0 / 720.0) + a2 * (Of(1.0 / 30240.0) + a * Of(1.0 / 1209600.0))
                + a2 * a2 * (Of(1.0 / 47900160.0) + a * Of(691.0 / 1307674368000.0));
        }

        /// <summary>Gives its slope over the angle.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector256<double> CotangentSlope(Vector256<double> a)
        {
            Vector256<double> a2 = a * a;
            return Of(1.0 / 360.0) + a * Of(1.0 / 7560.0) + a2 * (Of(1.0 / 201600.0) + a * Of(1.0 / 5987520.0))
                + a2 * a2 * (Of(691.0 / 130767436800.0) + a * Of(1.0 / 6227020800.0));
        }

        /// <summary>Gives J(phi) u of small phi.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d4 TangentMap(Vector3d4 phi, Vector3d4 u)
        {
            Vector256<double> a = phi.LengthSquared;
            Vector256<double> a2 = a * a;
            Vector256<double> a4 = a2 * a2;
            Vector256<double> first = Of(1.0 / 2.0) - a * Of(1.0 / 24.0)
                + a2 * (Of(1.0 / 720.0) - a * Of(1.0 / 40320.0))
                + a4 * (Of(1.0 / 3628800.0) - a * Of(1.0 / 479001600.0));
            Vector256<double> second = Of(1.0 / 6.0) - a * Of(1.0 / 120.0)
                + a2 * (Of(1.0 / 5040.0) - a * Of(1.0 / 362880.0))
                + a4 * (Of(1.0 / 39916800.0) - a * Of(1.0 / 6227020800.0));
            Vector3d4 cross = Vector3d4.Cross(phi, u);
            return u - first * cross + second * Vector3d4.Cross(phi, cross);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<double> Of(double value) => Vector256.Create(value);
    }
#endif
}
