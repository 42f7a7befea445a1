using System;
using System.Globalization;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>A quaternion x i + y j + z k + w in double precision; of unit length it is an orientation, which takes
    /// body vectors to world vectors by v -> q v q*. Component order x, y, z, w as in Unity.</summary>
    public readonly struct Quaterniond : IEquatable<Quaterniond>
    {
        /// <summary>The first imaginary component.</summary>
        public readonly double X;

        /// <summary>The second imaginary component.</summary>
        public readonly double Y;

        /// <summary>The third imaginary component.</summary>
        public readonly double Z;

        /// <summary>The real component.</summary>
        public readonly double W;

        /// <summary>Makes the quaternion x i + y j + z k + w.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Quaterniond(double x, double y, double z, double w)
        {
            X = x;
            Y = y;
            Z = z;
            W = w;
        }

        /// <summary>The orientation that turns nothing: (0, 0, 0, 1).</summary>
        public static Quaterniond Identity => new Quaterniond(0.0, 0.0, 0.0, 1.0);

        /// <summary>q* = (-x, -y, -z, w), the inverse of a unit quaternion.</summary>
        public Quaterniond Conjugate
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Quaterniond(-X, -Y, -Z, W);
        }

        /// <summary>Gives |q|^2.</summary>
        public double LengthSquared
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => X * X + Y * Y + Z * Z + W * W;
        }

        /// <summary>(x, y, z), the imaginary part.</summary>
        public Vector3d Imaginary
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d(X, Y, Z);
        }

        /// <summary>First director d1 = q e1 q*, the body's x axis in the world; q must be of unit length.</summary>
        public Vector3d Director1
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d(
                1.0 - 2.0 * (Y * Y + Z * Z), 2.0 * (X * Y + W * Z), 2.0 * (X * Z - W * Y));
        }

        /// <summary>Second director d2 = q e2 q*, the body's y axis in the world; q must be of unit length.</summary>
        public Vector3d Director2
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d(
                2.0 * (X * Y - W * Z), 1.0 - 2.0 * (X * X + Z * Z), 2.0 * (Y * Z + W * X));
        }

        /// <summary>Third director d3 = q e3 q*, along the rod element; q must be of unit length.</summary>
        public Vector3d Director3
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => new Vector3d(
                2.0 * (X * Z + W * Y), 2.0 * (Y * Z - W * X), 1.0 - 2.0 * (X * X + Y * Y));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Quaterniond operator +(in Quaterniond a, in Quaterniond b) =>
            new Quaterniond(a.X + b.X, a.Y + b.Y, a.Z + b.Z, a.W + b.W);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Quaterniond operator *(double s, in Quaterniond a) =>
            new Quaterniond(s * a.X, s * a.Y, s * a.Z, s * a.W);

        /// <summary>Hamilton's product: a b turns by b first, then by a.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Quaterniond operator *(in Quaterniond a, in Quaterniond b)
        {
            return new Quaterniond(
                a.W * b.X + a.X * b.W + a.Y * b.Z - a.Z * b.Y,
                a.W * b.Y - a.X * b.Z + a.Y * b.W + a.Z * b.X,
                a.W * b.Z + a.X * b.Y - a.Y * b.X + a.Z * b.W,
                a.W * b.W - a.X * b.X - a.Y * b.Y - a.Z * b.Z);
        }

        public static bool operator ==(in Quaterniond a, in Quaterniond b) =>
            a.X == b.X && a.Y == b.Y && a.Z == b.Z && a.W == b.W;

        public static bool operator !=(in Quaterniond a, in Quaterniond b) => !(a == b);

        /// <summary>Gives the quaternion with imaginary part v and real part 0.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Quaterniond Pure(in Vector3d v) => new Quaterniond(v.X, v.Y, v.Z, 0.0);

        /// <summary>q / |q|. A quaternion of length 0 gives NaN: it names no orientation.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Quaterniond Normalize(in Quaterniond q) =>
            (1.0 / Math.Sqrt(q.X * q.X + q.Y * q.Y + q.Z * q.Z + q.W * q.W)) * q;

        /// <summary>The shortest turn from one direction to another; none where they are opposite.</summary>
        public static Quaterniond Shortest(in Vector3d from, in Vector3d to)
        {
            Vector3d across = Vector3d.Cross(from, to);
            double along = Vector3d.Dot(from, to) + from.Length * to.Length;
            return along > 0.0 ? Normalize(new Quaterniond(across.X, across.Y, across.Z, along)) : Identity;
        }

        /// <summary>Of the two numbers of an orientation that which goes on from another one.</summary>
        public static Quaterniond Aligned(in Quaterniond before, in Quaterniond q)
        {
            double real = before.X * q.X + before.Y * q.Y + before.Z * q.Z + before.W * q.W;
            return real < 0.0 ? -1.0 * q : q;
        }

        /// <summary>Gives the turn by <paramref name="angle"/> radians about <paramref name="axis"/>, a unit
        /// vector.</summary>
        public static Quaterniond FromAxisAngle(in Vector3d axis, double angle)
        {
            double sine = Math.Sin(0.5 * angle);
            return new Quaterniond(sine * axis.X, sine * axis.Y, sine * axis.Z, Math.Cos(0.5 * angle));
        }

        /// <summary>q v q*: the body vector <paramref name="v"/> in the world; q must be of unit length.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d Rotate(in Quaterniond q, in Vector3d v)
        {
            Vector3d u = q.Imaginary;
            Vector3d t = 2.0 * Vector3d.Cross(u, v);
            return v + q.W * t + Vector3d.Cross(u, t);
        }

        /// <inheritdoc/>
        public bool Equals(Quaterniond other) =>
            X.Equals(other.X) && Y.Equals(other.Y) && Z.Equals(other.Z) && W.Equals(other.W);

        /// <inheritdoc/>
        public override bool Equals(object? obj) => obj is Quaterniond other && Equals(other);

        /// <inheritdoc/>
        public override int GetHashCode() => HashCode.Combine(X, Y, Z, W);

        /// <inheritdoc/>
        public override string ToString() =>
            string.Format(CultureInfo.InvariantCulture, "({0:R}, {1:R}, {2:R}, {3:R})", X, Y, Z, W);
    }
}
