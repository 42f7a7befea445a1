using System;
using System.Collections.Generic;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>The members of one object of an instrument's file. Each number is {"value", "basis", "source"}: a text
    /// with its unit, whether it was measured, derived or assumed, and where it is from. Each error is one line that
    /// names file, member, value and what is allowed.</summary>
    internal sealed class InstrumentFields
    {
        private static readonly string[] Bases = { "measured", "derived", "assumed" };

        private readonly string _file;
        private readonly string _path;
        private readonly JObject _object;

        /// <param name="file">The instrument's file.</param>
        /// <param name="path">Where the object stands in it; empty for the whole file.</param>
        /// <param name="value">The object.</param>
        /// <param name="names">The members that it may have.</param>
        /// <exception cref="ParameterException">It is no object, or has a member that is not known.</exception>
        public InstrumentFields(string file, string path, JToken value, params string[] names)
        {
            _file = file;
            _path = path;
            _object = value as JObject ?? throw new ParameterException(
                file, path, value.ToString(Formatting.None), "an object {" + string.Join(", ", names) + "}");
            foreach (JProperty property in _object.Properties())
            {
                if (Array.IndexOf(names, property.Name) < 0)
                {
                    throw new ParameterException(file + ": unknown member '" + At(property.Name) + "': allowed are "
                        + string.Join(", ", names));
                }
            }
        }

        /// <summary>Whether there is a member of this name.</summary>
        public bool Has(string name) => _object.ContainsKey(name);

        /// <summary>A text that must be there and say something.</summary>
        public string Text(string name)
        {
            JToken? value = _object[name];
            string? text = value?.Type == JTokenType.String ? ((string?)value)!.Trim() : null;
            return string.IsNullOrEmpty(text) ? throw Wrong(name, "a text in double quotes") : text!;
        }

        /// <summary>One of a few words.</summary>
        public string Word(string name, IReadOnlyList<string> words)
        {
            string text = Text(name);
            foreach (string word in words)
            {
                if (word == text)
                {
                    return text;
                }
            }
            throw Wrong(name, "one of \"" + string.Join("\", \"", words) + "\"");
        }

        /// <summary>Gives a number above zero with its unit, basis and source, in SI.</summary>
        /// <param name="name">The member.</param>
        /// <param name="dimension">What it measures.</param>
        /// <param name="mayBeZero">Whether 0 is allowed.</param>
        public double Quantity(string name, Dimension dimension, bool mayBeZero = false)
        {
            var fields = new InstrumentFields(_file, At(name), _object[name] ?? throw Wrong(name,
                "{\"value\", \"basis\", \"source\"}"), "value", "basis", "source", "coating");
            string? error = UnitTable.FindError(fields.Text("value"), dimension, out double value);
            if (error == null && !(value > 0.0 || (mayBeZero && value == 0.0)))
            {
                error = mayBeZero ? "a value of 0 or more" : "a value above 0";
            }
            if (error != null)
            {
                throw fields.Wrong("value", error);
            }
            fields.CheckOrigin();
            return value;
        }

        /// <summary>A number with its unit where one basis and one source stand for the whole object, in SI.</summary>
        public double Bare(string name, Dimension dimension, bool mayBeZero = false)
        {
            string? error = UnitTable.FindError(Text(name), dimension, out double value);
            return error == null && (value > 0.0 || (mayBeZero && value == 0.0)) ? value
                : throw Wrong(name, error ?? (mayBeZero ? "a value of 0 or more" : "a value above 0"));
        }

        /// <summary>The objects of a list; none where it is missing.</summary>
        public List<InstrumentFields> List(string name, params string[] names)
        {
            var items = new List<InstrumentFields>();
            if (_object[name] is JToken value)
            {
                foreach (JToken item in value as JArray ?? throw Wrong(name, "a list of objects"))
                {
                    items.Add(new InstrumentFields(_file, At(name) + "[" + items.Count + "]", item, names));
                }
            }
            return items;
        }

        /// <summary>An object that must be there.</summary>
        public InstrumentFields Object(string name, params string[] names)
        {
            return new InstrumentFields(_file, At(name), _object[name]
                ?? throw Wrong(name, "an object {" + string.Join(", ", names) + "}"), names);
        }

        /// <summary>Checks that basis and source are given.</summary>
        public void CheckOrigin()
        {
            Word("basis", Bases);
            Text("source");
        }

        /// <summary>The line for a member whose value is not allowed.</summary>
        public ParameterException Wrong(string name, string allowed)
        {
            return new ParameterException(
                _file, At(name), _object[name]?.ToString(Formatting.None) ?? "(missing)", allowed);
        }

        private string At(string name) => _path.Length == 0 ? name : _path + "." + name;
    }
}
