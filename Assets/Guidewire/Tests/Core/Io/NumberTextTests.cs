using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;
using Guidewire.Io;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The rule by which numbers are written, against the bits and against .NET's own shortest text.</summary>
    [Category("Target")]
    public sealed class NumberTextTests
    {
        private static readonly int Count = RandomGeometry.Cases(200_000, 20);

        // .NET writes the shortest text since Core 3.0; a runtime that writes otherwise is what the rule is for.
        private static readonly bool HasShortest = (5e-324).ToString("R", CultureInfo.InvariantCulture) == "5E-324"
            && 0.3.ToString("R", CultureInfo.InvariantCulture) == "0.3"
            && 5.0e-15.ToString("R", CultureInfo.InvariantCulture) == "5E-15"
            && 2.2250738585072014e-308.ToString("R", CultureInfo.InvariantCulture) == "2.2250738585072014E-308"
            && 9007199254740993.5.ToString("R", CultureInfo.InvariantCulture) == "9007199254740994";

        private static IEnumerable<double> Numbers()
        {
            foreach (double number in new[] { 0.0, -0.0, 1.0, -1.5, 0.1, 0.30000000000000004, 1e-5, 1e-6, 1e14, 1e15,
                1e16, 123456789012345680.0, 1234567890123456.0, 9007199254740993.0, 9.999999999999999e22,
                double.Epsilon, double.MaxValue, double.MinValue, 2.2250738585072014e-308 })
            {
                yield return number;
            }
            for (int exponent = -1074; exponent < 1024; exponent++)
            {
                double power = Math.Pow(2.0, exponent);
                yield return power;
                yield return BitConverter.Int64BitsToDouble(BitConverter.DoubleToInt64Bits(power) + 1);
                yield return BitConverter.Int64BitsToDouble(Math.Max(0, BitConverter.DoubleToInt64Bits(power) - 1));
            }
            for (int exponent = -323; exponent <= 308; exponent++)
            {
                yield return double.Parse("1e" + exponent.ToString(CultureInfo.InvariantCulture),
                    CultureInfo.InvariantCulture);
            }
            var random = new System.Random(5);
            var bits = new byte[8];
            for (int k = 0; k < Count; k++)
            {
                random.NextBytes(bits);
                double any = BitConverter.ToDouble(bits, 0);
                if (!double.IsNaN(any) && !double.IsInfinity(any))
                {
                    yield return any;
                }
                yield return Math.Round(1000.0 * random.NextDouble(), k % 12);
                yield return (random.NextDouble() - 0.5) * Math.Pow(10.0, random.Next(-8, 18));
            }
        }

        [Test]
        public void EveryNumber_ReadsBackAsTheSameBits()
        {
            foreach (double number in Numbers())
            {
                double back = double.Parse(NumberText.Shortest(number), CultureInfo.InvariantCulture);
                if (number != 0.0 && BitConverter.DoubleToInt64Bits(back) != BitConverter.DoubleToInt64Bits(number))
                {
                    Assert.Fail(NumberText.Shortest(number) + " is not " + BitConverter.DoubleToInt64Bits(number));
                }
            }
        }

        [Test]
        public void TheRule_IsTheShortestTextOfDotNet()
        {
            Assume.That(HasShortest, "this runtime does not write the shortest text by itself");
            foreach (double number in Numbers())
            {
                string expected = number.ToString(CultureInfo.InvariantCulture);
                if (double.Parse(expected, CultureInfo.InvariantCulture) != number)
                {
                    Assert.That(NumberText.IsMiswritten(number), Is.True, expected + " is another number's text");
                }
                else if (NumberText.Shortest(number) != expected)
                {
                    Assert.Fail(NumberText.Shortest(number) + " instead of " + expected);
                }
            }
        }

        [Test]
        public void LogAndHash_HaveOneRule()
        {
            var bytes = new byte[NumberText.Longest];
            foreach (double number in Numbers())
            {
                string logged = Encoding.ASCII.GetString(bytes, 0, NumberText.Write(number, bytes, 0));
                if (logged != NumberText.Shortest(number))
                {
                    Assert.Fail(logged + " instead of " + NumberText.Shortest(number));
                }
            }
        }

        [TestCase("{\"a\":[1,2.0,0.1,1e300,-0.0],\"b\":{\"c\":null,\"d\":\"x\\n\",\"e\":true}}")]
        [TestCase("[]")]
        [TestCase("3")]
        [TestCase("123456789012345680.0")]
        public void Json_IsNewtonsofts_ButForTheRule(string json)
        {
            Assume.That(HasShortest, "this runtime does not write the shortest text by itself");
            JToken token = JToken.Parse(json);
            Assert.That(NumberText.Write(token), Is.EqualTo(token.ToString(Formatting.None)));
        }

        [TestCase(0.30000000000000004, "0.30000000000000004")]
        [TestCase(0.1, "0.1")]
        [TestCase(100.0, "100")]
        [TestCase(-2.5e-7, "-2.5E-07")]
        [TestCase(0.00001, "1E-05")]
        [TestCase(0.0001, "0.0001")]
        [TestCase(1e16, "10000000000000000")]
        [TestCase(1e17, "1E+17")]
        [TestCase(123456789012345.6, "123456789012345.6")]
        public void Text(double number, string expected) =>
            Assert.That(NumberText.Shortest(number), Is.EqualTo(expected));
    }
}
