using System;
using System.Reflection;
using Guidewire.Io;
using UnityEngine.InputSystem;
using UnityEngine.Rendering;

namespace Guidewire.Unity.Tests
{
    /// <summary>Projects of others, by description: their pipeline, their input, where they put a wire.</summary>
    public sealed class ProjectTests
    {
        [SetUp]
        public void Enter() => Engine.Reset(Stage.Root);

        [TearDown]
        public void Leave()
        {
            Engine.Unload();
            GraphicsSettings.currentRenderPipeline = null;
        }

        private sealed class Pipeline : RenderPipelineAsset
        {
            private readonly string _shader;

            public Pipeline(string shader)
            {
                _shader = shader;
            }

            public override Shader defaultShader => _shader.Length == 0 ? null! : Shader.Find(_shader);
        }

        private static SimulationLoop Made(string name = "Wire", string file = "params/catheter.json")
        {
            SimulationLoop loop = new GameObject(name).AddComponent<SimulationLoop>();
            loop.Stepping = SteppingMode.Frames;
            loop.Choose(file, new[] { "deltaThreshold=0", "maxSimulationSteps=1000000" }, "", isSteered: true);
            return loop;
        }

        [TestCase(null, "Guidewire/Surface")]
        [TestCase("Universal Render Pipeline/Lit", "Guidewire/Surface")]
        [TestCase("HDRP/Lit", "HDRP/Lit")]
        [TestCase("", "Guidewire/Surface")]
        public void Views_TakeAShaderThatThePipelineDraws_AndAPlayerContains(string? pipeline, string shader)
        {
            GraphicsSettings.currentRenderPipeline = pipeline == null ? null : new Pipeline(pipeline);
            SimulationLoop loop = Made();
            WireView view = loop.gameObject.AddComponent<WireView>();
            view.Colouring = Colouring.Bending;
            loop.gameObject.AddComponent<VesselView>();
            loop.gameObject.AddComponent<ContactView>();
            loop.gameObject.layer = 9;
            Stage.Frames(3);
            Assert.That(Engine.Drawn, Has.Count.GreaterThanOrEqualTo(3), "wire, catheter, vessel");
            foreach ((Mesh _, Matrix4x4 _, Material material, int layer) in Engine.Drawn)
            {
                Assert.That(material.shader.name, Is.EqualTo(shader));
                Assert.That(layer, Is.EqualTo(9));
                Assert.That(material.renderQueue, Is.EqualTo(material.color.a < 1f ? 3000 : 2000));
                bool isTransparent = material.color.a < 1f && pipeline == "HDRP/Lit";
                Assert.That(material.IsKeywordEnabled("_SURFACE_TYPE_TRANSPARENT"), Is.EqualTo(isTransparent));
            }
            Assert.That(Engine.Drawn.FindAll(one => one.Material.color.a < 1f), Has.Count.EqualTo(2));
            Assert.That(Engine.Drawn[0].Material.mainTexture, Is.Not.Null, "the colour map");
            Assert.That(Engine.Console.FindAll(line => line.Type == LogType.Error), Is.Empty);
        }

        [Test]
        public void MaterialsOfTheUser_AreTakenAsTheyAre()
        {
            SimulationLoop loop = Made();
            var own = new Material(Shader.Find("Own/Gold"));
            WireView view = loop.gameObject.AddComponent<WireView>();
            (view.Material, view.CatheterMaterial) = (own, own);
            loop.gameObject.AddComponent<VesselView>().Material = own;
            Stage.Frames(2);
            Assert.That(Engine.Drawn, Has.All.Matches<(Mesh Mesh, Matrix4x4 Place, Material Material, int Layer)>(
                one => ReferenceEquals(one.Material, own)));
            view.NextColouring();
            Stage.Frames(1);
            Assert.That(Engine.Drawn[0].Material, Is.Not.EqualTo(own), "colours need a texture");
        }

        [Test]
        public void Views_FindTheirLoop_AboveThem_AndDrawNothingWithoutOneOrSwitchedOff()
        {
            var lonely = new GameObject("Lonely");
            lonely.AddComponent<WireView>();
            lonely.AddComponent<ContactView>();
            lonely.AddComponent<VesselView>();
            lonely.AddComponent<OrbitCamera>();
            lonely.AddComponent<Hud>();
            lonely.AddComponent<KeyboardControl>();
            Stage.Frames(3);
            Assert.That(Engine.Drawn, Is.Empty);
            SimulationLoop loop = Made();
            var below = new GameObject("Below");
            below.transform.SetParent(loop.transform);
            below.AddComponent<MeshFilter>().sharedMesh = new Mesh();
            below.AddComponent<MeshRenderer>();
            WireView view = below.AddComponent<WireView>();
            Stage.Frames(2);
            Assert.That(view.Loop, Is.EqualTo(loop));
            Assert.That(Engine.Drawn, Has.Count.EqualTo(2), "wire and catheter; the object's own mesh is its own");
            view.enabled = false;
            Stage.Frames(1);
            Assert.That(Engine.Drawn, Is.Empty);
            view.enabled = true;
            below.SetActive(false);
            Stage.Frames(1);
            Assert.That(Engine.Drawn, Is.Empty);
            Assert.That(Engine.Console.FindAll(line => line.Type == LogType.Error), Is.Empty);
        }

        [TestCase(true, false)]
        [TestCase(false, true)]
        [TestCase(true, true)]
        [TestCase(false, false)]
        public void Input_IsReadFromWhatThereIs(bool hasManager, bool hasPackage)
        {
            if (!hasManager)
            {
                Engine.RefuseInput();
            }
            if (hasPackage)
            {
                Keyboard.current = new Keyboard();
                Mouse.current = new Mouse();
            }
            SimulationLoop loop = Made();
            loop.gameObject.AddComponent<KeyInput>();
            OrbitCamera camera = new GameObject("Camera").AddComponent<OrbitCamera>();
            camera.Loop = loop;
            Hud hud = loop.gameObject.AddComponent<Hud>();
            Stage.Frames(2);
            if (hasManager)
            {
                Engine.Press(KeyCode.W);
                Engine.Press(KeyCode.LeftArrow);
                Engine.Mouse(0f, 0f, -1, 2f);
            }
            else if (hasPackage)
            {
                Keyboard.current[Key.A + (KeyCode.W - KeyCode.A)].isPressed = true;
                Keyboard.current[Key.LeftArrow].isPressed = true;
                Mouse.current.scroll.Value = new Vector2(0f, 1f);
            }
            float distance = camera.Distance;
            Stage.Frames(1);
            bool isSteered = hasManager || hasPackage;
            Assert.That((loop.Push, loop.Turn), Is.EqualTo(isSteered ? (1f, -1f) : (0f, 0f)));
            Assert.That(camera.Distance, isSteered ? Is.LessThan(distance) : Is.EqualTo(distance));
            hud.Refresh();
            Assert.That(hud.Text.Contains("Active Input Handling", StringComparison.Ordinal), Is.EqualTo(!isSteered));
            Assert.That(Engine.Console.FindAll(line => line.Type == LogType.Error), Is.Empty);
        }

        [Test]
        public void AScaledAndTurnedParent_TakesWireViewsAndCameraAlong()
        {
            var room = new GameObject("Room");
            room.transform.localPosition = new Vector3(5f, 1f, -2f);
            room.transform.localRotation = Quaternion.Euler(0f, 90f, 0f);
            room.transform.localScale = 2f * Vector3.one;
            SimulationLoop loop = Made();
            loop.transform.SetParent(room.transform, false);
            loop.transform.localScale = 0.001f * Vector3.one;
            WireView view = loop.gameObject.AddComponent<WireView>();
            OrbitCamera camera = new GameObject("Camera").AddComponent<OrbitCamera>();
            (camera.Loop, camera.Distance, camera.Target) = (loop, 300f, new Vector3(0f, 0f, 50f));
            Stage.Frames(2);
            Vector3 middle = room.transform.position + 0.002f * 50f * Vector3.right;
            Assert.That((camera.transform.position - middle).magnitude, Is.EqualTo(0.6f).Within(1e-4f),
                "300 mm in a room of twice the size");
            Vector3 first = Engine.Drawn[0].Place.MultiplyPoint3x4(view.Tube!.Vertices[view.Tube.RingOf(0)]);
            var positions = new Vector3[loop.SphereCount];
            loop.GetPositions(positions);
            Assert.That((first - positions[0]).magnitude, Is.EqualTo(0.002f * view.DrawnRadius).Within(1e-5f));
        }

        [Test]
        public void PlayTwice_WithoutReloadOfTheDomain_BeginsAnew()
        {
            for (int play = 0; play < 2; play++)
            {
                SimulationLoop loop = Made();
                loop.Push = 1f;
                Stage.Frames(20);
                Assert.That(loop.Problem, Is.Empty);
                Assert.That(loop.State!.Hub!.Value.Insertion, Is.EqualTo(20.0 * Stage.Frame * 0.04).Within(0.002));
                Engine.Unload();
                Assert.That(loop.State, Is.Null);
            }
        }

        [Test]
        public void ScriptsThatAreCompiledAnewInPlay_LeaveAWire_WhichIsDrawn()
        {
            System.Runtime.CompilerServices.RuntimeHelpers.RunClassConstructor(
                typeof(Guidewire.Editor.LoopInspector).Assembly.GetType("Guidewire.Editor.ReloadStep")!.TypeHandle);
            Stage.Open("Assets/Scenes/Insertion.unity");
            Engine.Press(KeyCode.W);
            Stage.Frames(20);
            SimulationSession before = Stage.Loop.Session!;
            Mesh tube = Stage.Wire.Mesh!;
            Engine.Reload(ScriptRules.SurvivesReload);
            Assert.That(Stage.Loop.State, Is.Null);
            Stage.Frames(5);
            Assert.That(Stage.Loop.Problem, Is.Empty);
            Assert.That(Stage.Loop.Session, Is.Not.Null.And.Not.EqualTo(before));
            Assert.That(Stage.Loop.State!.StepCount, Is.GreaterThan(0));
            Assert.That(Engine.Drawn.FindAll(one => one.Mesh == Stage.Wire.Mesh && one.Mesh != tube),
                Has.Count.EqualTo(1));
            Assert.That(Engine.Drawn.FindAll(one => one.Mesh == Engine.Find<VesselView>().Meshes[0]),
                Has.Count.EqualTo(1));
            Assert.That(Engine.Console.FindAll(line => line.Type == LogType.Error), Is.Empty);
        }

        [Test]
        public void ALoopThatWasCopied_OrIsClosed_LeavesNoMeshBehind()
        {
            SimulationLoop loop = Made();
            loop.gameObject.AddComponent<WireView>();
            Stage.Frames(2);
            var copied = new GameObject(Engine.Renderers[0].name);    // as of a copy of the loop's object
            copied.transform.SetParent(loop.transform);
            copied.AddComponent<MeshFilter>().sharedMesh = Engine.Renderers[0].GetComponent<MeshFilter>().sharedMesh;
            copied.AddComponent<MeshRenderer>().sharedMaterial = Engine.Renderers[0].sharedMaterial;
            loop.Load();
            Stage.Frames(2);
            Assert.That(Engine.Drawn, Has.Count.EqualTo(2), "wire and catheter");
            loop.Close();
            Stage.Frames(2);
            Assert.That(Engine.Drawn, Is.Empty);
        }

        [Test]
        public void OfSeveralInputs_TheFirstThatIsEnabled_Steers()
        {
            SimulationLoop loop = Made();
            KeyInput keys = loop.gameObject.AddComponent<KeyInput>();
            InputSystemWire device = loop.gameObject.AddComponent<InputSystemWire>();
            ((InputAction)typeof(InputSystemWire).GetField("_push", BindingFlags.Instance | BindingFlags.NonPublic)!
                .GetValue(device)!).Value = 0.5f;
            Engine.Press(KeyCode.W);
            Stage.Frames(2);
            Assert.That(loop.Push, Is.EqualTo(1f));
            keys.enabled = false;
            Stage.Frames(1);
            Assert.That(loop.Push, Is.EqualTo(0.5f));
        }

        [Test]
        public void ALoopWithoutParameters_SaysWhatToChoose_AndIsNoError()
        {
            SimulationLoop loop = new GameObject("Empty").AddComponent<SimulationLoop>();
            loop.gameObject.AddComponent<WireView>();
            Stage.Frames(5);
            Assert.That(loop.Problem, Is.Empty);
            Assert.That(Engine.Console, Has.Count.EqualTo(1));
            Assert.That(Engine.Console[0].Type, Is.EqualTo(LogType.Warning));
            Assert.That(Engine.Console[0].Text, Does.Contain("Empty").And.Contain("choose a Parameter Asset"));
            loop.ParameterAsset = new TextAsset("{}") { name = "defaults" };
            loop.Stepping = SteppingMode.Frames;
            loop.Load();
            Assert.That(loop.Problem, Is.Empty);
        }

        [Test]
        public void TwoScenes_OneUponTheOther_KeepToThemselves()
        {
            Stage.Enter("Assets/Scenes/Longitudinal.unity");
            SimulationLoop first = Stage.Loop;
            Stage.Enter("Assets/Scenes/CollisionWall.unity");
            Stage.Frames(30);
            Assert.That(first.State!.StepCount, Is.GreaterThan(0));
            int drawn = Engine.Drawn.Count;
            UnityEngine.Object.Destroy(first.gameObject);
            Stage.Frames(10);
            Assert.That(Engine.Drawn.Count, Is.LessThan(drawn), "the views of the loop that is gone show nothing");
            Assert.That(Engine.Console.FindAll(line => line.Type == LogType.Error), Is.Empty);
        }

        [Test]
        public void AVesselThatIsMoved_StandsInItsNewPlace_OnceLoadedAgain()
        {
            SimulationLoop loop = Made(file: "params/insertion-accurate.json");
            Stage.Frames(1);
            Mesh arch = loop.gameObject.AddComponent<VesselView>() is VesselView view && Drawn(view) is Mesh mesh
                ? mesh : null!;
            var vessel = new GameObject("Vessel");
            vessel.AddComponent<MeshFilter>().sharedMesh = arch;
            var rim = new GameObject("Rim");
            rim.transform.localPosition = new Vector3(0f, 0f, -320f);
            rim.transform.SetParent(vessel.transform);
            SceneVessel walls = vessel.AddComponent<SceneVessel>();
            walls.OpenRims = new[] { rim.transform };
            loop.Choose("params/insertion-accurate.json", new[] { "vessel=null" }, "", isSteered: true);
            loop.Choose(null, walls);
            loop.Load();
            Assert.That(loop.Problem, Is.Empty);
            vessel.transform.localPosition = new Vector3(0f, 500f, 0f);
            loop.Load();
            Assert.That(loop.Problem, Does.Contain("outside"), "the wire stayed where it was");
            loop.transform.localPosition = new Vector3(0f, 500f, 0f);
            loop.Load();
            Assert.That(loop.Problem, Is.Empty);
        }

        private static Mesh? Drawn(VesselView view)
        {
            Stage.Frames(1);
            return view.Meshes.Count > 0 ? view.Meshes[0] : null;
        }

        // The package below Packages, under its name, as the Package Manager resolves it.
        [Test]
        public void APackageByPath_FindsItsPrefabAndItsManual_BelowItsOwnFolder()
        {
            string project = Path.Combine(TestContext.CurrentContext.WorkDirectory, "by-path");
            string manual = Path.Combine(project, "Packages/org.guidewire.simulation/Documentation~");
            Directory.CreateDirectory(manual);
            File.Copy(Path.Combine(Stage.Root, "Assets/Guidewire/Documentation~/index.md"),
                Path.Combine(manual, "index.md"), true);
            string before = Directory.GetCurrentDirectory();
            UnityEditor.PackageManager.PackageInfo.Installed = new UnityEditor.PackageManager.PackageInfo
            {
                assetPath = "Packages/org.guidewire.simulation",
            };
            try
            {
                Directory.SetCurrentDirectory(project);
                Assert.That(typeof(WireView).GetCustomAttribute<HelpURLAttribute>()!.URL,
                    Is.EqualTo("file://" + manual + "/index.md#views"));
                EditorTests.Call(EditorTests.Menu, "CreateWire", new UnityEditor.MenuCommand(null));
                Assert.That(Engine.Find<SimulationLoop>(), Is.Not.Null);
            }
            finally
            {
                Directory.SetCurrentDirectory(before);
                UnityEditor.PackageManager.PackageInfo.Installed = null;
                Directory.Delete(project, true);
            }
        }

        [Test]
        public void EveryComponent_HasHelp_InASectionOfTheManual()
        {
            string before = Directory.GetCurrentDirectory();
            Directory.SetCurrentDirectory(Stage.Root);
            try
            {
                foreach (Type type in typeof(SimulationLoop).Assembly.GetExportedTypes())
                {
                    if (typeof(MonoBehaviour).IsAssignableFrom(type) && !type.IsAbstract)
                    {
                        string[] url = type.GetCustomAttribute<HelpURLAttribute>()!.URL.Split('#');
                        string page = File.ReadAllText(new Uri(url[0]).LocalPath).ToLowerInvariant();
                        Assert.That(page, Does.Contain("\n## " + url[1].Replace('-', ' ') + "\n"), type.Name);
                    }
                }
            }
            finally
            {
                Directory.SetCurrentDirectory(before);
            }
        }

        [Test]
        public void Hud_GrowsWithTheDotsOfTheScreen_AndNobodysSettingsAreChanged()
        {
            SimulationLoop loop = Made();
            Hud hud = loop.gameObject.AddComponent<Hud>();
            Screen.dpi = 192f;
            Stage.Frames(1);
            Assert.That(hud.Scale, Is.EqualTo(2f));
            Assert.That(Application.runInBackground, Is.False);
            Assert.That(Application.targetFrameRate, Is.EqualTo(-1));
            Assert.That(QualitySettings.vSyncCount, Is.EqualTo(1));
        }
    }
}
