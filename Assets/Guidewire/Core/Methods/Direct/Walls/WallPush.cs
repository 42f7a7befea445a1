using System;

namespace Guidewire.Core
{
    /// <summary>Moves nodes off the walls, until no gap of a shape is less than it was in another shape or half of the
    /// barrier's distance, but for what one push does to the next.</summary>
    internal sealed class WallPush
    {
        private const double PushedTo = 0.5;      // of the barrier's distance
        private const double LeastLever = 0.1;
        private readonly BarrierEnergy _barrier;
        private readonly double _units;           // per metre
        private readonly StructList<WallPlace> _places = new StructList<WallPlace>(16);
        private readonly StructList<WallRidge> _ridges = new StructList<WallRidge>(16);

        /// <summary>Off the walls of a barrier.</summary>
        public WallPush(BarrierEnergy barrier)
        {
            _barrier = barrier;
            _units = barrier.UnitsPerMetre;
        }

        /// <summary>Moves nodes of a shape.</summary>
        /// <param name="before">The other shape.</param>
        /// <param name="shape">Its nodes 1 to <paramref name="last"/> are moved.</param>
        /// <param name="last">Up to n.</param>
        public void Apply(RodShape before, RodShape shape, int last)
        {
            NearWalls near = _barrier.Cover(before, shape);
            int n = shape.ElementCount;
            for (int w = 0; w < _barrier.Walls.Length; w++)
            {
                for (int i = 1; i <= last; i++)
                {
                    if ((i < n && near.IsNear(w, i)) || near.IsNear(w, i - 1))
                    {
                        PushNode(w, i, near.FeaturesOfNode(w, i), ref shape.X[i]);
                    }
                }
                for (int j = 0; j < n; j++)
                {
                    if (near.IsNear(w, j))
                    {
                        PushElement(w, j, near.FeaturesOf(w, j), shape, last);
                    }
                }
            }
        }

        private void PushNode(int w, int i, FeatureRange features, ref Vector3d x)
        {
            double radius = _barrier.RadiusOfNode(i);
            double asked = Math.Min(_barrier.NodeGap(w, i), PushedTo * _barrier.Barrier.Distance);
            _places.Clear();
            _barrier.Walls[w].FindPlaces(_units * x, _units * (radius + asked), features, _places);
            for (int k = 0; k < _places.Count; k++)
            {
                ref WallPlace at = ref _places[k];
                double gap = at.Contact.Distance / _units - radius;
                if (gap < asked && at.Weight > 0)
                {
                    x += (asked - gap) * at.Contact.Normal;
                    return;
                }
            }
        }

        private void PushElement(int w, int j, FeatureRange features, RodShape shape, int last)
        {
            double radius = _barrier.RadiusOf(j);
            double asked = Math.Min(_barrier.RidgeGap(w, j), PushedTo * _barrier.Barrier.Distance);
            _ridges.Clear();
            _barrier.Walls[w].FindRidges(_units * shape.X[j], _units * shape.X[j + 1], _units * (radius + asked),
                features, _ridges);
            for (int k = 0; k < _ridges.Count; k++)
            {
                ref WallRidge ridge = ref _ridges[k];
                double gap = ridge.Distance / _units - radius;
                if (gap < asked)
                {
                    double a = j > 0 ? 1.0 - ridge.Position : 0.0;
                    double b = j < last ? ridge.Position : 0.0;
                    double share = (asked - gap) / Math.Max(a * a + b * b, LeastLever);
                    shape.X[j] += share * a * ridge.Normal;
                    shape.X[j + 1] += share * b * ridge.Normal;
                    return;
                }
            }
        }
    }
}
