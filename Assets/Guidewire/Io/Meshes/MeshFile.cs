using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.Globalization;
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
            (List<Vector3d> vertices, List<int> triangles) = ReadFaces(file, bytes);
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

        /// <summary>The vertices and triangles of a file as they stand there.</summary>
        /// <exception cref="ParameterException">It cannot be read, or holds none.</exception>
        internal static (List<Vector3d> Vertices, List<int> Triangles) ReadFaces(string file, byte[]? bytes = null)
        {
            bytes ??= ReadBytes(file);
            var vertices = new List<Vector3d>();
            var triangles = new List<int>();
            string? problem = Extension(file) == ".obj" ? ObjReader.Read(bytes, vertices, triangles)
                : StlReader.Read(bytes, vertices, triangles);
            return problem == null ? (vertices, triangles) : throw new ParameterException(file + ": " + problem);
        }

        private static string Extension(string file) => Path.GetExtension(file).ToLowerInvariant();
    }

    /// <summary>Wavefront OBJ: lines "v x y z" and "f i j k ..." with indices from 1, or from the end when negative. A
    /// polygon becomes a fan; what stands behind a slash, groups and materials are ignored.</summary>
    internal static class ObjReader
    {
        private static readonly HashSet<string> PassedOver = new HashSet<string>((
            "vt vn vp g o s l p mg mtllib usemtl maplib usemap cstype deg bmat step curv curv2 surf parm trim hole scrv"
            + " sp end con bevel c_interp d_interp lod shadow_obj trace_obj ctech stech call csh").Split(' '));

        /// <summary>Adds what the file holds; what is wrong with it in one phrase, or null.</summary>
        public static string? Read(byte[] bytes, List<Vector3d> vertices, List<int> triangles)
        {
            if (bytes.Length == 0)
            {
                return "is empty";
            }
            if (!TextLines.IsText(bytes))
            {
                return "is not a text file, as OBJ must be";
            }
            var lines = new TextLines(bytes);
            while (lines.Next())
            {
                string word = lines.Words.Length > 0 ? lines.Words[0] : "";
                string? problem = word == "v" ? lines.ReadVertex(vertices)
                    : word == "f" ? ReadFace(lines, vertices.Count, triangles)
                    : word.Length == 0 || PassedOver.Contains(word) ? null
                    : lines.Error("an OBJ word (v, f, ...)");
                if (problem != null)
                {
                    return problem;
                }
            }
            return triangles.Count == 0 ? "has no triangles" : null;
        }

        private static string? ReadFace(TextLines lines, int count, List<int> triangles)
        {
            string[] words = lines.Words;
            if (words.Length < 4)
            {
                return lines.Error("at least three vertices behind f");
            }
            int first = 0;
            int previous = 0;
            for (int k = 1; k < words.Length; k++)
            {
                int slash = words[k].IndexOf('/');
                string text = slash < 0 ? words[k] : words[k].Substring(0, slash);
                if (!int.TryParse(text, NumberStyles.AllowLeadingSign, CultureInfo.InvariantCulture, out int index)
                    || index == 0 || index > count || index < -count)
                {
                    return lines.Error(count == 0 ? "vertices before it"
                        : "vertices from 1 to " + count.ToString(CultureInfo.InvariantCulture));
                }
                index = index > 0 ? index - 1 : count + index;
                if (k > 2)
                {
                    triangles.Add(first);
                    triangles.Add(previous);
                    triangles.Add(index);
                }
                first = k == 1 ? index : first;
                previous = index;
            }
            return null;
        }
    }

    /// <summary>STL, binary (80 bytes, a count, 50 bytes a triangle, little-endian single precision, less than 50 bytes
    /// behind) or text ("solid", "vertex x y z", small letters or capitals). The normals in the file are ignored: the
    /// order of the corners gives them.</summary>
    internal static class StlReader
    {
        private const int Header = 84;
        private const int Record = 50;

        /// <summary>Adds what the file holds; what is wrong with it in one phrase, or null.</summary>
        public static string? Read(byte[] bytes, List<Vector3d> vertices, List<int> triangles)
        {
            if (bytes.Length == 0)
            {
                return "is empty";
            }

            // Binary files may begin with "solid" too; only their length tells.
            long count = bytes.Length >= Header ? BinaryPrimitives.ReadUInt32LittleEndian(bytes.AsSpan(80)) : -1;
            bool isBinary = count >= 0 && Header + Record * count == bytes.Length;
            if (isBinary)
            {
                return ReadBinary(bytes, (int)count, vertices, triangles);
            }
            if (TextLines.IsText(bytes) && StartsWithSolid(bytes))
            {
                return ReadText(bytes, vertices, triangles);
            }
            long behind = bytes.Length - (Header + Record * count);
            if (count > 0 && behind > 0 && behind < Record)
            {
                return ReadBinary(bytes, (int)count, vertices, triangles);
            }
            return count < 0 ? "is neither text STL (it does not begin with 'solid') nor long enough for binary STL"
                : string.Format(
                    CultureInfo.InvariantCulture,
                    "is not STL, or truncated: as binary STL of {0} triangles it needs {1} bytes and has {2}",
                    count, Header + Record * count, bytes.Length);
        }

        private static string? ReadBinary(byte[] bytes, int count, List<Vector3d> vertices, List<int> triangles)
        {
            for (int t = 0; t < count; t++)
            {
                for (int k = 0; k < 3; k++)
                {
                    Span<byte> at = bytes.AsSpan(Header + Record * t + 12 * (k + 1), 12);
                    var vertex = new Vector3d(Single(at), Single(at.Slice(4)), Single(at.Slice(8)));
                    if (!vertex.IsFinite)
                    {
                        return string.Format(
                            CultureInfo.InvariantCulture, "triangle {0} of {1} has a coordinate that is not finite",
                            t + 1, count);
                    }
                    triangles.Add(vertices.Count);
                    vertices.Add(vertex);
                }
            }
            return count == 0 ? "has no triangles" : null;
        }

        private static double Single(Span<byte> bytes) =>
            BitConverter.Int32BitsToSingle(BinaryPrimitives.ReadInt32LittleEndian(bytes));

        private static bool StartsWithSolid(byte[] bytes)
        {
            var lines = new TextLines(bytes);
            while (lines.Next())
            {
                if (lines.Words.Length > 0)
                {
                    return lines.Words[0].StartsWith("solid", StringComparison.OrdinalIgnoreCase);
                }
            }
            return false;
        }

        private static string? ReadText(byte[] bytes, List<Vector3d> vertices, List<int> triangles)
        {
            var lines = new TextLines(bytes);
            int corners = 0;
            while (lines.Next())
            {
                switch (Word(lines.Words))
                {
                    case "vertex":
                        triangles.Add(vertices.Count);
                        corners++;
                        if (lines.ReadVertex(vertices) is string wrong)
                        {
                            return wrong;
                        }
                        break;
                    case "endfacet":
                        if (corners != 3)
                        {
                            return lines.Error("three vertices before it, and has " + corners);
                        }
                        corners = 0;
                        break;
                    case "":
                    case "solid":
                    case "end":
                    case "facet":
                    case "outer":
                    case "endloop":
                    case "endsolid":
                        break;
                    default:
                        return lines.Error("an STL word (facet, vertex, ...)");
                }
            }
            return corners != 0 ? "ends inside a facet: the file breaks off"
                : triangles.Count == 0 ? "has no triangles" : null;
        }

        // In small letters; some files have a blank in "end facet".
        private static string Word(string[] words)
        {
            string word = words.Length > 0 ? words[0].ToLowerInvariant() : "";
            bool isEndOfFacet = word == "end" && words.Length > 1
                && words[1].Equals("facet", StringComparison.OrdinalIgnoreCase);
            return isEndOfFacet ? "endfacet" : word;
        }
    }
}
