using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Lines of words separated by blanks, from the bytes of a text file. A mark of UTF-8 at its beginning is
    /// left out, and a backslash at the end of a line continues it.</summary>
    internal sealed class TextLines
    {
        private static readonly char[] Blanks = { ' ', '\t', '\v', '\f', '\r' };
        private static readonly byte[] Mark = { 0xEF, 0xBB, 0xBF };
        private readonly byte[] _bytes;
        private int _next;

        public TextLines(byte[] bytes)
        {
            _bytes = bytes;
            _next = bytes.AsSpan().StartsWith(Mark) ? Mark.Length : 0;
        }

        /// <summary>Number of the current line, from 1.</summary>
        public int Number { get; private set; }

        /// <summary>Words of the current line.</summary>
        public string[] Words { get; private set; } = Array.Empty<string>();

        /// <summary>Is true where the bytes look like text: no zero byte among the first thousand.</summary>
        public static bool IsText(byte[] bytes) => Array.IndexOf(bytes, (byte)0, 0, Math.Min(bytes.Length, 1000)) < 0;

        /// <summary>Goes to the next line; false behind the last.</summary>
        public bool Next()
        {
            if (_next >= _bytes.Length)
            {
                return false;
            }
            bool isContinued = ReadLine(out string[] words);
            while (isContinued && _next < _bytes.Length)
            {
                isContinued = ReadLine(out string[] more);
                words = words.Concat(more).ToArray();
            }
            Words = words;
            return true;
        }

        private bool ReadLine(out string[] words)
        {
            int end = Array.IndexOf(_bytes, (byte)'\n', _next);
            end = end < 0 ? _bytes.Length : end;
            string line = Encoding.UTF8.GetString(_bytes, _next, end - _next);
            int comment = line.IndexOf('#');
            line = (comment < 0 ? line : line.Substring(0, comment)).TrimEnd();
            bool isContinued = line.EndsWith("\\", StringComparison.Ordinal);
            words = (isContinued ? line.Substring(0, line.Length - 1) : line)
                .Split(Blanks, StringSplitOptions.RemoveEmptyEntries);
            _next = end + 1;
            Number++;
            return isContinued;
        }

        /// <summary>Adds the vertex that the three words after the first are.</summary>
        /// <returns>What is wrong with the line, in one phrase, or null.</returns>
        public string? ReadVertex(List<Vector3d> vertices)
        {
            if (Words.Length < 4 || !NumberText.TryRead(Words[1], out double x)
                || !NumberText.TryRead(Words[2], out double y) || !NumberText.TryRead(Words[3], out double z))
            {
                return Error("three finite numbers behind " + Words[0]);
            }
            vertices.Add(new Vector3d(x, y, z));
            return null;
        }

        /// <summary>What is wrong with the current line, in one phrase.</summary>
        public string Error(string needed)
        {
            string line = string.Join(" ", Words);
            line = line.Length > 60 ? line.Substring(0, 57) + "..." : line;
            var clean = new StringBuilder();
            foreach (char c in line)
            {
                clean.Append(char.IsControl(c) ? '?' : c);
            }
            return "line " + Number.ToString(CultureInfo.InvariantCulture) + " '" + clean + "' needs " + needed;
        }
    }
}
