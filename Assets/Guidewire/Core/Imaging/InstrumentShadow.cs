using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Adds instruments to a picture of optical depths: minus the logarithm of the transmitted fraction of a
    /// pixel's rays.</summary>
    /// <remarks><para>A straight piece of length L, outer radius r and lumen radius a at the angle theta to the rays is
    /// a strip of length L sin theta: at the distance s from its axis in the picture a ray's length in the wall is
    /// 2 (sqrt(r^2 - s^2) - sqrt(a^2 - s^2))/sin theta. A pixel is a square: across the strip its area is distributed
    /// as a trapezoid, the convolution of two boxes of the widths |n_x| and |n_y| for a normal n of the axis. What of
    /// the strip is in the pixel is cut across into <see cref="StripProfile.Parts"/> parts of equal width; each has
    /// the mean chord of its width (exact), and what passes is the mean of exp(-mu t) over the parts with their areas.
    /// So an instrument thinner than a pixel takes away as much wherever it lies between the pixels' middles.</para>
    /// <para>Along the axis the depth begins and ends over a pixel and over the mean extent e = (pi/2) r cos theta of
    /// the tilted end (a smoothed step), so that the windows of successive pieces add up to 1; at a free end the window
    /// is a part of the pixel. A piece that is shorter than
    /// that in the picture, as where a wire comes towards the detector, has the plateau of its volume over e, and goes
    /// over from the profile of a strip into the even thickness of an end, L/cos theta. Depths of pieces and of
    /// instruments add up. At free ends the axis is longer by 2 r/3: the volume of a hemisphere.</para></remarks>
    internal sealed class InstrumentShadow
    {
        private const double CapLength = 2.0 / 3.0;    // of the radius
        private const double Thinnest = 1e-3;          // pixels: least width of a smoothed step's corner

        private readonly int _pixels;
        private readonly float[] _depth;

        /// <param name="depth">Optical depths, row by row; they grow.</param>
        /// <param name="pixels">Of a side.</param>
        public InstrumentShadow(float[] depth, int pixels)
        {
            _depth = depth;
            _pixels = pixels;
        }

        /// <summary>Adds an instrument.</summary>
        public void Add(ImagedInstrument instrument, CArm arm)
        {
            Vector3d[] x = instrument.Positions;
            int last = x.Length - 2;
            for (int j = 0; j <= last; j++)
            {
                double r = instrument.Radii[j] * arm.Scale;
                double a = instrument.InnerRadii[j] * arm.Scale;
                double mu = instrument.Attenuations[j] / arm.Scale;
                Vector3d from = arm.ToDetector(x[j]);
                Vector3d to = arm.ToDetector(x[j + 1]);
                if (IsOutside(from, to, r) || !(mu > 0.0))
                {
                    continue;
                }
                int pieces = CentrelinePieces.IsBent(x, j) ? CentrelinePieces.PerBentElement : 1;
                for (int k = 1; k <= pieces; k++)
                {
                    to = k == pieces ? arm.ToDetector(x[j + 1])
                        : arm.ToDetector(CentrelinePieces.At(x, j, (double)k / pieces));
                    double before = j == 0 && k == 1 ? CapLength * r : 0.0;
                    double after = j == last && k == pieces ? CapLength * r : 0.0;
                    AddPiece(from, to, r, a, mu, before, after);
                    from = to;
                }
            }
        }

        /// <summary>Adds what is more opaque in the wall of an instrument.</summary>
        public void AddBands(ImagedInstrument instrument, CArm arm)
        {
            Vector3d[] x = instrument.Positions;
            foreach (OpaqueBand band in instrument.Bands)
            {
                int j = band.Element;
                double r = instrument.Radii[j] * arm.Scale;
                bool isBent = CentrelinePieces.IsBent(x, j);
                Vector3d At(double t) => arm.ToDetector(isBent ? CentrelinePieces.At(x, j, t)
                    : Vector3d.Lerp(x[j], x[j + 1], t));
                Vector3d from = At(band.From);
                if (IsOutside(from, At(band.To), r))
                {
                    continue;
                }
                int pieces = isBent ? CentrelinePieces.PerBentElement : 1;
                for (int k = 1; k <= pieces; k++)
                {
                    Vector3d to = At(band.From + (band.To - band.From) * k / pieces);
                    AddPiece(from, to, r, instrument.InnerRadii[j] * arm.Scale, band.Attenuation / arm.Scale, 0.0, 0.0);
                    from = to;
                }
            }
        }

        /// <summary>Adds a straight piece; all lengths are in pixels.</summary>
        /// <param name="from">Its one end, as of <see cref="CArm.ToDetector"/>.</param>
        /// <param name="to">Its other end.</param>
        /// <param name="r">Outer radius.</param>
        /// <param name="a">Radius of the lumen.</param>
        /// <param name="mu">Attenuation per pixel's side.</param>
        /// <param name="before">Length that is added at its one end.</param>
        /// <param name="after">Length that is added at its other end.</param>
        public void AddPiece(in Vector3d from, in Vector3d to, double r, double a, double mu, double before,
            double after)
        {
            Vector3d along = to - from;
            double length = along.Length;
            if (!(length > 0.0) || !along.IsFinite)
            {
                return;
            }
            Vector3d t = along / length;
            Vector3d start = from - before * t;
            length += before + after;
            double sin = Math.Sqrt(t.X * t.X + t.Y * t.Y);
            double cos = Math.Abs(t.Z);
            double ux = sin > 0.0 ? t.X / sin : 1.0;
            double uy = sin > 0.0 ? t.Y / sin : 0.0;
            double shown = Math.Max(sin * length, Thinnest);
            double tilt = Math.Max(0.5 * Math.PI * r * cos, Thinnest);
            double peak = Math.Min(1.0, shown / tilt);
            var strip = new StripProfile(r, a, mu * length / Math.Max(shown, tilt), peak,
                Math.Max(Math.Abs(uy), Thinnest), Math.Max(Math.Abs(ux), Thinnest));
            double outer = 0.5 * (tilt + 1.0);
            double beyond = strip.HalfWidth;
            int lastRow = Row(start.Y, uy * shown, beyond, outer, false);
            for (int row = Row(start.Y, uy * shown, beyond, outer, true); row <= lastRow; row++)
            {
                double y = row + 0.5 - start.Y;
                if (!Columns(start.X, y, ux, uy, beyond, shown, outer, out int first, out int end))
                {
                    continue;
                }
                for (int column = first; column < end; column++)
                {
                    double x = column + 0.5 - start.X;
                    double at = x * ux + y * uy;
                    double depth = strip.Depth(y * ux - x * uy);
                    double begins = Step(at, tilt);
                    double ends = Step(at - shown, tilt);
                    bool isFreeEnd = (before > 0.0 && begins < 1.0) || (after > 0.0 && ends > 0.0);
                    double window = (begins - ends) / peak;
                    _depth[row * _pixels + column] += (float)(isFreeEnd && peak == 1.0
                        ? -Math.Log(1.0 - window * (1.0 - Math.Exp(-depth))) : window * depth);
                }
            }
        }

        // A step at 0 that is smoothed by a pixel and by another width.
        private static double Step(double x, double width)
        {
            double half = 0.5 * (width + 1.0);
            return x <= -half ? 0.0 : x >= half ? 1.0 : StripProfile.Trapezoid(x, width, 1.0);
        }

        private bool IsOutside(in Vector3d from, in Vector3d to, double r)
        {
            // A cubic piece stays within its chord's length of it.
            double slack = 0.3 * Vector3d.Distance(from, to) + 2.0 * r + 2.0;
            return Math.Max(from.X, to.X) < -slack || Math.Min(from.X, to.X) > _pixels + slack
                || Math.Max(from.Y, to.Y) < -slack || Math.Min(from.Y, to.Y) > _pixels + slack;
        }

        // First or last row that a strip touches.
        private int Row(double start, double shown, double beyond, double outer, bool isFirst)
        {
            double slack = beyond + outer;
            double at = isFirst ? Math.Min(start, start + shown) - slack : Math.Max(start, start + shown) + slack;
            return (int)Math.Min(Math.Max(at - 0.5, 0.0), isFirst ? _pixels : _pixels - 1.0);
        }

        // Columns of a row whose pixel centres are within the strip.
        private bool Columns(double start, double y, double ux, double uy, double beyond, double shown, double outer,
            out int first, out int end)
        {
            double low = -0.5 - start;
            double high = _pixels - 0.5 - start;
            Cut(-uy, y * ux, -beyond, beyond, ref low, ref high);
            Cut(ux, y * uy, -outer, shown + outer, ref low, ref high);
            first = (int)Math.Max(0.0, Math.Ceiling(low + start - 0.5));
            end = (int)Math.Min(_pixels, Math.Floor(high + start - 0.5) + 1.0);
            return low <= high && first < end;
        }

        // Narrows [low, high] to where from <= slope x + offset <= to.
        private static void Cut(double slope, double offset, double from, double to, ref double low, ref double high)
        {
            if (Math.Abs(slope) < 1e-9)
            {
                if (offset < from || offset > to)
                {
                    high = double.NegativeInfinity;
                }
                return;
            }
            double one = (from - offset) / slope;
            double other = (to - offset) / slope;
            low = Math.Max(low, Math.Min(one, other));
            high = Math.Min(high, Math.Max(one, other));
        }
    }

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
