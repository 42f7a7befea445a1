using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.Globalization;
using Guidewire.Core;

namespace Guidewire.Io
{
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
