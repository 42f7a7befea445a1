using System;

namespace Guidewire.Core
{
    /// <summary>When a hub that moved less than it was asked makes a run unreliable.</summary>
    internal static class Shortfall
    {
        private const double OfAsked = 1e-3;
        private const double OfLength = 1e-6;    // of the wire: the give of a hub that rests

        /// <summary>Whether a shortfall counts; all in one unit of length.</summary>
        /// <param name="shortfall">What is missing; negative where the hub went farther than asked.</param>
        /// <param name="asked">The motion that was asked, there and back both counted.</param>
        /// <param name="length">Of the wire.</param>
        public static bool Counts(double shortfall, double asked, double length) =>
            Math.Abs(shortfall) > Math.Max(OfAsked * asked, OfLength * length);
    }
}
