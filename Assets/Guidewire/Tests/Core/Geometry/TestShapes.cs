using System;
using System.Collections.Generic;
using System.Globalization;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Walls of every kind.</summary>
    internal static class TestShapes
    {
        /// <summary>Names that <see cref="Make"/> knows.</summary>
        public static readonly string[] Names =
        {
            "plane", "tube", "wavy tube", "cube", "bumpy ball", "open tube", "sphere", "capsule", "box", "hull",
            "cone", "cylinder", "sac",
        };

        private static readonly double[] StraightRadii = { 0.8, 0.8 };
        private static readonly double[] WavyRadii = { 0.5, 0.7, 0.4, 0.6 };

        /// <summary>The wall of that name, of size 1 about the origin.</summary>
        public static ContactShape Make(string name)
        {
            var random = new RandomGeometry(36);
            switch (name)
            {
                case "plane":
                    return new PlaneShape(0.2 * random.Point(), random.Direction());
                case "tube":
                    return new TubeShape(
                        new[] { -2.0 * Vector3d.UnitZ, 2.0 * Vector3d.UnitZ }, StraightRadii, true, true);
                case "wavy tube":
                    return new TubeShape(
                        new[]
                        {
                            new Vector3d(0.0, 0.0, -1.2), new Vector3d(0.1, 0.0, -0.3), new Vector3d(0.5, 0.2, 0.4),
                            new Vector3d(0.2, 0.8, 1.1),
                        },
                        WavyRadii, true, false);
                case "sac":
                    // A ball behind a short neck: its first pieces hold the crease between neck and cone.
                    var knots = new Vector3d[9];
                    var radii = new double[9];
                    for (int i = 0; i < 9; i++)
                    {
                        double angle = Math.PI * (0.75 - 0.0625 * (i - 2));
                        knots[i] = new Vector3d(0.0, 0.0, i < 2 ? 1.2 * i - 2.1 : 0.8 * Math.Cos(angle));
                        radii[i] = i < 2 ? 0.25 : 0.8 * Math.Sin(angle);
                    }
                    return new TubeShape(knots, radii, true, false);
                case "cube":
                    return new MeshShape(TestMeshes.Cube().Build());
                case "bumpy ball":
                    return new MeshShape(TestMeshes.Ball(9, 0.4).Build());
                case "open tube":
                    return new MeshShape(
                        TestMeshes.Tube(16, 8, 6.0).Build(Vector3d.Zero, new Vector3d(0.0, 0.0, 6.0)),
                        new Placement(new Vector3d(0.0, 0.0, -3.0), Quaterniond.Identity, new Vector3d(1.0, 1.0, 1.0)));
                case "sphere":
                    return ConvexObstacle.Sphere(0.2 * random.Point(), 0.4);
                case "capsule":
                    return ConvexObstacle.Capsule(0.5 * random.Point(), 0.5 * random.Point(), 0.3);
                case "box":
                    return ConvexObstacle.Box(
                        0.2 * random.Point(), new Vector3d(0.3, 0.5, 0.7), random.Orientation());
                case "cone":
                    return ConeShape.Cone(0.5 * random.Point(), 0.5 * random.Point(), 0.1, 0.3);
                case "cylinder":
                    return ConeShape.Cylinder(0.2 * random.Point(), random.Direction(), 0.3);
                default:
                    var points = new Vector3d[20];
                    for (int i = 0; i < points.Length; i++)
                    {
                        points[i] = 0.6 * random.Point();
                    }
                    return new ConvexObstacle(points, 0.05);
            }
        }
    }

    /// <summary>Closed and open surfaces with known insides, as vertices and triangles.</summary>
    internal sealed class TestMeshes
    {
        private readonly List<Vector3d> _vertices = new List<Vector3d>();
        private readonly List<int> _triangles = new List<int>();

        public Vector3d[] Vertices => _vertices.ToArray();

        public int[] Triangles => _triangles.ToArray();

        public Vector3d[] Corners => Array.ConvertAll(Triangles, i => _vertices[i]);

        /// <summary>The cube from -1 to 1.</summary>
        public static TestMeshes Cube()
        {
            var mesh = new TestMeshes();
            for (int k = 0; k < 8; k++)
            {
                mesh._vertices.Add(new Vector3d((k & 1) * 2 - 1, (k & 2) - 1, (k & 4) / 2 - 1));
            }
            mesh.Quad(0, 1, 3, 2);
            mesh.Quad(4, 6, 7, 5);
            mesh.Quad(0, 4, 5, 1);
            mesh.Quad(2, 3, 7, 6);
            mesh.Quad(0, 2, 6, 4);
            mesh.Quad(1, 5, 7, 3);
            return mesh;
        }

        /// <summary>A closed sphere whose radius varies by <paramref name="bumps"/>: with dents, so that edges and
        /// corners point both ways. 2 rings (rings - 1) 2 triangles.</summary>
        public static TestMeshes Ball(int rings, double bumps)
        {
            var mesh = new TestMeshes();
            int around = 2 * rings;
            mesh._vertices.Add(new Vector3d(0.0, 0.0, 1.0));
            mesh._vertices.Add(new Vector3d(0.0, 0.0, -1.0));
            for (int i = 1; i < rings; i++)
            {
                for (int k = 0; k < around; k++)
                {
                    double theta = Math.PI * i / rings;
                    double phi = 2.0 * Math.PI * k / around;
                    double r = 1.0 + bumps * Math.Sin(3.0 * phi) * Math.Sin(theta) * Math.Sin(4.0 * theta);
                    mesh._vertices.Add(new Vector3d(
                        r * Math.Sin(theta) * Math.Cos(phi), r * Math.Sin(theta) * Math.Sin(phi), r * Math.Cos(theta)));
                }
            }
            for (int k = 0; k < around; k++)
            {
                int next = (k + 1) % around;
                mesh.Triangle(0, 2 + k, 2 + next);
                mesh.Triangle(1, 2 + (rings - 2) * around + next, 2 + (rings - 2) * around + k);
                for (int i = 0; i + 2 < rings; i++)
                {
                    int first = 2 + i * around;
                    mesh.Quad(first + k, first + around + k, first + around + next, first + next);
                }
            }
            return mesh;
        }

        /// <summary>A tube of radius 1 along z from 0 to <paramref name="length"/>, open at both ends.</summary>
        public static TestMeshes Tube(int around, int rows, double length) => Tube(around, rows, length, z => 1.0);

        /// <summary>A tube along z from 0 to <paramref name="length"/>, open at both ends, with a radius that depends
        /// on z.</summary>
        public static TestMeshes Tube(int around, int rows, double length, Func<double, double> radius)
        {
            var mesh = new TestMeshes();
            for (int i = 0; i <= rows; i++)
            {
                for (int k = 0; k < around; k++)
                {
                    double phi = 2.0 * Math.PI * k / around;
                    double z = length * i / rows;
                    double r = radius(z);
                    mesh._vertices.Add(new Vector3d(r * Math.Cos(phi), r * Math.Sin(phi), z));
                }
            }
            mesh.JoinRows(around, rows);
            return mesh;
        }

        /// <summary>A pipe of circles about places on a line in the y z plane, open at both ends; a corner of each lies
        /// in that plane on either side.</summary>
        /// <param name="places">Centres of the circles.</param>
        /// <param name="turns">How far the line has turned from z towards y there, radians.</param>
        /// <param name="around">Corners of a circle, an even number.</param>
        public static TestMeshes Pipe(Vector3d[] places, double[] turns, double radius, int around)
        {
            var mesh = new TestMeshes();
            for (int i = 0; i < places.Length; i++)
            {
                var inPlane = new Vector3d(0.0, Math.Cos(turns[i]), -Math.Sin(turns[i]));
                for (int k = 0; k < around; k++)
                {
                    double phi = 2.0 * Math.PI * k / around;
                    mesh._vertices.Add(places[i]
                        + radius * (Math.Cos(phi) * inPlane + Math.Sin(phi) * Vector3d.UnitX));
                }
            }
            mesh.JoinRows(around, places.Length - 1);
            return mesh;
        }

        /// <summary>The same surface with every triangle cut in four at the middles of its edges.</summary>
        public TestMeshes CutInFour()
        {
            var mesh = new TestMeshes();
            mesh._vertices.AddRange(_vertices);
            for (int t = 0; t < _triangles.Count; t += 3)
            {
                int i = _triangles[t];
                int j = _triangles[t + 1];
                int k = _triangles[t + 2];
                int ij = mesh.Vertex(0.5 * (_vertices[i] + _vertices[j]));
                int jk = mesh.Vertex(0.5 * (_vertices[j] + _vertices[k]));
                int ki = mesh.Vertex(0.5 * (_vertices[k] + _vertices[i]));
                mesh.Triangle(i, ij, ki);
                mesh.Triangle(ij, j, jk);
                mesh.Triangle(ki, jk, k);
                mesh.Triangle(ij, jk, ki);
            }
            return mesh;
        }

        public void Triangle(int i, int j, int k)
        {
            _triangles.Add(i);
            _triangles.Add(j);
            _triangles.Add(k);
        }

        public int Vertex(in Vector3d vertex)
        {
            _vertices.Add(vertex);
            return _vertices.Count - 1;
        }

        public void Remove(int triangle) => _triangles.RemoveRange(3 * triangle, 3);

        public void Turn(int triangle)
        {
            int i = _triangles[3 * triangle];
            _triangles[3 * triangle] = _triangles[3 * triangle + 1];
            _triangles[3 * triangle + 1] = i;
        }

        public TriangleMesh Build(params Vector3d[] rims) => TriangleMesh.Create(Vertices, Triangles, rims);

        /// <summary>How often the closed surface winds around a point: the sum of the solid angles of its triangles
        /// (Van Oosterom and Strackee 1983) over 4 pi.</summary>
        public double WindingNumber(in Vector3d p)
        {
            double sum = 0.0;
            for (int t = 0; t < _triangles.Count; t += 3)
            {
                Vector3d a = _vertices[_triangles[t]] - p;
                Vector3d b = _vertices[_triangles[t + 1]] - p;
                Vector3d c = _vertices[_triangles[t + 2]] - p;
                double bottom = a.Length * b.Length * c.Length + Vector3d.Dot(a, b) * c.Length
                    + Vector3d.Dot(b, c) * a.Length + Vector3d.Dot(c, a) * b.Length;
                sum += 2.0 * Math.Atan2(Vector3d.Dot(a, Vector3d.Cross(b, c)), bottom);
            }
            return sum / (4.0 * Math.PI);
        }

        private void JoinRows(int around, int rows)
        {
            for (int i = 0; i < rows; i++)
            {
                for (int k = 0; k < around; k++)
                {
                    int next = (k + 1) % around;
                    Quad(i * around + k, i * around + next, (i + 1) * around + next, (i + 1) * around + k);
                }
            }
        }

        private void Quad(int i, int j, int k, int l)
        {
            Triangle(i, j, k);
            Triangle(i, k, l);
        }
    }

    /// <summary>Seeded random points and figures of size 1, among them the awkward ones.</summary>
    internal sealed class RandomGeometry
    {
        private readonly Random _random;

        public RandomGeometry(int seed)
        {
            _random = new Random(seed);
        }

        /// <summary>How many cases to try: all of them when the environment variable GUIDEWIRE_ALL is set, otherwise
        /// one of so many, by default of ten.</summary>
        public static int Cases(int all, int oneOf = 10) =>
            string.IsNullOrEmpty(Environment.GetEnvironmentVariable("GUIDEWIRE_ALL")) ? all / oneOf : all;

        /// <summary>The first of so many cases to try of all, each day the next ones: the environment variable
        /// GUIDEWIRE_DAY is the number of the day.</summary>
        public static int FirstOfTheDay(int count, int all)
        {
            string day = Environment.GetEnvironmentVariable("GUIDEWIRE_DAY") ?? "0";
            return count * (int.Parse(day, CultureInfo.InvariantCulture) % (all / count));
        }

        /// <summary>Draws 100,000 cases, or a tenth of them, and asserts that no error of one exceeds the
        /// tolerance.</summary>
        public static void AssertErrors(int seed, double tolerance, Func<RandomGeometry, double> error)
        {
            var random = new RandomGeometry(seed);
            double worst = 0.0;
            for (int i = 0; i < Cases(100_000); i++)
            {
                worst = Math.Max(worst, error(random));
            }
            Assert.That(worst, Is.LessThan(tolerance));
        }

        public double Number(double from, double to) => from + (to - from) * _random.NextDouble();

        public int Index(int count) => _random.Next(count);

        /// <summary>A point in the cube from -1 to 1.</summary>
        public Vector3d Point() => new Vector3d(Number(-1.0, 1.0), Number(-1.0, 1.0), Number(-1.0, 1.0));

        public Vector3d Direction()
        {
            while (true)
            {
                Vector3d v = Point();
                if (v.Length > 0.1 && v.Length <= 1.0)
                {
                    return Vector3d.Normalize(v);
                }
            }
        }

        public Quaterniond Orientation() => Quaterniond.FromAxisAngle(Direction(), Number(0.0, 2.0 * Math.PI));

        /// <summary>A triangle; one in four is a needle, down to a height of 1e-12.</summary>
        public Vector3d[] Triangle()
        {
            var triangle = new[] { Point(), Point(), Point() };
            if (Index(4) == 0)
            {
                double height = Math.Pow(10.0, Number(-12.0, -1.0));
                triangle[2] = Vector3d.Lerp(triangle[0], triangle[1], Number(-0.2, 1.2)) + height * Direction();
            }
            return triangle;
        }

        /// <summary>A segment; one in four is nearly parallel to the direction given, one in eight has no length.
        /// </summary>
        public Vector3d[] Segment(in Vector3d direction)
        {
            Vector3d a = Point();
            switch (Index(8))
            {
                case 0:
                case 1:
                    Vector3d along = Number(-1.0, 1.0) * direction;
                    return new[] { a, a + along + Math.Pow(10.0, Number(-16.0, -2.0)) * Direction() };
                case 2:
                    return new[] { a, a };
                default:
                    return new[] { a, Point() };
            }
        }
    }
}
