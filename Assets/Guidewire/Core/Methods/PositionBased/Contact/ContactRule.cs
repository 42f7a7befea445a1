using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Contact of spheres and, unless switched off, of rod elements by the lever rule.</summary>
    /// <remarks>One search an element tells whether anything is in reach. Only then the two spheres are asked, and
    /// where the element touches with an end, the sphere's own contact stands for it and, where spheres leave gaps,
    /// the element's middle half is asked: a long element in a bend lies against the outer wall with its ends and
    /// against the inner wall between. Where a motion is long enough to have met the wall on its way, the swept test
    /// gives the place where it did.</remarks>
    internal sealed class ContactRule : IContactRule
    {
        private const int ContactsPerSphere = 8;
        private const double MiddleFrom = 0.25;
        private const double MiddleTo = 0.75;
        private readonly ContactShape[] _walls;
        private readonly double _radius;
        private readonly double _reach;
        private readonly double _range;
        private readonly double _gain;
        private readonly double _clearance;
        private readonly SphereContactConstraint _spheres;
        private readonly ElementContactConstraint? _elements;
        private readonly SphereContactConstraint _sphereStops;
        private readonly ElementContactConstraint? _elementStops;
        private readonly int[] _elementHint;
        private readonly int[] _sphereHint;
        private readonly double[] _distance;
        private readonly bool[] _isKnown;
        private readonly bool _leavesGaps;

        /// <param name="state">The wire, with its final masses.</param>
        /// <param name="parameters">Radius, margin, gain, and whether elements touch.</param>
        public ContactRule(RodState state, SimulationParameters parameters)
        {
            _walls = parameters.Walls;
            _radius = parameters.SphereRadius;
            _reach = parameters.SphereRadius + parameters.CollisionMargin;

            // What comes within half a radius more may be pushed into reach by the other constraints.
            _range = _reach + 0.5 * _radius;
            _gain = parameters.CollisionStiffness;
            _clearance = SweptGuard.ClearanceFor(parameters.SphereRadius);
            int capacity = ContactsPerSphere * _walls.Length * state.SphereCount;
            _spheres = new SphereContactConstraint(state, capacity);
            _sphereStops = new SphereContactConstraint(state, capacity);
            if (parameters.ElementContact == ElementContact.Barycentric)
            {
                _elements = new ElementContactConstraint(state, capacity);
                _elementStops = new ElementContactConstraint(state, capacity);
            }
            _elementHint = new int[_walls.Length * state.ElementCount];
            _sphereHint = new int[_walls.Length * state.SphereCount];
            Array.Fill(_elementHint, -1);
            Array.Fill(_sphereHint, -1);
            _distance = new double[state.ElementCount];
            _isKnown = new bool[state.SphereCount];
            _leavesGaps = state.ElementLength > 2.0 * _radius;
        }

        /// <inheritdoc/>
        public bool GuardsSpheres => true;

        /// <inheritdoc/>
        public bool GuardsElements => _elements != null;

        /// <inheritdoc/>
        public int ContactCount =>
            _spheres.Count + (_elements?.Count ?? 0) + (_elementStops?.Count ?? 0) + _sphereStops.Count;

        /// <inheritdoc/>
        public void Detect(Vector3d[] from, Vector3d[] to)
        {
            _spheres.Clear();
            _sphereStops.Clear();
            _elements?.Clear();
            _elementStops?.Clear();
            int n = _distance.Length;
            Array.Fill(_distance, double.PositiveInfinity);
            for (int w = 0; w < _walls.Length; w++)
            {
                bool previousNear = false;
                Array.Clear(_isKnown, 0, _isKnown.Length);
                for (int j = 0; j < n; j++)
                {
                    bool near = DetectElement(w, j, from, to);
                    if (near || previousNear)
                    {
                        DetectSphere(w, j, from, to);
                    }
                    previousNear = near;
                }
                if (previousNear)
                {
                    DetectSphere(w, n, from, to);
                }
            }
        }

        /// <inheritdoc/>
        public double ClearanceOf(int j)
        {
            return _distance[j];
        }

        /// <inheritdoc/>
        public void AddImpact(int j, bool isElement, in SurfaceContact contact)
        {
            if (isElement)
            {
                _elementStops!.Add(j, contact, 2.0 * _clearance, 1.0);
            }
            else
            {
                _sphereStops.Add(j, contact, 2.0 * _clearance, 1.0);
            }
        }

        /// <inheritdoc/>
        public void Sweep(Vector3d[] x)
        {
            _spheres.Sweep(x);
            _elements?.Sweep(x);
            _elementStops?.Sweep(x);
            _sphereStops.Sweep(x);
        }

        /// <inheritdoc/>
        public void SpheresOf(int k, out int first, out int last)
        {
            SphereContactConstraint? spheres = At(ref k, out ElementContactConstraint? elements);
            first = spheres?.SphereOf(k) ?? elements!.ElementOf(k);
            last = spheres != null ? first : first + 1;
        }

        /// <inheritdoc/>
        [MethodImpl(Compiled.AtOnce)]
        public bool Project(int k, Vector3d[] x)
        {
            SphereContactConstraint? spheres = At(ref k, out ElementContactConstraint? elements);
            return spheres != null ? spheres.Project(k, x) : elements!.Project(k, x);
        }

        /// <inheritdoc/>
        public void AddImpulses(Vector3d[] impulses)
        {
            _spheres.AddImpulses(impulses);
            _elements?.AddImpulses(impulses);
            _elementStops?.AddImpulses(impulses);
            _sphereStops.AddImpulses(impulses);
        }

        /// <inheritdoc/>
        public double Penetration(Vector3d[] x)
        {
            double gap = Math.Max(_spheres.LargestGap(x), _elements?.LargestGap(x) ?? double.NegativeInfinity);
            return gap - (_reach - _radius);
        }

        // Where contact k of a sweep stands, and which it is there: spheres, or where that is null, elements.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private SphereContactConstraint? At(ref int k, out ElementContactConstraint? elements)
        {
            elements = null;
            if (k < _spheres.Count)
            {
                return _spheres;
            }
            k -= _spheres.Count;
            int ofElements = _elements?.Count ?? 0;
            int ofElementStops = _elementStops?.Count ?? 0;
            if (k < ofElements)
            {
                elements = _elements;
                return null;
            }
            k -= ofElements;
            if (k < ofElementStops)
            {
                elements = _elementStops;
                return null;
            }
            k -= ofElementStops;
            return _sphereStops;
        }

        // True where the element comes near the wall, or may have met it on its way.
        private bool DetectElement(int w, int j, Vector3d[] from, Vector3d[] to)
        {
            ref int hint = ref _elementHint[w * _distance.Length + j];
            double motion = Math.Max(Vector3d.Distance(from[j], to[j]), Vector3d.Distance(from[j + 1], to[j + 1]));
            ContactShape wall = _walls[w];
            bool near = wall.Nearest(to[j], to[j + 1], _range, ref hint, out SurfaceContact contact);
            double distance = near ? Math.Abs(contact.Distance) : _range;
            _distance[j] = Math.Min(_distance[j], distance - motion);
            bool mayHaveMet = distance <= motion + _clearance;
            if (near && !mayHaveMet && (contact.Position == 0.0 || contact.Position == 1.0))
            {
                // The place nearest to the element is nearest to the sphere at its end, too.
                int end = contact.Position == 0.0 ? j : j + 1;
                if (!_isKnown[end])
                {
                    _isKnown[end] = true;
                    _spheres.Add(end, contact, _reach, _gain);
                }
            }
            if (_elements == null || !(near || mayHaveMet))
            {
                return near || mayHaveMet;
            }
            if (mayHaveMet && wall.Sweep(
                from[j], from[j + 1], to[j], to[j + 1], _clearance, out SurfaceContact impact) < ContactShape.NoImpact)
            {
                _elements.Add(j, impact, _reach, _gain);
                AddImpact(j, true, impact);
                return true;
            }
            if (!near)
            {
                return true;
            }
            if (contact.Position > 0.0 && contact.Position < 1.0)
            {
                _elements.Add(j, contact, _reach, _gain);
                return true;
            }
            if (_leavesGaps)
            {
                DetectMiddle(wall, j, to, hint);
            }
            return true;
        }

        private void DetectMiddle(ContactShape wall, int j, Vector3d[] to, int hint)
        {
            Vector3d a = Vector3d.Lerp(to[j], to[j + 1], MiddleFrom);
            Vector3d b = Vector3d.Lerp(to[j], to[j + 1], MiddleTo);
            if (wall.Nearest(a, b, _range, ref hint, out SurfaceContact contact))
            {
                double s = MiddleFrom + (MiddleTo - MiddleFrom) * contact.Position;
                _elements!.Add(
                    j, new SurfaceContact(s, contact.Point, contact.Normal, contact.Distance), _reach, _gain);
            }
        }

        private void DetectSphere(int w, int i, Vector3d[] from, Vector3d[] to)
        {
            if (_isKnown[i])
            {
                return;
            }
            ref int hint = ref _sphereHint[w * from.Length + i];
            ContactShape wall = _walls[w];
            double motion = Vector3d.Distance(from[i], to[i]);
            bool near = wall.Nearest(to[i], to[i], _range, ref hint, out SurfaceContact contact);
            bool mayHaveMet = (near ? Math.Abs(contact.Distance) : _range) <= motion + _clearance;
            if (mayHaveMet && wall.Sweep(
                from[i], from[i], to[i], to[i], _clearance, out SurfaceContact impact) < ContactShape.NoImpact)
            {
                _spheres.Add(i, impact, _reach, _gain);
                AddImpact(i, false, impact);
            }
            else if (near)
            {
                _spheres.Add(i, contact, _reach, _gain);
            }
        }
    }
}
