using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Across a straight piece of an instrument in a picture: the optical depth of a pixel at a distance from
    /// its axis, as <see cref="InstrumentShadow"/> derives it. All lengths are in pixels.</summary>
    /// <remarks>The mean of exp(-d) over a part whose depth d goes from one value to another, D apart, is exp of the
    /// mean depth times 1 + D^2/24 + ..: with it six parts are enough for an opaque wire.</remarks>
    internal readonly struct StripProfile
    {
        /// <summary>Parts of what of a piece is in a pixel.</summary>
        public const int Parts = 6;

        private const double Opaque = 1e-12;    // least part that passes
        private const double MaxSpread = 3.0;  // beyond that a part takes nearly all

        private readonly double _r;
        private readonly double _a;
        private readonly double _perChord;   // optical depth per chord of the cross-section
        private readonly double _even;       // optical depth that is the same everywhere
        private readonly double _one;        // widths of the two boxes
        private readonly double _other;

        /// <param name="r">Outer radius.</param>
        /// <param name="a">Radius of the lumen.</param>
        /// <param name="perChord">Attenuation times the length of the ray per chord of the cross-section.</param>
        /// <param name="round">How much of the depth goes with the chord, in [0, 1]; the rest is even.</param>
        /// <param name="one">A pixel's width across, of the one pair of its sides; above 0.</param>
        /// <param name="other">Of the other pair; above 0.</param>
        public StripProfile(double r, double a, double perChord, double round, double one, double other)
        {
            _r = r;
            _a = a;
            _perChord = round * perChord;
            _even = (1.0 - round) * perChord * 0.5 * Math.PI * (r - a) * (r + a) / r;
            _one = one;
            _other = other;
        }

        /// <summary>Distance from the axis beyond which the piece is invisible.</summary>
        public double HalfWidth => _r + 0.5 * (_one + _other);

        /// <summary>Gives the integral up to x of the convolution of two boxes of these widths, above 0, and of area
        /// 1.</summary>
        public static double Trapezoid(double x, double one, double other)
        {
            double half = 0.5 * (one + other);
            double inner = 0.5 * (one - other);
            return (Ramp(x + half) - Ramp(x + inner) - Ramp(x - inner) + Ramp(x - half)) / (one * other);
        }

        /// <summary>Minus the logarithm of the part of a pixel's rays that pass.</summary>
        /// <param name="distance">Of the pixel's middle from the axis.</param>
        public double Depth(double distance)
        {
            double wide = 0.5 * (_one + _other);
            double low = Math.Max(-_r, distance - wide);
            double step = (Math.Min(_r, distance + wide) - low) / Parts;
            if (!(step > 0.0))
            {
                return 0.0;
            }
            double chord = ChordIntegral.At(low / _r);
            double lumen = _a > 0.0 ? ChordIntegral.At(low / _a) : 0.0;
            double side = Wall(low);
            double area = Trapezoid(low - distance, _one, _other);
            double taken = 0.0;
            for (int k = 1; k <= Parts; k++)
            {
                double edge = low + k * step;
                double nextChord = ChordIntegral.At(edge / _r);
                double wall = _r * _r * (nextChord - chord);
                chord = nextChord;
                if (_a > 0.0)
                {
                    double nextLumen = ChordIntegral.At(edge / _a);
                    wall -= _a * _a * (nextLumen - lumen);
                    lumen = nextLumen;
                }
                double nextSide = Wall(edge);
                double spread = Math.Min(_perChord * Math.Abs(nextSide - side), MaxSpread);
                side = nextSide;
                double nextArea = Trapezoid(edge - distance, _one, _other);
                double passed = Math.Exp(-(_perChord * wall / step + _even)) * (1.0 + spread * spread / 24.0);
                taken += (nextArea - area) * (1.0 - passed);
                area = nextArea;
            }
            return -Math.Log(Math.Max(1.0 - taken, Opaque));
        }

        // Length of the ray in the wall at a distance from the axis, as a chord of the cross-section.
        private double Wall(double s)
        {
            double outer = Math.Sqrt(Math.Max(0.0, _r * _r - s * s));
            return 2.0 * (_a > 0.0 ? outer - Math.Sqrt(Math.Max(0.0, _a * _a - s * s)) : outer);
        }

        private static double Ramp(double x) => x > 0.0 ? 0.5 * x * x : 0.0;
    }

    /// <summary>Integral of the chord of a unit circle over the distance from its middle, F(u) = integral from 0 to u
    /// of 2 sqrt(1 - s^2) ds = u sqrt(1 - u^2) + asin u, constant beyond the circle; from a table, linear between its
    /// entries. The mean chord of a circle of radius r between the distances a and b is r^2 (F(b/r) - F(a/r))/(b - a).
    /// </summary>
    internal static class ChordIntegral
    {
        private const int Entries = 4096;
        private static readonly double[] Table = Create();

        /// <summary>Gives F(u), off by less than 4e-6.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double At(double u)
        {
            if (u <= -1.0)
            {
                return -0.5 * Math.PI;
            }
            if (!(u < 1.0))
            {
                return 0.5 * Math.PI;
            }
            double at = 0.5 * Entries * (u + 1.0);
            int k = (int)at;
            double low = Table[k];
            return low + (at - k) * (Table[k + 1] - low);
        }

        private static double[] Create()
        {
            var table = new double[Entries + 2];
            for (int k = 0; k < table.Length; k++)
            {
                double u = Math.Min(1.0, 2.0 * k / Entries - 1.0);
                table[k] = u * Math.Sqrt(Math.Max(0.0, 1.0 - u * u)) + Math.Asin(u);
            }
            return table;
        }
    }

    /// <summary>Cuts the centreline of an instrument into straight pieces: a cubic through all points whose slope at
    /// point i is (x_{i+1} - x_{i-1})/2, as other pictures draw it; an element that is straight is one piece.</summary>
    internal static class CentrelinePieces
    {
        /// <summary>Pieces of an element that is not straight.</summary>
        public const int PerBentElement = 4;

        // An element whose chord is this much longer over its neighbours than its distance from their line, squared
        // sine of the angle: 0.02 rad. Over 5 mm the curve is then within 0.013 mm of the chord.
        private const double StraightSquared = 4e-4;

        /// <summary>Whether element j is drawn as several pieces.</summary>
        public static bool IsBent(Vector3d[] x, int j) => IsBentAt(x, j) || IsBentAt(x, j + 1);

        /// <summary>Gives the point of element j at t in [0, 1].</summary>
        public static Vector3d At(Vector3d[] x, int j, double t)
        {
            int last = x.Length - 1;
            Vector3d chord = x[j + 1] - x[j];
            Vector3d before = j > 0 ? 0.5 * (x[j + 1] - x[j - 1]) : chord;
            Vector3d after = j + 2 <= last ? 0.5 * (x[j + 2] - x[j]) : chord;
            double s = 1.0 - t;
            return s * s * (1.0 + 2.0 * t) * x[j] + t * t * (3.0 - 2.0 * t) * x[j + 1] + t * s * s * before
                - t * t * s * after;
        }

        private static bool IsBentAt(Vector3d[] x, int i)
        {
            if (i == 0 || i == x.Length - 1)
            {
                return false;
            }
            Vector3d a = x[i] - x[i - 1];
            Vector3d b = x[i + 1] - x[i];
            return Vector3d.Cross(a, b).LengthSquared > StraightSquared * a.LengthSquared * b.LengthSquared
                || Vector3d.Dot(a, b) < 0.0;
        }
    }
}
