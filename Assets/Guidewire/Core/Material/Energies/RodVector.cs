using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace Guidewire.Core
{
    /// <summary>Six numbers of one node and the element after it: X along the world's axes (a displacement in m or a
    /// force in N), T along the element's own axes (a turn in radians or a couple in N m).</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct RodVector
    {
        public double X1, X2, X3;
        public double T1, T2, T3;

        /// <summary>Makes one of both.</summary>
        public RodVector(in Vector3d x, in Vector3d t)
        {
            (X1, X2, X3) = (x.X, x.Y, x.Z);
            (T1, T2, T3) = (t.X, t.Y, t.Z);
        }

        /// <summary>X as a vector.</summary>
        public Vector3d X
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            readonly get => new Vector3d(X1, X2, X3);
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            set => (X1, X2, X3) = (value.X, value.Y, value.Z);
        }

        /// <summary>T as a vector.</summary>
        public readonly Vector3d T => new Vector3d(T1, T2, T3);

        /// <summary>Adds to X.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void AddX(in Vector3d x)
        {
            X1 += x.X;
            X2 += x.Y;
            X3 += x.Z;
        }

        /// <summary>Adds to T.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void AddT(in Vector3d t)
        {
            T1 += t.X;
            T2 += t.Y;
            T3 += t.Z;
        }

        /// <summary>Adds another one times a number.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void AddScaled(double scale, in RodVector v)
        {
            X1 += scale * v.X1;
            X2 += scale * v.X2;
            X3 += scale * v.X3;
            T1 += scale * v.T1;
            T2 += scale * v.T2;
            T3 += scale * v.T3;
        }

        /// <summary>Takes the scalar product a . b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double Dot(in RodVector a, in RodVector b) =>
            a.X1 * b.X1 + a.X2 * b.X2 + a.X3 * b.X3 + a.T1 * b.T1 + a.T2 * b.T2 + a.T3 * b.T3;
    }
}
