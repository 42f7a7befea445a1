using System.IO;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads JSON that <see cref="StrictJson"/> has passed: no dates made of strings, numbers as
    /// doubles.</summary>
    public static class JsonText
    {
        /// <summary>The value that a text holds.</summary>
        internal static JToken Parse(string text)
        {
            using var reader = new JsonTextReader(new StringReader(text));
            reader.DateParseHandling = DateParseHandling.None;
            reader.FloatParseHandling = FloatParseHandling.Double;
            return JToken.ReadFrom(reader);
        }

        /// <summary>The object that a file holds.</summary>
        /// <exception cref="ParameterException">The file cannot be read, is not JSON or holds no object.</exception>
        public static JObject ReadObject(string file)
        {
            return ParseObject(ReadFile(file), file);
        }

        /// <summary>The object that a text holds.</summary>
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
            return Parse(text) as JObject
                ?? throw new ParameterException(source + ": needs one JSON object, { \"key\": value, ... }");
        }

        private static string ReadFile(string file)
        {
            try
            {
                return File.ReadAllText(file);
            }
            catch (IOException error)
            {
                bool missing = error is FileNotFoundException || error is DirectoryNotFoundException;
                throw new ParameterException(file
                    + (missing ? ": no such file" : ": cannot be read: " + error.Message));
            }
            catch (System.UnauthorizedAccessException)
            {
                throw new ParameterException(file
                    + (Directory.Exists(file) ? ": is a folder, a parameter file is needed"
                    : ": cannot be read: permission denied"));
            }
        }
    }
}
