namespace Guidewire.Core
{
    /// <summary>Eliminates a twist angle after the block of its element (<see cref="BlockElimination"/>): its columns
    /// go through that block as right-hand sides do, then the angle is a pivot of its own,
    ///   u = L^-1 U_j, v = L^-1 V_j, d = Z_jj - u^T D^-1 u, c = Z_(j+1)j - v^T D^-1 u, Z_(j+1)(j+1) -= v^T D^-1 v,
    ///   K_(j+1) -= b b^T/d, Z_(j+1)(j+1) -= c^2/d, U_(j+1) -= c b/d,
    /// with U_j, V_j the columns of z_j and z_(j+1) in block j and b that of z_j in block j + 1.</summary>
    /// <remarks>Nothing is filled in but the positions of b: a rotation meets the next position, so z_j does
    /// too.</remarks>
    internal static class TwistElimination
    {
        /// <summary>Eliminates z_j from what comes after it.</summary>
        /// <param name="block">Block j, eliminated.</param>
        /// <param name="y">Its right-hand side, D^-1 L^-1 of it.</param>
        /// <param name="z">Right-hand side of z_j; receives it over the pivot.</param>
        /// <returns>1 where the pivot is not positive, else 0.</returns>
        public static int Eliminate(in RodBlock block, ref RodBlock next, ref TwistRow row, ref TwistRow nextRow,
            in RodVector y, ref RodVector nextY, ref double z, ref double nextZ)
        {
            PassBlock(block, ref row, ref nextRow);
            double pivot = row.Diagonal - Dot(row.WeightedOwn, row.Own);
            row.NextTwist -= Dot(row.WeightedNext, row.Own);
            nextRow.Diagonal -= Dot(row.WeightedNext, row.Next);
            row.Inverse = 1.0 / pivot;
            AddSquare(ref next, row.Below, -row.Inverse);
            AddScaled(ref nextRow.Own, -row.Inverse * row.NextTwist, row.Below);
            nextRow.Diagonal -= row.Inverse * row.NextTwist * row.NextTwist;
            Forward(row, y, ref nextY, ref z, ref nextZ);
            return pivot > 0.0 ? 0 : 1;
        }

        /// <summary>Sends the columns of z_j and z_(j+1) through block j, which is eliminated.</summary>
        public static void PassBlock(in RodBlock block, ref TwistRow row, ref TwistRow nextRow)
        {
            Add(ref row.Own, row.Turn);
            row.Below = default;
            Add(ref row.Below, row.NextTurn);
            BlockElimination.Forward(block, ref row.Own, ref row.Below);
            row.Next = default;
            Add(ref row.Next, row.TurnOfNext);
            BlockElimination.Forward(block, ref row.Next, ref nextRow.Own);
            row.WeightedOwn = Weighted(block, row.Own);
            row.WeightedNext = Weighted(block, row.Next);
        }

        /// <summary>The right-hand side of z_j and of what comes after it, with a factorisation that is kept.</summary>
        /// <param name="y">Of block j, after its own <see cref="BlockElimination.Forward"/>.</param>
        public static void Forward(in TwistRow row, in RodVector y, ref RodVector nextY, ref double z,
            ref double nextZ)
        {
            z = row.Inverse * (z - Dot(row.WeightedOwn, y));
            nextZ -= Dot(row.WeightedNext, y) + row.NextTwist * z;
            AddScaled(ref nextY, -z, row.Below);
        }

        /// <summary>Solves for z_j, and takes its part and that of z_(j+1) out of block j, before that block's own
        /// <see cref="BlockElimination.Backward"/>.</summary>
        public static void Backward(in TwistRow row, ref RodVector y, in RodVector nextY, ref double z, double nextZ)
        {
            z -= row.Inverse * (Dot(row.Below, nextY) + row.NextTwist * nextZ);
            AddScaled(ref y, -z, row.Own);
            AddScaled(ref y, -nextZ, row.Next);
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

        /// <summary>Takes the scalar product a . b.</summary>
        public static double Dot(in RodVector a, in RodVector b)
        {
            return a.X1 * b.X1 + a.X2 * b.X2 + a.X3 * b.X3 + a.T1 * b.T1 + a.T2 * b.T2 + a.T3 * b.T3;
        }

        private static void Add(ref RodVector v, in Vector3d turn)
        {
            v.T1 += turn.X;
            v.T2 += turn.Y;
            v.T3 += turn.Z;
        }

        /// <summary>Adds: to += scale v.</summary>
        public static void AddScaled(ref RodVector to, double scale, in RodVector v)
        {
            to.X1 += scale * v.X1;
            to.X2 += scale * v.X2;
            to.X3 += scale * v.X3;
            to.T1 += scale * v.T1;
            to.T2 += scale * v.T2;
            to.T3 += scale * v.T3;
        }

        /// <summary>Adds: block += scale b b^T.</summary>
        public static void AddSquare(ref RodBlock block, in RodVector b, double scale)
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
