using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The motion of a hub belongs to its drive: it is saved and restored with it, and moves nothing
    /// else.</summary>
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
        public void DriveThatIsRestored_TakesItsHubBackToTheSameBits()
        {
            Scene scene = SteeredBy(new Steering { Push = 1.37, Turn = 0.3 }, out MaterialDrive drive);
            var start = new StepStart(snapshot =>
            {
                drive.Serialize(snapshot);
                drive.Hub.Serialize(snapshot, 0.0);
            });
            drive.Prepare(scene.Shape, 0.0);
            start.Save();
            drive.Prepare(scene.Shape, Step);
            (Vector3d, double, double) once = EndOf(scene, drive);
            drive.SlipHub(4.1e-5);
            start.Restore();
            drive.Prepare(scene.Shape, Step);
            Assert.That(EndOf(scene, drive), Is.EqualTo(once));
            Assert.That(once.Item2, Is.EqualTo(0.6).Within(Rounding));
        }

        [Test]
        public void HubWhoseFrameIsHeld_TurnsAheadOfIt()
        {
            var hub = new HubMotion(Vector3d.Zero, Quaterniond.Identity, 3.0);
            hub.HoldFrame(0.7);
            Assert.That(hub.FrameTurnAt(2.0), Is.EqualTo(0.7));
            Assert.That(hub.FrameTwistRate, Is.Zero);
            Assert.That(hub.AheadAt(2.0), Is.EqualTo(6.0 - 0.7).Within(Rounding));
        }

        private static (Vector3d Position, double Turn, double Insertion) EndOf(Scene scene, MaterialDrive drive)
        {
            HubMotion hub = scene.Schedule.Hub;
            return (hub.PositionAt(2.0 * Step), hub.TurnAt(2.0 * Step), drive.Insertion);
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
