using System;
using System.Globalization;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads a start other than the straight wire: {"positions": [[x, y, z], ...] (n + 1, units),
    /// "orientations": [[x, y, z, w], ...] (n), "velocities": (n + 1, unit/s) and "angularVelocities": (n, rad/s, body
    /// frame), and the clamps' frames "proximalFrame" and "distalFrame" ([x, y, z, w]), all but the first
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
            return Read(JsonText.ReadObject(file), file, n);
        }

        /// <summary>The start that an object holds.</summary>
        /// <param name="root">The object.</param>
        /// <param name="file">Where it stands, for what is refused.</param>
        /// <param name="n">Elements of the wire.</param>
        /// <exception cref="ParameterException">It does not fit a wire of n elements.</exception>
        public static RodStart Read(JObject root, string file, int n)
        {
            foreach (JProperty property in root.Properties())
            {
                if (Array.IndexOf(Keys, property.Name) < 0)
                {
                    throw new ParameterException(file + ": unknown key '" + property.Name
                        + "': allowed are " + string.Join(", ", Keys));
                }
            }
            Vector3d[] positions = Vectors(file, root, "positions", n + 1)
                ?? throw Missing(file, "positions", n + 1, "[x, y, z] in units");
            var start = new RodStart(positions,
                root["orientations"] == null ? Along(file, positions) : Orientations(file, root, n),
                Vectors(file, root, "velocities", n + 1),
                Vectors(file, root, "angularVelocities", n));
            start.ProximalFrame = Frame(file, root, "proximalFrame");
            start.DistalFrame = Frame(file, root, "distalFrame");
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

        private static Quaterniond[] Along(string file, Vector3d[] positions)
        {
            for (int j = 0; j < positions.Length - 1; j++)
            {
                if (positions[j] == positions[j + 1])
                {
                    throw new ParameterException(string.Format(CultureInfo.InvariantCulture,
                        "{0}: positions[{1}] and positions[{2}] coincide: element {1} has no length", file, j,
                        j + 1));
                }
            }
            return RodStart.AlongChords(positions);
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
