using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>A symmetric 3x3 matrix by its lower triangle.</summary>
    internal readonly struct Symmetric3
    {
        private const int JacobiSweeps = 5;
        private const double Rounding = 4e-15;    // of the largest entry

        private readonly double _11;
        private readonly double _21;
        private readonly double _22;
        private readonly double _31;
        private readonly double _32;
        private readonly double _33;

        /// <summary>The matrix of these entries.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Symmetric3(double a11, double a21, double a22, double a31, double a32, double a33)
        {
            _11 = a11;
            _21 = a21;
            _22 = a22;
            _31 = a31;
            _32 = a32;
            _33 = a33;
        }

        /// <summary>Gives the sum of w_k c_k c_k^T over three vectors, plus a diagonal.</summary>
        public static Symmetric3 FromColumns(in Vector3d c1, double w1, in Vector3d c2, double w2, in Vector3d c3,
            double w3, in Vector3d diagonal)
        {
            return new Symmetric3(
                w1 * c1.X * c1.X + w2 * c2.X * c2.X + w3 * c3.X * c3.X + diagonal.X,
                w1 * c1.X * c1.Y + w2 * c2.X * c2.Y + w3 * c3.X * c3.Y,
                w1 * c1.Y * c1.Y + w2 * c2.Y * c2.Y + w3 * c3.Y * c3.Y + diagonal.Y,
                w1 * c1.X * c1.Z + w2 * c2.X * c2.Z + w3 * c3.X * c3.Z,
                w1 * c1.Y * c1.Z + w2 * c2.Y * c2.Z + w3 * c3.Y * c3.Z,
                w1 * c1.Z * c1.Z + w2 * c2.Z * c2.Z + w3 * c3.Z * c3.Z + diagonal.Z);
        }

        /// <summary>Gives the sum of two matrices.</summary>
        public static Symmetric3 operator +(in Symmetric3 a, in Symmetric3 b)
        {
            return new Symmetric3(a._11 + b._11, a._21 + b._21, a._22 + b._22, a._31 + b._31, a._32 + b._32,
                a._33 + b._33);
        }

        /// <summary>The entry (1, 1).</summary>
        public double A11 => _11;

        /// <summary>The entry (2, 1).</summary>
        public double A21 => _21;

        /// <summary>The entry (2, 2).</summary>
        public double A22 => _22;

        /// <summary>The entry (3, 1).</summary>
        public double A31 => _31;

        /// <summary>The entry (3, 2).</summary>
        public double A32 => _32;

        /// <summary>The entry (3, 3).</summary>
        public double A33 => _33;

        /// <summary>Makes w c c^T.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Symmetric3 Outer(double w, in Vector3d c)
        {
            return new Symmetric3(w * c.X * c.X, w * c.X * c.Y, w * c.Y * c.Y, w * c.X * c.Z, w * c.Y * c.Z,
                w * c.Z * c.Z);
        }

        /// <summary>Gives w (c d^T + d c^T).</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Symmetric3 Pair(double w, in Vector3d c, in Vector3d d)
        {
            return new Symmetric3(2.0 * w * c.X * d.X, w * (c.X * d.Y + c.Y * d.X), 2.0 * w * c.Y * d.Y,
                w * (c.X * d.Z + c.Z * d.X), w * (c.Y * d.Z + c.Z * d.Y), 2.0 * w * c.Z * d.Z);
        }

        /// <summary>Multiplies by a number: w A.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Symmetric3 operator *(double w, in Symmetric3 a) =>
            new Symmetric3(w * a._11, w * a._21, w * a._22, w * a._31, w * a._32, w * a._33);

        /// <summary>Multiplies a vector: A b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector3d Times(in Vector3d b)
        {
            return new Vector3d(_11 * b.X + _21 * b.Y + _31 * b.Z, _21 * b.X + _22 * b.Y + _32 * b.Z,
                _31 * b.X + _32 * b.Y + _33 * b.Z);
        }

        /// <summary>The nearest matrix without negative eigenvalues: those of this one are set to 0, by Jacobi's
        /// rotations. A matrix that has none, or only such as rounding leaves, is returned as it is.</summary>
        public Symmetric3 PositivePart()
        {
            if (IsSemidefinite())
            {
                return this;
            }
            Symmetric3 d = this;
            Vector3d v1 = Vector3d.UnitX;
            Vector3d v2 = Vector3d.UnitY;
            Vector3d v3 = Vector3d.UnitZ;
            for (int sweep = 0; sweep < JacobiSweeps; sweep++)
            {
                Rotation(d._11, d._22, d._21, out double c, out double s);
                d = new Symmetric3(c * c * d._11 - 2.0 * s * c * d._21 + s * s * d._22, 0.0,
                    s * s * d._11 + 2.0 * s * c * d._21 + c * c * d._22, c * d._31 - s * d._32,
                    s * d._31 + c * d._32, d._33);
                (v1, v2) = (c * v1 - s * v2, s * v1 + c * v2);
                Rotation(d._11, d._33, d._31, out c, out s);
                d = new Symmetric3(c * c * d._11 - 2.0 * s * c * d._31 + s * s * d._33, c * d._21 - s * d._32,
                    d._22, 0.0, s * d._21 + c * d._32, s * s * d._11 + 2.0 * s * c * d._31 + c * c * d._33);
                (v1, v3) = (c * v1 - s * v3, s * v1 + c * v3);
                Rotation(d._22, d._33, d._32, out c, out s);
                d = new Symmetric3(d._11, c * d._21 - s * d._31,
                    c * c * d._22 - 2.0 * s * c * d._32 + s * s * d._33, s * d._21 + c * d._31, 0.0,
                    s * s * d._22 + 2.0 * s * c * d._32 + c * c * d._33);
                (v2, v3) = (c * v2 - s * v3, s * v2 + c * v3);
            }
            return Outer(System.Math.Max(0.0, d._11), v1) + Outer(System.Math.Max(0.0, d._22), v2)
                + Outer(System.Math.Max(0.0, d._33), v3);
        }

        // Whether no eigenvalue is negative beyond rounding: the pivots of an elimination, the largest diagonal entry
        // first, have the signs of the eigenvalues.
        private bool IsSemidefinite()
        {
            (double a, double b, double c) = (_11, _22, _33);
            (double ab, double ac, double bc) = (_21, _31, _32);
            if (b > a && b >= c)
            {
                (a, b, ac, bc) = (b, a, bc, ac);
            }
            else if (c > a)
            {
                (a, c, ab, bc) = (c, a, bc, ab);
            }
            if (!(a > 0.0))
            {
                return false;
            }
            double rounding = Rounding * a;
            double scale = 1.0 / a;
            b -= scale * ab * ab;
            c -= scale * ac * ac;
            bc -= scale * ab * ac;
            (b, c) = c > b ? (c, b) : (b, c);
            return b > rounding ? c - bc * bc / b >= -rounding
                : System.Math.Abs(b) <= rounding && System.Math.Abs(c) <= rounding && System.Math.Abs(bc) <= rounding;
        }

        // The turn by which (p, q; q, r) becomes diagonal.
        private static void Rotation(double p, double r, double q, out double c, out double s)
        {
            if (q == 0.0)
            {
                c = 1.0;
                s = 0.0;
                return;
            }
            double theta = 0.5 * (r - p) / q;
            double t = (theta >= 0.0 ? 1.0 : -1.0)
                / (System.Math.Abs(theta) + System.Math.Sqrt(theta * theta + 1.0));
            c = 1.0 / System.Math.Sqrt(t * t + 1.0);
            s = t * c;
        }

        /// <summary>The solution u of A u = b, by cofactors; A must not be singular.</summary>
        public Vector3d Solve(in Vector3d b)
        {
            double c11 = _22 * _33 - _32 * _32;
            double c21 = _31 * _32 - _21 * _33;
            double c31 = _21 * _32 - _22 * _31;
            double c22 = _11 * _33 - _31 * _31;
            double c32 = _21 * _31 - _11 * _32;
            double c33 = _11 * _22 - _21 * _21;
            double scale = 1.0 / (_11 * c11 + _21 * c21 + _31 * c31);
            return scale * new Vector3d(
                c11 * b.X + c21 * b.Y + c31 * b.Z,
                c21 * b.X + c22 * b.Y + c32 * b.Z,
                c31 * b.X + c32 * b.Y + c33 * b.Z);
        }
    }
}
