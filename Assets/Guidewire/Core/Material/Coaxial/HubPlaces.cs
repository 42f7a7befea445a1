namespace Guidewire.Core
{
    /// <summary>Where instruments and the sheath around them are along a chain.</summary>
    internal sealed class HubPlaces
    {
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

        /// <summary>Where the sheath ends, m from the outermost hub.</summary>
        public double Sheathed { get; set; }
    }
}
