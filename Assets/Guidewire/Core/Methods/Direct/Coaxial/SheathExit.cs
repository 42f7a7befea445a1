using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>The exit of a sheath, and the check of its position.</summary>
    internal static class SheathExit
    {
        private const double Rounding = 1e-6;   // of the wire's length, and of a direction

        /// <summary>The exit, m.</summary>
        /// <exception cref="ArgumentException">One from which the wire cannot be fed into the vessel.</exception>
        public static Vector3d Find(Sheath sheath, MaterialScene whole) =>
            whole.ExitOfSheath ?? whole.Metres * FindInUnits(sheath, whole);

        private static Vector3d FindInUnits(Sheath sheath, MaterialScene whole)
        {
            double units = 1.0 / whole.Metres;
            Vector3d axis = whole.Schedule.Hub.Frame.Director3;
            Vector3d start = units * whole.Shape.X[0];
            int n = whole.Shape.ElementCount;
            double length = units * whole.Rod.TotalLength;
            if (sheath.Direction is Vector3d direction)
            {
                double along = Vector3d.Dot(Vector3d.Normalize(direction), axis);
                if (!(along > 1.0 - Rounding))
                {
                    throw new ArgumentException("sheath: its direction " + (along < 0.0
                        ? "points out of the vessel, against that of the wire, " : "is not that of the wire, ")
                        + Text(axis));
                }
            }
            if (!(sheath.Exit is Vector3d exit))
            {
                return Inlet(whole);
            }
            if (whole.IsReached)
            {
                return exit;    // that of the start: under loads the hub's node gives way by the clamp's compliance
            }
            Vector3d from = exit - start;
            double reached = Vector3d.Dot(from, axis);
            if (!((from - reached * axis).Length <= Rounding * length))
            {
                throw new ArgumentException(string.Format(CultureInfo.InvariantCulture,
                    "sheath: its exit is {0:G4} units off the wire's axis, which goes through {1} along {2}",
                    (from - reached * axis).Length, Text(start), Text(axis)));
            }
            double tip = Vector3d.Dot(units * whole.Shape.X[n] - start, axis);
            if (reached < 0.0 || reached > tip)
            {
                throw new ArgumentException(string.Format(CultureInfo.InvariantCulture,
                    "sheath: its exit has to be on the wire at its start, from {0} to {1}", Text(start),
                    Text(start + tip * axis)));
            }
            return start + reached * axis;
        }

        /// <summary>What is wrong with the start of a wire in a sheath, in one phrase, or null.</summary>
        public static string? FindProblem(SimulationParameters parameters, MaterialScene whole)
        {
            double units = 1.0 / whole.Metres;
            Vector3d exit;
            try
            {
                exit = whole.ExitOfSheath is Vector3d known ? units * known
                    : FindInUnits(parameters.Scene.Sheath!, whole);
            }
            catch (ArgumentException error)
            {
                return error.Message;
            }
            Vector3d axis = whole.Schedule.Hub.Frame.Director3;
            int first = 0;
            while (first < whole.Shape.ElementCount - 1
                && Vector3d.Dot(units * whole.Shape.X[first + 1] - exit, axis) <= 0.0)
            {
                first++;
            }
            string? problem = MaterialStart.FindProblemFrom(whole, first, exit);
            if (problem != null)
            {
                return problem + "; the sheath ends at " + Text(exit)
                    + ", and the wire from there on has to be inside the vessel";
            }
            double available = whole.Metres * Vector3d.Dot(exit - units * whole.Shape.X[0], axis);
            double asked = (parameters.Scene.Start?.Hub?.Insertion ?? 0.0) + parameters.Drive.LargestInsertion(
                parameters.Method.MaxSimulationSteps * parameters.Method.TimeStep);
            return asked <= available * (1.0 + Rounding) ? null : string.Format(CultureInfo.InvariantCulture,
                "sheath: an insertion of {0:G4} m is longer than the wire: {1:G4} m of it are in the sheath", asked,
                available);
        }

        // One element inside the first node from which on the wire is free of the walls.
        private static Vector3d Inlet(MaterialScene whole)
        {
            int n = whole.Shape.ElementCount;
            int first = n;
            while (first > 0 && IsWithin(whole, first - 1)
                && MaterialStart.FindProblem(whole, first - 1, first) == null)
            {
                first--;
            }
            if (first >= n)
            {
                throw new ArgumentException("sheath: the wire's last element starts outside the vessel, at "
                    + Text((1.0 / whole.Metres) * whole.Shape.X[n]) + ": name an exit, or let the tip start inside");
            }
            return (1.0 / whole.Metres) * whole.Shape.X[first + 1];
        }

        private static bool IsWithin(MaterialScene whole, int node)
        {
            Vector3d position = (1.0 / whole.Metres) * whole.Shape.X[node];
            return Array.TrueForAll(whole.Walls, wall => wall.IsWithin(position));
        }

        private static string Text(in Vector3d v) =>
            string.Format(CultureInfo.InvariantCulture, "[{0:G6}, {1:G6}, {2:G6}]", v.X, v.Y, v.Z);
    }
}
