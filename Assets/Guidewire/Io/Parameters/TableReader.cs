using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads a CSV file of numbers in columns. Lines that begin with # are passed over. A first line of words
    /// names the columns, in any order and with units: time,rotation_deg,insertion_mm. Without one they are in the
    /// order asked for, in SI.</summary>
    internal static class TableReader
    {
        private static readonly char[] Separators = { ';', '\t', ' ' };

        /// <summary>Gives the columns asked for, each with a number for every row, in SI.</summary>
        /// <param name="file">Its full name.</param>
        /// <param name="where">Parameter file and key, for what is refused; ends in ": ".</param>
        /// <exception cref="ParameterException">The file cannot be read, or a line holds something else.</exception>
        public static List<double>[] Read(string file, string where, params TableColumn[] columns)
        {
            string[] lines;
            try
            {
                lines = PlainFile.ReadText(file, "a table").Split('\n');
            }
            catch (ParameterException error)
            {
                throw new ParameterException(where + error.Message);
            }
            List<double>[] read = Array.ConvertAll(columns, _ => new List<double>());
            int[] order = Enumerable.Range(0, columns.Count(column => !column.Missing.HasValue)).ToArray();
            double[] sizes = Array.ConvertAll(columns, _ => 1.0);
            bool mayBeHead = true;
            for (int i = 0; i < lines.Length; i++)
            {
                string line = lines[i].Trim();
                if (line.Length == 0 || line[0] == '#')
                {
                    continue;
                }
                string[] cells = Array.ConvertAll(line.Split(','), cell => cell.Trim().Trim('"').Trim());
                string? problem = mayBeHead && IsHead(cells) ? FindProblemOfHead(cells, columns, ref order, sizes)
                    : FindProblemOfRow(cells, columns, order, sizes, read);
                if (problem != null)
                {
                    throw new ParameterException(where + file + ": line " + (i + 1) + " " + problem);
                }
                mayBeHead = false;
            }
            for (int c = 0; c < columns.Length; c++)
            {
                if (columns[c].Missing is double missing && Array.IndexOf(order, c) < 0)
                {
                    read[c].AddRange(Enumerable.Repeat(missing, read[order[0]].Count));
                }
            }
            return read;
        }

        // Words alone.
        private static bool IsHead(string[] cells) =>
            Array.TrueForAll(cells, cell => cell.Length > 0 && (char.IsLetter(cell[0]) || cell[0] == '_'));

        // Adds a row, whole or not at all.
        private static string? FindProblemOfRow(string[] cells, TableColumn[] columns, int[] order, double[] sizes,
            List<double>[] read)
        {
            var row = new double[cells.Length];
            for (int c = 0; c < cells.Length; c++)
            {
                if (!NumberText.TryRead(cells[c], out row[c]))
                {
                    return "needs " + Needed(columns) + "; it has '" + cells[c] + "'"
                        + (cells[c].IndexOfAny(Separators) < 0 ? "" : ": commas separate columns, and numbers have a "
                            + "decimal point");
                }
            }
            if (row.Length != order.Length)
            {
                return "needs " + Needed(columns) + "; it has " + row.Length + " numbers"
                    + (row.Length > columns.Length ? ": numbers have a decimal point, not a comma" : "");
            }
            for (int c = 0; c < row.Length; c++)
            {
                read[order[c]].Add(sizes[c] * row[c]);
            }
            return null;
        }

        // Where the columns are, and the size of their units in SI.
        private static string? FindProblemOfHead(string[] cells, TableColumn[] columns, ref int[] order,
            double[] sizes)
        {
            order = cells.Length <= columns.Length ? new int[cells.Length] : order;
            var found = new HashSet<int>();
            for (int c = 0; c < cells.Length; c++)
            {
                string name = cells[c].Split(' ', '_', '(', '[')[0];
                string unit = cells[c].Substring(name.Length).Trim(' ', '_', '(', ')', '[', ']');
                int column = Array.FindIndex(columns, one => string.Equals(one.Name, name,
                    StringComparison.OrdinalIgnoreCase));
                if (column < 0)
                {
                    return "has a column '" + cells[c] + "': allowed are " + Names(columns) + ", with commas between"
                        + (cells[c].Contains(';') ? ", no semicolons" : "");
                }
                if (!found.Add(column))
                {
                    return "has the column '" + columns[column].Name + "' twice";
                }
                double size = 1.0;
                if (unit.Length > 0 && !UnitTable.TrySize(unit, columns[column].Of, out size))
                {
                    return "has the column '" + cells[c] + "' in an unknown unit: allowed are "
                        + UnitTable.Of(columns[column].Of);
                }
                if (c < order.Length)
                {
                    (order[c], sizes[c]) = (column, size);
                }
            }
            int missing = Array.FindIndex(columns,
                one => !one.Missing.HasValue && !found.Contains(Array.IndexOf(columns, one)));
            return missing < 0 ? null
                : "has no column '" + columns[missing].Name + "': needed are " + Names(columns);
        }

        private static string Names(TableColumn[] columns) => string.Join(", ", columns.Select(column => column.Name));

        private static string Needed(TableColumn[] columns) =>
            string.Join(", ", columns.Select(column => column.Words)) + " with commas between";
    }

    /// <summary>A column of a CSV file.</summary>
    internal readonly struct TableColumn
    {
        /// <param name="name">In a first line of words.</param>
        /// <param name="of">What its numbers measure.</param>
        /// <param name="missing">The number of every row where the file has no such column; null: it needs it.</param>
        public TableColumn(string name, Dimension of, double? missing = null)
        {
            Name = name;
            Of = of;
            Missing = missing;
        }

        /// <summary>The column's name.</summary>
        public string Name { get; }

        /// <summary>What its numbers measure, in SI without another unit beside the name.</summary>
        public Dimension Of { get; }

        /// <summary>What counts where the file has no such column; null: it needs it.</summary>
        public double? Missing { get; }

        /// <summary>The name with the unit that counts where the file states none.</summary>
        public string Words => Of == Dimension.Number ? Name : Name + " (" + UnitTable.SIUnitOf(Of) + ")";
    }

    /// <summary>A file that a parameter names.</summary>
    internal static class NamedFile
    {
        /// <summary>Its full name: beside the parameter file that names it, or from the current folder, where the
        /// command line names it or where it is only there.</summary>
        /// <param name="file">The name as it was given; an empty one stays empty.</param>
        /// <param name="source">The parameter file, or what counts instead.</param>
        public static string Find(string file, string source)
        {
            string beside = Path.Combine(Path.GetDirectoryName(source) ?? "", file);
            bool isBeside = !CommandLineHandler.IsOverride(source) && (IsThere(beside) || !IsThere(file));
            return file.Length == 0 ? file : Path.GetFullPath(isBeside ? beside : file);
        }

        private static bool IsThere(string file) => File.Exists(file) || Directory.Exists(file);
    }

    /// <summary>Reads the file of key driveFile: a CSV file of time in s, insertion in m and rotation in rad.</summary>
    internal static class DriveTableReader
    {
        /// <summary>Sets the table of a drive; the file's name is replaced by the one that was found.</summary>
        /// <param name="values">Its parameters.</param>
        /// <param name="source">The parameter file that names the table, or "command line".</param>
        /// <exception cref="ParameterException">A file that holds no such table.</exception>
        public static void Read(RunParameters values, string source)
        {
            if (values.DriveFile.Length == 0)
            {
                return;
            }
            values.DriveFile = NamedFile.Find(values.DriveFile, source);
            string where = source + ": driveFile: ";
            List<double>[] columns = TableReader.Read(values.DriveFile, where,
                new TableColumn("time", Dimension.Time), new TableColumn("insertion", Dimension.Length),
                new TableColumn("rotation", Dimension.Angle));
            try
            {
                double[] times = columns[0].ToArray();
                values.Simulation.Drive.Table = new DriveTable(new TimeTable(times, columns[1].ToArray()),
                    new TimeTable(times, columns[2].ToArray()));
            }
            catch (ArgumentException error)
            {
                throw new ParameterException(where + values.DriveFile + ": " + error.Message);
            }
        }
    }

    /// <summary>Reads the tables of key loadTables: CSV files of two columns, time in s and a factor on the load that
    /// names the file.</summary>
    internal static class LoadTableReader
    {
        private static readonly Dictionary<string, Action<SceneParameters, TimeTable>> Loads =
            new Dictionary<string, Action<SceneParameters, TimeTable>>
            {
                ["gravity"] = (scene, table) => scene.GravityTable = table,
                ["tipForce"] = (scene, table) => scene.TipForceTable = table,
                ["distributedForce"] = (scene, table) => scene.DistributedForceTable = table,
                ["pointLoads"] = (scene, table) => scene.PointLoadsTable = table,
                ["axialForce"] = (scene, table) => scene.AxialForceTable = table,
                ["tipMoment"] = (scene, table) => scene.TipMomentTable = table,
                ["tipFollowerForce"] = (scene, table) => scene.TipFollowerForceTable = table,
            };

        /// <summary>Sets the tables of a scene; the files' names are replaced by those that were found.</summary>
        /// <param name="values">Its parameters.</param>
        /// <param name="sourceOf">Who said what stands at a path: a parameter file, or "command line".</param>
        /// <exception cref="ParameterException">A load that has no table, or a file that holds none.</exception>
        public static void Read(RunParameters values, Func<string, string> sourceOf)
        {
            if (!(values.LoadTables is JObject tables))
            {
                return;
            }
            tables = (JObject)tables.DeepClone();
            foreach (JProperty property in tables.Properties())
            {
                string source = sourceOf("loadTables." + property.Name);
                if (!Loads.TryGetValue(property.Name, out Action<SceneParameters, TimeTable>? set)
                    || property.Value.Type != JTokenType.String)
                {
                    throw new ParameterException(source, "loadTables", property.ToString(),
                        "names of CSV files for any of " + string.Join(", ", Loads.Keys));
                }
                string file = NamedFile.Find((string)property.Value!, source);
                set(values.Simulation.Scene, Table(file, source + ": loadTables: " + property.Name + ": "));
                property.Value = file;
            }
            values.LoadTables = tables;
        }

        /// <summary>What the files hold, for the parameter hash.</summary>
        public static string Content(JToken? tables)
        {
            string text = "";
            foreach (JProperty property in (tables as JObject)?.Properties() ?? new JObject().Properties())
            {
                text += property.Name + "=" + File.ReadAllText((string)property.Value!) + "\n";
            }
            return text;
        }

        private static TimeTable Table(string file, string where)
        {
            List<double>[] columns = TableReader.Read(file, where, new TableColumn("time", Dimension.Time),
                new TableColumn("factor", Dimension.Number));
            try
            {
                return new TimeTable(columns[0].ToArray(), columns[1].ToArray());
            }
            catch (ArgumentException error)
            {
                throw new ParameterException(where + file + ": " + error.Message);
            }
        }
    }

    /// <summary>Reads the files of keys proximalMotionFile and distalMotionFile: CSV files of time in s, a displacement
    /// in m and a rotation vector in rad, x, y, z each.</summary>
    internal static class EndMotionReader
    {
        private static readonly TableColumn[] Columns =
        {
            new TableColumn("time", Dimension.Time), new TableColumn("x", Dimension.Length),
            new TableColumn("y", Dimension.Length), new TableColumn("z", Dimension.Length),
            new TableColumn("rx", Dimension.Angle), new TableColumn("ry", Dimension.Angle),
            new TableColumn("rz", Dimension.Angle),
        };

        /// <summary>Sets the motions of a scene; the files' names are replaced by those that were found.</summary>
        /// <param name="values">Its parameters.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <exception cref="ParameterException">A file that holds no such motion.</exception>
        public static void Read(RunParameters values, Func<string, string> sourceOf)
        {
            SceneParameters scene = values.Simulation.Scene;
            values.ProximalMotionFile = Find("proximalMotionFile", values.ProximalMotionFile, sourceOf,
                motion => scene.ProximalMotion = motion);
            values.DistalMotionFile = Find("distalMotionFile", values.DistalMotionFile, sourceOf,
                motion => scene.DistalMotion = motion);
        }

        private static string Find(string key, string file, Func<string, string> sourceOf, Action<EndMotion> set)
        {
            if (file.Length == 0)
            {
                return file;
            }
            string found = NamedFile.Find(file, sourceOf(key));
            string where = sourceOf(key) + ": " + key + ": ";
            List<double>[] columns = TableReader.Read(found, where, Columns);
            try
            {
                set(new EndMotion(columns[0].ToArray(), Vectors(columns, 1), Vectors(columns, 4)));
            }
            catch (ArgumentException error)
            {
                throw new ParameterException(where + found + ": " + error.Message);
            }
            return found;
        }

        private static Vector3d[] Vectors(List<double>[] columns, int first)
        {
            var vectors = new Vector3d[columns[0].Count];
            for (int i = 0; i < vectors.Length; i++)
            {
                vectors[i] = new Vector3d(columns[first][i], columns[first + 1][i], columns[first + 2][i]);
            }
            return vectors;
        }
    }
}
