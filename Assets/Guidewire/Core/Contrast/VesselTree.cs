using System;

namespace Guidewire.Core
{
    /// <summary>The centreline of a vessel as blood flows through it: points from the inlet to the ends, each after
    /// the one
    /// before it.</summary>
    public sealed class VesselTree
    {
        /// <summary>Makes a tree of points, radii and the index of the point before each.</summary>
        /// <param name="points">mm.</param>
        /// <param name="radii">Of the lumen at each, mm, above 0.</param>
        /// <param name="before">The point before each towards the inlet, smaller than its own number; -1 at the inlet,
        /// the
        /// first.</param>
        /// <exception cref="ArgumentException">Fewer than two points, or no such tree.</exception>
        public VesselTree(Vector3d[] points, double[] radii, int[] before)
        {
            bool isTree = points.Length > 1 && radii.Length == points.Length && before.Length == points.Length
                && before[0] == -1;
            for (int k = 1; isTree && k < points.Length; k++)
            {
                isTree = before[k] >= 0 && before[k] < k;
            }
            for (int k = 0; isTree && k < points.Length; k++)
            {
                isTree = points[k].IsFinite && radii[k] > 0.0 && !double.IsInfinity(radii[k]);
            }
            if (!isTree)
            {
                throw new ArgumentException("a vessel's tree needs two points at least, each after the one before it,"
                    + " and radii above 0");
            }
            Points = points;
            Radii = radii;
            Before = before;
        }

        /// <summary>The points of the centreline, mm.</summary>
        public Vector3d[] Points { get; }

        /// <summary>The radius of the lumen at each point, mm.</summary>
        public double[] Radii { get; }

        /// <summary>The point before each; -1 at the inlet, the first.</summary>
        public int[] Before { get; }
    }
}
