using System.Collections.Generic;
using System.IO;
using System.Text;
using Guidewire.Core;

namespace Guidewire.Cli
{
    /// <summary>The walls of a scene as bytes, for who draws them, lowest byte first: for each wall, the vessel first
    /// where there is one, how many vertices and triangles it has (int32), its vertices (x, y and z, float64, units)
    /// and its triangles (three indices, int32), counter-clockwise as the wire sees them.</summary>
    internal static class SessionWalls
    {
        /// <summary>All walls.</summary>
        /// <param name="parameters">Those of the run.</param>
        /// <param name="middle">Where the picture's middle is, units.</param>
        /// <param name="reach">How far from there a wall without end is drawn, units.</param>
        /// <param name="centrelines">Nodes of the wire and of each catheter, units.</param>
        /// <param name="displacements">Of walls at their elements, m; none: all walls are at rest.</param>
        public static byte[] ToBytes(SimulationParameters parameters, in Vector3d middle, double reach,
            IReadOnlyList<Vector3d[]> centrelines, IReadOnlyList<Vector3d[]> displacements)
        {
            using var bytes = new MemoryStream();
            using var writer = new BinaryWriter(bytes, Encoding.UTF8);
            foreach (ContactShape wall in parameters.Scene.Walls)
            {
                WallSurface surface = WallSurface.Create(wall, middle, reach);
                var drawn = new WallIndentation(parameters, wall, surface.Vertices);
                drawn.Move(centrelines, displacements);
                writer.Write(surface.Vertices.Count);
                writer.Write(surface.Triangles.Count / 3);
                foreach (Vector3d vertex in drawn.Vertices)
                {
                    writer.Write(vertex.X);
                    writer.Write(vertex.Y);
                    writer.Write(vertex.Z);
                }
                foreach (int index in surface.Triangles)
                {
                    writer.Write(index);
                }
            }
            writer.Flush();
            return bytes.ToArray();
        }
    }
}
