using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Where a wire may start: with every element in the lumen and none across a wall.</summary>
    public static class WireStart
    {
        /// <summary>What is wrong with the start that the parameters describe, in one phrase, or null.</summary>
        public static string? Complaint(SimulationParameters parameters)
        {
            if (parameters.Walls.Length == 0)
            {
                return null;
            }
            RodState state = Simulation.StartOf(parameters);
            for (int j = 0; j < state.ElementCount; j++)
            {
                foreach (ContactShape wall in parameters.Walls)
                {
                    int hint = -1;
                    wall.Nearest(state.Positions[j], state.Positions[j + 1], double.PositiveInfinity, ref hint,
                        out SurfaceContact contact);
                    if (!(contact.Distance > 0.0) || !wall.Contains(state.Positions[j])
                        || !wall.Contains(state.Positions[j + 1]))
                    {
                        return string.Format(CultureInfo.InvariantCulture,
                            "the wire starts outside: rod element {0} from {1} to {2} is not on the free side of the"
                            + " wall",
                            j, state.Positions[j], state.Positions[j + 1]);
                    }
                }
            }
            return null;
        }

        /// <summary>Sphere 0 after its first displacement: as far as the walls let it go.</summary>
        internal static Vector3d Displaced(SimulationParameters parameters, RodState state, in Vector3d asked)
        {
            Vector3d from = state.Positions[0];
            double clearance = SweptSearch.ClearanceFor(parameters.SphereRadius);
            double part = 1.0;
            foreach (ContactShape wall in parameters.Walls)
            {
                double own = wall.Sweep(from, from, asked, asked, clearance, out _);
                double shared = wall.Sweep(
                    from, state.Positions[1], asked, state.Positions[1], clearance, out _);
                part = Math.Min(part, Math.Min(own, shared));
            }
            return part >= 1.0 ? asked : Vector3d.Lerp(from, asked, part);
        }
    }
}
