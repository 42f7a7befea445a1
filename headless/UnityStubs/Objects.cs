using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public class Object
    {
        internal bool isDestroyed;

        public string name { get; set; } = "";

        /// <summary>At once here, at the end of the frame in Unity. In edit mode an error, and nothing is destroyed.
        /// </summary>
        public static void Destroy(Object obj)
        {
            if (!Application.isPlaying)
            {
                Debug.LogError("Destroy may not be called from edit mode! Use DestroyImmediate instead.");
                return;
            }
            DestroyImmediate(obj);
        }

        public static void DestroyImmediate(Object obj)
        {
            if (obj is null || obj.isDestroyed)
            {
                return;
            }
            obj.isDestroyed = true;
            if (obj is GameObject gameObject)
            {
                foreach (Component component in gameObject.components)
                {
                    component.isDestroyed = true;
                    UnityStubs.Engine.Remove(component);
                }
            }
        }

        public static implicit operator bool(Object exists) => !(exists == null);

        public static bool operator ==(Object a, Object b)
        {
            bool noA = a is null || a.isDestroyed;
            bool noB = b is null || b.isDestroyed;
            return noA || noB ? noA && noB : ReferenceEquals(a, b);
        }

        public static bool operator !=(Object a, Object b) => !(a == b);

        public override bool Equals(object other) => this == other as Object;

        public override int GetHashCode() => base.GetHashCode();
    }

    public sealed class TextAsset : Object
    {
        public TextAsset(string text)
        {
            this.text = text;
        }

        public string text { get; }
    }

    public sealed class GameObject : Object
    {
        internal readonly List<Component> components = new List<Component>();

        public GameObject()
            : this("New Game Object")
        {
        }

        public GameObject(string name)
        {
            this.name = name;
            Attach(typeof(Transform));
        }

        public Transform transform => (Transform)components[0];

        public int layer { get; set; }

        public T AddComponent<T>()
            where T : Component
        {
            Component component = Attach(typeof(T));
            UnityStubs.Engine.Awaken(component);
            return (T)component;
        }

        public T GetComponent<T>()
        {
            foreach (Component component in components)
            {
                if (component is T found)
                {
                    return found;
                }
            }
            return default;
        }

        internal Component Attach(Type type)
        {
            var component = (Component)Activator.CreateInstance(type);
            component.gameObject = this;
            components.Add(component);
            return component;
        }
    }

    public class Component : Object
    {
        public GameObject gameObject { get; internal set; }

        public Transform transform => gameObject.transform;

        public T GetComponent<T>() => gameObject.GetComponent<T>();
    }

    public class Transform : Component
    {
        public Vector3 position { get; set; }

        public Quaternion rotation { get; set; } = Quaternion.identity;

        public Vector3 localScale { get; set; } = Vector3.one;

        public Matrix4x4 localToWorldMatrix => Matrix4x4.TRS(position, rotation, localScale);

        public Vector3 TransformPoint(Vector3 position) => localToWorldMatrix.MultiplyPoint3x4(position);

        public Vector3 InverseTransformPoint(Vector3 position)
        {
            Quaternion back = rotation;
            Vector3 p = new Quaternion(-back.x, -back.y, -back.z, back.w) * (position - this.position);
            return new Vector3(p.x / localScale.x, p.y / localScale.y, p.z / localScale.z);
        }
    }

    public class Behaviour : Component
    {
        public bool enabled { get; set; } = true;
    }

    public class MonoBehaviour : Behaviour
    {
        public void Invoke(string methodName, float time) => throw new NotSupportedException();

        public Coroutine StartCoroutine(string methodName) => throw new NotSupportedException();

        public Coroutine StartCoroutine(System.Collections.IEnumerator routine) => throw new NotSupportedException();
    }

    public class Renderer : Component
    {
        public Material sharedMaterial { get; set; }
    }

    public sealed class MeshRenderer : Renderer
    {
    }

    public sealed class MeshFilter : Component
    {
        public Mesh sharedMesh { get; set; }
    }

    public sealed class MeshCollider : Collider
    {
        public Mesh sharedMesh { get; set; }
    }

    public sealed class LineRenderer : Renderer
    {
        private Vector3[] _positions = Array.Empty<Vector3>();

        public int positionCount
        {
            get => _positions.Length;
            set => Array.Resize(ref _positions, value);
        }

        public void SetPositions(Vector3[] positions)
        {
            Array.Copy(positions, _positions, Math.Min(positions.Length, _positions.Length));
        }

        public Vector3 GetPosition(int index) => _positions[index];
    }

    public sealed class Camera : Behaviour
    {
    }

    public sealed class Light : Behaviour
    {
    }
}
