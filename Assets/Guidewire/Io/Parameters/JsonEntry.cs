using System;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>An object or a list that a reader of its own takes apart, or null for none.</summary>
    internal sealed class JsonEntry : ParameterEntry
    {
        private readonly JTokenType _type;
        private readonly Func<RunParameters, JToken?> _get;
        private readonly Action<RunParameters, JToken?> _set;

        public JsonEntry(string key, JTokenType type, string allowed, string help, Func<RunParameters, JToken?> get,
            Action<RunParameters, JToken?> set)
            : base(key, "", help)
        {
            _type = type;
            Allowed = allowed;
            _get = get;
            _set = set;
        }

        public override string Allowed { get; }

        public override JToken Write(RunParameters source)
        {
            return _get(source)?.DeepClone() ?? JValue.CreateNull();
        }

        internal override bool TryRead(RunParameters target, JToken value)
        {
            if (value.Type != _type && value.Type != JTokenType.Null)
            {
                return false;
            }
            _set(target, value.Type == JTokenType.Null ? null : value);
            return true;
        }
    }
}
