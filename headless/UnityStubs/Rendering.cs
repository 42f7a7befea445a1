using System;

namespace UnityEngine.Rendering
{
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

    public sealed class Material : Object
    {
        public Material(Shader shader)
        {
        }

        public Material(Material source)
        {
            if (source is null)
            {
                throw new ArgumentNullException(nameof(source));
            }
            color = source.color;
            mainTexture = source.mainTexture;
        }

        public Color color { get; set; }

        public Texture mainTexture { get; set; }
    }

    /// <summary>Keeps what it is given, and refuses what Unity refuses.</summary>
    public sealed class Mesh : Object
    {
        private Vector3[] _vertices = Array.Empty<Vector3>();
        private Vector3[] _normals = Array.Empty<Vector3>();
        private int[] _triangles = Array.Empty<int>();

        public Rendering.IndexFormat indexFormat { get; set; }

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

        public void RecalculateNormals()
        {
            Copy(new Vector3[_vertices.Length], ref _normals);
        }

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
            UnityStubs.Engine.Draw(matrix, material);
        }
    }

    public static class QualitySettings
    {
        public static int vSyncCount { get; set; } = 1;
    }

    public static class Screen
    {
        public static int width => 1280;

        public static int height => 720;
    }
}
