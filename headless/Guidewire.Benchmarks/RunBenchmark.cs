using BenchmarkDotNet.Attributes;

namespace Guidewire.Benchmarks
{
    /// <summary>Whole runs of Core without a log: linear in the number of steps.</summary>
    public class RunBenchmark
    {
        /// <summary>Steps of the run.</summary>
        [Params(1000, 10000)]
        public int Steps { get; set; }

        [Benchmark]
        [Work(30.0 * 10.0, "el.-iter.")]
        public int Run()
        {
            Simulation simulation = Scenes.Transversal(30, 10);
            for (int step = 0; step < Steps; step++)
            {
                simulation.Step();
            }
            return simulation.StepCount;
        }
    }
}
