using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

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

        /// <summary>The points of each branch one after another, the first where it leaves another one.</summary>
        public IEnumerable<Vector3d[]> BranchLines()
        {
            for (int b = 0; b < BranchNames.Count; b++)
            {
                var line = new List<Vector3d>();
                int last = -1;
                foreach (int k in Enumerable.Range(0, Points.Length).Where(k => Branches[k] == b))
                {
                    if (Parents[k] != last && line.Count > 1)
                    {
                        yield return line.ToArray();
                    }
                    if (Parents[k] != last)
                    {
                        line.Clear();
                        line.AddRange(Parents[k] < 0 ? Array.Empty<Vector3d>() : new[] { Points[Parents[k]] });
                    }
                    line.Add(Points[k]);
                    last = k;
                }
                if (line.Count > 1)
                {
                    yield return line.ToArray();
                }
            }
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

    /// <summary>Reads the file of a vessel's ends and centreline: {"ends": [{"number", "name", "centre", "radius",
    /// "direction", "open", "point"}, ..], "centreline": {"points": [[x, y, z, radius], ..], "parents": [..],
    /// "branches": [..], "names": [..], "links": [[one, other], ..]}}, lengths in the mesh's units.</summary>
    internal static class AnatomyReader
    {
        /// <summary>The anatomy that the key vessel names, placed as the vessel is; null where it names none.</summary>
        /// <param name="values">The parameters of the run; the file's name is replaced by the one that was
        /// found.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <exception cref="ParameterException">A file that cannot be read or holds no anatomy.</exception>
        public static Anatomy? Read(RunParameters values, Func<string, string> sourceOf)
        {
            if (!(values.Vessel is JObject vessel) || vessel["anatomy"] == null)
            {
                return null;
            }
            var fields = new JsonFields(sourceOf, "vessel", vessel);
            string file = NamedFile.Find(fields.Text("anatomy"), sourceOf("vessel.anatomy"));
            if (file.Length == 0)
            {
                throw fields.Wrong("anatomy", "the name of a file that the command anatomy wrote");
            }
            fields.Replace("anatomy", file);
            double unit = values.Simulation.Scene.MetresPerUnit;
            double scale = fields.Number("metresPerUnit", unit) / unit;
            return Read(file, scale, values);
        }

        private static Anatomy Read(string file, double scale, RunParameters values)
        {
            JObject root = JsonText.ReadObject(file);
            try
            {
                return Read(root, scale, values);
            }
            catch (Exception error) when (error is NullReferenceException || error is InvalidCastException
                || error is ArgumentException || error is FormatException || error is OverflowException
                || error is InvalidOperationException || error is IndexOutOfRangeException)
            {
                throw new ParameterException(file + ": holds no anatomy as the command anatomy writes it: needs"
                    + " ends, each with number, name, centre, radius, direction, open and point, and centreline with"
                    + " points, parents, branches and names");
            }
        }

        private static Anatomy Read(JObject root, double scale, RunParameters values)
        {
            var placement = new Placement(values.Position, Placement.FromEulerDegrees(values.Rotation), values.Scale);
            double size = scale * Math.Pow(Math.Abs(values.Scale.X * values.Scale.Y * values.Scale.Z), 1.0 / 3.0);
            JToken line = root["centreline"]!;
            double[][] rows = line["points"]!.Select(row => row.Select(Finite).ToArray()).ToArray();
            var anatomy = new Anatomy
            {
                Points = rows.Select(row => placement.Apply(scale * new Vector3d(row[0], row[1], row[2]))).ToArray(),
                Radii = rows.Select(row => size * row[3]).ToArray(),
                Parents = line["parents"]!.Select(item => (int)item).ToArray(),
                Branches = line["branches"]!.Select(item => (int)item - 1).ToArray(),
                BranchNames = line["names"]!.Select(item => (string)item!).ToArray(),
                Links = (line["links"] ?? new JArray()).Select(pair => ((int)pair[0]!, (int)pair[1]!)).ToArray(),
                Axes = PatientAxes.Named((string?)root["patientAxes"] ?? "")?.Turned(placement),
            };
            int count = rows.Length;
            bool isTree = count > 1 && anatomy.Parents.Length == count && anatomy.Branches.Length == count
                && anatomy.Parents[0] == -1 && anatomy.Radii.All(radius => radius > 0.0)
                && Enumerable.Range(1, count - 1).All(k => anatomy.Parents[k] >= 0 && anatomy.Parents[k] < k)
                && anatomy.Links.All(link => link.One >= 0 && link.One < count && link.Other >= 0 && link.Other < count)
                && anatomy.Branches.All(branch => branch >= 0 && branch < anatomy.BranchNames.Count);
            if (!isTree)
            {
                throw new FormatException();
            }
            var ends = new List<VesselEnd>();
            var rims = new List<Vector3d>();
            foreach (JToken end in root["ends"]!)
            {
                Vector3d centre = Vector(end["centre"]!);
                Vector3d placed = placement.Apply(scale * centre);
                Vector3d ahead = placement.Apply(scale * (centre + Vector(end["direction"]!)));
                int point = (int)end["point"]!;
                double radius = size * Finite(end["radius"]!);
                if (point < 0 || point >= count || !(radius > 0.0) || !((ahead - placed).LengthSquared > 0.0))
                {
                    throw new FormatException();
                }
                ends.Add(new VesselEnd((int)end["number"]!, (string)end["name"]!, placed, radius,
                    Vector3d.Normalize(ahead - placed), point));
                if ((bool)end["open"]!)
                {
                    rims.Add(centre);
                }
            }
            anatomy.Ends = ends;
            anatomy.OpenRims = rims.ToArray();
            return ends.Count > 0 ? anatomy : throw new FormatException();
        }

        private static Vector3d Vector(JToken value) =>
            new Vector3d(Finite(value[0]!), Finite(value[1]!), Finite(value[2]!));

        private static double Finite(JToken value)
        {
            return Kinds.TryNumber(value, out double number) && Math.Abs(number) <= 1e9 ? number
                : throw new FormatException();
        }
    }
}
