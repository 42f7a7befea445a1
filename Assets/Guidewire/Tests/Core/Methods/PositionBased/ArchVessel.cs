using System;
using System.Collections.Generic;
using System.IO;
using Guidewire.Io;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The vessel of the scenes: a straight sheath along z from an open rim, then an arch.</summary>
    internal static class ArchVessel
    {
        /// <summary>z of the open rim, a circle around the z axis, units.</summary>
        public const double Entrance = -320.0;

        /// <summary>z where the straight sheath ends, units.</summary>
        public const double SheathEnd = 0.0;

        private const double EntranceRadius = 8.0;

        /// <summary>Its wall, without friction; shared.</summary>
        public static readonly MeshShape Shape = Read();

        /// <summary>How many of the wire's points, ten an element, lie beyond the wall. What left through the rim's
        /// disc lies outside but has passed no wall.</summary>
        public static int PointsOutside(RodState state)
        {
            // From the tip, the end far from the open rim: wherever the wire lies after it left by the rim, even beside
            // the sheath, it has passed no wall.
            Vector3d last = state.Positions[state.ElementCount];
            bool isInside = Shape.Contains(last);
            bool throughRim = false;
            int count = isInside ? 0 : 1;
            for (int k = 10 * state.ElementCount - 1; k >= 0; k--)
            {
                int j = k / 10;
                Vector3d x = Vector3d.Lerp(state.Positions[j], state.Positions[j + 1], (k - 10 * j) / 10.0);
                bool wasInside = isInside;
                isInside = Shape.Contains(x);
                if (isInside != wasInside)
                {
                    bool crossesRim = CrossesRim(last, x);
                    count += isInside && throughRim && !crossesRim ? 1 : 0;
                    throughRim = !isInside && crossesRim;
                }
                count += isInside || throughRim ? 0 : 1;
                last = x;
            }
            return count;
        }

        /// <summary>Its wall, for one who changes it.</summary>
        private static MeshShape Read()
        {
            string copy = Path.Combine(Path.GetTempPath(), Guid.NewGuid().ToString("N") + ".obj");
            File.Copy(Path.Combine(Package(), "Samples~", "Scenes", "arch.obj.txt"), copy);
            try
            {
                return new MeshShape(MeshFile.Read(copy, 1.0, new[] { new Vector3d(0.0, 0.0, Entrance) }));
            }
            finally
            {
                File.Delete(copy);
            }
        }

        private static bool CrossesRim(in Vector3d from, in Vector3d to)
        {
            if (from.Z < Entrance == to.Z < Entrance)
            {
                return false;
            }
            Vector3d at = Vector3d.Lerp(from, to, (Entrance - from.Z) / (to.Z - from.Z));
            return Math.Sqrt(at.X * at.X + at.Y * at.Y) < EntranceRadius;
        }

        // This package's folder: of this repository, or of a project in which it is embedded or installed.
        private static string Package()
        {
            const string Name = "org.guidewire.simulation";
            for (string? folder = TestContext.CurrentContext.TestDirectory; folder != null;
                folder = Path.GetDirectoryName(folder))
            {
                string cache = Path.Combine(folder, "Library", "PackageCache");
                var found = new List<string>
                {
                    Path.Combine(folder, "Assets", "Guidewire"), Path.Combine(folder, "Packages", Name),
                };
                found.AddRange(Directory.Exists(cache) ? Directory.GetDirectories(cache, Name + "*")
                    : Array.Empty<string>());
                found.RemoveAll(own => !Directory.Exists(Path.Combine(own, "Samples~")));
                if (found.Count > 0)
                {
                    return found[0];
                }
            }
            throw new DirectoryNotFoundException("no package around");
        }
    }
}
