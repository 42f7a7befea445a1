using System;

namespace Guidewire.Core
{
    /// <summary>Material of an instrument along its length, from its hub: piecewise constant between borders.</summary>
    internal sealed class InstrumentProfile
    {
        private readonly double[] _border;      // m from the hub; first 0, last the length
        private readonly CrossSection[] _piece;

        /// <summary>Makes a profile of these pieces.</summary>
        /// <param name="borders">m, one more than there are pieces; first 0.</param>
        public InstrumentProfile(double[] borders, CrossSection[] pieces)
        {
            _border = borders;
            _piece = pieces;
        }

        /// <summary>Makes that of a wire.</summary>
        /// <param name="metres">Metres in one of the profile's units.</param>
        public InstrumentProfile(WireProfile profile, double metres)
            : this(Array.ConvertAll(profile.Borders, position => metres * position), profile.Pieces)
        {
        }

        /// <summary>The instrument's length, m.</summary>
        public double Length => _border[_border.Length - 1];

        /// <summary>The pieces.</summary>
        public CrossSection[] Pieces => _piece;

        /// <summary>Borders of the pieces, m from the hub.</summary>
        public double[] Borders => _border;

        /// <summary>The piece at a position, m from the hub; beyond its ends the last or first.</summary>
        public int PieceAt(double position)
        {
            int p = 0;
            while (p < _piece.Length - 1 && _border[p + 1] <= position)
            {
                p++;
            }
            return p;
        }

        /// <summary>What the instrument is made of at a position behind which its hub is by a lead, m; at a border what
        /// is before it.</summary>
        public ref readonly CrossSection PieceUpTo(double position, double lead)
        {
            int p = 0;
            while (p < _piece.Length - 1 && _border[p + 1] - lead < position)
            {
                p++;
            }
            return ref _piece[p];
        }

        /// <summary>The next border after a position behind which the hub is by a lead, m; infinite after the
        /// last.</summary>
        public double NextBorder(double position, double lead)
        {
            double next = double.PositiveInfinity;
            foreach (double border in _border)
            {
                next = border - lead > position ? Math.Min(next, border - lead) : next;
            }
            return next;
        }

        /// <summary>Integral over a part of the length of what a piece has per length.</summary>
        /// <param name="from">m from the hub, as is <paramref name="to"/>.</param>
        /// <param name="density">Of a piece, in a lumen of some radius, m.</param>
        public double Integral(double from, double to, Func<CrossSection, double, double> density,
            double lumenRadius = 0.0)
        {
            double sum = 0.0;
            for (int p = 0; p < _piece.Length; p++)
            {
                double length = Math.Min(to, _border[p + 1]) - Math.Max(from, _border[p]);
                sum += length > 0.0 ? length * density(_piece[p], lumenRadius) : 0.0;
            }
            return sum;
        }
    }
}
