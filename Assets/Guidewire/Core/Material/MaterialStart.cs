using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Checks where a wire with a material starts: the surface of no element may touch a rigid wall, nor the
    /// limit of a soft one.</summary>
    internal static class MaterialStart
    {
        private const string Wire = "the wire";
        private const double Rounding = 1e-9;  // of the radius
        private const double Apart = 1e-4;     // of the radius, by which barriers begin with an open gap

        /// <summary>What is wrong with the start of a scene, in one phrase, or null. A surface at a wall but for
        /// rounding is moved off it, where barriers need a gap, by a ten-thousandth of the radius. What has no barriers
        /// touches walls, and contact may have let them in a little: of that the core line has to be free.</summary>
        public static string? FindProblem(SimulationParameters parameters, MaterialScene scene)
        {
            if (MethodTable.Of(parameters.Method.Solver).HasBarriers)
            {
                MoveApart(scene);
                return FindProblem(scene, 0, scene.Rod.ElementCount);
            }
            return FindProblem(scene, 0, scene.Rod.ElementCount,
                parameters.Scene.Start != null ? SweptSearch.ClearanceFor(1.0) : 1.0 - Rounding);
        }

        // Elements whose surface touches a wall within rounding.
        private static void MoveApart(MaterialScene scene)
        {
            double units = 1.0 / scene.Metres;
            foreach (ContactShape wall in scene.Walls)
            {
                for (int j = 0; j < scene.Rod.ElementCount && wall.Softness == null && wall.Motion == null; j++)
                {
                    double radius = units * scene.Rod.Radius[j];
                    int hint = -1;
                    if (wall.Nearest(units * scene.Shape.X[j], units * scene.Shape.X[j + 1], (1.0 + Rounding) * radius,
                        ref hint, out SurfaceContact near) && near.Distance >= (1.0 - Rounding) * radius)
                    {
                        Vector3d move = (Apart * scene.Rod.Radius[j]) * near.Normal;
                        scene.Shape.X[j] += move;
                        scene.Shape.X[j + 1] += move;
                    }
                }
            }
        }

        /// <summary>The same for the wire from a position on, units, which is in an element, with its whole
        /// radius.</summary>
        public static string? FindProblemFrom(MaterialScene scene, int element, in Vector3d position,
            string name = Wire)
        {
            Vector3d[] x = Nodes(scene);
            x[element] = position;
            return FindProblem(scene, x, element, scene.Rod.ElementCount, 1.0, name);
        }

        /// <summary>Gives the same for the elements before one, exclusive.</summary>
        /// <param name="fraction">Of the radius, that has to be free.</param>
        /// <param name="name">What the phrase calls it.</param>
        public static string? FindProblem(MaterialScene scene, int from, int to, double fraction = 1.0,
            string name = Wire) => FindProblem(scene, Nodes(scene), from, to, fraction, name);

        private static Vector3d[] Nodes(MaterialScene scene)
        {
            double units = 1.0 / scene.Metres;
            return System.Array.ConvertAll(scene.Shape.X, node => units * node);
        }

        private static string? FindProblem(MaterialScene scene, Vector3d[] x, int from, int to, double fraction,
            string name)
        {
            double units = 1.0 / scene.Metres;
            for (int j = from; j < to; j++)
            {
                foreach (ContactShape wall in scene.Walls)
                {
                    if (wall.Motion != null && scene.IsReached)
                    {
                        continue;    // it was elsewhere then
                    }
                    double radius = units * (scene.Rod.Radius[j] - (wall.Softness?.MaxOf(scene.Rod.Radius[j]) ?? 0.0));
                    Vector3d[] onWall = wall.Motion == null ? x : OnWall(x, new WallField(wall.Motion));
                    if (!WireStart.IsFree(wall, scene.IsReached, onWall, j, fraction * radius, out double distance))
                    {
                        return name + Text(j, x[j], x[j + 1], radius, distance, wall);
                    }
                }
            }
            return null;
        }

        private static Vector3d[] OnWall(Vector3d[] x, WallField field) =>
            System.Array.ConvertAll(x, node => field.AtRest(node));

        private static string Text(int j, in Vector3d a, in Vector3d b, double radius, double distance,
            ContactShape wall)
        {
            double narrowest = wall.NarrowestRadius(0.5 * radius, radius);
            return string.Format(CultureInfo.InvariantCulture,
                " starts outside: rod element {0} from {1} to {2}, radius {3:G4} units, reaches {4:G4} units"
                + " into the wall{5}", j, a, b, radius, radius - distance,
                double.IsInfinity(narrowest) ? "" : string.Format(CultureInfo.InvariantCulture,
                    "; the vessel's radius is {0:G4} units where it is narrowest", narrowest));
        }
    }
}
