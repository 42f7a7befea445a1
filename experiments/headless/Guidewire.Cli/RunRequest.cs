using System.Collections.Generic;
using Guidewire.Io;
using Newtonsoft.Json.Linq;

namespace Guidewire.Cli
{
    /// <summary>One line of the request loop's input.</summary>
    internal sealed class RunRequest
    {
        private RunRequest(JObject json)
        {
            ParameterFile = (string?)json["parameters"];
            Out = (string?)json["out"];
            Repeat = (int?)json["repeat"];
            Check = (bool?)json["check"] ?? false;
            Log = (bool?)json["log"] ?? true;
            foreach (JProperty property in ((JObject?)json["set"] ?? new JObject()).Properties())
            {
                Overrides.Add(new KeyValuePair<string, JToken>(property.Name, property.Value));
            }
        }

        /// <summary>The parameter file, or null for the defaults.</summary>
        public string? ParameterFile { get; }

        /// <summary>The folder of the results.</summary>
        public string? Out { get; }

        /// <summary>Number of a timed repeat, or null.</summary>
        public int? Repeat { get; }

        /// <summary>Whether the parameters are only checked, and the run's address told.</summary>
        public bool Check { get; }

        /// <summary>Whether the run leaves a log.</summary>
        public bool Log { get; }

        /// <summary>Parameters that count instead of the file's.</summary>
        public List<KeyValuePair<string, JToken>> Overrides { get; } = new List<KeyValuePair<string, JToken>>();

        /// <summary>The request that a line holds.</summary>
        /// <exception cref="ParameterException">The line is not a request.</exception>
        public static RunRequest Parse(string line)
        {
            JObject json = JsonText.ParseObject(line, "request");
            Require(json, "parameters", "a file's path", JTokenType.String);
            Require(json, "out", "a folder's path", JTokenType.String);
            Require(json, "repeat", "a whole number from 0", JTokenType.Integer);
            Require(json, "check", "true or false", JTokenType.Boolean);
            Require(json, "log", "true or false", JTokenType.Boolean);
            Require(json, "set", "an object of parameters", JTokenType.Object);
            return new RunRequest(json);
        }

        /// <summary>What the answer repeats: the id of a line, which need not be a whole request, or null.</summary>
        public static JToken? IdOf(string line)
        {
            try
            {
                return JsonText.ParseObject(line, "request")["id"];
            }
            catch (ParameterException)
            {
                return null;
            }
        }

        private static void Require(JObject json, string key, string allowed, JTokenType type)
        {
            JToken? value = json[key];
            if (value != null && value.Type != JTokenType.Null && value.Type != type)
            {
                throw new ParameterException("request", key, value.ToString(Newtonsoft.Json.Formatting.None), allowed);
            }
        }
    }
}
