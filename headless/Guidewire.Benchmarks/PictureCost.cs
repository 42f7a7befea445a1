using Guidewire.Io;
using Newtonsoft.Json.Linq;

namespace Guidewire.Benchmarks
{
    /// <summary>What a fluoroscopic picture of a scene costs, in processor time of this thread's process, and against
    /// the steps of the scene.</summary>
    internal static class PictureCost
    {
        private const int Steps = 150;
        private const int Pictures = 2000;

        /// <summary>Makes steps, then takes pictures from one place, and prints both.</summary>
        /// <param name="file">A parameter file.</param>
        public static void Print(string file)
        {
            using SimulationSession session = SimulationSession.Open(
                file, Array.Empty<KeyValuePair<string, JToken>>(), false);
            Simulation run = session.Simulation;
            TimeSpan before = Processor();
            while (run.Outcome == Outcome.Running && run.StepCount < Steps)
            {
                run.Step();
            }
            double step = (Processor() - before).TotalMilliseconds / Math.Max(1, run.StepCount);
            var pictures = new RunPictures(session.Parameters);
            var centrelines = new List<Vector3d[]>(run.Centrelines());
            foreach ((int pixels, bool hasNoise) in new[] { (128, false), (256, false), (256, true), (512, true) })
            {
                var view = new PictureView { Pixels = pixels };
                view.Settings.Noise = hasNoise ? 0.03 : 0.0;
                view.Settings.Blur = hasNoise ? 0.3 : 0.0;
                var grey = new byte[pixels * pixels];
                TimeSpan start = default;
                for (int k = -Pictures / 2; k < Pictures; k++)
                {
                    start = k == 0 ? Processor() : start;
                    view.Settings.Seed = (uint)Math.Max(k, 0);
                    pictures.Draw(centrelines, view, grey);
                }
                double each = (Processor() - start).TotalMilliseconds / Pictures;
                Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                    "{0}, {1} x {1}{2}: {3:0.000} ms of a processor, {4:0} a second; {5:0.00} of a step ({6:0.00} ms)",
                    Path.GetFileName(file), pixels, hasNoise ? " with noise and blur" : "", each, 1e3 / each,
                        each / step,
                    step));
            }
        }

        private static TimeSpan Processor()
        {
            using var self = Process.GetCurrentProcess();
            return self.TotalProcessorTime;
        }
    }
}
