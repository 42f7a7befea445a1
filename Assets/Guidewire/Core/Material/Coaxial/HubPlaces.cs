using System;

namespace Guidewire.Core
{
    /// <summary>Where instruments and the sheath around them are along a chain.</summary>
    internal sealed class HubPlaces
    {
        private const double Rounding = 1e-14;    // of a length
        /// <summary>Of so many instruments, all hubs in one place.</summary>
        public HubPlaces(int count)
        {
            Leads = new double[count];
            Ends = new double[count];
        }

        /// <summary>How far each hub is behind the outermost one's, m.</summary>
        public double[] Leads { get; }

        /// <summary>Where the instruments end, m from the outermost hub.</summary>
        public double[] Ends { get; }

        /// <summary>Sets where an instrument ends, m. A tip that only rounding takes from the outer instrument's last
        /// node is there, so that rounding does not choose the side of it.</summary>
        /// <param name="node">That node, m from the outermost hub.</param>
        public void SetEnd(int instrument, double end, double node) =>
            Ends[instrument] = Math.Abs(end - node) <= Rounding * node ? node : end;

        /// <summary>Where the sheath ends, m from the outermost hub.</summary>
        public double Sheathed { get; set; }

        /// <summary>The fraction of what joint k of a chain stands for, weighted by its hat function, that is not in
        /// the sheath.</summary>
        /// <param name="station">Of the nodes, m from the outermost hub.</param>
        /// <param name="last">Of them.</param>
        public double FractionOutside(int k, double[] station, int last)
        {
            double node = station[k];
            if (Sheathed <= (k > 0 ? station[k - 1] : node))
            {
                return 1.0;
            }
            double before = k > 0 ? node - station[k - 1] : 0.0;
            double after = k < last ? station[k + 1] - node : 0.0;
            double beyond = Sheathed < node ? after + (node - Sheathed) * (1.0 + (Sheathed - node + before) / before)
                : after > 0.0 ? Math.Pow(Math.Max(0.0, node + after - Sheathed), 2.0) / after : 0.0;
            return beyond / (before + after);
        }
    }
}
