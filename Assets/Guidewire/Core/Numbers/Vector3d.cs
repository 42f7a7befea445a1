using System;
using System.Globalization;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>A point or a direction in space, three doubles. Unity's Vector3 is float, which at positions of
    /// 300 units and steps of 1e-4 s leaves no digits for the velocity.</summary>
    public readonly struct Vector3d : IEquatable<Vector3d>
    {
        /// <summary>Component along the x axis.</summary>
        public readonly double X;

        /// <summary>Component along the y axis.</summary>
        public readonly double Y;

        /// <summary>Component along the z axis, along which a wire lies at the start.</summary>
        public readonly double Z;

        /// <summary>Makes the vector (x, y, z).</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector3d(double x, double y, double z)
        {
            X = x;
            Y = y;
            Z = z;
        }

        /// <summary>(0, 0, 0).</summary>
        public static Vector3d Zero => default;

        /// <summary>(1, 0, 0).</summary>
        public static Vector3d UnitX
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d(1.0, 0.0, 0.0);
        }

        /// <summary>(0, 1, 0).</summary>
        public static Vector3d UnitY
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d(0.0, 1.0, 0.0);
        }

        /// <summary>(0, 0, 1).</summary>
        public static Vector3d UnitZ
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d(0.0, 0.0, 1.0);
        }

        /// <summary>Gives |v|^2.</summary>
        public double LengthSquared
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => X * X + Y * Y + Z * Z;
        }

        /// <summary>Gives the length |v|.</summary>
        public double Length
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => Math.Sqrt(X * X + Y * Y + Z * Z);
        }

        /// <summary>True when no component is infinite or not a number.</summary>
        public bool IsFinite => IsFiniteNumber(X) && IsFiniteNumber(Y) && IsFiniteNumber(Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d operator +(in Vector3d a, in Vector3d b) =>
            new Vector3d(a.X + b.X, a.Y + b.Y, a.Z + b.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d operator -(in Vector3d a, in Vector3d b) =>
            new Vector3d(a.X - b.X, a.Y - b.Y, a.Z - b.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d operator -(in Vector3d a) => new Vector3d(-a.X, -a.Y, -a.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d operator *(double s, in Vector3d a) => new Vector3d(s * a.X, s * a.Y, s * a.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d operator *(in Vector3d a, double s) => new Vector3d(s * a.X, s * a.Y, s * a.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d operator /(in Vector3d a, double s) => new Vector3d(a.X / s, a.Y / s, a.Z / s);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static bool operator ==(in Vector3d a, in Vector3d b) => a.X == b.X && a.Y == b.Y && a.Z == b.Z;

        public static bool operator !=(in Vector3d a, in Vector3d b) => !(a == b);

        /// <summary>Takes the scalar product a . b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double Dot(in Vector3d a, in Vector3d b) => a.X * b.X + a.Y * b.Y + a.Z * b.Z;

        /// <summary>Takes the cross product a x b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d Cross(in Vector3d a, in Vector3d b) =>
            new Vector3d(a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X);

        /// <summary>Gives the distance |a - b|.</summary>
        public static double Distance(in Vector3d a, in Vector3d b) => (a - b).Length;

        /// <summary>Gives (1 - t) a + t b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d Lerp(in Vector3d a, in Vector3d b, double t) =>
            new Vector3d(a.X + t * (b.X - a.X), a.Y + t * (b.Y - a.Y), a.Z + t * (b.Z - a.Z));

        /// <summary>v / |v|; the zero vector stays zero, because it has no direction.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d Normalize(in Vector3d a)
        {
            double length = a.Length;
            return length > 0.0 ? a / length : Zero;
        }

        /// <summary>Some unit vector across a, which must not be 0.</summary>
        internal static Vector3d Perpendicular(in Vector3d a)
        {
            Vector3d other = Math.Abs(a.X) < 0.9 * a.Length ? UnitX : UnitY;
            return Normalize(Cross(a, other));
        }

        /// <inheritdoc/>
        public bool Equals(Vector3d other) => X.Equals(other.X) && Y.Equals(other.Y) && Z.Equals(other.Z);

        /// <inheritdoc/>
        public override bool Equals(object? obj) => obj is Vector3d other && Equals(other);

        /// <inheritdoc/>
        public override int GetHashCode() => HashCode.Combine(X, Y, Z);

        /// <inheritdoc/>
        public override string ToString() =>
            string.Format(CultureInfo.InvariantCulture, "({0:R}, {1:R}, {2:R})", X, Y, Z);

        private static bool IsFiniteNumber(double value) => !double.IsNaN(value) && !double.IsInfinity(value);
    }
}
