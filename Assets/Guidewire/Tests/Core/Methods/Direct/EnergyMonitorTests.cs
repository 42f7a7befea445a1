using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The account of a falling wire: the work of its weight is all in its motion.</summary>
    public sealed class EnergyMonitorTests
    {
        [Test]
        public void WorkOfLoads_IsCounted_OnceForAStepThatIsRepeated()
        {
            MaterialRod rod = Rods.Wire(6);
            var supports = new RodSupports { Proximal = ProximalEnd.Free };
            RodSchedule schedule = Rods.Schedule(new SceneParameters { Gravity = new Vector3d(0.0, -9.81, 0.0) });
            RodDynamics motion = MotionTests.Start(rod, supports, schedule, Rods.Straight(rod), Integrator.Esdirk4,
                1e-9);
            var monitor = new EnergyMonitor(motion.Terms, new FreeInertia(motion.Terms.Mass, supports), motion.Shape,
                motion.Velocities, motion.Spins, new HeldEnds(motion.Terms, schedule));
            for (int k = 0; k < 10; k++)
            {
                var kept = new Snapshot(isStep: true);
                motion.Serialize(kept);
                monitor.Serialize(kept);
                for (int repeat = 0; repeat < 2; repeat++)
                {
                    if (repeat == 1)
                    {
                        Snapshot read = kept.ToRead();
                        motion.Serialize(read);
                        monitor.Serialize(read);
                    }
                    Assert.That(motion.Step(0.01), Is.Null);
                    Assert.That(monitor.Blowup(), Is.Null);
                }
                Assert.That(monitor.FractionLost, Is.EqualTo(0.0).Within(1e-6));
                Assert.That(motion.KineticEnergy, Is.GreaterThan(0.0));
            }
        }
    }
}
