namespace Guidewire.Core
{
    /// <summary>Eliminates the two twist angles of an element with two instruments inside, one after the other, as
    /// <see cref="TwistElimination"/> does one: their columns and those of the next element's two angles pass through
    /// the block, then each angle is a pivot for all that comes after it.</summary>
    internal static class TwistPairElimination
    {
        /// <summary>Eliminates both angles of element j.</summary>
        /// <param name="block">Block j, eliminated.</param>
        /// <param name="y">Its right-hand side, D^-1 L^-1 of it.</param>
        /// <param name="z">Right-hand sides of the two; receive them over the pivots.</param>
        /// <returns>How many pivots are not positive.</returns>
        public static int Eliminate(in RodBlock block, ref RodBlock next, ref TwistRow first, ref TwistRow second,
            ref TwistRow nextFirst, ref TwistRow nextSecond, in RodVector y, ref RodVector nextY, ref RodVector z,
            ref RodVector nextZ)
        {
            TwistElimination.PassBlock(block, ref first, ref nextFirst);
            TwistElimination.PassBlock(block, ref second, ref nextSecond);
            double one = first.Diagonal - TwistElimination.Dot(first.WeightedOwn, first.Own);
            double two = second.Diagonal - TwistElimination.Dot(second.WeightedOwn, second.Own);
            first.Other -= TwistElimination.Dot(first.WeightedOwn, second.Own);
            first.NextTwist -= TwistElimination.Dot(first.WeightedNext, first.Own);
            first.NextOther -= TwistElimination.Dot(second.WeightedNext, first.Own);
            second.NextTwist -= TwistElimination.Dot(second.WeightedNext, second.Own);
            second.NextOther -= TwistElimination.Dot(first.WeightedNext, second.Own);
            nextFirst.Diagonal -= TwistElimination.Dot(first.WeightedNext, first.Next);
            nextSecond.Diagonal -= TwistElimination.Dot(second.WeightedNext, second.Next);
            nextFirst.Other -= TwistElimination.Dot(first.WeightedNext, second.Next);
            first.Inverse = 1.0 / one;
            double scale = first.Inverse * first.Other;
            two -= scale * first.Other;
            second.NextOther -= scale * first.NextTwist;
            second.NextTwist -= scale * first.NextOther;
            TwistElimination.AddScaled(ref second.Below, -scale, first.Below);
            Update(first, first.NextTwist, first.NextOther, ref next, ref nextFirst, ref nextSecond);
            second.Inverse = 1.0 / two;
            Update(second, second.NextOther, second.NextTwist, ref next, ref nextFirst, ref nextSecond);
            Forward(first, second, y, ref nextY, ref z, ref nextZ);
            return (one > 0.0 ? 0 : 1) + (two > 0.0 ? 0 : 1);
        }

        /// <summary>The right-hand sides of both and of what comes after them, with a factorisation that is
        /// kept.</summary>
        /// <param name="y">Of block j, after its own <see cref="BlockElimination.Forward"/>.</param>
        public static void Forward(in TwistRow first, in TwistRow second, in RodVector y, ref RodVector nextY,
            ref RodVector z, ref RodVector nextZ)
        {
            z.T3 = first.Inverse * (z.T3 - TwistElimination.Dot(first.WeightedOwn, y));
            z.T2 = second.Inverse * (z.T2 - TwistElimination.Dot(second.WeightedOwn, y) - first.Other * z.T3);
            nextZ.T3 -= TwistElimination.Dot(first.WeightedNext, y) + first.NextTwist * z.T3
                + second.NextOther * z.T2;
            nextZ.T2 -= TwistElimination.Dot(second.WeightedNext, y) + first.NextOther * z.T3
                + second.NextTwist * z.T2;
            TwistElimination.AddScaled(ref nextY, -z.T3, first.Below);
            TwistElimination.AddScaled(ref nextY, -z.T2, second.Below);
        }

        /// <summary>Solves for both, and takes their part and that of the next element's out of block j, before that
        /// block's own <see cref="BlockElimination.Backward"/>.</summary>
        public static void Backward(in TwistRow first, in TwistRow second, ref RodVector y, in RodVector nextY,
            ref RodVector z, in RodVector nextZ)
        {
            z.T2 -= second.Inverse * (TwistElimination.Dot(second.Below, nextY) + second.NextOther * nextZ.T3
                + second.NextTwist * nextZ.T2);
            z.T3 -= first.Inverse * (TwistElimination.Dot(first.Below, nextY) + first.NextTwist * nextZ.T3
                + first.NextOther * nextZ.T2 + first.Other * z.T2);
            TwistElimination.AddScaled(ref y, -z.T3, first.Own);
            TwistElimination.AddScaled(ref y, -z.T2, second.Own);
            TwistElimination.AddScaled(ref y, -nextZ.T3, first.Next);
            TwistElimination.AddScaled(ref y, -nextZ.T2, second.Next);
        }

        // What the pivot of one angle leaves in the next block and the next two angles.
        private static void Update(in TwistRow row, double toFirst, double toSecond, ref RodBlock next,
            ref TwistRow nextFirst, ref TwistRow nextSecond)
        {
            TwistElimination.AddSquare(ref next, row.Below, -row.Inverse);
            TwistElimination.AddScaled(ref nextFirst.Own, -row.Inverse * toFirst, row.Below);
            TwistElimination.AddScaled(ref nextSecond.Own, -row.Inverse * toSecond, row.Below);
            nextFirst.Diagonal -= row.Inverse * toFirst * toFirst;
            nextSecond.Diagonal -= row.Inverse * toSecond * toSecond;
            nextFirst.Other -= row.Inverse * toFirst * toSecond;
        }
    }
}
