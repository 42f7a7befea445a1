using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The motion of a hub belongs to its drive: it moves nothing else.</summary>
    public sealed class HubMotionTests
    {
        private const double Step = 0.01;
        private const double Rounding = 1e-14;

        [Test]
        public void TwoHubs_EachFollowTheirOwnUser_UnderTheSameLoads()
        {
            var users = new[] { new Steering { Push = 2.0, Turn = 0.1 }, new Steering { Push = -1.0, Turn = -0.4 } };
            Scene scene = SteeredBy(users[0], out MaterialDrive first);
            SteeredBy(users[1], out MaterialDrive model);
            var hub = new HubMotion(new Vector3d(1.0, 2.0, 3.0), Quaterniond.Identity, 0.0);
            var second = new MaterialDrive(model, hub, Vector3d.UnitX);
            var other = new RodSchedule(scene.Schedule.Loads, hub, scene.Schedule.Distal);
            Vector3d start = scene.Schedule.Hub.PositionAt(0.0);
            for (int k = 0; k < 5; k++)
            {
                first.Prepare(scene.Shape, k * Step);
                second.Prepare(scene.Shape, k * Step);
            }
            const double end = 5 * Step;
            Vector3d moved = scene.Schedule.Hub.PositionAt(end) - start;
            Assert.That(moved.Z, Is.EqualTo(5.0 * 2.0 * scene.UnitLength).Within(Rounding));
            Assert.That(scene.Schedule.Hub.TurnAt(end), Is.EqualTo(0.5).Within(Rounding));
            Assert.That(other.Hub.PositionAt(end).X, Is.EqualTo(1.0 - 5.0 * scene.UnitLength).Within(Rounding));
            Assert.That(other.Hub.TurnAt(end), Is.EqualTo(-2.0).Within(Rounding));
        }

        [Test]
        public void HubOfAWindow_IsWhereItsNodeIs_AndHoldsItsFrame()
        {
            var hub = new HubMotion(Vector3d.Zero, Quaterniond.Identity, 3.0);
            hub.MoveOn(1.0, new Vector3d(0.0, 0.0, 0.6), new Vector3d(0.0, 0.0, 0.2));
            var window = new HubMotion(hub, new Vector3d(0.0, 0.0, -0.1), 0.7);
            hub.Shift(Vector3d.UnitX);
            Assert.That(window.PositionAt(2.0).X, Is.Zero);
            Assert.That(window.PositionAt(2.0).Z, Is.EqualTo(0.7).Within(Rounding));
            Assert.That(window.FrameTurnAt(2.0), Is.EqualTo(0.7));
            Assert.That(window.FrameTwistRate, Is.Zero);
            Assert.That(window.AheadAt(2.0), Is.EqualTo(6.0 - 0.7).Within(Rounding));
        }

        private static Scene SteeredBy(Steering user, out MaterialDrive drive)
        {
            SimulationParameters parameters = Rods.Clamped(4, Solver.Direct, Step, 10);
            parameters.Drive.Steering = user;
            var scene = new Scene(parameters);
            drive = new MaterialDrive(parameters, scene, true);
            return scene;
        }
    }
}
