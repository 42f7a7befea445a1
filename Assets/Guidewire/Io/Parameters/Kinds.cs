using System;
using System.Collections.Generic;
using System.Globalization;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>What values of a key or a field may be: in words, and how one is read from JSON and written.</summary>
    internal sealed class Kind<T>
    {
        /// <summary>Reads a value; false where it is not allowed.</summary>
        public delegate bool Reader(JToken token, out T value);

        private readonly Reader _read;
        private readonly Func<T, JToken> _write;

        /// <param name="allowed">What is allowed, as a noun phrase without a unit.</param>
        /// <param name="write">Null: as the JSON value of its own type.</param>
        public Kind(string allowed, Reader read, Func<T, JToken>? write = null)
        {
            Allowed = allowed;
            _read = read;
            _write = write ?? (value => new JValue((object?)value));
        }

        /// <summary>What is allowed, as a noun phrase without a unit.</summary>
        public string Allowed { get; }

        /// <summary>The words to choose from, where there are only a few.</summary>
        public IReadOnlyList<string> Choices { get; set; } = Array.Empty<string>();

        /// <summary>Words of older files and those that say the same now.</summary>
        public IReadOnlyDictionary<string, string> OlderWords { get; set; } = new Dictionary<string, string>();

        /// <summary>The value that a text on the command line stands for; null where the text is JSON.</summary>
        public Func<string, JToken?>? FromText { get; set; }

        /// <summary>The names of the fields of an object, where it is one.</summary>
        public IReadOnlyList<string> Fields { get; set; } = Array.Empty<string>();

        /// <summary>Says what a field of the object allows; null where there is none of this name.</summary>
        public Func<string, string?> AllowedOf { get; set; } = field => null;

        /// <summary>Reads a value; false where it is not allowed.</summary>
        public bool TryRead(JToken token, out T value) => _read(token, out value);

        /// <summary>Writes a value as it is read.</summary>
        public JToken Write(T value) => _write(value);

        /// <summary>Gives the present word for a word of older files; null for any other value.</summary>
        public string? NewerWord(JToken token) => token.Type == JTokenType.String
            && OlderWords.TryGetValue((string)token!, out string? newer) ? newer : null;
    }

    /// <summary>The kinds of values that keys and fields have.</summary>
    internal static class Kinds
    {
        /// <summary>True or false.</summary>
        public static Kind<bool> Switch { get; } = new Kind<bool>("true or false", (JToken token, out bool value) =>
        {
            value = token.Type == JTokenType.Boolean && (bool)token;
            return token.Type == JTokenType.Boolean;
        });

        /// <summary>True, false, or null for what other values make of it.</summary>
        public static Kind<bool?> OptionalSwitch { get; } = new Kind<bool?>("null, true or false",
            (JToken token, out bool? value) =>
        {
            value = token.Type == JTokenType.Boolean ? (bool)token : (bool?)null;
            return token.Type == JTokenType.Boolean || token.Type == JTokenType.Null;
        });

        /// <summary>Any text, such as a path.</summary>
        public static Kind<string> Text { get; } = new Kind<string>("a text in double quotes",
            (JToken token, out string value) =>
        {
            bool isText = token.Type == JTokenType.String;
            value = isText ? (string)token! : "";
            return isText;
        }) { FromText = text => new JValue(text) };

        /// <summary>Three numbers, or null for none.</summary>
        public static Kind<Vector3d?> OptionalVector { get; } = new Kind<Vector3d?>("null or three numbers [x, y, z]",
            (JToken token, out Vector3d? value) =>
        {
            value = TryVector(token, out Vector3d vector) ? vector : (Vector3d?)null;
            return value != null || token.Type == JTokenType.Null;
        }, value => value is Vector3d vector ? Write(vector) : JValue.CreateNull());

        /// <summary>Three letters for where x, y and z point in the patient; an empty text for axes that are
        /// unknown.</summary>
        public static Kind<string> Axes { get; } = new Kind<string>("\"\" or three letters that say where x, y and z "
            + "point, one of L and R, one of A and P, one of S and I, right-handed, such as \"LPS\", and where needed "
            + "signed degrees by which the chest is turned to the left, such as \"LPS-60\"",
            (JToken token, out string value) =>
        {
            string letters = token.Type == JTokenType.String ? (string)token! : "?";
            value = letters;
            return letters.Length == 0 || PatientAxes.Named(letters) != null;
        }) { FromText = text => new JValue(text) };

        /// <summary>An end or a branch of a vessel: its name, its number, or a point; null for none.</summary>
        public static Kind<JToken?> End { get; } = new Kind<JToken?>(
            "null, a name in double quotes, a number from 1, or a point [x, y, z]", (JToken token, out JToken? value) =>
        {
            value = token.Type == JTokenType.Null ? null : token;
            bool isName = token.Type == JTokenType.String && ((string)token!).Length > 0;
            bool isNumber = TryNumber(token, out double number) && number >= 1.0 && number == Math.Floor(number)
                && number <= 1e6;
            return value == null || isName || isNumber || TryVector(token, out _);
        }, Copy) { FromText = text => JsonText.Given(text) ?? text };

        /// <summary>A real number within bounds.</summary>
        public static Kind<double> Number(NumberRange range) => new Kind<double>("a number" + range.Text,
            (JToken token, out double value) => TryNumber(token, out value) && range.Contains(value));

        /// <summary>A real number within bounds, or null for none.</summary>
        public static Kind<double?> OptionalNumber(NumberRange range) => new Kind<double?>(
            "null or a number" + range.Text, (JToken token, out double? value) =>
        {
            value = null;
            if (token.Type == JTokenType.Null)
            {
                return true;
            }
            bool isRead = TryNumber(token, out double number) && range.Contains(number);
            value = number;
            return isRead;
        });

        /// <summary>A real number within bounds, null for 0, or a word for what the program knows, which is no
        /// number.</summary>
        public static Kind<double> NumberOr(NumberRange range, string word) => new Kind<double>(
            "null or a number" + range.Text + ", or \"" + word + "\"", (JToken token, out double value) =>
        {
            bool isWord = token.Type == JTokenType.String && (string?)token == word;
            value = isWord ? double.NaN : 0.0;
            return isWord || token.Type == JTokenType.Null || (TryNumber(token, out value) && range.Contains(value));
        }, value => double.IsNaN(value) ? new JValue(word) : new JValue(value))
        {
            FromText = text => text == word ? text : JsonText.Given(text),
        };

        /// <summary>A whole number within bounds; 30.0 is one, too.</summary>
        public static Kind<int> Whole(int minimum, int maximum) => new Kind<int>(string.Format(
            CultureInfo.InvariantCulture, "a whole number from {0} to {1}", minimum, maximum),
            (JToken token, out int value) =>
        {
            bool isRead = TryNumber(token, out double number) && number == Math.Floor(number) && number >= minimum
                && number <= maximum;
            value = isRead ? (int)number : 0;
            return isRead;
        });

        /// <summary>Three numbers: [x, y, z], or {"x": .., "y": .., "z": ..} as older files have them.</summary>
        public static Kind<Vector3d> Vector(bool mayBeZero) => new Kind<Vector3d>(
            "three numbers [x, y, z] or {\"x\", \"y\", \"z\"}" + (mayBeZero ? "" : ", not all 0"),
            (JToken token, out Vector3d value) =>
                TryVector(token, out value) && (mayBeZero || value.LengthSquared != 0.0), Write);

        /// <summary>One of a few words, in camelCase.</summary>
        /// <param name="older">Pairs of words of older files and of now.</param>
        public static Kind<T> Choice<T>(params (string Old, string New)[] older)
            where T : struct, Enum
        {
            string[] words = Array.ConvertAll(Enum.GetNames(typeof(T)), Word);
            var newer = new Dictionary<string, string>();
            foreach ((string before, string now) in older)
            {
                newer[before] = now;
            }
            return new Kind<T>("one of \"" + string.Join("\", \"", words) + "\"", (JToken token, out T value) =>
            {
                string? word = token.Type == JTokenType.String ? (string?)token : null;
                int index = word == null ? -1
                    : Array.IndexOf(words, newer.TryGetValue(word, out string? now) ? now : word);
                value = index < 0 ? default : (T)Enum.Parse(typeof(T), Enum.GetNames(typeof(T))[index]);
                return index >= 0;
            }, value => new JValue(Word(value.ToString())))
            {
                Choices = words,
                OlderWords = newer,
                FromText = text => new JValue(text),
            };
        }

        /// <summary>An object or a list that a reader of its own knows, or null for none.</summary>
        public static Kind<JToken?> Json(JTokenType type, string allowed) => new Kind<JToken?>(allowed,
            (JToken token, out JToken? value) =>
        {
            value = token.Type == JTokenType.Null ? null : token;
            return value == null || token.Type == type;
        }, Copy);

        /// <summary>A value, or null for none.</summary>
        public static Kind<T?> Optional<T>(Kind<T> kind)
            where T : class => new Kind<T?>("null or " + kind.Allowed, (JToken token, out T? value) =>
        {
            value = null;
            if (token.Type == JTokenType.Null)
            {
                return true;
            }
            bool isRead = kind.TryRead(token, out T found);
            value = found;
            return isRead;
        }, value => value == null ? JValue.CreateNull() : kind.Write(value));

        /// <summary>Reads a finite number.</summary>
        public static bool TryNumber(JToken value, out double number)
        {
            number = value.Type == JTokenType.Float ? (double)value : double.NaN;
            if (value.Type != JTokenType.Integer)
            {
                return !double.IsNaN(number) && !double.IsInfinity(number);
            }
            // Integers beyond 64 bits arrive as BigInteger; their text reads as a double like any other number.
            string text = Convert.ToString(((JValue)value).Value, CultureInfo.InvariantCulture) ?? "";
            return NumberText.TryRead(text, out number);
        }

        /// <summary>Reads three numbers.</summary>
        public static bool TryVector(JToken value, out Vector3d vector)
        {
            vector = default;
            JToken? Part(int index, string name) => value is JArray array ? array[index] : value[name];
            if (!(value is JContainer parts) || parts.Count != 3 || !(Part(0, "x") is JToken x)
                || !(Part(1, "y") is JToken y) || !(Part(2, "z") is JToken z) || !TryNumber(x, out double a)
                || !TryNumber(y, out double b) || !TryNumber(z, out double c))
            {
                return false;
            }
            vector = new Vector3d(a, b, c);
            return true;
        }

        /// <summary>Writes three numbers.</summary>
        public static JToken Write(Vector3d vector) => new JArray(vector.X, vector.Y, vector.Z);

        /// <summary>An enumeration's name as a word in files: in camelCase.</summary>
        public static string Word(string name) => char.ToLowerInvariant(name[0]) + name.Substring(1);

        private static JToken Copy(JToken? value) => value?.DeepClone() ?? JValue.CreateNull();
    }

    /// <summary>The fields of a JSON object that stands for one value: of each its name, what is allowed, and where the
    /// value has it.</summary>
    internal sealed class Fields<T>
        where T : class, new()
    {
        private readonly List<Field> _fields = new List<Field>();
        private readonly string[] _needed;

        /// <param name="needed">The fields that may not be missing.</param>
        public Fields(params string[] needed) => _needed = needed;

        /// <summary>The names, in the order in which they are written.</summary>
        public IReadOnlyList<string> Names => _fields.ConvertAll(field => field.Name);

        /// <summary>Says what a field allows; null where there is none of this name.</summary>
        public string? AllowedOf(string name) => _fields.Find(field => field.Name == name)?.Allowed;

        /// <summary>Adds a field.</summary>
        /// <param name="allowed">What it allows, with the unit.</param>
        /// <param name="get">Gives its value; null: the field is left out.</param>
        public Fields<T> Add<TValue>(string name, string allowed, Kind<TValue> kind, Func<T, object?> get,
            Action<T, TValue> set)
        {
            _fields.Add(new Field(name, allowed, (token, owner) =>
            {
                bool isRead = kind.TryRead(token, out TValue value);
                if (isRead)
                {
                    set(owner, value);
                }
                return isRead;
            }, owner => get(owner) is TValue value ? kind.Write(value) : null));
            return this;
        }

        /// <summary>The kind of a value that has these fields and no other.</summary>
        /// <param name="allowed">What is allowed, as a noun phrase.</param>
        /// <param name="isAllowed">Whether fields go together.</param>
        public Kind<T> Of(string allowed, Predicate<T> isAllowed) => new Kind<T>(allowed,
            (JToken token, out T value) =>
        {
            value = new T();
            if (!(token is JObject item))
            {
                return false;
            }
            foreach (JProperty property in item.Properties())
            {
                Field? field = _fields.Find(one => one.Name == property.Name);
                if (field == null || !field.Read(property.Value, value))
                {
                    return false;
                }
            }
            return Array.TrueForAll(_needed, item.ContainsKey) && isAllowed(value);
        }, Write);

        private JObject Write(T value)
        {
            var item = new JObject();
            foreach (Field field in _fields)
            {
                if (field.Write(value) is JToken token)
                {
                    item[field.Name] = token;
                }
            }
            return item;
        }

        private sealed class Field
        {
            public Field(string name, string allowed, Func<JToken, T, bool> read, Func<T, JToken?> write)
            {
                Name = name;
                Allowed = allowed;
                Read = read;
                Write = write;
            }

            public string Name { get; }

            public string Allowed { get; }

            public Func<JToken, T, bool> Read { get; }

            public Func<T, JToken?> Write { get; }
        }
    }

    /// <summary>Bounds of a number, each of them inside or outside.</summary>
    public readonly struct NumberRange
    {
        private readonly bool _minimumExcluded;

        private NumberRange(double minimum, bool minimumExcluded, double maximum)
        {
            Minimum = minimum;
            _minimumExcluded = minimumExcluded;
            Maximum = maximum;
        }

        /// <summary>Allows every finite number.</summary>
        public static NumberRange Any => new NumberRange(double.NegativeInfinity, false, double.PositiveInfinity);

        /// <summary>Allows numbers above 0.</summary>
        public static NumberRange Positive => new NumberRange(0.0, true, double.PositiveInfinity);

        /// <summary>Allows 0 and numbers above.</summary>
        public static NumberRange NotNegative => new NumberRange(0.0, false, double.PositiveInfinity);

        /// <summary>Allows numbers from 0 to 1.</summary>
        public static NumberRange Fraction => new NumberRange(0.0, false, 1.0);

        /// <summary>The lower bound.</summary>
        public double Minimum { get; }

        /// <summary>The upper bound.</summary>
        public double Maximum { get; }

        /// <summary>Above 0, up to a bound that is inside.</summary>
        public static NumberRange PositiveUpTo(double maximum) => new NumberRange(0.0, true, maximum);

        /// <summary>The bounds as they follow "a number".</summary>
        internal string Text
        {
            get
            {
                string text = double.IsNegativeInfinity(Minimum) ? ""
                    : (_minimumExcluded ? " > " : " >= ") + Minimum.ToString("R", CultureInfo.InvariantCulture);
                return double.IsPositiveInfinity(Maximum) ? text
                    : text + (text.Length > 0 ? " and" : "") + " <= "
                    + Maximum.ToString("R", CultureInfo.InvariantCulture);
            }
        }

        /// <summary>Whether a number lies inside.</summary>
        internal bool Contains(double value) =>
            (_minimumExcluded ? value > Minimum : value >= Minimum) && value <= Maximum;
    }
}
