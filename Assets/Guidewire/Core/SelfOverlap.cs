using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Finds an instrument that goes through itself: two of its stretches are nearer than a
    /// diameter.</summary>
    /// <remarks>An arc that is bent no tighter than the instrument's own radius, r, has its ends a diameter apart or
    /// more from a length of pi r on (Schur's theorem: none of its length has nearer ends than the half circle). So
    /// elements with at least that much between them are nearer than a diameter only where the instrument has come back
    /// to itself. A ring, whose ends are in one place, is closed there.</remarks>
    internal sealed class SelfOverlap
    {
        private readonly double[][] _station;   // of each instrument's nodes at rest, units
        private readonly double[][] _radius;    // of its elements, units
        private readonly double[] _widest;
        private double _least = 1.0;            // distance over the diameter
        private int _instrument;                // as of parameters: 0 the wire, k catheter k - 1
        private double _first;                  // units from its proximal end
        private double _second;
        private double _time;                   // s

        /// <summary>A monitor of the instruments of a run.</summary>
        public SelfOverlap(SimulationParameters parameters)
        {
            var all = new List<SimulationParameters> { parameters };
            foreach (Catheter catheter in parameters.Scene.Catheters)
            {
                all.Add(parameters.OfCatheter(catheter, Vector3d.UnitZ));
            }
            _station = new double[all.Count][];
            _radius = new double[all.Count][];
            _widest = new double[all.Count];
            bool hasMaterial = MethodTable.Of(parameters.Method.Solver).TakesMaterial;
            for (int i = 0; i < all.Count; i++)
            {
                double[] lengths = ElementLayout.Lengths(all[i], 1.0, out _station[i]);
                _radius[i] = new double[lengths.Length];
                for (int j = 0; j < lengths.Length; j++)
                {
                    double middle = 0.5 * (_station[i][j] + _station[i][j + 1]);
                    _radius[i][j] = hasMaterial
                        ? CrossSection.At(all[i].Material, middle).Radius / parameters.Scene.MetresPerUnit
                        : parameters.Contact.SphereRadius;
                    _widest[i] = Math.Max(_widest[i], _radius[i][j]);
                }
            }
        }

        /// <summary>The warning of where an instrument overlapped itself most; null where none did.</summary>
        public RunWarning? Warning => _least >= 1.0 ? (RunWarning?)null
            : WarningTable.SelfOverlap.With(
                _instrument == 0 ? "the wire" : _station.Length == 2 ? "the catheter" : "catheter " + _instrument,
                _time, _first, _second, _least);

        /// <summary>Takes where an instrument is.</summary>
        /// <param name="instrument">0 the wire, k catheter k - 1.</param>
        /// <param name="x">Its nodes, units.</param>
        /// <param name="time">s.</param>
        public void Update(int instrument, Vector3d[] x, double time)
        {
            double[] station = _station[instrument];
            double[] radius = _radius[instrument];
            int n = radius.Length;
            double longest = 0.0;
            for (int j = 0; j < n; j++)
            {
                longest = Math.Max(longest, Vector3d.Distance(x[j], x[j + 1]));
            }
            double reach = longest + 2.0 * _widest[instrument];
            if (!(reach <= double.MaxValue))
            {
                return;
            }
            double arc = Math.PI * _widest[instrument];
            double around = Vector3d.Distance(x[0], x[n]) < _widest[instrument] ? station[n] : double.PositiveInfinity;
            int from = 0;
            for (int i = 0; i < n; i++)
            {
                double clear = station[i + 1] + arc;
                while (from < n && station[from] < clear)
                {
                    from++;
                }
                for (int j = NearPairs.Next(x, n, i, from, reach, longest); j < n;
                    j = NearPairs.Next(x, n, i, j + 1, reach, longest))
                {
                    if (around - station[j + 1] + station[i] < arc)
                    {
                        continue;
                    }
                    double share = Math.Sqrt(ClosestPoints.SegmentSegment(x[i], x[i + 1], x[j], x[j + 1],
                        out double s, out double t)) / (radius[i] + radius[j]);
                    if (share < _least)
                    {
                        (_least, _instrument, _time) = (share, instrument, time);
                        _first = station[i] + s * (station[i + 1] - station[i]);
                        _second = station[j] + t * (station[j + 1] - station[j]);
                    }
                }
            }
        }

        /// <summary>Writes or restores what was seen.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _least);
            snapshot.Serialize(ref _instrument);
            snapshot.Serialize(ref _time);
            snapshot.Serialize(ref _first);
            snapshot.Serialize(ref _second);
        }
    }
}
