using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Checks whether another instrument can take the place of one of several coaxial ones.</summary>
    /// <remarks>It has to be withdrawn into the sheath, or one that is inside into the first element of the outermost
    /// one: there all are straight and touch no wall, and what takes its place does not move the others.</remarks>
    internal static class CoaxialExchange
    {
        private const double Rounding = 1e-6;   // of an element's length

        /// <summary>Why an instrument is not withdrawn at a time, in one phrase, or null.</summary>
        /// <param name="instrument">0 the outermost one.</param>
        public static string? FindInVessel(CoaxialSetup setup, CoaxialHubs hubs, int instrument, double time)
        {
            double first = setup.Catheter.Rod.Length[0];
            double most = Math.Max(setup.Sheath == null ? 0.0 : hubs.SheathedAt(time), instrument == 0 ? 0.0 : first);
            if (most == 0.0 && setup.Sheath == null)
            {
                return NameOf(setup, instrument) + " cannot be exchanged: without a sheath there is nothing into which "
                    + "it could be withdrawn";
            }
            double beyond = TipOf(setup, hubs, instrument, time) - most;
            return beyond <= Rounding * first ? null : Text(setup,
                "{0} needs to be withdrawn by {1:G4} mm more, into {2}", instrument, beyond,
                setup.Sheath != null ? "the sheath" : "the first element of " + NameOf(setup, 0));
        }

        /// <summary>Why instruments do not fit one another where their hubs are at a time, in one phrase, or
        /// null.</summary>
        public static string? FindMisfit(CoaxialSetup setup, CoaxialHubs hubs, double time)
        {
            double first = setup.Catheter.Rod.Length[0];
            double rounding = Rounding * first;
            for (int i = 1; i < setup.Instruments.Length; i++)
            {
                double behind = hubs.LeadAt(i - 1, time) - hubs.LeadAt(i, time);
                if (behind > rounding)
                {
                    return Text(setup, "{0} is {1:G4} mm too short: the hub of {2} would be behind its own", i,
                        behind, NameOf(setup, i - 1));
                }
                double missing = first - TipOf(setup, hubs, i, time);
                if (missing > rounding)
                {
                    return Text(setup, "{0} needs to reach {1:G4} mm farther, through the first element of {2}", i,
                        missing, NameOf(setup, 0));
                }
            }
            return null;
        }

        // m from the outermost hub.
        private static double TipOf(CoaxialSetup setup, CoaxialHubs hubs, int instrument, double time) =>
            setup.Instruments[instrument].Rod.TotalLength - hubs.LeadAt(instrument, time);

        private static string NameOf(CoaxialSetup setup, int instrument)
        {
            int wire = setup.Instruments.Length - 1;
            return instrument == wire ? "the wire" : wire == 1 ? "the catheter"
                : instrument == 0 ? "the outer catheter" : "the inner catheter";
        }

        // length: m.
        private static string Text(CoaxialSetup setup, string format, int instrument, double length, string more)
        {
            return string.Format(CultureInfo.InvariantCulture, format, NameOf(setup, instrument),
                1e3 * length, more);
        }
    }
}
