using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Material of the wire along its length: piecewise constant between the borders of its sections, and its
    /// mean over an element.</summary>
    /// <remarks>Over an element that holds a border, compliances (1/EA, 1/GA), masses and rotary inertia are averaged
    /// by length. A joint turns the element after it against the one before it, each a straight line that stands for
    /// the mean direction of its piece of wire: the difference of two means is the integral of the curvature times the
    /// hat function that is 1 at the joint and falls to 0 at its neighbours. Compliances in bending and twist and the
    /// rest curvature are averaged with it; for an even element it counts half of it. A bent tip shorter than the last
    /// half element therefore turns that element by what it moves the tip. With the moment taken at the joint the
    /// error at a border is of second order in the element's length.</remarks>
    internal sealed class WireProfile
    {
        private const double Rounding = 1e-9;  // of an element: shorter parts of another piece are ignored

        private readonly double[] _border;     // units; of the pieces, first 0, last L
        private readonly CrossSection[] _piece;

        /// <summary>The wire of these parameters.</summary>
        public WireProfile(MaterialParameters material, double length)
        {
            var borders = new List<double> { 0.0, length };
            foreach (WireSection section in material.Sections)
            {
                if (!section.IsMarker)
                {
                    AddBorder(borders, section.From, length);
                    AddBorder(borders, section.To, length);
                }
            }
            borders.Sort();
            _border = borders.ToArray();
            _piece = new CrossSection[_border.Length - 1];
            for (int k = 0; k < _piece.Length; k++)
            {
                _piece[k] = CrossSection.At(material, 0.5 * (_border[k] + _border[k + 1]));
            }
        }

        /// <summary>Borders of the pieces, units, first 0, last L.</summary>
        public double[] Borders => _border;

        /// <summary>The pieces between them.</summary>
        public CrossSection[] Pieces => _piece;

        /// <summary>Sets all but the length of element j, which lies between these positions (units).</summary>
        public void SetElement(MaterialRod rod, int j, double from, double to)
        {
            double slack = Rounding * (to - from);
            int first = 0;
            while (first < _piece.Length - 1 && _border[first + 1] <= from + slack)
            {
                first++;
            }
            int last = first;
            while (last < _piece.Length - 1 && _border[last + 1] < to - slack)
            {
                last++;
            }
            if (first == last)
            {
                _piece[first].CopyTo(rod, j);
                return;
            }
            var mean = new Mean();
            var start = new Mean();
            var end = new Mean();
            for (int k = first; k <= last; k++)
            {
                // Fractions of the element, from 0 at its start to 1 at its end.
                double a = k == first ? 0.0 : (_border[k] - from) / (to - from);
                double b = k == last ? 1.0 : (_border[k + 1] - from) / (to - from);
                mean.Add(_piece[k], b - a);
                end.Add(_piece[k], b * b - a * a);
                start.Add(_piece[k], (b - a) * (2.0 - a - b));
            }
            mean.Result().CopyTo(rod, j);
            rod.SetSides(j, start.Result().Side, end.Result().Side);
        }

        private static void AddBorder(List<double> borders, double position, double length)
        {
            if (position > 0.0 && position < length && !borders.Contains(position))
            {
                borders.Add(position);
            }
        }

        /// <summary>A weighted mean: of compliances, densities and curvatures.</summary>
        private struct Mean
        {
            private double _stretch;
            private double _shear;
            private double _bend1;
            private double _bend2;
            private double _twist;
            private double _density;
            private double _rotary1;
            private double _rotary2;
            private Vector3d _curvature;
            private double _radius;   // the largest
            private double _core;

            public void Add(in CrossSection piece, double weight)
            {
                _stretch += weight / piece.StretchStiffness;
                _shear += weight / piece.ShearStiffness;
                _bend1 += weight / piece.BendStiffness1;
                _bend2 += weight / piece.BendStiffness2;
                _twist += weight / piece.TwistStiffness;
                _density += weight * piece.LineDensity;
                _rotary1 += weight * piece.RotaryInertia1;
                _rotary2 += weight * piece.RotaryInertia2;
                _curvature += weight * piece.RestCurvature;
                _radius = Math.Max(_radius, piece.Radius);
                _core = Math.Max(_core, piece.CoreRadius);
            }

            public CrossSection Result()
            {
                return new CrossSection
                {
                    StretchStiffness = 1.0 / _stretch,
                    ShearStiffness = 1.0 / _shear,
                    BendStiffness1 = 1.0 / _bend1,
                    BendStiffness2 = 1.0 / _bend2,
                    TwistStiffness = 1.0 / _twist,
                    LineDensity = _density,
                    RotaryInertia1 = _rotary1,
                    RotaryInertia2 = _rotary2,
                    RestCurvature = _curvature,
                    Radius = _radius,
                    CoreRadius = _core,
                };
            }
        }
    }
}
