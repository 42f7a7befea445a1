#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace Guidewire.Core
{
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
}
#endif
