using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The places of meshes against enumeration over all their triangles, edges and corners.</summary>
    internal sealed class MeshContactPointTests
    {
        private const double Tolerance = 1e-9;
        // Of two distances that are one; by the square of what a foot is off an edge they differ by less than that of
        // two feet 1e-7 apart.
        private const double Equal = 1e-14;
        private const double Doubtful = 1e-6;

        private static readonly string[] Names = { "cube", "bumpy ball", "open tube" };

        [TestCaseSource(nameof(Names))]
        public void Places_AreThoseOfAllFacesEdgesAndCorners_LessWhatCancels(string name)
        {
            TestMeshes mesh = Make(name);
            var shape = new MeshShape(mesh.Build(Rims(name)));
            var random = new RandomGeometry(61);
            var places = new StructList<ContactPoint>(1);
            int tested = 0;
            int cases = RandomGeometry.Cases(2_000);
            for (int i = 0; i < cases; i++)
            {
                Vector3d x = random.Point();
                double range = random.Number(0.05, 0.6);
                List<Expected>? expected = Enumerate(mesh, x, range);
                if (expected == null)
                {
                    continue;
                }
                tested++;
                places.Clear();
                shape.FindContactPoints(x, range, default, places);
                Assert.That(places.Count, Is.EqualTo(expected.Count), "case " + i);
                foreach (Expected place in expected)
                {
                    int same = 0;
                    for (int k = 0; k < places.Count; k++)
                    {
                        Vector3d[] point = { places[k].Contact.Point };
                        bool isSame = places[k].Weight == place.Weight
                            && Math.Abs(Math.Abs(places[k].Contact.Distance) - place.Distance) < Tolerance
                            && BruteForce.Distance(point, place.Feature) < Tolerance;
                        same += isSame ? 1 : 0;
                    }
                    Assert.That(same, Is.EqualTo(1), "case " + i);
                }
            }
            Assert.That(tested, Is.GreaterThan(0.9 * cases));
        }

        [Test]
        public void Places_DoNotDependOnTheOrderOfTheTriangles()
        {
            TestMeshes mesh = TestMeshes.Ball(7, 0.3);
            var random = new RandomGeometry(62);
            int[] triangles = mesh.Triangles;
            for (int t = triangles.Length / 3 - 1; t > 0; t--)
            {
                int other = random.Index(t + 1);
                for (int k = 0; k < 3; k++)
                {
                    (triangles[3 * t + k], triangles[3 * other + k]) = (triangles[3 * other + k], triangles[3 * t + k]);
                }
            }
            var shape = new MeshShape(mesh.Build());
            var shuffled = new MeshShape(TriangleMesh.Create(mesh.Vertices, triangles, Array.Empty<Vector3d>()));
            var first = new StructList<ContactPoint>(1);
            var second = new StructList<ContactPoint>(1);
            int most = 0;
            for (int i = 0; i < RandomGeometry.Cases(20_000); i++)
            {
                Vector3d x = random.Point();
                first.Clear();
                second.Clear();
                shape.FindContactPoints(x, 0.3, default, first);
                shuffled.FindContactPoints(x, 0.3, default, second);
                Assert.That(Sorted(second), Is.EqualTo(Sorted(first)), "case " + i);
                most = Math.Max(most, first.Count);
            }
            Assert.That(most, Is.GreaterThan(5));
        }

        [Test]
        public void FlatWall_HoweverFinelyCut_ListsWhatThePlaneLists()
        {
            TestMeshes mesh = TestMeshes.Cube();
            for (int k = 0; k < 3; k++)
            {
                mesh = mesh.CutInFour();
            }
            var shape = new MeshShape(mesh.Build());
            var plane = new PlaneShape(-1.0 * Vector3d.UnitZ, Vector3d.UnitZ);
            var random = new RandomGeometry(63);
            var cut = new StructList<ContactPoint>(1);
            var whole = new StructList<ContactPoint>(1);
            for (int i = 0; i < RandomGeometry.Cases(20_000); i++)
            {
                Vector3d x = NearTheBottom(random);
                cut.Clear();
                whole.Clear();
                shape.FindContactPoints(x, 0.4, default, cut);
                plane.FindContactPoints(x, 0.4, default, whole);
                Assert.That(cut.Count, Is.EqualTo(1), "case " + i);
                Assert.That(cut[0].Weight, Is.EqualTo(1), "case " + i);
                Assert.That(cut[0].Curvature, Is.Zero, "case " + i);
                Vector3d difference = cut[0].Contact.Point - whole[0].Contact.Point;
                Assert.That(difference.Length, Is.LessThan(Tolerance), "case " + i);
            }
        }

        [Test]
        public void Valley_CountsBothFeet_LessTheEdgeBetween()
        {
            // Near the cube's edge y = z = -1, seen from its middle.
            var shape = new MeshShape(TestMeshes.Cube().Build());
            var places = new StructList<ContactPoint>(1);
            var x = new Vector3d(0.3, -0.9, -0.8);
            shape.FindContactPoints(x, 0.5, default, places);
            Assert.That(places.Count, Is.EqualTo(3));
            Assert.That(places[0].Weight + places[1].Weight, Is.EqualTo(2));
            Assert.That(
                new[] { places[0].Contact.Distance, places[1].Contact.Distance },
                Is.EquivalentTo(new[] { 0.1, 0.2 }).Using<double>((p, q) => Math.Abs(p - q) < Tolerance ? 0 : 1));
            Assert.That(places[2].Weight, Is.EqualTo(-1));
            Assert.That(places[2].Contact.Distance, Is.EqualTo(Math.Sqrt(0.05)).Within(Tolerance));
            Assert.That(places[2].CrossCurvature, Is.EqualTo(1.0 / Math.Sqrt(0.05)).Within(1e-6));
            Assert.That(Math.Abs(places[2].Direction.X), Is.EqualTo(1.0).Within(Tolerance));
        }

        // Within 0.4 of the cube's bottom and farther than that from its sides.
        private static Vector3d NearTheBottom(RandomGeometry random) =>
            new Vector3d(random.Number(-0.5, 0.5), random.Number(-0.5, 0.5), random.Number(-0.99, -0.7));

        private static TestMeshes Make(string name)
        {
            return name == "cube" ? TestMeshes.Cube() : name == "bumpy ball" ? TestMeshes.Ball(5, 0.4)
                : TestMeshes.Tube(7, 2, 1.5);
        }

        private static Vector3d[] Rims(string name)
        {
            return name == "open tube"
                ? new[] { Vector3d.Zero, new Vector3d(0.0, 0.0, 1.5) } : Array.Empty<Vector3d>();
        }

        [Test]
        public void PointIsOutside_HoweverFarItIs()
        {
            var shape = new MeshShape(TestMeshes.Tube(8, 4, 5.0).Build(Vector3d.Zero, new Vector3d(0.0, 0.0, 5.0)));
            Assert.That(shape.Contains(new Vector3d(0.0, 0.0, 2.5)), Is.True);
            foreach (double far in new[] { 1e3, 1e100, 1.4e154, 1e300 })
            {
                Assert.That(shape.Contains(new Vector3d(0.0, far, 2.5)), Is.False, far.ToString());
            }
        }

        private sealed class Expected
        {
            public Vector3d[] Feature = Array.Empty<Vector3d>();
            public double Distance;
            public int Weight;
        }

        // Inclusion and exclusion over all triangles, edges of two triangles and corners inside the surface, each with
        // the smallest of its own corners, edges and face that is as near. Null where a choice is in doubt.
        private static List<Expected>? Enumerate(TestMeshes mesh, in Vector3d x, double range)
        {
            var point = new[] { x };
            Vector3d[] vertices = mesh.Vertices;
            var simplices = new SortedDictionary<string, (int[] Corners, int Count, double Distance)>();
            int[] triangles = mesh.Triangles;
            var rim = new HashSet<int>();
            for (int t = 0; t < triangles.Length; t += 3)
            {
                for (int mask = 1; mask < 8; mask++)
                {
                    int[] corners = Array.FindAll(
                        new[] { 0, 1, 2 }, k => (mask >> k & 1) == 1);
                    corners = Array.ConvertAll(corners, k => triangles[t + k]);
                    Array.Sort(corners);
                    string key = string.Join(",", corners);
                    int count = simplices.TryGetValue(key, out var known) ? known.Count : 0;
                    double distance = count > 0 ? known.Distance
                        : BruteForce.Distance(point, Array.ConvertAll(corners, v => vertices[v]));
                    simplices[key] = (corners, count + 1, distance);
                }
            }
            foreach (var simplex in simplices.Values)
            {
                if (simplex.Corners.Length == 2 && simplex.Count == 1)
                {
                    rim.UnionWith(simplex.Corners);
                }
            }
            var weights = new SortedDictionary<string, int>();
            foreach (var simplex in simplices.Values)
            {
                int size = simplex.Corners.Length;
                bool isShared = size == 3 || (size == 2 ? simplex.Count == 2 : !rim.Contains(simplex.Corners[0]));
                if (Math.Abs(simplex.Distance - range) < Doubtful)
                {
                    return null;
                }
                if (!isShared || simplex.Distance > range)
                {
                    continue;
                }
                string? nearest = null;
                for (int n = 1; n <= size && nearest == null; n++)
                {
                    foreach (string key in simplices.Keys)
                    {
                        var part = simplices[key];
                        bool isPart = Array.TrueForAll(part.Corners, v => Array.IndexOf(simplex.Corners, v) >= 0);
                        if (part.Corners.Length != n || !isPart)
                        {
                            continue;
                        }
                        double more = part.Distance - simplex.Distance;
                        if (more < Equal)
                        {
                            nearest = key;
                            break;
                        }
                        if (more < Doubtful)
                        {
                            return null;
                        }
                    }
                }
                weights.TryGetValue(nearest!, out int weight);
                weights[nearest!] = weight + (size == 2 ? -1 : 1);
            }
            var places = new List<Expected>();
            foreach (string key in weights.Keys)
            {
                if (weights[key] != 0)
                {
                    places.Add(new Expected
                    {
                        Feature = Array.ConvertAll(simplices[key].Corners, v => vertices[v]),
                        Distance = simplices[key].Distance,
                        Weight = weights[key],
                    });
                }
            }
            return places;
        }

        private static List<(double, double, Vector3d, int)> Sorted(StructList<ContactPoint> places)
        {
            var sorted = new List<(double, double, Vector3d, int)>();
            for (int k = 0; k < places.Count; k++)
            {
                SurfaceContact contact = places[k].Contact;
                sorted.Add((contact.Distance, contact.Position, contact.Point, places[k].Weight));
            }
            sorted.Sort((p, q) => (p.Item1, p.Item2, p.Item3.X, p.Item3.Y, p.Item3.Z).CompareTo(
                (q.Item1, q.Item2, q.Item3.X, q.Item3.Y, q.Item3.Z)));
            return sorted;
        }
    }
}
