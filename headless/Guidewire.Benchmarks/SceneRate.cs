using Guidewire.Io;
using Newtonsoft.Json.Linq;

namespace Guidewire.Benchmarks
{
    /// <summary>How many times faster than real time the scene of a parameter file runs: its steps, on one core, once
    /// its code is compiled as far as it will be.</summary>
    internal static class SceneRate
    {
        private const int WarmUp = 4;
        private const int Turns = 5;

        /// <summary>Makes the run in turns and prints the median and the best.</summary>
        /// <param name="file">A parameter file.</param>
        public static void Print(string file)
        {
            var rates = new List<double>();
            double first = 0.0;
            double iterations = 0.0;
            for (int k = 0; k < WarmUp + Turns; k++)
            {
                using SimulationSession session = SimulationSession.Open(
                    file, Array.Empty<KeyValuePair<string, JToken>>(), false);
                Simulation run = session.Simulation;
                long start = Stopwatch.GetTimestamp();
                while (run.Outcome == Outcome.Running)
                {
                    run.Step();
                }
                double seconds = (Stopwatch.GetTimestamp() - start) / (double)Stopwatch.Frequency;
                if (run.Outcome != Outcome.Finished || run.Contacts!.Passages > 0)
                {
                    throw new InvalidOperationException(run.Reason);
                }
                double rate = run.Time / seconds;
                first = k == 0 ? rate : first;
                iterations = run.Report()!.WallIterations / run.StepCount;
                if (k >= WarmUp)
                {
                    rates.Add(rate);
                }
            }
            rates.Sort();
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "{0}: {1:0.0} x real time, {2:0.0} at best, {3:0.0} in a process that has just begun; {4:0.0} Newton"
                + " iterations a step", Path.GetFileName(file), rates[Turns / 2], rates[Turns - 1], first,
                iterations));
        }
    }
}
