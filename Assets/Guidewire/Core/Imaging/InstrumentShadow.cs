using System;

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
}
