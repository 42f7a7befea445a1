using System;
using System.Collections.Generic;
using System.Globalization;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Path of a value: a key, or a part of its value, such as <c>vessel.radius</c>,
    /// <c>obstacles[0].radius</c>, <c>wireSections[-1].youngsModulus</c> or <c>gravity[1]</c>. A negative index counts
    /// from a list's end.</summary>
    internal sealed class ParameterPath
    {
        private readonly List<string> _names = new List<string>();      // of a step into an object; "" into a list
        private readonly List<int> _indices = new List<int>();          // of a step into a list

        private ParameterPath(string text, string key)
        {
            Text = text;
            Key = key;
        }

        /// <summary>The path as it was written.</summary>
        public string Text { get; private set; }

        /// <summary>The key that it begins with.</summary>
        public string Key { get; }

        /// <summary>How many steps lead from the key's value to the part; 0: the value itself.</summary>
        public int Depth => _names.Count;

        /// <summary>Name of the field that is meant; empty where the last step is an index or there is none.</summary>
        public string Field => Depth == 0 ? "" : _names[Depth - 1];

        /// <summary>Reads a path; null where brackets or dots are not those of one.</summary>
        public static ParameterPath? Parse(string text)
        {
            int at = EndOfName(text, 0);
            var path = new ParameterPath(text, text.Substring(0, at));
            while (at < text.Length)
            {
                int close = text[at] == '[' ? text.IndexOf(']', at) : EndOfName(text, at + 1);
                string step = close < 0 ? "" : text.Substring(at + 1, close - at - 1);
                int index = 0;
                if (step.Length == 0 || text[at] == ']' || (text[at] == '[' && !int.TryParse(
                        step, NumberStyles.AllowLeadingSign, CultureInfo.InvariantCulture, out index)))
                {
                    return null;
                }
                path._names.Add(text[at] == '[' ? "" : step);
                path._indices.Add(index);
                at = text[at] == '[' ? close + 1 : close;
                if (at < text.Length && text[at] != '.' && text[at] != '[')
                {
                    return null;
                }
            }
            return path.Key.Length == 0 ? null : path;
        }

        /// <summary>Whether a path is another one, or a part of what that one holds.</summary>
        public static bool IsWithin(string path, string whole)
        {
            return path.StartsWith(whole, StringComparison.Ordinal)
                && (path.Length == whole.Length || path[whole.Length] == '.' || path[whole.Length] == '[');
        }

        /// <summary>Puts a value where the path leads. Indices that count from an end are then counted from the
        /// start.</summary>
        /// <param name="root">What the key holds; changed, unless the path is the key alone.</param>
        /// <param name="value">The part.</param>
        /// <returns>What the key holds now.</returns>
        /// <exception cref="ParameterException">The path does not exist: one line without a source.</exception>
        public JToken Replace(JToken root, JToken value)
        {
            if (Depth == 0)
            {
                return value.DeepClone();
            }
            JToken holder = root;
            string reached = Key;
            for (int k = 0; k < Depth; k++)
            {
                bool isLast = k == Depth - 1;
                if (_names[k].Length > 0)
                {
                    var map = holder as JObject ?? throw Nowhere(reached, holder);
                    reached += "." + _names[k];
                    if (isLast)
                    {
                        map[_names[k]] = value.DeepClone();
                        break;
                    }
                    holder = map[_names[k]]
                        ?? throw new ParameterException(Text + " does not exist: there is no " + reached);
                }
                else
                {
                    var list = holder as JArray ?? throw Nowhere(reached, holder);
                    int index = _indices[k] < 0 ? list.Count + _indices[k] : _indices[k];
                    if (index < 0 || index >= list.Count)
                    {
                        throw Nowhere(reached, holder);
                    }
                    _indices[k] = index;
                    reached += "[" + index.ToString(CultureInfo.InvariantCulture) + "]";
                    if (isLast)
                    {
                        list[index] = value.DeepClone();
                        break;
                    }
                    holder = list[index];
                }
            }
            Text = reached;
            return root;
        }

        private ParameterException Nowhere(string reached, JToken holder)
        {
            string there = holder is JArray list ? list.Count == 0 ? "an empty list" : "a list of " + list.Count + ", "
                    + reached + "[0]" + (list.Count > 1 ? " to " + reached + "[" + (list.Count - 1) + "]" : "")
                : holder is JObject ? "an object: " + reached + ".NAME"
                : holder.Type == JTokenType.Null ? "null, give the whole of it" : "one value without parts";
            return new ParameterException(Text + " does not exist: " + reached + " is " + there);
        }

        private static int EndOfName(string text, int start)
        {
            int end = text.IndexOfAny(new[] { '.', '[', ']' }, start);
            return end < 0 ? text.Length : end;
        }
    }
}
