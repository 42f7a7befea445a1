using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Forces against the change of momentum, in every step, at the default tolerance. The momentum is that of
    /// the velocities and the mass matrix; the reactions are the stress of the first and the last element.</summary>
    public sealed class ForceBalanceTests
    {
        private const double Balance = 1e-6;  // of the largest reaction or load of the run
        private const double Tolerance = 1e-6;
        private static readonly Vector3d Gravity = new Vector3d(1.0, -9.81, 2.0);

        private static readonly Integrator[] Schemes =
        {
            Integrator.ImplicitEuler, Integrator.Bdf2, Integrator.Trbdf2, Integrator.Esdirk3, Integrator.Esdirk4,
        };

        [Test]
        public void Forces_Balance_AfterABentWireIsLetGo(
            [ValueSource(nameof(Schemes))] Integrator scheme, [Values(10, 30)] int n,
            [Values(0.5e-3, 2e-3)] double step)
        {
            MaterialRod rod = Rods.Wire(n);
            RodShape shape = Rods.AtRest(rod, new RodSupports(), Vector3d.Zero,
                new Vector3d(0.0, 0.1 * Rods.BendForce, 0.0), Vector3d.Zero);
            AssertBalanced(rod, new RodSupports(), Rods.Schedule(), shape, scheme, step);
        }

        [Test]
        public void Forces_Balance_WhileAWireFallsFromTheStraight(
            [ValueSource(nameof(Schemes))] Integrator scheme, [Values(12, 60)] int n,
            [Values(1e-3, 5e-3)] double step)
        {
            MaterialRod rod = Rods.Wire(n);
            AssertBalanced(rod, new RodSupports(), UnderWeight(), Rods.Straight(rod), scheme, step);
        }

        [Test]
        public void Forces_Balance_OfAWireClampedAtBothEnds([ValueSource(nameof(Schemes))] Integrator scheme,
            [Values(0.5e-3, 1e-3, 5e-3)] double step)
        {
            const int N = 24;
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports { Distal = DistalEnd.Clamped };
            RodShape shape = Rods.Straight(rod);
            var schedule = Rods.Schedule(new SceneParameters { Gravity = Gravity }, shape);
            AssertBalanced(rod, supports, schedule, shape, scheme, step);
        }

        [Test]
        public void Forces_Balance_WhileClampedEndsComeCloserUntilTheWireBuckles(
            [ValueSource(nameof(Schemes))] Integrator scheme,
            [Values(1e-3, 5e-3)] double step)
        {
            // Clamped ends that come 2 % closer, under weight.
            const int N = 24;
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports { Distal = DistalEnd.Clamped };
            RodShape shape = Rods.Straight(rod);
            var schedule = Rods.Schedule(new SceneParameters
            {
                Gravity = Gravity,
                DistalDisplacement = -0.02 * Rods.Length,
                DistalRampTime = 0.05,
            }, shape);
            AssertBalanced(rod, supports, schedule, shape, scheme, step);
        }

        [Test]
        public void Forces_Balance_UnderWeightAndATipForce([ValueSource(nameof(Schemes))] Integrator scheme,
            [Values(1e-3, 5e-3)] double step)
        {
            // Ten times what bends it by its own length, until it is let go.
            const int N = 20;
            MaterialRod rod = Rods.Wire(N);
            var schedule = Rods.Schedule(new SceneParameters
            {
                Gravity = Gravity,
                TipForce = new Vector3d(0.0, 10.0 * Rods.BendForce, -3.0 * Rods.BendForce),
                TipForceReleaseTime = 0.05,
            });
            AssertBalanced(rod, new RodSupports(), schedule, Rods.Straight(rod), scheme, step);
        }

        [Test]
        public void Weight_AloneChangesTheMomentum_OfAWireThatNothingHolds(
            [ValueSource(nameof(Schemes))] Integrator scheme)
        {
            // Bent and held by nothing: the weight alone changes the momentum, while larger forces within the rod must
            // cancel each other.
            MaterialRod rod = Rods.Wire(12);
            RodShape shape = Rods.Random(rod, 0.05, 0.0, 3);
            var supports = new RodSupports { Proximal = ProximalEnd.Free };
            AssertBalanced(rod, supports, UnderWeight(), shape, scheme, 1e-3);
        }

        private static RodSchedule UnderWeight() => Rods.Schedule(new SceneParameters { Gravity = Gravity });

        private static void AssertBalanced(MaterialRod rod, RodSupports supports, RodSchedule schedule, RodShape shape,
            Integrator scheme, double step)
        {
            RodDynamics motion = MotionTests.Start(rod, supports, schedule, shape, scheme, Tolerance);
            motion.Reactions.AreKept = true;
            double worst = 0.0;
            double peak = 0.0;
            Vector3d change = Vector3d.Zero;    // of the momentum, in the step before
            for (int i = 0; i < 100; i++)
            {
                Vector3d before = change;
                Vector3d momentum = Rods.Momentum(motion);
                Assert.That(motion.Step(step), Is.Null);
                change = Rods.Momentum(motion) - momentum;
                // As the scheme writes it: BDF2 after its first step by three values.
                Vector3d rate = (scheme == Integrator.Bdf2 && i > 0 ? 1.5 * change - 0.5 * before : change) / step;
                StageForces mean = motion.Reactions.Mean;
                Vector3d reactions = mean.Proximal + mean.Distal;
                double left = (rate - reactions - mean.Load).Length;
                worst = Math.Max(worst, left);
                peak = Math.Max(peak, Math.Max(mean.Proximal.Length, mean.Load.Length));
                if (supports.Proximal == ProximalEnd.Free)
                {
                    peak = Math.Max(peak, LargestForce(rod, shape));
                }
            }
            Assert.That(worst, Is.LessThan(Balance * peak));
        }

        private static double LargestForce(MaterialRod rod, RodShape shape)
        {
            var stretch = new StretchEnergy(rod);
            double largest = 0.0;
            for (int j = 0; j < rod.ElementCount; j++)
            {
                largest = Math.Max(largest, stretch.Stress(shape, j, out _).Length);
            }
            return largest;
        }
    }
}
