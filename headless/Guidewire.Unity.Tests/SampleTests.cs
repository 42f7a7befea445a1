using System;
using System.Linq;
using System.Reflection;
using UnityEngine.InputSystem;

namespace Guidewire.Unity.Tests
{
    /// <summary>The package's samples, in a scene that is made here: a vessel of a mesh, turned, moved and scaled,
    /// and the
    /// wire's object in another place.</summary>
    public sealed class SampleTests
    {
        private const float Scale = 0.001f;

        private static readonly string Sample = Path.Combine(Stage.Root, "Assets/Guidewire/Samples~/OwnVessel");

        private static readonly Vector3 Place = new Vector3(0.3f, -0.2f, 0.5f);

        private static readonly Quaternion Turned = Quaternion.Euler(20f, 70f, -40f);

        private GameObject _object = null!;
        private SimulationLoop _loop = null!;
        private LineRenderer _line = null!;

        [TearDown]
        public void Leave() => Engine.Unload();

        // The sample's tube about z, closed, slightly bent to the side.
        internal static Mesh Tube(Func<Vector3, Vector3> place)
        {
            var made = new GameObject("Tube");
            made.Attach(typeof(MeshFilter));
            var tube = (TubeVessel)made.Attach(typeof(TubeVessel));
            typeof(TubeVessel).GetMethod("Awake", BindingFlags.Instance | BindingFlags.NonPublic)!.Invoke(tube, null);
            Mesh own = made.GetComponent<MeshFilter>().sharedMesh;
            var mesh = new Mesh();
            mesh.SetVertices(Array.ConvertAll(own.vertices, point => place(point)));
            mesh.SetTriangles(own.triangles, 0);
            return mesh;
        }

        private static void Set(object target, string field, object value) =>
            target.GetType().GetField(field, BindingFlags.Instance | BindingFlags.NonPublic)!.SetValue(target, value);

        private void Build(bool byCollider = false)
        {
            Engine.Reset(Stage.Root);
            _object = Standing("Wire", Place, Turned, Scale);
            GameObject vessel = Standing("Vessel", new Vector3(1f, 2f, 3f), Quaternion.Euler(0f, 90f, 0f), 2f);
            Mesh mesh = Tube(x => vessel.transform.InverseTransformPoint(_object.transform.TransformPoint(x)));
            if (byCollider)
            {
                ((MeshCollider)vessel.Attach(typeof(MeshCollider))).sharedMesh = mesh;
                ((MeshFilter)vessel.Attach(typeof(MeshFilter))).sharedMesh = new Mesh();    // what is seen is another
            }
            else
            {
                ((MeshFilter)vessel.Attach(typeof(MeshFilter))).sharedMesh = mesh;
            }
            var walls = (SceneVessel)vessel.Attach(typeof(SceneVessel));
            Set(walls, "_frictionCoefficient", 0.1f);
            _loop = (SimulationLoop)_object.Attach(typeof(SimulationLoop));
            _loop.Stepping = SteppingMode.Frames;
            _object.Attach(typeof(KeyInput));
            var parameters = new TextAsset(File.ReadAllText(Path.Combine(Sample, "wire.json"))) { name = "wire" };
            _loop.Choose("", Array.Empty<string>(), "", isSteered: true);
            _loop.Choose(parameters, walls);
            var view = new GameObject("Line");
            _line = (LineRenderer)view.Attach(typeof(LineRenderer));
            Component own = view.Attach(typeof(OwnWire));
            Set(own, "_wire", _loop);
            Set(own, "_line", _line);
            Engine.Enter(new[] { _object, vessel, view });
        }

        private static GameObject Standing(string name, Vector3 position, Quaternion rotation, float scale)
        {
            var made = new GameObject(name);
            made.transform.position = position;
            made.transform.rotation = rotation;
            made.transform.localScale = scale * Vector3.one;
            return made;
        }

        [TestCase(false)]
        [TestCase(true)]
        public void Sample_PushesAWireAlongItsOwnVessel(bool byCollider)
        {
            Build(byCollider);
            Stage.Frames(1);
            Vector3 start = _line.GetPosition(_line.positionCount - 1);
            Engine.Press(KeyCode.UpArrow);
            Stage.Frames(300);
            Assert.That(_loop.Problem, Is.Empty);
            Assert.That(_line.positionCount, Is.EqualTo(25));
            RodState state = _loop.Shown!.Rod;
            for (int i = 0; i < 25; i++)
            {
                Vector3 expected = Place + Turned * (Scale * state.Positions[i].ToUnity());
                Assert.That(Vector3.Distance(_line.GetPosition(i), expected), Is.LessThan(1e-6f));
            }
            float distance = Vector3.Distance(_line.GetPosition(24), start);
            Assert.That(distance, Is.EqualTo(0.2f).Within(0.02f), "5 s at 40 units of a millimetre a second");
            Assert.That(_loop.Session!.Simulation.Contacts!.Passages, Is.EqualTo(0));
            Assert.That(state.Positions[24].X, Is.GreaterThan(5.0), "the vessel has bent it");
            Assert.That(Engine.Console, Is.Empty);
        }

        private long Count(int frames, Quaternion[] orientations)
        {
            long before = GC.GetAllocatedBytesForCurrentThread();
            for (int frame = 0; frame < frames; frame++)
            {
                Stage.Frames(1);
                _loop.GetOrientations(orientations);
            }
            return GC.GetAllocatedBytesForCurrentThread() - before;
        }

        [Test]
        public void SampleFrames_LeaveNoGarbage()
        {
            Build();
            Engine.Press(KeyCode.UpArrow);
            Engine.Press(KeyCode.RightArrow);
            Stage.Frames(120);
            Assert.That(_loop.Session!.Simulation.Contacts!.LargestTotal, Is.GreaterThan(0.0),
                "the first contact, whose"
                + " lists are made once, is over");
            var orientations = new Quaternion[24];
            int steps = _loop.Session.Simulation.StepCount;
            long left = Count(100, orientations);
            Engine.Release(KeyCode.UpArrow);
            Engine.Press(KeyCode.DownArrow);
            left += Count(200, orientations);
            Assert.That(left, Is.EqualTo(0));
            Assert.That(_loop.Session.Simulation.StepCount - steps, Is.EqualTo(500).Within(2), "5 s in steps of 10 ms");
        }

        [Test]
        public void Orientations_PointAlongTheWire()
        {
            Build();
            Stage.Frames(2);
            var positions = new Vector3[25];
            var orientations = new Quaternion[24];
            _loop.GetPositions(positions);
            _loop.GetOrientations(orientations);
            for (int j = 0; j < 24; j++)
            {
                Vector3 along = (positions[j + 1] - positions[j]).normalized;
                Assert.That(Vector3.Distance(orientations[j] * Vector3.forward, along), Is.LessThan(1e-3f));
            }
            Assert.Throws<ArgumentException>(() => _loop.GetPositions(new Vector3[24]));
            Assert.Throws<ArgumentException>(() => _loop.GetOrientations(new Quaternion[25]));
        }

        [TestCase(1f, 1f)]
        [TestCase(0.25f, 0.25f)]
        [TestCase(-3f, -1f)]
        public void Push_IsAnalogueAndBounded(float asked, float counted)
        {
            Build();
            _object.GetComponent<KeyInput>().enabled = false;
            Stage.Frames(1);
            double before = _loop.Session!.Simulation.Hub()!.Insertion;
            _loop.Push = asked;
            for (int k = 0; k < 10; k++)
            {
                _loop.Step();
            }
            double distance = _loop.Session.Simulation.Hub()!.Insertion - before;
            Assert.That(distance, Is.EqualTo(counted * 10 * 0.01 * 40.0 * 1e-3).Within(1e-9), "m: speed times time");
        }

        [Test]
        public void ContactEvents_PairUp_AndTheEndIsToldOnce()
        {
            Build();
            var touched = new HashSet<int>();
            int began = 0;
            int ended = 0;
            SceneVessel vessel = Engine.Find<SceneVessel>();
            _loop.Overrides = new[] { "obstacles=[{\"shape\": \"sphere\", \"centre\": [0, 300, 0], \"radius\": 10}]" };
            WireEvents events = _object.AddComponent<WireEvents>();
            events.ContactBegan.AddListener(contact =>
            {
                began++;
                Assert.That(touched.Add(contact.Sphere), Is.True);
                Assert.That(contact.Vessel, Is.EqualTo(vessel));
                Assert.That(contact.Force.magnitude, Is.GreaterThan(0f));
                Vector3 place = _object.transform.TransformPoint(
                    _loop.State!.Rod.Positions[contact.Sphere].ToUnity());
                Assert.That(Vector3.Distance(contact.Place, place), Is.LessThan(1e-6f));
                Vector3d force = _loop.State.ContactForces[contact.Sphere];
                Vector3 turned = Turned * force.ToUnity();
                Assert.That((contact.Force - turned).magnitude, Is.LessThan(1e-5f * turned.magnitude));
            });
            events.ContactEnded.AddListener(contact => Assert.That(touched.Remove(contact.Sphere), Is.True));
            _loop.Ended += (outcome, reason) => ended += outcome == Outcome.Finished && reason.Length > 0 ? 1 : 100;
            Engine.Press(KeyCode.UpArrow);
            Stage.Frames(200);
            Assert.That(began, Is.GreaterThan(0));
            _loop.Choose("", new[] { "maxSimulationSteps=5" }, "", isSteered: false);
            _loop.Load();
            Stage.Frames(30);
            Assert.That(ended, Is.EqualTo(1));
        }

        [Test]
        public void TwoWires_HaveTheirOwnRuns()
        {
            Build();
            SimulationLoop first = _loop;
            GameObject other = Standing("Other", Place, Turned, Scale);
            var second = (SimulationLoop)other.Attach(typeof(SimulationLoop));
            second.Stepping = SteppingMode.Frames;
            second.Choose("params/longitudinal.json", Array.Empty<string>(), "", isSteered: false);
            Engine.Enter(new[] { other });
            Engine.Press(KeyCode.UpArrow);
            Stage.Frames(30);
            Assert.That(first.Problem + second.Problem, Is.Empty);
            Assert.That(first.SphereCount, Is.Not.EqualTo(second.SphereCount));
            Assert.That(first.Session!.Simulation.Hub()!.Insertion, Is.GreaterThan(0.01));
            Assert.That(second.Session!.Simulation.StepCount, Is.GreaterThan(0));
        }

        [Test]
        public void VesselsThatAreNone_AreRefusedInOneLine()
        {
            Build();
            SceneVessel vessel = Engine.Find<SceneVessel>();
            MeshFilter filter = vessel.GetComponent<MeshFilter>();
            Mesh open = filter.sharedMesh;
            int[] triangles = open.triangles;
            Array.Resize(ref triangles, triangles.Length - 3);
            open.SetTriangles(triangles, 0);
            AssertRefused("vessel Vessel: the mesh is not watertight");
            filter.sharedMesh = new Mesh();
            AssertRefused("vessel Vessel: ");
            filter.sharedMesh = null!;
            AssertRefused("vessel Vessel: needs a MeshCollider or a MeshFilter with a mesh");
            Set(vessel, "_frictionCoefficient", float.NaN);
            filter.sharedMesh = open;
            AssertRefused("vessel Vessel: friction coefficient NaN is not allowed: a number >= 0");
        }

        private void AssertRefused(string words)
        {
            _loop.Load();
            Assert.That(_loop.Problem, Does.StartWith(words));
            Assert.That(_loop.Problem, Does.Not.Contain("\n"));
            Assert.That(_loop.SphereCount, Is.EqualTo(0));
            _loop.GetPositions(Array.Empty<Vector3>());
            _loop.GetOrientations(Array.Empty<Quaternion>());
        }

        [Test]
        public void AnAssetWithAWrongValue_IsNamed()
        {
            Build();
            _loop.Choose(new TextAsset("{\"solver\": \"direct\", \"timeStep\": -1}") { name = "wire" });
            _loop.Load();
            Assert.That(_loop.Problem, Does.StartWith("wire: timeStep = -1 is not allowed: "));
            _loop.Choose(new TextAsset("[1]") { name = "wire" });
            _loop.Load();
            Assert.That(_loop.Problem, Does.StartWith("wire: needs one JSON object"));
        }

        [Test]
        public void KeyInput_SteersTheLoopOfItsObject()
        {
            Engine.Reset(Stage.Root);
            GameObject made = Standing("Wire", Vector3.zero, Quaternion.identity, 1f);
            made.Attach(typeof(KeyInput));
            var loop = (SimulationLoop)made.Attach(typeof(SimulationLoop));
            loop.Stepping = SteppingMode.Frames;
            loop.Choose("params/insertion.json", Array.Empty<string>(), "", isSteered: true);
            Engine.Enter(new[] { made });
            Engine.Press(KeyCode.W);
            Engine.Press(KeyCode.LeftArrow);
            Stage.Frames(2);
            Assert.That((loop.Push, loop.Turn), Is.EqualTo((1f, -1f)));
            made.GetComponent<KeyInput>().enabled = false;
            Stage.Frames(1);
            Assert.That((loop.Push, loop.Turn), Is.EqualTo((0f, 0f)), "what is unticked lets go");
            loop.Push = 0.5f;
            Stage.Frames(2);
            Assert.That(loop.Push, Is.EqualTo(0.5f), "and leaves a script alone");
        }

        [Test]
        public void Sample_IsShort() =>
            Assert.That(File.ReadAllLines(Path.Combine(Sample, "OwnWire.cs")).Length, Is.LessThanOrEqualTo(33));
    }
}
