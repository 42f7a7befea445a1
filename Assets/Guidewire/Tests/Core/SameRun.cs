using System;
using System.Collections;
using System.Reflection;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Compares all that two runs say of themselves, number by number and bit by bit.</summary>
    internal static class SameRun
    {
        /// <summary>Fails at the first number that differs, with its name.</summary>
        public static void AssertSame(Simulation actual, Simulation expected, string when)
        {
            AssertSame(actual.State, expected.State, when + ": State");
            Assert.That(actual.Warnings, Is.EqualTo(expected.Warnings), when);
            Assert.That((actual.Time, actual.StepCount, actual.Outcome, actual.Reason, actual.PredictionError),
                Is.EqualTo((expected.Time, expected.StepCount, expected.Outcome, expected.Reason,
                    expected.PredictionError)), when);
            AssertSame(actual.Contacts, expected.Contacts, when + ": Contacts");
            AssertSame(actual.Report(), expected.Report(), when + ": Report");
            AssertSame(actual.Hub(), expected.Hub(), when + ": Hub");
            AssertSame(actual.Catheters(), expected.Catheters(), when + ": Catheters");
            AssertSame(actual.Stress(), expected.Stress(), when + ": Stress");
        }

        private static void AssertSame(object? actual, object? expected, string name)
        {
            if (actual == null || expected == null || actual is string || actual.GetType().IsValueType)
            {
                Assert.That(actual, Is.EqualTo(expected), name);
            }
            else if (actual is IList items && expected is IList others)
            {
                Assert.That(items.Count, Is.EqualTo(others.Count), name);
                for (int k = 0; k < items.Count; k++)
                {
                    AssertSame(items[k], others[k], name + "[" + k + "]");
                }
            }
            else
            {
                foreach (PropertyInfo property in actual.GetType().GetProperties(
                    BindingFlags.Instance | BindingFlags.Public))
                {
                    if (property.GetIndexParameters().Length == 0)
                    {
                        AssertSame(property.GetValue(actual), property.GetValue(expected), name + "." + property.Name);
                    }
                }
            }
        }
    }
}
