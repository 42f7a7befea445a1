using System.Collections.Generic;
using System.Linq;
using Guidewire.Core;
using Guidewire.Io;
using Newtonsoft.Json.Linq;

namespace Guidewire.Cli
{
    /// <summary>One line of the request loop's input.</summary>
    internal sealed class RunRequest
    {
        private const string HubNeeds = "a whole number from 0, the wire's";

        private RunRequest(JObject json)
        {
            Id = json["id"];
            ParameterFile = (string?)json["parameters"];
            Out = (string?)json["out"];
            Repeat = (int?)json["repeat"];
            IsCheck = (bool?)json["check"] ?? false;
            Log = (bool?)json["log"] ?? true;
            Session = (string?)json["session"];
            Hand = (bool?)json["hand"];
            Record = (bool?)json["record"] ?? false;
            Steps = (int?)json["steps"] ?? 1;
            Pushes = (json["push"] as JArray)?.Values<double>().ToArray();
            Turns = (json["turn"] as JArray)?.Values<double>().ToArray();
            Push = Pushes != null ? 0.0 : (double?)json["push"] ?? 0.0;
            Turn = Turns != null ? 0.0 : (double?)json["turn"] ?? 0.0;
            Hub = (int?)json["hub"] ?? 0;
            Snapshot = (string?)json["snapshot"] ?? "";
            View = (JObject?)json["view"] ?? new JObject();
            Positions = (string?)json["positions"] ?? "";
            Middle = MiddleOf(json["middle"]);
            Reach = (double?)json["reach"];
            Amount = (double?)json["amount"];
            Rate = (double?)json["rate"] ?? 1.0;
            Seconds = (double?)json["seconds"] ?? 0.0;
            AtInlet = (bool?)json["inlet"] ?? false;
            Flow = (JObject?)json["flow"];
            foreach (JProperty property in ((JObject?)json["set"] ?? new JObject()).Properties())
            {
                Overrides.Add(new KeyValuePair<string, JToken>(property.Name, property.Value));
            }
        }

        /// <summary>What the answer repeats, or null.</summary>
        public JToken? Id { get; }

        /// <summary>The parameter file, or null for the defaults.</summary>
        public string? ParameterFile { get; }

        /// <summary>The folder of the results.</summary>
        public string? Out { get; }

        /// <summary>Number of a timed repeat, or null.</summary>
        public int? Repeat { get; }

        /// <summary>Whether the parameters are only checked, and the run's address reported.</summary>
        public bool IsCheck { get; }

        /// <summary>Whether the run leaves a log.</summary>
        public bool Log { get; }

        /// <summary>What is to be done with a run that is stepped by requests, or null for a whole run.</summary>
        public string? Session { get; }

        /// <summary>Whether requests steer it in place of the drive; null: wherever the method may be
        /// steered.</summary>
        public bool? Hand { get; }

        /// <summary>Whether the session records how it is steered, for drive tables.</summary>
        public bool Record { get; }

        /// <summary>Steps to make.</summary>
        public int Steps { get; }

        /// <summary>Displacement of sphere 0 along the first element in all of them, units.</summary>
        public double Push { get; }

        /// <summary>Turn of the first element about its axis in all of them, rad.</summary>
        public double Turn { get; }

        /// <summary>Displacement of each hub in all of them, the wire's first, units; null where one is
        /// moved.</summary>
        public double[]? Pushes { get; }

        /// <summary>Turn of each hub in all of them, rad; null where one is moved.</summary>
        public double[]? Turns { get; }

        /// <summary>Whose hub they move: 0 the wire's, k that of catheter k.</summary>
        public int Hub { get; }

        /// <summary>What is to be restored, as base64.</summary>
        public string Snapshot { get; }

        /// <summary>Which picture is to be taken.</summary>
        public JObject View { get; }

        /// <summary>The wire of a picture as base64 of doubles; empty: the session's.</summary>
        public string Positions { get; }

        /// <summary>Middle of a picture of walls, units, or null for that of the wire.</summary>
        public Vector3d? Middle { get; }

        /// <summary>How far from there walls without end are drawn, units, or null for the wire's length.</summary>
        public double? Reach { get; }

        /// <summary>Contrast agent to be injected, ml; 0 ends an injection; null: no other one.</summary>
        public double? Amount { get; }

        /// <summary>The rate of the injection, ml/s.</summary>
        public double Rate { get; }

        /// <summary>Time by which the blood goes on without a step, s.</summary>
        public double Seconds { get; }

        /// <summary>Whether agent is injected where the blood comes in, and not at a tip.</summary>
        public bool AtInlet { get; }

        /// <summary>How blood flows, or null: as before.</summary>
        public JObject? Flow { get; }

        /// <summary>Parameters that count instead of the file's.</summary>
        public List<KeyValuePair<string, JToken>> Overrides { get; } = new List<KeyValuePair<string, JToken>>();

        /// <summary>The request that a line holds.</summary>
        /// <exception cref="ParameterException">The line is not a request.</exception>
        public static RunRequest Parse(string line)
        {
            JObject json = JsonText.ParseObject(line, "request");
            Check(json, "parameters", "a file's path", JTokenType.String);
            Check(json, "out", "a folder's path", JTokenType.String);
            Check(json, "repeat", "a whole number from 0", JTokenType.Integer);
            Check(json, "steps", "a whole number from 1", JTokenType.Integer);
            Check(json, "hub", HubNeeds, JTokenType.Integer);
            Check(json, "check", "true or false", JTokenType.Boolean);
            Check(json, "log", "true or false", JTokenType.Boolean);
            Check(json, "set", "an object of parameters", JTokenType.Object);
            Check(json, "session", "a text", JTokenType.String);
            Check(json, "hand", "true or false", JTokenType.Boolean);
            Check(json, "record", "true or false", JTokenType.Boolean);
            Check(json, "snapshot", "base64 as of \"save\"", JTokenType.String);
            Check(json, "view", "an object", JTokenType.Object);
            Check(json, "positions", "base64 of doubles", JTokenType.String);
            CheckNumber(json, "repeat", 0.0, int.MaxValue, "a whole number from 0");
            CheckNumber(json, "steps", 1.0, int.MaxValue, "a whole number from 1");
            CheckNumber(json, "hub", 0.0, int.MaxValue, HubNeeds);
            CheckNumbers(json, "push", "a number (units), or a list of one for each hub");
            CheckNumbers(json, "turn", "a number (rad), or a list of one for each hub");
            Check(json, "inlet", "true or false", JTokenType.Boolean);
            Check(json, "flow", "an object", JTokenType.Object);
            CheckNumber(json, "amount", 0.0, 1e4, "a number from 0 to 10000 (ml)");
            CheckNumber(json, "rate", 1e-6, 1e4, "a number from 1e-6 to 10000 (ml/s)");
            CheckNumber(json, "seconds", 0.0, 1e4, "a number from 0 to 10000 (s)");
            CheckNumber(json, "reach", double.Epsilon, double.MaxValue, "a number above 0 (units)");
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

        private static Vector3d? MiddleOf(JToken? value)
        {
            if (value == null || value.Type == JTokenType.Null)
            {
                return null;
            }
            bool isPoint = value is JArray numbers && numbers.Count == 3 && numbers.All(one =>
                one.Type == JTokenType.Integer || one.Type == JTokenType.Float);
            var point = isPoint ? new Vector3d((double)value[0]!, (double)value[1]!, (double)value[2]!) : default;
            return isPoint && point.IsFinite ? point : throw new ParameterException("request", "middle",
                value.ToString(Newtonsoft.Json.Formatting.None), "three numbers (units)");
        }

        private static void CheckNumbers(JObject json, string key, string allowed)
        {
            if (!(json[key] is JArray values))
            {
                CheckNumber(json, key, double.MinValue, double.MaxValue, allowed);
                return;
            }
            foreach (JToken value in values)
            {
                CheckNumber(new JObject { [key] = value.DeepClone() }, key, double.MinValue, double.MaxValue, allowed);
                if (value.Type == JTokenType.Null)
                {
                    throw new ParameterException("request", key, "null", allowed);
                }
            }
        }

        private static void CheckNumber(JObject json, string key, double low, double high, string allowed)
        {
            JToken? value = json[key];
            if (value == null || value.Type == JTokenType.Null)
            {
                return;
            }
            bool isNumber = value.Type == JTokenType.Integer || value.Type == JTokenType.Float;
            if (!isNumber || !((double)value >= low && (double)value <= high))
            {
                throw new ParameterException("request", key, value.ToString(Newtonsoft.Json.Formatting.None), allowed);
            }
        }

        private static void Check(JObject json, string key, string allowed, JTokenType type)
        {
            JToken? value = json[key];
            if (value != null && value.Type != JTokenType.Null && value.Type != type)
            {
                throw new ParameterException("request", key, value.ToString(Newtonsoft.Json.Formatting.None), allowed);
            }
        }
    }
}
