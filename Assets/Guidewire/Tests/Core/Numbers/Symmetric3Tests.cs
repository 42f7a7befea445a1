using System;
using Guidewire.Core;
using NUnit.Framework;

namespace Guidewire.Tests
{
    /// <summary>The positive part of a symmetric matrix against what defines it.</summary>
    public class Symmetric3Tests
    {
        private const double Rounding = 2e-14;    // of the largest entry

        /// <summary>P is the nearest matrix to A without negative eigenvalues if and only if neither P nor P - A has
        /// any and the trace of P (P - A) is 0.</summary>
        [TestCase(1.0, 1.0, 1.0)]
        [TestCase(1.0, 1.0, 0.0)]
        [TestCase(1.0, 0.0, 0.0)]
        [TestCase(1.0, 1e-3, -1e-3)]
        [TestCase(1.0, 1e-6, -1e-9)]
        [TestCase(1.0, 1e-9, -1e-6)]
        [TestCase(1.0, 1.0, -1e-12)]
        [TestCase(1.0, -1.0, 0.0)]
        [TestCase(1.0, -1.0, -1.0)]
        [TestCase(-1.0, -1.0, -1.0)]
        [TestCase(-1.0, 0.0, 0.0)]
        [TestCase(0.0, 0.0, 0.0)]
        public void PositivePart_IsTheNearestWithoutNegativeEigenvalues(double first, double second, double third)
        {
            var random = new Random(1);
            for (int k = 0; k < 200; k++)
            {
                Quaterniond frame = Quaterniond.Normalize(new Quaterniond(random.NextDouble() - 0.5,
                    random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5));
                Symmetric3 a = Symmetric3.Outer(first, frame.Director1) + Symmetric3.Outer(second, frame.Director2)
                    + Symmetric3.Outer(third, frame.Director3);
                double scale = Math.Max(Math.Abs(first), Math.Max(Math.Abs(second), Math.Abs(third)));
                Symmetric3 part = a.PositivePart();
                Symmetric3 taken = part + (-1.0) * a;
                foreach (Vector3d d in new[] { frame.Director1, frame.Director2, frame.Director3 })
                {
                    Assert.That(Vector3d.Dot(d, part.Times(d)), Is.GreaterThanOrEqualTo(-Rounding * scale));
                    Assert.That(Vector3d.Dot(d, taken.Times(d)), Is.GreaterThanOrEqualTo(-Rounding * scale));
                    Assert.That(Vector3d.Dot(part.Times(d), taken.Times(d)), Is.EqualTo(0.0).Within(
                        Rounding * scale * scale));
                }
            }
        }
    }
}
