using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Where a wire may start: with every element in the lumen and none across a wall.</summary>
    internal static class WireStart
    {
        /// <summary>What is wrong with the start of a scene, in one phrase, or null.</summary>
        public static string? FindProblem(Scene scene)
        {
            Vector3d[] x = scene.Shape.X;
            for (int j = 0; j < scene.Shape.ElementCount; j++)
            {
                foreach (ContactShape wall in scene.Walls)
                {
                    int hint = -1;
                    wall.Nearest(x[j], x[j + 1], double.PositiveInfinity, ref hint, out SurfaceContact contact);
                    if (!(contact.Distance > 0.0) || !wall.Contains(x[j]) || !wall.Contains(x[j + 1]))
                    {
                        return string.Format(CultureInfo.InvariantCulture,
                            "the wire starts outside: rod element {0} from {1} to {2} is not on the free side of the"
                            + " wall",
                            j, x[j], x[j + 1]);
                    }
                }
            }
            return null;
        }
    }
}
