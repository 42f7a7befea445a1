using System;
using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.Intrinsics;
#endif

namespace Guidewire.Core
{
    /// <summary>What <see cref="InertiaEnergy"/> asks most of four successive elements, at once, with its formulas in
    /// its order: the same bits.</summary>
    /// <remarks>False where nothing is done, because one of the four has turned by more than the series can take or the
    /// processor has no such registers.</remarks>
    internal static class InertiaLanes
    {
#if NET8_0_OR_GREATER
        private const int Step = 6;   // numbers of a RodVector
#endif

        /// <summary>Sets the couples of elements j to j+3, and their turns since the step's start.</summary>
        /// <param name="surelyFirst">Square of a turn below which the shortest rotation vector is meant.</param>
        public static bool FindCouples(InertiaEnergy inertia, Vector3d[] rotary, RodShape shape, Vector3d[] countedTurn,
            double surelyFirst, Vector3d[] couple, int j)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported || !TryTurn(inertia, shape, countedTurn, surelyFirst, j, out Vector3d4 turn))
            {
                return false;
            }
            Vector256<double> perStage = Vector256.Create(1.0 / inertia.StageLength);
            Vector3d4 w = perStage
                * RotationVector4.TangentMap(turn, turn - Vector3d4.Load(ref inertia.TurnHistory[j]));
            Vector3d4 rate = perStage * (w - Vector3d4.Load(ref inertia.SpinHistory[j]));
            Vector3d4 i = Vector3d4.Load(ref rotary[j]);
            var precession = new Vector3d4(w.Y * w.Z, (w.X * w.Z) ^ Vector256.Create(-0.0),
                (i.Y - i.X) / i.Z * (w.X * w.Y));
            Vector3d4 change = rate + precession + Vector256.Create(inertia.TurnDamping) * w;
            new Vector3d4(i.X * change.X, i.Y * change.Y, i.Z * change.Z).Store(ref couple[j]);
            return true;
#else
            return false;
#endif
        }

        /// <summary>Sets phi' and w' of elements j to j+3, and their turns since the step's start.</summary>
        /// <param name="surelyFirst">Square of a turn below which the shortest rotation vector is meant.</param>
        public static bool SetRates(InertiaEnergy inertia, RodShape shape, Vector3d[] countedTurn, double surelyFirst,
            Vector3d[] turnRate, Vector3d[] spinRate, int j)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported || !TryTurn(inertia, shape, countedTurn, surelyFirst, j, out Vector3d4 turn))
            {
                return false;
            }
            Vector256<double> perStage = Vector256.Create(1.0 / inertia.StageLength);
            Vector3d4 change = turn - Vector3d4.Load(ref inertia.TurnHistory[j]);
            Vector3d4 w = perStage * RotationVector4.TangentMap(turn, change);
            (perStage * change).Store(ref turnRate[j]);
            (perStage * (w - Vector3d4.Load(ref inertia.SpinHistory[j]))).Store(ref spinRate[j]);
            return true;
#else
            return false;
#endif
        }

        /// <summary>Predicts orientations j to j+3 at the end of a stage from w' of two stages before.</summary>
        /// <param name="largest">In and out: the largest square of a change of a turn, rad^2.</param>
        public static bool Predict(InertiaEnergy inertia, Vector3d[] countedTurn, Vector3d[] first, Vector3d[] second,
            double fraction, Quaterniond[] predicted, int j, ref double largest)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported)
            {
                return false;
            }
            Vector256<double> h = Vector256.Create(inertia.StageLength);
            Vector3d4 one = Vector3d4.Load(ref first[j]);
            Vector3d4 rate = one + Vector256.Create(fraction) * (Vector3d4.Load(ref second[j]) - one);
            Vector3d4 turn = Vector3d4.Load(ref inertia.TurnHistory[j])
                + h * (Vector3d4.Load(ref inertia.SpinHistory[j]) + h * rate);
            if (!RotationVector4.TryExp(turn, out Quaterniond4 rotation))
            {
                return false;
            }
            (Quaterniond4.Load(ref inertia.Start[j]) * rotation).Store(ref predicted[j]);
            Vector256<double> squares = (turn - Vector3d4.Load(ref countedTurn[j])).LengthSquared;
            largest = Math.Max(Math.Max(Math.Max(largest, squares.GetElement(0)), squares.GetElement(1)),
                Math.Max(squares.GetElement(2), squares.GetElement(3)));
            return true;
#else
            return false;
#endif
        }

        /// <summary>Adds the gradients of nodes and elements from one on, four at a time.</summary>
        /// <param name="end">First element that does not belong to them.</param>
        /// <param name="couple">On the elements, N m.</param>
        /// <returns>The first that is left.</returns>
        public static int AddGradient(InertiaEnergy inertia, double[] diagonal, double[] coupling, Vector3d[] couple,
            RodShape shape, RodVector[] gradient, int from, int end)
        {
            int j = from;
#if NET8_0_OR_GREATER
            Vector256<double> perSquare = Vector256.Create(1.0 / (inertia.StageLength * inertia.StageLength));
            for (; Rows4.IsSupported && j + 4 <= end; j += 4)
            {
                Vector3d4 a = perSquare
                    * (Vector3d4.Load(ref shape.X[j]) - Vector3d4.Load(ref inertia.FreePositions[j]));
                Vector3d4 b = perSquare
                    * (Vector3d4.Load(ref shape.X[j + 1]) - Vector3d4.Load(ref inertia.FreePositions[j + 1]));
                Vector256<double> mixed = Vector256.LoadUnsafe(ref coupling[j]);
                Vector3d4 onNext = mixed * a;
                Vector3d4 force = Vector256.LoadUnsafe(ref diagonal[j]) * a + mixed * b;
                Vector3d4 c = Vector3d4.Load(ref couple[j]);
                Rows4.Add(ref gradient[j + 1].X1, Step, onNext.X, onNext.Y, onNext.Z, Rows4.Nothing);
                Rows4.Add(ref gradient[j].X1, Step, force.X, force.Y, force.Z, c.X);
                Rows4.Add(ref gradient[j].T2, Step, c.Y, c.Z);
            }
#endif
            return j;
        }

        /// <summary>Adds the work of the couples of elements j to j+3 since their anchor, J.</summary>
        /// <param name="perTurn">Second derivative by a turn over the rotary inertia, 1/s^2.</param>
        public static bool AddWork(Quaterniond[] anchor, Vector3d[] couple, Vector3d[] rotary, double perTurn,
            RodShape shape, int j, ref double sum)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported)
            {
                return false;
            }
            Quaterniond4 relative = Quaterniond4.Load(ref anchor[j]).Conjugate * Quaterniond4.Load(ref shape.Q[j]);
            if (!RotationVector4.TryLog(relative, out Vector3d4 turn))
            {
                return false;
            }
            Vector3d4 i = Vector3d4.Load(ref rotary[j]);
            Vector256<double> squares = i.X * turn.X * turn.X + i.Y * turn.Y * turn.Y + i.Z * turn.Z * turn.Z;
            sum = Rows4.Sum(sum, Vector3d4.Dot(Vector3d4.Load(ref couple[j]), turn)
                + Vector256.Create(0.5 * perTurn) * squares);
            return true;
#else
            return false;
#endif
        }

#if NET8_0_OR_GREATER
        // InertiaEnergy.Turn.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static bool TryTurn(InertiaEnergy inertia, RodShape shape, Vector3d[] countedTurn, double surelyFirst,
            int j, out Vector3d4 turn)
        {
            Quaterniond4 relative = Quaterniond4.Load(ref inertia.Start[j]).Conjugate
                * Quaterniond4.Load(ref shape.Q[j]);
            Vector256<double> last = Vector3d4.Load(ref countedTurn[j]).LengthSquared;
            if (!RotationVector4.TryLog(relative, out turn)
                || !Vector256.LessThanOrEqualAll(last, Vector256.Create(surelyFirst)))
            {
                return false;
            }
            turn.Store(ref countedTurn[j]);
            return true;
        }
#endif
    }
}
