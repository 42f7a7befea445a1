namespace Guidewire.Unity.Tests
{
    /// <summary>A scene file of the project, played frame by frame.</summary>
    internal static class Stage
    {
        /// <summary>Real time of a frame in s.</summary>
        public const float Frame = 1f / 60f;

        /// <summary>Folder that holds Assets.</summary>
        public static string Root { get; } = FindRoot();

        public static SimulationLoop Loop => Engine.Find<SimulationLoop>();

        public static WireView Wire => Engine.Find<WireView>();

        /// <summary>What the views draw.</summary>
        public static RodState Shown => Loop.Shown!.Rod;

        public static RodState State => Loop.Session!.Simulation.State;

        /// <summary>Scenes in the order of the build settings.</summary>
        public static IEnumerable<string> Scenes()
        {
            foreach (string line in File.ReadLines(Path.Combine(Root, "ProjectSettings", "EditorBuildSettings.asset")))
            {
                if (line.Trim().StartsWith("path: ", System.StringComparison.Ordinal))
                {
                    yield return line.Trim().Substring(6);
                }
            }
        }

        /// <summary>Opens a scene; its objects are awake, no frame has been.</summary>
        /// <param name="scene">Its path.</param>
        /// <param name="project">Folder that holds its Assets; null: this project's.</param>
        public static void Open(string scene, string? project = null)
        {
            Engine.Reset(project ?? Root);
            Enter(scene, project: project);
        }

        /// <summary>Opens a scene in a process that a test has made ready.</summary>
        /// <param name="scene">Its path.</param>
        /// <param name="stepping">Between frames each frame has the steps of its time, however long they take.</param>
        /// <param name="project">As of <see cref="Open"/>.</param>
        public static void Enter(string scene, SteppingMode stepping = SteppingMode.Frames, string? project = null)
        {
            List<GameObject> objects = SceneFile.Read(project ?? Root, scene,
                typeof(SimulationLoop).Assembly, typeof(Stage).Assembly);
            foreach (GameObject one in objects)
            {
                if (one.GetComponent<SimulationLoop>() is SimulationLoop loop)
                {
                    loop.Stepping = stepping;
                }
            }
            Engine.Enter(objects);
        }

        /// <summary>Names what the next Load reads, instead of the Inspector.</summary>
        public static void Choose(this SimulationLoop loop, string file, string[] overrides, string log, bool isSteered)
        {
            (loop.ParameterFile, loop.Overrides, loop.LogFolder, loop.IsSteered) = (file, overrides, log, isSteered);
            loop.ParameterAsset = file.Length > 0 ? null : loop.ParameterAsset;
        }

        public static void Choose(this SimulationLoop loop, TextAsset? parameters, params SceneVessel[] vessels) =>
            (loop.ParameterAsset, loop.Vessels) = (parameters, vessels);

        /// <summary>Opens the scene in which the wire is steered by hand.</summary>
        public static void OpenInsertion() => Open("Assets/Scenes/Insertion.unity");

        public static void Frames(int count)
        {
            for (int k = 0; k < count; k++)
            {
                Engine.Frame(Frame);
            }
        }

        /// <summary>Presses a key for one frame.</summary>
        public static void Tap(KeyCode key)
        {
            Engine.Press(key);
            Frames(1);
            Engine.Release(key);
        }

        /// <summary>An error with these words was logged.</summary>
        public static void AssertLogged(LogType type, string words)
        {
            Assert.That(Engine.Console.Exists(line => line.Type == type && line.Text.Contains(words)), Is.True,
                words + " is not among: " + string.Join(" | ", Engine.Console));
        }

        private static string FindRoot()
        {
            string? folder = TestContext.CurrentContext.TestDirectory;
            while (folder != null && !Directory.Exists(Path.Combine(folder, "ProjectSettings")))
            {
                folder = Path.GetDirectoryName(folder);
            }
            return folder ?? throw new DirectoryNotFoundException("no folder above the tests holds ProjectSettings");
        }
    }
}
