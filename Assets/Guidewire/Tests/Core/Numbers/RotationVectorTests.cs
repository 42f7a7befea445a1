using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The series for small angles against closed forms that do not cancel, on both sides of where the one
    /// takes over from the other.</summary>
    public sealed class RotationVectorTests
    {
        private const double Rounding = 4e-16;
        private static readonly Vector3d Axis = Vector3d.Normalize(new Vector3d(0.3, -0.5, 0.8));

        [Test]
        public void Exp_IsCosineAndSineOfHalfTheAngle([Values(1e-9, 0.01, 0.1, 0.299999, 0.3, 1.0, 3.1)] double angle)
        {
            Quaterniond q = RotationVector.Exp(angle * Axis);
            Assert.That(q.W, Is.EqualTo(Math.Cos(0.5 * angle)).Within(Rounding));
            Assert.That(Vector3d.Distance(q.Imaginary, Math.Sin(0.5 * angle) * Axis), Is.LessThan(Rounding * angle));
        }

        [Test]
        public void Log_IsTheInverse([Values(1e-9, 0.01, 0.1, 0.2837, 0.2839, 1.0, 3.1)] double angle,
            [Values(1.0, -1.0)] double sign)
        {
            // sin(angle/2)^2 = 0.02 at 0.28380.
            double sine = Math.Sin(0.5 * angle);
            var q = new Quaterniond(sign * sine * Axis.X, sign * sine * Axis.Y, sign * sine * Axis.Z,
                sign * Math.Cos(0.5 * angle));
            Assert.That(Vector3d.Distance(RotationVector.Log(q), angle * Axis), Is.LessThan(2.0 * Rounding * angle));
        }

        [Test]
        public void Cotangent_FactorAndSlope([Values(0.29, 0.2999999, 0.3, 0.31)] double angle)
        {
            // 1 - (a/2) cot(a/2) = a^2/12 loses two digits at these angles; the slope by differences of the factor.
            double half = 0.5 * angle;
            double square = angle * angle;
            double factor = RotationVector.CotangentFactor(square);
            Assert.That(factor, Is.EqualTo((1.0 - half / Math.Tan(half)) / square).Within(1e-13 * factor));
            const double Step = 1e-3;
            double more = RotationVector.CotangentFactor((angle + Step) * (angle + Step));
            double less = RotationVector.CotangentFactor((angle - Step) * (angle - Step));
            double slope = (more - less) / (2.0 * Step * angle);
            Assert.That(RotationVector.CotangentSlope(square, factor), Is.EqualTo(slope).Within(1e-6 * slope));
        }

        [Test]
        public void TangentMap_IsTheBodysTurn([Values(1e-4, 0.1, 0.299999, 0.3, 1.0, 2.5)] double angle)
        {
            // exp(phi)* exp(phi + e u) = exp(e J(phi) u), by central differences.
            var u = new Vector3d(0.7, 0.2, -0.4);
            Vector3d phi = angle * Axis;
            const double Step = 1e-4;
            Quaterniond back = RotationVector.Exp(phi).Conjugate;
            Vector3d turn = RotationVector.Log(back * RotationVector.Exp(phi + Step * u))
                - RotationVector.Log(back * RotationVector.Exp(phi - Step * u));
            Vector3d expected = (0.5 / Step) * turn;
            Assert.That(Vector3d.Distance(RotationVector.TangentMap(phi, u), expected), Is.LessThan(1e-8));
        }
    }
}
