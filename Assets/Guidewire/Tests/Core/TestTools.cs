using System;
using System.Globalization;
using System.Reflection;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Roots and limits by bisection.</summary>
    internal static class Bisection
    {
        /// <summary>The number between two others up to which a condition holds; 60 halvings are to rounding.</summary>
        public static double Limit(double low, double high, Func<double, bool> holds, int halvings = 60)
        {
            for (int k = 0; k < halvings; k++)
            {
                double middle = 0.5 * (low + high);
                if (holds(middle))
                {
                    low = middle;
                }
                else
                {
                    high = middle;
                }
            }
            return low;
        }
    }

    /// <summary>Counts what code leaves for the garbage collector.</summary>
    internal static class Garbage
    {
        private const int Probe = 1 << 16;    // bytes

        // Asked for by name, because not every profile that Unity compiles tests for has it.
        private static readonly MethodInfo? Counter =
            typeof(GC).GetMethod("GetAllocatedBytesForCurrentThread", Type.EmptyTypes);

        /// <summary>Bytes that this thread allocates in an action. The test is ignored where the runtime does not count
        /// them, as Unity's own collector may not: there a zero would prove nothing.</summary>
        public static long LeftBy(Action action)
        {
            Func<long> count = Counter == null ? () => 0L
                : (Func<long>)Delegate.CreateDelegate(typeof(Func<long>), Counter);
            long start = count();
            GC.KeepAlive(new byte[Probe]);
            if (count() - start < Probe)
            {
                Assert.Ignore("this runtime does not count allocated bytes, so that nothing can be said here");
            }
            long before = count();
            action();
            return count() - before;
        }

        /// <summary>Bytes that further steps of a run allocate, after as many as bring it into its usual course: the
        /// least of up to four times so many steps. Once in many runs of all tests some hundred bytes to 4 kB were
        /// counted that no repetition showed; steps that allocate do so in each.</summary>
        public static long LeftBySteps(Simulation run, int before, int steps)
        {
            Wires.Step(run, before);
            long least = long.MaxValue;
            for (int k = 0; k < 4 && least > 0; k++)
            {
                least = Math.Min(least, LeftBy(() => Wires.Step(run, steps)));
                Wires.GoOn(run, least > 0 ? 1 : 0);    // a run at its end would allocate nothing
            }
            return least;
        }
    }

    /// <summary>The largest difference of values from those expected, against the largest expected.</summary>
    internal sealed class LargestError
    {
        private double _error;
        private double _peak;

        public void Add(double value, double expected)
        {
            _error = Math.Max(_error, Math.Abs(value - expected));
            _peak = Math.Max(_peak, Math.Abs(expected));
        }

        /// <summary>Some value was above `least`, and no error is as large as a millionth of the largest.</summary>
        public void AssertSmall(double least)
        {
            Assert.That(_peak, Is.GreaterThan(least));
            Assert.That(_error, Is.LessThan(1e-6 * _peak));
        }
    }

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
