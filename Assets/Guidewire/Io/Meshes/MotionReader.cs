using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads how a wall moves.</summary>
    internal static class MotionReader
    {
        /// <summary>The field of a wall that says so.</summary>
        public const string Key = "motion";

        internal const string Period = "period";
        internal const string HeartRate = "heartRate";
        internal const string Phase = "phase";
        private const string Rigid = "rigid";
        private const string Centreline = "centreline";
        private const string Frames = "frames";
        private const string Spacing = "spacing";
        private const string RampTime = "rampTime";
        internal const string Breathing = "breathing";
        private const string WithVessel = "vessel";
        private const double DefaultSpacing = 2e-3;    // m
        private const double Radians = Math.PI / 180.0;
        private const int MostPoints = 5000;           // of all branches
        private const double NearWall = 0.25;          // of the spacing
        private const double FarVertices = 0.1;        // of a mesh, such as those of the lids of its ends

        private static readonly string[] Given = { Rigid, Centreline, Frames };
        private static readonly string[] OfCycle = { Period, HeartRate, Phase, Rigid, Centreline, Frames };

        /// <summary>What a wall's field says; null: it stands still.</summary>
        /// <param name="values">The scene, whose anatomy may have the centreline.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <param name="vessel">The vessel's wall, or the obstacle's.</param>
        /// <param name="last">The motion of the vessel that was read last; null for an obstacle.</param>
        /// <exception cref="ParameterException">A value that is not allowed, or a field that folds.</exception>
        public static WallMotion? Read(JsonFields fields, RunParameters values, Func<string, string> sourceOf,
            ContactShape wall, WallMotion? vessel, LastMotion? last = null)
        {
            if (!fields.Has(Key))
            {
                return null;
            }
            if (fields.IsText(Key))
            {
                return fields.Text(Key) == WithVessel && vessel != null ? vessel
                    : throw fields.Wrong(Key, "an object {\"period\": ...}, or of an obstacle \"vessel\", whose motion "
                        + "it then has");
            }
            JsonFields own = fields.Object(Key);
            own.Allow(OfCycle.Concat(new[] { Spacing, RampTime, Breathing }).ToArray());
            double units = 1.0 / values.Simulation.Scene.MetresPerUnit;
            double spacing = units * own.Positive(Spacing, "m", DefaultSpacing);
            var branches = new List<Vector3d[]>();
            var cycles = new List<MotionCycle>();
            JsonFields? breathing = own.Has(Breathing) ? own.Object(Breathing) : null;
            breathing?.Allow(OfCycle);
            FindFiles(own, sourceOf);
            FindFiles(breathing, sourceOf);
            WallMotion? known = last?.Find(values);
            ReadCycle(own, fields, values, sourceOf, wall, spacing, cycles, branches, known);
            if (breathing != null)
            {
                ReadCycle(breathing, fields, values, sourceOf, wall, spacing, cycles, branches, known);
            }
            double ramp = own.Number(RampTime, 0.25 * cycles[0].Period);
            if (!(ramp >= 0.0))
            {
                throw own.Wrong(RampTime, "a number >= 0 (s)");
            }
            var motion = new WallMotion(cycles, branches, spacing, ramp);
            string? fold = known != null ? null : motion.FindFold(
                branches.SelectMany(branch => branch).Concat(wall.SurfacePoints()).ToArray());
            if (fold != null)
            {
                throw own.Refused(fold);
            }
            last?.Keep(motion);
            return motion;
        }

        /// <summary>What the files of all walls hold, for the parameter hash.</summary>
        public static string Content(JToken? wall)
        {
            string text = "";
            foreach (JToken? cycle in new[] { wall?[Key], (wall?[Key] as JObject)?[Breathing] })
            {
                foreach (string key in new[] { Rigid, Centreline })
                {
                    if ((cycle as JObject)?[key] is JValue file && file.Type == JTokenType.String)
                    {
                        text += key + "=" + File.ReadAllText((string)file!) + "\n";
                    }
                }
                foreach (JToken frame in (cycle as JObject)?[Frames] as JArray ?? new JArray())
                {
                    text += Frames + "=" + KeptMeshes.Sum(MeshFile.ReadBytes((string)frame!)) + "\n";
                }
            }
            return text;
        }

        /// <summary>Leaves out what the files are called.</summary>
        public static void RemoveFiles(JObject wall)
        {
            foreach (JToken? cycle in new[] { wall[Key], (wall[Key] as JObject)?[Breathing] })
            {
                foreach (JProperty property in ((cycle as JObject) ?? new JObject()).Properties()
                    .Where(own => own.Value.Type == JTokenType.String || own.Name == Frames).ToArray())
                {
                    property.Remove();
                }
            }
        }

        private static void ReadCycle(JsonFields fields, JsonFields vessel, RunParameters values,
            Func<string, string> sourceOf, ContactShape wall, double spacing, List<MotionCycle> cycles,
            List<Vector3d[]> branches, WallMotion? known)
        {
            if (fields.Has(Period) == fields.Has(HeartRate))
            {
                throw fields.Wrong(fields.Has(Period) ? HeartRate : Period, fields.Has(Period)
                    ? "no period beside it" : "a number > 0 (s), or a heartRate in its place");
            }
            double period = fields.Has(Period) ? fields.Positive(Period, "s")
                : 60.0 / fields.Positive(HeartRate, "beats per minute");
            double phase = fields.Number(Phase, 0.0);
            if (!(phase >= 0.0 && phase <= 1.0))
            {
                throw fields.Wrong(Phase, "a number from 0 to 1");
            }
            string[] given = Array.FindAll(Given, fields.Has);
            if (given.Length != 1)
            {
                throw fields.Wrong(given.LastOrDefault() ?? Rigid, "one of rigid, centreline and frames");
            }
            double units = 1.0 / values.Simulation.Scene.MetresPerUnit;
            if (!fields.Has(Rigid))
            {
                if (branches.Count > 0)
                {
                    throw fields.Wrong(given[0], "rigid: only one cycle may move the centreline");
                }
                if (known != null)
                {
                    branches.AddRange(known.Branches);
                    cycles.Add(known.Cycles[cycles.Count].At(period, phase));
                    return;
                }
                cycles.Add(fields.Has(Frames)
                    ? OfFrames(fields, vessel, values, wall, spacing, (period, phase), branches)
                    : OfCentreline(fields, values, sourceOf, spacing, (period, phase), branches));
            }
            else if (fields.IsText(Rigid))
            {
                List<double>[] table = Table(fields, Rigid, sourceOf, new TableColumn("phase", Dimension.Number),
                    new TableColumn("x", Dimension.Length, 0.0), new TableColumn("y", Dimension.Length, 0.0),
                    new TableColumn("z", Dimension.Length, 0.0), new TableColumn("rx", Dimension.Angle, 0.0),
                    new TableColumn("ry", Dimension.Angle, 0.0), new TableColumn("rz", Dimension.Angle, 0.0));
                double[] phases = Phases(fields, Rigid, table[0]);
                cycles.Add(MotionCycle.Table(period, phase, phases, phases.Select((_, k) => Enumerable.Range(1, 6)
                    .Select(c => (c < 4 ? units : 1.0) * table[c][k]).ToArray()).ToArray(), Vector3d.Zero));
            }
            else
            {
                JsonFields rigid = fields.Object(Rigid);
                rigid.Allow("translation", "rotation", "about");
                cycles.Add(MotionCycle.Sine(period, phase, rigid.Vector("translation", Vector3d.Zero),
                    Radians * rigid.Vector("rotation", Vector3d.Zero), rigid.Vector("about", Vector3d.Zero)));
            }
        }

        // A row for each station of each branch at each phase: where it is then, or its displacement.
        private static MotionCycle OfCentreline(JsonFields fields, RunParameters values, Func<string, string> sourceOf,
            double spacing, (double Period, double Phase) cycle, List<Vector3d[]> branches)
        {
            double units = 1.0 / values.Simulation.Scene.MetresPerUnit;
            List<double>[] table = Table(fields, Centreline, sourceOf, new TableColumn("branch", Dimension.Number, 0.0),
                new TableColumn("station", Dimension.Length), new TableColumn("phase", Dimension.Number),
                new TableColumn("x", Dimension.Length), new TableColumn("y", Dimension.Length),
                new TableColumn("z", Dimension.Length), new TableColumn("dx", Dimension.Length, 0.0),
                new TableColumn("dy", Dimension.Length, 0.0), new TableColumn("dz", Dimension.Length, 0.0),
                new TableColumn("rx", Dimension.Angle, 0.0), new TableColumn("ry", Dimension.Angle, 0.0),
                new TableColumn("rz", Dimension.Angle, 0.0), new TableColumn("scale", Dimension.Number, 1.0));
            if (table[12].Any(scale => !(scale > 0.0)))
            {
                throw fields.Wrong(Centreline, "a table whose scale is > 0 everywhere");
            }
            double[] phases = Phases(fields, Centreline, table[2].Distinct().OrderBy(own => own).ToList());
            Placement placement = PlacementOf(values);
            if (!placement.IsUniform && table.Skip(9).Take(3).Any(column => column.Any(turn => turn != 0.0)))
            {
                throw fields.Wrong(Centreline, "a table without rotations where the key scale has different factors");
            }
            List<double[]>[] rows = Array.ConvertAll(phases, _ => new List<double[]>());
            foreach (IGrouping<double, int> branch in Enumerable.Range(0, table[0].Count)
                .GroupBy(row => table[0][row]).OrderBy(group => group.Key))
            {
                double[] stations = branch.Select(row => table[1][row]).Distinct().OrderBy(own => own).ToArray();
                // Position at rest, displacement, rotation and change of scale, by phase and station.
                double[][][] given = Array.ConvertAll(phases, _ => new double[stations.Length][]);
                foreach (int row in branch)
                {
                    Vector3d rest = placement.Apply(units * new Vector3d(table[3][row], table[4][row], table[5][row]));
                    Vector3d way = placement.ApplyToWay(
                        units * new Vector3d(table[6][row], table[7][row], table[8][row]));
                    Vector3d turn = placement.ApplyToTurn(
                        new Vector3d(table[9][row], table[10][row], table[11][row]));
                    given[Array.IndexOf(phases, table[2][row])][Array.IndexOf(stations, table[1][row])] = new[]
                    {
                        rest.X, rest.Y, rest.Z, way.X, way.Y, way.Z, turn.X, turn.Y, turn.Z, table[12][row] - 1.0,
                    };
                }
                if (given.Any(moment => moment.Any(row => row == null)) || stations.Length < 2)
                {
                    throw fields.Wrong(Centreline, "a table with at least two stations of each branch, each at every "
                        + "phase: branch " + branch.Key + " has not");
                }
                AddBranch(fields, branches, Resample(units, spacing, stations, given, rows));
            }
            return MotionCycle.Table(cycle.Period, cycle.Phase, phases,
                Array.ConvertAll(rows, moment => moment.SelectMany(row => row).ToArray()), null);
        }

        // Meshes of one topology at even phases, of which the first is the vessel at rest.
        private static MotionCycle OfFrames(JsonFields fields, JsonFields vessel, RunParameters values,
            ContactShape wall, double spacing, (double Period, double Phase) cycle, List<Vector3d[]> branches)
        {
            if (values.Anatomy == null || !(wall is MeshShape))
            {
                throw fields.Wrong(Frames, "a vessel that is a mesh with a centreline: it needs vessel.anatomy, the "
                    + "file that the command anatomy writes beside a mesh");
            }
            List<string> files = fields.Texts(Frames);
            if (files.Count < 3)
            {
                throw fields.Wrong(Frames, "a list of three or more meshes of one cycle");
            }
            double unit = values.Simulation.Scene.MetresPerUnit;
            double scale = vessel.Number("metresPerUnit", unit) / unit;
            Placement placement = PlacementOf(values);
            var frames = new Vector3d[files.Count][];
            List<int>? triangles = null;
            for (int p = 0; p < frames.Length; p++)
            {
                (List<Vector3d> Vertices, List<int> Triangles) mesh = MeshFile.ReadFaces(files[p]);
                triangles ??= mesh.Triangles;
                if (!triangles.SequenceEqual(mesh.Triangles) || (p > 0 && mesh.Vertices.Count != frames[0].Length))
                {
                    throw fields.Refused(Frames + ": " + files[p] + " has other triangles than " + files[0]
                        + ": all need the same vertices in the same order");
                }
                frames[p] = mesh.Vertices.Select(vertex => placement.Apply(scale * vertex)).ToArray();
            }
            int far = frames[0].Count(vertex =>
            {
                int hint = -1;
                return !wall.Nearest(vertex, vertex, NearWall * spacing, ref hint, out _);
            });
            if (far > FarVertices * frames[0].Length)
            {
                throw fields.Refused(FormattableString.Invariant(
                    $"{Frames}: {files[0]} is not the vessel at rest: {far} of its {frames[0].Length} vertices are ")
                    + FormattableString.Invariant($"farther from its wall than {unit * NearWall * spacing:G3} m"));
            }
            foreach (Vector3d[] line in values.Anatomy.BranchLines())
            {
                var stations = new double[line.Length];
                for (int k = 1; k < line.Length; k++)
                {
                    stations[k] = stations[k - 1] + Vector3d.Distance(line[k - 1], line[k]);
                }
                AddBranch(fields, branches, Resample(1.0, spacing, stations,
                    new[] { Array.ConvertAll(line, c => new[] { c.X, c.Y, c.Z }) }, null));
            }
            double[] phases = Enumerable.Range(0, frames.Length).Select(p => (double)p / frames.Length).ToArray();
            try
            {
                var fitted = MotionCycle.Table(cycle.Period, cycle.Phase, phases,
                    FrameFit.Rows(branches, spacing, frames), null);
                fitted.Misfit = FrameFit.Misfit(fitted, branches, spacing, frames);
                return fitted;
            }
            catch (ArgumentException error)
            {
                throw fields.Refused(Frames + ": " + files[0] + " " + error.Message);
            }
        }

        private static Placement PlacementOf(RunParameters values) =>
            new Placement(values.Position, Placement.FromEulerDegrees(values.Rotation), values.Scale);

        private static void AddBranch(JsonFields fields, List<Vector3d[]> branches, Vector3d[] points)
        {
            branches.Add(points);
            if (branches.Sum(branch => branch.Length) > MostPoints)
            {
                throw fields.Wrong(Spacing, "a larger one: the centreline has more than " + MostPoints + " points");
            }
        }

        // Points of a branch a spacing apart, by splines through its stations.
        private static Vector3d[] Resample(double units, double spacing, double[] stations, double[][][] given,
            List<double[]>[]? rows)
        {
            double length = units * (stations[stations.Length - 1] - stations[0]);
            int count = Math.Max(2, (int)Math.Min(MostPoints + 1, Math.Round(length / spacing) + 1.0));
            var points = new Vector3d[count];
            var values = new double[given[0][0].Length];
            for (int p = 0; p < given.Length; p++)
            {
                var spline = new CubicSpline(stations, given[p]);
                for (int k = 0; k < count; k++)
                {
                    spline.Evaluate(stations[0] + length / units * k / (count - 1), values);
                    points[k] = p == 0 ? new Vector3d(values[0], values[1], values[2]) : points[k];
                    rows?[p].Add(values.Skip(3).ToArray());
                }
            }
            return points;
        }

        private static List<double>[] Table(JsonFields fields, string key, Func<string, string> sourceOf,
            params TableColumn[] columns)
        {
            string path = fields.Key + "." + key;
            return TableReader.Read(fields.Text(key), sourceOf(path) + ": " + path + ": ", columns);
        }

        private static void FindFiles(JsonFields? cycle, Func<string, string> sourceOf)
        {
            foreach (string key in new[] { Rigid, Centreline })
            {
                if (cycle != null && cycle.IsText(key))
                {
                    cycle.Replace(key, NamedFile.Find(cycle.Text(key), sourceOf(cycle.Key + "." + key)));
                }
            }
            if (cycle != null && cycle.Has(Frames))
            {
                cycle.Replace(Frames, new JArray(cycle.Texts(Frames)
                    .Select(file => NamedFile.Find(file, sourceOf(cycle.Key + "." + Frames)))));
            }
        }

        private static double[] Phases(JsonFields fields, string key, List<double> phases)
        {
            double[] own = phases.ToArray();
            for (int k = 0; k < own.Length; k++)
            {
                if (!(own[k] >= 0.0 && own[k] < 1.0) || (k > 0 && !(own[k] > own[k - 1])))
                {
                    throw fields.Wrong(key, "a table with phases that increase from 0 to less than 1");
                }
            }
            return own.Length >= 3 ? own : throw fields.Wrong(key, "a table of at least three phases");
        }
    }

    /// <summary>Keeps the motion that was read last: a vessel that only beats faster, begins at another phase or has
    /// another friction is neither read nor searched for folds again. Runs have the same bits either way.</summary>
    internal sealed class LastMotion
    {
        private string? _asked;    // what the parameters say of the vessel that was asked for
        private string? _vessel;
        private WallMotion? _motion;

        /// <summary>The motion of the vessel of these parameters, but for its period and phase; null: it is another
        /// one.</summary>
        public WallMotion? Find(RunParameters values)
        {
            try
            {
                _asked = TextOf(values);
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException)
            {
                _asked = null;    // whoever reads the file says so
            }
            return _asked != null && _asked == _vessel ? _motion : null;
        }

        /// <summary>Keeps a motion that does not fold the vessel that was asked for.</summary>
        public void Keep(WallMotion motion) => (_vessel, _motion) = (_asked, motion);

        // With the sum of its mesh and the content of its tables.
        private static string TextOf(RunParameters values)
        {
            var vessel = (JObject)values.Vessel!.DeepClone();
            vessel.Remove("frictionCoefficient");
            if (vessel[MotionReader.Key] is JObject motion && !motion.ContainsKey(MotionReader.Breathing))
            {
                // Of one cycle alone all phases are the same, however fast it is.
                motion.Remove(MotionReader.Period);
                motion.Remove(MotionReader.HeartRate);
                motion.Remove(MotionReader.Phase);
            }
            var placed = new JArray(values.Simulation.Scene.MetresPerUnit);
            foreach (Vector3d part in new[] { values.Position, values.Rotation, values.Scale })
            {
                placed.Add(new JArray(part.X, part.Y, part.Z));
            }
            return NumberText.Write(vessel) + NumberText.Write(placed) + MotionReader.Content(values.Vessel);
        }
    }
}
