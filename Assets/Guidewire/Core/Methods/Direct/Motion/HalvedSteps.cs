using System;

namespace Guidewire.Core
{
    /// <summary>Steps of a motion that are halved where they have no solution, and those halves again, down to 1/4096:
    /// a snap or a violent release goes far in one step, and where it ends depends on what came between.</summary>
    /// <remarks>A wire that snaps between walls is far from where it was after however short a piece: Newton's method
    /// then descends far, energy falling in every iteration. So there the shortest piece has <see
    /// cref="MoreIterations"/> times as many iterations before it counts as one without a solution.</remarks>
    internal sealed class HalvedSteps
    {
        private const int MostHalvings = 12;
        private const int MoreIterations = 10;    // as a rest shape has

        private readonly RodDynamics _dynamics;
        private readonly StepStart _start;
        private StageForces _meanForces;

        /// <summary>For this motion.</summary>
        public HalvedSteps(RodDynamics dynamics)
        {
            _dynamics = dynamics;
            _start = new StepStart(dynamics.SerializeStep);
        }

        /// <summary>What is told of each piece that is done, or null.</summary>
        public Action? PieceDone { get; set; }

        /// <summary>The forces from outside, the means over the last step, where reactions are tracked.</summary>
        public StageForces MeanForces => _meanForces;

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
            StageForces sum = default;
            while (done < whole)
            {
                double h = length * size / whole;
                _start.Save();
                string? failure = _dynamics.Step(h);
                if (failure != null && size == 1 && _dynamics.WallSolver != null)
                {
                    _start.Restore();
                    failure = StepLong(_dynamics.WallSolver, h);
                }
                if (failure == null)
                {
                    if (size == whole)
                    {
                        sum = _dynamics.Reactions.Mean;
                    }
                    else
                    {
                        sum.Add((double)size / whole, _dynamics.Reactions.Mean);
                    }
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
            _meanForces = sum;
            return null;
        }

        /// <summary>Goes back to where the piece without a solution began.</summary>
        public void Restore()
        {
            _start.Restore();
        }

        /// <summary>Writes or takes over the count.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Halvings = snapshot.Serialize(Halvings);
        }

        // With more iterations.
        private string? StepLong(BarrierNewton newton, double h)
        {
            int most = newton.MostIterations;
            newton.MostIterations = (int)Math.Min((long)MoreIterations * most, int.MaxValue);
            string? failure = _dynamics.Step(h);
            newton.MostIterations = most;
            return failure;
        }
    }
}
