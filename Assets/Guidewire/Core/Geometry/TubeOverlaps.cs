using System;

namespace Guidewire.Core
{
    /// <summary>Pieces of a tube that overlap pieces which are not next to them: legs of a hairpin, and where the tube
    /// comes back to itself. A segment may cross from one to the other at no knot.</summary>
    internal sealed class TubeOverlaps
    {
        private const double LargestTurn = 1.0;    // radians between axes of pieces that pieces between them separate
        private readonly bool[] _isIn;             // by piece
        private readonly bool _hasAny;

        /// <summary>Finds the overlaps of the tube through these knots with these radii, units.</summary>
        public TubeOverlaps(Vector3d[] knots, double[] radii)
        {
            int count = knots.Length - 1;
            _isIn = new bool[count];
            var lengths = new double[count];
            for (int i = 0; i < count; i++)
            {
                lengths[i] = Vector3d.Distance(knots[i], knots[i + 1]);
            }
            for (int i = 0; i < count; i++)
            {
                double between = 0.0;    // length of the pieces between i and j
                Vector3d axis = (knots[i + 1] - knots[i]) / lengths[i];
                for (int j = i + 2; j < count; j++)
                {
                    between += lengths[j - 1];
                    double range = Math.Max(radii[i], radii[i + 1]) + Math.Max(radii[j], radii[j + 1]);
                    double far = range + lengths[i] + lengths[j];
                    if ((knots[i] - knots[j]).LengthSquared > far * far)
                    {
                        continue;
                    }
                    double squared = ClosestPoints.SegmentSegment(
                        knots[i], knots[i + 1], knots[j], knots[j + 1], out double s, out double t);
                    double along = between + (1.0 - s) * lengths[i] + t * lengths[j];
                    double cosine = Vector3d.Dot(axis, knots[j + 1] - knots[j]) / lengths[j];
                    // Around a circle of at least the tube's radius it takes more than half a circle to come so near.
                    if (squared < range * range && (cosine < Math.Cos(LargestTurn) || along > 0.5 * Math.PI * range))
                    {
                        _isIn[i] = true;
                        _isIn[j] = true;
                        _hasAny = true;
                    }
                }
            }
        }

        /// <summary>Whether one of these pieces is such a one; of all pieces, where they are not known.</summary>
        public bool Has(FeatureRange pieces)
        {
            for (int i = pieces.From; i < pieces.To && _hasAny; i++)
            {
                if (_isIn[pieces[i]])
                {
                    return true;
                }
            }
            return _hasAny && !pieces.IsKnown;
        }
    }
}
