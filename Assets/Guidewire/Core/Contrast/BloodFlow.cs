using System;

namespace Guidewire.Core
{
    /// <summary>How blood flows through a vessel's tree.</summary>
    public sealed class BloodFlow
    {
        /// <summary>Mean flow at the inlet, ml/s; null: such that its mean velocity is
        /// <see cref="UsualVelocity"/>.</summary>
        public double? Inlet { get; set; }

        /// <summary>Mean velocity at an inlet of which nothing is said, mm/s: 4 ml/s through a lumen of 5 mm, as
        /// through an
        /// internal carotid artery.</summary>
        public const double UsualVelocity = 200.0;

        /// <summary>Flow beyond each of the tree's points that follow a fork or the inlet, by the number of the point,
        /// ml/s or in
        /// any other unit: they count against those of the same fork. What is not said follows the radii
        /// cubed.</summary>
        public Func<int, double?> Given { get; set; } = _ => null;

        /// <summary>Dispersion coefficient over mean velocity and radius: 1 spreads a short bolus to a standard
        /// deviation of
        /// sqrt(2 r x) at a distance x.</summary>
        public double Dispersion { get; set; } = 1.0;

        /// <summary>Amplitude of the pulse over the mean flow, from 0 to 1: Q(t) = Q (1 + a sin(2 pi f t)).</summary>
        public double PulseAmplitude { get; set; }

        /// <summary>The pulse's rate f, 1/s.</summary>
        public double PulseRate { get; set; } = 1.0;

        /// <summary>What is wrong with these values in one phrase, or null.</summary>
        public string? FindProblem()
        {
            return Inlet is double flow && !(flow > 0.0 && flow <= 1e6)
                ? "flow needs to be a number > 0 and <= 1e6 (ml/s)"
                : !(Dispersion >= 0.0 && Dispersion <= 1e3) ? "dispersion needs to be a number from 0 to 1000 (radii)"
                : !(PulseAmplitude >= 0.0 && PulseAmplitude <= 1.0) ? "pulse needs an amplitude from 0 to 1"
                : !(PulseRate > 0.0 && PulseRate <= 100.0) ? "pulse needs a rate above 0 and up to 100 (1/s)" : null;
        }
    }
}
