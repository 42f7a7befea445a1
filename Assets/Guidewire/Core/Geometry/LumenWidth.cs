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
}
