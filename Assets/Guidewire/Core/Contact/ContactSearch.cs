using System;

namespace Guidewire.Core
{
    /// <summary>Finds the spheres and rod elements near the walls, without any response. One implementation per contact
    /// rule, chosen once.</summary>
    internal interface IContactSearch : IWallClearance
    {
        /// <summary>Whether spheres may not pass a wall, so that the swept test looks for points where they
        /// would.</summary>
        bool GuardsSpheres { get; }

        /// <summary>Whether rod elements may not pass either.</summary>
        bool GuardsElements { get; }

        /// <summary>What the last search found, wall by wall and along the wire.</summary>
        StructList<WireContact> Contacts { get; }

        /// <summary>The impacts that the swept test found; without stops there the motion would pass the wall.
        /// </summary>
        StructList<WireContact> Impacts { get; }

        /// <summary>Finds the contacts of a motion of the wire.</summary>
        /// <param name="from">Where the n + 1 spheres are, units; under a rule that guards, clear of the walls.</param>
        /// <param name="to">Where the prediction takes them.</param>
        void Find(Vector3d[] from, Vector3d[] to);
    }

    /// <summary>Lower bounds of the distances between a wire's elements and walls.</summary>
    internal interface IWallClearance
    {
        /// <summary>The walls from which distances count.</summary>
        ContactShape[] Walls { get; }

        /// <summary>Radius of the wire, its least where it varies, units.</summary>
        double Radius { get; }

        /// <summary>Lower bound of the distance of element j from wall w at the start of the motion under test,
        /// units.</summary>
        double ClearanceOf(int w, int j);
    }

    /// <summary>A sphere or a rod element that is near a wall, and where.</summary>
    internal readonly struct WireContact
    {
        /// <summary>The wall, by its index in the scene's list.</summary>
        public readonly int Wall;

        /// <summary>The sphere, 0 to n, or the rod element, 0 to n - 1, from sphere Index to Index + 1.</summary>
        public readonly int Index;

        /// <summary>True for a rod element, false for a sphere.</summary>
        public readonly bool IsElement;

        /// <summary>Where it comes nearest to the wall; its position runs along the element.</summary>
        public readonly SurfaceContact Nearest;

        /// <summary>Makes a contact with these values.</summary>
        public WireContact(int wall, int index, bool isElement, in SurfaceContact nearest)
        {
            Wall = wall;
            Index = index;
            IsElement = isElement;
            Nearest = nearest;
        }
    }

    /// <summary>Searches for spheres and, unless switched off, rod elements near the walls.</summary>
    /// <remarks>One search an element tells whether anything is in range. Only then the two spheres are searched; where
    /// the element touches with an end, the sphere's own contact represents it and, where spheres leave gaps, the
    /// element's middle half is searched: a long element in a bend lies against the outer wall with its ends and
    /// against the inner wall between. Where a motion is long enough to have met the wall, the swept test gives the
    /// point of impact.</remarks>
    internal sealed class ContactSearch : IContactSearch
    {
        private const double MiddleFrom = 0.25;
        private const double MiddleTo = 0.75;
        private readonly double _range;
        private readonly double _clearance;
        private readonly int[] _elementHint;
        private readonly int[] _sphereHint;
        private readonly int _elementCount;
        private readonly double[] _distance;    // at least, where the motion starts, per wall and element
        private readonly bool[] _isKnown;
        private readonly bool _leavesGaps;

        /// <param name="walls">Walls of the scene.</param>
        /// <param name="elementCount">n.</param>
        /// <param name="elementLength">l in units.</param>
        /// <param name="radius">r in units.</param>
        /// <param name="clearance">r + margin in units.</param>
        /// <param name="findsElements">Whether rod elements touch, or spheres alone.</param>
        public ContactSearch(ContactShape[] walls, int elementCount, double elementLength, double radius,
            double clearance, bool findsElements)
        {
            Walls = walls;
            Radius = radius;
            GuardsElements = findsElements;

            // What is within half a radius more may be moved into range by the other constraints.
            _range = clearance + 0.5 * radius;
            _clearance = SweptSearch.ClearanceFor(radius);
            _elementHint = new int[walls.Length * elementCount];
            _sphereHint = new int[walls.Length * (elementCount + 1)];
            Array.Fill(_elementHint, -1);
            Array.Fill(_sphereHint, -1);
            _elementCount = elementCount;
            _distance = new double[walls.Length * elementCount];
            _isKnown = new bool[elementCount + 1];
            _leavesGaps = elementLength > 2.0 * radius;
            Contacts = new StructList<WireContact>(_elementHint.Length + _sphereHint.Length);
            Impacts = new StructList<WireContact>(_elementHint.Length + _sphereHint.Length);
        }

        /// <inheritdoc/>
        public ContactShape[] Walls { get; }

        /// <inheritdoc/>
        public double Radius { get; }

        /// <inheritdoc/>
        public bool GuardsSpheres => true;

        /// <inheritdoc/>
        public bool GuardsElements { get; }

        /// <inheritdoc/>
        public StructList<WireContact> Contacts { get; }

        /// <inheritdoc/>
        public StructList<WireContact> Impacts { get; }

        /// <inheritdoc/>
        public void Find(Vector3d[] from, Vector3d[] to)
        {
            Contacts.Clear();
            Impacts.Clear();
            int n = _elementCount;
            for (int w = 0; w < Walls.Length; w++)
            {
                bool previousNear = false;
                Array.Clear(_isKnown, 0, _isKnown.Length);
                for (int j = 0; j < n; j++)
                {
                    bool near = FindElement(w, j, from, to);
                    if (near || previousNear)
                    {
                        FindSphere(w, j, from, to);
                    }
                    previousNear = near;
                }
                if (previousNear)
                {
                    FindSphere(w, n, from, to);
                }
            }
        }

        /// <inheritdoc/>
        public double ClearanceOf(int w, int j) => _distance[w * _elementCount + j];

        // True where the element comes near the wall, or may have met it during the motion.
        private bool FindElement(int w, int j, Vector3d[] from, Vector3d[] to)
        {
            ref int hint = ref _elementHint[w * _elementCount + j];
            double motion = Math.Max(Vector3d.Distance(from[j], to[j]), Vector3d.Distance(from[j + 1], to[j + 1]));
            ContactShape wall = Walls[w];
            bool near = wall.Nearest(to[j], to[j + 1], _range, ref hint, out SurfaceContact contact);
            double distance = near ? wall.UnsignedDistance(contact.Distance) : _range;
            _distance[w * _elementCount + j] = distance - motion;
            bool mayHaveMet = distance <= motion + _clearance;
            if (near && !mayHaveMet && (contact.Position == 0.0 || contact.Position == 1.0))
            {
                // The point nearest to the element is also nearest to the sphere at its end.
                int end = contact.Position == 0.0 ? j : j + 1;
                if (!_isKnown[end])
                {
                    _isKnown[end] = true;
                    Contacts.Add(new WireContact(w, end, false, contact));
                }
            }
            if (!GuardsElements || !(near || mayHaveMet))
            {
                return near || mayHaveMet;
            }
            if (mayHaveMet && wall.TimeOfImpact(
                from[j], from[j + 1], to[j], to[j + 1], _clearance, out SurfaceContact impact) < ContactShape.NoImpact)
            {
                AddImpact(new WireContact(w, j, true, impact));
                return true;
            }
            if (!near)
            {
                return true;
            }
            if (contact.Position > 0.0 && contact.Position < 1.0)
            {
                Contacts.Add(new WireContact(w, j, true, contact));
                return true;
            }
            if (_leavesGaps)
            {
                FindMiddle(w, j, to, hint);
            }
            return true;
        }

        private void FindMiddle(int w, int j, Vector3d[] to, int hint)
        {
            Vector3d a = Vector3d.Lerp(to[j], to[j + 1], MiddleFrom);
            Vector3d b = Vector3d.Lerp(to[j], to[j + 1], MiddleTo);
            if (Walls[w].Nearest(a, b, _range, ref hint, out SurfaceContact contact))
            {
                double s = MiddleFrom + (MiddleTo - MiddleFrom) * contact.Position;
                Contacts.Add(new WireContact(
                    w, j, true, new SurfaceContact(s, contact.Point, contact.Normal, contact.Distance)));
            }
        }

        private void FindSphere(int w, int i, Vector3d[] from, Vector3d[] to)
        {
            if (_isKnown[i])
            {
                return;
            }
            ref int hint = ref _sphereHint[w * from.Length + i];
            ContactShape wall = Walls[w];
            double motion = Vector3d.Distance(from[i], to[i]);
            bool near = wall.Nearest(to[i], to[i], _range, ref hint, out SurfaceContact contact);
            bool mayHaveMet = (near ? Math.Abs(contact.Distance) : _range) <= motion + _clearance;
            if (mayHaveMet && wall.TimeOfImpact(
                from[i], from[i], to[i], to[i], _clearance, out SurfaceContact impact) < ContactShape.NoImpact)
            {
                AddImpact(new WireContact(w, i, false, impact));
            }
            else if (near)
            {
                Contacts.Add(new WireContact(w, i, false, contact));
            }
        }

        private void AddImpact(in WireContact impact)
        {
            Contacts.Add(impact);
            Impacts.Add(impact);
        }
    }

    /// <summary>Contacts as published (thesis 3.1.2): at the predicted state, every sphere and every rod element whose
    /// core is within a sphere's radius of the wall. Passages are not prevented, and distances at the start of a
    /// displacement are not known.</summary>
    internal sealed class ThesisContactSearch : IContactSearch
    {
        private readonly int[] _elementHint;
        private readonly int[] _sphereHint;

        /// <param name="walls">Walls of the scene.</param>
        /// <param name="elementCount">n.</param>
        /// <param name="radius">r in units.</param>
        public ThesisContactSearch(ContactShape[] walls, int elementCount, double radius)
        {
            Walls = walls;
            Radius = radius;
            _elementHint = new int[walls.Length * elementCount];
            _sphereHint = new int[walls.Length * (elementCount + 1)];
            Array.Fill(_elementHint, -1);
            Array.Fill(_sphereHint, -1);
            Contacts = new StructList<WireContact>(_elementHint.Length + _sphereHint.Length);
        }

        /// <inheritdoc/>
        public ContactShape[] Walls { get; }

        /// <inheritdoc/>
        public double Radius { get; }

        /// <inheritdoc/>
        public bool GuardsSpheres => false;

        /// <inheritdoc/>
        public bool GuardsElements => false;

        /// <inheritdoc/>
        public StructList<WireContact> Contacts { get; }

        /// <inheritdoc/>
        public StructList<WireContact> Impacts { get; } = new StructList<WireContact>(1);

        /// <inheritdoc/>
        public void Find(Vector3d[] from, Vector3d[] to)
        {
            Contacts.Clear();
            int n = to.Length - 1;
            for (int w = 0; w < Walls.Length; w++)
            {
                for (int i = 0; i <= n; i++)
                {
                    if (Walls[w].Nearest(
                        to[i], to[i], Radius, ref _sphereHint[w * (n + 1) + i], out SurfaceContact contact))
                    {
                        Contacts.Add(new WireContact(w, i, false, contact));
                    }
                }
                for (int j = 0; j < n; j++)
                {
                    if (Walls[w].Nearest(
                        to[j], to[j + 1], Radius, ref _elementHint[w * n + j], out SurfaceContact contact))
                    {
                        Contacts.Add(new WireContact(w, j, true, contact));
                    }
                }
            }
        }

        /// <inheritdoc/>
        public double ClearanceOf(int w, int j) => double.NegativeInfinity;
    }

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
