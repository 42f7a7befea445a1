using System;

namespace Guidewire.Core
{
    /// <summary>The widest ball in a lumen across a direction, for walks along a vessel. In units.</summary>
    internal sealed class LumenBall
    {
        private readonly ContactShape _wall;
        private int _hint = -1;

        /// <summary>In the lumen of this wall.</summary>
        public LumenBall(ContactShape wall)
        {
            _wall = wall;
        }

        /// <summary>Radius.</summary>
        public double Width { get; set; } = double.PositiveInfinity;

        /// <summary>Centre.</summary>
        public Vector3d Centre { get; set; }

        /// <summary>Climbs from x to the middle of the lumen across a direction, or to where the ball is large enough:
        /// eight directions in turn, the step doubled where one leads up and halved where none does. No step leaves the
        /// ball, hence none leaves the lumen.</summary>
        /// <param name="finest">The last step.</param>
        /// <param name="enough">Radius.</param>
        public void Climb(in Vector3d x, in Vector3d along, double finest, double enough)
        {
            Vector3d u = Vector3d.Perpendicular(along);
            Vector3d v = Vector3d.Cross(along, u);
            Centre = x;
            Width = DistanceAt(x);
            double step = 0.5 * Width;
            while (step > finest && Width < enough)
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
                step = Width > width ? Math.Min(2.0 * step, 0.5 * Width) : 0.5 * step;
            }
        }

        /// <summary>Signed distance from the wall.</summary>
        public double DistanceAt(in Vector3d x)
        {
            _wall.Nearest(x, x, double.PositiveInfinity, ref _hint, out SurfaceContact contact);
            return contact.Distance;
        }
    }
}
