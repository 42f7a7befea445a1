using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;
#endif

namespace Guidewire.Core
{
    /// <summary><see cref="RodStep"/> for four successive elements at once, with its formulas in its order: the same
    /// bits. False where nothing is done, because a rotation exceeds the range of the series or the processor lacks
    /// such registers.</summary>
    internal static class StepLanes
    {
#if NET8_0_OR_GREATER
        private const int Stride = 6;   // numbers of a RodVector
#endif

        /// <summary>Moves elements j to j+3 and the nodes after them so that strains change linearly.</summary>
        /// <param name="old">In and out: the last node before the step, m.</param>
        /// <param name="x">In and out: the last node after it.</param>
        public static bool Apply(RodShape shape, RodVector[] direction, double scale, RodShape to, int j,
            ref Vector3d old, ref Vector3d x)
        {
#if NET8_0_OR_GREATER
            if (!TryLoad(direction, scale, j, out Vector3d4 move, out Vector3d4 turn, out Quaterniond4 rotation))
            {
                return false;
            }
            Vector3d4 nextMove = Next(move, scale, direction[j + 4]);
            Vector3d4 nextOld = Vector3d4.Load(ref shape.X[j + 1]);
            Vector3d4 chord = nextOld - Before(nextOld, old);
            old = shape.X[j + 4];
            Quaterniond4 q = Quaterniond4.Load(ref shape.Q[j]);
            Quaterniond4 inverse = q.Conjugate;
            Vector3d4 straight = Quaterniond4.Rotate(inverse, chord);
            Vector3d4 changed = straight + Quaterniond4.Rotate(inverse, nextMove - move)
                + Vector3d4.Cross(straight, turn);
            q = Quaterniond4.NearlyNormalized(q * rotation);
            q.Store(ref to.Q[j]);
            Vector3d4 along = Quaterniond4.Rotate(q, changed);
            double px = x.X, py = x.Y, pz = x.Z;
            for (int k = 0; k < 4; k++)
            {
                px += along.X.GetElement(k);
                py += along.Y.GetElement(k);
                pz += along.Z.GetElement(k);
                to.X[j + 1 + k] = new Vector3d(px, py, pz);
            }
            x = new Vector3d(px, py, pz);
            return true;
#else
            return false;
#endif
        }

        /// <summary>Moves nodes and elements j to j+3 on straight lines.</summary>
        public static bool ApplyStraight(RodShape shape, RodVector[] direction, double scale, RodShape to, int j)
        {
#if NET8_0_OR_GREATER
            if (!TryLoad(direction, scale, j, out Vector3d4 move, out _, out Quaterniond4 rotation))
            {
                return false;
            }
            (Vector3d4.Load(ref shape.X[j]) + move).Store(ref to.X[j]);
            Quaterniond4.NearlyNormalized(Quaterniond4.Load(ref shape.Q[j]) * rotation).Store(ref to.Q[j]);
            return true;
#else
            return false;
#endif
        }

#if NET8_0_OR_GREATER
        // Moves of nodes j to j+3, turns of elements j to j+3 as vectors and as rotations.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static bool TryLoad(RodVector[] direction, double scale, int j, out Vector3d4 move, out Vector3d4 turn,
            out Quaterniond4 rotation)
        {
            if (!Rows4.IsSupported)
            {
                move = default;
                turn = default;
                rotation = default;
                return false;
            }
            Vector256<double> s = Vector256.Create(scale);
            Rows4.Load(ref direction[j].X1, Stride, out Vector256<double> x1, out Vector256<double> x2,
                out Vector256<double> x3, out Vector256<double> t1);
            Rows4.Load(ref direction[j].T2, Stride, out Vector256<double> t2, out Vector256<double> t3);
            move = s * new Vector3d4(x1, x2, x3);
            turn = s * new Vector3d4(t1, t2, t3);
            return RotationVector4.TryExp(turn, out rotation);
        }

        // Each lane's vector in the lane after it, the entering one in lane 0.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector3d4 Before(Vector3d4 v, in Vector3d entering) =>
            new Vector3d4(Before(v.X, entering.X), Before(v.Y, entering.Y), Before(v.Z, entering.Z));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<double> Before(Vector256<double> v, double entering) =>
            Avx.Blend(Avx2.Permute4x64(v, 0b10_01_00_00), Vector256.Create(entering), 0b0001);

        // Each lane's move in the lane before it, that of the direction in lane 3.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector3d4 Next(Vector3d4 v, double scale, in RodVector last) =>
            new Vector3d4(Next(v.X, scale * last.X1), Next(v.Y, scale * last.X2), Next(v.Z, scale * last.X3));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<double> Next(Vector256<double> v, double entering) =>
            Avx.Blend(Avx2.Permute4x64(v, 0b11_11_10_01), Vector256.Create(entering), 0b1000);
#endif
    }
}
