using System;
using System.Globalization;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Seeded random points and figures of size 1, among them the awkward ones.</summary>
    internal sealed class RandomGeometry
    {
        private readonly Random _random;

        public RandomGeometry(int seed)
        {
            _random = new Random(seed);
        }

        /// <summary>How many cases to try: all of them when the environment variable GUIDEWIRE_ALL is set, otherwise
        /// one of so many, by default of ten.</summary>
        public static int Cases(int all, int oneOf = 10) =>
            string.IsNullOrEmpty(Environment.GetEnvironmentVariable("GUIDEWIRE_ALL")) ? all / oneOf : all;

        /// <summary>The first of so many cases to try of all, each day the next ones: the environment variable
        /// GUIDEWIRE_DAY is the number of the day.</summary>
        public static int FirstOfTheDay(int count, int all)
        {
            string day = Environment.GetEnvironmentVariable("GUIDEWIRE_DAY") ?? "0";
            return count * (int.Parse(day, CultureInfo.InvariantCulture) % (all / count));
        }

        /// <summary>Draws 100,000 cases, or a tenth of them, and asserts that no error of one exceeds the
        /// tolerance.</summary>
        public static void AssertErrors(int seed, double tolerance, Func<RandomGeometry, double> error)
        {
            var random = new RandomGeometry(seed);
            double worst = 0.0;
            for (int i = 0; i < Cases(100_000); i++)
            {
                worst = Math.Max(worst, error(random));
            }
            Assert.That(worst, Is.LessThan(tolerance));
        }

        public double Number(double from, double to) => from + (to - from) * _random.NextDouble();

        public int Index(int count) => _random.Next(count);

        /// <summary>A point in the cube from -1 to 1.</summary>
        public Vector3d Point() => new Vector3d(Number(-1.0, 1.0), Number(-1.0, 1.0), Number(-1.0, 1.0));

        public Vector3d Direction()
        {
            while (true)
            {
                Vector3d v = Point();
                if (v.Length > 0.1 && v.Length <= 1.0)
                {
                    return Vector3d.Normalize(v);
                }
            }
        }

        public Quaterniond Orientation() => Quaterniond.FromAxisAngle(Direction(), Number(0.0, 2.0 * Math.PI));

        /// <summary>A triangle; one in four is a needle, down to a height of 1e-12.</summary>
        public Vector3d[] Triangle()
        {
            var triangle = new[] { Point(), Point(), Point() };
            if (Index(4) == 0)
            {
                double height = Math.Pow(10.0, Number(-12.0, -1.0));
                triangle[2] = Vector3d.Lerp(triangle[0], triangle[1], Number(-0.2, 1.2)) + height * Direction();
            }
            return triangle;
        }

        /// <summary>A segment; one in four is nearly parallel to the direction given, one in eight has no length.
        /// </summary>
        public Vector3d[] Segment(in Vector3d direction)
        {
            Vector3d a = Point();
            switch (Index(8))
            {
                case 0:
                case 1:
                    Vector3d along = Number(-1.0, 1.0) * direction;
                    return new[] { a, a + along + Math.Pow(10.0, Number(-16.0, -2.0)) * Direction() };
                case 2:
                    return new[] { a, a };
                default:
                    return new[] { a, Point() };
            }
        }
    }
}
