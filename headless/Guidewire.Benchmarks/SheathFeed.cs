namespace Guidewire.Benchmarks
{
    /// <summary>A nitinol wire of 0.36 mm in elements of 5 mm, fed into <see cref="ArchWalls"/>: 1.8 m of it from a
    /// sheath, or the last 200 mm alone, whose tip does the same.</summary>
    internal sealed class SheathFeed
    {
        private const double Element = 5.0;       // mm
        private const double Body = 200.0;        // mm in the body while it goes to and fro
        private const double Whole = 1800.0;      // mm
        private const double Depth = 60.0;          // mm, into the arch
        private const double Amplitude = 10.0;    // mm, to and fro
        private const double Early = 0.1;         // of an element, by which it is simulated before it is out
        private const int Rounds = 9;
        private const int Swings = 4;

        private static readonly int InsertionSteps = (int)Math.Round(1e-3 * Depth / (FedWire.Speed * FedWire.TimeStep));
        private static readonly int SwingSteps = (int)Math.Round(4e-3 * Amplitude / (FedWire.Speed * FedWire.TimeStep));

        private readonly Simulation _run;
        private readonly int _nodes;
        private int _nodesOutside;

        private SheathFeed(ContactShape wall, bool isSheathed)
        {
            double length = isSheathed ? Whole : Body;
            double depth = 1e-3 * Depth;
            var times = new List<double> { 0.0, depth / FedWire.Speed };
            var insertions = new List<double> { 0.0, depth };
            for (int k = 0; k < 2 * Swings; k++)
            {
                times.Add(times[times.Count - 1] + (k == 0 ? 1e-3 : 2e-3) * Amplitude / FedWire.Speed);
                insertions.Add(depth + (k % 2 == 0 ? 1e-3 : -1e-3) * Amplitude);
            }
            SimulationParameters parameters = FedWire.Parameters(length, (int)Math.Round(length / Element), wall,
                InsertionSteps + Swings * SwingSteps);
            parameters.Scene.Sheath = isSheathed ? new Sheath { Exit = new Vector3d(0.0, 0.0, Depth - Body) } : null;
            parameters.Drive.Table = new DriveTable(new TimeTable(times.ToArray(), insertions.ToArray()),
                new TimeTable(new[] { 0.0 }, new[] { 0.0 }));
            _run = Simulation.Create(parameters);
            _nodes = _run.State.SphereCount;
        }

        /// <summary>Times both in turns, step by step, and prints what the sheath costs and what a step in which an
        /// element comes in.</summary>
        public static void Print()
        {
            foreach ((string name, ContactShape wall) in new (string, ContactShape)[]
            {
                ("a tube", ArchWalls.Tube()), ("a mesh of 50,000", ArchWalls.Mesh()),
            })
            {
                Print(name, wall);
            }
        }

        // Every round makes the same steps: of each the shortest counts, which nothing else has interrupted.
        private static void Print(string name, ContactShape wall)
        {
            int steps = InsertionSteps + Swings * SwingSteps;
            var one = new double[steps];
            var other = new double[steps];
            var enters = new bool[steps];
            long garbage = 0;
            long usual = 0;
            Array.Fill(one, double.PositiveInfinity);
            Array.Fill(other, double.PositiveInfinity);
            for (int round = 0; round < Rounds; round++)
            {
                var sheathed = new SheathFeed(wall, true);
                var alone = new SheathFeed(wall, false);
                for (int k = 0; k < steps; k++)
                {
                    enters[k] = sheathed.Enters() && k > 0;
                    long before = GC.GetAllocatedBytesForCurrentThread();
                    one[k] = Math.Min(one[k], FedWire.Step(sheathed._run, true));
                    long left = GC.GetAllocatedBytesForCurrentThread() - before;
                    other[k] = Math.Min(other[k], FedWire.Step(alone._run, true));
                    bool counts = round > 0 && k > 0 && k < InsertionSteps;
                    garbage = counts && enters[k] ? Math.Max(garbage, left) : garbage;
                    usual = counts && !enters[k] ? Math.Max(usual, left) : usual;
                }
            }
            var entries = new List<double>();
            var others = new List<double>();
            for (int k = 1; k < InsertionSteps; k++)
            {
                (enters[k] ? entries : others).Add(one[k]);
            }
            double median = Median(others);
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "a wire of 1.8 m of which 200 mm are out of a sheath, {0}: {1:0.00} of what a wire of 200 mm costs, in"
                + " turns ({2:0} and {3:0} us a step, the hub read off); a step in which an element comes in {4:0} us,"
                + " {5:0.00} of the median of the others, at most {6:0.00}; it leaves {7} B, others {8} B", name,
                Mean(one) / Mean(other), Mean(one), Mean(other), Median(entries), Median(entries) / median,
                entries[entries.Count - 1] / median, garbage, usual));
        }

        // Of the steps to and fro.
        private static double Mean(double[] times)
        {
            double sum = 0.0;
            for (int k = InsertionSteps; k < times.Length; k++)
            {
                sum += times[k];
            }
            return sum / (times.Length - InsertionSteps);
        }

        // Whether the next step begins with one more element.
        private bool Enters()
        {
            int outside = 0;
            for (int i = 0; i < _nodes; i++)
            {
                outside += _run.State.Positions[i].Z >= Depth - Body - Early * Element ? 1 : 0;
            }
            bool enters = outside > _nodesOutside;
            _nodesOutside = outside;
            return enters;
        }

        private static double Median(List<double> values)
        {
            values.Sort();
            return values[values.Count / 2];
        }
    }
}
