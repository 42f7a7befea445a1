using BenchmarkDotNet.Attributes;

namespace Guidewire.Benchmarks
{
    /// <summary>One step of the seed's rod after the transversal displacement: linear in n and in m.</summary>
    public class SweepBenchmark
    {
        private Simulation _simulation = null!;

        /// <summary>The number of elements n.</summary>
        [Params(30, 300, 3000, 10000)]
        public int Elements { get; set; }

        /// <summary>The number of iterations m.</summary>
        [Params(10, 100)]
        public int Iterations { get; set; }

        [GlobalSetup]
        public void Setup() => _simulation = Scenes.Transversal(Elements, Iterations);

        [Benchmark]
        [Work(1.0, "el.-iter.")]
        public void Sweep() => _simulation.Step();
    }
}
