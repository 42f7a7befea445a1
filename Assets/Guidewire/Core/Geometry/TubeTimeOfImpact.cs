using System;

namespace Guidewire.Core
{
    /// <summary>Time of impact of a segment in a tube. Along the segment the deepest piece changes at some points
    /// (handovers); between two of them, during a motion, the segment's points are a patch with four corners, and a
    /// piece that contains the corners contains the patch, because its lumen is convex.</summary>
    /// <remarks>So a motion is free if the same pieces are deepest in the same order before and after, and the
    /// handovers have the clearance. Otherwise the motion is halved until the change of pieces lies in a part too short
    /// to bring the segment to the wall: d has slope at most 1. What is undecided after <see cref="MostQueries"/>
    /// queries counts as not free. Holds scratch memory: one object serves one thread.</remarks>
    internal sealed class TubeTimeOfImpact
    {
        private const int MostQueries = 16;
        private const double SafePart = 0.9;
        private const double LeastFraction = 1.0 / 16.0;
        private const double ShortestTime = 1.0 / 128.0;
        private readonly TubeShape _tube;
        private TubeHandovers _before;
        private TubeHandovers _after;

        /// <summary>For a tube and the tree of its pieces.</summary>
        public TubeTimeOfImpact(TubeShape tube, TubeTree tree)
        {
            _tube = tube;
            _before = new TubeHandovers(tree);
            _after = new TubeHandovers(tree);
        }

        /// <summary>Largest fraction of the motion for which every point of the segment is proven to stay at least
        /// <paramref name="clearance"/> from the wall, <see cref="ContactShape.NoImpact"/> for all of it.</summary>
        public double TimeOfImpact(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance)
        {
            bool isPoint = a0 == b0 && a1 == b1;
            double time = 0.0;
            double end = 1.0;         // up to it no approach below the clearance is known
            double step = 1.0;
            if (!isPoint)
            {
                _before.Find(a0, b0, clearance);
            }
            for (int queries = 0; queries < MostQueries && step >= ShortestTime; queries++)
            {
                double until = Math.Min(end, time + step);
                Vector3d a = Vector3d.Lerp(a0, a1, until);
                Vector3d b = Vector3d.Lerp(b0, b1, until);
                double least = isPoint ? _tube.LeastDistance(Vector3d.Lerp(a0, a1, time), a) 
                    : FindAfter(a, b, clearance);
                if (least < clearance)
                {
                    // By linear interpolation of the distance.
                    double before = isPoint ? _tube.Distance(Vector3d.Lerp(a0, a1, time), out _) : _before.Least;
                    double fraction = SafePart * (before - clearance) / (before - least);
                    end = until;
                    step = (end - time) * Math.Min(0.5, Math.Max(fraction, LeastFraction));
                }
                else if (isPoint || IsFree(clearance))
                {
                    if (until == 1.0)
                    {
                        return ContactShape.NoImpact;
                    }
                    time = until;
                    step = Math.Min(2.0 * step, 0.5 * (end - time) + (end < 1.0 ? 0.0 : 1.0));
                    (_before, _after) = (_after, _before);
                }
                else
                {
                    step *= 0.5;
                }
            }
            return time;
        }

        private double FindAfter(in Vector3d a, in Vector3d b, double clearance)
        {
            _after.Find(a, b, clearance);
            return Math.Min(_before.Least, _after.Least);
        }

        // From where _before was found to where _after was.
        private bool IsFree(double clearance)
        {
            double motion = Math.Max(Vector3d.Distance(_before.A, _after.A), Vector3d.Distance(_before.B, _after.B));
            return 0.5 * (_before.Least + _after.Least - motion) >= clearance || _before.LeadTo(_after, clearance);
        }
    }
}
