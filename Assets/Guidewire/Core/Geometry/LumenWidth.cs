using System;

namespace Guidewire.Core
{
    /// <summary>Width of a vessel's lumen along a path: the radius of the largest sphere centred in the plane across
    /// the path at each position. Lengths in units.</summary>
    /// <remarks>In a tube of numbers that is the radius of its knots. In a mesh the path is followed ball by ball, each
    /// centred across the path by a search whose last step is <see cref="Fineness"/> of the radius asked for where the
    /// lumen is no wider, so that such a width is found to about 1 %; at a branch the walk goes on straight. Where the
    /// lumen is narrower than the wire the direction of the walk is smoothed, so that it never turns back at a closed
    /// end.</remarks>
    internal sealed class LumenWidth
    {
        private const double Fineness = 0.005;
        private const double StepFraction = 0.25;   // from one position of the walk to the next
        private const double Ample = 4.0;            // radii, from which on nothing is centred
        private const int MaxSteps = 4000;
        private readonly ContactShape _wall;
        private readonly LumenSphere _ball;
        private readonly double _radius;

        /// <summary>The lumen of a vessel, for a wire of this radius.</summary>
        public LumenWidth(ContactShape wall, double radius)
        {
            _wall = wall;
            _ball = new LumenSphere(wall);
            _radius = radius;
        }

        /// <summary>The widest ball at the wire's first narrow position, where that is narrower than the wire; else at
        /// its tip.</summary>
        public double Width
        {
            get => _ball.Width;
            private set => _ball.Width = value;
        }

        /// <summary>Centre of that ball.</summary>
        public Vector3d Centre
        {
            get => _ball.Centre;
            private set => _ball.Centre = value;
        }

        /// <summary>True where the lumen is narrower than the wire at the wire itself, or before it as far as it is
        /// pushed. A lumen that ends there does not count: a wire stops at a vessel's end.</summary>
        /// <param name="wire">The wire's spheres, in the lumen.</param>
        /// <param name="travel">How far it is pushed, tip first; infinite if unknown.</param>
        public bool IsTooNarrow(Vector3d[] wire, double travel)
        {
            if (_wall is TubeShape tube)
            {
                return IsTooNarrow(tube, wire, travel);
            }
            if (!(_wall is MeshShape))
            {
                return false;
            }
            int tip = wire.Length - 1;
            for (int i = 0; i <= tip; i++)
            {
                Vector3d along = wire[Math.Min(i + 1, tip)] - wire[Math.Max(i - 1, 0)];
                Measure(wire[i], Vector3d.Normalize(along), i < tip ? _radius : Ample * _radius);
                if (Width < _radius * (1.0 - 2.0 * Fineness))
                {
                    return true;
                }
            }
            return NarrowsAhead(Vector3d.Normalize(wire[tip] - wire[tip - 1]), travel);
        }

        // From the ball at the tip on. What is narrower counts once the lumen has been as wide as the wire again, or
        // has let the walk out of an open rim; at a closed end the balls shrink to nothing.
        private bool NarrowsAhead(Vector3d along, double travel)
        {
            double tipWidth = Width;
            Vector3d tipCentre = Centre;
            double narrowest = double.PositiveInfinity;
            Vector3d narrow = Centre;
            double gone = 0.0;
            for (int k = 0; k < MaxSteps && gone < travel && Width > Fineness * _radius; k++)
            {
                Vector3d before = Centre;
                Vector3d next = before + (StepFraction * Math.Min(Width, Ample * _radius)) * along;
                bool isOut = !_wall.Contains(next);
                if (!isOut)
                {
                    Measure(next, along, Ample * _radius);
                    gone += Vector3d.Distance(before, Centre);
                    along = Width < _radius ? along
                        : Vector3d.Normalize(along + 0.5 * Vector3d.Normalize(Centre - before));
                    if (Width < narrowest)
                    {
                        narrowest = Width;
                        narrow = Centre;
                    }
                }
                if (narrowest < _radius * (1.0 - 2.0 * Fineness) && (isOut || Width >= _radius))
                {
                    Width = narrowest;
                    Centre = narrow;
                    return true;
                }
                if (isOut)
                {
                    break;
                }
            }
            Width = tipWidth;
            Centre = tipCentre;
            return false;
        }

        private void Measure(in Vector3d x, in Vector3d along, double enough) =>
            _ball.Climb(x, along, Fineness * _radius, enough, _radius);

        private bool IsTooNarrow(TubeShape tube, Vector3d[] wire, double travel)
        {
            double[] stations = Stations(tube);
            double proximal = StationOf(tube, stations, wire[0], out double atProximal);
            double tip = StationOf(tube, stations, wire[wire.Length - 1], out double atTip);
            RecordWidth(atTip, wire[wire.Length - 1]);
            if (atTip < _radius || atProximal < _radius)
            {
                RecordWidth(Math.Min(atTip, atProximal), atTip <= atProximal ? wire[wire.Length - 1] : wire[0]);
                return true;
            }
            bool forward = tip >= proximal;
            double from = forward ? proximal : tip - travel;
            double to = forward ? tip + travel : proximal;
            int last = tube.Knots.Length - 1;
            for (int k = 0; k <= last; k++)
            {
                int i = forward ? k : last - k;
                if (tube.Radii[i] < _radius && stations[i] > from && stations[i] < to
                    && ContinuesNarrow(tube, i, forward))
                {
                    RecordWidth(tube.Radii[i], tube.Knots[i]);
                    return true;
                }
            }
            return false;
        }

        // Whether a lumen that is too narrow at a knot is wide enough behind it, or open.
        private bool ContinuesNarrow(TubeShape tube, int knot, bool forward)
        {
            int end = forward ? tube.Knots.Length - 1 : 0;
            bool isOpen = forward ? tube.LastKnot < end : tube.FirstKnot > end;
            bool hasWidened = false;
            for (int i = knot; i != end; i += forward ? 1 : -1)
            {
                hasWidened |= tube.Radii[i + (forward ? 1 : -1)] >= _radius;
            }
            return isOpen || hasWidened;
        }

        private void RecordWidth(double width, in Vector3d centre)
        {
            Width = width;
            Centre = centre;
        }

        private static double[] Stations(TubeShape tube)
        {
            var stations = new double[tube.Knots.Length];
            for (int i = 1; i < stations.Length; i++)
            {
                stations[i] = stations[i - 1] + Vector3d.Distance(tube.Knots[i - 1], tube.Knots[i]);
            }
            return stations;
        }

        // Arc length of the piece's centre that is nearest to a point by the tube's own distance, and the radius there.
        private static double StationOf(TubeShape tube, double[] stations, in Vector3d x, out double radius)
        {
            double best = double.NegativeInfinity;
            double station = 0.0;
            radius = 0.0;
            for (int i = 0; i + 1 < stations.Length; i++)
            {
                double value = tube.PieceDistance(i, x, out Vector3d centre, out _);
                if (value > best)
                {
                    double fraction = Vector3d.Distance(tube.Knots[i], centre) / (stations[i + 1] - stations[i]);
                    best = value;
                    station = stations[i] + fraction * (stations[i + 1] - stations[i]);
                    radius = tube.Radii[i] + fraction * (tube.Radii[i + 1] - tube.Radii[i]);
                }
            }
            return station;
        }
    }

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
