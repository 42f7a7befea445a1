using BenchmarkDotNet.Attributes;
using Guidewire.Core;

namespace Guidewire.Benchmarks
{
    /// <summary>The free cantilever: 0.2 s of the motion of a clamped wire that is let go from its rest shape under a
    /// tip force F L^2/EI = 0.1, without damping, at the default tolerance; and beside it,
    /// because the load of a machine changes within a minute, the sweep in which its time is told.</summary>
    public class CantileverBenchmark
    {
        private const int SweepElements = 30;
        private const int SweepIterations = 100;

        private FreeCantilever _cantilever = null!;
        private Simulation _sweep = null!;

        [GlobalSetup]
        public void Setup()
        {
            _cantilever = new FreeCantilever(FreeCantilever.Elements, FreeCantilever.Scheme,
                FreeCantilever.TimeStep);
            _sweep = Scenes.Transversal(SweepElements, SweepIterations);
        }

        [Benchmark]
        [Work(SweepElements * SweepIterations, "el.-iter.")]
        public void SweepBeside()
        {
            _sweep.Step();
        }

        [Benchmark]
        [Work(1e3 * FreeCantilever.Duration, "sim. ms")]
        public double LetGo()
        {
            return _cantilever.Run(null);
        }
    }
}
