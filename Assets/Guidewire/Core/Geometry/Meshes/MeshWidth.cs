using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Smallest width of the lumen of a mesh, found by walks along it (<see
    /// cref="LumenWalk"/>) that start from balls touching the wall.</summary>
    /// <remarks>The balls are those of the shrinking ball (Ma, Bae and Choi 2012): starting with one that is too large,
    /// the wall point q nearest to its centre gives the ball through p and q with the same normal, of radius |p -
    /// q|^2/(2 n . (q - p)), until no point is nearer than p. The points p are spread evenly over the wall's area, and
    /// no walk starts from balls no smaller than the narrowest so far: so the same surface has the same width however
    /// it is triangulated.</remarks>
    internal static class MeshWidth
    {
        private const int MaxSamples = 600_000;
        private const int MinSamples = 2_000;
        private const double SamplesOverRadius = 2.0;    // in a square of the least radius
        private const double SmallestSphere = 0.7;            // of that radius: smaller balls lie in folds of the wall
        private const int MaxShrinks = 30;
        private const double Converged = 2e-3;    // of a ball's radius squared
        private const double MinRadius = 1e-6;    // of the mesh's size, for a radius

        /// <summary>The smallest radius between two, units; infinite where there is none.</summary>
        public static double Narrowest(ContactShape wall, MeshGeometry mesh, double above, double below)
        {
            double area = 0.0;
            double size = 0.0;
            for (int t = 0; t < mesh.FaceNormals.Length; t++)
            {
                area += Area(mesh, t);
                size = Math.Max(size, Vector3d.Distance(mesh.Corners[3 * t], mesh.Corners[0]));
            }
            double least = Math.Max(above, MinRadius * size);
            double samples = SamplesOverRadius * area / (least * least);
            double cell = area / Math.Min(Math.Max(samples, MinSamples), MaxSamples);
            var walk = new LumenWalk(wall, least);
            double narrowest = below;
            double covered = 0.5 * cell;
            for (int t = 0; t < mesh.FaceNormals.Length; t++)
            {
                covered += Area(mesh, t);
                if (covered < cell)
                {
                    continue;
                }
                int rows = (int)Math.Ceiling(Math.Sqrt(Math.Floor(covered / cell)));
                covered %= cell;
                for (int k = 0; k < rows * rows; k++)
                {
                    double start = Math.Min(size, narrowest);
                    double radius = Ball(mesh, t, PlaceOn(mesh, t, k, rows), start, out Vector3d centre);
                    if (radius < start && radius > SmallestSphere * least)
                    {
                        narrowest = Math.Min(narrowest, walk.From(centre, start));
                    }
                }
            }
            return narrowest < below ? narrowest : double.PositiveInfinity;
        }

        private static double Area(MeshGeometry mesh, int triangle)
        {
            Vector3d a = mesh.Corners[3 * triangle];
            return 0.5 * Vector3d.Cross(mesh.Corners[3 * triangle + 1] - a, mesh.Corners[3 * triangle + 2] - a).Length;
        }

        // The middle of the k-th of rows^2 equal parts of a triangle: in row i 2 i + 1 of them, alternately upright and
        // inverted.
        private static Vector3d PlaceOn(MeshGeometry mesh, int triangle, int k, int rows)
        {
            int i = (int)Math.Sqrt(k + 0.5);
            int j = k - i * i;
            bool isUpright = j % 2 == 0;
            double u = (i - j / 2 + (isUpright ? 1.0 : -1.0) / 3.0) / rows;
            double v = (j / 2 + (isUpright ? 1.0 : 2.0) / 3.0) / rows;
            Vector3d a = mesh.Corners[3 * triangle];
            return a + u * (mesh.Corners[3 * triangle + 1] - a)
                + v * (mesh.Corners[3 * triangle + 2] - a);
        }

        private static double Ball(MeshGeometry mesh, int triangle, in Vector3d p, double start, out Vector3d centre)
        {
            Vector3d n = mesh.FaceNormals[triangle];
            double radius = start;
            int hint = triangle;
            centre = p + radius * n;
            for (int k = 0; k < MaxShrinks; k++)
            {
                int nearest = mesh.Tree.Nearest(
                    centre, centre, radius, hint, out double squared, out _, out Vector3d q, out _);
                double towards = 2.0 * Vector3d.Dot(n, q - p);
                if (nearest < 0 || squared >= (1.0 - Converged) * radius * radius || !(towards > 0.0))
                {
                    return radius;
                }
                hint = nearest;
                radius = (q - p).LengthSquared / towards;
                centre = p + radius * n;
            }
            return radius;
        }
    }

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
