using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Counts what code leaves for the garbage collector.</summary>
    internal static class Garbage
    {
        private const int Probe = 1 << 16;    // bytes

        /// <summary>Bytes that this thread allocates in an action. The test is ignored where the runtime does not count
        /// them, as Unity's own collector may not: there a zero would prove nothing.</summary>
        public static long LeftBy(Action action)
        {
            long start = GC.GetAllocatedBytesForCurrentThread();
            GC.KeepAlive(new byte[Probe]);
            if (GC.GetAllocatedBytesForCurrentThread() - start < Probe)
            {
                Assert.Ignore("this runtime does not count allocated bytes, so that nothing can be said here");
            }
            long before = GC.GetAllocatedBytesForCurrentThread();
            action();
            return GC.GetAllocatedBytesForCurrentThread() - before;
        }
    }
}
