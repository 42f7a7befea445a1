using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A tube's line of knots with its corners rounded: each becomes an arc that touches the two pieces which
    /// meet there, in parts that turn by half a degree at most.</summary>
    /// <remarks>The arc begins half of the shorter piece before the knot and ends as far behind it: with t that length
    /// and theta the turn, its radius is t/tan(theta/2), and it passes the knot at t tan(theta/4). Knots at equal
    /// distances on a circle of radius R so become one arc, of radius R cos(theta/2).
    ///
    /// A wire's tip that a wall guides with a force P slides along a straight piece and turns at the next: the force on
    /// it varies by P theta about that of a smooth wall, over the length of a piece. Half a degree leaves less than a
    /// hundredth of P.</remarks>
    public static class RoundedCentreline
    {
        private const double LargestTurn = 0.5 * Math.PI / 180.0;
        private const double Fold = 3.0;         // radians; a line that folds back on itself has no arc
        private const double Resolution = 1e-9;  // of the shorter piece

        /// <summary>Replaces corners by arcs.</summary>
        /// <param name="knots">Centreline, units, no two neighbours at the same position.</param>
        /// <param name="radii">Radius at each, units; along an arc it changes evenly from the knot's to both
        /// ends'.</param>
        public static void Round(ref Vector3d[] knots, ref double[] radii)
        {
            var line = new List<Vector3d> { knots[0] };
            var widths = new List<double> { radii[0] };
            for (int k = 1; k + 1 < knots.Length; k++)
            {
                AddCorner(knots, radii, k, line, widths);
            }
            Add(knots[knots.Length - 1], radii[knots.Length - 1], 0.0, line, widths);
            knots = line.ToArray();
            radii = widths.ToArray();
        }

        private static void AddCorner(
            Vector3d[] knots, double[] radii, int k, List<Vector3d> line, List<double> widths)
        {
            double before = Vector3d.Distance(knots[k - 1], knots[k]);
            double after = Vector3d.Distance(knots[k], knots[k + 1]);
            Vector3d along = (1.0 / before) * (knots[k] - knots[k - 1]);
            Vector3d next = (1.0 / after) * (knots[k + 1] - knots[k]);
            double turn = Math.Atan2(Vector3d.Cross(along, next).Length, Vector3d.Dot(along, next));
            if (!(turn > LargestTurn && turn < Fold))
            {
                Add(knots[k], radii[k], 0.0, line, widths);
                return;
            }
            double limit = 0.5 * Math.Min(before, after);
            double radius = limit / Math.Tan(0.5 * turn);
            Vector3d start = knots[k] - limit * along;
            Vector3d inwards = Vector3d.Normalize(next - Math.Cos(turn) * along);
            double atStart = radii[k] + limit / before * (radii[k - 1] - radii[k]);
            double atEnd = radii[k] + limit / after * (radii[k + 1] - radii[k]);
            int parts = 2 * (int)Math.Ceiling(0.5 * turn / LargestTurn);
            for (int i = 0; i <= parts; i++)
            {
                double angle = turn * i / parts;
                double fromKnot = Math.Abs(2.0 * i / parts - 1.0);
                double width = radii[k] + fromKnot * ((2 * i < parts ? atStart : atEnd) - radii[k]);
                Add(start + radius * (Math.Sin(angle) * along + (1.0 - Math.Cos(angle)) * inwards), width,
                    Resolution * limit, line, widths);
            }
        }

        // Where one arc ends in another there is one knot.
        private static void Add(
            in Vector3d knot, double radius, double resolution, List<Vector3d> line, List<double> widths)
        {
            if (Vector3d.Distance(line[line.Count - 1], knot) > resolution)
            {
                line.Add(knot);
                widths.Add(radius);
            }
        }
    }
}
