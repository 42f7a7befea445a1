using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Rotations as vectors: theta = angle times axis, q = exp(theta/2) as a quaternion, |theta| at most pi
    /// for the inverse. Small angles go by series, because the closed forms are 0/0 there.</summary>
    /// <remarks>Compiled in full at once: a short run would otherwise end before the runtime sees that they are
    /// hot.</remarks>
    internal static class RotationVector
    {
        // Below |sin(angle/2)|^2 = 0.02 eight terms of asin(s)/s are exact to 1e-16.
        public const double SmallSineSquared = 0.02;

        // Below angle^2 = 0.09 six terms of the cotangent series are exact to 1e-16.
        public const double SmallAngleSquared = 0.09;

        /// <summary>The unit quaternion that turns by <paramref name="theta"/>.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Quaterniond Exp(in Vector3d theta)
        {
            double squared = theta.LengthSquared;
            if (squared >= SmallAngleSquared)
            {
                return LargeExp(theta, squared);
            }
            // sin(a/2)/a and cos(a/2) in h = (a/2)^2.
            double h = 0.25 * squared;
            double h2 = h * h;
            double h4 = h2 * h2;
            double scale = 0.5 - h * (0.5 / 6.0) + h2 * (0.5 / 120.0 - h * (0.5 / 5040.0))
                + h4 * (0.5 / 362880.0 - h * (0.5 / 39916800.0));
            double real = 1.0 - h * (1.0 / 2.0) + h2 * (1.0 / 24.0 - h * (1.0 / 720.0))
                + h4 * (1.0 / 40320.0 - h * (1.0 / 3628800.0) + h2 * (1.0 / 479001600.0));
            return new Quaterniond(scale * theta.X, scale * theta.Y, scale * theta.Z, real);
        }

        /// <summary>The rotation vector of a unit quaternion, of length 0 to pi: q and -q are the same
        /// rotation.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d Log(in Quaterniond q)
        {
            double sineSquared = q.X * q.X + q.Y * q.Y + q.Z * q.Z;
            double scale = sineSquared < SmallSineSquared
                ? (q.W < 0.0 ? -SmallScale(sineSquared) : SmallScale(sineSquared))
                : LargeScale(sineSquared, q.W);
            return new Vector3d(scale * q.X, scale * q.Y, scale * q.Z);
        }

        /// <summary>The rotation vector of the same orientation that is nearest to another one along its own axis: more
        /// by whole turns.</summary>
        public static Vector3d Nearest(in Vector3d theta, in Vector3d other)
        {
            if (theta.LengthSquared == 0.0)
            {
                return theta;
            }
            Vector3d axis = Vector3d.Normalize(theta);
            double turns = Math.Round(Vector3d.Dot(other - theta, axis) / (2.0 * Math.PI));
            return theta + (2.0 * Math.PI * turns) * axis;
        }

        /// <summary>Gives c(a) = (1 - (a/2) cot(a/2))/a^2, for the inverse tangent map T = 1 + [theta]/2 + c
        /// [theta]^2.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double CotangentFactor(double angleSquared)
        {
            double a = angleSquared;
            if (a >= SmallAngleSquared)
            {
                return LargeCotangentFactor(a);
            }
            double a2 = a * a;
            return 1.0 / 12.0 + a * (1.0 / 720.0) + a2 * (1.0 / 30240.0 + a * (1.0 / 1209600.0))
                + a2 * a2 * (1.0 / 47900160.0 + a * (691.0 / 1307674368000.0));
        }

        /// <summary>Gives c'(a)/a, the derivative of <see cref="CotangentFactor"/> by the angle over the
        /// angle.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double CotangentSlope(double angleSquared, double cotangentFactor)
        {
            double a = angleSquared;
            if (a >= SmallAngleSquared)
            {
                return LargeCotangentSlope(a, cotangentFactor);
            }
            double a2 = a * a;
            return 1.0 / 360.0 + a * (1.0 / 7560.0) + a2 * (1.0 / 201600.0 + a * (1.0 / 5987520.0))
                + a2 * a2 * (691.0 / 130767436800.0 + a * (1.0 / 6227020800.0));
        }

        /// <summary>Gives J(phi) u, the body's turn that belongs to the change u of the rotation vector phi:
        /// J = 1 - (1 - cos a)/a^2 [phi] + (a - sin a)/a^3 [phi]^2.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d TangentMap(in Vector3d phi, in Vector3d u)
        {
            double a = phi.LengthSquared;
            double first;
            double second;
            if (a < SmallAngleSquared)
            {
                double a2 = a * a;
                double a4 = a2 * a2;
                first = 1.0 / 2.0 - a * (1.0 / 24.0) + a2 * (1.0 / 720.0 - a * (1.0 / 40320.0))
                    + a4 * (1.0 / 3628800.0 - a * (1.0 / 479001600.0));
                second = 1.0 / 6.0 - a * (1.0 / 120.0) + a2 * (1.0 / 5040.0 - a * (1.0 / 362880.0))
                    + a4 * (1.0 / 39916800.0 - a * (1.0 / 6227020800.0));
            }
            else
            {
                LargeTangent(a, out first, out second);
            }
            Vector3d cross = Vector3d.Cross(phi, u);
            return u - first * cross + second * Vector3d.Cross(phi, cross);
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static Quaterniond LargeExp(in Vector3d theta, double squared)
        {
            double angle = Math.Sqrt(squared);
            double scale = Math.Sin(0.5 * angle) / angle;
            return new Quaterniond(scale * theta.X, scale * theta.Y, scale * theta.Z, Math.Cos(0.5 * angle));
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static void LargeTangent(double squared, out double first, out double second)
        {
            double angle = Math.Sqrt(squared);
            first = (1.0 - Math.Cos(angle)) / squared;
            second = (angle - Math.Sin(angle)) / (squared * angle);
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static double SmallScale(double s)
        {
            double s2 = s * s;
            double s4 = s2 * s2;
            return 2.0 + s * (2.0 / 6.0) + s2 * (6.0 / 40.0 + s * (10.0 / 112.0))
                + s4 * (70.0 / 1152.0 + s * (126.0 / 2816.0) + s2 * (462.0 / 13312.0 + s * (286.0 / 10240.0))
                + s4 * (12870.0 / 557056.0));
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static double LargeScale(double sineSquared, double real)
        {
            double sine = Math.Sqrt(sineSquared);
            return real < 0.0 ? -2.0 * Math.Atan2(sine, -real) / sine : 2.0 * Math.Atan2(sine, real) / sine;
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static double LargeCotangentFactor(double a)
        {
            double half = 0.5 * Math.Sqrt(a);
            return (1.0 - half / Math.Tan(half)) / a;
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static double LargeCotangentSlope(double a, double cotangentFactor)
        {
            double half = 0.5 * Math.Sqrt(a);
            double sine = Math.Sin(half);
            double slope = 0.5 * (Math.Cos(half) / sine - half / (sine * sine));
            return -slope / (2.0 * half * a) - 2.0 * cotangentFactor / a;
        }
    }
}
