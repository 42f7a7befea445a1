using System;

namespace Guidewire.Core
{
    /// <summary>Penetration depth of the wire in a wall: r less the smallest distance of a sphere's centre or of a rod
    /// element's
    /// core line from any wall, r the element's own. A core line that cuts a wall has distance 0; beyond a wall
    /// distances are negative.</summary>
    /// <remarks>Spheres and elements that are known to lie less deep than the depth found so far are skipped.</remarks>
    internal sealed class WireDepth
    {
        private readonly IContactSearch _search;
        private readonly ContactShape[] _walls;
        private readonly double[] _radius;      // of elements, units
        private readonly int[] _elementHint;    // where the nearest point was, per wall and element
        private readonly int[] _sphereHint;

        /// <param name="search">Its walls and radius; it knows for each element a lower bound of its distance from the
        /// walls at the start of a motion.</param>
        /// <param name="radius">r of the n elements, units.</param>
        public WireDepth(IContactSearch search, double[] radius)
        {
            int elementCount = radius.Length;
            _search = search;
            _walls = search.Walls;
            _radius = radius;
            _elementHint = new int[_walls.Length * elementCount];
            _sphereHint = new int[_walls.Length * (elementCount + 1)];
            Array.Fill(_elementHint, -1);
            Array.Fill(_sphereHint, -1);
        }

        /// <summary>Depth of the wire, or <paramref name="known"/> where that is more; units.</summary>
        public double Deepest(Vector3d[] x, double known)
        {
            for (int w = 0; w < _walls.Length; w++)
            {
                for (int j = 0; j + 1 < x.Length; j++)
                {
                    known = Deepest(w, j, x, known);
                }
            }
            return known;
        }

        /// <summary>The same after the motion that was last searched for contacts.</summary>
        public double Deepest(Vector3d[] from, Vector3d[] to, double known)
        {
            for (int j = 0; j + 1 < to.Length; j++)
            {
                double motion = Math.Max(Vector3d.Distance(from[j], to[j]), Vector3d.Distance(from[j + 1], to[j + 1]));
                for (int w = 0; w < _walls.Length; w++)
                {
                    if (_radius[j] - (_search.ClearanceOf(w, j) - motion) > known)
                    {
                        known = Deepest(w, j, to, known);
                    }
                }
            }
            return known;
        }

        private double Deepest(int w, int j, Vector3d[] x, double known)
        {
            int n = x.Length - 1;
            double radius = _radius[j];
            known = Deepest(w, radius, x[j], x[j + 1], known, ref _elementHint[w * n + j]);
            if (!_search.GuardsSpheres)
            {
                known = Deepest(w, radius, x[j], x[j], known, ref _sphereHint[w * (n + 1) + j]);
                known = Deepest(w, radius, x[j + 1], x[j + 1], known, ref _sphereHint[w * (n + 1) + j + 1]);
            }
            return known;
        }

        // A guarded wire is beyond no wall: beside a vessel that it left by an open rim it counts by its distance.
        private double Deepest(int w, double radius, in Vector3d a, in Vector3d b, double known, ref int hint)
        {
            double range = _search.GuardsSpheres ? Math.Max(0.0, radius - known) : double.PositiveInfinity;
            if (!_walls[w].Nearest(a, b, range, ref hint, out SurfaceContact contact))
            {
                return known;
            }
            double distance = _search.GuardsSpheres
                ? _walls[w].UnsignedDistance(contact.Distance) : contact.Distance;
            if (distance < 0.0 && radius - distance > known)
            {
                distance = _walls[w].MinAlong(a, b, distance);
            }
            return Math.Max(known, radius - distance);
        }
    }
}
