namespace Guidewire.Core
{
    /// <summary>Eliminates the twist angles of an element, one or two, after its block (<see
    /// cref="BlockElimination"/>): the columns of each go through that block as right-hand sides do, then it is a pivot
    /// of its own,
    ///   u = L^-1 U_j, v = L^-1 V_j, d = Z_jj - u^T D^-1 u, c = Z_(j+1)j - v^T D^-1 u, Z_(j+1)(j+1) -= v^T D^-1 v,
    ///   K_(j+1) -= b b^T/d, Z_(j+1)(j+1) -= c^2/d, U_(j+1) -= c b/d,
    /// with U_j, V_j the columns of z_j and z_(j+1) in block j and b that of z_j in block j + 1. A second angle is one
    /// more of what comes after the first.</summary>
    /// <remarks>Nothing is filled in but the positions of b: a rotation meets the next position, so z_j does too. Rows
    /// are those of all first angles, then those of the second ones, by an offset behind them; 0: there are none. Of
    /// vectors T3 is the first angle's, T2 the second one's.</remarks>
    internal static class TwistElimination
    {
        /// <summary>Eliminates the angles of element j from what comes after it.</summary>
        /// <param name="block">Block j, eliminated.</param>
        /// <param name="second">The offset.</param>
        /// <param name="y">Its right-hand side, D^-1 L^-1 of it.</param>
        /// <param name="z">Right-hand sides of the angles; receives them over the pivots.</param>
        /// <returns>How many pivots are not positive.</returns>
        public static int Eliminate(in RodBlock block, ref RodBlock next, TwistRow[] rows, int j, int second,
            in RodVector y, ref RodVector nextY, ref RodVector z, ref RodVector nextZ)
        {
            ref TwistRow row = ref rows[j];
            ref TwistRow nextRow = ref rows[j + 1];
            PassBlock(block, ref row, ref nextRow);
            double pivot = row.Diagonal - RodVector.Dot(row.WeightedOwn, row.Own);
            row.NextTwist -= RodVector.Dot(row.WeightedNext, row.Own);
            nextRow.Diagonal -= RodVector.Dot(row.WeightedNext, row.Next);
            row.Inverse = 1.0 / pivot;
            AddSquare(ref next, row.Below, -row.Inverse);
            nextRow.Own.AddScaled(-row.Inverse * row.NextTwist, row.Below);
            nextRow.Diagonal -= row.Inverse * row.NextTwist * row.NextTwist;
            int negative = pivot > 0.0 ? 0 : 1;
            if (second > 0)
            {
                negative += EliminateSecond(block, ref next, ref row, ref nextRow, ref rows[second + j],
                    ref rows[second + j + 1]);
            }
            Forward(rows, j, second, y, ref nextY, ref z, ref nextZ);
            return negative;
        }

        // After the first one.
        private static int EliminateSecond(in RodBlock block, ref RodBlock next, ref TwistRow first,
            ref TwistRow nextFirst, ref TwistRow row, ref TwistRow nextRow)
        {
            PassBlock(block, ref row, ref nextRow);
            double pivot = row.Diagonal - RodVector.Dot(row.WeightedOwn, row.Own);
            first.Other -= RodVector.Dot(first.WeightedOwn, row.Own);
            first.NextOther -= RodVector.Dot(row.WeightedNext, first.Own);
            row.NextTwist -= RodVector.Dot(row.WeightedNext, row.Own);
            row.NextOther -= RodVector.Dot(first.WeightedNext, row.Own);
            nextRow.Diagonal -= RodVector.Dot(row.WeightedNext, row.Next);
            nextFirst.Other -= RodVector.Dot(first.WeightedNext, row.Next);
            double scale = first.Inverse * first.Other;
            pivot -= scale * first.Other;
            row.NextOther -= scale * first.NextTwist;
            row.NextTwist -= scale * first.NextOther;
            row.Below.AddScaled(-scale, first.Below);
            nextRow.Own.AddScaled(-first.Inverse * first.NextOther, first.Below);
            nextRow.Diagonal -= first.Inverse * first.NextOther * first.NextOther;
            nextFirst.Other -= first.Inverse * first.NextTwist * first.NextOther;
            row.Inverse = 1.0 / pivot;
            AddSquare(ref next, row.Below, -row.Inverse);
            nextFirst.Own.AddScaled(-row.Inverse * row.NextOther, row.Below);
            nextRow.Own.AddScaled(-row.Inverse * row.NextTwist, row.Below);
            nextFirst.Diagonal -= row.Inverse * row.NextOther * row.NextOther;
            nextRow.Diagonal -= row.Inverse * row.NextTwist * row.NextTwist;
            nextFirst.Other -= row.Inverse * row.NextOther * row.NextTwist;
            return pivot > 0.0 ? 0 : 1;
        }

        // Sends the columns of z_j and z_(j+1) through block j, which is eliminated.
        private static void PassBlock(in RodBlock block, ref TwistRow row, ref TwistRow nextRow)
        {
            row.Own.AddT(row.Turn);
            row.Below = default;
            row.Below.AddT(row.NextTurn);
            BlockElimination.Forward(block, ref row.Own, ref row.Below);
            row.Next = default;
            row.Next.AddT(row.TurnOfNext);
            BlockElimination.Forward(block, ref row.Next, ref nextRow.Own);
            row.WeightedOwn = Weighted(block, row.Own);
            row.WeightedNext = Weighted(block, row.Next);
        }

        /// <summary>The right-hand sides of the angles and of what comes after them, with a factorisation that is
        /// kept.</summary>
        /// <param name="y">Of block j, after its own <see cref="BlockElimination.Forward"/>.</param>
        public static void Forward(TwistRow[] rows, int j, int second, in RodVector y, ref RodVector nextY,
            ref RodVector z, ref RodVector nextZ)
        {
            ref readonly TwistRow first = ref rows[j];
            z.T3 = first.Inverse * (z.T3 - RodVector.Dot(first.WeightedOwn, y));
            double toFirst = RodVector.Dot(first.WeightedNext, y) + first.NextTwist * z.T3;
            nextY.AddScaled(-z.T3, first.Below);
            if (second > 0)
            {
                ref readonly TwistRow row = ref rows[second + j];
                z.T2 = row.Inverse * (z.T2 - RodVector.Dot(row.WeightedOwn, y) - first.Other * z.T3);
                toFirst += row.NextOther * z.T2;
                nextZ.T2 -= RodVector.Dot(row.WeightedNext, y) + first.NextOther * z.T3 + row.NextTwist * z.T2;
                nextY.AddScaled(-z.T2, row.Below);
            }
            nextZ.T3 -= toFirst;
        }

        /// <summary>Solves for the angles, and takes their part and that of the next element's out of block j, before
        /// that block's own <see cref="BlockElimination.Backward"/>.</summary>
        public static void Backward(TwistRow[] rows, int j, int second, ref RodVector y, in RodVector nextY,
            ref RodVector z, in RodVector nextZ)
        {
            ref readonly TwistRow first = ref rows[j];
            double sum = RodVector.Dot(first.Below, nextY) + first.NextTwist * nextZ.T3;
            if (second == 0)
            {
                z.T3 -= first.Inverse * sum;
                y.AddScaled(-z.T3, first.Own);
                y.AddScaled(-nextZ.T3, first.Next);
                return;
            }
            ref readonly TwistRow row = ref rows[second + j];
            z.T2 -= row.Inverse
                * (RodVector.Dot(row.Below, nextY) + row.NextOther * nextZ.T3 + row.NextTwist * nextZ.T2);
            z.T3 -= first.Inverse * (sum + first.NextOther * nextZ.T2 + first.Other * z.T2);
            y.AddScaled(-z.T3, first.Own);
            y.AddScaled(-z.T2, row.Own);
            y.AddScaled(-nextZ.T3, first.Next);
            y.AddScaled(-nextZ.T2, row.Next);
        }

        // D times a column.
        private static RodVector Weighted(in RodBlock block, in RodVector v)
        {
            return new RodVector
            {
                X1 = v.X1 / block.A11, X2 = v.X2 / block.A22, X3 = v.X3 / block.A33,
                T1 = v.T1 / block.C11, T2 = v.T2 / block.C22, T3 = v.T3 / block.C33,
            };
        }

        // block += scale b b^T.
        private static void AddSquare(ref RodBlock block, in RodVector b, double scale)
        {
            double x1 = scale * b.X1;
            double x2 = scale * b.X2;
            double x3 = scale * b.X3;
            block.A11 += x1 * b.X1;
            block.A21 += x2 * b.X1; block.A22 += x2 * b.X2;
            block.A31 += x3 * b.X1; block.A32 += x3 * b.X2; block.A33 += x3 * b.X3;
            block.B11 += b.T1 * x1; block.B12 += b.T1 * x2; block.B13 += b.T1 * x3;
            block.B21 += b.T2 * x1; block.B22 += b.T2 * x2; block.B23 += b.T2 * x3;
            block.B31 += b.T3 * x1; block.B32 += b.T3 * x2; block.B33 += b.T3 * x3;
            double t1 = scale * b.T1;
            double t2 = scale * b.T2;
            double t3 = scale * b.T3;
            block.C11 += t1 * b.T1;
            block.C21 += t2 * b.T1; block.C22 += t2 * b.T2;
            block.C31 += t3 * b.T1; block.C32 += t3 * b.T2; block.C33 += t3 * b.T3;
        }
    }
}
