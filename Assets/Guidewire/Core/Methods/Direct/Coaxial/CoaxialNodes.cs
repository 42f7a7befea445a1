using System;

namespace Guidewire.Core
{
    /// <summary>Determines which nodes of inner instruments are beyond the surrounding tips, and when that set has to
    /// change.</summary>
    /// <remarks>A node comes in where it is 0.02 of its element's length beyond the tip to the end of a step, or the
    /// difference of the two radii where that is less: so far the ball of a tip inside lies in the one around it, and
    /// misses no wall. Where a soft wall gives way the balls are those at its limit. It goes where it is half as far
    /// beyond it, and a step ends a part there: so what takes its place lies where it was. The tip around an
    /// instrument is that of the next one around it which is beyond those around it in turn.</remarks>
    internal sealed class CoaxialNodes
    {
        /// <summary>The fraction of a step, or of an element's length, below which two moments are one.</summary>
        public const double SameTime = 1e-6;

        private const double OfLength = 0.02;    // of an element's length, beyond a tip it comes in
        private const double OfPlay = 0.01;      // the same, at least
        private const double Left = 0.5;    // of that, where it goes
        private const double LeaveHysteresis = 0.3;    // of an element's length, by which it goes late in a sheath
        private const int MinElements = 2;

        private readonly CoaxialInstrument[] _instrument;
        private readonly CoaxialHubs _hubs;
        private readonly WallSoftness[] _soft;

        /// <summary>Of these instruments, on these hubs.</summary>
        /// <param name="soft">Of the walls that give way.</param>
        public CoaxialNodes(CoaxialInstrument[] instruments, CoaxialHubs hubs, WallSoftness[] soft)
        {
            _soft = soft;
            _instrument = instruments;
            _hubs = hubs;
            Beyond = new int[instruments.Length];
        }

        /// <summary>What was found last, of each instrument.</summary>
        public int[] Beyond { get; }

        /// <summary>The first element of the outermost instrument in a sheath that is needed in a step: it is wholly in
        /// the sheath until its end, by the hub's position and, where the instrument is stretched, by its own. So every
        /// joint that comes out, or goes in, does so within a step.</summary>
        /// <param name="shape">Where its elements are, from one on.</param>
        /// <param name="first">That element.</param>
        /// <param name="sheathed">Length in the sheath, m.</param>
        /// <param name="move">What of it comes out, m.</param>
        public int FirstOf(RodShape shape, int first, SheathEnd sheath, double sheathed, double move)
        {
            double[] station = _instrument[0].Stations;
            int known = first;
            // How far a node will be beyond the exit at most.
            double Beyond(int i) => move + Math.Max(station[i] - sheathed,
                sheath.Outside(shape.X[Math.Max(i - known, 0)]) + Math.Min(station[i] - station[known], 0.0));
            while (first > 0 && Beyond(first + 1) > 0.0)
            {
                first--;
            }
            int last = station.Length - 1 - MinElements;
            while (first < last && Beyond(first + 2) < -LeaveHysteresis * _instrument[0].Rod.Length[first + 1])
            {
                first++;
            }
            return first;
        }

        /// <summary>Finds how many are beyond in a part of a step.</summary>
        /// <param name="time">Of its start, s.</param>
        /// <param name="length">s.</param>
        public void Find(double time, double length)
        {
            for (int i = 1; i < _instrument.Length; i++)
            {
                int around = AroundOf(i, Beyond);
                double lead = _hubs.LeadAt(i, time) - _hubs.LeadAt(around, time);
                double next = _hubs.LeadAt(i, time + length) - _hubs.LeadAt(around, time + length);
                Beyond[i] = Find(i, around, Beyond[i], Math.Max(lead, next) + _instrument[around].Rod.TotalLength);
            }
        }

        /// <summary>Time until the first inner node beyond a tip is as near to it as one may come, s: there it goes,
        /// before the element that takes over its length would be another than the two that were. Or until a tip inside
        /// is as far out as it comes in: there it is where the tip around it has been, and outside no wall.</summary>
        public double TimeToNode(double time)
        {
            double least = double.PositiveInfinity;
            for (int i = 1; i < _instrument.Length; i++)
            {
                int around = AroundOf(i, Beyond);
                double tip = _hubs.LeadAt(i, time) - _hubs.LeadAt(around, time)
                    + _instrument[around].Rod.TotalLength;
                least = Math.Min(least, TimeToNode(i, around, Beyond[i], tip, _hubs.SlideOf(i, around)));
            }
            return least;
        }

        // The last instrument around one that is the outermost one anywhere.
        private static int AroundOf(int instrument, int[] beyond) => instrument == 2 && beyond[1] > 0 ? 1 : 0;

        // How far beyond the tip around it the end of an element comes in, m.
        private double Reached(int instrument, int outermost, int element)
        {
            MaterialRod inner = _instrument[instrument].Rod;
            double[] outer = _instrument[outermost].Rod.Radius;
            double around = outer[outer.Length - 1];
            double inside = inner.Radius[element];
            double play = around - inside;
            double reached = Math.Min(OfLength * inner.Length[element], play);
            foreach (WallSoftness soft in _soft)
            {
                reached = Math.Min(reached, Math.Max(play - (soft.MaxOf(around) - soft.MaxOf(inside)), OfPlay * play));
            }
            return reached;
        }

        private int Find(int instrument, int around, int beyond, double tip)
        {
            double[] station = _instrument[instrument].Stations;
            double[] length = _instrument[instrument].Rod.Length;
            int n = length.Length;
            while (beyond > 0 && station[n + 1 - beyond] - tip
                < (1.0 - SameTime) * Left * Reached(instrument, around, n - beyond))
            {
                beyond--;
            }
            while (beyond < n && station[n - beyond] - tip
                >= Reached(instrument, around, n - 1 - beyond) - SameTime * length[n - 1 - beyond])
            {
                beyond++;
            }
            return beyond;
        }

        // slide: of the instrument against the one around it, m/s.
        private double TimeToNode(int instrument, int around, int beyond, double tip, double slide)
        {
            double[] station = _instrument[instrument].Stations;
            double[] length = _instrument[instrument].Rod.Length;
            int n = length.Length;
            if (beyond == 0 || !(slide < 0.0))
            {
                double ahead = Reached(instrument, around, n - 1) - (station[n] - tip);
                return beyond == 0 && slide > 0.0 && ahead > SameTime * length[n - 1] ? ahead / slide
                    : double.PositiveInfinity;
            }
            while (beyond > 0 && station[n + 1 - beyond] - tip
                <= (1.0 + SameTime) * Left * Reached(instrument, around, n - beyond))
            {
                beyond--;
            }
            return beyond == 0 ? double.PositiveInfinity
                : (station[n + 1 - beyond] - tip - Left * Reached(instrument, around, n - beyond)) / -slide;
        }
    }
}
