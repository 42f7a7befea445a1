using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public class Object
    {
        internal bool isDestroyed;

        public Object()
        {
            UnityStubs.Engine.RequireMainThread();
        }

        public HideFlags hideFlags { get; set; }

        private string _name = "";

        /// <summary>Of a component that of its object.</summary>
        public string name
        {
            get => this is Component component ? component.gameObject.name : _name;
            set => _name = value;
        }

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
            if (obj is GameObject gameObject)
            {
                foreach (Transform child in gameObject.transform.children.ToArray())
                {
                    DestroyImmediate(child.gameObject);
                }
                foreach (Component component in gameObject.components)
                {
                    UnityStubs.Engine.Remove(component);
                    component.isDestroyed = true;
                }
                gameObject.transform.SetParent(null);
            }
            else if (obj is Component component)
            {
                UnityStubs.Engine.Remove(component);
                component.gameObject.components.Remove(component);
            }
            obj.isDestroyed = true;
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

    [Flags]
    public enum HideFlags
    {
        None = 0,
        DontSave = 52,
    }

    public struct EntityId
    {
    }

    public sealed class TextAsset : Object
    {
        public TextAsset(string text)
            : this(System.Text.Encoding.UTF8.GetBytes(text))
        {
        }

        internal TextAsset(byte[] bytes)
        {
            _bytes = bytes;
        }

        private readonly byte[] _bytes;

        public byte[] bytes => UnityStubs.Engine.OnMainThread(_bytes);

        public long dataSize => bytes.Length;

        public string text => System.Text.Encoding.UTF8.GetString(bytes);
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

        internal string prefabRoot;
        internal string prefabPath;

        public Transform transform => UnityStubs.Engine.OnMainThread((Transform)components[0]);

        public string tag { get; set; } = "Untagged";

        public int layer { get; set; }

        public bool activeSelf { get; private set; } = true;

        public bool activeInHierarchy => activeSelf
            && (transform.parent is null || transform.parent.gameObject.activeInHierarchy);

        public void SetActive(bool value)
        {
            activeSelf = value;
            UnityStubs.Engine.UpdateEnabled();
        }

        public T AddComponent<T>()
            where T : Component
        {
            foreach (RequireComponent needed in typeof(T).GetCustomAttributes(typeof(RequireComponent), true))
            {
                if (!components.Exists(needed.m_Type0.IsInstanceOfType))
                {
                    UnityStubs.Engine.Awaken(Attach(needed.m_Type0));
                }
            }
            // Of some there is at most one.
            bool isOne = typeof(T) == typeof(MeshFilter) || typeof(T).IsSubclassOf(typeof(Renderer));
            if (isOne && components.Exists(component => component is T))
            {
                return null;
            }
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
            if (component is MeshRenderer renderer)
            {
                UnityStubs.Engine.Renderers.Add(renderer);
            }
            if (component is Camera camera)
            {
                Camera.All.Add(camera);
            }
            return component;
        }
    }

    public class Component : Object
    {
        private GameObject _gameObject;

        public GameObject gameObject
        {
            get => UnityStubs.Engine.OnMainThread(_gameObject);
            internal set => _gameObject = value;
        }

        public Transform transform => gameObject.transform;

        public T GetComponent<T>() => gameObject.GetComponent<T>();

        public bool TryGetComponent<T>(out T component)
        {
            component = gameObject.GetComponent<T>();
            return component is object;
        }

        public void GetComponents<T>(List<T> results)
        {
            results.Clear();
            foreach (Component component in gameObject.components)
            {
                if (component is T found)
                {
                    results.Add(found);
                }
            }
        }

        public T[] GetComponents<T>()
        {
            var found = new List<T>();
            GetComponents(found);
            return found.ToArray();
        }

        public T GetComponentInParent<T>()
        {
            for (Transform above = transform; !(above is null); above = above.parent)
            {
                if (above.TryGetComponent(out T found))
                {
                    return found;
                }
            }
            return default;
        }
    }

    public class Transform : Component
    {
        internal readonly List<Transform> children = new List<Transform>();

        public Transform parent { get; private set; }

        public int childCount => children.Count;

        public Transform GetChild(int index) => children[index];

        public Vector3 localPosition { get; set; }

        public Quaternion localRotation { get; set; } = Quaternion.identity;

        public Vector3 localScale { get; set; } = Vector3.one;

        public Vector3 position
        {
            get => localToWorldMatrix.position;
            set => localPosition = parent is null ? value : parent.worldToLocalMatrix.MultiplyPoint3x4(value);
        }

        public Quaternion rotation
        {
            get => parent is null ? localRotation : parent.rotation * localRotation;
            set => localRotation = parent is null ? value : Quaternion.Inverse(parent.rotation) * value;
        }

        /// <summary>As of parents that are not sheared.</summary>
        public Vector3 lossyScale => parent is null ? localScale : new Vector3(parent.lossyScale.x * localScale.x,
            parent.lossyScale.y * localScale.y, parent.lossyScale.z * localScale.z);

        public Matrix4x4 localToWorldMatrix => parent is null ? Matrix4x4.TRS(localPosition, localRotation, localScale)
            : parent.localToWorldMatrix * Matrix4x4.TRS(localPosition, localRotation, localScale);

        public Matrix4x4 worldToLocalMatrix => localToWorldMatrix.inverse;

        public Vector3 TransformPoint(Vector3 position) => localToWorldMatrix.MultiplyPoint3x4(position);

        public Vector3 InverseTransformPoint(Vector3 position) => worldToLocalMatrix.MultiplyPoint3x4(position);

        public void SetParent(Transform parent) => SetParent(parent, true);

        public void SetParent(Transform parent, bool worldPositionStays)
        {
            (Vector3 position, Quaternion rotation) = (this.position, this.rotation);
            this.parent?.children.Remove(this);
            this.parent = parent;
            parent?.children.Add(this);
            if (worldPositionStays)
            {
                (this.position, this.rotation) = (position, rotation);
            }
        }

    }

    public class Behaviour : Component
    {
        private bool _enabled = true;

        public bool enabled
        {
            get => _enabled;
            set
            {
                _enabled = value;
                UnityStubs.Engine.UpdateEnabled();
            }
        }

        public bool isActiveAndEnabled => !isDestroyed && enabled && gameObject.activeInHierarchy;
    }

    public class MonoBehaviour : Behaviour
    {
    }

    public class Renderer : Component
    {
        public Material sharedMaterial { get; set; }

        public bool enabled { get; set; } = true;
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

        public float widthMultiplier { get; set; } = 1f;

        public int positionCount
        {
            get => _positions.Length;
            set => Array.Resize(ref _positions, value);
        }

        public void SetPositions(Vector3[] positions) =>
            Array.Copy(positions, _positions, Math.Min(positions.Length, _positions.Length));

        public Vector3 GetPosition(int index) => _positions[index];
    }

    public sealed class Rigidbody : Component
    {
        public bool isKinematic { get; set; }

        public void MovePosition(Vector3 position) => transform.position = position;

        public void MoveRotation(Quaternion rot) => transform.rotation = rot;
    }

    public sealed class Camera : Behaviour
    {
        internal static readonly List<Camera> All = new List<Camera>();

        public static Camera main =>
            All.Find(camera => camera != null && camera.gameObject.tag == "MainCamera" && camera.isActiveAndEnabled);

        public float nearClipPlane { get; set; } = 0.3f;
    }

    public sealed class Light : Behaviour
    {
    }
}

namespace UnityEngine.Events
{
    public delegate void UnityAction<T0>(T0 arg0);

    public class UnityEvent<T0>
    {
        private event UnityAction<T0> Listeners;

        public void AddListener(UnityAction<T0> call) => Listeners += call;

        public void Invoke(T0 arg0) => Listeners?.Invoke(arg0);
    }
}
