#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace Guidewire.Core
{
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
}
#endif
