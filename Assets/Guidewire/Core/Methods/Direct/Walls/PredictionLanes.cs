using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.Intrinsics;
#endif

namespace Guidewire.Core
{
    /// <summary>What <see cref="WallPrediction"/> and <see cref="WallStage"/> do for each element, of four successive
    /// ones at once, with their formulas in their order: the same bits.</summary>
    /// <remarks>False where nothing is done, because one of the four turns by more than the series can take or the
    /// processor has no such registers.</remarks>
    internal static class PredictionLanes
    {
#if NET8_0_OR_GREATER
        private const int Step = 6;   // numbers of a RodVector
#endif

        /// <summary>Places nodes i to i+3 one after the other, in the directions of a curve.</summary>
        /// <param name="slide">What slides out of outer instruments by node, of which a fraction is added to the
        /// lengths.</param>
        public static bool PlaceAtLengths(Vector3d[] curve, Vector3d[] x, double[] lengths, double[] slide,
            double fraction, int i)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported)
            {
                return false;
            }
            Vector256<double> length = Vector256.LoadUnsafe(ref lengths[i]) + Vector256.Create(fraction)
                * (Vector256.LoadUnsafe(ref slide[i]) - Vector256.LoadUnsafe(ref slide[i - 1]));
            Vector3d4 along = length
                * Vector3d4.Normalize(Vector3d4.Load(ref curve[i]) - Vector3d4.Load(ref curve[i - 1]));
            Vector3d last = x[i - 1];
            double px = last.X, py = last.Y, pz = last.Z;
            for (int k = 0; k < 4; k++)
            {
                px += along.X.GetElement(k);
                py += along.Y.GetElement(k);
                pz += along.Z.GetElement(k);
                x[i + k] = new Vector3d(px, py, pz);
            }
            return true;
#else
            return false;
#endif
        }

        /// <summary>Turns elements j to j+3 with their chords, and about these by their spins.</summary>
        /// <param name="orientations">By the spins.</param>
        /// <param name="predicted">Its nodes are set; receives the orientations.</param>
        public static bool Turn(RodShape shape, Quaterniond[] orientations, RodShape predicted, int j)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported)
            {
                return false;
            }
            Vector3d4 from = Vector3d4.Load(ref shape.X[j + 1]) - Vector3d4.Load(ref shape.X[j]);
            Vector3d4 to = Vector3d4.Load(ref predicted.X[j + 1]) - Vector3d4.Load(ref predicted.X[j]);
            Vector3d4 across = Vector3d4.Cross(from, to);
            Vector256<double> along = Vector3d4.Dot(from, to)
                + Vector256.Sqrt(from.LengthSquared) * Vector256.Sqrt(to.LengthSquared);
            Quaterniond4 q = Quaterniond4.Load(ref shape.Q[j]);
            Vector256<double> zero = Vector256<double>.Zero;
            if (!Vector256.GreaterThanAll(along, zero)
                || !RotationVector4.TryLog(q.Conjugate * Quaterniond4.Load(ref orientations[j]), out Vector3d4 spin)
                || !RotationVector4.TryExp(new Vector3d4(zero, zero, spin.Z), out Quaterniond4 about))
            {
                return false;
            }
            Quaterniond4 shortest = Quaterniond4.Normalize(new Quaterniond4(across.X, across.Y, across.Z, along));
            (shortest * q * about).Store(ref predicted.Q[j]);
            return true;
#else
            return false;
#endif
        }

        /// <summary>Sets the direction of nodes and elements j to j+3 from one shape to another.</summary>
        public static bool SetDirection(RodShape shape, RodShape to, RodVector[] direction, int j)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported || !RotationVector4.TryLog(
                Quaterniond4.Load(ref shape.Q[j]).Conjugate * Quaterniond4.Load(ref to.Q[j]), out Vector3d4 turn))
            {
                return false;
            }
            Vector3d4 move = Vector3d4.Load(ref to.X[j]) - Vector3d4.Load(ref shape.X[j]);
            Rows4.Store(ref direction[j].X1, Step, move.X, move.Y, move.Z, turn.X);
            Rows4.Store(ref direction[j].T2, Step, turn.Y, turn.Z);
            return true;
#else
            return false;
#endif
        }
    }
}
