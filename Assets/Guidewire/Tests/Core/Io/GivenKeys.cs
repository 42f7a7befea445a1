using System;
using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Guidewire.Core.Tests
{
    /// <summary>Keys as they are given beside a parameter file.</summary>
    internal static class GivenKeys
    {
        /// <summary>None.</summary>
        public static readonly KeyValuePair<string, JToken>[] None = Array.Empty<KeyValuePair<string, JToken>>();

        /// <summary>Keys with their values.</summary>
        public static List<KeyValuePair<string, JToken>> Of(params (string Key, JToken Value)[] given) =>
            Of(given, value => value);

        /// <summary>Keys whose values are made from something else, such as their JSON text.</summary>
        public static List<KeyValuePair<string, JToken>> Of<T>(IEnumerable<(string Key, T Value)> given,
            Func<T, JToken> toJson)
        {
            var keys = new List<KeyValuePair<string, JToken>>();
            foreach ((string key, T value) in given)
            {
                keys.Add(new KeyValuePair<string, JToken>(key, toJson(value)));
            }
            return keys;
        }
    }
}
