using System;
using System.Collections.Generic;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Distances along a vessel's centreline from the inlet, and the position on it nearest to a point of the
    /// lumen.</summary>
    /// <remarks>A point p belongs to the sphere of the centreline with the least |p - c|^2 - r^2, the power of p: not
    /// to the nearest centre, because beside a wide vessel the middle of a narrow one may be nearer to points of the
    /// wide one.</remarks>
    internal sealed class CentrelinePath
    {
        private readonly Anatomy _anatomy;
        private CentrelinePath? _fromTarget;
        private readonly int[] _before;   // next point towards the inlet, -1 there

        /// <param name="anatomy">The vessel.</param>
        /// <param name="inlet">Where distances begin.</param>
        public CentrelinePath(Anatomy anatomy, VesselEnd inlet)
        {
            _anatomy = anatomy;
            Inlet = inlet;
            int count = anatomy.Points.Length;
            _before = new int[count];
            Distances = new double[count];
            Array.Fill(_before, -1);
            Array.Fill(Distances, double.PositiveInfinity);
            Distances[inlet.Point] = 0.0;
            List<int>[] neighbours = anatomy.Neighbours();
            var isDone = new bool[count];
            // Dijkstra's shortest paths: of a loop of vessels the shorter way to each point.
            var waiting = new SortedSet<(double Distance, int Point)> { (0.0, inlet.Point) };
            while (waiting.Count > 0)
            {
                (double distance, int own) = waiting.Min;
                waiting.Remove((distance, own));
                isDone[own] = true;
                foreach (int other in neighbours[own])
                {
                    double through = distance + Vector3d.Distance(anatomy.Points[other], anatomy.Points[own]);
                    if (!isDone[other] && through < Distances[other])
                    {
                        waiting.Remove((Distances[other], other));
                        Distances[other] = through;
                        _before[other] = own;
                        waiting.Add((through, other));
                    }
                }
            }
        }

        /// <summary>The end at which distances begin.</summary>
        public VesselEnd Inlet { get; }

        /// <summary>Where the tip is to come, units; null without a target.</summary>
        public Vector3d? TargetPoint => Target < 0 ? (Vector3d?)null : _anatomy.Points[Target];

        /// <summary>Target of the tip: a point of the centreline; -1 without a target.</summary>
        public int Target { get; private set; } = -1;

        /// <summary>Sets the target.</summary>
        /// <param name="target">A point of the centreline.</param>
        /// <param name="name">As it is called.</param>
        /// <param name="reach">How far before the target along the centreline it counts as reached, units: the radius
        /// of the lumen there. At a closed end the sphere of the centreline's last point has none.</param>
        public void SetTarget(int target, string name, double reach)
        {
            (Target, TargetName, Reach) = (target, name, reach);
            Vector3d ahead = _before[target] < 0 ? Inlet.Direction
                : _anatomy.Points[_before[target]] - _anatomy.Points[target];
            ahead = ahead.LengthSquared > 0.0 ? Vector3d.Normalize(ahead) : Inlet.Direction;
            _fromTarget = new CentrelinePath(_anatomy,
                new VesselEnd(0, name, _anatomy.Points[target], reach, ahead, target));
        }

        /// <summary>How far before the target it counts as reached, units.</summary>
        public double Reach { get; private set; }

        /// <summary>The target as it is called.</summary>
        public string TargetName { get; private set; } = "";

        /// <summary>The points of the centreline from the inlet to one of them, units.</summary>
        public Vector3d[] PointsTo(int point)
        {
            var points = new List<Vector3d>();
            for (int k = point; k >= 0; k = _before[k])
            {
                points.Add(_anatomy.Points[k]);
            }
            points.Reverse();
            return points.ToArray();
        }

        /// <summary>The distance of each point of the centreline from the inlet along it, units.</summary>
        public double[] Distances { get; }

        /// <summary>Gives the point of the centreline whose sphere a point of the lumen belongs to.</summary>
        public int Locate(in Vector3d point)
        {
            int best = 0;
            double least = double.PositiveInfinity;
            for (int k = 0; k < Distances.Length; k++)
            {
                double radius = _anatomy.Radii[k];
                double power = (point - _anatomy.Points[k]).LengthSquared - radius * radius;
                if (power < least)
                {
                    least = power;
                    best = k;
                }
            }
            return best;
        }

        /// <summary>Distance of a point from the inlet along the centreline: that of its sphere, and how far the point
        /// is ahead of the centre.</summary>
        /// <param name="point">Units.</param>
        /// <param name="near">The point's sphere.</param>
        public double DistanceOf(in Vector3d point, int near)
        {
            int before = _before[near];
            if (before < 0)
            {
                return Distances[near] + Vector3d.Dot(point - _anatomy.Points[near], Inlet.Direction);
            }
            Vector3d along = Vector3d.Normalize(_anatomy.Points[near] - _anatomy.Points[before]);
            double ahead = Vector3d.Dot(point - _anatomy.Points[near], along);
            double most = Distances[near] - Distances[before];
            return Distances[near] + Math.Max(-most, Math.Min(most, ahead));
        }

        /// <summary>Gives the distance of a point along the centreline to the target, negative beyond it; not a number
        /// without a target.</summary>
        public double LeftFrom(in Vector3d point, int near) =>
            _fromTarget == null ? double.NaN : _fromTarget.DistanceOf(point, near);

        /// <summary>Whether a point of the centreline is at the target: within a radius of it along the centreline, or
        /// beyond it.</summary>
        public bool IsAtTarget(int near)
        {
            if (Target < 0)
            {
                return false;
            }
            for (int k = near; k >= 0; k = _before[k])
            {
                if (k == Target)
                {
                    return true;
                }
            }
            for (int k = Target; k >= 0 && Distances[Target] - Distances[k] <= Reach; k = _before[k])
            {
                if (k == near)
                {
                    return true;
                }
            }
            return false;
        }

        /// <summary>Gives the branch of a point of the centreline, from 0.</summary>
        public int BranchOf(int near) => _anatomy.Branches[near];

        /// <summary>The points of the centreline from the inlet to the target, units, with radii and distances: "name",
        /// "reach", "indices" (in the anatomy's file), "points", "radii", "distances".</summary>
        public JObject RouteToTarget()
        {
            var route = new List<int>();
            for (int k = Target; k >= 0; k = _before[k])
            {
                route.Add(k);
            }
            route.Reverse();
            return new JObject
            {
                ["name"] = TargetName,
                ["reach"] = Reach,
                ["indices"] = new JArray(route),
                ["points"] = new JArray(route.ConvertAll(k =>
                    new JArray(_anatomy.Points[k].X, _anatomy.Points[k].Y, _anatomy.Points[k].Z))),
                ["radii"] = new JArray(route.ConvertAll(k => _anatomy.Radii[k])),
                ["distances"] = new JArray(route.ConvertAll(k => Distances[k])),
            };
        }

        /// <summary>Names of the branches from the inlet to a point of the centreline.</summary>
        public List<string> BranchesTo(int near)
        {
            var names = new List<string>();
            for (int k = near; k >= 0; k = _before[k])
            {
                string name = _anatomy.BranchNames[_anatomy.Branches[k]];
                if (names.Count == 0 || names[names.Count - 1] != name)
                {
                    names.Add(name);
                }
            }
            names.Reverse();
            return names;
        }

        /// <summary>The first point of a branch, seen from the inlet, that is a radius beyond the branch's root; its
        /// last point where the branch is shorter. -1 where no branch has the name.</summary>
        public int Within(string branch)
        {
            int first = -1;
            int found = -1;
            foreach (int k in Ordered())
            {
                if (!string.Equals(_anatomy.BranchNames[_anatomy.Branches[k]], branch,
                    StringComparison.OrdinalIgnoreCase))
                {
                    continue;
                }
                first = first < 0 ? k : first;
                found = k;
                int root = Math.Max(_before[first], 0);
                if (Distances[k] - Distances[first] >= _anatomy.Radii[root])
                {
                    break;
                }
            }
            return found;
        }

        private int[] Ordered()
        {
            var order = new int[Distances.Length];
            for (int k = 0; k < order.Length; k++)
            {
                order[k] = k;
            }
            Array.Sort((double[])Distances.Clone(), order);
            return order;
        }
    }
}
