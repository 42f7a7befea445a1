namespace Guidewire.Core
{
    /// <summary>A part of an element of an instrument whose wall takes more from X-rays than the element's material, as
    /// a marker does.</summary>
    public readonly struct OpaqueBand
    {
        /// <summary>A band.</summary>
        /// <param name="element">Where it is.</param>
        /// <param name="from">Where it begins, of the element's length.</param>
        /// <param name="to">Where it ends.</param>
        /// <param name="attenuation">By which the linear attenuation coefficient is larger, 1/unit.</param>
        public OpaqueBand(int element, double from, double to, double attenuation)
        {
            Element = element;
            From = from;
            To = to;
            Attenuation = attenuation;
        }

        /// <summary>Where it is.</summary>
        public int Element { get; }

        /// <summary>Where it begins, of the element's length.</summary>
        public double From { get; }

        /// <summary>Where it ends, of the element's length.</summary>
        public double To { get; }

        /// <summary>By which the linear attenuation coefficient is larger, 1/unit.</summary>
        public double Attenuation { get; }
    }
}
