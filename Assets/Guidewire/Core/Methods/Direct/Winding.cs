using System;

namespace Guidewire.Core
{
    /// <summary>Divides a sudden rotation of a clamp into increments, each solved before the next, so that a rod is
    /// wound up instead of rotating through the smaller angle.</summary>
    internal static class Winding
    {
        private const double LargestTurn = 0.5;   // radians a part
        private const double MaxTurn = 10_000.0; // radians that are wound up at once at all

        /// <summary>Into how many parts a turn is split.</summary>
        /// <param name="turn">Radians.</param>
        /// <param name="parts">At least 1; of no use with a failure.</param>
        /// <returns>Null, or why it cannot be wound up.</returns>
        public static string? Split(double turn, out int parts)
        {
            double size = Math.Abs(turn);
            if (!(size <= MaxTurn))
            {
                parts = 0;
                return "a clamp turns by more than " + MaxTurn + " rad at once (distalRotation, twistPerStep)";
            }
            parts = 1 + (int)(size / LargestTurn);
            return null;
        }
    }
}
