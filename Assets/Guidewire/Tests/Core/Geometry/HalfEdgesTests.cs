using System;
using System.Collections.Generic;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Pairs of half-edges against a table of all edges, and merged vertices against all pairs.</summary>
    internal sealed class HalfEdgesTests
    {
        [Test]
        public void Pair_JoinsTheTwoHalfEdgesOfEachEdge()
        {
            var random = new RandomGeometry(47);
            for (int i = 0; i < RandomGeometry.Cases(2_000); i++)
            {
                // Few vertices, so that edges of one, two and more triangles are among them.
                int vertexCount = 4 + random.Index(12);
                var triangles = new List<int>();
                for (int t = 0; t < 1 + random.Index(20); t++)
                {
                    triangles.AddRange(Enumerable.Range(0, vertexCount).OrderBy(_ => random.Number(0.0, 1.0)).Take(3));
                }
                int[] others = HalfEdges.Pair(triangles.ToArray(), vertexCount, out int crowded);
                var edges = Enumerable.Range(0, triangles.Count).GroupBy(h => (
                    Math.Min(triangles[h], triangles[HalfEdges.Next(h)]),
                    Math.Max(triangles[h], triangles[HalfEdges.Next(h)]))).ToArray();
                Assert.That(crowded, Is.EqualTo(edges.Sum(edge => Math.Max(0, edge.Count() - 2))), "case " + i);
                foreach (int[] edge in edges.Select(edge => edge.ToArray()))
                {
                    Assert.That(others[edge[0]], Is.EqualTo(edge.Length > 1 ? edge[1] : -1), "case " + i);
                    Assert.That(edge.Length < 2 || others[edge[1]] == edge[0], "case " + i);
                    Assert.That(edge.Skip(2).Select(h => others[h]), Is.All.EqualTo(-1), "case " + i);
                }
            }
        }

        [Test]
        public void Join_MergesVerticesThatAreEqual_OrWithinTheTolerance()
        {
            var random = new RandomGeometry(53);
            for (int i = 0; i < RandomGeometry.Cases(2_000); i++)
            {
                var vertices = new List<Vector3d> { new Vector3d(-1.0, -1.0, -1.0), new Vector3d(1.0, 1.0, 1.0) };
                double tolerance = 2.0 * VertexWeld.RelativeTolerance; // of a box with sides of 2
                for (int k = 0; k < 30; k++)
                {
                    Vector3d near = vertices[random.Index(vertices.Count)];
                    double apart = random.Index(2) == 0 ? 0.0 : random.Number(0.1, 0.9) * tolerance;
                    vertices.Add(random.Index(3) == 0 ? random.Point() : near + apart * random.Direction());
                }
                int[] index = VertexWeld.Join(vertices.ToArray(), out Vector3d[] kept);
                int[] first = Groups(vertices, tolerance * (1.0 + 1e-6));
                Assert.That(kept, Has.Length.EqualTo(first.Distinct().Count()), "case " + i);
                for (int k = 0; k < first.Length; k++)
                {
                    Assert.That(index[k], Is.EqualTo(index[first[k]]), "case " + i);
                    Assert.That(kept[index[k]], Is.EqualTo(vertices[first[k]]), "case " + i);
                }
            }
        }

        // The first vertex of each one's group, by comparing all pairs until nothing changes.
        private static int[] Groups(List<Vector3d> vertices, double tolerance)
        {
            int[] first = Enumerable.Range(0, vertices.Count).ToArray();
            for (bool isChanged = true; isChanged;)
            {
                isChanged = false;
                for (int a = 0; a < first.Length; a++)
                {
                    for (int b = 0; b < first.Length; b++)
                    {
                        if (first[b] < first[a] && Vector3d.Distance(vertices[a], vertices[b]) <= tolerance)
                        {
                            first[a] = first[b];
                            isChanged = true;
                        }
                    }
                }
            }
            return first;
        }
    }
}
