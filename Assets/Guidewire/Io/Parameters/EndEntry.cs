using System;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>An end or a branch of a vessel: its name, its number, or a point; null for none.</summary>
    internal sealed class EndEntry : ValueEntry<JToken?>
    {
        public EndEntry(string key, string help)
            : base(key, "", help)
        {
        }

        public override string Allowed => "null, a name in double quotes, a number from 1, or a point [x, y, z]";

        internal override JToken Write(RunParameters source) => Get(source)?.DeepClone() ?? JValue.CreateNull();

        internal override bool TryRead(RunParameters target, JToken value)
        {
            bool isNull = value.Type == JTokenType.Null;
            bool isName = value.Type == JTokenType.String && ((string)value!).Length > 0;
            bool isNumber = NumberEntry.TryNumber(value, out double number) && number >= 1.0
                && number == Math.Floor(number) && number <= 1e6;
            if (!isNull && !isName && !isNumber && !VectorEntry.TryVector(value, out _))
            {
                return false;
            }
            Set(target, isNull ? null : value);
            return true;
        }

        internal override JToken? FromText(string text) => base.FromText(text) ?? text;
    }
}
