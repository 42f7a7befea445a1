using System;

namespace Guidewire.Core
{
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
}
