using System;
using System.Collections.Generic;
using System.IO;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Reads a vessel's triangles from an OBJ or STL file (text or binary) and makes a wall of them.</summary>
    public static class MeshFile
    {
        private const long LargestFile = 1L << 30;

        /// <summary>The wall in a file, in units of the scene.</summary>
        /// <param name="file">A file whose name ends in .obj or .stl.</param>
        /// <param name="scale">Units of the scene per unit of the file.</param>
        /// <param name="rims">A point near the middle of each rim that may be open, in the file's own units.</param>
        /// <exception cref="ParameterException">The file cannot be read or holds no such wall.</exception>
        public static TriangleMesh Read(string file, double scale, IReadOnlyList<Vector3d> rims)
        {
            var vertices = new List<Vector3d>();
            var triangles = new List<int>();
            byte[] bytes = ReadBytes(file);
            string extension = Path.GetExtension(file).ToLowerInvariant();
            string? complaint = extension == ".obj" ? ObjReader.Read(bytes, vertices, triangles)
                : extension == ".stl" ? StlReader.Read(bytes, vertices, triangles)
                : "needs a name that ends in .obj or .stl";
            if (complaint != null)
            {
                throw new ParameterException(file + ": " + complaint);
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

        private static byte[] ReadBytes(string file)
        {
            try
            {
                if (new FileInfo(file).Length > LargestFile)
                {
                    throw new ParameterException(file + ": is larger than 1 GiB, more than a mesh may be");
                }
                return File.ReadAllBytes(file);
            }
            catch (IOException error)
            {
                bool missing = error is FileNotFoundException || error is DirectoryNotFoundException;
                throw new ParameterException(
                    file + (missing ? ": no such file" : ": cannot be read: " + error.Message));
            }
            catch (UnauthorizedAccessException)
            {
                throw new ParameterException(file + (Directory.Exists(file)
                    ? ": is a folder, a mesh file is needed" : ": cannot be read: permission denied"));
            }
        }
    }
}
