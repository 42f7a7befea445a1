using System;

namespace Guidewire.Core
{
    /// <summary>What points of a wire are asked again and again: features of walls about the points of a lattice, each
    /// found once and kept. A wire that is pushed goes through the same places node after node.</summary>
    /// <remarks>One place in the table for each hash: what was there before is forgotten; and all is where the lists
    /// have grown long. Nothing is allocated once it stands.</remarks>
    internal sealed class FeatureCells
    {
        private const int Places = 1 << 13;
        private const int MostFeatures = 1 << 17;
        private const int LongestList = 1 << 13;    // that is expected
        private const double HalfDiagonal = 0.8661;    // of a lattice's cell, rounded up
        private readonly ContactShape[] _walls;
        private readonly double _size;
        private readonly double _reach;
        private readonly Cell[] _cells = new Cell[Places];

        /// <summary>For walls that stay where they are.</summary>
        /// <param name="walls">The walls.</param>
        /// <param name="reach">What is found holds at least this far about where it was asked for, units.</param>
        public FeatureCells(ContactShape[] walls, double reach)
        {
            _walls = walls;
            _size = 0.5 * reach;
            _reach = reach + HalfDiagonal * _size;
        }

        /// <summary>The lists.</summary>
        public StructList<WallFeature> Features { get; } =
            new StructList<WallFeature>(MostFeatures + LongestList);

        /// <summary>Begins anew where the lists have grown too long; places that were found then hold no longer.
        /// </summary>
        /// <returns>Whether it did.</returns>
        public bool Trim()
        {
            if (Features.Count <= MostFeatures)
            {
                return false;
            }
            Features.Clear();
            Array.Clear(_cells, 0, _cells.Length);
            return true;
        }

        /// <summary>Finds a wall about the lattice point next to a point.</summary>
        /// <param name="w">Which wall.</param>
        /// <param name="x">Units.</param>
        /// <param name="range">Of the features, beyond the reach, units.</param>
        /// <param name="place">Receives it, with its features among <see cref="Features"/>.</param>
        public void Find(int w, in Vector3d x, double range, ref NearPlace place)
        {
            var centre = new Vector3d(
                _size * Math.Round(x.X / _size), _size * Math.Round(x.Y / _size), _size * Math.Round(x.Z / _size));
            double radius = _reach + range;
            ref Cell cell = ref _cells[PlaceOf(w, centre, radius)];
            if (!cell.Is(w, centre, radius))
            {
                int from = Features.Count;
                double distance = _walls[w].FindFeatures(centre, radius, Features);
                cell = new Cell(w, centre, radius, from, Features.Count, distance);
            }
            place.Begin(centre, centre, _reach, cell.From);
            place.End(cell.Distance, radius, cell.To);
        }

        private static int PlaceOf(int w, in Vector3d centre, double radius)
        {
            unchecked
            {
                ulong hash = (ulong)BitConverter.DoubleToInt64Bits(centre.X);
                hash = 0x9E3779B97F4A7C15UL * (hash ^ (hash >> 29)) + (ulong)BitConverter.DoubleToInt64Bits(centre.Y);
                hash = 0x9E3779B97F4A7C15UL * (hash ^ (hash >> 29)) + (ulong)BitConverter.DoubleToInt64Bits(centre.Z);
                hash = 0x9E3779B97F4A7C15UL * (hash ^ (hash >> 29)) + (ulong)BitConverter.DoubleToInt64Bits(radius);
                hash = 0x9E3779B97F4A7C15UL * (hash ^ (hash >> 29)) + (ulong)w;
                return (int)((0x9E3779B97F4A7C15UL * (hash ^ (hash >> 29))) >> 40) & (Places - 1);
            }
        }

        private readonly struct Cell
        {
            public readonly int From;
            public readonly int To;
            public readonly double Distance;
            private readonly int _wall;
            private readonly Vector3d _centre;
            private readonly double _radius;    // 0: nothing was found here

            public Cell(int wall, in Vector3d centre, double radius, int from, int to, double distance)
            {
                _wall = wall;
                _centre = centre;
                _radius = radius;
                From = from;
                To = to;
                Distance = distance;
            }

            public bool Is(int wall, in Vector3d centre, double radius)
            {
                return _radius == radius && _wall == wall && _centre == centre;
            }
        }
    }
}
