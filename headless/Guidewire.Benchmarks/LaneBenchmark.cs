namespace Guidewire.Benchmarks
{
    /// <summary>Steps whose sweeps run in the lanes of a vector register against the same steps with scalar sweeps, in
    /// turns: two runs of one wire that stay equal bit for bit, so that both do the same work.</summary>
    internal static class LaneBenchmark
    {
        private static readonly int[] Lanes = { 4, 8 };
        private static readonly double[] Limits = { 0.38, 0.27 };    // of the scalar time, m = 500
        private static readonly int[] LimitElements = { 30, 300 };
        private static readonly int[] LimitIterations = { 4, 10, 50, 500 };
        private static readonly int[] Elements = { 1, 2, 3, 5, 8, 12, 16, 24, 30, 60, 300, 1000, 10000 };
        private static readonly int[] Iterations = { 1, 2, 3, 4, 5, 8, 10, 16, 20, 50, 500 };
        private const double SlowerLimit = 1.05;
        private const int MinWork = 15000;       // element-iterations timed at a time
        private const int MaxWork = 600000;

        /// <summary>Prints what the lanes gain, what filling them costs at few iterations, and where the choice between
        /// them and the scalar sweeps loses most.</summary>
        public static void Print()
        {
            foreach (int n in LimitElements)
            {
                foreach (int m in LimitIterations)
                {
                    string line = string.Empty;
                    for (int k = 0; k < Lanes.Length; k++)
                    {
                        line += Cell(n, m, Lanes[k], m == 500 ? Limits[k] : (double?)null);
                    }
                    Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                        "step in lanes (n = {0}, m = {1}), ns an element-iteration, best of many in turns:{2}",
                        n, m, line));
                }
            }
            PrintChoice();
        }

        private static string Cell(int n, int m, int lanes, double? limit)
        {
            var inLanes = new SteppedWire(n, m, scalar => IterationChoice.WithLanes(scalar, lanes));
            if (inLanes.Sweeps == null)
            {
                return " no " + lanes + " lanes here;";
            }
            Interleaved both = InTurns(n, m, inLanes);
            double work = (double)n * m * Repeats(n, m);
            return string.Format(CultureInfo.InvariantCulture, " {0} lanes {1:0.0} of {2:0.0} ({3:0.000}{4});", lanes,
                both.FirstBest / work, both.SecondBest / work, both.FirstBest / both.SecondBest,
                limit == null ? string.Empty : ", limit " + limit.Value.ToString(CultureInfo.InvariantCulture));
        }

        private static void PrintChoice()
        {
            double worst = 0.0;
            string where = "nowhere";
            int chosen = 0;
            foreach (int n in Elements)
            {
                foreach (int m in Iterations)
                {
                    var fastest = new SteppedWire(n, m, scalar => IterationChoice.Fastest(scalar, m));
                    if (fastest.Sweeps is ScalarIterations || (double)n * m > MaxWork)
                    {
                        continue;
                    }
                    chosen++;
                    Interleaved both = InTurns(n, m, fastest);
                    double ratio = both.FirstBest / both.SecondBest;
                    if (ratio > worst)
                    {
                        worst = ratio;
                        where = "n = " + n + ", m = " + m;
                    }
                }
            }
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "step in lanes: chosen in {0} of {1} pairs of n and m from 1, and then at most {2:0.000} of the scalar"
                + " step's time ({3}; limit {4})",
                chosen, Elements.Length * Iterations.Length, worst, where, SlowerLimit));
        }

        private static Interleaved InTurns(int n, int m, SteppedWire inLanes)
        {
            var one = new SteppedWire(n, m, scalar => scalar);
            int repeats = Repeats(n, m);
            return new Interleaved(() => inLanes.Advance(repeats), () => one.Advance(repeats));
        }

        private static int Repeats(int n, int m) => Math.Max(1, MinWork / (n * m));
    }
}
