namespace Guidewire.Core
{
    /// <summary>One of several coaxial instruments, described as if it were alone.</summary>
    internal sealed class CoaxialInstrument
    {
        /// <summary>Makes an instrument.</summary>
        /// <param name="rod">Its elements.</param>
        /// <param name="profile">What it is made of.</param>
        /// <param name="lumenRadius">m; 0 leaves out the drag of the fluid in its lumen.</param>
        public CoaxialInstrument(MaterialRod rod, InstrumentProfile profile, double lumenRadius = 0.0)
        {
            Rod = rod;
            Profile = profile;
            LumenRadius = lumenRadius;
            Stations = new double[rod.ElementCount + 1];
            for (int j = 0; j < rod.ElementCount; j++)
            {
                Stations[j + 1] = Stations[j] + rod.Length[j];
            }
        }

        /// <summary>Its elements as a rod.</summary>
        public MaterialRod Rod { get; }

        /// <summary>What it is made of.</summary>
        public InstrumentProfile Profile { get; }

        /// <summary>Radius of its lumen, m; 0: the drag in it is left out.</summary>
        public double LumenRadius { get; }

        /// <summary>Distance of each of its nodes from its hub, m.</summary>
        public double[] Stations { get; }
    }
}
