using System;

namespace Guidewire.Core
{
    /// <summary>The largest sphere in a lumen centred in a plane across a direction, for walks along a vessel. In
    /// units.</summary>
    internal sealed class LumenSphere
    {
        private const double Golden = 0.6180339887498949;
        private const double Coarse = 0.25;   // the last step over the room that is left
        private const int Sections = 12;
        private readonly ContactShape _wall;
        private int _hint = -1;

        /// <summary>Makes a sphere in the lumen of this wall.</summary>
        public LumenSphere(ContactShape wall)
        {
            _wall = wall;
        }

        /// <summary>The sphere's radius.</summary>
        public double Width { get; set; } = double.PositiveInfinity;

        /// <summary>The sphere's centre.</summary>
        public Vector3d Centre { get; set; }

        /// <summary>Climbs from x to the middle of the lumen across a direction, or to where the ball is large enough:
        /// eight directions in turn, the step doubled where one leads up and halved where none does, nor a ridge. No
        /// step leaves the ball, hence none leaves the lumen.</summary>
        /// <remarks>Between two walls that meet at an angle the distance rises along the ridge between them alone, in a
        /// cone no wider than that angle, which eight directions miss. The ridge passes between the ends of a line
        /// across it: there the distance is largest.</remarks>
        /// <param name="finest">The last step.</param>
        /// <param name="enough">Radius.</param>
        /// <param name="needed">Radius: the more room there is beyond it, the coarser is the last step.</param>
        public void Climb(in Vector3d x, in Vector3d along, double finest, double enough,
            double needed = double.PositiveInfinity)
        {
            Vector3d u = Vector3d.Perpendicular(along);
            Vector3d v = Vector3d.Cross(along, u);
            Centre = x;
            Width = DistanceAt(x);
            double step = 0.5 * Width;
            while (step > Math.Max(finest, Coarse * (Width - needed)) && Width < enough)
            {
                Vector3d start = Centre;
                double width = Width;
                for (int k = 0; k < 8; k++)
                {
                    double angle = 0.25 * Math.PI * k;
                    Vector3d other = start + step * (Math.Cos(angle) * u + Math.Sin(angle) * v);
                    double distance = DistanceAt(other);
                    if (distance > Width)
                    {
                        Width = distance;
                        Centre = other;
                    }
                }
                for (int k = 0; k < 4 && !(Width > width); k++)
                {
                    Vector3d forward = k % 2 == 0 ? u : v;
                    FollowMaximum(start + (k < 2 ? step : -step) * forward, step * (k % 2 == 0 ? v : u));
                }
                step = Width > width ? Math.Min(2.0 * step, 0.5 * Width) : 0.5 * step;
            }
        }

        // To the largest ball on the line from middle - half to middle + half, if that is larger: golden section.
        private void FollowMaximum(in Vector3d middle, in Vector3d half)
        {
            double low = -0.7;    // with the step to the middle, within the ball
            double high = 0.7;
            double a = high - Golden * (high - low);
            double b = low + Golden * (high - low);
            double atA = DistanceAt(middle + a * half);
            double atB = DistanceAt(middle + b * half);
            for (int k = 0; k < Sections; k++)
            {
                if (atA < atB)
                {
                    low = a;
                    (a, atA) = (b, atB);
                    b = low + Golden * (high - low);
                    atB = DistanceAt(middle + b * half);
                }
                else
                {
                    high = b;
                    (b, atB) = (a, atA);
                    a = high - Golden * (high - low);
                    atA = DistanceAt(middle + a * half);
                }
            }
            double width = Math.Max(atA, atB);
            if (width > Width)
            {
                Width = width;
                Centre = middle + (atA > atB ? a : b) * half;
            }
        }

        /// <summary>Gives the signed distance from the wall.</summary>
        public double DistanceAt(in Vector3d x)
        {
            _wall.Nearest(x, x, double.PositiveInfinity, ref _hint, out SurfaceContact contact);
            return contact.Distance;
        }
    }
}
