namespace Guidewire.Benchmarks
{
    /// <summary>A nitinol wire of 300 mm and 0.36 mm in 60 elements, fed into <see cref="ArchWalls"/>: in a catheter
    /// over its first half, whose hub goes with it, or alone.</summary>
    internal sealed class CoaxialFeed
    {
        private const double Length = 300.0;      // mm
        private const double Insertion = 100.0;   // mm
        public const int Elements = 60;
        private const int Rounds = 7;

        private static readonly int Steps = (int)Math.Round(1e-3 * Insertion / (FedWire.Speed * FedWire.TimeStep));

        private readonly Simulation _run;

        private CoaxialFeed(bool hasCatheter)
        {
            _run = Simulation.Create(Parameters(hasCatheter ? Elements / 2 : 0));
        }

        /// <summary>Of the wire in a catheter over so many of its elements; 0: alone.</summary>
        public static SimulationParameters Parameters(int covered)
        {
            SimulationParameters parameters = FedWire.Parameters(Length, Elements, ArchWalls.Tube(), Steps);
            parameters.Drive.InsertionSpeed = FedWire.Speed;
            if (covered > 0)
            {
                var drive = new DriveParameters
                {
                    Kind = Drive.Displace, Displacement = 0.0, InsertionSpeed = FedWire.Speed,
                };
                var catheter = new Catheter { Length = Length * covered / Elements, Elements = covered, Drive = drive };
                catheter.Material.WireRadius = 0.4e-3;
                catheter.Material.InnerRadius = 0.25e-3;
                catheter.Material.YoungsModulus = 1e9;
                catheter.Material.ShearModulus = 0.4e9;
                catheter.Material.Density = 1200.0;
                parameters.Scene.Catheters = new[] { catheter };
            }
            return parameters;
        }

        /// <summary>Times both in turns, step by step, and prints what the catheter costs.</summary>
        public static void Print()
        {
            var one = new double[Steps];
            var other = new double[Steps];
            double iterations = 0.0;
            double iterationsAlone = 0.0;
            long garbage = 0;
            Array.Fill(one, double.PositiveInfinity);
            Array.Fill(other, double.PositiveInfinity);
            for (int round = 0; round < Rounds; round++)
            {
                var both = new CoaxialFeed(true);
                var alone = new CoaxialFeed(false);
                for (int k = 0; k < Steps; k++)
                {
                    // Every round makes the same steps: the shortest counts, which nothing else has interrupted.
                    long before = GC.GetAllocatedBytesForCurrentThread();
                    one[k] = Math.Min(one[k], FedWire.Step(both._run, false));
                    garbage = round > 0 && k > 0
                        ? Math.Max(garbage, GC.GetAllocatedBytesForCurrentThread() - before) : garbage;
                    other[k] = Math.Min(other[k], FedWire.Step(alone._run, false));
                }
                iterations = both._run.Report()!.WallIterations / Steps;
                iterationsAlone = alone._run.Report()!.WallIterations / Steps;
            }
            double ratio = Sum(one) / Sum(other);
            Array.Sort(one);
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "a wire of 60 elements in a catheter over half of them, a tube: {0:0.00} of what the wire costs alone,"
                + " in turns ({1:0} and {2:0} us a step; {3:0.0} and {4:0.0} Newton iterations, so {5:0.00} an"
                + " iteration); 99 of 100 steps below {6:0} us; a step leaves at most {7} B", ratio, Sum(one) / Steps,
                Sum(other) / Steps, iterations, iterationsAlone, ratio * iterationsAlone / iterations,
                one[Steps * 99 / 100], garbage));
        }

        private static double Sum(double[] times)
        {
            double sum = 0.0;
            foreach (double time in times)
            {
                sum += time;
            }
            return sum;
        }
    }
}
