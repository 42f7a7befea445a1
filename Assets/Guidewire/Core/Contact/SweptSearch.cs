using System;

namespace Guidewire.Core
{
    /// <summary>Finds where a displacement of the wire would pass a wall (swept tests).</summary>
    /// <remarks>The start of every motion is clear of the wall by induction: a motion is only accepted when the swept
    /// test finds it clear, and the wire does not move at all where nothing else is. An element whose distance at the
    /// start is known to exceed the displacement of its ends cannot meet the wall and is not swept.</remarks>
    internal sealed class SweptSearch
    {
        private readonly IContactSearch _search;
        private readonly ContactShape[] _walls;
        private readonly double _clearance;

        /// <param name="search">Its walls and radius; which parts of the wire it guards, and what it knows of their
        /// distance at the start of the motion.</param>
        /// <param name="sphereCount">n + 1.</param>
        public SweptSearch(IContactSearch search, int sphereCount)
        {
            _search = search;
            _walls = search.Walls;
            _clearance = ClearanceFor(search.Radius);
            Impacts = new StructList<WireContact>(2 * sphereCount);
        }

        /// <summary>What the last <see cref="Find"/> met, along the wire: each guarded sphere's and element's first
        /// impact.</summary>
        public StructList<WireContact> Impacts { get; }

        /// <summary>Clearance between core line and wall in the swept test, units: enough to stay clear of rounding,
        /// too little to matter.</summary>
        public static double ClearanceFor(double radius) => 1e-3 * radius;

        /// <summary>Lists every point where the motion would pass a wall; true when there is one.</summary>
        /// <param name="from">Where the n + 1 spheres are, clear of the walls; units.</param>
        /// <param name="to">Where they would go.</param>
        public bool Find(Vector3d[] from, Vector3d[] to)
        {
            Impacts.Clear();
            bool wasHit = false;
            for (int i = 0; i < to.Length; i++)
            {
                WireContact element = default;
                bool isHit = i + 1 < to.Length && ElementImpact(from, to, i, out element) < ContactShape.NoImpact;

                // A sphere is an end of its elements: where they are free, it is.
                if ((wasHit || isHit || !_search.GuardsElements)
                    && SphereImpact(from, to, i, out WireContact sphere) < ContactShape.NoImpact)
                {
                    Impacts.Add(sphere);
                }
                if (isHit)
                {
                    Impacts.Add(element);
                }
                wasHit = isHit;
            }
            return Impacts.Count > 0;
        }

        /// <summary>Fraction of the motion after which sphere i meets a wall, <see cref="ContactShape.NoImpact"/> where
        /// it meets none or is not guarded.</summary>
        public double SphereImpact(Vector3d[] from, Vector3d[] to, int i, out WireContact impact)
        {
            impact = default;
            if (!_search.GuardsSpheres)
            {
                return ContactShape.NoImpact;
            }
            return Impact(from, to, i, i, out impact);
        }

        /// <summary>Gives the same for the rod element from sphere j to sphere j + 1.</summary>
        public double ElementImpact(Vector3d[] from, Vector3d[] to, int j, out WireContact impact)
        {
            impact = default;
            return _search.GuardsElements
                ? Impact(from, to, j, j + 1, out impact) : ContactShape.NoImpact;
        }

        private double Impact(Vector3d[] from, Vector3d[] to, int i, int k, out WireContact impact)
        {
            impact = default;
            double motion = Math.Max(Vector3d.Distance(from[i], to[i]), Vector3d.Distance(from[k], to[k]));
            double first = ContactShape.NoImpact;
            if (motion == 0.0)
            {
                return first;
            }
            for (int w = 0; w < _walls.Length; w++)
            {
                if (motion + _clearance < ClearanceOf(w, i, k, to.Length - 1))
                {
                    continue;
                }
                double time = _walls[w].TimeOfImpact(from[i], from[k], to[i], to[k], _clearance, out SurfaceContact at);
                if (time < first)
                {
                    first = time;
                    impact = new WireContact(w, i, i != k, at);
                }
            }
            return first;
        }

        // Lower bound of the distance of an element, or of a sphere by its elements.
        private double ClearanceOf(int w, int i, int k, int elementCount)
        {
            if (i != k)
            {
                return _search.ClearanceOf(w, i);
            }
            return Math.Max(
                i > 0 ? _search.ClearanceOf(w, i - 1) : 0.0, i < elementCount ? _search.ClearanceOf(w, i) : 0.0);
        }
    }
}
