using System.Diagnostics;

namespace Guidewire.Runtime
{
    /// <summary>Work between two frames, where no thread does it.</summary>
    internal sealed class FrameBudget
    {
        private readonly Stopwatch _clock = new Stopwatch();

        /// <summary>Works until nothing is left, or one of the limits is reached.</summary>
        /// <param name="most">Pieces of work, steps among them.</param>
        /// <param name="milliseconds">Looked at between two pieces: at least one is done.</param>
        public void Work(WireRun run, int most, double milliseconds)
        {
            _clock.Restart();
            int done = 0;
            while (done < most && (done == 0 || _clock.Elapsed.TotalMilliseconds < milliseconds) && run.Work())
            {
                done++;
            }
        }
    }
}
