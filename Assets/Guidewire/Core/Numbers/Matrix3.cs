using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>A 3x3 matrix by its columns.</summary>
    internal readonly struct Matrix3
    {
        /// <summary>First column.</summary>
        public readonly Vector3d C1;

        /// <summary>Second column.</summary>
        public readonly Vector3d C2;

        /// <summary>Third column.</summary>
        public readonly Vector3d C3;

        /// <summary>The matrix of these columns.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Matrix3(in Vector3d c1, in Vector3d c2, in Vector3d c3)
        {
            C1 = c1;
            C2 = c2;
            C3 = c3;
        }

        /// <summary>1.</summary>
        public static Matrix3 Identity => new Matrix3(Vector3d.UnitX, Vector3d.UnitY, Vector3d.UnitZ);

        /// <summary>det A.</summary>
        public double Determinant => Vector3d.Dot(C1, Vector3d.Cross(C2, C3));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Matrix3 operator +(in Matrix3 a, in Matrix3 b) =>
            new Matrix3(a.C1 + b.C1, a.C2 + b.C2, a.C3 + b.C3);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Matrix3 operator *(double w, in Matrix3 a) => new Matrix3(w * a.C1, w * a.C2, w * a.C3);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Vector3d operator *(in Matrix3 a, in Vector3d v) => v.X * a.C1 + v.Y * a.C2 + v.Z * a.C3;

        /// <summary>A B.</summary>
        public Matrix3 Times(in Matrix3 b) => new Matrix3(this * b.C1, this * b.C2, this * b.C3);

        /// <summary>Makes a b^T.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Matrix3 Outer(in Vector3d a, in Vector3d b) => new Matrix3(b.X * a, b.Y * a, b.Z * a);

        /// <summary>A^T v.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector3d TransposeTimes(in Vector3d v) =>
            new Vector3d(Vector3d.Dot(C1, v), Vector3d.Dot(C2, v), Vector3d.Dot(C3, v));

        /// <summary>A^T B.</summary>
        public Matrix3 TransposeTimes(in Matrix3 b) =>
            new Matrix3(TransposeTimes(b.C1), TransposeTimes(b.C2), TransposeTimes(b.C3));

        /// <summary>Entry of a row and a column, from 0.</summary>
        public double this[int row, int column]
        {
            get
            {
                Vector3d c = column == 0 ? C1 : column == 1 ? C2 : C3;
                return row == 0 ? c.X : row == 1 ? c.Y : c.Z;
            }
        }

        /// <summary>The matrix of v -> S v + t x v.</summary>
        public static Matrix3 Of(in Symmetric3 s, in Vector3d t = default) => new Matrix3(
            s.Times(Vector3d.UnitX) + Vector3d.Cross(t, Vector3d.UnitX),
            s.Times(Vector3d.UnitY) + Vector3d.Cross(t, Vector3d.UnitY),
            s.Times(Vector3d.UnitZ) + Vector3d.Cross(t, Vector3d.UnitZ));

        /// <summary>The solution u of A u = b; A must not be singular.</summary>
        public Vector3d Solve(in Vector3d b)
        {
            Vector3d c23 = Vector3d.Cross(C2, C3);
            Vector3d c31 = Vector3d.Cross(C3, C1);
            Vector3d c12 = Vector3d.Cross(C1, C2);
            double scale = 1.0 / Vector3d.Dot(C1, c23);
            return scale * new Vector3d(Vector3d.Dot(c23, b), Vector3d.Dot(c31, b), Vector3d.Dot(c12, b));
        }

        /// <summary>A^T H A.</summary>
        public Symmetric3 Congruent(in Symmetric3 h)
        {
            Vector3d h1 = h.Times(C1);
            Vector3d h2 = h.Times(C2);
            Vector3d h3 = h.Times(C3);
            return new Symmetric3(Vector3d.Dot(C1, h1), Vector3d.Dot(C2, h1), Vector3d.Dot(C2, h2),
                Vector3d.Dot(C3, h1), Vector3d.Dot(C3, h2), Vector3d.Dot(C3, h3));
        }

        /// <summary>A^T (H + [t]) B, as a symmetric part and the vector of the other one, v -> turn x v.</summary>
        /// <param name="turn">In: t. Out: of the product.</param>
        public Symmetric3 Congruent(in Symmetric3 h, in Matrix3 b, ref Vector3d turn)
        {
            Vector3d r1 = TransposeTimes(h.Times(b.C1) + Vector3d.Cross(turn, b.C1));
            Vector3d r2 = TransposeTimes(h.Times(b.C2) + Vector3d.Cross(turn, b.C2));
            Vector3d r3 = TransposeTimes(h.Times(b.C3) + Vector3d.Cross(turn, b.C3));
            turn = 0.5 * new Vector3d(r2.Z - r3.Y, r3.X - r1.Z, r1.Y - r2.X);
            return new Symmetric3(r1.X, 0.5 * (r1.Y + r2.X), r2.Y, 0.5 * (r1.Z + r3.X), 0.5 * (r2.Z + r3.Y), r3.Z);
        }
    }
}
