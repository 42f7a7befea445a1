using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Where a wire with a material may start between walls: with the surface of every element in the
    /// free.</summary>
    internal static class MaterialStart
    {
        /// <summary>What is wrong with the start of a scene, in one phrase, or null.</summary>
        /// <param name="from">The first element that is looked at.</param>
        public static string? FindProblem(MaterialScene scene, int from = 0)
        {
            return FindProblem(scene, from, scene.Rod.ElementCount);
        }

        /// <summary>The same of the elements before one, exclusive.</summary>
        public static string? FindProblem(MaterialScene scene, int from, int to)
        {
            double units = 1.0 / scene.Metres;
            Vector3d[] x = System.Array.ConvertAll(scene.Shape.X, node => units * node);
            for (int j = from; j < to; j++)
            {
                double radius = units * scene.Rod.Radius[j];
                foreach (ContactShape wall in scene.Walls)
                {
                    if (!WireStart.IsFree(wall, scene.IsReached, x, j, radius, out double distance))
                    {
                        return Text(j, x[j], x[j + 1], radius, distance, wall);
                    }
                }
            }
            return null;
        }

        private static string Text(int j, in Vector3d a, in Vector3d b, double radius, double distance,
            ContactShape wall)
        {
            double narrowest = wall.NarrowestRadius(0.0);
            return string.Format(CultureInfo.InvariantCulture,
                "the wire starts outside: rod element {0} from {1} to {2}, radius {3:G4} units, reaches {4:G4} units"
                + " into the wall{5}", j, a, b, radius, radius - distance,
                double.IsInfinity(narrowest) ? "" : string.Format(CultureInfo.InvariantCulture,
                    "; the vessel's radius is {0:G4} units where it is narrowest", narrowest));
        }
    }
}
