using System;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>A key that holds one value: the property of the same name in the parameters of the key's group or,
    /// where these have none of that name and type, in RunParameters.</summary>
    internal abstract class ValueEntry<T> : ParameterEntry
    {
        private protected ValueEntry(string key, string unit, string help)
            : base(key, unit, help)
        {
            Property = NamedProperty.Of(key);
        }

        /// <summary>The property's name.</summary>
        public string Property { get; internal set; }

        /// <summary>Reads the value where that takes more than a property, with Setter; else null.</summary>
        public Func<RunParameters, T>? Getter { get; internal set; }

        /// <summary>Takes over the value, with Getter; else null.</summary>
        public Action<RunParameters, T>? Setter { get; internal set; }

        /// <inheritdoc/>
        internal override JToken Write(RunParameters source) => new JValue((object?)Get(source));

        private protected T Get(RunParameters source) =>
            Getter == null ? NamedProperty.Get<T>(Owner(source), Property) : Getter(source);

        private protected void Set(RunParameters target, T value)
        {
            if (Setter == null)
            {
                NamedProperty.Set(Owner(target), Property, value);
                return;
            }
            Setter(target, value);
        }

        private object Owner(RunParameters parameters)
        {
            object group = GroupOf(parameters);
            return NamedProperty.IsOf<T>(group, Property) ? group : parameters;
        }
    }
}
