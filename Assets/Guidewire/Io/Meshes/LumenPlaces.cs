using System;
using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Finds where instruments are in a vessel with a centreline; see <see cref="LumenPlace"/>. What it says
    /// depends on the instrument's points alone: it is the same in a run, in a session that goes on from a snapshot,
    /// and in a log.</summary>
    /// <remarks>A wire passes no wall, so it can only have left by an open end. Its elements are tested against the
    /// discs of the ends, and only where one leads out through a disc, or the tip is outside, every point is asked
    /// whether it is in the lumen. What lies behind the inlet, in the sheath, does not count.</remarks>
    internal sealed class LumenPlaces
    {
        private const double Disc = 1.5;    // radius of the disc over an end's: rims are neither round nor flat

        private readonly CentrelinePath _path;
        private readonly ContactShape _vessel;
        private readonly IReadOnlyList<VesselEnd> _ends;

        /// <param name="path">From the inlet, with the target.</param>
        /// <param name="ends">Of the vessel.</param>
        /// <param name="vessel">Its wall.</param>
        public LumenPlaces(CentrelinePath path, IReadOnlyList<VesselEnd> ends, ContactShape vessel)
        {
            _path = path;
            _ends = ends;
            _vessel = vessel;
        }

        /// <summary>Where an instrument with these points, from its hub to its tip, is.</summary>
        /// <param name="field">Where the vessel is, if it moves.</param>
        public LumenPlace Of(Vector3d[] points, WallField? field = null)
        {
            points = field == null ? points : Array.ConvertAll(points, point => field.AtRest(point));
            int last = points.Length - 1;
            bool isInside = _vessel.IsWithin(points[last]) && !MayHaveLeft(points);
            int front = isInside ? last : Front(points, out isInside);
            Vector3d place = front < 0 ? _path.Inlet.Centre : points[front];
            int near = front < 0 ? _path.Inlet.Point : _path.Locate(place);
            return new LumenPlace(isInside, field?.Moved(place) ?? place, near, _path.BranchOf(near),
                _path.DistanceOf(place, near), _path.LeftFrom(place, near), front >= 0 && _path.IsAtTarget(near));
        }

        private bool MayHaveLeft(Vector3d[] points)
        {
            for (int i = 0; i < _ends.Count; i++)
            {
                VesselEnd end = _ends[i];
                double before = Vector3d.Dot(points[0] - end.Centre, end.Direction);
                for (int k = 1; k < points.Length; k++)
                {
                    double after = Vector3d.Dot(points[k] - end.Centre, end.Direction);
                    if (before >= 0.0 && after < 0.0)
                    {
                        Vector3d crossing = Vector3d.Lerp(points[k - 1], points[k], before / (before - after));
                        if (Vector3d.Distance(crossing, end.Centre) < Disc * end.Radius)
                        {
                            return true;
                        }
                    }
                    before = after;
                }
            }
            return false;
        }

        // The last point before the first that is outside, counted from where the wire is a radius within the inlet;
        // -1 where none is inside.
        private int Front(Vector3d[] points, out bool isInside)
        {
            int first = 0;
            while (first < points.Length && !(IsBeyondInlet(points[first]) && _vessel.IsWithin(points[first])))
            {
                first++;
            }
            if (first == points.Length)
            {
                first = Array.FindIndex(points, point => _vessel.IsWithin(point));
                if (first < 0)
                {
                    isInside = false;
                    return -1;
                }
            }
            int next = first + 1;
            while (next < points.Length && _vessel.IsWithin(points[next]))
            {
                next++;
            }
            isInside = next == points.Length;
            return next - 1;
        }

        private bool IsBeyondInlet(in Vector3d point) =>
            Vector3d.Dot(point - _path.Inlet.Centre, _path.Inlet.Direction) >= 0.9 * _path.Inlet.Radius;
    }

    /// <summary>Where an instrument has come to in its vessel: the last point of it, seen from the hub, up to which it
    /// has not left the lumen. Of a tip in the lumen that is the tip; of one that left by an end, a point near that
    /// end, wherever the tip goes outside.</summary>
    public readonly struct LumenPlace
    {
        internal LumenPlace(bool isInside, in Vector3d point, int near, int branch, double distance, double left,
            bool isAtTarget)
        {
            IsInside = isInside;
            Point = point;
            Near = near;
            Branch = branch;
            Distance = distance;
            Left = left;
            IsAtTarget = isAtTarget;
        }

        /// <summary>Whether the tip is in the lumen, and all of the instrument between the inlet and it.</summary>
        public bool IsInside { get; }

        /// <summary>The last point up to which it is, units.</summary>
        public Vector3d Point { get; }

        /// <summary>The point of the centreline to whose sphere that belongs.</summary>
        public int Near { get; }

        /// <summary>The branch there, from 0.</summary>
        public int Branch { get; }

        /// <summary>The distance from the inlet along the centreline, units.</summary>
        public double Distance { get; }

        /// <summary>The distance from there to the target along the centreline, units; not a number where there is
        /// no target.</summary>
        public double Left { get; }

        /// <summary>Whether that is within a radius of the target along the centreline, or beyond it.</summary>
        public bool IsAtTarget { get; }
    }
}
