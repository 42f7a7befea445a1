using System.Collections.Generic;
using Guidewire.Core;
using UnityEngine;
using UnityEngine.Rendering;

namespace Guidewire.Runtime
{
    /// <summary>Shows the walls, translucent: from outside the far wall is seen through the near one, because a wall's
    /// front is the side that the wire sees.</summary>
    public sealed class VesselView : MonoBehaviour
    {
        [SerializeField] private SimulationLoop _loop = null!;

        [Tooltip("Material of the walls.")]
        [SerializeField] private Material _material = null!;

        [Tooltip("Distance from the middle of the wire up to which an infinite wall is drawn, in units.")]
        [SerializeField] private float _reach = 150f;

        private readonly List<Mesh> _meshes = new List<Mesh>();
        private int _generation;

        /// <summary>The walls' meshes.</summary>
        public IReadOnlyList<Mesh> Meshes => _meshes;

        private void LateUpdate()
        {
            if (_generation != _loop.Generation)
            {
                _generation = _loop.Generation;
                Build();
            }
            Matrix4x4 place = transform.localToWorldMatrix;
            for (int i = 0; i < _meshes.Count; i++)
            {
                Graphics.DrawMesh(_meshes[i], place, _material, gameObject.layer);
            }
        }

        private void OnDestroy()
        {
            Clear();
        }

        private void Build()
        {
            Clear();
            if (_loop.Session == null)
            {
                return;
            }
            RodState state = _loop.Session.Simulation.State;
            Vector3d middle = state.Positions[state.ElementCount];
            foreach (ContactShape wall in _loop.Session.Parameters.Scene.Walls)
            {
                WallSurface surface = WallSurface.Create(wall, middle, _reach);
                var vertices = new Vector3[surface.Vertices.Count];
                for (int i = 0; i < vertices.Length; i++)
                {
                    vertices[i] = surface.Vertices[i].ToUnity();
                }
                var mesh = new Mesh { name = "Wall", indexFormat = IndexFormat.UInt32 };
                mesh.SetVertices(vertices);
                mesh.SetTriangles(new List<int>(surface.Triangles).ToArray(), 0);
                mesh.RecalculateNormals();
                mesh.RecalculateBounds();
                _meshes.Add(mesh);
            }
        }

        private void Clear()
        {
            foreach (Mesh mesh in _meshes)
            {
                Destroy(mesh);
            }
            _meshes.Clear();
        }
    }
}
