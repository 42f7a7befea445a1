using System;

namespace Guidewire.Core
{
    /// <summary>Steps of a wire between walls: a step that moves or turns the proximal end farther than the barriers
    /// reach is made in parts, and a part that has no solution is halved, a bounded number of times.</summary>
    internal sealed class WallSteps
    {
        private const int MostHalvings = 8;
        private const int MostParts = 64;
        private const double LargestTurn = 0.5;   // radians a part
        private const double SmallExcess = 0.01;  // over the longest part that does not make two of it

        private readonly RodDynamics _dynamics;
        private readonly RodSchedule _schedule;
        private readonly WallWatch _watch;
        private readonly StepStart _start;
        private StageForces _meanForces;
        private readonly double _longestMove;     // m

        /// <summary>For this motion.</summary>
        public WallSteps(RodDynamics dynamics, RodSchedule schedule, WallWatch watch)
        {
            _dynamics = dynamics;
            _schedule = schedule;
            _watch = watch;
            _start = new StepStart(dynamics.ExchangeStep);
            _longestMove = BarrierRule.MostMove * dynamics.Terms.Walls!.Barrier.Barrier.Distance;
        }

        /// <summary>The forces from outside, the means over the last step, where reactions are tracked.</summary>
        public StageForces MeanForces => _meanForces;

        /// <summary>Parts that were halved so far.</summary>
        public long Halvings { get; private set; }

        /// <summary>One step.</summary>
        /// <param name="dt">s.</param>
        /// <returns>Null, or why a part has no solution however short; the shape is then not to be used.</returns>
        public string? Step(double dt)
        {
            _meanForces = default;
            _watch.BeginStep(_dynamics.Shape);
            int parts = Parts(dt);
            for (int k = 0; k < parts; k++)
            {
                string? failure = StepPart(dt / parts, dt);
                if (failure != null)
                {
                    return failure;
                }
            }
            return null;
        }

        /// <summary>Writes or takes over the counts.</summary>
        public void Exchange(Snapshot snapshot)
        {
            Halvings = snapshot.Exchange(Halvings);
            _watch.Exchange(snapshot);
        }

        private int Parts(double dt)
        {
            double move = Vector3d.Distance(_schedule.ProximalPositionAt(_dynamics.Time + dt)
                - _dynamics.Terms.Walls!.Spring.LagOf(_dynamics.Shape), _dynamics.Shape.X[0]);
            double turn = Math.Abs(_schedule.FrameTurnAt(_dynamics.Time + dt) - _dynamics.ProximalTurn)
                + Math.Abs(_schedule.DistalTurnAt(_dynamics.Time + dt) - _dynamics.DistalTurn);
            // Rounding, and the little that node 0 is off its support, must not make a part more.
            double parts = Math.Ceiling(Math.Max(move / _longestMove, turn / LargestTurn) * (1.0 - SmallExcess));
            return (int)Math.Min(Math.Max(parts, 1.0), MostParts);
        }

        private string? StepPart(double length, double dt)
        {
            const int whole = 1 << MostHalvings;
            int done = 0;
            int size = whole;
            while (done < whole)
            {
                double h = length * size / whole;
                _start.Save();
                string? failure = _dynamics.Step(h);
                if (failure == null)
                {
                    _meanForces.Add(h / dt, _dynamics.MeanForces);
                    _watch.AddPart(_dynamics.Shape);
                    done += size;
                    // Longer again where the parts done make up whole ones.
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
            return null;
        }
    }
}
