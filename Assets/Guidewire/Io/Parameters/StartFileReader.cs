using System;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads a start other than the straight wire: {"positions": [[x, y, z], ...] (n + 1, units),
    /// "orientations": [[x, y, z, w], ...] (n), "velocities": (n + 1, unit/s) and "angularVelocities": (n, rad/s, body
    /// frame), and the clamps' frames "proximalFrame" and "distalFrame" ([x, y, z, w]), the last four
    /// optional}.</summary>
    internal static class StartFileReader
    {
        private static readonly string[] Keys =
        {
            "positions", "orientations", "velocities", "angularVelocities", "proximalFrame", "distalFrame",
        };

        /// <summary>The start that a file holds.</summary>
        /// <exception cref="ParameterException">The file cannot be read or does not fit a wire of n
        /// elements.</exception>
        public static RodStart Read(string file, int n)
        {
            JObject root = JsonText.ReadObject(file);
            foreach (JProperty property in root.Properties())
            {
                if (Array.IndexOf(Keys, property.Name) < 0)
                {
                    throw new ParameterException(file + ": unknown key '" + property.Name
                        + "': allowed are " + string.Join(", ", Keys));
                }
            }
            var start = new RodStart(
                Vectors(file, root, "positions", n + 1)
                ?? throw Missing(file, "positions", n + 1, "[x, y, z] in units"),
                Orientations(file, root, n),
                Vectors(file, root, "velocities", n + 1),
                Vectors(file, root, "angularVelocities", n));
            start.ProximalFrame = Frame(file, root, "proximalFrame") ?? start.ProximalFrame;
            start.DistalFrame = Frame(file, root, "distalFrame") ?? start.DistalFrame;
            return start;
        }

        private static Vector3d[]? Vectors(string file, JObject root, string key, int count)
        {
            JToken? list = root[key];
            if (list == null)
            {
                return null;
            }
            var vectors = new Vector3d[count];
            if (!(list is JArray array) || array.Count != count)
            {
                throw Missing(file, key, count, "[x, y, z]");
            }
            for (int i = 0; i < count; i++)
            {
                if (!VectorEntry.TryVector(array[i], out vectors[i]))
                {
                    throw new ParameterException(file, key + "[" + i + "]", array[i].ToString(),
                        "three numbers [x, y, z]");
                }
            }
            return vectors;
        }

        private static Quaterniond[] Orientations(string file, JObject root, int n)
        {
            if (!(root["orientations"] is JArray array) || array.Count != n)
            {
                throw Missing(file, "orientations", n, "[x, y, z, w]");
            }
            var orientations = new Quaterniond[n];
            for (int j = 0; j < n; j++)
            {
                orientations[j] = Orientation(file, "orientations[" + j + "]", array[j]);
            }
            return orientations;
        }

        private static Quaterniond? Frame(string file, JObject root, string key)
        {
            return root[key] is JToken value ? Orientation(file, key, value) : (Quaterniond?)null;
        }

        private static Quaterniond Orientation(string file, string key, JToken value)
        {
            var parts = new double[4];
            bool valid = value is JArray four && four.Count == 4;
            for (int k = 0; k < 4 && valid; k++)
            {
                valid = NumberEntry.TryNumber(value[k]!, out parts[k]);
            }
            var orientation = new Quaterniond(parts[0], parts[1], parts[2], parts[3]);
            return valid && orientation.LengthSquared > 1e-12 ? orientation
                : throw new ParameterException(file, key, value.ToString(),
                    "four numbers [x, y, z, w], not all 0");
        }

        private static ParameterException Missing(string file, string key, int count, string items)
        {
            return new ParameterException(file + ": " + key + " needs a list of " + count + " " + items
                + " (numberRodElements decides the count)");
        }
    }
}
