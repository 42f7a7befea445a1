using System;

namespace Guidewire.Core
{
    /// <summary>Keeps a motion of the wire from passing a wall: finds where it would, and shortens it as the last
    /// resort.</summary>
    /// <remarks>The start of every motion is clear of the wall by induction: a motion is only accepted when the swept
    /// test finds it clear, and the wire does not move at all where nothing else is. An element whose distance at the
    /// start is known to exceed the way of its ends cannot meet the wall and is not swept.</remarks>
    internal sealed class SweptGuard
    {
        private const int LocalRounds = 8;
        private const int GlobalRounds = 20;
        private const double SafePart = 0.9;
        private readonly ContactShape[] _walls;
        private readonly IContactRule _rule;
        private readonly double _clearance;
        private readonly double[] _share;
        private readonly Vector3d[] _whole;

        /// <param name="walls">What may not be passed.</param>
        /// <param name="rule">Which parts of the wire are guarded, and what it knows of their distance.</param>
        /// <param name="sphereCount">n + 1.</param>
        /// <param name="radius">r in units.</param>
        public SweptGuard(ContactShape[] walls, IContactRule rule, int sphereCount, double radius)
        {
            _walls = walls;
            _rule = rule;
            _clearance = ClearanceFor(radius);
            _share = new double[sphereCount];
            _whole = new Vector3d[sphereCount];
        }

        /// <summary>What the swept test keeps between core line and wall, units: enough to stay clear of rounding, too
        /// little to be felt.</summary>
        public static double ClearanceFor(double radius)
        {
            return 1e-3 * radius;
        }

        /// <summary>Tells the rule of every place where the motion would pass a wall; true when there is one.</summary>
        public bool FindImpacts(Vector3d[] from, Vector3d[] to)
        {
            bool found = false;
            for (int i = 0; i < to.Length; i++)
            {
                if (_rule.GuardsSpheres && Impact(from, to, i, i, out SurfaceContact contact) < ContactShape.NoImpact)
                {
                    _rule.AddImpact(i, false, contact);
                    found = true;
                }
                if (_rule.GuardsElements && i + 1 < to.Length
                    && Impact(from, to, i, i + 1, out contact) < ContactShape.NoImpact)
                {
                    _rule.AddImpact(i, true, contact);
                    found = true;
                }
            }
            return found;
        }

        /// <summary>Shortens the motion until no guarded part of the wire passes a wall: first of the spheres that
        /// would, then of all alike.</summary>
        public void Shorten(Vector3d[] from, Vector3d[] to)
        {
            Array.Copy(to, _whole, to.Length);
            Array.Fill(_share, 1.0);
            for (int round = 0; round < LocalRounds; round++)
            {
                if (!Cut(from, to))
                {
                    return;
                }
                Apply(from, to);
            }
            double least = 1.0;
            foreach (double share in _share)
            {
                least = Math.Min(least, share);
            }
            for (int round = 0; round < GlobalRounds; round++)
            {
                Array.Fill(_share, least);
                Apply(from, to);
                if (!Cut(from, to))
                {
                    return;
                }
                least *= 0.5;
            }
            Array.Copy(from, to, to.Length);
        }

        private bool Cut(Vector3d[] from, Vector3d[] to)
        {
            bool any = false;
            for (int i = 0; i < to.Length; i++)
            {
                double own = _rule.GuardsSpheres ? Impact(from, to, i, i, out _) : ContactShape.NoImpact;
                if (own < ContactShape.NoImpact)
                {
                    any = true;
                    _share[i] *= SafePart * own;
                }
                double shared = _rule.GuardsElements && i + 1 < to.Length
                    ? Impact(from, to, i, i + 1, out _) : ContactShape.NoImpact;
                if (shared < ContactShape.NoImpact)
                {
                    any = true;
                    _share[i] *= SafePart * shared;
                    _share[i + 1] *= SafePart * shared;
                }
            }
            return any;
        }

        private void Apply(Vector3d[] from, Vector3d[] to)
        {
            for (int i = 0; i < to.Length; i++)
            {
                to[i] = Vector3d.Lerp(from[i], _whole[i], _share[i]);
            }
        }

        // Element i, i + 1, or sphere i as i, i.
        private double Impact(Vector3d[] from, Vector3d[] to, int i, int k, out SurfaceContact contact)
        {
            contact = default;
            double motion = Math.Max(Vector3d.Distance(from[i], to[i]), Vector3d.Distance(from[k], to[k]));
            double known = i == k
                ? Math.Max(ClearanceOf(i - 1), ClearanceOf(i)) : _rule.ClearanceOf(i);
            if (motion + _clearance < known || motion == 0.0)
            {
                return ContactShape.NoImpact;
            }
            double first = ContactShape.NoImpact;
            foreach (ContactShape wall in _walls)
            {
                double impact = wall.Sweep(from[i], from[k], to[i], to[k], _clearance, out SurfaceContact at);
                if (impact < first)
                {
                    first = impact;
                    contact = at;
                }
            }
            return first;
        }

        private double ClearanceOf(int element)
        {
            return element < 0 || element + 1 >= _share.Length ? 0.0 : _rule.ClearanceOf(element);
        }
    }
}
