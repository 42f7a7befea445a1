using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Ends and centreline of a vessel: a tree of points, each with the radius of the largest inscribed
    /// sphere. Lengths in units of the scene, the vessel placed.</summary>
    internal sealed class Anatomy
    {
        /// <summary>A point near the middle of each open rim, in the mesh file's own units and frame.</summary>
        public Vector3d[] OpenRims { get; set; } = Array.Empty<Vector3d>();

        /// <summary>The ends, in the order of their numbers.</summary>
        public IReadOnlyList<VesselEnd> Ends { get; set; } = Array.Empty<VesselEnd>();

        /// <summary>The k points of the centreline.</summary>
        public Vector3d[] Points { get; set; } = Array.Empty<Vector3d>();

        /// <summary>Radius of the sphere at each.</summary>
        public double[] Radii { get; set; } = Array.Empty<double>();

        /// <summary>The point before each, -1 at the root; smaller than its own index.</summary>
        public int[] Parents { get; set; } = Array.Empty<int>();

        /// <summary>The branch of each, an index of <see cref="BranchNames"/>.</summary>
        public int[] Branches { get; set; } = Array.Empty<int>();

        /// <summary>Pairs of points where branches of the tree meet again: the vessel is a loop there.</summary>
        public IReadOnlyList<(int One, int Other)> Links { get; set; } = Array.Empty<(int One, int Other)>();

        /// <summary>Axes of the patient in the scene, as the file states them, or null.</summary>
        public PatientAxes? Axes { get; set; }

        /// <summary>The branches' names.</summary>
        public IReadOnlyList<string> BranchNames { get; set; } = Array.Empty<string>();

        /// <summary>The points next to each: its parent, its children, and those that it meets in a loop.</summary>
        public List<int>[] Neighbours()
        {
            List<int>[] found = Array.ConvertAll(Parents, _ => new List<int>());
            foreach ((int one, int other) in Links.Concat(
                Enumerable.Range(0, Parents.Length).Where(k => Parents[k] >= 0).Select(k => (Parents[k], k))))
            {
                found[one].Add(other);
                found[other].Add(one);
            }
            return found;
        }

        /// <summary>The end with a name, whatever its case, or null.</summary>
        public VesselEnd? Find(string name) =>
            Ends.FirstOrDefault(end => string.Equals(end.Name, name, StringComparison.OrdinalIgnoreCase));

        /// <summary>The end nearest to a point.</summary>
        public VesselEnd Nearest(Vector3d point) => Ends.OrderBy(end => Vector3d.Distance(end.Centre, point)).First();

        /// <summary>The ends as listed in an error line, with number and position.</summary>
        public string List()
        {
            return string.Join(", ", Ends.Take(12).Select(end => string.Format(CultureInfo.InvariantCulture,
                "{0} \"{1}\" at [{2:G4}, {3:G4}, {4:G4}]", end.Number, end.Name, end.Centre.X, end.Centre.Y,
                end.Centre.Z))) + (Ends.Count > 12 ? ", .." : "");
        }
    }

    /// <summary>An end of a vessel: an open rim, or where a branch is closed. Lengths in units of the scene.</summary>
    internal sealed class VesselEnd
    {
        public VesselEnd(int number, string name, in Vector3d centre, double radius, in Vector3d direction, int point)
        {
            Number = number;
            Name = name;
            Centre = centre;
            Radius = radius;
            Direction = direction;
            Point = point;
        }

        /// <summary>The number by which reports and keys name it, from 1.</summary>
        public int Number { get; }

        /// <summary>The name by which reports and keys know it.</summary>
        public string Name { get; }

        /// <summary>The end's middle.</summary>
        public Vector3d Centre { get; }

        /// <summary>The radius of the lumen there.</summary>
        public double Radius { get; }

        /// <summary>The direction of the centreline, into the lumen, of length 1.</summary>
        public Vector3d Direction { get; }

        /// <summary>The centreline's point there.</summary>
        public int Point { get; }
    }
}
