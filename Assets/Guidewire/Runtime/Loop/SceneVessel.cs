using System;
using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A vessel for wires: the mesh of this object's MeshCollider, or else of its MeshFilter, as it stands
    /// when a wire is built. It is one closed surface, or open at the rims that are named.</summary>
    public sealed class SceneVessel : MonoBehaviour
    {
        [Tooltip("Coulomb's coefficient of friction with the wire, dimensionless.")]
        [SerializeField] private float _frictionCoefficient;

        [Tooltip("An object near the middle of each open rim of the mesh.")]
        [SerializeField] private Transform[] _openRims = Array.Empty<Transform>();

        /// <summary>The wall, in units of a wire's frame.</summary>
        /// <param name="frame">The wire's object: a unit of the wire is a unit along its axes.</param>
        /// <exception cref="ArgumentException">There is no mesh, it is no such surface, or the friction is
        /// negative.</exception>
        public ContactShape Create(Transform frame)
        {
            MeshCollider collider = GetComponent<MeshCollider>();
            MeshFilter filter = GetComponent<MeshFilter>();
            Mesh? mesh = collider ? collider.sharedMesh : filter ? filter.sharedMesh : null;
            if (!mesh)
            {
                throw Refused("needs a MeshCollider or a MeshFilter with a mesh");
            }
            if (!(_frictionCoefficient >= 0f))
            {
                throw Refused("friction coefficient " + _frictionCoefficient + " is not allowed: a number >= 0");
            }
            var rims = new Vector3d[_openRims.Length];
            for (int i = 0; i < rims.Length; i++)
            {
                rims[i] = frame.InverseTransformPoint(_openRims[i].position).ToCore();
            }
            Vector3[] local = mesh!.vertices;
            var vertices = new Vector3d[local.Length];
            for (int i = 0; i < vertices.Length; i++)
            {
                vertices[i] = frame.InverseTransformPoint(transform.TransformPoint(local[i])).ToCore();
            }
            try
            {
                return new MeshShape(TriangleMesh.Create(vertices, mesh.triangles, rims))
                {
                    FrictionCoefficient = _frictionCoefficient,
                };
            }
            catch (MeshException error)
            {
                throw Refused(error.Message);
            }
        }

        private ArgumentException Refused(string why)
        {
            return new ArgumentException("vessel " + gameObject.name + ": " + why);
        }
    }
}
