using System;
using System.Collections.Generic;
using Guidewire.Io;
using NUnit.Framework;
using Newtonsoft.Json.Linq;

namespace Guidewire.Core.Tests
{
    /// <summary>How a user's error is answered.</summary>
    internal static class Refusal
    {
        /// <summary>The message of the <see cref="ParameterException"/> that a call throws: one line.</summary>
        public static string Of(TestDelegate call)
        {
            string message = Assert.Throws<ParameterException>(call)!.Message;
            Assert.That(message, Does.Not.Contain("\n"));
            return message;
        }
    }

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
