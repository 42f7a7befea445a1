using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Which equilibria count as rest shapes where stiffness varies along the wire or between its axes: those
    /// that buckle do not, and neutral motions do not stand in the way.</summary>
    public sealed class EquilibriumStabilityTests
    {
        private const int N = 30;
        private const double Tolerance = 1e-9;

        /// <summary>A soft piece of length a on a stiff base carries a stiff piece of length b and a thrust P at its
        /// top: y'''' + k^2 y'' = 0 in the soft piece, k^2 = P/EI, and its top leans as the stiff piece turns, so
        /// k a tan(k a) = a/b; pi/2 where b = 0.</summary>
        [Test]
        public void SoftPiece_UnderThrust_BucklesAtItsOwnLoad(
            [Values(1e2, 1e3, 1e4, 1e5, 1e6, 1e7)] double ratio,
            [Values("0 15", "8 22", "15 30")] string piece,
            [Values(0.9, 1.1, 1.5)] double load)
        {
            int from = int.Parse(piece.Split(new[] { ' ' })[0]);
            int to = int.Parse(piece.Split(new[] { ' ' })[1]);
            MaterialRod rod = SoftBetween(from, to, ratio);
            double soft = (to - from) * Rods.Length / N;
            double above = (N - to) * Rods.Length / N;
            double critical = Critical(soft, above);
            double thrust = load * critical * critical / (soft * soft) * rod.BendStiffness1[from];
            RodTerms terms = Terms(rod, new RodSupports(), Vector3d.Zero, -thrust * Vector3d.UnitZ);
            RodShape shape = Rods.Straight(rod);
            EquilibriumResult result = new RodStatics(terms).Solve(shape, Tolerance, 500);
            Assert.That(result.Converged, Is.True, result.Reason);
            double lean = Math.Acos(Math.Min(1.0, shape.Q[N - 1].Director3.Z));
            if (load < 1.0)
            {
                Assert.That(lean, Is.LessThan(1e-6), "straight below its load");
            }
            else
            {
                Assert.That(lean, Is.GreaterThan(0.3), "bent above it");
            }
        }

        /// <summary>Michell and Prandtl: a strip clamped at one end, with a force across its soft axis at the tip,
        /// leaves its plane at 4.0126 sqrt(EI2 GJ)/(L^2 sqrt((1 - EI2/EI1)(1 - GJ/EI1))).</summary>
        [TestCase(10.0)]
        [TestCase(30.0)]
        [TestCase(100.0)]
        public void Strip_LeavesItsPlaneAtPrandtlsForce(double sides)
        {
            MaterialRod rod = Rods.Wire(N);
            double stiff = sides * sides * Rods.BendStiffness;
            for (int j = 0; j < N; j++)
            {
                rod.BendStiffness1[j] = stiff;
                rod.ShearStiffness[j] *= sides * sides;
                rod.StretchStiffness[j] *= sides * sides;
            }
            double bent = Math.Sqrt((1.0 - Rods.BendStiffness / stiff) * (1.0 - Rods.TwistStiffness / stiff));
            double critical = 4.0126 * Math.Sqrt(Rods.BendStiffness * Rods.TwistStiffness)
                / (Rods.Length * Rods.Length * bent);
            Assert.That(Aside(rod, 0.97 * critical), Is.LessThan(1e-6), "below");
            Assert.That(Aside(rod, 1.05 * critical), Is.GreaterThan(0.1), "above");
        }

        [Test]
        public void FreeRods_AreAtRest_HoweverTheyLie([Values(1.0, 1e2, 1e4, 1e7)] double ratio,
            [Values(0.0, 8.0)] double curvature)
        {
            MaterialRod rod = Curved(SoftBetween(N / 2, N, ratio), curvature);
            RodTerms terms = Terms(rod, new RodSupports { Proximal = ProximalEnd.Free }, Vector3d.Zero, Vector3d.Zero);
            EquilibriumResult result = new RodStatics(terms).Solve(Rods.Straight(rod), 1e-6, 100);
            Assert.That(result.Converged, Is.True, result.Reason);
        }

        [Test]
        public void BallJoint_TurnsAboutTheVerticalForNothing([Values(1.0, 1e2, 1e4, 1e7)] double ratio,
            [Values(0.0, 8.0)] double curvature)
        {
            // Hung up from aside, by its own weight.
            MaterialRod rod = Curved(SoftBetween(N / 2, N, ratio), curvature);
            RodTerms terms = Terms(rod, new RodSupports { Proximal = ProximalEnd.Held },
                new Vector3d(0.3, 0.1, 9.81), Vector3d.Zero);
            RodShape shape = Rods.Straight(rod);
            EquilibriumResult result = new RodStatics(terms).Solve(shape, 1e-6, 100);
            Assert.That(result.Converged, Is.True, result.Reason);
            // Its centre of mass is straight below the joint.
            Vector3d moment = Vector3d.Zero;
            for (int i = 0; i <= N; i++)
            {
                moment += Vector3d.Cross(shape.X[i], terms.Loads.Force[i]);
            }
            double weight = terms.Mass.Total * 9.81 * Rods.Length;
            Assert.That(moment.Length, Is.LessThan(1e-5 * weight));
        }

        /// <summary>A wire that stands on a ball joint falls, however small its weight is against its stiffness: its
        /// fall is a rigid rotation, but no neutral one.</summary>
        [Test]
        public void StandingOnABallJoint_IsNoRestShape([Values(1e-1, 1e-3, 1e-5)] double weight)
        {
            MaterialRod rod = Rods.Wire(N);
            RodTerms terms = Terms(rod, new RodSupports { Proximal = ProximalEnd.Held },
                Vector3d.Zero, -weight * Rods.BendForce * Vector3d.UnitZ);
            RodShape shape = Rods.Straight(rod);
            EquilibriumResult result = new RodStatics(terms).Solve(shape, Tolerance, 500);
            Assert.That(!result.Converged || shape.X[N].Z < -0.9 * Rods.Length, Is.True, "fell, or no rest shape");
        }

        /// <summary>Round sections between two clamps on one axis, pushed together: the bent wire turns about the axis
        /// and its sections about themselves, for nothing.</summary>
        [Test]
        public void BentBetweenClamps_TurnsForNothing([Values(1.0, 1e2, 1e3)] double ratio)
        {
            // Softer in every way: a piece that bends far more easily than it shortens is hard to push together. From a
            // wire shortened by a tenth the search takes 52, 88 and 411 iterations.
            MaterialRod rod = SoftBetween(N / 3, N, ratio);
            for (int j = N / 3; j < N; j++)
            {
                rod.StretchStiffness[j] /= ratio;
                rod.ShearStiffness[j] /= ratio;
            }
            var supports = new RodSupports { Distal = DistalEnd.Clamped };
            RodShape shape = Rods.Straight(rod);
            for (int i = 0; i <= N; i++)
            {
                shape.X[i] = 0.9 * shape.X[i];
            }
            EquilibriumResult result = new RodStatics(new RodTerms(rod, supports)).Solve(shape, 1e-6, 500);
            Assert.That(result.Converged, Is.True, result.Reason);
            double aside = 0.0;
            foreach (Vector3d x in shape.X)
            {
                aside = Math.Max(aside, Math.Sqrt(x.X * x.X + x.Y * x.Y));
            }
            Assert.That(aside, Is.GreaterThan(0.1 * Rods.Length));
        }

        private static MaterialRod SoftBetween(int from, int to, double ratio)
        {
            MaterialRod rod = Rods.Wire(N);
            for (int j = from; j < to; j++)
            {
                rod.BendStiffness1[j] /= ratio;
                rod.BendStiffness2[j] /= ratio;
                rod.TwistStiffness[j] /= ratio;
            }
            return rod;
        }

        private static MaterialRod Curved(MaterialRod rod, double curvature)
        {
            for (int j = 0; j < N; j++)
            {
                rod.RestCurvature[j] = curvature * Vector3d.UnitX;
            }
            return rod;
        }

        private static RodTerms Terms(MaterialRod rod, RodSupports supports, in Vector3d gravity, in Vector3d tipForce)
        {
            var terms = new RodTerms(rod, supports);
            terms.Loads.Set(gravity, tipForce);
            return terms;
        }

        // k a of x tan(x) = a/b, by bisection.
        private static double Critical(double a, double b) =>
            Bisection.Limit(0.0, 0.5 * Math.PI, x => b * x * Math.Sin(x) < a * Math.Cos(x));

        // How far the tip of the strip is from its plane at rest, over L.
        private static double Aside(MaterialRod rod, double force)
        {
            RodTerms terms = Terms(rod, new RodSupports(), Vector3d.Zero, force * Vector3d.UnitY);
            RodShape shape = Rods.Straight(rod);
            EquilibriumResult result = new RodStatics(terms).Solve(shape, Tolerance, 500);
            Assert.That(result.Converged, Is.True, result.Reason);
            return Math.Abs(shape.X[N].X) / Rods.Length;
        }
    }
}
