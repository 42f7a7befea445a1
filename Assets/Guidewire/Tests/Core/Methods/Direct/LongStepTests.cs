using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Steps far longer than a wire's own motion needs, under loads that bend it double: a run ends converged
    /// or says why not, and is never lost.</summary>
    public sealed class LongStepTests
    {
        private static readonly Integrator[] Schemes =
        {
            Integrator.ImplicitEuler, Integrator.Bdf2, Integrator.Trbdf2, Integrator.Esdirk3, Integrator.Esdirk4,
        };

        [Test]
        public void Wire_DroppedFromTheStraight_IsNeverLost([ValueSource(nameof(Schemes))] Integrator scheme,
            [Values(1e-3, 5e-3, 20e-3, 50e-3)] double step, [Values(15, 30, 120)] int n,
            [Values(0.456, 10.0, 100.0)] double weight)
        {
            if (n == 120 && (scheme != Integrator.Esdirk4 || weight < 100.0 || step < 50e-3))
            {
                Rods.OnlyInFull("15 and 30 elements, and of 120 what is hardest");
            }
            if (n == 30 && (weight < 100.0 || (scheme == Integrator.Esdirk4 && step == 5e-3)))
            {
                Rods.OnlyInFull("15 elements, and ten times the weight in longer steps");
            }
            // weight: w L^3/EI, 0.456 on Earth. The first mode's period is 211 ms, the third's 12 ms. A wire 100 times
            // as heavy as its stiffness falls by 0.6 L in a step of 5 ms; an error of that order in a stage of length h
            // is a force M L/h^2 = 290 N in esdirk4, which stretches it by 0.6 %.
            MaterialRod rod = Rods.Wire(n);
            RodShape shape = Rods.Straight(rod);
            double gravity = weight * Rods.BendForce / (Rods.Density * Rods.Area * Rods.Length);
            var schedule = Rods.Schedule(new SceneParameters { Gravity = new Vector3d(0.0, -gravity, 0.0) });
            RodDynamics motion = MotionTests.Start(rod, new RodSupports(), schedule, shape, scheme, 1e-6);
            string? failure = null;
            int steps = 0;
            while (failure == null && steps < 60)
            {
                failure = motion.Step(step);
                steps++;
                for (int i = 0; i <= n && failure == null; i++)
                {
                    Assert.That(shape.X[i].Length, Is.LessThan(1.1 * Rods.Length), "node " + i + ", step " + steps);
                    Assert.That(motion.Velocities[i].IsFinite, Is.True);
                }
            }
            Assert.That(failure, Is.Null.Or.Not.Empty);
            if (weight <= 10.0 || scheme != Integrator.Esdirk4)
            {
                Assert.That(failure, Is.Null);
            }
        }
    }
}
