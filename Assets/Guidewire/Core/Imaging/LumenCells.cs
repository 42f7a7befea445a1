using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>How far the ray through each pixel goes in each cell of a vessel's tree. A place in the lumen belongs
    /// to the
    /// cell whose sphere has the least power at the middle of its voxel, one of 128 along the largest side.</summary>
    internal sealed class LumenCells
    {
        private const int Voxels = 128;

        private readonly Vector3d[] _middles;
        private readonly double[] _radii;
        private readonly Vector3d _low;
        private readonly double _side;
        private readonly double _spacing;
        private readonly int[] _counts = new int[3];
        private readonly short[] _cells;    // of voxels, from 1 on; 0: not asked for yet
        private readonly List<(int Pixel, double Depth, bool IsIn)> _crossings =
            new List<(int Pixel, double Depth, bool IsIn)>();
        private readonly List<(int Pixel, int Cell, double Length)> _parts =
            new List<(int Pixel, int Cell, double Length)>();

        /// <param name="middles">Of the cells, units.</param>
        /// <param name="radii">Units.</param>
        /// <param name="low">Lowest corner of the vessels, units.</param>
        /// <param name="high">Their highest.</param>
        public LumenCells(Vector3d[] middles, double[] radii, in Vector3d low, in Vector3d high)
        {
            (_middles, _radii, _low) = (middles, radii, low);
            Vector3d box = high - low;
            _side = Math.Max(Math.Max(box.X, box.Y), Math.Max(box.Z, 1e-9)) / Voxels;
            _counts[0] = (int)(box.X / _side) + 1;
            _counts[1] = (int)(box.Y / _side) + 1;
            _counts[2] = (int)(box.Z / _side) + 1;
            _cells = new short[_counts[0] * _counts[1] * _counts[2]];
            double sum = 0.0;
            foreach (double radius in radii)
            {
                sum += radius;
            }
            _spacing = sum / radii.Length;
        }

        /// <summary>Looks at the vessels anew.</summary>
        public void Look(CArm arm, IReadOnlyList<LumenThickness> lumens)
        {
            _crossings.Clear();
            _parts.Clear();
            foreach (LumenThickness lumen in lumens)
            {
                lumen.Cross(arm, _crossings);
            }
            _crossings.Sort((one, other) => one.Pixel != other.Pixel ? one.Pixel.CompareTo(other.Pixel)
                : other.Depth.CompareTo(one.Depth));
            int inside = 0;
            for (int k = 0; k + 1 < _crossings.Count; k++)
            {
                (int pixel, double depth, bool isIn) = _crossings[k];
                if (k == 0 || _crossings[k - 1].Pixel != pixel)
                {
                    inside = 0;
                }
                inside += isIn ? 1 : -1;
                if (inside > 0 && _crossings[k + 1].Pixel == pixel)
                {
                    Divide(arm, pixel, depth, _crossings[k + 1].Depth);
                }
            }
        }

        /// <summary>Adds up the agent along each ray, part times units.</summary>
        /// <param name="parts">Of the blood in each cell that is agent.</param>
        /// <param name="sum">Row by row; begins anew.</param>
        public void Sum(ReadOnlySpan<double> parts, double[] sum)
        {
            Array.Clear(sum, 0, sum.Length);
            foreach ((int pixel, int cell, double length) in _parts)
            {
                sum[pixel] += parts[cell] * length;
            }
        }

        private void Divide(CArm arm, int pixel, double from, double to)
        {
            double x = pixel % arm.Pixels + 0.5;
            double y = pixel / arm.Pixels + 0.5;
            double length = (from - to) / arm.Scale;
            int count = Math.Max(1, (int)Math.Ceiling(length / _spacing));
            for (int k = 0; k < count; k++)
            {
                int cell = CellAt(arm.FromDetector(x, y, from + (k + 0.5) / count * (to - from)));
                _parts.Add((pixel, cell, length / count));
            }
        }

        private int CellAt(in Vector3d point)
        {
            int i = Index((point.X - _low.X) / _side, 0);
            int j = Index((point.Y - _low.Y) / _side, 1);
            int k = Index((point.Z - _low.Z) / _side, 2);
            ref short cell = ref _cells[(i * _counts[1] + j) * _counts[2] + k];
            if (cell == 0)
            {
                cell = (short)(1 + VesselCells.Nearest(
                    _low + _side * new Vector3d(i + 0.5, j + 0.5, k + 0.5), _middles, _radii));
            }
            return cell - 1;
        }

        private int Index(double at, int axis) => (int)Math.Max(0.0, Math.Min(_counts[axis] - 1.0, Math.Floor(at)));
    }
}
