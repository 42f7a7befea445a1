using System;
using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A vessel's mesh as it was in the scene: what its wall is built from, by any thread.</summary>
    internal sealed class VesselMesh
    {
        private readonly Vector3[] _vertices;    // in the mesh's own frame
        private readonly int[] _triangles;
        private readonly Matrix4x4 _place;       // into the wire's frame
        private readonly Vector3d[] _rims;
        private readonly double _friction;

        public VesselMesh(string name, Mesh mesh, in Matrix4x4 place, Vector3d[] rims, double friction)
        {
            Name = name;
            _vertices = mesh.vertices;
            _triangles = mesh.triangles;
            _place = place;
            _rims = rims;
            _friction = friction;
        }

        /// <summary>The object's name.</summary>
        public string Name { get; }

        /// <summary>The wall, in units of the wire's frame.</summary>
        /// <exception cref="ArgumentException">The mesh is no such surface.</exception>
        public ContactShape Build()
        {
            var vertices = new Vector3d[_vertices.Length];
            for (int i = 0; i < vertices.Length; i++)
            {
                vertices[i] = _place.MultiplyPoint3x4(_vertices[i]).ToCore();
            }
            try
            {
                return new MeshShape(TriangleMesh.Create(vertices, _triangles, _rims))
                {
                    FrictionCoefficient = _friction,
                };
            }
            catch (MeshException error)
            {
                throw new ArgumentException("vessel " + Name + ": " + error.Message, error);
            }
        }
    }
}
