using System;
using System.Globalization;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>A real number within bounds.</summary>
    internal sealed class NumberEntry : ValueEntry<double>
    {
        private readonly NumberRange _range;

        public NumberEntry(string key, string unit, NumberRange range, string help)
            : base(key, unit, help)
        {
            _range = range;
        }

        public override string Allowed => WithUnit("a number" + _range.Text);

        internal override bool TryRead(RunParameters target, JToken value)
        {
            if (!TryNumber(value, out double number) || !_range.Contains(number))
            {
                return false;
            }
            Set(target, number);
            return true;
        }

        internal static bool TryNumber(JToken value, out double number)
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
    }

    /// <summary>A real number within bounds, or null for none.</summary>
    internal sealed class OptionalNumberEntry : ValueEntry<double?>
    {
        private readonly NumberRange _range;

        public OptionalNumberEntry(string key, string unit, NumberRange range, string help)
            : base(key, unit, help)
        {
            _range = range;
        }

        public override string Allowed => WithUnit("null or a number" + _range.Text);

        internal override bool TryRead(RunParameters target, JToken value)
        {
            bool isNull = value.Type == JTokenType.Null;
            double number = 0.0;
            if (!isNull && (!NumberEntry.TryNumber(value, out number) || !_range.Contains(number)))
            {
                return false;
            }
            Set(target, isNull ? (double?)null : number);
            return true;
        }
    }

    /// <summary>A real number within bounds, null for 0, or a word for what the program knows: the property then is no
    /// number.</summary>
    internal sealed class NumberOrWordEntry : ValueEntry<double>
    {
        private readonly NumberRange _range;
        private readonly string _word;

        public NumberOrWordEntry(string key, string unit, NumberRange range, string word, string help)
            : base(key, unit, help)
        {
            _range = range;
            _word = word;
        }

        public override string Allowed => WithUnit("null or a number" + _range.Text + ", or \"" + _word + "\"");

        internal override JToken? FromText(string text) => text == _word ? new JValue(text) : base.FromText(text);

        internal override JToken Write(RunParameters source) =>
            double.IsNaN(Get(source)) ? new JValue(_word) : base.Write(source);

        internal override bool TryRead(RunParameters target, JToken value)
        {
            bool isWord = value.Type == JTokenType.String && (string?)value == _word;
            double number = isWord ? double.NaN : 0.0;
            if (!isWord && value.Type != JTokenType.Null
                && (!NumberEntry.TryNumber(value, out number) || !_range.Contains(number)))
            {
                return false;
            }
            Set(target, number);
            return true;
        }
    }

    /// <summary>A whole number within bounds.</summary>
    internal sealed class IntegerEntry : ValueEntry<int>
    {
        private readonly int _minimum;
        private readonly int _maximum;

        public IntegerEntry(string key, string unit, int minimum, int maximum, string help)
            : base(key, unit, help)
        {
            _minimum = minimum;
            _maximum = maximum;
        }

        public override string Allowed => WithUnit(string.Format(CultureInfo.InvariantCulture,
            "a whole number from {0} to {1}", _minimum, _maximum));

        internal override bool TryRead(RunParameters target, JToken value)
        {
            // 30.0 is a whole number, however it is written.
            if (!NumberEntry.TryNumber(value, out double number) || number != Math.Floor(number)
                || number < _minimum || number > _maximum)
            {
                return false;
            }
            Set(target, (int)number);
            return true;
        }
    }

    /// <summary>Three numbers: [x, y, z], or {"x": .., "y": .., "z": ..} as older files have them.</summary>
    internal sealed class VectorEntry : ValueEntry<Vector3d>
    {
        private readonly bool _mayBeZero;

        public VectorEntry(string key, string unit, bool mayBeZero, string help)
            : base(key, unit, help)
        {
            _mayBeZero = mayBeZero;
        }

        public override string Allowed =>
            WithUnit("three numbers [x, y, z] or {\"x\", \"y\", \"z\"}" + (_mayBeZero ? "" : ", not all 0"));

        internal override JToken Write(RunParameters source)
        {
            Vector3d v = Get(source);
            return new JArray(v.X, v.Y, v.Z);
        }

        internal override bool TryRead(RunParameters target, JToken value)
        {
            if (!TryVector(value, out Vector3d vector) || (!_mayBeZero && vector.LengthSquared == 0.0))
            {
                return false;
            }
            Set(target, vector);
            return true;
        }

        internal static bool TryVector(JToken value, out Vector3d vector)
        {
            vector = default;
            JToken? x;
            JToken? y;
            JToken? z;
            if (value is JArray array && array.Count == 3)
            {
                x = array[0];
                y = array[1];
                z = array[2];
            }
            else if (value is JObject map && map.Count == 3)
            {
                x = map["x"];
                y = map["y"];
                z = map["z"];
            }
            else
            {
                return false;
            }
            if (x == null || y == null || z == null || !NumberEntry.TryNumber(x, out double a)
                || !NumberEntry.TryNumber(y, out double b) || !NumberEntry.TryNumber(z, out double c))
            {
                return false;
            }
            vector = new Vector3d(a, b, c);
            return true;
        }
    }
}
