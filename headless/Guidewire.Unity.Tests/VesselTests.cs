using System;

namespace Guidewire.Unity.Tests
{
    /// <summary>The scene in which a hand pushes the wire into the vessel.</summary>
    public sealed class VesselTests
    {
        [SetUp]
        public void Open()
        {
            Stage.OpenInsertion();
            Stage.Frames(1);
        }

        [TearDown]
        public void Leave() => Engine.Unload();

        [Test]
        public void Wall_IsDrawnWhereTheSimulationHasIt()
        {
            VesselView view = Engine.Find<VesselView>();
            Assert.That(view.Meshes, Has.Count.EqualTo(1));
            ContactShape wall = Stage.Loop.Session!.Parameters.Scene.Walls[0];
            foreach (Vector3 vertex in view.Meshes[0].vertices)
            {
                int hint = -1;
                var point = new Vector3d(vertex.x, vertex.y, vertex.z);
                wall.Nearest(point, point, 1.0, ref hint, out SurfaceContact contact);
                Assert.That(Math.Abs(contact.Distance), Is.LessThan(1e-3), "float at 300 units has steps of 3e-5");
            }
        }

        [Test]
        public void PushedWire_StaysInTheVessel_AndItsContactsAreShown()
        {
            Stage.Loop.Set("timeStep", "0.02");    // half the steps: the test is about what is seen
            double before = Stage.State.Positions[30].Z;
            Engine.Press(KeyCode.W);
            bool wereDrawn = false;
            for (int frame = 0; frame < 240; frame++)
            {
                Stage.Frames(1);
                wereDrawn |= AssertMarksLieOnTheWall();
            }
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
            Assert.That(Stage.State.Positions[30].Z - before, Is.GreaterThan(60.0), "4 s at 40 units a second");
            Assert.That(wereDrawn, Is.True, "the bend of the arch is touched");
            Assert.That(Stage.Loop.Session!.Simulation.Contacts!.Passages, Is.EqualTo(0));
        }

        // Balls have equal scales, sticks do not; the wire's own marks are switched off.
        private static bool AssertMarksLieOnTheWall()
        {
            ContactShape wall = Stage.Loop.Session!.Parameters.Scene.Walls[0];
            bool any = false;
            foreach ((Mesh _, Matrix4x4 place, Material _, int _) in Engine.Drawn)
            {
                Vector3 centre = place.MultiplyPoint3x4(Vector3.zero);
                float along = Vector3.Distance(place.MultiplyPoint3x4(Vector3.forward), centre);
                float across = Vector3.Distance(place.MultiplyPoint3x4(Vector3.right), centre);
                if (Math.Abs(along - across) > 1e-3f || along < 1.1f)
                {
                    continue;
                }
                any = true;
                int hint = -1;
                var point = new Vector3d(centre.x, centre.y, centre.z);
                wall.Nearest(point, point, 1.0, ref hint, out SurfaceContact contact);
                Assert.That(Math.Abs(contact.Distance), Is.LessThan(1e-3));
            }
            return any;
        }

        [Test]
        public void MissingMesh_StopsWithItsName()
        {
            Stage.Loop.Choose("params/insertion.json",
                new[] { "vessel={\"shape\": \"mesh\", \"file\": \"meshes/nowhere.obj\"}" }, "", true);
            Stage.Tap(KeyCode.R);
            Stage.Frames(1);
            Assert.That(Stage.Loop.Problem, Does.Contain("nowhere.obj"));
            Stage.AssertLogged(LogType.Error, "nowhere.obj");
            Assert.That(Engine.Find<VesselView>().Meshes, Is.Empty);
            Stage.Loop.Choose("params/insertion.json", Array.Empty<string>(), "", true);
            Stage.Tap(KeyCode.R);
            Stage.Frames(2);
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
            Assert.That(Engine.Find<VesselView>().Meshes, Has.Count.EqualTo(1));
        }
    }
}
