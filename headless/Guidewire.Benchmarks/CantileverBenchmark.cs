using BenchmarkDotNet.Attributes;

namespace Guidewire.Benchmarks
{
    /// <summary>The free cantilever: 0.2 s of the motion of a clamped wire that is let go from its rest shape under a
    /// tip force F L^2/EI = 0.1, without damping, at the default tolerance.</summary>
    public class CantileverBenchmark
    {
        private FreeCantilever _cantilever = null!;

        [GlobalSetup]
        public void Setup()
        {
            _cantilever = new FreeCantilever(FreeCantilever.Elements, FreeCantilever.Scheme,
                FreeCantilever.TimeStep);
        }

        [Benchmark]
        [Work(1e3 * FreeCantilever.Duration, "sim. ms")]
        public double Release() => _cantilever.Run(null);
    }
}
