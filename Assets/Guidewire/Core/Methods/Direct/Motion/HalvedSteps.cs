using System;

namespace Guidewire.Core
{
    /// <summary>Steps of a motion that are halved where they have no solution, and those halves again, down to 1/4096:
    /// a snap or a violent release goes far in one step, and where it ends depends on what came between.</summary>
    internal sealed class HalvedSteps
    {
        private const int MostHalvings = 12;

        private readonly RodDynamics _dynamics;
        private readonly StepStart _start;

        /// <summary>For this motion.</summary>
        public HalvedSteps(RodDynamics dynamics)
        {
            _dynamics = dynamics;
            _start = new StepStart(dynamics.ExchangeStep);
        }

        /// <summary>What is told of each piece that is done, or null.</summary>
        public Action? PieceDone { get; set; }

        /// <summary>Force of the proximal support, N, the mean over the last step, where reactions are
        /// tracked.</summary>
        public Vector3d MeanReaction { get; private set; }

        /// <summary>Pieces that were halved so far.</summary>
        public long Halvings { get; private set; }

        /// <summary>One step.</summary>
        /// <param name="length">s.</param>
        /// <returns>Null, or why a piece has no solution however short; the shape is then not to be used.</returns>
        public string? Step(double length)
        {
            const int whole = 1 << MostHalvings;
            int done = 0;
            int size = whole;
            Vector3d sum = Vector3d.Zero;
            while (done < whole)
            {
                _start.Save();
                string? failure = _dynamics.Step(length * size / whole);
                if (failure == null)
                {
                    Vector3d reaction = _dynamics.MeanReaction;
                    sum = size == whole ? reaction : sum + ((double)size / whole) * reaction;
                    PieceDone?.Invoke();
                    done += size;
                    // Longer again where the pieces done make up whole ones.
                    size = size < whole && done % (2 * size) == 0 ? 2 * size : size;
                    continue;
                }
                if (size == 1)
                {
                    return failure;
                }
                _start.Restore();
                Halvings++;
                size /= 2;
            }
            MeanReaction = sum;
            return null;
        }

        /// <summary>Writes or takes over the count.</summary>
        public void Exchange(Snapshot snapshot)
        {
            Halvings = snapshot.Exchange(Halvings);
        }
    }
}
