using System;
using System.Collections.Generic;
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
}
