using System;
using Guidewire.Core;
using Guidewire.Io;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A wall's triangles for a picture: made by the thread that opens a run, since a vessel may have many.
    /// </summary>
    internal sealed class WallMesh
    {
        private readonly WallIndentation _drawn;

        private readonly int _wall;

        private WallMesh(WallIndentation drawn, WallSurface surface, int wall)
        {
            (_drawn, _wall) = (drawn, wall);
            Vertices = Array.ConvertAll(drawn.Vertices, vertex => vertex.ToUnity());
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
                WallSurface surface = WallSurface.Create(walls[k], state.Positions[state.ElementCount],
                    0.5 * state.ElementCount * state.ElementLength);
                meshes[k] = new WallMesh(new WallIndentation(session.Parameters, walls[k], surface.Vertices),
                    surface, k);
            }
            return meshes;
        }

        /// <summary>Moves the vertices of a wall that gives way or moves to where it is drawn.</summary>
        /// <returns>Whether they differ from before.</returns>
        public bool Follow(WireState state)
        {
            bool isOther = _drawn.Move(state.Centrelines, state.WallDisplacements, state.Fields[_wall]);
            for (int i = 0; i < Vertices.Length && isOther; i++)
            {
                Vertices[i] = _drawn.Vertices[i].ToUnity();
            }
            return isOther;
        }
    }
}
