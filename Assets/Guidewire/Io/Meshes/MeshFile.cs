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
        public static TriangleMesh Read(string file, double scale, IReadOnlyList<Vector3d> rims)
        {
            var vertices = new List<Vector3d>();
            var triangles = new List<int>();
            string extension = Path.GetExtension(file).ToLowerInvariant();
            if (extension != ".obj" && extension != ".stl" && !Directory.Exists(file))
            {
                throw new ParameterException(file + ": needs a name that ends in .obj or .stl");
            }
            byte[] bytes = PlainFile.ReadBytes(file, "a mesh file");
            string? problem = extension == ".obj" ? ObjReader.Read(bytes, vertices, triangles)
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
    }
}
