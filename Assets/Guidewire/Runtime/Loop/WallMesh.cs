using Guidewire.Core;
using Guidewire.Io;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A wall's triangles for a picture: made by the thread that opens a run, since a vessel may have many.
    /// </summary>
    internal sealed class WallMesh
    {
        private WallMesh(WallSurface surface)
        {
            Vertices = new Vector3[surface.Vertices.Count];
            for (int i = 0; i < Vertices.Length; i++)
            {
                Vertices[i] = surface.Vertices[i].ToUnity();
            }
            Triangles = new int[surface.Triangles.Count];
            for (int i = 0; i < Triangles.Length; i++)
            {
                Triangles[i] = surface.Triangles[i];
            }
        }

        /// <summary>The vertices, units.</summary>
        public Vector3[] Vertices { get; }

        /// <summary>Three indices a triangle.</summary>
        public int[] Triangles { get; }

        /// <summary>The walls of a run; one without bounds up to half the wire's length from its middle.</summary>
        public static WallMesh[] Of(SimulationSession session)
        {
            ContactShape[] walls = session.Parameters.Scene.Walls;
            RodState state = session.Simulation.State;
            var meshes = new WallMesh[walls.Length];
            for (int k = 0; k < walls.Length; k++)
            {
                meshes[k] = new WallMesh(WallSurface.Create(walls[k], state.Positions[state.ElementCount],
                    0.5 * state.ElementCount * state.ElementLength));
            }
            return meshes;
        }
    }
}
