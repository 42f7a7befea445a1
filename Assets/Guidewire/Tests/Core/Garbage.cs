using System;
using System.Reflection;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
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
}
