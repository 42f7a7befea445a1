using System;
using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A vessel for wires: the mesh of this object's MeshCollider, or else of its MeshFilter, as it stands
    /// when a wire is built. It is one closed surface, or open at the rims that are named.</summary>
    [AddComponentMenu("Guidewire/Scene Vessel"), Manual("vessels")]
    public sealed class SceneVessel : MonoBehaviour
    {
        [Tooltip("Coulomb's coefficient of friction with the wire, dimensionless.")]
        [SerializeField, Min(0f)] private float _frictionCoefficient;

        [Tooltip("An object near the middle of each open rim of the mesh.")]
        [SerializeField] private Transform[] _openRims = Array.Empty<Transform>();

        /// <summary>Coulomb's coefficient of friction with the wire, dimensionless, 0 or more.</summary>
        public float FrictionCoefficient
        {
            get => _frictionCoefficient;
            set => _frictionCoefficient = value;
        }

        /// <summary>An object near the middle of each open rim of the mesh.</summary>
        public Transform[] OpenRims
        {
            get => _openRims;
            set => _openRims = value;
        }

        /// <summary>The wall, in units of a wire's frame.</summary>
        /// <param name="frame">The wire's object: a unit of the wire is a unit along its axes.</param>
        /// <exception cref="ArgumentException">There is no mesh, it is no such surface, or the friction is
        /// negative.</exception>
        public ContactShape Create(Transform frame) => Read(frame).Build();

        /// <summary>Another text where the wall would be another: in another place, or another mesh.</summary>
        internal string Key(Transform frame)
        {
            MeshCollider collider = GetComponent<MeshCollider>();
            MeshFilter filter = GetComponent<MeshFilter>();
            Mesh? mesh = collider ? collider.sharedMesh : filter ? filter.sharedMesh : null;
            Matrix4x4 place = frame.worldToLocalMatrix * transform.localToWorldMatrix;
            string key = gameObject.name + _frictionCoefficient + place + (mesh ? mesh!.name + mesh.vertexCount : "");
            foreach (Transform rim in _openRims)
            {
                key += rim ? rim.position.ToString() : "";
            }
            return key;
        }

        /// <summary>Takes the mesh from the scene.</summary>
        internal VesselMesh Read(Transform frame)
        {
            MeshCollider collider = GetComponent<MeshCollider>();
            MeshFilter filter = GetComponent<MeshFilter>();
            Mesh? mesh = collider ? collider.sharedMesh : filter ? filter.sharedMesh : null;
            if (!mesh)
            {
                throw Refused("needs a MeshCollider or a MeshFilter with a mesh");
            }
            if (!mesh!.isReadable)
            {
                throw Refused("its mesh is not readable: tick Read/Write in its import settings");
            }
            if (!(_frictionCoefficient >= 0f))
            {
                throw Refused("friction coefficient " + _frictionCoefficient + " is not allowed: a number >= 0");
            }
            var rims = new Vector3d[_openRims.Length];
            for (int i = 0; i < rims.Length; i++)
            {
                if (!_openRims[i])
                {
                    throw Refused("open rim " + i + " names no object");
                }
                rims[i] = frame.InverseTransformPoint(_openRims[i].position).ToCore();
            }
            Matrix4x4 place = frame.worldToLocalMatrix * transform.localToWorldMatrix;
            return new VesselMesh(gameObject.name, mesh, place, rims, _frictionCoefficient);
        }

        private ArgumentException Refused(string why) =>
            new ArgumentException("vessel " + gameObject.name + ": " + why);
    }
}
