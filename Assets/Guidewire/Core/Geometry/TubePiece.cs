using System;

namespace Guidewire.Core
{
    /// <summary>A straight piece of a tube: the union of all balls whose centre c(u) runs from one knot to the next
    /// while their radius R(u) changes linearly.</summary>
    internal readonly struct TubePiece
    {
        private readonly Vector3d _from;
        private readonly Vector3d _axis;      // of the piece's length
        private readonly double _length;
        private readonly double _radius;      // at its start
        private readonly double _slope;       // of the radius
        private readonly double _root;        // sqrt(1 - slope^2)
        private readonly Vector3d _middle;
        private readonly double _extent;      // no point of it is farther from the middle

        /// <summary>The piece between two knots.</summary>
        public TubePiece(in Vector3d from, in Vector3d to, double startRadius, double endRadius)
        {
            _from = from;
            _axis = to - from;
            _length = _axis.Length;
            _radius = startRadius;
            _slope = (endRadius - startRadius) / _length;
            _root = Math.Sqrt(1.0 - _slope * _slope);
            _middle = Vector3d.Lerp(from, to, 0.5);
            _extent = (0.5 * _length + Math.Max(startRadius, endRadius)) * (1.0 + 1e-12);
        }

        /// <summary>max over u in [0, 1] of R(u) - |x - c(u)|, the centre that gives it, and where along the piece that
        /// centre would lie if the piece had no ends: from 0 to 1 between its knots.</summary>
        /// <remarks>With h the distance of x from the line, z its foot's arc length and k the slope of the radius,
        /// |k| &lt; 1, the maximum of R0 + k y - sqrt(h^2 + (z - y)^2) lies at y = z + k h/sqrt(1 - k^2).</remarks>
        public double Distance(in Vector3d x, out Vector3d centre, out double along)
        {
            Vector3d offset = x - _from;
            double z = Vector3d.Dot(offset, _axis) / _length;
            double h = Vector3d.Cross(_axis, offset).Length / _length;
            double free = z + _slope * h / _root;
            double y = Math.Min(Math.Max(free, 0.0), _length);
            along = free / _length;
            centre = _from + (y / _length) * _axis;
            return _radius + _slope * y - Vector3d.Distance(x, centre);
        }

        /// <summary>True where the distance at x is surely less than this; cheaper than the distance.</summary>
        public bool IsBelow(in Vector3d x, double distance)
        {
            double reach = _extent - distance;
            return reach < 0.0 || (x - _middle).LengthSquared > reach * reach;
        }
    }
}
