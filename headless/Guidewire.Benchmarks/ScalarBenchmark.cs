using BenchmarkDotNet.Attributes;

namespace Guidewire.Benchmarks
{
    /// <summary>One step with scalar sweeps at n = 30: what all other times are compared with.</summary>
    public class ScalarBenchmark
    {
        private const int Elements = 30;
        private const int Iterations = 100;
        private SteppedWire _wire = null!;

        [GlobalSetup]
        public void Setup() => _wire = new SteppedWire(Elements, Iterations, scalar => scalar);

        [Benchmark]
        [Work(Elements * Iterations, "el.-iter.")]
        public void ScalarSweep() => _wire.Advance(1);
    }
}
