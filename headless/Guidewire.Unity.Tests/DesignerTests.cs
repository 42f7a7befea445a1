using System;
using System.Globalization;
using System.Linq;
using System.Text;

namespace Guidewire.Unity.Tests
{
    /// <summary>What is steered, attached and told without a script.</summary>
    public sealed class DesignerTests
    {
        private static readonly string[] NoDrive = { "deltaThreshold=0", "maxSimulationSteps=1000000" };

        private SimulationLoop _loop = null!;

        [SetUp]
        public void Enter()
        {
            Engine.Reset(Stage.Root);
            _loop = new GameObject("Wire").AddComponent<SimulationLoop>();
            _loop.transform.localRotation = Quaternion.Euler(10f, 50f, -20f);
            _loop.transform.localScale = 0.001f * Vector3.one;
            _loop.Stepping = SteppingMode.Frames;
            _loop.Choose("params/catheter.json", NoDrive, "", isSteered: true);
        }

        [TearDown]
        public void Leave() => Engine.Unload();

        private double Catheter => _loop.State!.Catheters[0].Hub.Insertion;

        private double Wire => _loop.State!.Hub!.Value.Insertion;

        [Test]
        public void TwoHubControls_MoveTwoHubsAtOnce_ByTheirFields()
        {
            HubControl wire = _loop.gameObject.AddComponent<HubControl>();
            HubControl catheter = _loop.gameObject.AddComponent<HubControl>();
            (wire.Push, catheter.Instrument, catheter.Push, catheter.Turn) = (0.5f, 1, 0.25f, 1f);
            Stage.Frames(60);
            double time = _loop.State!.Time;
            Assert.That(Wire, Is.EqualTo(0.02 * time).Within(1e-3), "half of 40 mm/s");
            Assert.That(Catheter, Is.EqualTo(0.01 * time).Within(1e-3));
            Assert.That(_loop.State.Catheters[0].Hub.Turn, Is.EqualTo(Math.PI * time).Within(0.15), "180 degrees/s");
            catheter.enabled = false;
            double before = Catheter;
            Stage.Frames(10);
            Assert.That(Catheter, Is.EqualTo(before).Within(1e-3), "what is unticked lets go");
            Assert.That(Wire, Is.GreaterThan(0.02 * time + 1e-3));
        }

        // Forward by 20 mm and about the first element by 90 degrees; then at once by 100 mm, which takes 2.5 s.
        [Test]
        public void AHandle_IsFollowed_AndLaggedBehindWhereItIsFast()
        {
            var handle = new GameObject("Handle");
            Quaternion frame = _loop.transform.localRotation;
            handle.transform.localRotation = frame;
            HubControl control = _loop.gameObject.AddComponent<HubControl>();
            control.Handle = handle.transform;
            Stage.Frames(5);
            for (int frames = 1; frames <= 120; frames++)
            {
                handle.transform.localPosition = frame * (1e-3f * (20f * frames / 120f) * Vector3.forward);
                handle.transform.localRotation = frame * Quaternion.Euler(0f, 0f, 90f * frames / 120f);
                Stage.Frames(1);
            }
            Stage.Frames(5);
            Assert.That(Wire, Is.EqualTo(0.02).Within(5e-4));
            Assert.That(_loop.State!.Hub!.Value.Turn, Is.EqualTo(Math.PI / 2.0).Within(0.05));
            handle.transform.localPosition += frame * (0.1f * Vector3.forward);
            Stage.Frames(60);
            Assert.That(Wire, Is.EqualTo(0.06).Within(2e-3), "a second at 40 mm/s");
            Stage.Frames(120);
            Assert.That(Wire, Is.EqualTo(0.12).Within(2e-3), "and no farther than the handle");
        }

        [TestCase(0f)]
        [TestCase(0.503f)]
        [TestCase(1f)]
        public void AnAttachment_StandsOnTheWire_AndABodyBecomesKinematic(float place)
        {
            WireAttachment free = new GameObject("Marker").AddComponent<WireAttachment>();
            WireAttachment heavy = new GameObject("Body").AddComponent<WireAttachment>();
            Rigidbody body = heavy.gameObject.AddComponent<Rigidbody>();
            foreach (WireAttachment one in new[] { free, heavy })
            {
                (one.Loop, one.PlaceAlongWire) = (_loop, place);
            }
            Stage.Frames(5);
            _loop.IsPaused = true;
            Stage.Frames(3);
            var points = new Vector3[_loop.SphereCount];
            _loop.GetPositions(points);
            float along = place * (points.Length - 1);
            int k = Math.Min((int)along, points.Length - 2);
            Vector3 expected = points[k] + (along - k) * (points[k + 1] - points[k]);
            Assert.That(Vector3.Distance(free.transform.position, expected), Is.LessThan(1e-6f));
            Assert.That(Vector3.Distance(heavy.transform.position, expected), Is.LessThan(1e-6f));
            Vector3 forward = free.transform.rotation * Vector3.forward;
            Assert.That(Vector3.Dot(forward, (points[k + 1] - points[k]).normalized), Is.GreaterThan(0.9999f));
            Assert.That(body.isKinematic, Is.True);
        }

        [Test]
        public void AVesselThatMovesInPlay_IsWarnedOfOnce()
        {
            var vessel = new GameObject("Vessel");
            vessel.AddComponent<MeshFilter>().sharedMesh = SampleTests.Tube(
                point => new Vector3(2f * point.x, 2f * point.y, 3f * point.z));
            vessel.transform.localRotation = _loop.transform.localRotation;
            vessel.transform.localScale = _loop.transform.localScale;
            _loop.Choose("params/default.json", new[] { "guidewireOffset=-400" }, "", isSteered: false);
            _loop.Vessels = new[] { vessel.AddComponent<SceneVessel>() };
            Stage.Frames(5);
            Assert.That(_loop.Problem, Is.Empty);
            Assert.That(Engine.Console, Is.Empty);
            _loop.transform.localPosition += Vector3.up;
            vessel.transform.localPosition += Vector3.up;
            Stage.Frames(3);
            Assert.That(Engine.Console, Is.Empty, "both together: the wall goes along");
            vessel.transform.localPosition += 0.01f * Vector3.up;
            Stage.Frames(30);
            Assert.That(Engine.Console, Has.Count.EqualTo(1));
            Assert.That(Engine.Console[0].Text, Does.Contain("Vessel").And.Contain("Load"));
        }

        [Test]
        public void ASavedRecording_IsADriveFile_ThatMovesTheHubsTheSameWay()
        {
            _loop.Recording = new SteeringRecord();
            HubControl catheter = _loop.gameObject.AddComponent<HubControl>();
            catheter.Instrument = 1;
            for (int k = 0; k < 6; k++)
            {
                (_loop.Push, _loop.Turn, catheter.Push) = (0.7f - 0.2f * k, 0.3f * (k - 2), 0.1f * k);
                Stage.Frames(15);
            }
            WireState steered = _loop.State!;
            Assert.That(steered.Hub!.Value.Shortfall, Is.Zero, "no hub has slipped");
            string folder = TestContext.CurrentContext.WorkDirectory;
            var files = new string[2];
            for (int k = 0; k < 2; k++)
            {
                files[k] = Path.Combine(folder, "recorded-" + k + ".csv");
                File.WriteAllText(files[k], _loop.Recording.ToDriveTable(k));
            }
            using var run = Io.SimulationSession.Open(Path.Combine(Stage.Root, "params/catheter.json"), NoDrive
                .Append("driveFile=" + files[0]).Append("catheters[0].driveFile=" + files[1]), "", isSteered: false);
            while (run.Simulation.StepCount < steered.StepCount)
            {
                run.Step(0.0, 0.0);
            }
            double largest = Enumerable.Range(0, steered.Rod.SphereCount).Max(i =>
                Vector3d.Distance(run.Simulation.State.Positions[i], steered.Rod.Positions[i]));
            Assert.That(largest, Is.Zero, "the same bits");
            Assert.That(run.Simulation.Catheters()[0].Insertion,
                Is.EqualTo(steered.Catheters[0].Hub.Insertion).Within(1e-12));
            _loop.Set("massDamping", "1");
            Assert.That(() => _loop.Recording.ToDriveTable(), Throws.InvalidOperationException
                .With.Message.Contains("massDamping was changed"));
        }

        // A tube with a centreline, and a wire that is pushed to its middle.
        [Test]
        public void TheTarget_IsToldOnce_WithTheTipsPlace_AndTheEndInOneLine()
        {
            string folder = Path.Combine(TestContext.CurrentContext.WorkDirectory, "target");
            Directory.CreateDirectory(folder);
            File.WriteAllText(Path.Combine(folder, "anatomy.json"), Anatomy());
            File.WriteAllText(Path.Combine(folder, "vessel.obj"), TubeFile());
            string file = Path.Combine(folder, "scene.json");
            File.WriteAllText(file, "{\"solver\": \"direct\", \"guidewireLength\": 80, \"numberRodElements\": 20, "
                + "\"wireRadius\": 0.00018, \"massDamping\": 20, \"proximalEnd\": \"clamped\", \"sheath\": {}, "
                + "\"drive\": \"displace\", \"insertionSpeed\": 0.04, "
                + "\"inlet\": 1, \"target\": [0, 0, 30], \"vessel\": {\"shape\": \"mesh\", \"file\": "
                + "\"vessel.obj\", \"anatomy\": \"anatomy.json\"}, \"timeStep\": 0.02, \"deltaThreshold\": 0, "
                + "\"maxSimulationSteps\": 60}");
            _loop.Choose(file, Array.Empty<string>(), "", isSteered: false);
            WireEvents events = _loop.gameObject.AddComponent<WireEvents>();
            var reached = new List<Vector3>();
            var ended = new List<string>();
            events.TargetReached.AddListener(reached.Add);
            events.Ended.AddListener(ended.Add);
            Stage.Frames(90);
            Assert.That(_loop.Problem, Is.Empty);
            Assert.That(reached, Has.Count.EqualTo(1));
            Vector3 place = _loop.transform.InverseTransformPoint(reached[0]);
            Assert.That(place.z, Is.EqualTo(30f).Within(4f), "a lumen radius and a step of 0.8 mm");
            Assert.That(ended, Has.Count.EqualTo(1));
            Assert.That(ended[0], Does.StartWith("finished: "));
        }

        private static string Anatomy()
        {
            var points = new StringBuilder();
            for (int k = 0; k <= 30; k++)
            {
                points.Append(k == 0 ? "" : ", ").Append(CultureInfo.InvariantCulture, $"[0, 0, {2 * k}, 2]");
            }
            string End(int number, int z, int into, int point) =>
                $"{{\"number\": {number}, \"name\": \"rim {number}\", "
                + $"\"centre\": [0, 0, {z}], \"radius\": 2, \"direction\": [0, 0, {into}], \"open\": true, "
                + $"\"point\": {point}}}";
            return $"{{\"ends\": [{End(1, 0, 1, 0)}, {End(2, 60, -1, 30)}], \"centreline\": {{\"points\": [{points}], "
                + $"\"parents\": [{string.Join(", ", Enumerable.Range(-1, 31))}], \"branches\": "
                + $"[{string.Join(", ", Enumerable.Repeat(1, 31))}], \"names\": [\"branch 1\"]}}}}";
        }

        private static string TubeFile()
        {
            const int Sides = 20;
            var text = new StringBuilder();
            for (int k = 0; k < 2 * Sides; k++)
            {
                double angle = 2.0 * Math.PI * (k % Sides) / Sides;
                text.Append(CultureInfo.InvariantCulture,
                    $"v {2.0 * Math.Cos(angle):R} {2.0 * Math.Sin(angle):R} {(k < Sides ? 0 : 60)}\n");
            }
            for (int a = 1; a <= Sides; a++)
            {
                int b = a % Sides + 1;
                text.Append(CultureInfo.InvariantCulture, $"f {a} {b} {Sides + b}\nf {a} {Sides + b} {Sides + a}\n");
            }
            return text.ToString();
        }
    }
}
