namespace Guidewire.Benchmarks
{
    /// <summary>Two pieces of work timed in turns, because what else a machine does changes within seconds: the ratio
    /// of neighbours holds where the times themselves do not.</summary>
    internal sealed class Interleaved
    {
        private const int Rounds = 60;
        private const int WarmUp = 5;
        private static readonly TimeSpan Compiling = TimeSpan.FromSeconds(0.4);

        /// <summary>Times both, some 60 times in turns.</summary>
        /// <param name="first">What is measured.</param>
        /// <param name="second">What it is measured against.</param>
        /// <param name="prepare">Made before each turn of the first and not timed; or null.</param>
        public Interleaved(Action first, Action second, Action? prepare = null)
        {
            var ratios = new List<double>();
            var firsts = new List<double>();
            var seconds = new List<double>();
            // Until all of it is compiled: the final compilation begins a tenth of a second after the last new method.
            var watch = Stopwatch.StartNew();
            for (int round = 0; round < WarmUp || watch.Elapsed < Compiling; round++)
            {
                prepare?.Invoke();
                first();
                second();
            }
            for (int round = 0; round < Rounds; round++)
            {
                prepare?.Invoke();
                double a = Time(first);
                double b = Time(second);
                ratios.Add(a / b);
                firsts.Add(a);
                seconds.Add(b);
            }
            Ratio = Median(ratios);
            First = Median(firsts);
            Second = Median(seconds);
            FirstBest = firsts[0];
            SecondBest = seconds[0];
        }

        /// <summary>Median of the first's time over the second's, measured right after it.</summary>
        public double Ratio { get; }

        /// <summary>Median time of the first, ns.</summary>
        public double First { get; }

        /// <summary>Median time of the second, ns.</summary>
        public double Second { get; }

        /// <summary>Shortest time of the first, ns: also where the two differ so much in length that a busy machine
        /// interrupts every call of one and hardly any of the other.</summary>
        public double FirstBest { get; }

        /// <summary>Shortest time of the second, ns.</summary>
        public double SecondBest { get; }

        private static double Time(Action work)
        {
            long start = Stopwatch.GetTimestamp();
            work();
            return 1e9 * (Stopwatch.GetTimestamp() - start) / Stopwatch.Frequency;
        }

        private static double Median(List<double> values)
        {
            values.Sort();
            return values[values.Count / 2];
        }
    }
}
