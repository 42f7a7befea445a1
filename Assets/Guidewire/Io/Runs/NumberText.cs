using System;
using System.Globalization;
using System.IO;
using System.Text;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Doubles as text by one rule on every runtime: the fewest digits that read back as the same bits, of
    /// those the nearest, laid out as .NET does. Unity's Mono by itself writes 17 digits where 16 do.</summary>
    internal static class NumberText
    {
        /// <summary>Characters of the longest number, -2.2250738585072014E-308.</summary>
        public const int Longest = 24;

        private const int SafeDigits = 15;    // so many digits survive conversion to a normal double and back
        private const int MaxDigits = 17;    // every double survives conversion to so many digits and back
        private const double SmallestNormal = 2.2250738585072014e-308;

        /// <summary>The finite number that a text is; false where it is none.</summary>
        public static bool TryRead(string text, out double number)
        {
            return double.TryParse(text, NumberStyles.Float, CultureInfo.InvariantCulture, out number)
                && !double.IsNaN(number) && !double.IsInfinity(number);
        }

        /// <summary>Writes a finite number as ASCII from an index on.</summary>
        /// <returns>Bytes written, at most <see cref="Longest"/>.</returns>
        public static int Write(double value, byte[] target, int start)
        {
#if NET8_0_OR_GREATER
            if (!IsMiswritten(value))
            {
                value.TryFormat(target.AsSpan(start), out int written, default, CultureInfo.InvariantCulture);
                return written;
            }
#endif
            string text = Shortest(value);
            return Encoding.ASCII.GetBytes(text, 0, text.Length, target, start);
        }

        /// <summary>Gives JSON on one line, its numbers by this rule.</summary>
        public static string Write(JToken token)
        {
            using var text = new StringWriter(CultureInfo.InvariantCulture);
            using var writer = new Writer(text);
            token.WriteTo(writer);
            writer.Flush();
            return text.ToString();
        }

        /// <summary>Gives the rule itself, from formats that every runtime rounds correctly.</summary>
        internal static string Shortest(double value)
        {
            string sign = BitConverter.DoubleToInt64Bits(value) < 0 ? "-" : "";
            double size = Math.Abs(value);
            for (int digits = size < SmallestNormal ? 1 : SafeDigits; digits < MaxDigits; digits++)
            {
                string nearest = Scientific(size, digits);
                if (Read(nearest) == size)
                {
                    return sign + LayOut(nearest);
                }

                // At a power of two the doubles below are twice as near, so that the next decimal above may do.
                string above = Above(nearest);
                if (Read(above) == size)
                {
                    return sign + LayOut(above);
                }
            }
            return sign + LayOut(Scientific(size, MaxDigits));
        }

        /// <summary>Whether .NET's own text is that of a neighbour: 2^-25 and 2^-958 alone of all powers of two, with
        /// .NET 10; no other number is known.</summary>
        internal static bool IsMiswritten(double value)
        {
            double size = Math.Abs(value);
            return size == 2.98023223876953125e-8 || size == 4.1045368012983762e-289;
        }

        private static string Scientific(double size, int digits)
        {
            return size.ToString("E" + (digits - 1).ToString(CultureInfo.InvariantCulture),
                CultureInfo.InvariantCulture);
        }

        private static double Read(string text) => double.Parse(text, NumberStyles.Float, CultureInfo.InvariantCulture);

        // d.ddd...E+xxx with one more in the last digit; a text of nines stays as it is.
        private static string Above(string text)
        {
            char[] letters = text.ToCharArray();
            int index = text.IndexOf('E') - 1;
            while (index >= 0 && (letters[index] == '9' || letters[index] == '.'))
            {
                letters[index] = letters[index] == '9' ? '0' : '.';
                index--;
            }
            if (index < 0)
            {
                return text;
            }
            letters[index]++;
            return new string(letters);
        }

        // From d.ddd...E+xxx: no zeros at the end; an exponent only from 1e17 on and below 1e-4.
        private static string LayOut(string text)
        {
            int mark = text.IndexOf('E');
            string digits = text.Substring(0, mark).Replace(".", "").TrimEnd('0');
            int exponent = int.Parse(text.Substring(mark + 1), NumberStyles.AllowLeadingSign,
                CultureInfo.InvariantCulture);
            if (digits.Length == 0)
            {
                return "0";
            }
            if (exponent >= MaxDigits || exponent < -4)
            {
                string tail = digits.Length == 1 ? "" : "." + digits.Substring(1);
                return digits.Substring(0, 1) + tail + "E" + exponent.ToString("+00;-00", CultureInfo.InvariantCulture);
            }
            if (exponent < 0)
            {
                return "0." + new string('0', -exponent - 1) + digits;
            }
            return exponent + 1 >= digits.Length ? digits.PadRight(exponent + 1, '0')
                : digits.Substring(0, exponent + 1) + "." + digits.Substring(exponent + 1);
        }

        /// <summary>Newtonsoft's writer, but for the text of a double; as there, a whole number has a ".0".</summary>
        private sealed class Writer : JsonTextWriter
        {
            public Writer(TextWriter text)
                : base(text)
            {
            }

            public override void WriteValue(double value)
            {
                if (double.IsNaN(value) || double.IsInfinity(value))
                {
                    base.WriteValue(value);
                    return;
                }
                string text = Shortest(value);
                WriteRawValue(text.IndexOf('.') < 0 && text.IndexOf('E') < 0 ? text + ".0" : text);
            }
        }
    }
}
