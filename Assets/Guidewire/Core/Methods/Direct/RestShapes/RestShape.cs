using System;

namespace Guidewire.Core
{
    /// <summary>Brings a scene's rod to its rest shape at time 0. Displacements and turns of the ends are taken in
    /// parts, each solved before the next, so that a rod turned by many turns is wound up and not turned the shorter
    /// way.</summary>
    internal static class RestShape
    {
        private const double LargestTurn = 0.5;    // radians a part
        private const double LargestShift = 0.01;  // of L a part

        /// <summary>Moves the shape to rest.</summary>
        /// <param name="report">Told how the rest shape was found and how good it is.</param>
        /// <returns>Null, or why there is no rest shape.</returns>
        public static string? Find(MaterialScene scene, RodTerms terms, RodShape shape, double tolerance,
            int mostIterations, SolverReport report)
        {
            RodSchedule schedule = scene.Schedule;
            var statics = new RodStatics(terms);
            terms.SetTime(schedule, 0.0);
            bool clamped = scene.Supports.HasDistalJoint;
            int last = shape.ElementCount;
            double turn = clamped ? schedule.DistalTurnAt(0.0) : 0.0;
            Vector3d from = shape.X[0];
            Vector3d startShift = schedule.ProximalPositionAt(0.0) - from;
            Vector3d end = shape.X[last];
            Vector3d endShift = clamped ? schedule.DistalPositionAt(0.0) - end : Vector3d.Zero;
            double shift = Math.Max(endShift.Length, clamped ? startShift.Length : 0.0) / scene.Rod.TotalLength;
            int parts = 1 + (int)Math.Max(Math.Abs(turn) / LargestTurn, shift / LargestShift);
            for (int k = 1; k <= parts; k++)
            {
                // Each part is spread over the rod as an even stretch and an even twist; the solver does the rest.
                for (int i = 0; i <= last; i++)
                {
                    Vector3d a = clamped ? Vector3d.Lerp(startShift, endShift, (double)i / last) : startShift;
                    shape.X[i] += a / parts;
                }
                for (int j = 0; j < last; j++)
                {
                    double share = turn / parts * (j + 0.5) / last;
                    shape.Q[j] = shape.Q[j] * Quaterniond.FromAxisAngle(Vector3d.UnitZ, share);
                }
                schedule.TurnFrames(shape, 0.0, turn * k / parts);
                EquilibriumResult result = statics.Solve(shape, tolerance, mostIterations);
                report.EquilibriumIterations += result.Iterations;
                report.Factorisations += result.Factorisations;
                report.EquilibriumResidual = result.Residual;
                report.SmallestEigenvalue = result.SmallestEigenvalue;
                report.Method = result.Method ?? string.Empty;
                if (!result.Converged)
                {
                    return "no rest shape: " + result.Reason;
                }
            }
            return null;
        }
    }
}
