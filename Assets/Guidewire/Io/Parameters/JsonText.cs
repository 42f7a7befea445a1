using System.IO;
using System.Linq;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads JSON that <see cref="StrictJson"/> has passed: no dates made of strings, numbers as
    /// doubles.</summary>
    internal static class JsonText
    {
        /// <summary>May hold a text for readers in any object of any file; nothing else takes notice of it.</summary>
        public const string NoteKey = "note";

        /// <summary>The value that a text holds.</summary>
        public static JToken Parse(string text)
        {
            using var reader = new JsonTextReader(new StringReader(text));
            reader.DateParseHandling = DateParseHandling.None;
            reader.FloatParseHandling = FloatParseHandling.Double;
            return JToken.ReadFrom(reader);
        }

        /// <summary>The value that a text on the command line stands for, or null where it stands for none.</summary>
        public static JToken? Given(string text) => StrictJson.FindError(text) == null ? Parse(text) : null;

        /// <summary>The object that a file holds.</summary>
        /// <exception cref="ParameterException">The file cannot be read, is not JSON or holds no object.</exception>
        public static JObject ReadObject(string file) =>
            ParseObject(PlainFile.ReadText(file, "a parameter file"), file);

        /// <summary>The object that a text holds, without its notes.</summary>
        /// <param name="text">The text.</param>
        /// <param name="source">What errors name as its source.</param>
        /// <exception cref="ParameterException">The text is not JSON or holds no object.</exception>
        public static JObject ParseObject(string text, string source)
        {
            string? error = StrictJson.FindError(text);
            if (error != null)
            {
                throw new ParameterException(source + ": not JSON: " + error);
            }
            JObject content = Parse(text) as JObject
                ?? throw new ParameterException(source + ": needs one JSON object, { \"key\": value, ... }");
            foreach (JObject one in content.DescendantsAndSelf().OfType<JObject>().ToArray())
            {
                if (one[NoteKey]?.Type == JTokenType.String)
                {
                    one.Remove(NoteKey);
                }
            }
            return content;
        }
    }
}
