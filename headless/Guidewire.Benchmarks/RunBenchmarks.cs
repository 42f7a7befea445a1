using BenchmarkDotNet.Attributes;
using Guidewire.Io;

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

    /// <summary>What the log adds to a default step: 31 spheres with positions and velocities that use all digits.
    /// </summary>
    public class LogBenchmark : IDisposable
    {
        private Simulation _simulation = null!;
        private const long LargestFile = 1 << 24;     // bytes; it is written over from there on

        private DataLogger _logger = null!;
        private FileStream _file = null!;

        [GlobalSetup]
        public void Setup()
        {
            _simulation = Scenes.Transversal(30, 500);
            for (int step = 0; step < 20; step++)
            {
                _simulation.Step();
            }
            _file = new FileStream(Path.GetTempFileName(), FileMode.Create, FileAccess.Write, FileShare.Read, 1,
                FileOptions.DeleteOnClose);
            _logger = new DataLogger(_file, new RunParameters(Solver.Pbd));
        }

        [Benchmark]
        [Work(1.0, "step")]
        public void Log()
        {
            _logger.Log(_simulation, 0.123);
            if (_file.Position > LargestFile)
            {
                _file.Position = 0;
            }
        }

        [Benchmark]
        [Work(1.0, "step")]
        public void DefaultStep() => _simulation.Step();

        [GlobalCleanup]
        public void Dispose()
        {
            _logger.Dispose();
            GC.SuppressFinalize(this);
        }
    }
}
