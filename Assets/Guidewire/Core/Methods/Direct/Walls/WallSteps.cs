using System;

namespace Guidewire.Core
{
    /// <summary>Steps of a wire between walls: a step that moves or turns the proximal end farther than the range of
    /// the barriers is made in parts, each of which is halved where it has no solution.</summary>
    internal sealed class WallSteps
    {
        private const int MostParts = 64;
        private const double LargestTurn = 0.5;   // radians a part
        private const double SmallExcess = 0.01;  // over the longest part without dividing it

        private readonly RodDynamics _dynamics;
        private readonly RodSchedule _schedule;
        private readonly WallMonitor _monitor;
        private readonly HalvedSteps _halved;
        private readonly double _metres;
        private StageForces _meanForces;
        private readonly double _longestMove;     // m

        /// <summary>For this motion.</summary>
        /// <param name="metres">Of a unit of the walls.</param>
        public WallSteps(RodDynamics dynamics, HalvedSteps halved, RodSchedule schedule, WallMonitor monitor,
            double metres)
        {
            _metres = metres;
            _dynamics = dynamics;
            _schedule = schedule;
            _monitor = monitor;
            _halved = halved;
            halved.PieceDone = () => monitor.AddPart(dynamics.Shape);
            _longestMove = BarrierDefaults.MostMove * dynamics.Terms.Walls()!.Barrier.Barrier.Distance;
        }

        /// <summary>The forces from outside, the means over the last step, where reactions are tracked.</summary>
        public StageForces MeanForces => _meanForces;

        /// <summary>One step.</summary>
        /// <param name="dt">s.</param>
        /// <returns>Null, or why a part has no solution however short; the shape is then not to be used.</returns>
        public string? Step(double dt)
        {
            _meanForces = default;
            _monitor.BeginStep(_dynamics.Shape);
            int parts = Parts(dt);
            for (int k = 0; k < parts; k++)
            {
                string? failure = _halved.Step(dt / parts) ?? FindBuckled();
                if (failure != null)
                {
                    return failure;
                }
                _meanForces.Add(dt / parts / dt, _halved.MeanForces);
            }
            return null;
        }

        private string? FindBuckled()
        {
            RodTerms terms = _dynamics.Terms;
            SheathEnd? sheath = terms.Supports.SheathEnd;
            return sheath == null || !sheath.IsBuckled(_dynamics.Shape.X, terms.Walls()!.Barrier.Walls, _metres) ? null
                : "the wire buckles at the exit of its sheath and would come out through a wall";
        }

        private int Parts(double dt)
        {
            double move = Vector3d.Distance(_schedule.Hub.PositionAt(_dynamics.Time + dt)
                - _dynamics.Terms.Walls()!.Spring.LagOf(_dynamics.Shape), _dynamics.Shape.X[0]);
            move = Math.Max(move, _schedule.InnerMove(dt));
            double turn = Math.Abs(_schedule.Hub.FrameTurnAt(_dynamics.Time + dt) - _dynamics.ProximalTurn)
                + Math.Abs(_schedule.Distal.TurnAt(_dynamics.Time + dt) - _dynamics.DistalTurn);
            if (_schedule.HasMotions)
            {
                double end = _dynamics.Time + dt;
                turn += _schedule.AngleBetween(_dynamics.Time, end);
                move = Math.Max(move, Vector3d.Distance(
                    _schedule.Distal.PositionAt(_dynamics.Time), _schedule.Distal.PositionAt(end)));
            }
            // Rounding, and the small distance of node 0 from its support, must not add a part.
            double parts = Math.Ceiling(Math.Max(move / _longestMove, turn / LargestTurn) * (1.0 - SmallExcess));
            return (int)Math.Min(Math.Max(parts, 1.0), MostParts);
        }
    }
}
