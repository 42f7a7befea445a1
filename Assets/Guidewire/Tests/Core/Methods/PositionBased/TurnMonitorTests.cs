using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class TurnMonitorTests
    {
        [TestCase(0.99, "")]
        [TestCase(1.01, "joint 1 was turned over half a turn in step 10,")]
        public void ATurnIsLost_WhereAJointGoesOverHalfOfOne(double halves, string start)
        {
            RodState state = Straight();
            var watch = new TurnMonitor(state);
            for (int step = 1; step <= 10; step++)
            {
                TurnDistalPart(state, 0.1 * halves * Math.PI);
                watch.Update(state, step);
            }
            Assert.That(watch.Warning != null, Is.EqualTo(start.Length > 0));
            Assert.That(watch.Warning?.Text ?? "", Does.StartWith(start));
        }

        [Test]
        public void ALostTurnIsRemembered_WhenTheJointHasUnwoundItself()
        {
            RodState state = Straight();
            var watch = new TurnMonitor(state);
            TurnDistalPart(state, 1.1 * Math.PI);
            watch.Update(state, 1);
            TurnDistalPart(state, -1.1 * Math.PI);
            watch.Update(state, 2);
            Assert.That(watch.Warning!.Value.Text, Does.Contain("in step 1,"));
        }

        [Test]
        public void TheSignOfAQuaternionAtTheStart_IsNoTurn()
        {
            RodState state = Straight();
            state.Orientations[1] = -1.0 * state.Orientations[1];
            var watch = new TurnMonitor(state);
            watch.Update(state, 1);
            Assert.That(watch.Warning, Is.Null);
        }

        private static RodState Straight() => new RodState(3, 3.0, 1.0, 0.0);

        // Element 2 alone: joint 1 is turned.
        private static void TurnDistalPart(RodState state, double angle) =>
            state.Orientations[2] = state.Orientations[2] * Quaterniond.FromAxisAngle(Vector3d.UnitZ, angle);
    }
}
