using System;
using System.Collections.Generic;

namespace UnityEngine.Rendering
{
    public enum BlendMode
    {
        Zero = 0,
        One = 1,
        SrcAlpha = 5,
        OneMinusSrcAlpha = 10,
    }

    public abstract class RenderPipelineAsset : ScriptableObject
    {
        public virtual Shader defaultShader => null;
    }

    public static class GraphicsSettings
    {
        public static RenderPipelineAsset currentRenderPipeline { get; internal set; }
    }

    public enum IndexFormat
    {
        UInt16,
        UInt32,
    }
}

namespace UnityEngine
{
    public enum TextureWrapMode
    {
        Repeat,
        Clamp,
        Mirror,
        MirrorOnce,
    }

    public class Texture : Object
    {
        public TextureWrapMode wrapMode { get; set; }
    }

    public sealed class Texture2D : Texture
    {
        private readonly int _pixels;

        public Texture2D(int width, int height)
        {
            _pixels = width * height;
        }

        public void SetPixels32(Color32[] colors)
        {
            if (colors.Length != _pixels)
            {
                throw new UnityException("SetPixels32: invalid number of pixels");
            }
        }

        public void Apply()
        {
        }
    }

    public sealed class Shader : Object
    {
        public static Shader Find(string name) => new Shader { name = name };
    }

    /// <summary>A material's properties are those of its shader; what it has not is not set.</summary>
    public sealed class Material : Object
    {
        private static readonly Dictionary<string, string[]> Properties = new Dictionary<string, string[]>
        {
            ["Guidewire/Surface"] = new[] { "_Color", "_MainTex", "_SrcBlend", "_DstBlend", "_ZWrite" },
            ["Universal Render Pipeline/Lit"] = new[]
            {
                "_BaseColor", "_BaseMap", "_Color", "_MainTex", "_Surface", "_SrcBlend", "_DstBlend", "_ZWrite",
            },
            ["HDRP/Lit"] = new[]
            {
                "_BaseColor", "_BaseColorMap", "_Color", "_MainTex", "_SurfaceType", "_SrcBlend", "_DstBlend",
                "_AlphaDstBlend", "_ZWrite",
            },
        };

        private readonly Dictionary<string, object> _values = new Dictionary<string, object>();
        private readonly HashSet<string> _keywords = new HashSet<string>();

        public Material(Shader shader)
        {
            this.shader = shader is null ? throw new ArgumentNullException(nameof(shader)) : shader;
        }

        public Material(Material source)
        {
            if (source is null)
            {
                throw new ArgumentNullException(nameof(source));
            }
            shader = source.shader;
            renderQueue = source.renderQueue;
            foreach (KeyValuePair<string, object> value in source._values)
            {
                _values[value.Key] = value.Value;
            }
            _keywords.UnionWith(source._keywords);
        }

        public Shader shader { get; set; }

        public int renderQueue { get; set; } = 2000;

        public Color color
        {
            get => (Color)(Value("_BaseColor") ?? Value("_Color") ?? new Color(1f, 1f, 1f));
            set => SetColor(HasProperty("_BaseColor") ? "_BaseColor" : "_Color", value);
        }

        public Texture mainTexture
        {
            get => (Texture)(Value("_BaseMap") ?? Value("_BaseColorMap") ?? Value("_MainTex"));
            set => SetTexture("_MainTex", value);
        }

        public bool HasProperty(string name) =>
            Properties.TryGetValue(shader.name, out string[] names) && Array.IndexOf(names, name) >= 0;

        public void SetColor(string name, Color value) => Set(name, value);

        public void SetFloat(string name, float value) => Set(name, value);

        public void SetTexture(string name, Texture value) => Set(name, value);

        public void SetOverrideTag(string tag, string val)
        {
        }

        public void EnableKeyword(string keyword) => _keywords.Add(keyword);

        public bool IsKeywordEnabled(string keyword) => _keywords.Contains(keyword);

        private object Value(string name) => _values.TryGetValue(name, out object value) ? value : null;

        private void Set(string name, object value)
        {
            if (HasProperty(name))
            {
                _values[name] = value;
            }
        }
    }

    /// <summary>Keeps what it is given, and refuses what Unity refuses.</summary>
    public sealed class Mesh : Object
    {
        private Vector3[] _vertices = Array.Empty<Vector3>();
        private Vector3[] _normals = Array.Empty<Vector3>();
        private int[] _triangles = Array.Empty<int>();

        public Rendering.IndexFormat indexFormat { get; set; }

        public bool isReadable { get; internal set; } = true;

        public int vertexCount => _vertices.Length;

        public Vector3[] vertices => (Vector3[])_vertices.Clone();

        public Vector3[] normals => (Vector3[])_normals.Clone();

        public int[] triangles => (int[])_triangles.Clone();

        public void MarkDynamic()
        {
        }

        public void SetVertices(Vector3[] inVertices) => Copy(inVertices, ref _vertices);

        public void SetNormals(Vector3[] inNormals)
        {
            Check(inNormals.Length, "normals");
            Copy(inNormals, ref _normals);
        }

        public void SetUVs(int channel, Vector2[] uvs) => Check(uvs.Length, "uvs");

        public void SetTriangles(int[] triangles, int submesh)
        {
            foreach (int index in triangles)
            {
                if (index < 0 || index >= _vertices.Length)
                {
                    throw new UnityException("Failed setting triangles: an index is out of bounds");
                }
                if (indexFormat == Rendering.IndexFormat.UInt16 && index > ushort.MaxValue)
                {
                    throw new UnityException("Failed setting triangles: an index needs 32 bits");
                }
            }
            Copy(triangles, ref _triangles);
        }

        public void RecalculateBounds()
        {
        }

        public void RecalculateNormals() => Copy(new Vector3[_vertices.Length], ref _normals);

        private static void Copy<T>(T[] from, ref T[] to)
        {
            if (to.Length != from.Length)
            {
                to = new T[from.Length];
            }
            Array.Copy(from, to, from.Length);
        }

        private void Check(int length, string what)
        {
            if (length != _vertices.Length)
            {
                throw new UnityException("Mesh." + what + " is out of bounds: " + _vertices.Length + " vertices");
            }
        }
    }

    public sealed class UnityException : Exception
    {
        public UnityException(string message)
            : base(message)
        {
        }
    }

    public static class Graphics
    {
        public static void DrawMesh(Mesh mesh, Matrix4x4 matrix, Material material, int layer)
        {
            if (mesh == null || material == null)
            {
                throw new ArgumentNullException(mesh == null ? nameof(mesh) : nameof(material));
            }
            UnityStubs.Engine.Draw(mesh, matrix, material, layer);
        }
    }

    /// <summary>The materials of the package's folder Resources.</summary>
    public static class Resources
    {
        public static T Load<T>(string path)
            where T : Object => UnityStubs.SceneFile.Resource(path) as T;

        public static T[] FindObjectsOfTypeAll<T>()
            where T : Component => UnityStubs.Engine.FindAll<T>();
    }

    public static class QualitySettings
    {
        public static int vSyncCount { get; set; } = 1;
    }

    public static class Screen
    {
        public static int width => 1280;

        public static int height => 720;

        public static float dpi { get; internal set; } = 96f;
    }
}
