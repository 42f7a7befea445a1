using System;
using System.IO;
using System.Text;
using Guidewire.Io;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Mesh files, whole and broken: one clear line for each.</summary>
    internal sealed class MeshFileTests : FolderTests
    {
        [Test]
        public void Cube_ReadsAlike_FromObjTextStlAndBinaryStl()
        {
            TestMeshes cube = TestMeshes.Cube();
            foreach (string file in new[] { Write("a.obj", Obj(cube)), Write("b.stl", TextStl(cube)),
                Write("c.STL", BinaryStl(cube)) })
            {
                TriangleMesh mesh = MeshFile.Read(file, 2.0, Array.Empty<Vector3d>());
                Assert.That(mesh.Report.Triangles, Is.EqualTo(12), file);
                Assert.That(mesh.Report.Vertices, Is.EqualTo(8), file);
                Assert.That(mesh.Report.Volume, Is.EqualTo(64.0).Within(1e-9), file);
            }
        }

        [TestCase("f 1/ 3/ 2/", "f 1 2 4\nf 1 4 3\nf 2 3 4", "", "")]
        [TestCase("f 1// 3//7 2/5", "f 1 2 4\nf 1 4 3\nf -3 -2 -1", "usemtl \n", "")]
        [TestCase("f 1 3 \\\n2", "f 1 2 4\nf 1 4 3\nf 2 3 4", "", "\uFEFF")]
        [TestCase("f 1 3 2", "f 1 2 4 # a comment\r\nf 1 4 3\r\nf 2 3 4\r", "lod 3\nvn 0 0 1\n", "")]
        public void Tetrahedron_IsReadFromEveryKindOfFace(string first, string others, string between, string before)
        {
            byte[] file = Encoding.UTF8.GetBytes(before + "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\n" + between + first
                + "\n" + others + "\n");
            TriangleMesh mesh = MeshFile.Read(Write("a.obj", file), 1.0, Array.Empty<Vector3d>());
            Assert.That(mesh.Report.Triangles, Is.EqualTo(4));
            Assert.That(mesh.Report.Volume, Is.EqualTo(1000.0 / 6.0).Within(1e-9));
        }

        [Test]
        public void Stl_IsReadInCapitals_WithABlankInItsEnds_AndWithBytesBehind()
        {
            TestMeshes cube = TestMeshes.Cube();
            string text = Encoding.ASCII.GetString(TextStl(cube));
            byte[] binary = BinaryStl(cube);
            var tail = new byte[binary.Length + 2];
            binary.CopyTo(tail, 0);
            foreach (byte[] file in new[] { Text(text.ToUpperInvariant()), tail,
                Text(text.Replace("endsolid", "end solid").Replace("endfacet", "end facet")), })
            {
                Assert.That(MeshFile.Read(Write("a.stl", file), 1.0, Array.Empty<Vector3d>()).Report.Triangles,
                    Is.EqualTo(12));
            }
            var longer = new byte[binary.Length + 50];
            binary.CopyTo(longer, 0);
            Refused("b.stl", longer, "as binary STL of 12 triangles it needs 684 bytes and has 734");
        }

        [Test]
        public void BrokenFiles_GiveOneLineThatNamesFileAndFault()
        {
            TestMeshes cube = TestMeshes.Cube();
            byte[] whole = BinaryStl(cube);
            var truncated = new byte[whole.Length - 30];
            Array.Copy(whole, truncated, truncated.Length);
            var garbage = new byte[10_000_000];
            new Random(1).NextBytes(garbage);
            Refused("empty.obj", Array.Empty<byte>(), "is empty");
            Refused("empty.stl", Array.Empty<byte>(), "is empty");
            Refused("one.obj", Text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "not watertight");
            Refused("nan.obj", Text("v 0 0 nan\n"), "line 1 'v 0 0 nan' needs three finite numbers");
            Refused("nan.stl", Text("solid\nfacet\nvertex 0 inf 0\n"), "line 3 'vertex 0 inf 0' needs");
            Refused("index.obj", Text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
                "line 4 'f 1 2 9' needs vertices from 1 to 3");
            Refused("garbage.obj", garbage, "is not a text file");
            Refused("garbage.stl", garbage, "is not STL, or truncated");
            Refused("short.stl", truncated, "truncated: as binary STL of 12 triangles it needs 684 bytes and has 654");
            Refused("facet.stl", Text("solid\nfacet\nvertex 0 0 0\nendfacet\n"),
                "line 4 'endfacet' needs three vertices");
            Refused("mesh.ply", Text("ply"), "needs a name that ends in .obj or .stl");
            Refused("vertices.obj", Text("v 0 0 0\n"), "has no triangles");
            Assert.That(
                () => MeshFile.Read(Path.Combine(Folder, "none.obj"), 1.0, Array.Empty<Vector3d>()),
                Throws.TypeOf<ParameterException>().With.Message.Contains("none.obj: no such file"));
        }

        [Test]
        public void WhatIsNoPlainFile_IsRefusedBeforeItIsRead()
        {
            string folder = Path.Combine(Folder, "folder.obj");
            Directory.CreateDirectory(folder);
            RefusedFile(folder, ": is a folder, a mesh file is needed");
            RefusedFile(Folder, ": is a folder, a mesh file is needed");
            RefusedFile(Path.Combine(Folder, "none"), ": needs a name that ends in .obj or .stl");
            string large = Path.Combine(Folder, "large.stl");
            using (FileStream stream = File.Create(large))
            {
                stream.SetLength(((long)PlainFile.LargestMebibytes << 20) + 1);
            }
            RefusedFile(large, ": holds more than 256 MiB");
        }

        private static void RefusedFile(string file, string message)
        {
            Assert.That(() => MeshFile.Read(file, 1.0, Array.Empty<Vector3d>()),
                Throws.TypeOf<ParameterException>().With.Message.Contains(file + message));
        }

        private void Refused(string name, byte[] bytes, string message)
        {
            string file = Write(name, bytes);
            Assert.That(
                () => MeshFile.Read(file, 1.0, Array.Empty<Vector3d>()),
                Throws.TypeOf<ParameterException>().With.Message.Contains(name + ": ").And.Message.Contains(message)
                    .And.Message.Not.Contains("\n"), name);
        }

        private string Write(string name, byte[] bytes)
        {
            string file = Path.Combine(Folder, name);
            File.WriteAllBytes(file, bytes);
            return file;
        }

        private static byte[] Text(string text) => Encoding.ASCII.GetBytes(text);

        private static byte[] Obj(TestMeshes mesh)
        {
            var text = new StringBuilder("# a cube\n");
            foreach (Vector3d v in mesh.Vertices)
            {
                text.Append("v " + v.X + " " + v.Y + " " + v.Z + "\n");
            }
            for (int t = 0; t < mesh.Triangles.Length; t += 3)
            {
                text.Append("f " + (mesh.Triangles[t] + 1) + "/1 " + (mesh.Triangles[t + 1] + 1) + "//2 -"
                    + (mesh.Vertices.Length - mesh.Triangles[t + 2]) + "\n");
            }
            return Text(text.ToString());
        }

        private static byte[] TextStl(TestMeshes mesh)
        {
            var text = new StringBuilder("solid cube\n");
            for (int t = 0; t < mesh.Corners.Length; t += 3)
            {
                text.Append("facet normal 0 0 0\nouter loop\n");
                for (int k = t; k < t + 3; k++)
                {
                    text.Append("vertex " + mesh.Corners[k].X + " " + mesh.Corners[k].Y + " " + mesh.Corners[k].Z
                        + "\n");
                }
                text.Append("endloop\nendfacet\n");
            }
            return Text(text + "endsolid cube\n");
        }

        private static byte[] BinaryStl(TestMeshes mesh)
        {
            using var stream = new MemoryStream();
            using var writer = new BinaryWriter(stream);
            writer.Write(new byte[80]);
            writer.Write(mesh.Triangles.Length / 3);
            for (int t = 0; t < mesh.Corners.Length; t += 3)
            {
                writer.Write(new byte[12]);
                for (int k = t; k < t + 3; k++)
                {
                    writer.Write((float)mesh.Corners[k].X);
                    writer.Write((float)mesh.Corners[k].Y);
                    writer.Write((float)mesh.Corners[k].Z);
                }
                writer.Write((short)0);
            }
            return stream.ToArray();
        }
    }
}
