namespace Guidewire.Core
{
    /// <summary>User steering of the wire: set between two steps, read in the next.</summary>
    public sealed class Steering
    {
        /// <summary>Motion of sphere 0 along the first element in the next step (thesis eq. 3.6), units; negative
        /// values pull.</summary>
        public double Push { get; set; }

        /// <summary>Turn of element 0 about its own axis in the next step, rad.</summary>
        public double Turn { get; set; }

        /// <summary>Strain of an element at which a pbd wire slips in the hand; infinite: never.</summary>
        public double SlipStrain { get; set; } = double.PositiveInfinity;
    }
}
