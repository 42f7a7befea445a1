using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Counts passages through walls, and of the wire through itself, from the positions alone, independent of
    /// the solver, and records contact forces.</summary>
    internal sealed class WallMonitor : IWallClearance
    {
        private const double Wide = 1.5;       // of the radius: strain and bend may bring a moving wall nearer

        private readonly MaterialRod _rod;
        private readonly WallTerms _walls;
        private readonly BarrierEnergy _barrier;
        private readonly RodVector[] _gradient;
        private readonly double _units;        // per metre
        private readonly double[] _radius;     // of elements, units
        private readonly int[] _hint;
        private readonly PassageCount _passages;
        private readonly StrandMonitor? _strands;   // null where strands do not touch
        private readonly WallImages _start;    // of the step
        private readonly WallImages _from;     // of the current part
        private readonly WallImages _to;
        private readonly Vector3d[] _forces;   // of the walls where the part begins, N; empty where none moves
        private readonly Vector3d[] _ways;     // of the walls, units
        private double _partBegan;             // s
        private double _byBlood;               // work of its drag, J
        private bool _hasForces;               // those of the part that comes next
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
            _start = new WallImages(barrier.Fields, n + 1);
            _from = new WallImages(barrier.Fields, n + 1);
            _to = new WallImages(barrier.Fields, n + 1);
            _forces = new Vector3d[barrier.Fields.Carrier >= 0 ? n + 1 : 0];
            _ways = new Vector3d[_forces.Length];
            _clearance = new double[n];
            _gradient = new RodVector[2 * (n + 1) + 1 + walls.VesselCount];
            _passages = new PassageCount(this, n);
            _strands = walls.Self == null ? null : new StrandMonitor(rod.Length, rod.Radius, rod.ElementCount, true);
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
            _hasForces = false;
            _passages.Remesh(_rod.ElementCount);
            _strands?.Remesh(_rod.ElementCount);
        }

        /// <summary>Work that moving walls have done on the wire so far, J: the mean of their forces where a part of a
        /// step begins and ends, times the ways of the wall at these nodes.</summary>
        public double Work { get; private set; }

        /// <summary>The most that moving walls and the blood in them have put into the wire, J.</summary>
        public double MaxPutIn { get; private set; }

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
            _from.CopyFrom(_start, _rod.ElementCount + 1);
            SetClearances(shape);
            if (!_hasForces)
            {
                BeginWork(shape);
            }
            _strands?.Begin(shape.X);
        }

        /// <summary>Takes the shape at the end of a part of the step.</summary>
        /// <param name="dragPower">By which moving blood drags the wire along at its end, W.</param>
        public void AddPart(RodShape shape, double dragPower)
        {
            if (_walls.Self?.TakeNear() == true)
            {
                _strands!.Follow(shape.X, 0.0);
            }
            else
            {
                _strands?.Begin(shape.X);
            }
            SetUnits(shape, _to);
            for (int w = 0; w < Walls.Length; w++)
            {
                _passages.AddPart(w, _from.OnWall[w], _to.OnWall[w]);
            }
            AddWork(_from, _partBegan, _barrier.Fields.Time);
            _from.CopyFrom(_to, _rod.ElementCount + 1);
            double began = _partBegan;
            SetClearances(shape);
            BeginWork(shape);
            AddWork(_to, began, _partBegan);
            _byBlood += dragPower * (_partBegan - began);
            MaxPutIn = Math.Max(MaxPutIn, Work + _byBlood);
        }

        private void BeginWork(RodShape shape)
        {
            if (_forces.Length > 0)
            {
                _hasForces = true;
                _partBegan = _barrier.Fields.Time;
                SetGradient(shape);
                for (int i = 0; i <= _rod.ElementCount; i++)
                {
                    _forces[i] = -_gradient[i].X;
                }
            }
        }

        // Half of the work of the forces on these nodes while walls move between two times.
        private void AddWork(WallImages nodes, double from, double to)
        {
            int w = _barrier.Fields.Carrier;
            int count = _rod.ElementCount + 1;
            if (w >= 0 && from != to)
            {
                Array.Copy(_forces, _ways, count);
                _barrier.Fields.SetWays(w, nodes.OnWall[w], count, from, to, _ways);
                for (int i = 0; i < count; i++)
                {
                    Work += 0.5 / _units * Vector3d.Dot(_forces[i], _ways[i]);
                }
            }
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
                Vector3d[] x = _from.OnWall[w];
                bool isInside = !Walls[w].IsSurface
                    || (!_barrier.SeesBehind && Walls[w].Contains(x[0]) && Walls[w].Contains(x[n]));
                for (int j = 0; j < n && !isInside; j++)
                {
                    double radius = _units * _barrier.LawOf(w).RadiusOf(j);
                    if (Walls[w].Nearest(x[j], x[j + 1], radius, ref _hint[w * n + j],
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
            for (int w = 0; w < Walls.Length; w++)
            {
                _passages.EndStep(w, _start.OnWall[w], _from.OnWall[w]);
            }
            record.Passages = _passages.Total;
            record.StrandPassages = _strands?.Passages ?? 0;
            double deepest = record.MaxPenetration;
            for (int w = 0; w < Walls.Length; w++)
            {
                for (int j = 0; j < _rod.ElementCount; j++)
                {
                    ref int hint = ref _hint[w * _rod.ElementCount + j];
                    double radius = _units * _barrier.LawOf(w).RadiusOf(j);
                    if (_barrier.Fields.Of[w] is WallField field)
                    {
                        deepest = Math.Max(deepest,
                            DepthInSpace(w, j, field, _barrier.LawOf(w).Narrowest * radius, ref hint));
                        continue;
                    }
                    Vector3d[] x = _from.InSpace;
                    if (_clearance[j] < radius
                        && Walls[w].Nearest(x[j], x[j + 1], radius, ref hint, out SurfaceContact contact))
                    {
                        double distance = Walls[w].IsSurface ? Math.Abs(contact.Distance) : contact.Distance;
                        deepest = Math.Max(deepest, radius - distance);
                    }
                }
            }
            record.MaxPenetration = deepest;
            TakeForces(shape, record);
        }

        // How deep the straight element is in a wall that moves, by distances in space: those at rest over the length
        // of their gradient, at the points of the element that may be nearest.
        private double DepthInSpace(int w, int j, WallField field, double radius, ref int hint)
        {
            const int Pieces = 4;
            double deepest = 0.0;
            for (int k = 0; k <= Pieces && _clearance[j] < Wide * radius; k++)
            {
                Vector3d x = Vector3d.Lerp(_from.InSpace[j], _from.InSpace[j + 1], (double)k / Pieces);
                Vector3d image = field.AtRest(x, out Matrix3 gradient);
                if (Walls[w].Nearest(image, image, Wide * radius, ref hint, out SurfaceContact contact))
                {
                    double distance = Walls[w].IsSurface ? Math.Abs(contact.Distance) : contact.Distance;
                    deepest = Math.Max(deepest,
                        radius - distance / gradient.TransposeTimes(contact.Normal).Length);
                }
            }
            return deepest;
        }

        /// <summary>Writes or restores the passages so far; for a step also the work of moving walls.</summary>
        public void Serialize(Snapshot snapshot)
        {
            _passages.Serialize(snapshot);
            long strands = snapshot.Serialize(_strands?.Passages ?? 0);
            if (_strands != null)
            {
                _strands.Passages = strands;
            }
            if (snapshot.IsStep)
            {
                SerializeWork(snapshot);
            }
        }

        /// <summary>Writes or restores the work of moving walls.</summary>
        public void SerializeWork(Snapshot snapshot)
        {
            Work = snapshot.Serialize(Work);
            MaxPutIn = snapshot.Serialize(MaxPutIn);
            snapshot.Serialize(ref _byBlood);
            snapshot.Serialize(ref _partBegan);
            snapshot.Serialize(ref _hasForces);
            snapshot.Serialize(_forces, _rod.ElementCount + 1);
        }

        private void TakeForces(RodShape shape, ContactRecord record)
        {
            Vector3d total = Vector3d.Zero;
            SetGradient(shape);
            for (int i = 0; i <= _rod.ElementCount; i++)
            {
                RodVector g = _gradient[i];
                record.Forces[i] = -g.X;
                total += record.Forces[i];
            }
            record.SetTotal(total);
            record.WallForces = _barrier.Resultants;
            if (_strands == null)
            {
                return;
            }
            Array.Clear(_gradient, 0, _rod.ElementCount + 2);
            _walls.AddStrandGradient(shape, _gradient);
            for (int i = 0; i <= _rod.ElementCount; i++)
            {
                record.StrandForces[i] = -_gradient[i].X;
            }
        }

        private void SetGradient(RodShape shape)
        {
            Array.Clear(_gradient, 0, _rod.ElementCount + 2);
            _walls.AddWallGradient(shape, _gradient);
        }

        private void SetUnits(RodShape shape, WallImages x)
        {
            _barrier.Nodes.Set(shape, x.InSpace);
            x.Map(_rod.ElementCount + 1);
        }
    }
}
