using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Placement of a vessel: x -> position + R (scale x), with the scale along the vessel's own
    /// axes.</summary>
    public readonly struct Placement
    {
        private readonly Quaterniond _orientation;
        private readonly Vector3d _scale;
        private readonly Vector3d _position;

        /// <summary>The placement with this position (units), orientation (of unit length) and scale (no component 0;
        /// negative ones mirror).</summary>
        public Placement(in Vector3d position, in Quaterniond orientation, in Vector3d scale)
        {
            _position = position;
            _orientation = orientation;
            _scale = scale;
        }

        /// <summary>Leaves everything where it is.</summary>
        public static Placement Identity =>
            new Placement(Vector3d.Zero, Quaterniond.Identity, new Vector3d(1.0, 1.0, 1.0));

        /// <summary>True when the vessel is mirrored, which turns its triangles inside out.</summary>
        public bool Mirrors => _scale.X * _scale.Y * _scale.Z < 0.0;

        /// <summary>Where the point stands.</summary>
        public Vector3d Apply(in Vector3d x) => _position + ApplyToWay(x);

        /// <summary>What a displacement of the vessel becomes.</summary>
        public Vector3d ApplyToWay(in Vector3d way) =>
            Quaterniond.Rotate(_orientation, new Vector3d(_scale.X * way.X, _scale.Y * way.Y, _scale.Z * way.Z));

        /// <summary>What a rotation vector of the vessel becomes, with factors of one size (<see cref="IsUniform"/>).
        /// </summary>
        public Vector3d ApplyToTurn(in Vector3d turn) =>
            ((Mirrors ? -1.0 : 1.0) / System.Math.Abs(_scale.X)) * ApplyToWay(turn);

        /// <summary>Whether the factors are of one size.</summary>
        public bool IsUniform => System.Math.Abs(_scale.X) == System.Math.Abs(_scale.Y)
            && System.Math.Abs(_scale.X) == System.Math.Abs(_scale.Z);

        /// <summary>The orientation of Euler angles in degrees, in Unity's order: about z first, then x, then y, all
        /// about the fixed axes.</summary>
        public static Quaterniond FromEulerDegrees(in Vector3d degrees)
        {
            const double Radians = System.Math.PI / 180.0;
            return Quaterniond.FromAxisAngle(Vector3d.UnitY, Radians * degrees.Y)
                * Quaterniond.FromAxisAngle(Vector3d.UnitX, Radians * degrees.X)
                * Quaterniond.FromAxisAngle(Vector3d.UnitZ, Radians * degrees.Z);
        }
    }

    /// <summary>A smooth displacement of a vessel: along each axis a sum of three waves, one along each axis, as
    /// long as the diagonal of its box. x_i -> x_i + (0.08/k) sum_j c_ij sin(k (x_j - m_j)), k = 2 pi/diagonal, m the
    /// middle of
    /// the box.</summary>
    /// <remarks>With |c_ij| at most 1 its gradient differs from the identity by at most 0.24, in the norm of the
    /// largest row sum: it is one to one, and no walls meet.</remarks>
    public sealed class SmoothWarp : IEquatable<SmoothWarp>
    {
        private const double Strain = 0.08;

        private readonly double[] _coefficients;

        /// <param name="coefficients">Nine from -1 to 1: of the displacement along x the waves along x, y and z, then
        /// along y, then along z.</param>
        public SmoothWarp(double[] coefficients)
        {
            _coefficients = coefficients;
        }

        /// <summary>Gives the points where it moves them.</summary>
        /// <param name="points">All vertices of a vessel, units.</param>
        public Vector3d[] Apply(IReadOnlyList<Vector3d> points)
        {
            Extents box = Extents.Of(points);
            Vector3d middle = 0.5 * (box.Low + box.High);
            double wave = 2.0 * Math.PI / (box.High - box.Low).Length;
            double size = Strain / wave;
            var moved = new Vector3d[points.Count];
            for (int i = 0; i < moved.Length; i++)
            {
                Vector3d phase = wave * (points[i] - middle);
                double x = Math.Sin(phase.X);
                double y = Math.Sin(phase.Y);
                double z = Math.Sin(phase.Z);
                moved[i] = points[i] + size * new Vector3d(Sum(0, x, y, z), Sum(3, x, y, z), Sum(6, x, y, z));
            }
            return moved;
        }

        /// <inheritdoc/>
        public bool Equals(SmoothWarp? other) =>
            other != null && _coefficients.AsSpan().SequenceEqual(other._coefficients);

        /// <inheritdoc/>
        public override bool Equals(object? obj) => Equals(obj as SmoothWarp);

        /// <inheritdoc/>
        public override int GetHashCode() => _coefficients[0].GetHashCode();

        private double Sum(int from, double x, double y, double z) =>
            _coefficients[from] * x + _coefficients[from + 1] * y + _coefficients[from + 2] * z;
    }

    /// <summary>The box along the axes around some points or a wall, units.</summary>
    internal readonly struct Extents
    {
        /// <summary>The least coordinates.</summary>
        public readonly Vector3d Low;

        /// <summary>The largest coordinates.</summary>
        public readonly Vector3d High;

        /// <summary>Makes the box between two corners.</summary>
        public Extents(in Vector3d low, in Vector3d high)
        {
            Low = low;
            High = high;
        }

        /// <summary>The box's longest side.</summary>
        public double LargestSide => Math.Max(High.X - Low.X, Math.Max(High.Y - Low.Y, High.Z - Low.Z));

        /// <summary>The box around points, at least one.</summary>
        public static Extents Of(IReadOnlyList<Vector3d> points)
        {
            Vector3d low = points[0];
            Vector3d high = points[0];
            foreach (Vector3d p in points)
            {
                low = new Vector3d(Math.Min(low.X, p.X), Math.Min(low.Y, p.Y), Math.Min(low.Z, p.Z));
                high = new Vector3d(Math.Max(high.X, p.X), Math.Max(high.Y, p.Y), Math.Max(high.Z, p.Z));
            }
            return new Extents(low, high);
        }

        /// <summary>The box around a wall, for a tube without the continuation beyond its open ends; null for a plane,
        /// which is infinite.</summary>
        public static Extents? Of(ContactShape wall)
        {
            switch (wall)
            {
                case MeshShape mesh:
                    return Of(mesh.Wall.Corners);
                case TubeShape tube:
                    return OfSpheres(tube.Knots, tube.Radii, tube.FirstKnot, tube.LastKnot);
                case ConvexObstacle obstacle:
                    Extents box = Of(obstacle.Points);
                    Vector3d around = obstacle.Radius * new Vector3d(1.0, 1.0, 1.0);
                    return new Extents(box.Low - around, box.High + around);
                default:
                    return null;
            }
        }

        /// <summary>Gives both corners, to four digits.</summary>
        public override string ToString()
        {
            return string.Format(
                CultureInfo.InvariantCulture, "from ({0:G4}, {1:G4}, {2:G4}) to ({3:G4}, {4:G4}, {5:G4})",
                Low.X, Low.Y, Low.Z, High.X, High.Y, High.Z);
        }

        private static Extents OfSpheres(Vector3d[] centres, double[] radii, int first, int last)
        {
            var corners = new List<Vector3d>();
            for (int i = first; i <= last; i++)
            {
                Vector3d around = radii[i] * new Vector3d(1.0, 1.0, 1.0);
                corners.Add(centres[i] - around);
                corners.Add(centres[i] + around);
            }
            return Of(corners);
        }
    }
}
