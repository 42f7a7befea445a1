using System;

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
}
