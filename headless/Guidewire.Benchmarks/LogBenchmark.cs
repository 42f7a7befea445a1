using BenchmarkDotNet.Attributes;
using Guidewire.Io;

namespace Guidewire.Benchmarks
{
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
