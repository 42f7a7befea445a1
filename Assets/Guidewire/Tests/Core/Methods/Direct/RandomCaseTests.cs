using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Rest shapes from the straight start under random loads, without a ramp: seeded campaigns of 1,000
    /// cases with a potential and 500 without, a tenth of them by default.</summary>
    public sealed class RandomCaseTests
    {
        private const double LargestResidual = 1e-6;  // of EI/L^2 + load

        [Test]
        public void TipForces_InAnyDirection_EndInAMinimum()
        {
            int count = Rods.InFull ? 500 : 50;
            var random = new System.Random(1);
            for (int i = 0; i < count; i++)
            {
                int n = random.Next(15, 121);
                Vector3d force = LogUniform(random) * Rods.BendForce * Direction(random);
                Check("force " + i, n, force, Vector3d.Zero, true);
            }
        }

        [Test]
        public void ForceAndMomentInAPlane_EndInAMinimum()
        {
            int count = Rods.InFull ? 500 : 50;
            var random = new System.Random(2);
            for (int i = 0; i < count; i++)
            {
                int n = random.Next(15, 121);
                double across = 2.0 * Math.PI * random.NextDouble();
                var normal = new Vector3d(Math.Cos(across), Math.Sin(across), 0.0);
                Vector3d any = Direction(random);
                Vector3d inPlane = Vector3d.Normalize(any - Vector3d.Dot(any, normal) * normal);
                Vector3d force = LogUniform(random) * Rods.BendForce * inPlane;
                double moment = (2.0 * random.NextDouble() - 1.0) * 4.0 * Math.PI * Rods.BendStiffness / Rods.Length;
                Check("plane " + i, n, force, moment * normal, true);
            }
        }

        [Test]
        public void MomentThatTurnsWithTheTip_EndsInAHelixExactly()
        {
            // Without a force, and with GJ = EI, every section carries the couple m along its own axes: the strain
            // m/EI is even, so element j is turned by exp of (j + 1/2) l m/EI. Beyond m L/EI = 3.6 it flutters.
            int count = Rods.InFull ? 100 : 20;
            var random = new System.Random(3);
            for (int i = 0; i < count; i++)
            {
                int n = random.Next(15, 121);
                Vector3d moment = 3.5 * random.NextDouble() * Rods.BendStiffness / Rods.Length * Direction(random);
                MaterialRod rod = Rods.Wire(n);
                Array.Copy(rod.BendStiffness1, rod.TwistStiffness, n);
                RodShape shape = Rods.AtRest(rod, new RodSupports { Clamp = ClampRule.HalfElement }, Vector3d.Zero,
                    Vector3d.Zero, moment);
                Vector3d strain = moment / Rods.BendStiffness;
                for (int j = 0; j < n; j++)
                {
                    Quaterniond expected = RotationVector.Exp((j + 0.5) / n * Rods.Length * strain);
                    Assert.That(RotationVector.Log(expected.Conjugate * shape.Q[j]).Length, Is.LessThan(1e-8),
                        "case " + i + ", element " + j);
                }
            }
        }

        [Test]
        public void ForceAndMomentInSpace_EndAtRestOrFail()
        {
            // The couple has no potential here, and a wire under a large one never rests: then the answer is a failure
            // with a reason. What is called converged is in balance and comes back when disturbed. A dense
            // eigen-decomposition in Python looks at the same.
            int count = Rods.InFull ? 500 : 10;
            var random = new System.Random(4);
            int converged = 0;
            for (int i = 0; i < count; i++)
            {
                int n = random.Next(15, 121);
                double k = LogUniform(random);
                Vector3d force = k * Rods.BendForce * Direction(random);
                double couple = 4.0 * Math.PI * random.NextDouble();
                Vector3d moment = couple * Rods.BendStiffness / Rods.Length * Direction(random);
                bool rests = Check("space " + i, n, force, moment, false);
                converged += rests ? 1 : 0;
                Assert.That(rests || couple > 1.0, "case " + i + ": a couple below EI/L has a rest shape");
            }
            Assert.That(converged, Is.GreaterThan(count / 3));
        }

        [TestCase(1.0)]
        [TestCase(10.0)]
        [TestCase(100.0)]
        public void SelfWeight_InAnyDirection_EndsInAMinimum(double k)
        {
            var random = new System.Random(5);
            for (int i = 0; i < 10; i++)
            {
                MaterialRod rod = Rods.Wire(random.Next(15, 121));
                Vector3d gravity = k * Rods.BendForce / (Rods.Density * Rods.Area * Rods.Length) * Direction(random);
                var rodTerms = new RodTerms(rod, new RodSupports());
                rodTerms.Loads.Set(gravity, Vector3d.Zero);
                EquilibriumResult result = new RodStatics(rodTerms).Solve(Rods.Straight(rod), 1e-9, 500);
                Assert.That(result.Converged, Is.True, "case " + i + ": " + result.Reason);
                Assert.That(result.SmallestEigenvalue, Is.GreaterThan(0.0));
            }
        }

        private static bool Check(string name, int n, in Vector3d force, in Vector3d moment, bool hasPotential)
        {
            MaterialRod rod = Rods.Wire(n);
            RodShape shape = Rods.Straight(rod);
            var supports = new RodSupports();
            var rodTerms = new RodTerms(rod, supports);
            rodTerms.Loads.Set(Vector3d.Zero, force);
            rodTerms.Followers.Moment.Moment = moment;
            EquilibriumResult result = new RodStatics(rodTerms).Solve(shape, 1e-9, 500);
            if (!hasPotential && !result.Converged)
            {
                Assert.That(result.Reason, Does.Contain("tipMoment"), name);
                return false;
            }
            Assert.That(result.Converged, Is.True, name + ": " + result.Reason);
            Assert.That(result.SmallestEigenvalue, Is.GreaterThan(0.0), name);
            Assert.That(Unbalanced(rod, supports, rodTerms, shape), Is.LessThan(LargestResidual), name);
            for (int j = 0; j < n; j++)
            {
                Quaterniond before = j == 0 ? shape.ProximalFrame : shape.Q[j - 1];
                Assert.That(RotationVector.Log(before.Conjugate * shape.Q[j]).Length, Is.LessThan(0.9 * Math.PI), name);
            }
            return true;
        }

        /// <summary>Largest force on a free node, or couple on an element over L, over EI/L^2 + load.</summary>
        private static double Unbalanced(MaterialRod rod, RodSupports supports, RodTerms rodTerms, RodShape shape)
        {
            var system = new BlockTridiagonal(rod, supports);
            var free = new RodVector[system.VectorCount];
            EnergyTerm[] terms = rodTerms.All;
            system.Gradient(terms, shape, new RodVector[system.VectorCount], free);
            double worst = 0.0;
            foreach (RodVector v in free)
            {
                worst = Math.Max(worst, Math.Sqrt(v.X1 * v.X1 + v.X2 * v.X2 + v.X3 * v.X3));
                worst = Math.Max(worst, Math.Sqrt(v.T1 * v.T1 + v.T2 * v.T2 + v.T3 * v.T3) / Rods.Length);
            }
            return worst / (Rods.BendForce + rodTerms.Loads.Force[rod.ElementCount].Length);
        }

        // From 0.1 to 100.
        private static double LogUniform(System.Random random) => 0.1 * Math.Pow(100.0 / 0.1, random.NextDouble());

        private static Vector3d Direction(System.Random random)
        {
            double z = 2.0 * random.NextDouble() - 1.0;
            double angle = 2.0 * Math.PI * random.NextDouble();
            double r = Math.Sqrt(1.0 - z * z);
            return new Vector3d(r * Math.Cos(angle), r * Math.Sin(angle), z);
        }
    }
}
