using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>An object or a list with its own reader, or null for none.</summary>
    internal sealed class JsonEntry : ValueEntry<JToken?>
    {
        private readonly JTokenType _type;

        public JsonEntry(string key, JTokenType type, string allowed, string help)
            : base(key, "", help)
        {
            _type = type;
            Allowed = allowed;
        }

        public override string Allowed { get; }

        internal override JToken Write(RunParameters source) => Get(source)?.DeepClone() ?? JValue.CreateNull();

        internal override bool TryRead(RunParameters target, JToken value)
        {
            if (value.Type != _type && value.Type != JTokenType.Null)
            {
                return false;
            }
            Set(target, value.Type == JTokenType.Null ? null : value);
            return true;
        }
    }
}
