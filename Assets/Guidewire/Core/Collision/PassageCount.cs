using System;

namespace Guidewire.Core
{
    /// <summary>Counts points of the wire that are inside before a step and outside after it, ten an element (s = 0,
    /// 0.1, ... 0.9) and the last sphere. Leaving through an open rim is no passage.</summary>
    /// <remarks>Only an element whose straight way comes within the clearance of a wall is asked: another changes no
    /// side. The clearance must not be 0, where the swept test may end behind the wall by rounding and see it
    /// recede.</remarks>
    internal sealed class PassageCount
    {
        private const int SamplesPerElement = 10;
        private readonly ContactShape[] _walls;
        private readonly double _clearance;

        /// <param name="walls">What may not be passed.</param>
        /// <param name="radius">r in units.</param>
        public PassageCount(ContactShape[] walls, double radius)
        {
            _walls = walls;
            _clearance = SweptGuard.ClearanceFor(radius);
        }

        /// <summary>Passages so far.</summary>
        public long Total { get; private set; }

        /// <summary>Counts those of one step, from x_k to x_{k+1} in units.</summary>
        /// <param name="from">x_k, n + 1.</param>
        /// <param name="to">x_{k+1}.</param>
        /// <param name="rule">Knows for each element a lower bound of its distance from the wall.</param>
        /// <param name="boundsHold">Whether the bounds are those at x_k.</param>
        public void Add(Vector3d[] from, Vector3d[] to, IContactRule rule, bool boundsHold)
        {
            int n = to.Length - 1;
            for (int j = 0; j < n; j++)
            {
                double motion = Math.Max(Vector3d.Distance(from[j], to[j]), Vector3d.Distance(from[j + 1], to[j + 1]));
                if (boundsHold && motion < rule.ClearanceOf(j))
                {
                    continue;
                }
                foreach (ContactShape wall in _walls)
                {
                    if (wall.Sweep(from[j], from[j + 1], to[j], to[j + 1], _clearance, out _) < ContactShape.NoImpact)
                    {
                        CountElement(wall, from, to, j, j + 1 == n ? SamplesPerElement + 1 : SamplesPerElement);
                    }
                }
            }
        }

        private void CountElement(ContactShape wall, Vector3d[] from, Vector3d[] to, int j, int samples)
        {
            for (int k = 0; k < samples; k++)
            {
                double s = (double)k / SamplesPerElement;
                Vector3d before = Vector3d.Lerp(from[j], from[j + 1], s);
                Vector3d after = Vector3d.Lerp(to[j], to[j + 1], s);
                if (wall.Contains(before) && !wall.Contains(after)
                    && wall.Sweep(before, before, after, after, _clearance, out _) < ContactShape.NoImpact)
                {
                    Total++;
                }
            }
        }
    }
}
