using System;

namespace Guidewire.Unity.Tests
{
    /// <summary>What each key and the mouse do, in the scene that a user steers.</summary>
    public sealed class KeyTests
    {
        [SetUp]
        public void Open()
        {
            Stage.OpenInsertion();
            Stage.Frames(2);
        }

        [TearDown]
        public void Leave() => Engine.Unload();

        private static double Along() => Stage.State.Positions[0].Z;

        /// <summary>Angle of the first element about its axis in rad.</summary>
        private static double Turned()
        {
            Quaterniond q = Stage.State.Orientations[0];
            return 2.0 * Math.Atan2(q.Z, q.W);
        }

        /// <summary>Keys that do the same in one scene: to open it takes longer than its frames.</summary>
        [TestCase(1, KeyCode.W, KeyCode.UpArrow)]
        [TestCase(-1, KeyCode.S, KeyCode.DownArrow)]
        public void PushAndPull_MoveSphere0AlongTheWire(int sign, params KeyCode[] keys)
        {
            foreach (KeyCode key in keys)
            {
                AssertMoves(key, sign);
            }
        }

        private static void AssertMoves(KeyCode key, int sign)
        {
            double before = Along();
            double time = Stage.Loop.Session!.Simulation.Time;
            Engine.Press(key);
            Stage.Frames(8);
            double moved = Along() - before;
            Assert.That(moved, Is.EqualTo(sign * 40.0 * (Stage.Loop.Session!.Simulation.Time - time)).Within(0.2),
                "40 units a second of in-game time");
            Assert.That(Math.Abs(moved), Is.GreaterThan(1.0));
            Engine.Release(key);
            Stage.Frames(1);
            double after = Along();
            Stage.Frames(3);
            Assert.That(Along(), Is.EqualTo(after), "it is held where it was left");
        }

        [TestCase(1, KeyCode.D, KeyCode.RightArrow)]
        [TestCase(-1, KeyCode.A, KeyCode.LeftArrow)]
        public void Turn_TurnsTheFirstElementAboutItsAxis(int sign, params KeyCode[] keys)
        {
            foreach (KeyCode key in keys)
            {
                double before = Turned();
                double time = Stage.Loop.Session!.Simulation.Time;
                Engine.Press(key);
                Stage.Frames(8);
                Engine.Release(key);
                double asked = sign * Math.PI * (Stage.Loop.Session!.Simulation.Time - time);
                Assert.That(Turned() - before, Is.EqualTo(asked).Within(0.05 * Math.Abs(asked)),
                    "180 degrees a second");
            }
        }

        [Test]
        public void Space_PausesAndGoesOn()
        {
            Stage.Tap(KeyCode.Space);
            int steps = Stage.Loop.Session!.Simulation.StepCount;
            double real = Stage.Loop.RealTime;
            Stage.Frames(4);
            Assert.That(Stage.Loop.Session.Simulation.StepCount, Is.EqualTo(steps));
            Assert.That(Stage.Loop.RealTime, Is.EqualTo(real), "a pause is not counted");
            Stage.Tap(KeyCode.Space);
            Stage.Frames(4);
            Assert.That(Stage.Loop.Session.Simulation.StepCount, Is.GreaterThan(steps));
        }

        [Test]
        public void N_MakesOneStepAndPauses()
        {
            Stage.Tap(KeyCode.Space);
            int steps = Stage.Loop.Session!.Simulation.StepCount;
            Stage.Tap(KeyCode.N);
            Stage.Frames(5);
            Assert.That(Stage.Loop.Session.Simulation.StepCount, Is.EqualTo(steps + 1));
            Assert.That(Stage.Loop.IsPaused, Is.True);
        }

        [Test]
        public void R_StartsAnew()
        {
            Engine.Press(KeyCode.W);
            Stage.Frames(8);
            Engine.Release(KeyCode.W);
            Stage.Tap(KeyCode.Space);
            Stage.Tap(KeyCode.R);
            Assert.That(Stage.Loop.Generation, Is.EqualTo(2));
            Assert.That(Stage.Loop.Session!.Simulation.StepCount, Is.EqualTo(0), "still paused");
            Assert.That(Along(), Is.EqualTo(Stage.Loop.Session.Parameters.Scene.GuidewireOffset));
        }

        [Test]
        public void C_GoesThroughTheColourings()
        {
            Colouring first = Stage.Wire.Colouring;
            for (int k = 1; k <= 4; k++)
            {
                Stage.Tap(KeyCode.C);
                Assert.That((int)Stage.Wire.Colouring, Is.EqualTo(((int)first + k) % 4));
            }
        }

        [Test]
        public void B_DrawsEverySphereWhereItIs()
        {
            Stage.Tap(KeyCode.B);
            Stage.Frames(1);
            for (int i = 0; i < Stage.State.SphereCount; i++)
            {
                Vector3 centre = Stage.Shown.Positions[i].ToUnity();
                bool isDrawn = Engine.Drawn.Exists(mark =>
                    Vector3.Distance(mark.Place.MultiplyPoint3x4(Vector3.zero), centre) < 1e-3f);
                Assert.That(isDrawn, Is.True, "sphere " + i);
            }
            Stage.Tap(KeyCode.B);
            Stage.Frames(1);
            Assert.That(Stage.Wire.ShowsSpheres, Is.False);
        }

        [Test]
        public void G_DrawsThreeDirectorsAnElement()
        {
            int before = Engine.Drawn.Count;
            int meshes = Engine.Renderers.Count;    // wire and vessel, drawn before balls and sticks
            Stage.Tap(KeyCode.G);
            Stage.Frames(1);
            Assert.That(Engine.Drawn.Count - before, Is.EqualTo(3 * Stage.State.ElementCount));

            // The third of element 0 lies along it: its far end is beyond the middle along d3.
            RodState state = Stage.Shown;
            Vector3 middle = (0.5 * (state.Positions[0] + state.Positions[1])).ToUnity();
            Matrix4x4 place = Engine.Drawn[meshes + 2].Place;
            Vector3 end = place.MultiplyPoint3x4(Vector3.forward) - middle;
            Assert.That(Vector3.Dot(end.normalized, state.Orientations[0].Director3.ToUnity()),
                Is.EqualTo(1f).Within(1e-4f));
        }

        [Test]
        public void F_SwitchesTheContacts()
        {
            ContactView contacts = Engine.Find<ContactView>();
            bool before = contacts.IsShown;
            Stage.Tap(KeyCode.F);
            Assert.That(contacts.IsShown, Is.EqualTo(!before));
        }

        [Test]
        public void H_ShowsAndHidesTheKeys()
        {
            Assert.That(Engine.Labels, Does.Contain(Engine.Find<KeyboardControl>().Help));
            Stage.Tap(KeyCode.H);
            Assert.That(Engine.Labels, Does.Not.Contain(Engine.Find<KeyboardControl>().Help));
        }

        [Test]
        public void T_KeepsTheTipInTheMiddle()
        {
            Stage.Tap(KeyCode.T);
            Stage.Frames(1);
            Transform camera = Engine.Find<OrbitCamera>().transform;
            Vector3 tip = Stage.Shown.Positions[Stage.Shown.ElementCount].ToUnity();
            Vector3 towards = (tip - camera.position).normalized;
            Assert.That(Vector3.Dot(towards, camera.rotation * Vector3.forward), Is.EqualTo(1f).Within(1e-5f));
        }

        [Test]
        public void RightButton_OrbitsAndWheelZooms()
        {
            Transform camera = Engine.Find<OrbitCamera>().transform;
            Engine.Mouse(100f, 100f, -1, 0f);
            Stage.Frames(1);
            Vector3 first = camera.position;
            Engine.Mouse(200f, 100f, -1, 0f);
            Stage.Frames(1);
            Assert.That(camera.position, Is.EqualTo(first), "without the button nothing turns");
            Engine.Mouse(300f, 100f, 1, 0f);
            Stage.Frames(1);
            Assert.That(Vector3.Distance(camera.position, first), Is.GreaterThan(50f), "30 degrees");
            const float distance = 430f;    // the scene's
            Vector3 middle = camera.position + camera.rotation * Vector3.forward * distance;
            Engine.Mouse(300f, 100f, -1, 3f);
            Stage.Frames(1);
            float expected = distance * Mathf.Exp(-0.3f);
            Assert.That(Vector3.Distance(camera.position, middle), Is.EqualTo(expected).Within(0.1f));
        }

        [Test]
        public void Button_ChangesNothing_WhereThereIsNoOtherChoice()
        {
            Stage.Tap(KeyCode.Space);
            Engine.Click = "solver";
            Stage.Frames(1);
            Assert.That(Stage.Loop.Session!.Text("solver"), Is.EqualTo("pbd"),
                "gains do not go on as a material");
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
        }

        [Test]
        public void Button_SwitchesTheSolverOfAWireWithAMaterial()
        {
            string file = System.IO.Path.Combine(TestContext.CurrentContext.WorkDirectory, "material.json");
            System.IO.File.WriteAllText(file, "{\"solver\": \"direct\", \"numberRodElements\": 12, "
                + "\"timeStep\": 0.001, \"gravity\": [0, -9.81, 0], \"deltaThreshold\": 0, "
                + "\"maxSimulationSteps\": 100000}");
            Stage.Loop.Choose(file, Array.Empty<string>(), "", false);
            Stage.Tap(KeyCode.R);
            Stage.Frames(10);
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
            int steps = Stage.Loop.Session!.Simulation.StepCount;
            Vector3d tip = Stage.State.Positions[12];
            Engine.Click = "solver";
            Stage.Tap(KeyCode.Space);
            Assert.That(Stage.Loop.Session.Text("solver"), Is.EqualTo("explicit"));
            Assert.That(Stage.Loop.Session.Simulation.StepCount, Is.GreaterThanOrEqualTo(steps));
            Assert.That(Vector3d.Distance(Stage.State.Positions[12], tip), Is.LessThan(1.0));
        }

        [TestCase("integrator", "euler")]
        [TestCase("sweepOrder", "bilateral")]
        public void Button_SwitchesInFlight(string key, string expected)
        {
            Stage.Frames(4);
            Vector3d tip = Stage.State.Positions[30];
            Stage.Tap(KeyCode.Space);
            int steps = Stage.Loop.Session!.Simulation.StepCount;
            Engine.Click = key;
            Stage.Frames(1);
            Assert.That(Stage.Loop.Session.Text(key), Is.EqualTo(expected));
            Assert.That(Stage.Loop.Session.Simulation.StepCount, Is.EqualTo(steps));
            Assert.That(Vector3d.Distance(Stage.State.Positions[30], tip), Is.LessThan(1.0));
            Stage.Tap(KeyCode.Space);
            Stage.Frames(5);
            Assert.That(Stage.Loop.Session.Simulation.StepCount, Is.GreaterThan(steps));
            Assert.That(Stage.Loop.Problem, Is.EqualTo(""));
        }
    }
}
