using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>The noise of counted quanta, from a seed: the sum of the four bytes of a hash of seed and pixel, which
    /// is near to a normal distribution. Integers of 32 bits only, so that a shader has the same noise.</summary>
    internal static class QuantumNoise
    {
        // Mean, and variance 4 (256^2 - 1)/12, of the sum of four bytes.
        private const int Mean = 510;
        private static readonly float PerDeviation = (float)(1.0 / Math.Sqrt(4.0 * 65535.0 / 12.0));

        /// <summary>Gives what a seed contributes to every pixel's hash.</summary>
        public static uint Start(uint seed) => Mixed(seed ^ 0x9e3779b9u);

        /// <summary>Gives a pixel's deviation, in standard deviations.</summary>
        /// <param name="start">Of the seed.</param>
        /// <param name="pixel">Its number.</param>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static float At(uint start, uint pixel)
        {
            uint h = Mixed(start + pixel);
            uint pairs = (h & 0x00ff00ffu) + ((h >> 8) & 0x00ff00ffu);
            return ((int)((pairs & 0xffffu) + (pairs >> 16)) - Mean) * PerDeviation;
        }

        // lowbias32 by C. Wellons.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static uint Mixed(uint h)
        {
            h ^= h >> 16;
            h *= 0x7feb352du;
            h ^= h >> 15;
            h *= 0x846ca68bu;
            return h ^ (h >> 16);
        }
    }
}
