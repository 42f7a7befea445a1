using System;
using System.Globalization;
using System.Linq;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads a start other than the straight wire: {"positions": [[x, y, z], ...] (n + 1, units),
    /// "orientations": [[x, y, z, w], ...] (n), "velocities": (n + 1, unit/s) and "angularVelocities": (n, rad/s, body
    /// frame), and the clamps' frames "proximalFrame" and "distalFrame" ([x, y, z, w]), all but the first optional. In
    /// a sheath or in catheters "hub": {"insertion": m, "turn": rad} stands in place of the frames, and "catheters" has
    /// an object of the same keys for each, the outermost one first.</summary>
    internal static class StartFileReader
    {
        private const string HubKey = "hub";
        private static readonly string[] Keys =
        {
            "positions", "orientations", "velocities", "angularVelocities", "proximalFrame", "distalFrame", HubKey,
            CatheterReader.Key,
        };
        private static readonly string[] HubKeys = { "insertion", "turn" };

        /// <summary>The start that an object holds.</summary>
        /// <param name="root">The object.</param>
        /// <param name="file">Where it stands, for what is refused.</param>
        /// <param name="scene">The wire, and what is around it.</param>
        /// <exception cref="ParameterException">It does not fit them.</exception>
        public static RodStart Read(JObject root, string file, SimulationParameters scene)
        {
            bool hasSheath = scene.Scene.Sheath != null;
            int count = scene.Scene.Catheters.Count;
            RodStart start = ReadOne(root, file, "", ElementLayout.Count(scene), count > 0, hasSheath || count > 0);
            JToken? catheters = root[CatheterReader.Key];
            if (count == 0 && catheters != null)
            {
                throw new ParameterException(file + ": the scene has no catheters, the start has some");
            }
            if (count > 0 && !(catheters is JArray array && array.Count == count
                && array.All(one => one is JObject)))
            {
                throw new ParameterException(file + ": " + CatheterReader.Key + " needs a list of " + count
                    + " objects, one for each catheter of the scene, with the same keys");
            }
            start.Catheters = Enumerable.Range(0, count).Select(k => ReadOne((JObject)catheters![k]!, file,
                CatheterReader.Key + "[" + k + "].", ElementLayout.Count(scene, scene.Scene.Catheters[k]),
                true, true)).ToArray();
            return start;
        }

        private static RodStart ReadOne(JObject root, string file, string path, int n, bool needsHub, bool takesHub)
        {
            foreach (JProperty property in root.Properties())
            {
                if (Array.IndexOf(Keys, property.Name) < 0 || (path.Length > 0 && property.Name == CatheterReader.Key))
                {
                    throw new ParameterException(file + ": unknown key '" + path + property.Name
                        + "': allowed are " + string.Join(", ", Keys));
                }
            }
            string at = path + "positions";
            Vector3d[] positions = Vectors(file, root, path, "positions", n + 1)
                ?? throw Missing(file, at, n + 1, "[x, y, z] in units");
            var start = new RodStart(positions,
                root["orientations"] == null ? Along(file, path, positions) : Orientations(file, path, root, n),
                Vectors(file, root, path, "velocities", n + 1),
                Vectors(file, root, path, "angularVelocities", n));
            start.ProximalFrame = Frame(file, path, root, "proximalFrame");
            start.DistalFrame = Frame(file, path, root, "distalFrame");
            start.Hub = Hub(file, path + HubKey, root[HubKey], needsHub, takesHub);
            string? held = start.Hub == null ? null : start.ProximalFrame != null ? "proximalFrame"
                : start.DistalFrame != null ? "distalFrame" : null;
            return held == null ? start : throw new ParameterException(file + ": " + path + held
                + " and " + path + HubKey + ": give one of the two");
        }

        private static (double Insertion, double Turn)? Hub(string file, string path, JToken? value, bool needsIt,
            bool takesIt)
        {
            if (value == null && needsIt)
            {
                throw new ParameterException(file + ": " + path + " is missing: where the hub of each instrument is, "
                    + "{\"insertion\": m, \"turn\": rad}, is no part of its positions");
            }
            if (value == null)
            {
                return null;
            }
            if (!takesIt)
            {
                throw new ParameterException(file + ": " + path + " needs a sheath or catheters: elsewhere the hub is "
                    + "where the positions begin");
            }
            var parts = new double[HubKeys.Length];
            bool isRead = value is JObject given && given.Count == HubKeys.Length;
            for (int k = 0; k < parts.Length && isRead; k++)
            {
                isRead = value[HubKeys[k]] is JToken part && Kinds.TryNumber(part, out parts[k]);
            }
            return isRead ? (parts[0], parts[1]) : throw new ParameterException(file, path, value.ToString(
                Newtonsoft.Json.Formatting.None), "{\"insertion\": a number (m), \"turn\": a number (rad)}");
        }

        private static Vector3d[]? Vectors(string file, JObject root, string path, string key, int count)
        {
            JToken? list = root[key];
            key = path + key;
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
                if (!Kinds.TryVector(array[i], out vectors[i]))
                {
                    throw new ParameterException(file, key + "[" + i + "]", array[i].ToString(),
                        "three numbers [x, y, z]");
                }
            }
            return vectors;
        }

        private static Quaterniond[] Along(string file, string path, Vector3d[] positions)
        {
            for (int j = 0; j < positions.Length - 1; j++)
            {
                if (positions[j] == positions[j + 1])
                {
                    throw new ParameterException(string.Format(CultureInfo.InvariantCulture,
                        "{0}: {3}positions[{1}] and positions[{2}] coincide: element {1} has no length", file, j,
                        j + 1, path));
                }
            }
            return RodStart.AlongChords(positions);
        }

        private static Quaterniond[] Orientations(string file, string path, JObject root, int n)
        {
            if (!(root["orientations"] is JArray array) || array.Count != n)
            {
                throw Missing(file, path + "orientations", n, "[x, y, z, w]");
            }
            var orientations = new Quaterniond[n];
            for (int j = 0; j < n; j++)
            {
                orientations[j] = Orientation(file, path + "orientations[" + j + "]", array[j]);
            }
            return orientations;
        }

        private static Quaterniond? Frame(string file, string path, JObject root, string key) =>
            root[key] is JToken value ? Orientation(file, path + key, value) : (Quaterniond?)null;

        private static Quaterniond Orientation(string file, string key, JToken value)
        {
            var parts = new double[4];
            bool valid = value is JArray four && four.Count == 4;
            for (int k = 0; k < 4 && valid; k++)
            {
                valid = Kinds.TryNumber(value[k]!, out parts[k]);
            }
            var orientation = new Quaterniond(parts[0], parts[1], parts[2], parts[3]);
            return valid && orientation.LengthSquared > 1e-12 ? orientation
                : throw new ParameterException(file, key, value.ToString(),
                    "four numbers [x, y, z, w], not all 0");
        }

        private static ParameterException Missing(string file, string key, int count, string items)
        {
            return new ParameterException(file + ": " + key + " needs a list of " + count + " " + items
                + " (the number of elements decides the count)");
        }
    }
}
