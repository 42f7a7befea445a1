using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Rest shapes against the elastica, closed forms and a published benchmark.</summary>
    public sealed class RestShapeTests
    {
        private const double Gate = 3e-3;  // of L, along the whole shape

        // Inextensible elastica under a dead tip load k = F L^2/EI, by shooting on theta'' = -k cos(theta) with ten
        // digits: (w/L, u/L) of the tip.
        [TestCase(1.0, 0.301720774, 0.0564332363)]
        [TestCase(2.0, 0.493457480, 0.160641721)]
        [TestCase(10.0, 0.810609025, 0.554995598)]
        public void TipLoad_BendsTheElastica(double k, double across, double shortening)
        {
            const int N = 30;
            RodShape shape = Rods.AtRest(Rods.Wire(N), new RodSupports(), Vector3d.Zero,
                new Vector3d(0.0, k * Rods.BendForce, 0.0), Vector3d.Zero);
            Assert.That(shape.X[N].Y / Rods.Length, Is.EqualTo(across).Within(Gate));
            Assert.That(1.0 - shape.X[N].Z / Rods.Length, Is.EqualTo(shortening).Within(Gate));
            Assert.That(shape.X[N].X, Is.EqualTo(0.0).Within(1e-12));
        }

        [TestCase(1.0)]
        [TestCase(10.0)]
        public void TipLoad_BendsTheWholeShape(double k)
        {
            // The elastica integrated here, independently: theta' = kappa, kappa' = -k cos(theta)/L^2, kappa(L) = 0, by
            // bisection on kappa(0) over fourth-order Runge-Kutta steps.
            const int N = 30;
            const int Steps = 100;  // an element
            RodShape shape = Rods.AtRest(Rods.Wire(N), new RodSupports(), Vector3d.Zero,
                new Vector3d(0.0, k * Rods.BendForce, 0.0), Vector3d.Zero);
            double curvature = Bisection.Limit(0.0, 20.0, first =>
            {
                Elastica(k, first, N * Steps, null, out double end);
                return end <= 0.0;
            });
            var points = new Vector3d[N * Steps + 1];
            Elastica(k, curvature, N * Steps, points, out _);
            for (int i = 0; i <= N; i++)
            {
                double miss = Vector3d.Distance(shape.X[i] / Rods.Length, points[i * Steps]);
                Assert.That(miss, Is.LessThan(Gate), "node " + i);
            }
        }

        // Heavy elastica, g = 9.81, from its boundary value problem (nine digits): z and y of the tip, m.
        [TestCase(0.5e-3, 0.299446369, -0.0170399963)]
        [TestCase(0.2e-3, 0.281225454, -0.0975643958)]
        public void OwnWeight_BendsTheHeavyElastica(double radius, double along, double down)
        {
            const int N = 30;
            MaterialRod rod = MaterialRod.Round(N, Rods.Length, radius, Rods.Young, Rods.Shear, Rods.Density);
            RodShape shape = Rods.AtRest(rod, new RodSupports(), new Vector3d(0.0, -9.81, 0.0), Vector3d.Zero,
                Vector3d.Zero);
            Assert.That(shape.X[N].Z, Is.EqualTo(along).Within(Gate * Rods.Length));
            Assert.That(shape.X[N].Y, Is.EqualTo(down).Within(Gate * Rods.Length));
        }

        [TestCase(0.5)]
        [TestCase(1.0)]
        [TestCase(2.0)]
        [TestCase(4.0)]
        public void EndMoment_BendsAnArc(double halfTurns)
        {
            // theta = M L/EI; the couple turns the wire about -x, so it rises into +y. Half-element clamp: every angle
            // is exact; the tip misses by the chords' (kappa l)^2/24.
            const int N = 30;
            double theta = halfTurns * Math.PI;
            RodShape shape = Rods.AtRest(Rods.Wire(N), new RodSupports { Clamp = ClampRule.HalfElement }, Vector3d.Zero,
                Vector3d.Zero, new Vector3d(-theta * Rods.BendStiffness / Rods.Length, 0.0, 0.0));
            for (int j = 0; j < N; j++)
            {
                Quaterniond expected = Quaterniond.FromAxisAngle(-Vector3d.UnitX, theta * (j + 0.5) / N);
                double miss = RotationVector.Log(expected.Conjugate * shape.Q[j]).Length;
                Assert.That(miss, Is.LessThan(1e-9), "element " + j);
            }
            double chord = theta / N * (theta / N) / 24.0;
            Vector3d tip = Arc(theta, Rods.Length);
            double error = Vector3d.Distance(shape.X[N], tip) / Rods.Length;
            Assert.That(error, Is.LessThan(1.1 * chord + 1e-9));
            if (halfTurns <= 2.0)
            {
                Assert.That(error, Is.LessThan(1e-3));
            }
        }

        [Test]
        public void EndMoment_WithTheDarbouxLaw_IsOfOrderTwo()
        {
            double coarse = DarbouxError(45);
            double fine = DarbouxError(90);
            Assert.That(Math.Log(coarse / fine) / Math.Log(2.0), Is.EqualTo(2.0).Within(0.1));
            Assert.That(fine, Is.LessThan(1e-3));
        }

        [Test]
        public void CoupleBeyondTheDarbouxLaw_Fails()
        {
            // K sin(angle) carries no more than K = EI/l.
            const int N = 10;
            MaterialRod rod = Rods.Wire(N);
            var rodTerms = new RodTerms(rod,
                new RodSupports { Bend = BendLaw.Darboux, Clamp = ClampRule.HalfElement });
            rodTerms.Followers.Moment.Moment = new Vector3d(1.1 * Rods.BendStiffness * N / Rods.Length, 0.0, 0.0);
            EquilibriumResult result = new RodStatics(rodTerms).Solve(Rods.Straight(rod), 1e-10, 300);
            Assert.That(result.Converged, Is.False);
            Assert.That(result.Reason, Is.Not.Empty);
        }

        [Test]
        public void TurnedEnd_TwistsEvenly()
        {
            // Torque GJ phi/L, angle linear along the wire.
            const int N = 30;
            const double Turn = 0.5 * Math.PI;
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports { Distal = DistalEnd.Clamped, Clamp = ClampRule.HalfElement };
            RodShape shape = Rods.Straight(rod);
            shape.DistalFrame = Quaterniond.FromAxisAngle(Vector3d.UnitZ, Turn);
            var rodTerms = new RodTerms(rod, supports);
            EquilibriumResult result = new RodStatics(rodTerms).Solve(shape, 1e-11, 100);
            Assert.That(result.Converged, Is.True, result.Reason);
            double torque = Rods.TwistStiffness * Turn / Rods.Length;
            Assert.That(rodTerms.Bending.DistalCouple(shape).Z, Is.EqualTo(torque).Within(1e-3 * torque));
            Assert.That(rodTerms.Bending.ProximalCouple(shape).Z, Is.EqualTo(-torque).Within(1e-3 * torque));
            for (int j = 0; j < N; j++)
            {
                Assert.That(RotationVector.Log(shape.Q[j]).Z, Is.EqualTo(Turn * (j + 0.5) / N).Within(1e-6));
            }
        }

        [Test]
        public void FortyFiveDegreeBend_IsThePublishedOne()
        {
            // Bathe and Bolourchi 1979: arc of radius 100 over 45 degrees, unit square section, E = 1e7, nu = 0, load
            // 600 out of its plane; tip at (15.685, 47.150, 53.475) with J = 1/6 (here G J = 0.5e7/6).
            const int N = 40;
            const double R = 100.0;
            double length = R * Math.PI / 4.0;
            var rod = new MaterialRod(N);
            for (int j = 0; j < N; j++)
            {
                rod.Length[j] = length / N;
                rod.StretchStiffness[j] = 1e7;
                rod.ShearStiffness[j] = 0.5e7;
                rod.BendStiffness1[j] = 1e7 / 12.0;
                rod.BendStiffness2[j] = 1e7 / 12.0;
                rod.TwistStiffness[j] = 0.5e7 / 6.0;
                rod.LineDensity[j] = 1.0;
                rod.RotaryInertia1[j] = 1.0;
                rod.RotaryInertia2[j] = 1.0;
                rod.RestCurvature[j] = new Vector3d(-1.0 / R, 0.0, 0.0);
            }
            // The half-element clamp keeps the unloaded arc an arc.
            var supports = new RodSupports { Clamp = ClampRule.HalfElement };
            RodShape shape = Rods.AtRest(rod, supports, Vector3d.Zero, Vector3d.Zero, Vector3d.Zero);
            Vector3d free = Arc(Math.PI / 4.0, length);
            Assert.That(Vector3d.Distance(shape.X[N], free), Is.LessThan(1e-3 * length), "the unloaded arc");
            var rodTerms = new RodTerms(rod, supports);
            rodTerms.Loads.Set(Vector3d.Zero, new Vector3d(600.0, 0.0, 0.0));
            EquilibriumResult result = new RodStatics(rodTerms).Solve(shape, 1e-10, 200);
            Assert.That(result.Converged, Is.True, result.Reason);
            // Ours: across the bend y, along z, load x.
            Assert.That(shape.X[N].Y, Is.EqualTo(15.685).Within(0.01 * 15.685));
            Assert.That(shape.X[N].Z, Is.EqualTo(47.150).Within(0.01 * 47.150));
            Assert.That(shape.X[N].X, Is.EqualTo(53.475).Within(0.01 * 53.475));
        }

        [Test]
        public void BentTip_KeepsItsBendWithoutLoad()
        {
            const int N = 40;
            MaterialRod rod = Rods.Wire(N);
            for (int j = 30; j < N; j++)
            {
                rod.SetRound(j, 0.2e-3, 20e9, 8e9, Rods.Density);
                rod.RestCurvature[j] = new Vector3d(-20.0, 0.0, 0.0);
            }
            RodShape shape = Rods.AtRest(rod, new RodSupports(), Vector3d.Zero, Vector3d.Zero, Vector3d.Zero);
            // The joint at the border stands for half an element of either piece.
            double angle = 20.0 * (Rods.Length / N) * (10.0 - 0.5);
            Assert.That(-RotationVector.Log(shape.Q[N - 1]).X, Is.EqualTo(angle).Within(1e-9));
            Assert.That(shape.X[30].Y, Is.EqualTo(0.0).Within(1e-12));
        }

        private static double DarbouxError(int n)
        {
            const double Theta = 2.0 * Math.PI;
            RodShape shape = Rods.AtRest(Rods.Wire(n),
                new RodSupports { Clamp = ClampRule.HalfElement, Bend = BendLaw.Darboux }, Vector3d.Zero, Vector3d.Zero,
                new Vector3d(-Theta * Rods.BendStiffness / Rods.Length, 0.0, 0.0));
            return Vector3d.Distance(shape.X[n], Vector3d.Zero) / Rods.Length;
        }

        /// <summary>End of an arc that starts along z and rises into y.</summary>
        private static Vector3d Arc(double theta, double length)
        {
            double radius = length / theta;
            return new Vector3d(0.0, radius * (1.0 - Math.Cos(theta)), radius * Math.Sin(theta));
        }

        /// <summary>Unit length; writes (0, w, z) where points are asked for.</summary>
        private static void Elastica(double k, double startCurvature, int steps, Vector3d[]? points,
            out double endCurvature)
        {
            double h = 1.0 / steps;
            double theta = 0.0;
            double kappa = startCurvature;
            double y = 0.0;
            double z = 0.0;
            for (int i = 0; i < steps; i++)
            {
                double a1 = kappa;
                double b1 = -k * Math.Cos(theta);
                double a2 = kappa + 0.5 * h * b1;
                double b2 = -k * Math.Cos(theta + 0.5 * h * a1);
                double a3 = kappa + 0.5 * h * b2;
                double b3 = -k * Math.Cos(theta + 0.5 * h * a2);
                double a4 = kappa + h * b3;
                double b4 = -k * Math.Cos(theta + h * a3);
                double middle = theta + 0.5 * h * a2;
                double next = theta + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
                y += h / 6.0 * (Math.Sin(theta) + 4.0 * Math.Sin(middle) + Math.Sin(next));
                z += h / 6.0 * (Math.Cos(theta) + 4.0 * Math.Cos(middle) + Math.Cos(next));
                theta = next;
                kappa += h / 6.0 * (b1 + 2.0 * b2 + 2.0 * b3 + b4);
                if (points != null)
                {
                    points[i + 1] = new Vector3d(0.0, y, z);
                }
            }
            endCurvature = kappa;
        }
    }
}
