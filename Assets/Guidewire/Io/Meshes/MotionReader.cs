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

        private const string Period = "period";
        private const string HeartRate = "heartRate";
        private const string Phase = "phase";
        private const string Rigid = "rigid";
        private const string Centreline = "centreline";
        private const string Spacing = "spacing";
        private const string RampTime = "rampTime";
        private const string Breathing = "breathing";
        private const string WithVessel = "vessel";
        private const double DefaultSpacing = 2e-3;    // m
        private const double Radians = Math.PI / 180.0;
        private const int MostPoints = 5000;           // of all branches

        private static readonly string[] OfCycle = { Period, HeartRate, Phase, Rigid, Centreline };

        /// <summary>What a wall's field says; null: it stands still.</summary>
        /// <param name="values">The scene, whose anatomy may have the centreline.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <param name="vessel">The vessel's wall, or the obstacle's.</param>
        /// <exception cref="ParameterException">A value that is not allowed, or a field that folds.</exception>
        public static WallMotion? Read(JsonFields fields, RunParameters values, Func<string, string> sourceOf,
            ContactShape wall, WallMotion? vessel)
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
            double spacing = units * Positive(own, Spacing, DefaultSpacing, "m");
            var branches = new List<Vector3d[]>();
            var cycles = new List<MotionCycle>();
            ReadCycle(own, values, sourceOf, spacing, cycles, branches);
            if (own.Has(Breathing))
            {
                JsonFields breathing = own.Object(Breathing);
                breathing.Allow(OfCycle);
                ReadCycle(breathing, values, sourceOf, spacing, cycles, branches);
            }
            double ramp = own.Number(RampTime, 0.25 * cycles[0].Period);
            if (!(ramp >= 0.0))
            {
                throw own.Wrong(RampTime, "a number >= 0 (s)");
            }
            var motion = new WallMotion(cycles, branches, spacing, ramp);
            string? fold = motion.FindFold(
                branches.SelectMany(branch => branch).Concat(wall.SurfacePoints()).ToArray());
            return fold == null ? motion : throw own.Refused(fold);
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
            }
            return text;
        }

        /// <summary>Leaves out what the files are called.</summary>
        public static void RemoveFiles(JObject wall)
        {
            foreach (JToken? cycle in new[] { wall[Key], (wall[Key] as JObject)?[Breathing] })
            {
                foreach (JProperty property in ((cycle as JObject) ?? new JObject()).Properties()
                    .Where(own => own.Value.Type == JTokenType.String).ToArray())
                {
                    property.Remove();
                }
            }
        }

        private static void ReadCycle(JsonFields fields, RunParameters values, Func<string, string> sourceOf,
            double spacing, List<MotionCycle> cycles, List<Vector3d[]> branches)
        {
            if (fields.Has(Period) == fields.Has(HeartRate))
            {
                throw fields.Wrong(fields.Has(Period) ? HeartRate : Period, fields.Has(Period)
                    ? "no period beside it" : "a number > 0 (s), or a heartRate in its place");
            }
            double period = fields.Has(Period) ? Positive(fields, Period, 0.0, "s")
                : 60.0 / Positive(fields, HeartRate, 0.0, "beats per minute");
            double phase = fields.Number(Phase, 0.0);
            if (!(phase >= 0.0 && phase <= 1.0))
            {
                throw fields.Wrong(Phase, "a number from 0 to 1");
            }
            if (fields.Has(Rigid) == fields.Has(Centreline))
            {
                throw fields.Wrong(Rigid, "one of rigid and centreline");
            }
            double units = 1.0 / values.Simulation.Scene.MetresPerUnit;
            if (fields.Has(Centreline))
            {
                if (branches.Count > 0)
                {
                    throw fields.Wrong(Centreline, "rigid: only one cycle may move the centreline");
                }
                cycles.Add(OfCentreline(fields, values, sourceOf, spacing, (period, phase), branches));
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
            double[] phases = Phases(fields, Centreline, table[2].Distinct().OrderBy(own => own).ToList());
            var placement = new Placement(values.Position, Placement.FromEulerDegrees(values.Rotation), values.Scale);
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
                    given[Array.IndexOf(phases, table[2][row])][Array.IndexOf(stations, table[1][row])] = new[]
                    {
                        rest.X, rest.Y, rest.Z, units * table[6][row], units * table[7][row], units * table[8][row],
                        table[9][row], table[10][row], table[11][row], table[12][row] - 1.0,
                    };
                }
                if (given.Any(moment => moment.Any(row => row == null)) || stations.Length < 2)
                {
                    throw fields.Wrong(Centreline, "a table with at least two stations of each branch, each at every "
                        + "phase: branch " + branch.Key + " has not");
                }
                branches.Add(Resample(units, spacing, stations, given, rows));
                if (rows[0].Count > MostPoints)
                {
                    throw fields.Wrong(Spacing, "a larger one: the centreline has more than " + MostPoints + " points");
                }
            }
            return MotionCycle.Table(cycle.Period, cycle.Phase, phases,
                Array.ConvertAll(rows, moment => moment.SelectMany(row => row).ToArray()), null);
        }

        // Points of a branch a spacing apart, by splines through its stations.
        private static Vector3d[] Resample(double units, double spacing, double[] stations, double[][][] given,
            List<double[]>[] rows)
        {
            double length = units * (stations[stations.Length - 1] - stations[0]);
            int count = Math.Max(2, (int)Math.Min(MostPoints, Math.Round(length / spacing) + 1.0));
            var points = new Vector3d[count];
            var values = new double[10];
            for (int p = 0; p < given.Length; p++)
            {
                var spline = new CubicSpline(stations, given[p]);
                for (int k = 0; k < count; k++)
                {
                    spline.Evaluate(stations[0] + length / units * k / (count - 1), values);
                    points[k] = p == 0 ? new Vector3d(values[0], values[1], values[2]) : points[k];
                    rows[p].Add(values.Skip(3).ToArray());
                }
            }
            return points;
        }

        private static List<double>[] Table(JsonFields fields, string key, Func<string, string> sourceOf,
            params TableColumn[] columns)
        {
            string path = fields.Key + "." + key;
            string file = NamedFile.Find(fields.Text(key), sourceOf(path));
            fields.Replace(key, file);
            return TableReader.Read(file, sourceOf(path) + ": " + path + ": ", columns);
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

        private static double Positive(JsonFields fields, string key, double missing, string unit)
        {
            double value = fields.Number(key, missing);
            return value > 0.0 ? value : throw fields.Wrong(key, "a number > 0 (" + unit + ")");
        }
    }
}
