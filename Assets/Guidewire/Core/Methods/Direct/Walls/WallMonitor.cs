using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Counts passages through walls from the positions alone, independent of the solver, and records contact
    /// forces.</summary>
    internal sealed class WallMonitor : IWallClearance
    {
        private readonly MaterialRod _rod;
        private readonly WallTerms _walls;
        private readonly BarrierEnergy _barrier;
        private readonly RodVector[] _gradient;
        private readonly double _units;        // per metre
        private readonly double[] _radius;     // of elements, units
        private readonly int[] _hint;
        private readonly PassageCount _passages;
        private readonly Vector3d[] _start;    // of the step, units
        private readonly Vector3d[] _from;     // of the current part
        private readonly Vector3d[] _to;
        private readonly double[] _clearance;  // of elements from all walls at least, where a part begins, units

        /// <summary>A monitor of a rod between walls.</summary>
        public WallMonitor(MaterialRod rod, WallTerms walls, double metresPerUnit)
        {
            BarrierEnergy barrier = walls.Barrier;
            _walls = walls;
            int n = rod.Capacity;
            _rod = rod;
            _barrier = barrier;
            _units = 1.0 / metresPerUnit;
            _radius = new double[n];
            _hint = new int[n * barrier.Walls.Length];
            _start = new Vector3d[n + 1];
            _from = new Vector3d[n + 1];
            _to = new Vector3d[n + 1];
            _clearance = new double[n];
            _gradient = new RodVector[n + 2];
            _passages = new PassageCount(this, n);
            Remesh();
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            Radius = double.PositiveInfinity;
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                _radius[j] = _units * _rod.Radius[j];
                Radius = Math.Min(Radius, _radius[j]);
            }
            Array.Fill(_hint, -1);
            _passages.Remesh(_rod.ElementCount);
        }

        /// <inheritdoc/>
        public ContactShape[] Walls => _barrier.Walls;

        /// <inheritdoc/>
        public double Radius { get; private set; }

        /// <inheritdoc/>
        public double ClearanceOf(int w, int j) => _clearance[j];

        /// <summary>A step begins in this shape.</summary>
        public void BeginStep(RodShape shape)
        {
            _passages.BeginStep();
            SetUnits(shape, _start);
            Array.Copy(_start, _from, _rod.ElementCount + 1);
            SetClearances(shape);
        }

        /// <summary>Takes the shape at the end of a part of the step.</summary>
        public void AddPart(RodShape shape)
        {
            SetUnits(shape, _to);
            _passages.AddPart(_from, _to);
            Array.Copy(_to, _from, _rod.ElementCount + 1);
            SetClearances(shape);
        }

        /// <summary>Why the step does not count, where after its parts an element of a wire that left a vessel by an
        /// open rim lies in the wall from outside; else null.</summary>
        /// <remarks>The barrier keeps nodes off a surface from both sides, but elements only off the edges that bulge
        /// into the lumen. So once the wire is partly outside, the distances of all elements are found.</remarks>
        /// <param name="time">s.</param>
        public string? FindTouchFromBeside(double time)
        {
            int n = _rod.ElementCount;
            for (int w = 0; w < Walls.Length; w++)
            {
                bool isInside = !Walls[w].IsSurface
                    || (!_barrier.SeesBehind && Walls[w].Contains(_from[0]) && Walls[w].Contains(_from[n]));
                for (int j = 0; j < n && !isInside; j++)
                {
                    double radius = _units * _barrier.LawOf(w).RadiusOf(j);
                    if (Walls[w].Nearest(_from[j], _from[j + 1], radius, ref _hint[w * n + j],
                        out SurfaceContact contact) && Math.Abs(contact.Distance) < radius)
                    {
                        return string.Format(CultureInfo.InvariantCulture, "at t = {0:G6} s the wire, which left the "
                            + "vessel by an open rim, would be pressed into its wall from outside at ({1:G4}, {2:G4}, "
                            + "{3:G4}); a vessel that is longer there, or more elements, may help", time,
                            contact.Point.X, contact.Point.Y, contact.Point.Z);
                    }
                }
            }
            return null;
        }

        private void SetClearances(RodShape shape)
        {
            _barrier.Value(shape);
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                _clearance[j] = _barrier.ClearanceOf(j);
            }
        }

        /// <summary>The step ends in this shape.</summary>
        public void EndStep(RodShape shape, ContactRecord record)
        {
            _passages.EndStep(_start, _from);
            record.Passages = _passages.Total;
            double deepest = record.MaxPenetration;
            for (int w = 0; w < Walls.Length; w++)
            {
                for (int j = 0; j < _rod.ElementCount; j++)
                {
                    ref int hint = ref _hint[w * _rod.ElementCount + j];
                    double radius = _units * _barrier.LawOf(w).RadiusOf(j);
                    if (_clearance[j] < radius
                        && Walls[w].Nearest(_from[j], _from[j + 1], radius, ref hint, out SurfaceContact contact))
                    {
                        double distance = Walls[w].IsSurface ? Math.Abs(contact.Distance) : contact.Distance;
                        deepest = Math.Max(deepest, radius - distance);
                    }
                }
            }
            record.MaxPenetration = deepest;
            TakeForces(shape, record);
        }

        /// <summary>Writes or restores the passages so far.</summary>
        public void Serialize(Snapshot snapshot) => _passages.Serialize(snapshot);

        private void TakeForces(RodShape shape, ContactRecord record)
        {
            Vector3d total = Vector3d.Zero;
            Array.Clear(_gradient, 0, _rod.ElementCount + 2);
            _walls.AddWallGradient(shape, _gradient);
            for (int i = 0; i <= _rod.ElementCount; i++)
            {
                RodVector g = _gradient[i];
                record.Forces[i] = -g.X;
                total += record.Forces[i];
            }
            record.SetTotal(total);
            record.WallForces = _barrier.Resultants;
        }

        private void SetUnits(RodShape shape, Vector3d[] x) => _barrier.Nodes.Set(shape, x);
    }
}
