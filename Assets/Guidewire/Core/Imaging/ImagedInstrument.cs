using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A wire or a catheter as X-rays see it: n + 1 points of its centreline, and for each of the n elements
    /// between them its radii and its attenuation.</summary>
    public sealed class ImagedInstrument
    {
        /// <summary>Makes an instrument as a picture shows it.</summary>
        /// <param name="positions">Points of the centreline, units; at least two.</param>
        /// <param name="radii">Outer radius of each element, units.</param>
        /// <param name="innerRadii">Radius of each element's lumen, units; 0: none.</param>
        /// <param name="attenuations">Linear attenuation coefficient of each element's material, 1/unit.</param>
        /// <exception cref="ArgumentException">Arrays of other lengths.</exception>
        public ImagedInstrument(Vector3d[] positions, double[] radii, double[] innerRadii, double[] attenuations)
        {
            int n = positions.Length - 1;
            if (n < 1 || radii.Length != n || innerRadii.Length != n || attenuations.Length != n)
            {
                throw new ArgumentException("an instrument needs two points at least, and the radii and the attenuation"
                    + " of each element between them");
            }
            Positions = positions;
            Radii = radii;
            InnerRadii = innerRadii;
            Attenuations = attenuations;
        }

        /// <summary>Points of the centreline, units.</summary>
        public Vector3d[] Positions { get; set; }

        /// <summary>Outer radius of each element, units.</summary>
        public double[] Radii { get; }

        /// <summary>Radius of each element's lumen, units.</summary>
        public double[] InnerRadii { get; }

        /// <summary>Linear attenuation coefficient of each element's material, 1/unit.</summary>
        public double[] Attenuations { get; }

        /// <summary>What in its wall is more opaque, such as markers.</summary>
        public IReadOnlyList<OpaqueBand> Bands { get; set; } = Array.Empty<OpaqueBand>();
    }

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
