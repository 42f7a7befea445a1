using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Walks along a lumen, in both directions from a point, to its narrowest cross-section, beyond which it
    /// widens again.
    /// Lengths in units.</summary>
    /// <remarks>The walk goes by balls that are centred across it (<see cref="LumenSphere"/>), along the direction e in
    /// which the lesser of d(c + h e) and d(c - h e) is largest, d the distance from the wall. It ends where the lumen
    /// has become wider than its narrowest by <see cref="WideningFactor"/>, or where d falls by more than half of the
    /// distance travelled: there is the end of the vessel, and the last <see cref="EndLength"/> widths before it do not
    /// count, because a corner has balls of any width. Where even short steps lead aside into a wider lumen the walk
    /// was in a fold of the wall, which is no throat. The result depends on d alone, not on how the wall is
    /// triangulated. A lumen that narrows to less than a wire without widening again holds the wire whatever its
    /// barriers are, and does not count.</remarks>
    internal sealed class LumenWalk
    {
        private const double StepFraction = 0.25;
        private const double WideningFactor = 1.05;
        private const double EndSlope = 0.5;
        private const double Fineness = 2e-3;        // of the width, during the walk
        private const double LastFineness = 2e-4;    // at the end of it
        private const double ShortestStep = 0.02;    // of the width, at the end of a vessel
        private const double Same = 0.5;             // of the width: positions that count as one
        private const double Probe = 0.5;            // h over d
        private const double MinTurn = 0.02;       // rad, of e
        private const double EndLength = 3.0;        // widths before an end of the vessel that do not count
        private const int MaxSteps = 2000;
        private const int Thirds = 16;               // of the last bracket
        private readonly LumenSphere _ball;
        private readonly double _above;
        private readonly List<(Vector3d Centre, double Width)> _walked = new List<(Vector3d, double)>();
        private readonly List<(double Travel, Vector3d Centre, Vector3d Along, double Width)> _path =
            new List<(double, Vector3d, Vector3d, double)>();
        private double _narrowest;
        private Vector3d _position;
        private Vector3d _along;

        /// <summary>Makes the walk for a wall, past positions that are wider than a radius.</summary>
        public LumenWalk(ContactShape wall, double above)
        {
            _ball = new LumenSphere(wall);
            _above = above;
        }

        /// <summary>The radius where the lumen is narrowest about a position in it; infinite where the walk was made
        /// before, the lumen narrows to what does not count, or it is wide enough.</summary>
        public double From(in Vector3d start, double enough)
        {
            double width = _ball.DistanceAt(start);
            if (!(width > 0.0) || IsWalked(start, width))
            {
                return double.PositiveInfinity;
            }
            Vector3d along = Turned(start, width, FirstDirection(start, width));
            _ball.Climb(start, along, Fineness * width, enough);
            if (_ball.Width >= enough || IsWalked(_ball.Centre, _ball.Width))
            {
                return double.PositiveInfinity;
            }
            Vector3d centre = _ball.Centre;
            double first = _ball.Width;
            if (!(first > _above))
            {
                return double.PositiveInfinity;
            }
            along = Turned(centre, first, along);
            _walked.Add((centre, first));
            _path.Clear();
            _path.Add((0.0, centre, along, first));
            _narrowest = first;
            return Walk(centre, first, along, 1.0, out double last)
                && Walk(centre, first, -along, -1.0, out double from)
                ? Bottom(from, last) : double.PositiveInfinity;
        }

        private bool IsWalked(in Vector3d x, double width)
        {
            foreach ((Vector3d position, double other) in _walked)
            {
                double near = Same * Math.Min(width, other);
                if ((position - x).LengthSquared < near * near)
                {
                    return true;
                }
            }
            return false;
        }

        // Towards one side, 1 or -1, up to where the lumen is wide again or ends. False where it becomes too narrow to
        // count. What counts ends some widths before an end of the vessel: near a corner of it any width is met.
        private bool Walk(Vector3d centre, double width, Vector3d along, double side, out double last)
        {
            double fraction = StepFraction;
            double travel = 0.0;
            bool isAside = false;
            last = double.PositiveInfinity;
            for (int k = 0; k < MaxSteps && fraction > ShortestStep && width <= WideningFactor * _narrowest; k++)
            {
                _ball.Climb(centre + fraction * width * along, along, Fineness * width, 2.0 * WideningFactor * width);
                double distance = Vector3d.Distance(centre, _ball.Centre);
                if (width - _ball.Width > EndSlope * distance || !(_ball.Width > 0.0))
                {
                    fraction *= 0.5;
                    continue;
                }
                Vector3d chord = Vector3d.Normalize(_ball.Centre - centre);
                if (Vector3d.Dot(chord, along) < 0.5)
                {
                    // The climb has moved into a wider neighbouring lumen.
                    fraction *= 0.5;
                    isAside = true;
                    continue;
                }
                isAside = false;
                fraction = Math.Min(2.0 * fraction, StepFraction);
                centre = _ball.Centre;
                width = _ball.Width;
                if (width <= _above)
                {
                    return false;
                }
                along = Turned(centre, width, chord);
                travel += distance;
                _walked.Add((centre, width));
                _path.Add((side * travel, centre, along, width));
                _narrowest = Math.Min(_narrowest, width);
            }
            if (isAside)
            {
                return false;
            }
            bool isWide = width > WideningFactor * _narrowest;
            last = side * (isWide ? double.PositiveInfinity : travel - EndLength * width);
            return true;
        }

        // The least width of the walk between two positions on it, by thirds of the distance, half a step to both sides
        // of the narrowest position.
        private double Bottom(double from, double last)
        {
            double least = double.PositiveInfinity;
            foreach ((double travel, Vector3d centre, Vector3d along, double width) in _path)
            {
                if (travel >= from && travel <= last && width < least)
                {
                    least = width;
                    _position = centre;
                    _along = along;
                }
            }
            if (double.IsInfinity(least))
            {
                return least;
            }
            _narrowest = least;
            double length = StepFraction * _narrowest;
            double low = -length;
            double high = length;
            for (int k = 0; k < Thirds; k++)
            {
                double a = low + (high - low) / 3.0;
                double b = high - (high - low) / 3.0;
                double atA = Across(a);
                double atB = Across(b);
                least = Inside(least, atA, Math.Abs(a));
                least = Inside(least, atB, Math.Abs(b));
                low = atA < atB ? low : a;
                high = atA < atB ? b : high;
            }
            return least;
        }

        // Not at the end of the vessel.
        private double Inside(double least, double width, double distance) =>
            width > _above && _narrowest - width <= EndSlope * distance ? Math.Min(least, width) : least;

        private double Across(double distance)
        {
            _ball.Climb(_position + distance * _along, _along, LastFineness * _narrowest,
                2.0 * WideningFactor * _narrowest);
            return _ball.Width;
        }

        private double Lesser(in Vector3d x, in Vector3d direction) =>
            Math.Min(_ball.DistanceAt(x + direction), _ball.DistanceAt(x - direction));

        // Of the axes, the diagonals of the faces and those of the cube.
        private Vector3d FirstDirection(in Vector3d x, double width)
        {
            Vector3d best = Vector3d.UnitZ;
            double most = double.NegativeInfinity;
            for (int k = 14; k < 27; k++)
            {
                Vector3d direction = Vector3d.Normalize(new Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
                double lesser = Lesser(x, Probe * width * direction);
                if (lesser > most)
                {
                    most = lesser;
                    best = direction;
                }
            }
            return best;
        }

        // The best direction near one.
        private Vector3d Turned(in Vector3d x, double width, in Vector3d first)
        {
            double h = Probe * width;
            Vector3d best = first;
            double most = Lesser(x, h * best);
            for (double turn = 0.3; turn > MinTurn; turn *= 0.5)
            {
                Vector3d u = Vector3d.Perpendicular(best);
                Vector3d v = Vector3d.Cross(best, u);
                for (int k = 0; k < 4; k++)
                {
                    Vector3d side = k % 2 == 0 ? u : v;
                    Vector3d direction = Vector3d.Normalize(best + (k < 2 ? turn : -turn) * side);
                    double lesser = Lesser(x, h * direction);
                    if (lesser > most)
                    {
                        most = lesser;
                        best = direction;
                    }
                }
            }
            return best;
        }
    }
}
