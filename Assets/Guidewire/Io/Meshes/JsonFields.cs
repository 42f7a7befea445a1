using System;
using System.Collections.Generic;
using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Fields of one JSON object; each error is one line that names source, key, value and what is allowed.
    /// </summary>
    internal sealed class JsonFields
    {
        // Beyond it squares and volumes lose their last digits, and nothing there is a vessel.
        private const double Largest = 1e9;
        private const string OneNumber = "a number, 1e9 at most";
        private const string ThreeNumbers = "three numbers [x, y, z], each 1e9 at most";
        private readonly Func<string, string> _sourceOf;
        private readonly string _key;
        private readonly JObject _object;

        /// <param name="sourceOf">Who said what stands at a path: a file, or "command line".</param>
        /// <param name="key">Where the object stands.</param>
        /// <param name="value">The object.</param>
        /// <exception cref="ParameterException">It is no object.</exception>
        public JsonFields(Func<string, string> sourceOf, string key, JToken value)
        {
            _sourceOf = sourceOf;
            _key = key;
            _object = value as JObject ?? throw new ParameterException(
                sourceOf(key), key, value.ToString(Formatting.None), "an object {\"shape\": ...}");
        }

        /// <summary>Refuses every field but these.</summary>
        public void Allow(params string[] names)
        {
            foreach (JProperty property in _object.Properties())
            {
                if (Array.IndexOf(names, property.Name) < 0)
                {
                    throw new ParameterException(Source(property.Name) + ": unknown key '" + _key + "." + property.Name
                        + "': allowed are " + string.Join(", ", names));
                }
            }
        }

        /// <summary>Where the object stands.</summary>
        public string Key => _key;

        /// <summary>Whether there is a field of this name.</summary>
        public bool Has(string name) => _object.ContainsKey(name);

        /// <summary>A text; an empty one where it is missing.</summary>
        public string Text(string name)
        {
            JToken? value = _object[name];
            return value == null ? "" : value.Type == JTokenType.String ? (string?)value ?? ""
                : throw Wrong(name, "a text in double quotes");
        }

        /// <summary>A list of texts, or one text.</summary>
        public List<string> Texts(string name)
        {
            var texts = new List<string>();
            foreach (JToken item in _object[name] as JArray ?? new JArray(_object[name]!))
            {
                texts.Add(item.Type == JTokenType.String ? (string)item! : throw Wrong(name, "a list of texts"));
            }
            return texts;
        }

        /// <summary>Whether a field holds a text.</summary>
        public bool IsText(string name) => _object[name]?.Type == JTokenType.String;

        /// <summary>The object in a field.</summary>
        public JsonFields Object(string name) => _object[name] is JObject own
            ? new JsonFields(_sourceOf, _key + "." + name, own) : throw Wrong(name, "an object");

        /// <summary>true or false, or what counts where it is missing.</summary>
        public bool Switch(string name, bool missing)
        {
            JToken? value = _object[name];
            return value == null ? missing : value.Type == JTokenType.Boolean ? (bool)value
                : throw Wrong(name, "true or false");
        }

        /// <summary>A number, or what counts where it is missing (null: it may not be).</summary>
        public double Number(string name, double? missing)
        {
            JToken? value = _object[name];
            if (value == null && missing.HasValue)
            {
                return missing.Value;
            }
            return value != null && Kinds.TryNumber(value, out double number) && IsSmall(number)
                ? number : throw Wrong(name, OneNumber);
        }

        /// <summary>A number above 0, or what counts where it is missing (0: it may not be).</summary>
        public double Positive(string name, string unit, double missing = 0.0)
        {
            double value = Number(name, missing);
            return value > 0.0 ? value : throw Wrong(name, "a number > 0 (" + unit + ")");
        }

        /// <summary>A vector, or what counts where it is missing (null: it may not be).</summary>
        public Vector3d Vector(string name, Vector3d? missing)
        {
            JToken? value = _object[name];
            if (value == null && missing.HasValue)
            {
                return missing.Value;
            }
            return value != null && Kinds.TryVector(value, out Vector3d vector) && IsSmall(vector)
                ? vector : throw Wrong(name, ThreeNumbers);
        }

        /// <summary>The objects of a list; none where the field is missing.</summary>
        public List<JsonFields> Items(string name)
        {
            var items = new List<JsonFields>();
            JToken? value = _object[name];
            foreach (JToken item in value == null ? new JArray() : value as JArray ?? throw Wrong(name, "a list"))
            {
                items.Add(new JsonFields(_sourceOf, _key + "." + name + "[" + items.Count + "]", item));
            }
            return items;
        }

        /// <summary>Gives a list of vectors.</summary>
        public Vector3d[] Vectors(string name)
        {
            var vectors = new List<Vector3d>();
            foreach (JToken item in _object[name] as JArray ?? throw Wrong(name, "a list of [x, y, z]"))
            {
                vectors.Add(Kinds.TryVector(item, out Vector3d vector) && IsSmall(vector) ? vector
                    : throw WrongItem(name, vectors.Count, item, ThreeNumbers));
            }
            return vectors.ToArray();
        }

        /// <summary>A list of numbers, or one number that stands for <paramref name="count"/> equal ones.</summary>
        public double[] Numbers(string name, int count)
        {
            JToken? value = _object[name];
            if (value != null && Kinds.TryNumber(value, out double same) && IsSmall(same))
            {
                var all = new double[count];
                Array.Fill(all, same);
                return all;
            }
            var numbers = new List<double>();
            foreach (JToken item in value as JArray
                ?? throw Wrong(name, "a number, 1e9 at most, or a list of such numbers"))
            {
                numbers.Add(Kinds.TryNumber(item, out double number) && IsSmall(number) ? number
                    : throw WrongItem(name, numbers.Count, item, OneNumber));
            }
            return numbers.ToArray();
        }

        /// <summary>Named points, {"name": [x, y, z], ...}; none where the field is missing.</summary>
        public Vector3d[] NamedPoints(string name)
        {
            var points = new List<Vector3d>();
            JToken? value = _object[name];
            if (value != null)
            {
                foreach (JProperty property in
                    (value as JObject ?? throw Wrong(name, "named points {\"name\": [x, y, z]}")).Properties())
                {
                    points.Add(Kinds.TryVector(property.Value, out Vector3d point) && IsSmall(point) ? point
                        : throw Wrong(name, "named points {\"name\": [x, y, z]}"));
                }
            }
            return points.ToArray();
        }

        /// <summary>Replaces what stands in a field.</summary>
        public void Replace(string name, JToken value) => _object[name] = value;

        /// <summary>The line for a field whose value is not allowed.</summary>
        public ParameterException Wrong(string name, string allowed)
        {
            return new ParameterException(
                Source(name), _key + "." + name, _object[name]?.ToString(Formatting.None) ?? "(missing)", allowed);
        }

        private ParameterException WrongItem(string name, int index, JToken item, string allowed)
        {
            return new ParameterException(
                Source(name + "[" + index + "]"), _key + "." + name + "[" + index + "]",
                item.ToString(Formatting.None), allowed);
        }

        private string Source(string name) => _sourceOf(_key + "." + name);

        private static bool IsSmall(double number) => Math.Abs(number) <= Largest;

        private static bool IsSmall(in Vector3d vector) => IsSmall(vector.X) && IsSmall(vector.Y) && IsSmall(vector.Z);

        /// <summary>Gives the line for something that Core refused.</summary>
        public ParameterException Refused(string reason) =>
            new ParameterException(_sourceOf(_key) + ": " + _key + ": " + reason);
    }
}
