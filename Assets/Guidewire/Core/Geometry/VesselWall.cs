using System;

namespace Guidewire.Core
{
    /// <summary>A vessel's wall as a thin ring in the tissue around it: how stiff it is under a line load along the
    /// vessel.</summary>
    public static class VesselWall
    {
        private const double Incompressible = 4.0 / 3.0;    // 1/(1 - nu^2) with nu = 1/2
        private const double OfCavity = 2.0 / 3.0;          // 1/(1 + nu)
        private const int Harmonics = 20000;

        /// <summary>Gives K, the line load over the displacement of the wall under it, Pa.</summary>
        /// <remarks>A ring of radius R and thickness h has D = E h^3/12 * 4/3 per length of vessel. Harmonic n >= 2 of
        /// its displacement w cos(n t) bends it without stretching, D (n^2 - 1)^2/R^4 (Timoshenko and Gere, Theory of
        /// Elastic Stability); n = 0 stretches it, 4/3 E h/R^2; n = 1 moves it. All press the surrounding tissue by
        /// k w, with k = 2/3 E_s/R that of a round cavity. A line load has 1/(2 pi R) in n = 0 and 1/(pi R) in each
        /// other harmonic. In a wide vessel this is Hetenyi's beam on a foundation, K = 2 sqrt(2) D^(1/4) k^(3/4).
        /// </remarks>
        /// <param name="modulus">E of the wall, Pa.</param>
        /// <param name="thickness">h, m.</param>
        /// <param name="radius">R, of the lumen, m.</param>
        /// <param name="surrounding">E_s, Young's modulus of the surrounding tissue, Pa.</param>
        public static double Stiffness(double modulus, double thickness, double radius, double surrounding)
        {
            double foundation = OfCavity * surrounding / radius;
            double bending = Incompressible * modulus * Math.Pow(thickness, 3) / 12.0 / Math.Pow(radius, 4);
            double compliance = 0.5 / (Incompressible * modulus * thickness / (radius * radius) + foundation)
                + 1.0 / foundation;
            for (int n = Harmonics; n >= 2; n--)
            {
                double bent = ((double)n * n - 1.0) * ((double)n * n - 1.0);
                compliance += 1.0 / (bending * bent + foundation);
            }
            return Math.PI * radius / compliance;
        }
    }

    /// <summary>How a wall gives way to the wire that presses on it: at each contact by its own displacement, while
    /// the wall elsewhere stays in place (Winkler's foundation).</summary>
    public sealed class WallSoftness
    {
        /// <summary>tipLength where none is given, m.</summary>
        public const double DefaultTipLength = 5e-3;

        /// <summary>u_max over the radius of the wire where none is given.</summary>
        public const double LimitOfRadius = 0.9;

        /// <param name="name">Where it is stated, such as vessel.</param>
        /// <param name="stiffness">K, Pa.</param>
        /// <param name="limit">u_max, m; 0: by the radius.</param>
        /// <param name="tipLength">m.</param>
        /// <param name="relaxationTime">s.</param>
        public WallSoftness(string name, double stiffness, double limit = 0.0,
            double tipLength = DefaultTipLength, double relaxationTime = 0.0)
        {
            Name = name;
            Stiffness = stiffness;
            Limit = limit;
            TipLength = tipLength;
            RelaxationTime = relaxationTime;
        }

        /// <summary>The key or the item of the parameters that states it.</summary>
        public string Name { get; }

        /// <summary>K, force per length of wire and displacement of the wall, Pa: more than 0.</summary>
        public double Stiffness { get; }

        /// <summary>u_max, displacement that the wall does not exceed, m; 0: <see cref="LimitOfRadius"/> times the
        /// wire's radius.</summary>
        public double Limit { get; }

        /// <summary>Length of wall that gives way with the tip, and times the angle in radians with a wall's edge, m:
        /// more than 0.</summary>
        public double TipLength { get; }

        /// <summary>Time in which the wall follows a force (Kelvin-Voigt), s; 0: at once.</summary>
        public double RelaxationTime { get; }

        /// <summary>K by place instead; null where it is the same everywhere.</summary>
        public WallRegions? Regions { get; set; }

        /// <summary>Says by how much a wire of a radius may displace a wall that stays where it is, m.</summary>
        internal double MaxOf(double radius) => Limit > 0.0 && Limit < radius ? Limit : LimitOfRadius * radius;
    }

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
