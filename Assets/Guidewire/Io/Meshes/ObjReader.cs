using System;
using System.Collections.Generic;
using System.Globalization;
using Guidewire.Core;

namespace Guidewire.Io
{
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
}
