using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
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
