namespace Guidewire.Benchmarks
{
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
