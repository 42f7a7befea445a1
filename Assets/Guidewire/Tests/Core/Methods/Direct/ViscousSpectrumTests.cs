using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Stability under a couple that turns with the tip: the small matrices, and the spectrum of a
    /// rod.</summary>
    public sealed class ViscousSpectrumTests
    {
        [Test]
        public void Inverse_TimesMatrix_IsOne()
        {
            double[,] a = { { 0.0, 2.0, 1.0 }, { 1.0, 0.0, -3.0 }, { 4.0, 1.0, 0.5 } };
            double[,] inverse = SquareMatrix.Inverse(a, out double logOfDeterminant);
            for (int i = 0; i < 3; i++)
            {
                for (int j = 0; j < 3; j++)
                {
                    double sum = 0.0;
                    for (int k = 0; k < 3; k++)
                    {
                        sum += a[i, k] * inverse[k, j];
                    }
                    Assert.That(sum, Is.EqualTo(i == j ? 1.0 : 0.0).Within(1e-14));
                }
            }
            // det = -2 (0.5 + 12) + 1 = -24.
            Assert.That(logOfDeterminant, Is.EqualTo(Math.Log(24.0)).Within(1e-14));
        }

        // Roots -3, 1 + 2i, 1 - 2i, 40: companion matrix of (x + 3)(x^2 - 2 x + 5)(x - 40).
        [TestCase(-3.01, 0)]
        [TestCase(-2.99, 1)]
        [TestCase(0.99, 1)]
        [TestCase(1.01, 3)]
        [TestCase(39.9, 3)]
        [TestCase(40.1, 4)]
        public void EigenvaluesLeftOfALine_AreCounted(double x, int expected)
        {
            double[] cubic = { 15.0, -1.0, 1.0 };  // (x + 3)(x^2 - 2 x + 5) = x^3 + x^2 - x + 15
            double[] c = { -40.0 * cubic[0], cubic[0] - 40.0 * cubic[1], cubic[1] - 40.0 * cubic[2], cubic[2] - 40.0 };
            double[,] companion =
            {
                { 0.0, 0.0, 0.0, -c[0] }, { 1.0, 0.0, 0.0, -c[1] }, { 0.0, 1.0, 0.0, -c[2] }, { 0.0, 0.0, 1.0, -c[3] },
            };
            Assert.That(SquareMatrix.EigenvaluesLeftOf(companion, x), Is.EqualTo(expected));
        }

        [TestCase(1)]
        [TestCase(2)]
        [TestCase(3)]
        [TestCase(60)]
        public void WithoutACouple_TheSmallestRealPartIsTheEnergysSmallestEigenvalue(int n)
        {
            MaterialRod rod = Rods.Wire(n);
            RodShape shape = Rods.Straight(rod);
            var rodTerms = new RodTerms(rod, new RodSupports());
            rodTerms.Loads.Set(Vector3d.Zero, new Vector3d(0.0, -3.0 * Rods.BendForce, 0.0));
            EquilibriumResult result = new RodStatics(rodTerms).Solve(shape, 1e-12, 500);
            EnergyTerm[] terms = rodTerms.All;
            var tangent = new FollowerTangent(rod, new RodSupports(), terms, rodTerms.Followers);
            Assert.That(new ViscousSpectrum(tangent, rod).SmallestRealPart(shape),
                Is.EqualTo(result.SmallestEigenvalue).Within(1e-5 * Rods.BendForce));
        }

        [TestCase(0.0, 3.5, true)]
        [TestCase(0.0, 3.7, false)]
        [TestCase(30.0, 3.7, true)]  // a pull along the tip's tangent calms it
        public void BendingCoupleInSpace_RestsBelowItsFlutterOnly(double pull, double couple, bool rests)
        {
            // 3.60 EI/L from the eigenvalues of the full tangent of the circular arc, by a dense solver in Python.
            MaterialRod rod = Rods.Wire(40);
            var rodTerms = new RodTerms(rod, new RodSupports());
            // A force across the couple's plane, too small to matter, makes it a problem in space.
            rodTerms.Loads.Set(Vector3d.Zero,
                new Vector3d(1e-4 * Rods.BendForce, 0.0, pull * Rods.BendForce));
            rodTerms.Followers.Moment.Moment = new Vector3d(couple * Rods.BendStiffness / Rods.Length, 0.0, 0.0);
            EquilibriumResult result = new RodStatics(rodTerms).Solve(Rods.Straight(rod), 1e-9, 500);
            Assert.That(result.Converged, Is.EqualTo(rests), result.Reason);
            Assert.That(result.Converged ? "tipMoment" : result.Reason, Does.Contain("tipMoment"));
        }

        [Test]
        public void CoupleInSpacePutOnAtOnce_DampedSteps_EndInTheRestShape()
        {
            // Another way to the same shape: 5 s of overdamped motion, each stage solved with its inertia. Damped less,
            // the wire would flutter: eigenvalues a + ib grow in a motion unless the damping exceeds b/sqrt(a).
            SimulationParameters parameters = CoupleInSpace(3.0);
            parameters.Material.MassDamping = 0.5 / parameters.Method.TimeStep;
            parameters.Method.MaxSimulationSteps = 1000;
            RodState moved = Wires.Run(parameters).State;
            parameters.Method.MaxSimulationSteps = 0;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            Simulation rest = Simulation.Create(parameters);
            Assert.That(rest.Outcome, Is.EqualTo(Outcome.Converged), rest.Reason);
            Assert.That(Wires.Distance(moved, rest.State), Is.LessThan(1e-5 * 300.0));
        }

        [Test]
        public void CoupleBeyondFlutter_MovesOn()
        {
            // 4.5 EI/L: no rest shape, but a motion, in steps that turn the tip by radians at first.
            Simulation run = Wires.Finish(CoupleInSpace(4.5));
        }

        [Test]
        public void CoupleAtTheEnd_IsOfSecondOrderInN()
        {
            // Bending, twisting and a force at once, so that the frame turns in space along the last element.
            double[] tip = new double[4];
            for (int k = 0; k < tip.Length; k++)
            {
                SimulationParameters parameters = CoupleInSpace(2.0);
                parameters.Scene.NumberRodElements = 20 << k;
                parameters.Method.MaxSimulationSteps = 0;
                parameters.Scene.InitialState = InitialState.Equilibrium;
                parameters.Scene.TipForce = Rods.BendForce * new Vector3d(1.0, -2.0, 0.0);
                Simulation rest = Simulation.Create(parameters);
                Assert.That(rest.Outcome, Is.EqualTo(Outcome.Converged), rest.Reason);
                tip[k] = rest.State.Positions[20 << k].Y;
            }
            double coarse = tip[1] - tip[0];
            double middle = tip[2] - tip[1];
            double fine = tip[3] - tip[2];
            Assert.That(Math.Log(coarse / middle, 2.0), Is.EqualTo(2.0).Within(0.2));
            Assert.That(Math.Log(middle / fine, 2.0), Is.EqualTo(2.0).Within(0.1));
        }

        private static SimulationParameters CoupleInSpace(double couple)
        {
            SimulationParameters parameters = Rods.Clamped(30, Solver.Direct, 5e-3, 400);
            parameters.Method.Integrator = Integrator.ImplicitEuler;
            Vector3d axis = Vector3d.Normalize(new Vector3d(1.0, 0.0, 0.5));
            parameters.Scene.TipMoment = couple * Rods.BendStiffness / Rods.Length * axis;
            return parameters;
        }

        [Test]
        public void PlaneProblem_SaysWhereItIsStableInItsPlaneOnly()
        {
            MaterialRod rod = Rods.Wire(40);
            foreach (double angle in new[] { Math.PI, 2.0 * Math.PI })
            {
                var rodTerms = new RodTerms(rod, new RodSupports());
                rodTerms.Followers.Moment.Moment = new Vector3d(angle * Rods.BendStiffness / Rods.Length, 0.0, 0.0);
                EquilibriumResult result = new RodStatics(rodTerms).Solve(Rods.Straight(rod), 1e-9, 500);
                Assert.That(result.Converged, Is.True);
                Assert.That(result.Method!.Contains("is not stable"), Is.EqualTo(angle > 3.6), result.Method);
            }
        }
    }
}
