using System;
using System.Collections.Generic;
using System.Globalization;
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

    /// <summary>Checks that a text is JSON as RFC 8259 has it. Newtonsoft.Json also takes comments, single quotes, NaN,
    /// trailing commas and names without quotes, and a file that only some programs can read is an error here. So is a
    /// key that stands twice in one object, where RFC 8259 leaves open which counts.</summary>
    internal sealed class StrictJson
    {
        private const int MaximumDepth = 64;

        private readonly string _text;
        private int _at;

        private StrictJson(string text)
        {
            _text = text;
        }

        /// <summary>What is wrong with the text and where, in one phrase, or null.</summary>
        public static string? FindError(string text)
        {
            var check = new StrictJson(text);
            string? error = check.Value(0);
            if (error == null)
            {
                check.Blank();
                error = check._at < text.Length ? check.Unexpected("the end of the text") : null;
            }
            return error;
        }

        private string? Value(int depth)
        {
            Blank();
            if (depth > MaximumDepth)
            {
                return At("is nested too deeply");
            }
            switch (Current())
            {
                case '{':
                    return Members(depth, '}');
                case '[':
                    return Members(depth, ']');
                case '"':
                    return Text();
                case 't':
                    return Word("true");
                case 'f':
                    return Word("false");
                case 'n':
                    return Word("null");
                default:
                    return Number();
            }
        }

        private string? Members(int depth, char close)
        {
            _at++;
            Blank();
            if (Current() == close)
            {
                _at++;
                return null;
            }
            HashSet<string>? names = close == '}' ? new HashSet<string>() : null;
            while (true)
            {
                Blank();
                if (Current() == close)
                {
                    return At("has a comma before '" + close + "'");
                }
                string? error = names != null ? Name(names) : null;
                error ??= Value(depth + 1);
                if (error != null)
                {
                    return error;
                }
                Blank();
                char next = Current();
                if (next != ',' && next != close)
                {
                    return Unexpected("',' or '" + close + "'");
                }
                _at++;
                if (next == close)
                {
                    return null;
                }
            }
        }

        private string? Name(HashSet<string> names)
        {
            if (Current() != '"')
            {
                return Unexpected("a key in double quotes");
            }
            int start = _at + 1;
            string? error = Text();
            if (error != null)
            {
                return error;
            }
            // Compared as it reads, not as it is written: "a" and "\u0061" are the same key.
            string written = _text.Substring(start, _at - start - 1);
            string name = written.Contains('\\') ? JsonText.Parse("\"" + written + "\"").ToString() : written;
            if (!names.Add(name))
            {
                _at = start;
                return At("has the key '" + name + "' a second time: each key may stand once");
            }
            Blank();
            if (Current() != ':')
            {
                return Unexpected("':'");
            }
            _at++;
            return null;
        }

        private string? Text()
        {
            for (_at++; _at < _text.Length; _at++)
            {
                char c = _text[_at];
                if (c == '"')
                {
                    _at++;
                    return null;
                }
                if (c < ' ')
                {
                    return At("has a line break or control character inside a string");
                }
                if (c == '\\')
                {
                    _at++;
                    if (!"\"\\/bfnrtu".Contains(Current()) || (Current() == 'u' && !FourHexDigits(_at + 1)))
                    {
                        return At("has an unknown escape in a string");
                    }
                }
            }
            return At("ends inside a string");
        }

        private bool FourHexDigits(int start)
        {
            for (int i = start; i < start + 4; i++)
            {
                if (i >= _text.Length || !Uri.IsHexDigit(_text[i]))
                {
                    return false;
                }
            }
            return true;
        }

        private string? Word(string word)
        {
            if (string.CompareOrdinal(_text, _at, word, 0, word.Length) != 0)
            {
                return Unexpected("a value");
            }
            _at += word.Length;
            return null;
        }

        private string? Number()
        {
            int start = _at;
            if (Current() == '-')
            {
                _at++;
            }
            bool leadingZero = Current() == '0';
            int whole = Digits();
            bool valid = whole == 1 || (whole > 1 && !leadingZero);
            if (valid && Current() == '.')
            {
                _at++;
                valid = Digits() > 0;
            }
            if (valid && (Current() == 'e' || Current() == 'E'))
            {
                _at++;
                if (Current() == '+' || Current() == '-')
                {
                    _at++;
                }
                valid = Digits() > 0;
            }
            if (!valid)
            {
                _at = start;
                return Unexpected("a value");
            }
            return null;
        }

        private int Digits()
        {
            int start = _at;
            while (Current() >= '0' && Current() <= '9')
            {
                _at++;
            }
            return _at - start;
        }

        private void Blank()
        {
            while (_at < _text.Length && " \t\r\n".Contains(_text[_at]))
            {
                _at++;
            }
        }

        private char Current() => _at < _text.Length ? _text[_at] : '\0';

        private string Unexpected(string expected)
        {
            if (_at >= _text.Length)
            {
                return At("ends where " + expected + " is expected");
            }
            if (Current() == '#' || Current() == '/')
            {
                return At("has a comment, and JSON has none: a text under the key \"note\" can say the same");
            }
            if (Current() == ';')
            {
                return At("has ';' where " + expected + " is expected: JSON separates by commas");
            }
            if (char.IsDigit(Current()) && _at > 1 && _text[_at - 1] == ',' && char.IsDigit(_text[_at - 2]))
            {
                return At("has a number with a comma: JSON has a decimal point, not a comma");
            }
            int length = 1;
            while (length < 12 && _at + length < _text.Length && char.IsLetterOrDigit(_text[_at + length]))
            {
                length++;
            }
            string found = _text.Substring(_at, length);
            return At("has " + (found[0] < ' ' ? "a control character" : "'" + found + "'") + " where " + expected
                + " is expected");
        }

        private string At(string error)
        {
            int line = 1;
            int column = 1;
            for (int i = 0; i < _at && i < _text.Length; i++)
            {
                column = _text[i] == '\n' ? 1 : column + 1;
                line += _text[i] == '\n' ? 1 : 0;
            }
            return string.Format(CultureInfo.InvariantCulture, "line {0}, column {1} {2}", line, column, error);
        }
    }
}
