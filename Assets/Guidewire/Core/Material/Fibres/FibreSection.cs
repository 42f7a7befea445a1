using System;

namespace Guidewire.Core
{
    /// <summary>A round section as a bundle of fibres along the wire, each with a law that has a memory: a plateau from
    /// which it comes back, or yield from which it does not.</summary>
    /// <remarks>A fibre at (x, y) has the strain eps = kappa1 y - kappa2 x and the stress E (eps - e). Its own strain e
    /// minimises E (eps - e)^2/2 + H e^2/2 + c |e| + d |e - e_n| with |e| at most e_max, e_n that of the step before.
    /// Nitinol has c and d = the mean and half the difference of its plateau stresses, steel c = 0 and d its yield
    /// stress (generalised standard materials, Halphen and Nguyen 1975). What this adds to the linear section is
    ///   w = sum W (-E eps e + (E + H) e^2/2 + c |e| + d |e - e_n|),
    /// exactly 0 while elastic, and never as negative in its second derivative as -EI of the fibres.
    ///
    /// Fibres lie on rings at Gauss-Legendre points of r^2, so that area and EI are exact; alternate rings are turned
    /// by half a step. Law and section are odd: opposite fibres share a state.</remarks>
    internal sealed class FibreSection
    {
        private readonly double _young;       // E, Pa
        private readonly double _hardening;   // H, Pa
        private readonly double _mean;        // c, Pa
        private readonly double _half;        // d, Pa
        private readonly double _most;        // e_max
        private readonly double _inverse;     // 1/(E + H)
        private readonly double _reach;       // of the outermost fibre, m
        private readonly double[] _x;         // of one of each two opposite fibres, m
        private readonly double[] _y;
        private readonly double[] _area;      // of both, m^2

        /// <summary>A round section of this law.</summary>
        /// <param name="young">E, Pa.</param>
        /// <param name="radius">Of the core, m.</param>
        /// <param name="innerRadius">Of its hollow, m.</param>
        public FibreSection(MaterialLaw law, double young, double radius, double innerRadius)
        {
            Law = law;
            Radius = radius;
            _young = young;
            _hardening = law.Hardening ?? MaterialLaw.DefaultHardening * young;
            _mean = law.IsSuperelastic ? 0.5 * (law.Upper + law.Lower) : 0.0;
            _half = law.IsSuperelastic ? 0.5 * (law.Upper - law.Lower) : law.Upper;
            _most = law.IsSuperelastic ? law.Strain : double.PositiveInfinity;
            _inverse = 1.0 / (_young + _hardening);
            int rings = law.Rings;
            int half = 2 * (rings - 1);       // half of the angles
            _x = new double[rings * half];
            _y = new double[_x.Length];
            _area = new double[_x.Length];
            double hollow = innerRadius * innerRadius;
            double span = radius * radius - hollow;
            for (int i = 0; i < rings; i++)
            {
                (double point, double weight) = GaussLegendre.At(rings, i);
                double r = Math.Sqrt(hollow + 0.5 * span * (1.0 + point));
                _reach = Math.Max(_reach, r);
                for (int j = 0; j < half; j++)
                {
                    double angle = Math.PI * (j + 0.5 * (i % 2)) / half;
                    _x[i * half + j] = r * Math.Cos(angle);
                    _y[i * half + j] = r * Math.Sin(angle);
                    _area[i * half + j] = 0.5 * Math.PI * span * weight / half;
                }
            }
        }

        /// <summary>The law of its fibres.</summary>
        public MaterialLaw Law { get; }

        /// <summary>Radius of the core, m.</summary>
        public double Radius { get; }

        /// <summary>How many states the section has.</summary>
        public int StateCount => _area.Length;

        /// <summary>Strain at which the first fibre leaves the line.</summary>
        public double ElasticStrain => (_mean + _half) / _young;

        /// <summary>Whether a section without memory stays on its line at this curvature, rad/m.</summary>
        public bool IsElastic(double kappa1, double kappa2) =>
            _young * _reach * Math.Sqrt(kappa1 * kappa1 + kappa2 * kappa2) <= _mean + _half;

        /// <summary>Energy of the correction w and its derivatives by the curvature.</summary>
        /// <param name="states">e_n of the fibres, from an index on.</param>
        /// <param name="result">Added to, times a length, m.</param>
        public void Add(double kappa1, double kappa2, double[] states, int from, double length,
            ref FibreCurve result)
        {
            double slope = -_young * _young * _inverse;
            for (int i = 0; i < _area.Length; i++)
            {
                double strain = kappa1 * _y[i] - kappa2 * _x[i];
                double before = states[from + i];
                double own = Own(strain, before);
                if (own == 0.0 && before == 0.0)
                {
                    continue;
                }
                double weight = length * _area[i];
                result.Energy += weight * (own * (0.5 * (_young + _hardening) * own - _young * strain)
                    + _mean * Math.Abs(own) + _half * Math.Abs(own - before));
                double force = -_young * weight * own;
                result.Moment1 += force * _y[i];
                result.Moment2 -= force * _x[i];
                if (own != before && own != 0.0 && Math.Abs(own) < _most)
                {
                    double stiffness = slope * weight;
                    result.Slope11 += stiffness * _y[i] * _y[i];
                    result.Slope12 -= stiffness * _x[i] * _y[i];
                    result.Slope22 += stiffness * _x[i] * _x[i];
                }
            }
        }

        /// <summary>Adds e of the fibres, times a length, m, to sums.</summary>
        public void AddOwn(double kappa1, double kappa2, double[] states, int from, double length, double[] sums,
            int at)
        {
            for (int i = 0; i < _area.Length; i++)
            {
                sums[at + i] += length * Own(kappa1 * _y[i] - kappa2 * _x[i], states[from + i]);
            }
        }

        /// <summary>Derivative of w where e_n changes by the difference of two states, J/m.</summary>
        public double Towards(double kappa1, double kappa2, double[] states, int from, double[] own, double[] others,
            int at)
        {
            double sum = 0.0;
            for (int i = 0; i < _area.Length; i++)
            {
                double before = states[from + i];
                double change = others[at + i] - own[at + i];
                if (change == 0.0)
                {
                    continue;
                }
                double strain = kappa1 * _y[i] - kappa2 * _x[i];
                double now = Own(strain, before);
                double slope = now == before
                    ? (_young + _hardening) * now - _young * strain + _mean * Math.Sign(now)
                    : -_half * Math.Sign(now - before);
                sum += _area[i] * change * Math.Max(-_half, Math.Min(_half, slope));
            }
            return sum;
        }

        /// <summary>The share of the section whose fibres have left their line.</summary>
        public double ShareBeyond(double[] states, int from)
        {
            double beyond = 0.0;
            double all = 0.0;
            for (int i = 0; i < _area.Length; i++)
            {
                all += _area[i];
                beyond += states[from + i] != 0.0 ? _area[i] : 0.0;
            }
            return beyond / all;
        }

        /// <summary>Bends a section without memory about d1 and lets it go.</summary>
        /// <param name="curvature">That it is bent to, rad/m.</param>
        /// <param name="stiffness">EI of all of the wire there, N m^2.</param>
        /// <param name="states">0; receives e of its fibres.</param>
        /// <returns>The curvature that is left, rad/m.</returns>
        public double Shape(double curvature, double stiffness, double[] states)
        {
            // Along a path on which no strain turns back one step is exact.
            var bent = new double[states.Length];
            AddOwn(curvature, 0.0, states, 0, 1.0, bent, 0);
            double low = Math.Min(0.0, curvature);
            double high = Math.Max(0.0, curvature);
            for (int k = 0; k < 100; k++)
            {
                double middle = 0.5 * (low + high);
                var curve = default(FibreCurve);
                Add(middle, 0.0, bent, 0, 1.0, ref curve);
                (low, high) = stiffness * middle + curve.Moment1 > 0.0 ? (low, middle) : (middle, high);
            }
            Array.Clear(states, 0, states.Length);
            AddOwn(0.5 * (low + high), 0.0, bent, 0, 1.0, states, 0);
            return 0.5 * (low + high);
        }

        /// <summary>Curvature that is left where the couple is gone, in a section that yields, rad/m: as much as its
        /// fibres would bend all of it.</summary>
        /// <param name="stiffness">EI of all of the wire there, N m^2.</param>
        public double Kept(double[] states, int from, double stiffness)
        {
            double first = 0.0;
            double second = 0.0;
            for (int i = 0; i < _area.Length; i++)
            {
                double force = _young * _area[i] * states[from + i];
                first += force * _y[i];
                second -= force * _x[i];
            }
            return Law.IsSuperelastic ? 0.0 : Math.Sqrt(first * first + second * second) / stiffness;
        }

        // The minimiser e. The slope by e, (E + H) e - E eps + c sign(e) + d sign(e - e_n), grows and jumps at 0 and at
        // e_n.
        private double Own(double strain, double before)
        {
            double stress = _young * strain;
            double low = Math.Min(0.0, before);
            double high = Math.Max(0.0, before);
            double own = (stress - _mean - _half) * _inverse;
            if (own <= high)
            {
                own = (stress + _mean + _half) * _inverse;
                if (own >= low)
                {
                    double between = before >= 0.0 ? stress - _mean + _half : stress + _mean - _half;
                    own = Math.Max(low, Math.Min(high, between * _inverse));
                }
            }
            return Math.Max(-_most, Math.Min(_most, own));
        }
    }

    /// <summary>An energy and its derivatives by two curvatures.</summary>
    internal struct FibreCurve
    {
        public double Energy;      // J
        public double Moment1, Moment2;
        public double Slope11, Slope12, Slope22;
    }

    /// <summary>The mandrel over which a wire is bent, and what of the bend its core keeps.</summary>
    public static class Mandrel
    {
        private const int Bisections = 100;

        /// <summary>Gives the curvature on the mandrel and what of it remains, rad/m; null where no core yields in the
        /// middle of the bend, or where none keeps so much.</summary>
        /// <param name="metres">Of a unit.</param>
        public static (double Bent, double Kept)? Find(Shaping shaped, MaterialParameters material, double metres)
        {
            CrossSection here = CrossSection.At(material, 0.5 * (shaped.From + shaped.To));
            if (!(here.Fibres is FibreSection section) || section.Law.IsSuperelastic)
            {
                return null;
            }
            double Kept(double curvature) =>
                section.Shape(curvature, here.BendStiffness1, new double[section.StateCount]);
            if (shaped.Radius is double radius)
            {
                double on = 1.0 / (metres * radius + here.Radius);
                return (on, Kept(on));
            }
            double asked = Math.Abs(shaped.Angle!.Value) / (metres * (shaped.To - shaped.From));
            double low = 0.0;
            double high = 1.0 / here.Radius;
            if (Kept(high) < asked)
            {
                return null;
            }
            for (int k = 0; k < Bisections; k++)
            {
                double middle = 0.5 * (low + high);
                (low, high) = Kept(middle) < asked ? (middle, high) : (low, middle);
            }
            return (high, asked);
        }

        /// <summary>Gives the radius of the mandrel, units.</summary>
        /// <param name="bent">Curvature on it, rad/m.</param>
        public static double RadiusOf(Shaping shaped, double bent, MaterialParameters material, double metres) =>
            (1.0 / bent - CrossSection.At(material, 0.5 * (shaped.From + shaped.To)).Radius) / metres;

        /// <summary>Gives the strain of the core's outermost fibre on the mandrel.</summary>
        /// <param name="bent">Curvature on it, rad/m.</param>
        public static double StrainOf(Shaping shaped, double bent, MaterialParameters material) =>
            bent * CrossSection.At(material, 0.5 * (shaped.From + shaped.To)).Fibres!.Radius;
    }
}
