using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Io
{
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
