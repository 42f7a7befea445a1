namespace Guidewire.Benchmarks
{
    /// <summary>What the parts of a Newton iteration of the direct solver cost, each timed in turns with the scalar
    /// sweep: blocks of every term, elimination, back substitution, the move, and what a line search adds.</summary>
    internal static class NewtonParts
    {
        private const int Calls = 3000;   // elements that one timed call passes, at least

        /// <summary>Prints a table of parts against numbers of elements.</summary>
        public static void Print()
        {
            int[] counts = { 30, 60, 1000 };
            var names = new List<string>();
            var cells = new List<string>();
            double each = 0.0;
            foreach (int n in counts)
            {
                var bench = new NewtonBenchmark { Elements = n };
                bench.Setup();
                int row = 0;
                foreach ((string name, Action part) in bench.Parts())
                {
                    Ratio(part, n, out double ratio, out each);
                    string cell = string.Format(CultureInfo.InvariantCulture, "{0,9:0.0} ({1:0.00})", ratio * each,
                        ratio);
                    if (row == names.Count)
                    {
                        names.Add(name);
                        cells.Add(string.Empty);
                    }
                    cells[row++] += cell;
                }
            }
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "parts of a Newton iteration, ns an element (element-iterations of {0:0.0} ns), n = {1}", each,
                string.Join(", ", counts)));
            for (int row = 0; row < names.Count; row++)
            {
                Console.WriteLine("  {0,-34}{1}", names[row], cells[row]);
            }
        }

        // The shortest times of short calls: a busy machine interrupts some of them, but not all.
        private static void Ratio(Action part, int elements, out double ratio, out double each)
        {
            int calls = Math.Max(1, Calls / elements);
            SteppedWire sweep = MotionCost.Sweep();
            void Repeat()
            {
                for (int k = 0; k < calls; k++)
                {
                    part();
                }
            }
            var both = new Interleaved(Repeat, sweep.Step);
            each = both.SecondBest / MotionCost.ElementIterations;
            ratio = both.FirstBest / (calls * elements) / each;
        }
    }
}
