using System.Collections.Generic;
using UnityEngine;
using UnityEngine.Rendering;

namespace Guidewire.Runtime
{
    /// <summary>A mesh in the frame of a loop's object with a renderer of its own: lights, shadows and pipelines treat
    /// it as any object. It is saved in no scene.</summary>
    internal sealed class MeshObject
    {
        private const string Prefix = "Guidewire: ";    // of what no user names so

        // What is alive: a copy of a loop's object has copies of these that nobody rewrites, and so has a reload.
        private static readonly HashSet<GameObject> Live = new HashSet<GameObject>();

        private readonly GameObject _object;

        public MeshObject(string name, SimulationLoop loop, Vector3[] vertices, int[] triangles)
        {
            Mesh = new Mesh { name = name, indexFormat = IndexFormat.UInt32, hideFlags = HideFlags.DontSave };
            Mesh.MarkDynamic();
            Mesh.SetVertices(vertices);
            Mesh.SetTriangles(triangles, 0);
            for (int k = loop.transform.childCount - 1; k >= 0; k--)
            {
                GameObject child = loop.transform.GetChild(k).gameObject;
                if (child.name.StartsWith(Prefix, System.StringComparison.Ordinal) && !Live.Contains(child))
                {
                    Destroy(child);
                }
            }
            _object = new GameObject(Prefix + name) { hideFlags = HideFlags.DontSave };
            Live.Add(_object);
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
            Live.Remove(_object);
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
