using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using BenchmarkDotNet.Columns;
using BenchmarkDotNet.Configs;
using BenchmarkDotNet.Jobs;
using BenchmarkDotNet.Loggers;
using BenchmarkDotNet.Reports;
using BenchmarkDotNet.Running;
using BenchmarkDotNet.Toolchains.InProcess.Emit;

namespace Guidewire.Benchmarks
{
    /// <summary>Prints what a step costs, part by part, in nanoseconds per unit of work and as ratios to the sweep at
    /// n = 30, all measured in this one process, because machines differ and are shared.</summary>
    internal static class Program
    {
        private static readonly Type[] Families =
        {
            typeof(SweepBenchmark), typeof(RunBenchmark), typeof(LogBenchmark), typeof(DetectionBenchmark),
        };

        private static int Main(string[] arguments)
        {
            IConfig config = ManualConfig.CreateEmpty()
                .AddJob(Job.Default.WithToolchain(InProcessEmitToolchain.Instance)
                    .WithWarmupCount(3).WithIterationCount(9).WithIterationTime(Perfolizer.Horology.TimeInterval.FromMilliseconds(200)))
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
            return rows.All(row => row.Measured) ? 0 : 1;
        }

        private static void Print(List<Row> rows)
        {
            double sweep = rows.First(row => row.Name.StartsWith("Sweep", StringComparison.Ordinal)).PerUnit;
            Console.WriteLine("{0,-46} {1,12} {2,24} {3,9} {4,8} {5,12}", "what", "median", "per unit", "spread", "ratio",
                "allocated");
            foreach (Row row in rows)
            {
                Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                    "{0,-46} {1,9:0.0} us {2,9:0.0} ns / {3,-10} {4,7:0.0} % {5,8:0.00} {6,10} B", row.Name, 1e-3 * row.Median,
                    row.PerUnit, row.Unit, row.Spread, row.PerUnit / sweep, row.Allocated));
            }
            Console.WriteLine("ratio: to the time of one element-iteration (stretch and bend-twist) at n = 30. Spread: interquartile"
                + " range over median.");
        }
    }
}
