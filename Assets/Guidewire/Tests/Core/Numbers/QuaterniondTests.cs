using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class QuaterniondTests
    {
        private const double Rounding = 1e-14;

        [Test]
        public void Product_TurnsByTheSecondFactorFirst()
        {
            Quaterniond aboutX = Quaterniond.FromAxisAngle(Vector3d.UnitX, Math.PI / 2.0);
            Quaterniond aboutZ = Quaterniond.FromAxisAngle(Vector3d.UnitZ, Math.PI / 2.0);
            // e1 -> e2 by the turn about z, e2 -> e3 by the turn about x.
            Vector3d turned = Quaterniond.Rotate(aboutX * aboutZ, Vector3d.UnitX);
            Assert.That(Vector3d.Distance(turned, Vector3d.UnitZ), Is.LessThan(Rounding));
        }

        [Test]
        public void Directors_AreTheTurnedAxes()
        {
            var random = new Random(1);
            for (int k = 0; k < 100; k++)
            {
                Quaterniond q = Quaterniond.FromAxisAngle(Vector3d.Normalize(Wires.Any(random)),
                    6.0 * random.NextDouble());
                Quaterniond turned = q * Quaterniond.Pure(Vector3d.UnitZ) * q.Conjugate;
                Assert.That(Vector3d.Distance(q.Director3, turned.Imaginary), Is.LessThan(Rounding), "d3 = q e3 q*");
                Assert.That(Vector3d.Distance(q.Director1, Quaterniond.Rotate(q, Vector3d.UnitX)),
                    Is.LessThan(Rounding));
                Assert.That(Vector3d.Distance(q.Director2, Quaterniond.Rotate(q, Vector3d.UnitY)),
                    Is.LessThan(Rounding));
                Assert.That(Vector3d.Distance(Vector3d.Cross(q.Director1, q.Director2), q.Director3),
                    Is.LessThan(Rounding));
            }
        }
    }
}
