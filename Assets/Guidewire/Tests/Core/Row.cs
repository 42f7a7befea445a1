using System;
using System.Globalization;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Lines of the validation report that a test holds; the report takes their figures from its
    /// output.</summary>
    internal static class Row
    {
        /// <summary>Asserts that a value is within its limit of a reference, and writes the line.</summary>
        /// <param name="what">What is measured; of one name the report has the worst.</param>
        public static void Holds(string what, double value, double reference, double limit)
        {
            TestContext.WriteLine(string.Format(CultureInfo.InvariantCulture, "row: {0} | {1:R} | {2:R} | {3:R}", what,
                value, reference, limit));
            Assert.That(value, Is.EqualTo(reference).Within(limit), what);
        }
    }
}
