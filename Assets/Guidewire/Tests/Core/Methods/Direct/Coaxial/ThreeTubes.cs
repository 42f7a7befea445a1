using System;

namespace Guidewire.Core.Tests
{
    /// <summary>Three coaxial instruments that tests share.</summary>
    internal static class ThreeTubes
    {
        /// <summary>One with tips in the order of the instruments, each made of several pieces, with a rest twist and
        /// straight lengths between the hubs; tips and borders lie within elements.</summary>
        /// <param name="order">0: each tip beyond that around it; 1: that of the one between inside the outermost; 2:
        /// both inside; 3: the innermost inside the one between, which is beyond.</param>
        public static CoaxialPair Mixed(int order)
        {
            double middle = order == 0 || order == 3 ? 1.63 : order == 1 ? 1.165 : 1.02;
            double wire = order == 0 ? 2.3 : order == 1 ? 2.1 : order == 2 ? 1.49 : 1.74;
            var outer = new[]
            {
                new CoaxialPair.Piece(0.55, 3.0, 0.2, 0.0, 0.1), new CoaxialPair.Piece(0.45, 2.0, 0.9, 0.4),
            };
            var inner = new[]
            {
                new CoaxialPair.Piece(0.37, 1.0, 0.0, 0.3), new CoaxialPair.Piece(0.5, 1.2, 0.5, -0.3, 0.2),
                new CoaxialPair.Piece(middle - 0.87, 0.8, -0.7, 0.6),
            };
            var innermost = new[]
            {
                new CoaxialPair.Piece(0.8, 0.5, 0.0), new CoaxialPair.Piece(wire - 0.8, 0.4, 1.1, 0.7, -0.3),
            };
            int[] elements = { 4, 6, 8 };
            double[] leads = { 0.0, 0.213, 0.457 };
            return new CoaxialPair(new[] { outer, inner, innermost }, elements, 0.3, leads,
                Beyond(elements, new[] { 1.0, middle, wire }, leads));
        }

        /// <summary>How many nodes of each are beyond the tips around it.</summary>
        public static int[] Beyond(int[] elements, double[] lengths, double[] leads)
        {
            var beyond = new int[3];
            double tip = lengths[0];
            for (int i = 1; i < 3; i++)
            {
                double end = lengths[i] - leads[i];
                while (end - beyond[i] * lengths[i] / elements[i] > tip + 0.02 * lengths[i] / elements[i])
                {
                    beyond[i]++;
                }
                tip = Math.Max(tip, end);
            }
            return beyond;
        }

        /// <summary>Even tubes of length 1 from one hub.</summary>
        public static CoaxialPair Even(int n, double nu, double[] bends, double[] curvatures)
        {
            var pieces = new CoaxialPair.Piece[3][];
            for (int i = 0; i < 3; i++)
            {
                pieces[i] = new[] { new CoaxialPair.Piece(1.0, bends[i], curvatures[i]) };
            }
            return new CoaxialPair(pieces, new[] { n, n, n }, nu, new double[3], new int[3]);
        }
    }
}
