namespace Guidewire.Core
{
    /// <summary>How fast instruments and the exit of a sheath move along a chain, over the speed of the hub by whose
    /// position a derivative is.</summary>
    internal sealed class HubSpeeds
    {
        /// <summary>Of so many instruments; nothing moves.</summary>
        public HubSpeeds(int count)
        {
            Instruments = new double[count];
        }

        /// <summary>The speed of each instrument.</summary>
        public double[] Instruments { get; }

        /// <summary>The speed of the exit.</summary>
        public double Exit { get; set; }
    }
}
