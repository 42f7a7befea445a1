using System;
using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Takes true or false.</summary>
    internal sealed class SwitchEntry : ValueEntry<bool>
    {
        public SwitchEntry(string key, string help)
            : base(key, "", help)
        {
        }

        public override string Allowed => "true or false";

        internal override bool TryRead(RunParameters target, JToken value)
        {
            if (value.Type != JTokenType.Boolean)
            {
                return false;
            }
            Set(target, (bool)value);
            return true;
        }
    }

    /// <summary>Takes true, false, or null for what other values make of it.</summary>
    internal sealed class OptionalSwitchEntry : ValueEntry<bool?>
    {
        public OptionalSwitchEntry(string key, string help)
            : base(key, "", help)
        {
        }

        public override string Allowed => "null, true or false";

        internal override bool TryRead(RunParameters target, JToken value)
        {
            bool isNull = value.Type == JTokenType.Null;
            if (!isNull && value.Type != JTokenType.Boolean)
            {
                return false;
            }
            Set(target, isNull ? (bool?)null : (bool)value);
            return true;
        }
    }

    /// <summary>One of a few words, in camelCase.</summary>
    internal sealed class ChoiceEntry<T> : ValueEntry<T>
        where T : struct, Enum
    {
        /// <summary>Words of older files and those that say the same now.</summary>
        public IReadOnlyDictionary<string, string> OlderWords { get; internal set; } = new Dictionary<string, string>();

        public ChoiceEntry(string key, string help)
            : base(key, "", help)
        {
        }

        public override string Allowed => "one of \"" + string.Join("\", \"", Choices) + "\"";

        public override IReadOnlyList<string> Choices => Array.ConvertAll(Enum.GetNames(typeof(T)), Word);

        internal override JToken Write(RunParameters source) => new JValue(Word(Get(source).ToString()));

        internal override bool TryRead(RunParameters target, JToken value)
        {
            if (value.Type != JTokenType.String)
            {
                return false;
            }
            string word = NewerWord(value) ?? (string)value!;
            foreach (string name in Enum.GetNames(typeof(T)))
            {
                if (Word(name) == word)
                {
                    Set(target, (T)Enum.Parse(typeof(T), name));
                    return true;
                }
            }
            return false;
        }

        internal override JToken FromText(string text) => new JValue(text);

        internal override string? NewerWord(JToken value)
        {
            return value.Type == JTokenType.String && OlderWords.TryGetValue((string)value!, out string? newer)
                ? newer : null;
        }

        /// <summary>An enumeration's name as a word in files: in camelCase.</summary>
        internal static string Word(string name) => char.ToLowerInvariant(name[0]) + name.Substring(1);
    }

    /// <summary>Any text: a path.</summary>
    internal sealed class TextEntry : ValueEntry<string>
    {
        public TextEntry(string key, string help)
            : base(key, "", help)
        {
        }

        public override string Allowed => "a text in double quotes";

        internal override bool TryRead(RunParameters target, JToken value)
        {
            if (value.Type != JTokenType.String)
            {
                return false;
            }
            Set(target, (string?)value ?? "");
            return true;
        }

        internal override JToken FromText(string text) => new JValue(text);
    }
}
