using System;

namespace Guidewire.Core
{
    /// <summary>Stiffness of a vessel's wall by place: that of the sphere of the centreline that a point belongs
    /// to.</summary>
    /// <remarks>A point belongs to the sphere of the least |x - c|^2 - r^2. It is that of the cell around it, whose
    /// edge is a quarter of the smallest radius: cells that were asked for are kept, as many as there is room for. What
    /// is found does not depend on what was asked before.</remarks>
    public sealed class WallRegions
    {
        private const double CellOfRadius = 0.25;
        private const int Kept = 1 << 14;

        private readonly Vector3d[] _centres;
        private readonly double[] _radii;
        private readonly double[] _stiffness;
        private readonly double _cell;            // units
        private readonly (long X, long Y, long Z)[] _keys = new (long X, long Y, long Z)[Kept];
        private readonly double[] _found = new double[Kept];    // 0: none

        /// <param name="centres">Of the spheres, units.</param>
        /// <param name="radii">Their radii, more than 0.</param>
        /// <param name="stiffness">K of each, Pa.</param>
        public WallRegions(Vector3d[] centres, double[] radii, double[] stiffness)
        {
            _centres = centres;
            _radii = radii;
            _stiffness = stiffness;
            double least = double.PositiveInfinity;
            foreach (double radius in radii)
            {
                least = radius > 0.0 ? Math.Min(least, radius) : least;
            }
            _cell = CellOfRadius * least;
            foreach (double one in stiffness)
            {
                Softest = Math.Min(Softest, one);
                Stiffest = Math.Max(Stiffest, one);
            }
        }

        /// <summary>The least K, Pa.</summary>
        public double Softest { get; } = double.PositiveInfinity;

        /// <summary>The largest K, Pa.</summary>
        public double Stiffest { get; }

        /// <summary>K at a point, units.</summary>
        public double StiffnessAt(in Vector3d x)
        {
            (long X, long Y, long Z) key = ((long)Math.Floor(x.X / _cell), (long)Math.Floor(x.Y / _cell),
                (long)Math.Floor(x.Z / _cell));
            int place = (int)(((ulong)(key.X * 73856093L ^ key.Y * 19349663L ^ key.Z * 83492791L)) % Kept);
            if (_found[place] == 0.0 || _keys[place] != key)
            {
                _keys[place] = key;
                _found[place] = Find(_cell * new Vector3d(key.X + 0.5, key.Y + 0.5, key.Z + 0.5));
            }
            return _found[place];
        }

        private double Find(in Vector3d x)
        {
            int best = 0;
            double least = double.PositiveInfinity;
            for (int k = 0; k < _centres.Length; k++)
            {
                double power = (x - _centres[k]).LengthSquared - _radii[k] * _radii[k];
                if (power < least)
                {
                    least = power;
                    best = k;
                }
            }
            return _stiffness[best];
        }
    }
}
