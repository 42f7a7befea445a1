using System;
using System.IO;
using System.Linq;
using System.Text;
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

    /// <summary>Reads a file that a parameter or an argument names, of <see cref="LargestMebibytes"/> at most: an
    /// endless device is refused in one line, as is a missing file.</summary>
    internal static class PlainFile
    {
        /// <summary>Largest file that is read, MiB.</summary>
        public const int LargestMebibytes = 256;

        private const int SmallestChunk = 1 << 12;    // bytes
        private const int LargestChunk = 1 << 20;

        /// <summary>Gives all bytes of a file.</summary>
        /// <param name="file">Its name.</param>
        /// <param name="needed">What is needed where the name is a folder's, as a noun phrase.</param>
        /// <exception cref="ParameterException">It cannot be read, is a folder, or is too large.</exception>
        public static byte[] ReadBytes(string file, string needed)
        {
            if (Directory.Exists(file))
            {
                throw new ParameterException(file + ": is a folder, " + needed + " is needed");
            }
            try
            {
                using FileStream stream = File.OpenRead(file);
                return ReadToEnd(stream, file);
            }
            catch (IOException error)
            {
                bool missing = error is FileNotFoundException || error is DirectoryNotFoundException;
                throw new ParameterException(
                    file + (missing ? ": no such file" : ": cannot be read: " + error.Message));
            }
            catch (Exception error) when (error is ArgumentException || error is NotSupportedException)
            {
                throw new ParameterException(file + ": cannot be read: " + error.Message);
            }
            catch (UnauthorizedAccessException)
            {
                throw new ParameterException(file + ": cannot be read: permission denied");
            }
        }

        /// <summary>Gives the text of a file, by its byte order mark or else as UTF-8.</summary>
        /// <exception cref="ParameterException">As <see cref="ReadBytes"/>.</exception>
        public static string ReadText(string file, string needed) => Decode(ReadBytes(file, needed));

        /// <summary>The text in bytes, by their byte order mark or else as UTF-8.</summary>
        public static string Decode(byte[] bytes)
        {
            using var reader = new StreamReader(new MemoryStream(bytes), Encoding.UTF8, true);
            return reader.ReadToEnd();
        }

        // A device or a pipe does not state its true length, so the bytes themselves are counted.
        private static byte[] ReadToEnd(Stream stream, string file)
        {
            long limit = (long)LargestMebibytes << 20;
            if (stream.CanSeek && stream.Length > limit)
            {
                throw TooLarge(file);
            }
            long stated = stream.CanSeek ? stream.Length : 0;
            using var content = new MemoryStream((int)stated);
            var chunk = new byte[Math.Clamp(stated + 1, SmallestChunk, LargestChunk)];
            int count;
            while ((count = stream.Read(chunk, 0, chunk.Length)) > 0)
            {
                if (content.Length + count > limit)
                {
                    throw TooLarge(file);
                }
                content.Write(chunk, 0, count);
            }
            return content.ToArray();
        }

        private static ParameterException TooLarge(string file)
        {
            return new ParameterException(
                file + ": holds more than " + LargestMebibytes + " MiB, which no file of a run may");
        }
    }
}
