using System;
using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
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
}
