using System;

namespace Guidewire.Core
{
    /// <summary>Into how many equal parts a step between walls is divided: none moves or turns the proximal end farther
    /// than the range of the barriers.</summary>
    internal static class BarrierRange
    {
        private const int MaxParts = 64;
        private const double LargestTurn = 0.5;   // radians a part
        private const double SmallExcess = 0.01;  // over the longest part without dividing it

        /// <summary>Gives the parts of the next step of dt, s.</summary>
        public static int PartsOf(RodDynamics dynamics, RodSchedule schedule, double dt)
        {
            WallTerms walls = dynamics.Terms.Walls()!;
            double start = dynamics.Time;
            double end = start + dt;
            bool isCarried = walls.Barrier.Fields.Carrier >= 0 && !walls.HoldsStart;
            double move = isCarried ? 0.0 : Vector3d.Distance(
                schedule.Hub.PositionAt(end) - walls.Spring.LagOf(dynamics.Shape), dynamics.Shape.X[0]);
            move = Math.Max(move, schedule.InnerMove(dt));
            double turn = Math.Abs(schedule.Hub.FrameTurnAt(end) - dynamics.ProximalTurn)
                + Math.Abs(schedule.Distal.TurnAt(end) - dynamics.DistalTurn);
            if (schedule.HasMotions)
            {
                turn += schedule.AngleBetween(start, end);
                move = Math.Max(move, Vector3d.Distance(
                    schedule.Distal.PositionAt(start), schedule.Distal.PositionAt(end)));
            }
            // Rounding, and the small distance of node 0 from its support, must not add a part.
            double longest = BarrierDefaults.MaxMove * walls.Barrier.Barrier.Distance;
            double parts = Math.Ceiling(Math.Max(move / longest, turn / LargestTurn) * (1.0 - SmallExcess));
            return (int)Math.Min(Math.Max(parts, 1.0), MaxParts);
        }
    }
}
