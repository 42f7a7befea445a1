using System;
using System.Collections.Generic;
using System.Linq;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
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
