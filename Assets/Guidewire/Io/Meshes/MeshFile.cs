using System;
using System.Collections.Generic;
using System.IO;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Reads a vessel's triangles from an OBJ or STL file (text or binary) and makes a wall of them.</summary>
    public static class MeshFile
    {
        /// <summary>The wall in a file, in units of the scene.</summary>
        /// <param name="file">A file whose name ends in .obj or .stl.</param>
        /// <param name="scale">Units of the scene per unit of the file.</param>
        /// <param name="rims">A point near the middle of each rim that may be open, in the file's own units.</param>
        /// <exception cref="ParameterException">The file cannot be read or holds no such wall.</exception>
        public static TriangleMesh Read(string file, double scale, IReadOnlyList<Vector3d> rims) =>
            Make(file, ReadBytes(file), scale, rims);

        /// <summary>Whether a name ends as that of a mesh.</summary>
        internal static bool IsNamed(string file) => Extension(file) == ".obj" || Extension(file) == ".stl";

        /// <summary>What stands in a file.</summary>
        /// <exception cref="ParameterException">It cannot be read.</exception>
        internal static byte[] ReadBytes(string file)
        {
            if (!IsNamed(file) && !Directory.Exists(file))
            {
                throw new ParameterException(file + ": needs a name that ends in .obj or .stl");
            }
            return PlainFile.ReadBytes(file, "a mesh file");
        }

        /// <summary>The wall of what was read from a file; see <see cref="Read"/>.</summary>
        internal static TriangleMesh Make(string file, byte[] bytes, double scale, IReadOnlyList<Vector3d> rims)
        {
            var vertices = new List<Vector3d>();
            var triangles = new List<int>();
            string? problem = Extension(file) == ".obj" ? ObjReader.Read(bytes, vertices, triangles)
                : StlReader.Read(bytes, vertices, triangles);
            if (problem != null)
            {
                throw new ParameterException(file + ": " + problem);
            }
            var points = new Vector3d[rims.Count];
            for (int i = 0; i < points.Length; i++)
            {
                points[i] = scale * rims[i];
            }
            try
            {
                return TriangleMesh.Create(
                    Array.ConvertAll(vertices.ToArray(), vertex => scale * vertex), triangles.ToArray(), points);
            }
            catch (MeshException error)
            {
                throw new ParameterException(file + ": " + error.Message);
            }
        }

        private static string Extension(string file) => Path.GetExtension(file).ToLowerInvariant();
    }
}
