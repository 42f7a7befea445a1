using System;
using System.Collections.Generic;
using Guidewire.Core;
using Guidewire.Io;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A wall's triangles for a picture: made by the thread that opens a run, since a vessel may have many.
    /// </summary>
    internal sealed class WallMesh
    {
        private readonly Vector3d[] _rest;      // units
        private readonly Vector3d[] _moved;
        private readonly double _radius;        // of the wire, units
        private bool _isMoved;

        private WallMesh(WallSurface surface, double radius, bool isSoft)
        {
            _radius = radius;
            _rest = isSoft ? new List<Vector3d>(surface.Vertices).ToArray() : Array.Empty<Vector3d>();
            _moved = new Vector3d[_rest.Length];
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
                    0.5 * state.ElementCount * state.ElementLength),
                    session.Parameters.Material.WireRadius / session.Parameters.Scene.MetresPerUnit,
                    walls[k].Softness != null);
            }
            return meshes;
        }

        /// <summary>Moves the vertices of a wall that gives way to where it is drawn.</summary>
        /// <returns>Whether they differ from before.</returns>
        public bool Follow(WireState state)
        {
            if (_rest.Length == 0)
            {
                return false;
            }
            bool was = _isMoved;
            _isMoved = WallIndentation.Move(_rest, state.Rod.Positions, state.WallIndentations, _radius, _moved);
            for (int i = 0; i < _rest.Length && (was || _isMoved); i++)
            {
                Vertices[i] = _moved[i].ToUnity();
            }
            return was || _isMoved;
        }
    }
}
