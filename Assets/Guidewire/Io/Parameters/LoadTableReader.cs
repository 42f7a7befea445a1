using System;
using System.Collections.Generic;
using System.IO;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
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
}
