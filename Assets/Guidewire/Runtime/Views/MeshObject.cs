using UnityEngine;
using UnityEngine.Rendering;

namespace Guidewire.Runtime
{
    /// <summary>A mesh in the frame of a loop's object with a renderer of its own: lights, shadows and pipelines treat
    /// it as any object. It is saved in no scene.</summary>
    internal sealed class MeshObject
    {
        private readonly GameObject _object;

        public MeshObject(string name, SimulationLoop loop, Vector3[] vertices, int[] triangles)
        {
            Mesh = new Mesh { name = name, indexFormat = IndexFormat.UInt32, hideFlags = HideFlags.DontSave };
            Mesh.MarkDynamic();
            Mesh.SetVertices(vertices);
            Mesh.SetTriangles(triangles, 0);
            _object = new GameObject(name) { hideFlags = HideFlags.DontSave };
            _object.transform.SetParent(loop.transform, false);
            _object.AddComponent<MeshFilter>().sharedMesh = Mesh;
            Renderer = _object.AddComponent<MeshRenderer>();
        }

        public Mesh Mesh { get; }

        public MeshRenderer Renderer { get; }

        /// <summary>Shows it; it stays until it is hidden.</summary>
        public void Show(Material material, int layer)
        {
            if (_object)    // gone with its loop
            {
                _object.layer = layer;
                Renderer.sharedMaterial = material;
                Renderer.enabled = true;
            }
        }

        public void Hide()
        {
            if (_object)
            {
                Renderer.enabled = false;
            }
        }

        public void Destroy()
        {
            Destroy(_object);
            Destroy(Mesh);
        }

        /// <summary>Destroys what a view has made, in Play and in Edit Mode.</summary>
        public static void Destroy(Object? made)
        {
            if (made && Application.isPlaying)
            {
                Object.Destroy(made!);
            }
            else if (made)
            {
                Object.DestroyImmediate(made!);
            }
        }
    }
}
