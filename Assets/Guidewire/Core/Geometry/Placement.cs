using System;
using System.Collections.Generic;

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
}
