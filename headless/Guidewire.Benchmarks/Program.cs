using System.Linq;
using BenchmarkDotNet.Columns;
using BenchmarkDotNet.Configs;
using BenchmarkDotNet.Jobs;
using BenchmarkDotNet.Loggers;
using BenchmarkDotNet.Reports;
using BenchmarkDotNet.Running;
using BenchmarkDotNet.Toolchains.InProcess.Emit;
using Guidewire.Cli;

namespace Guidewire.Benchmarks
{
    /// <summary>Prints what a step costs, part by part, in nanoseconds per unit of work and as ratios to the scalar
    /// sweep at n = 30, all measured in this one process, because machines differ and are shared.</summary>
    internal static class Program
    {
        private const int SweepsATurn = 300;

        private static readonly Type[] Families =
        {
            typeof(ScalarBenchmark), typeof(SweepBenchmark), typeof(RunBenchmark), typeof(LogBenchmark),
            typeof(DetectionBenchmark), typeof(NewtonBenchmark), typeof(CantileverBenchmark),
        };

        private static int Main(string[] arguments)
        {
            if (arguments.Contains("--arch"))
            {
                PrintArch();
                return 0;
            }
            if (arguments.Contains("--newton"))
            {
                NewtonParts.Print();
                return 0;
            }
            if (arguments.Contains("--sheath"))
            {
                SheathFeed.Print();
                PrintScenes(arguments);
                return 0;
            }
            if (arguments.Contains("--coaxial"))
            {
                CoaxialFeed.Print();
                CoaxialParts.Print();
                PrintScenes(arguments);
                return 0;
            }
            if (arguments.Contains("--self"))
            {
                SelfContactCost.Print();
                return 0;
            }
            if (arguments.Contains("--pictures"))
            {
                foreach (string file in arguments.Where(word => word.EndsWith(".json", StringComparison.Ordinal)))
                {
                    PictureCost.Print(file);
                }
                return 0;
            }
            if (arguments.Contains("-lines"))
            {
                return RequestLoop.Serve(Console.In, Console.Out, MotionCost.Measure, () => false);
            }
            IConfig config = ManualConfig.CreateEmpty()
                .AddJob(Job.Default.WithToolchain(InProcessEmitToolchain.Instance)
                    .WithWarmupCount(3).WithIterationCount(9)
                    .WithIterationTime(Perfolizer.Horology.TimeInterval.FromMilliseconds(200)))
                .AddDiagnoser(BenchmarkDotNet.Diagnosers.MemoryDiagnoser.Default)
                .AddColumnProvider(DefaultColumnProviders.Instance)
                .AddLogger(arguments.Contains("--verbose") ? ConsoleLogger.Default : NullLogger.Instance)
                .WithOption(ConfigOptions.DisableLogFile, true);
            var rows = new List<Row>();
            foreach (Type family in Families)
            {
                Summary summary = BenchmarkRunner.Run(family, config);
                foreach (BenchmarkReport report in summary.Reports)
                {
                    rows.Add(Row.From(report));
                }
            }
            Print(rows);
            if (rows.All(row => row.Measured))
            {
                LaneBenchmark.Print();
                PrintNewton();
                NewtonParts.Print();
                PrintCantilever();
                PrintArch();
                SheathFeed.Print();
                CoaxialFeed.Print();
                CoaxialParts.Print();
                PrintScenes(arguments);
            }
            return rows.All(row => row.Measured) ? 0 : 1;
        }

        private static void PrintScenes(string[] arguments)
        {
            foreach (string file in arguments.Where(word => word.EndsWith(".json", StringComparison.Ordinal)))
            {
                SceneRate.Print(file);
            }
        }

        private static void PrintNewton()
        {
            const int Small = 1000;
            const int Large = 100000;
            var small = new NewtonBenchmark { Elements = Small };
            var large = new NewtonBenchmark { Elements = Large };
            small.Setup();
            large.Setup();
            var both = new Interleaved(() => large.Newton(), () => Repeat(Large / Small, () => small.Newton()));
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "Newton iteration: {0:0} ns an element at n = 1000, {1:0} ns at n = 100,000, in turns"
                + " ({2:+0.0;-0.0} %)",
                both.Second / Large, both.First / Large, 100.0 * (both.Ratio - 1.0)));
        }

        /// <summary>The error is that of the motion which is timed, against a fine one; how far that is from one half
        /// as fine bounds its own.</summary>
        private static void PrintCantilever()
        {
            const int Motions = 5;
            double[] timed = FreeCantilever.Tip(FreeCantilever.Elements, FreeCantilever.Scheme,
                FreeCantilever.TimeStep);
            double[] fine = FreeCantilever.Tip(40, Integrator.Esdirk4, 1e-4);
            double[] half = FreeCantilever.Tip(28, Integrator.Esdirk4, 2e-4);
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "free cantilever (n = {0}, {1}, {2:0.###} ms): {3:0.00} % error (reference good to {4:0.000} %)",
                FreeCantilever.Elements, FreeCantilever.Scheme.ToString().ToLowerInvariant(),
                1e3 * FreeCantilever.TimeStep, 100.0 * FreeCantilever.Difference(timed, fine),
                100.0 * FreeCantilever.Difference(half, fine)));

            var cantilever = new FreeCantilever(FreeCantilever.Elements, FreeCantilever.Scheme,
                FreeCantilever.TimeStep);
            var both = new Interleaved(() => Repeat(Motions, () => cantilever.Run(null)), MotionCost.Sweep().Step);
            double milliseconds = Motions * 1e3 * FreeCantilever.Duration;
            double sweeps = MotionCost.ElementIterations;
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "free cantilever: {0:0.00} us per simulated ms = {1:0} element-iterations, in turns (of {2:0.0} ns"
                + " each); {3:0.0000} s per simulated second",
                1e-3 * both.First / milliseconds, both.Ratio * sweeps / milliseconds, both.Second / sweeps,
                1e-6 * both.First / milliseconds));
        }

        /// <summary>Pushes between walls: at three speeds through a tube and a mesh, and a long wire in short
        /// steps.</summary>
        private static void PrintArch()
        {
            foreach (double speed in new[] { 50.0, 200.0, 1000.0 })
            {
                PrintPush("a tube", new ArchPush(ArchWalls.Tube(), 60, speed, 0.01), speed + " mm/s (n = 60, 10 ms)");
            }
            foreach (double speed in new[] { 50.0, 200.0, 1000.0 })
            {
                PrintPush("a mesh of 50,000", new ArchPush(ArchWalls.Mesh(), 60, speed, 0.01),
                    speed + " mm/s (n = 60, 10 ms)");
            }
            PrintLongWire();
        }

        private static void PrintPush(string wall, ArchPush push, string speed)
        {
            const int MinTurns = 8;
            TimeSpan warmUp = TimeSpan.FromSeconds(3.0);
            TimeSpan timed = TimeSpan.FromSeconds(1.0);
            SteppedWire sweep = MotionCost.Sweep();
            double iterations = 0.0;
            TimeSpan begin = Processor();
            while (Processor() - begin < warmUp)
            {
                ArchPush.Finish(push.Start());
                Repeat(SweepsATurn, sweep.Step);
            }
            var one = default(TimeSpan);
            var other = default(TimeSpan);
            double shortest = double.PositiveInfinity;
            double shortestSweep = double.PositiveInfinity;
            int turns = 0;
            for (; turns < MinTurns || one < timed; turns++)
            {
                Simulation run = push.Start();
                TimeSpan start = Processor();
                long begun = Stopwatch.GetTimestamp();
                iterations = ArchPush.Finish(run);
                shortest = Math.Min(shortest, Stopwatch.GetElapsedTime(begun).TotalMilliseconds);
                TimeSpan middle = Processor();
                for (int k = 0; k < SweepsATurn; k++)
                {
                    begun = Stopwatch.GetTimestamp();
                    sweep.Step();
                    shortestSweep = Math.Min(shortestSweep, Stopwatch.GetElapsedTime(begun).TotalMilliseconds);
                }
                one += middle - start;
                other += Processor() - middle;
            }
            double milliseconds = 1e3 * push.Duration * turns;
            double each = other.TotalMilliseconds / (turns * SweepsATurn * MotionCost.ElementIterations);
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "push into an arch, {0}, at {1}: {2:0.0} Newton iterations a step, {3:0.00} us of a processor per"
                + " simulated ms = {4:0} element-iterations, in turns (of {5:0.0} ns each); in the shortest of {6}"
                + " turns {7:0} (of {8:0.0} ns each)", wall, speed, iterations,
                1e3 * one.TotalMilliseconds / milliseconds, one.TotalMilliseconds / milliseconds / each, 1e6 * each,
                turns, shortest * turns / milliseconds / shortestSweep * MotionCost.ElementIterations,
                1e6 * shortestSweep / MotionCost.ElementIterations));
        }

        // What else the machine does takes long pushes more turns than short sweeps: the processor's own time counts.
        private static TimeSpan Processor()
        {
            using var self = Process.GetCurrentProcess();
            return self.TotalProcessorTime;
        }

        /// <summary>512 elements, half of them behind the arch's begin, in steps of 1 ms: single steps, timed one
        /// by one.</summary>
        private static void PrintLongWire()
        {
            const int Before = 2800;
            const int Timed = 200;
            Simulation run = new ArchPush(ArchWalls.Tube(), 512, 50.0, 1e-3).Start();
            while (run.StepCount < Before)
            {
                run.Step();
            }
            SteppedWire sweep = MotionCost.Sweep();
            Repeat(SweepsATurn, sweep.Step);
            var steps = new double[Timed];
            TimeSpan start = Processor();
            for (int k = 0; k < Timed; k++)
            {
                long before = Stopwatch.GetTimestamp();
                run.Step();
                steps[k] = 1e6 * (Stopwatch.GetTimestamp() - before) / Stopwatch.Frequency;
            }
            TimeSpan middle = Processor();
            Repeat(SweepsATurn, sweep.Step);
            double each = (Processor() - middle).TotalMilliseconds / (SweepsATurn * MotionCost.ElementIterations);
            double milliseconds = (middle - start).TotalMilliseconds / Timed;
            Array.Sort(steps);
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "push into an arch, a tube, at 50 mm/s (n = 512, 1 ms): median {0:0} us a step, 99 of 100 below"
                + " {1:0} us; {2:0} us of a processor = {3:0} element-iterations per simulated ms", steps[Timed / 2],
                steps[Timed * 99 / 100], 1e3 * milliseconds, milliseconds / each));
        }

        private static void Repeat(int times, Action work)
        {
            for (int i = 0; i < times; i++)
            {
                work();
            }
        }

        private static void Print(List<Row> rows)
        {
            double sweep = rows.First(row => row.Name.StartsWith("ScalarSweep", StringComparison.Ordinal)).PerUnit;
            Console.WriteLine("{0,-46} {1,12} {2,24} {3,9} {4,8} {5,12}", "what", "median", "per unit", "spread",
                "ratio", "allocated");
            foreach (Row row in rows)
            {
                Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                    "{0,-46} {1,9:0.0} us {2,9:0.0} ns / {3,-10} {4,7:0.0} % {5,8:0.00} {6,10} B", row.Name,
                    1e-3 * row.Median, row.PerUnit, row.Unit, row.Spread, row.PerUnit / sweep, row.Allocated));
            }
            Console.WriteLine("ratio: to the time of one element-iteration"
                + " (stretch and bend-twist) of the scalar sweeps at n"
                + " = 30. Spread: interquartile range over median.");
        }
    }
}
