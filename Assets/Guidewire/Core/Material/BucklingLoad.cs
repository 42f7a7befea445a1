using System;

namespace Guidewire.Core
{
    /// <summary>Axial forces at which an instrument bows out, by Euler's column. They are the limits of an operator's
    /// gauges, and no part of a step.</summary>
    public static class BucklingLoad
    {
        /// <summary>Length of a tip that is pressed, m: as data sheets of guidewires measure a tip load.</summary>
        public const double TipLength = 0.01;

        /// <summary>Length of a shaft between an operator's fingers and the valve that it is pushed through,
        /// m.</summary>
        public const double ShaftLength = 0.05;

        private const int Places = 64;

        /// <summary>Of the last <see cref="TipLength"/>, held behind it and pressed at its end, N. Rayleigh's quotient
        /// with the shape of an even column, exact for such a one.</summary>
        /// <param name="material">Of the instrument.</param>
        /// <param name="length">Of the instrument, units.</param>
        /// <param name="metres">Of a unit.</param>
        public static double OfTip(MaterialParameters material, double length, double metres)
        {
            double free = Math.Min(TipLength, length * metres);
            double sum = 0.0;
            for (int k = 0; k < Places; k++)
            {
                double along = (k + 0.5) / Places;    // from where it is held
                double cosine = Math.Cos(0.5 * Math.PI * along);
                double at = length - (1.0 - along) * free / metres;
                sum += 2.0 * cosine * cosine * CrossSection.At(material, at).BendStiffness1 / Places;
            }
            return 0.25 * Math.PI * Math.PI * sum / (free * free);
        }

        /// <summary>Of the shaft at its hub, its direction held at both ends of <see cref="ShaftLength"/>, N.</summary>
        /// <param name="material">Of the instrument.</param>
        public static double OfShaft(MaterialParameters material)
        {
            double stiffness = CrossSection.At(material, 0.0).BendStiffness1;
            return 4.0 * Math.PI * Math.PI * stiffness / (ShaftLength * ShaftLength);
        }
    }
}
