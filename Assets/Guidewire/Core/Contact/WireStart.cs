using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Checks where a wire starts: every element has to be in the lumen and none across a wall, and the lumen
    /// wide enough along the path of the push.</summary>
    public static class WireStart
    {
        // Whole vessels are 0.2 to 20 lengths of a wire, lumens 1.05 to 60 of its radii; metres taken for millimetres
        // are a factor of 1000.
        private const double OddLengths = 100.0;
        private const double OddRadii = 300.0;
        private const double MinRange = 1e-9;  // units: search range for walls that the axis may cross

        /// <summary>What is wrong with the start that the parameters describe, in one phrase, or null.</summary>
        /// <exception cref="ArgumentException">There is no such start.</exception>
        public static string? FindProblem(SimulationParameters parameters) =>
            parameters.Scene.Walls.Length == 0 ? null : FindProblem(parameters, new Scene(parameters));

        /// <summary>One line that gives the sizes of vessel and wire where they hardly belong together, or
        /// null.</summary>
        /// <param name="source">Who said what the vessel is.</param>
        public static string? FindOddSizes(SimulationParameters parameters, string source)
        {
            if (parameters.Scene.Walls.Length == 0)
            {
                return null;
            }
            double length = parameters.Scene.GuidewireLength;
            double radius = MethodTable.Of(parameters.Method.Solver).TakesMaterial
                ? parameters.Material.WireRadius / parameters.Scene.MetresPerUnit : parameters.Contact.SphereRadius;
            var scene = new Scene(parameters);
            Vector3d tip = (1.0 / scene.UnitLength) * scene.Shape.X[scene.Shape.ElementCount];
            foreach (ContactShape wall in parameters.Scene.Walls)
            {
                Extents? box = wall is ConvexObstacle ? null : Extents.Of(wall);
                if (!box.HasValue)
                {
                    continue;
                }
                double fraction = box.Value.LargestSide / length;
                double width = DistanceFrom(wall, tip);
                if (fraction > OddLengths || fraction < 1.0 / OddLengths || width > OddRadii * radius)
                {
                    return WarningTable.OddSizes.Text(source, box.Value.LargestSide, width, length, radius);
                }
            }
            return null;
        }

        /// <summary>What is wrong with the start of a scene, in one phrase, or null.</summary>
        internal static string? FindProblem(SimulationParameters parameters, Scene scene)
        {
            Vector3d[] x = scene.Shape.X;
            foreach (ContactShape wall in scene.Walls)
            {
                for (int j = 0; j < scene.Shape.ElementCount; j++)
                {
                    if (!IsFree(wall, scene.IsReached, x, j, 0.0, out _))
                    {
                        return Outside(x, j, wall);
                    }
                }
            }
            foreach (ContactShape wall in scene.Walls)
            {
                var lumen = new LumenWidth(wall, parameters.Contact.SphereRadius);
                if (lumen.IsTooNarrow(x, DistanceAhead(parameters)))
                {
                    return string.Format(CultureInfo.InvariantCulture,
                        "sphereRadius = {0} is larger than the lumen along the wire's path: {1:G4} units at ({2:G4},"
                        + " {3:G4}, {4:G4})", parameters.Contact.SphereRadius, lumen.Width, lumen.Centre.X,
                        lumen.Centre.Y, lumen.Centre.Z);
                }
            }
            return null;
        }

        /// <summary>Whether an element that a wire starts with has its axis farther than a distance from a wall, on the
        /// free side. Of a wire that a run had brought there an element outside the lumen has left by an open rim where
        /// elements that come no nearer to the wall connect it to the lumen.</summary>
        /// <param name="isReached">Whether a run had.</param>
        /// <param name="x">The wire's nodes, units.</param>
        /// <param name="least">That distance, units.</param>
        /// <param name="distance">From the wall, units; 0 or less outside.</param>
        internal static bool IsFree(ContactShape wall, bool isReached, Vector3d[] x, int element, double least,
            out double distance)
        {
            Vector3d a = x[element];
            Vector3d b = x[element + 1];
            int hint = -1;
            bool isInside = wall.Contains(a) && wall.Contains(b);
            if (!isInside && isReached && Array.Exists(x, node => wall.Contains(node)))
            {
                // Behind a rim the free side of a distant wall means nothing.
                bool isNear = wall.Nearest(a, b, Math.Max(least, MinRange), ref hint, out SurfaceContact near);
                distance = isNear ? near.Distance : double.PositiveInfinity;
                return distance > least;
            }
            wall.Nearest(a, b, double.PositiveInfinity, ref hint, out SurfaceContact contact);
            distance = isInside ? contact.Distance : Math.Min(contact.Distance, 0.0);
            return distance > least;
        }

        private static string Outside(Vector3d[] x, int element, ContactShape wall)
        {
            Extents? box = Extents.Of(wall);
            string what = wall is ConvexObstacle ? "the obstacle" : "the vessel";
            return string.Format(CultureInfo.InvariantCulture,
                "the wire starts outside: rod element {0} from {1} to {2} is not on the free side of the wall; the wire"
                + " reaches {3}{4}", element, x[element], x[element + 1], Extents.Of(x),
                box.HasValue ? ", " + what + " " + box.Value : "");
        }

        // How far the drive is to push the tip, units. Where nobody knows, the lumen is looked at for a wire's length:
        // to its end a walk through a long vessel takes a second, and fourteen in a browser.
        private static double DistanceAhead(SimulationParameters parameters)
        {
            DriveParameters drive = parameters.Drive;
            return drive.Steering != null || drive.Kind == Drive.Force ? parameters.Scene.GuidewireLength
                : drive.Kind == Drive.Hold ? Math.Abs(drive.Displacement)
                : Math.Max(0.0, drive.DisplacementPerStep * parameters.Method.MaxSimulationSteps);
        }

        private static double DistanceFrom(ContactShape wall, in Vector3d x)
        {
            int hint = -1;
            wall.Nearest(x, x, double.PositiveInfinity, ref hint, out SurfaceContact contact);
            return contact.Distance;
        }
    }
}
