using System.Reflection;
using BenchmarkDotNet.Reports;

namespace Guidewire.Benchmarks
{
    /// <summary>One line of the table.</summary>
    internal sealed class Row
    {
        private Row(string name, string unit)
        {
            Name = name;
            Unit = unit;
        }

        /// <summary>What was measured, with its parameters.</summary>
        public string Name { get; }

        /// <summary>The unit of work that <see cref="PerUnit"/> counts.</summary>
        public string Unit { get; }

        /// <summary>False where the benchmark did not run.</summary>
        public bool Measured { get; private set; }

        /// <summary>Median time of one call in ns.</summary>
        public double Median { get; private set; }

        /// <summary>Median time of one unit of work in ns.</summary>
        public double PerUnit { get; private set; }

        /// <summary>Interquartile range over median, in percent.</summary>
        public double Spread { get; private set; }

        /// <summary>Bytes allocated by one call.</summary>
        public long Allocated { get; private set; }

        /// <summary>The row of a report; the work of a call is what the benchmark's own attribute and parameters say.
        /// </summary>
        public static Row From(BenchmarkReport report)
        {
            MethodInfo method = report.BenchmarkCase.Descriptor.WorkloadMethod;
            WorkAttribute work = method.GetCustomAttribute<WorkAttribute>()!;
            string parameters = report.BenchmarkCase.Parameters.DisplayInfo;
            var row = new Row((method.Name + " " + parameters).Trim(), work.Unit);
            if (report.ResultStatistics == null)
            {
                return row;
            }
            double units = work.Count;
            foreach (var parameter in report.BenchmarkCase.Parameters.Items)
            {
                units *= System.Convert.ToDouble(parameter.Value, CultureInfo.InvariantCulture);
            }
            row.Measured = true;
            row.Median = report.ResultStatistics.Median;
            row.PerUnit = row.Median / units;
            row.Spread = 100.0 * report.ResultStatistics.InterquartileRange / row.Median;
            row.Allocated = report.GcStats.GetBytesAllocatedPerOperation(report.BenchmarkCase) ?? 0;
            return row;
        }
    }

    /// <summary>How much work one call of a benchmark does: a number times the product of its parameters.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    internal sealed class WorkAttribute : Attribute
    {
        /// <param name="count">The number.</param>
        /// <param name="unit">What it counts.</param>
        public WorkAttribute(double count, string unit)
        {
            Count = count;
            Unit = unit;
        }

        /// <summary>The number.</summary>
        public double Count { get; }

        /// <summary>What it counts.</summary>
        public string Unit { get; }
    }
}
