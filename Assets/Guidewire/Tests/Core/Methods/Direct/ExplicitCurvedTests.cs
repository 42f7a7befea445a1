using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The substep that explicit steps name as stable, of wires with a rest curvature.</summary>
    public sealed class ExplicitCurvedTests
    {
        /// <summary>About the rest shape the limit is 2/omega_max, counted on the whole matrix: the named step, which
        /// keeps twice that distance, is no longer than half of it.</summary>
        [Test]
        public void NamedStep_IsBelowTheLimitAboutTheRestShape([Values(6, 40, 300)] int n,
            [Values(0.03, 0.3, 1.0, 2.5)] double turn, [Values(false, true)] bool isStrip)
        {
            // turn: of a joint, rad; about both axes, and twisted by half as much.
            MaterialRod rod = Rods.Wire(n);
            double curvature = turn * n / Rods.Length;
            for (int j = 0; j < n; j++)
            {
                rod.RestCurvature[j] = curvature * new Vector3d(0.7, 0.5, 0.5);
                if (isStrip)
                {
                    rod.BendStiffness1[j] *= 9.0;
                    rod.RotaryInertia1[j] *= 9.0;
                }
            }
            var supports = new RodSupports { Mass = MassRule.Lumped };
            var terms = new RodTerms(rod, supports);
            double named = ExplicitStep.StableTimeStep(rod, supports);
            double limit = new ExplicitLimit(terms, new NodalInertia(terms.Mass, supports)).AtRest(
                Rods.Straight(rod), named);
            TestContext.WriteLine("{0:G4} of the limit", named / limit);
            Assert.That(named, Is.LessThan(0.5 * limit * 1.001));
        }

        /// <summary>Of a straight wire the named step is no longer than the limit, and shorter by what its bound of
        /// omega^2 adds at most: shear against turning, against shifting, and bending, where the truth is no less than
        /// what shear does alone.</summary>
        [TestCase(30, 0.5e-3)]
        [TestCase(60, 5e-3)]
        [TestCase(4, 5e-3)]
        public void NamedStepOfAStraightWire_IsThatOfTheLinearChain(int n, double radius)
        {
            MaterialRod rod = MaterialRod.Round(n, Rods.Length, radius, Rods.Young, Rods.Shear, Rods.Density);
            var supports = new RodSupports { Proximal = ProximalEnd.Free, Mass = MassRule.Lumped };
            var terms = new RodTerms(rod, supports);
            double named = ExplicitStep.StableTimeStep(rod, supports);
            double limit = new ExplicitLimit(terms, new NodalInertia(terms.Mass, supports)).AtRest(
                Rods.Straight(rod), named);
            TestContext.WriteLine("{0:G6} of the limit", named / limit);
            double l = Rods.Length / n;
            double turning = 4.0 * Rods.Shear / (Rods.Density * radius * radius);
            double shifting = 4.0 * Rods.Shear / (Rods.Density * l * l);
            double bending = 4.0 * Rods.Young / (Rods.Density * l * l);
            double slack = (turning + shifting + bending)
                / Math.Max(turning + shifting, turning + (1.0 - 1.0 / n) * bending);
            Assert.That(named, Is.InRange(0.999 * limit / Math.Sqrt(slack), 1.001 * limit));
        }

        /// <summary>A pre-curved wire that sets out straight moves far: at 0.99 of the named step it does not gain
        /// energy.</summary>
        [TestCase(40, 31.4, 30.0)]
        [TestCase(40, 125.0, 30.0)]
        [TestCase(25, 60.0, 0.0)]
        [TestCase(100, 80.0, 10.0)]
        public void CurvedWireLetGoFromStraight_IsStableAtTheNamedStep(int n, double curvature, double twist)
        {
            SimulationParameters parameters = Rods.Clamped(n, Solver.Explicit, 1e-3, 2);
            parameters.Material.RestCurvature = new Vector3d(curvature, 0.0, twist);
            double named = Simulation.Create(parameters).Report()!.StableSubstep;
            parameters.Method.Substeps = 4;
            parameters.Method.TimeStep = 0.99 * named * parameters.Method.Substeps;
            parameters.Method.MaxSimulationSteps = 2000;
            Simulation run = Wires.Finish(parameters);
        }
    }
}
